// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images of lights: what is read of PNG and OpenEXR, and what is refused.
#include "render/light_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "render/image_exr.h"
#include "render/png_writer.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::expect_one_line;
using test::message_of;
using testing::png_bytes;

TEST(LightImage, OfPngIsLinear) {
  const test::TemporaryDirectory folder;
  // 2 x 2: black, 188 (0.5029 by sRGB's formula), white; alpha as it is.
  const auto file = folder.write("x.png", png_bytes(2, 2, 8, PNG_COLOR_TYPE_RGB_ALPHA,
                                                    std::string("\0\xbc\xff\xff"
                                                                "\xff\0\0\x80"
                                                                "\x0a\0\0\0"
                                                                "\0\0\0\xff",
                                                                16)));
  const LightImage image = read_light_image(file);
  ASSERT_EQ(image.width, 2u);
  ASSERT_EQ(image.height, 2u);
  EXPECT_EQ(image.texel(0, 0)[0], 0);
  EXPECT_NEAR(image.texel(0, 0)[1], std::pow((188.0 / 255 + 0.055) / 1.055, 2.4), 1e-7);
  EXPECT_EQ(image.texel(0, 0)[2], 1);
  EXPECT_EQ(image.texel(0, 1)[0], 1) << "not multiplied by alpha";
  EXPECT_NEAR(image.texel(0, 1)[3], 128.0 / 255, 1e-7);
  EXPECT_NEAR(image.texel(1, 0)[0], 10.0 / 255 / 12.92, 1e-9) << "the second row is below";
}

TEST(LightImage, OfPngsOfEveryKind) {
  const test::TemporaryDirectory folder;
  const auto read = [&](int depth, int type, const std::string& samples) {
    return read_light_image(folder.write("x.png", png_bytes(1, 1, depth, type, samples)));
  };
  const LightImage grey = read(8, PNG_COLOR_TYPE_GRAY, "\xbc"),
                   grey16 = read(16, PNG_COLOR_TYPE_GRAY, "\xbc\xbc"),
                   grey_alpha = read(8, PNG_COLOR_TYPE_GRAY_ALPHA, "\xbc\x80"),
                   rgb16 = read(16, PNG_COLOR_TYPE_RGB, "\xbc\xbc\xbc\xbc\xbc\xbc");
  for (const LightImage* const image : {&grey, &grey16, &grey_alpha, &rgb16})
    for (std::size_t channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(image->texel(0, 0)[channel], 0.5029, 1e-4);
  EXPECT_EQ(grey.texel(0, 0)[3], 1);
  EXPECT_NEAR(grey_alpha.texel(0, 0)[3], 128.0 / 255, 1e-7);
  // 16 bits are more than 8: one more in the lower byte.
  EXPECT_GT(read(16, PNG_COLOR_TYPE_GRAY, "\xbc\xbd").texel(0, 0)[0], grey16.texel(0, 0)[0]);
}

TEST(LightImage, OfOpenExrIsAsItIs) {
  const test::TemporaryDirectory folder;
  picture::Field red{2, 1, {0.25f, 1e4f}}, green{2, 1, {0, 3}}, blue{2, 1, {1, 2}},
      alpha{2, 1, {1, 0.5f}};
  const ImageLayer color[] = {{"R", &red}, {"G", &green}, {"B", &blue}, {"A", &alpha}};
  write_image_exr(color, {}, folder / "c.exr");
  EXPECT_EQ(read_light_image(folder / "c.exr").rgba,
            (std::vector<float>{0.25f, 0, 1, 1, 1e4f, 3, 2, 0.5f}));
  const ImageLayer grey[] = {{"Y", &blue}};
  write_image_exr(grey, {}, folder / "y.exr");
  EXPECT_EQ(read_light_image(folder / "y.exr").rgba, (std::vector<float>{1, 1, 1, 1, 2, 2, 2, 1}));
}

TEST(LightImage, RefusesWhatIsNoImage) {
  const test::TemporaryDirectory folder;
  const auto refuses = [&](const std::string& bytes, const std::vector<std::string>& parts) {
    const auto file = folder.write("x.png", bytes);
    expect_one_line(message_of<InputError>([&] { read_light_image(file); }), parts);
  };
  const std::string good = testing::window_png(16);
  refuses("", {"x.png", "no image"});
  refuses("P6 1 1 255 abc", {"x.png", "no image"});
  for (const std::size_t length :
       {std::size_t{8}, std::size_t{20}, std::size_t{40}, good.size() / 2, good.size() - 1})
    refuses(good.substr(0, length), {"x.png", "damaged PNG"});
  std::string flipped = good;
  flipped[good.size() / 2] ^= 0x10;
  refuses(flipped, {"x.png", "damaged PNG"});
  // A million wide, which its checksum does not say.
  std::string wide = good;
  wide[17] = 0x10;
  refuses(wide, {"x.png", "damaged PNG"});
  refuses(std::string("v/1\x01") + "abc", {"x.png"});
  refuses(png_bytes(5000, 1, 8, PNG_COLOR_TYPE_GRAY, std::string(5000, 'x')),
          {"x.png", "5000 x 1", "1 to 4096"});
  EXPECT_THROW(read_light_image(folder / "missing.png"), IoError);
  EXPECT_THROW(read_light_image(folder.path()), IoError);
}

TEST(LightImage, RefusesRadianceThatCannotBe) {
  const test::TemporaryDirectory folder;
  for (const float value :
       {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    picture::Field grey{2, 2, {0, 0, 0, value}};
    const ImageLayer layers[] = {{"Y", &grey}};
    write_image_exr(layers, {}, folder / "y.exr");
    expect_one_line(message_of<InputError>([&] { read_light_image(folder / "y.exr"); }),
                    {"y.exr", "row 1, column 1", "finite"});
  }
  picture::Field other{1, 1, {1}};
  const ImageLayer layers[] = {{"Z", &other}};
  write_image_exr(layers, {}, folder / "z.exr");
  expect_one_line(message_of<InputError>([&] { read_light_image(folder / "z.exr"); }),
                  {"z.exr", "neither channels R, G and B nor Y"});
}

}  // namespace
}  // namespace ltc
