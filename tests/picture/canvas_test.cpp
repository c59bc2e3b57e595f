// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Canvas: pixels where they were drawn, text where it was measured, files that others read.
#include "picture/canvas.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/error.h"
#include "picture/png.h"
#include "picture/text.h"
#include "support/temporary_directory.h"

namespace ltc::picture {
namespace {

using ltc::test::names_in;
using ltc::test::read_file;
using ltc::test::TemporaryDirectory;

constexpr Color red{1, 0, 0};
const ColorScale gray_blue{Scale::linear(0, 1), &ColorMap::viridis(), ""};

// A colour as pixels store it.
Color stored(const Color& color) {
  const auto byte = [](double channel) { return std::round(255 * channel) / 255; };
  return {byte(color.red), byte(color.green), byte(color.blue)};
}

// The box around all pixels that are not white.
Box inked(const Canvas& canvas) {
  int left = canvas.width(), top = canvas.height(), right = 0, bottom = 0;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x)
      if (!(canvas.pixel(x, y) == white)) {
        left = std::min(left, x);
        right = std::max(right, x + 1);
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1);
      }
  return {1.0 * left, 1.0 * top, 1.0 * right - left, 1.0 * bottom - top};
}

TEST(Canvas, RefusesSizesItCannotHave) {
  for (const auto& [width, height] : {std::pair{0, 10}, {10, -1}, {16385, 10}})
    EXPECT_THROW(Canvas(width, height), InputError);
}

TEST(Canvas, RectanglesFillExactlyTheirPixels) {
  Canvas canvas(20, 10);
  canvas.rectangle({3, 2, 5, 4}, red);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      EXPECT_EQ(canvas.pixel(x, y), x >= 3 && x < 8 && y >= 2 && y < 6 ? red : white);
}

TEST(Canvas, LinesPolygonsAndDiscsAreWhereTheyShould) {
  Canvas canvas(100, 100);
  canvas.line({10, 20.5}, {40, 20.5}, {red, 1});
  canvas.polygon(std::array<Point, 3>{{{60, 10}, {90, 10}, {60, 40}}}, red);
  canvas.disc({30, 70}, 10, red);
  canvas.circle({70, 70}, 10, {red, 3});
  EXPECT_EQ(canvas.pixel(25, 20), red);
  EXPECT_EQ(canvas.pixel(25, 21), white);
  EXPECT_EQ(canvas.pixel(65, 15), red);
  EXPECT_EQ(canvas.pixel(85, 35), white);
  EXPECT_EQ(canvas.pixel(30, 70), red);
  EXPECT_EQ(canvas.pixel(30, 81), white);
  EXPECT_EQ(canvas.pixel(70, 70), white);
  EXPECT_EQ(canvas.pixel(79, 70), red);
}

TEST(Canvas, NearestImagesShowEachCellInItsColour) {
  Canvas canvas(40, 30);
  const Field field{3, 2, {0, 0.25f, 0.5f, 0.75f, 1, std::nanf("")}};
  canvas.image(field, gray_blue, {5, 4, 30, 20});
  for (int y = 4; y < 24; ++y)
    for (int x = 5; x < 35; ++x)
      EXPECT_EQ(canvas.pixel(x, y), stored(gray_blue.at(field.at((y - 4) / 10, (x - 5) / 10))))
          << x << " " << y;
  EXPECT_EQ(canvas.pixel(4, 10), white);
  EXPECT_EQ(canvas.pixel(35, 10), white);
}

TEST(Canvas, LinearImagesInterpolateValues) {
  Canvas canvas(8, 1);
  canvas.image({2, 1, {0, 1}}, gray_blue, canvas.area(), Sampling::linear);
  // Cell centres at 2 and 6: pixel centre 0.5 is before the first, 3.5 is 3/8 of the way.
  EXPECT_EQ(canvas.pixel(0, 0), stored(gray_blue.at(0)));
  EXPECT_EQ(canvas.pixel(3, 0), stored(gray_blue.at(0.375)));
  EXPECT_EQ(canvas.pixel(7, 0), stored(gray_blue.at(1)));
}

TEST(Canvas, LinearImagesKeepMissingCellsMissingAndTheOthersWhole) {
  Canvas canvas(8, 1);
  canvas.image({2, 1, {0.5f, std::nanf("")}}, gray_blue, canvas.area(), Sampling::linear);
  for (int x = 0; x < 8; ++x)
    EXPECT_EQ(canvas.pixel(x, 0), stored(x < 4 ? gray_blue.at(0.5) : missing)) << x;
}

TEST(Canvas, RefusesFieldsWithoutAllTheirValues) {
  Canvas canvas(8, 8);
  EXPECT_THROW(canvas.image({2, 2, {1, 2, 3}}, gray_blue, canvas.area()), InputError);
  EXPECT_THROW(canvas.image({0, 0, {}}, gray_blue, canvas.area()), InputError);
}

TEST(Canvas, TextStaysInTheBoxThatWasMeasured) {
  for (const double rotation_degrees : {0.0, 90.0, 30.0})
    for (const HorizontalAnchor horizontal :
         {HorizontalAnchor::left, HorizontalAnchor::center, HorizontalAnchor::right})
      for (const VerticalAnchor vertical : {VerticalAnchor::top, VerticalAnchor::middle,
                                            VerticalAnchor::baseline, VerticalAnchor::bottom}) {
        Canvas canvas(500, 500);
        const TextStyle style{30, ink, horizontal, vertical, true, rotation_degrees};
        canvas.text({250, 250}, "Égalité (αθφ)", style);
        const Box box = canvas.text_box({250, 250}, "Égalité (αθφ)", style);
        const Box found = inked(canvas);
        EXPECT_GT(found.width, 20);
        // Antialiasing may touch the next pixel.
        EXPECT_TRUE(box.inset(-1.5).contains(found)) << rotation_degrees;
        // And the box is not generous: side bearings, and ascents taller than the letters.
        EXPECT_NEAR(found.center().x, box.center().x, 6) << rotation_degrees;
        EXPECT_NEAR(found.center().y, box.center().y, 6) << rotation_degrees;
      }
}

TEST(Canvas, RotatesTextCounterClockwise) {
  Canvas canvas(300, 300);
  canvas.text({150, 150}, "upwards", {.size = 20, .rotation_degrees = 90});
  const Box found = inked(canvas);
  EXPECT_LT(found.bottom(), 152);
  EXPECT_LT(found.top, 90);
}

TEST(Canvas, SurvivesTextThatIsNoUtf8) {
  Canvas canvas(300, 50);
  canvas.text({5, 30}, "a\xff\xc3(\xed\xa0\x80 b", {});
  const double after_bad_text = canvas.text_width("good", {});
  EXPECT_GT(after_bad_text, 0);
  EXPECT_NO_THROW(canvas.png_bytes());
}

TEST(CleanUtf8, KeepsWhatIsValidAndMarksWhatIsNot) {
  EXPECT_EQ(clean_utf8("aä→𝛼"), "aä→𝛼");
  EXPECT_EQ(clean_utf8("a\xff"), "a\uFFFD");
  EXPECT_EQ(clean_utf8("\xc3"), "\uFFFD");                      // truncated
  EXPECT_EQ(clean_utf8("\xc0\xaf"), "\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(clean_utf8("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // surrogate
  EXPECT_EQ(clean_utf8("a\nb"), "a\uFFFDb");                    // control character
  EXPECT_EQ(clean_utf8(""), "");
}

TEST(FittedText, ShrinksToTheWidth) {
  Canvas canvas(400, 60);
  fitted_text(canvas, {10, 40}, "a line that is too long for this", {.size = 30}, 200);
  EXPECT_LE(inked(canvas).right(), 211);
  EXPECT_GT(inked(canvas).right(), 190);
}

TEST(Canvas, ClippingEndsEvenAfterAnException) {
  Canvas canvas(20, 20);
  EXPECT_THROW(canvas.clipped({0, 0, 5, 5},
                              [&] {
                                canvas.rectangle(canvas.area(), red);
                                throw std::runtime_error("stop");
                              }),
               std::runtime_error);
  EXPECT_EQ(canvas.pixel(4, 4), red);
  EXPECT_EQ(canvas.pixel(5, 5), white);
  canvas.rectangle({10, 10, 5, 5}, red);
  EXPECT_EQ(canvas.pixel(12, 12), red);
}

TEST(Canvas, HatchStaysInItsBox) {
  Canvas canvas(40, 40);
  canvas.hatch({10, 10, 20, 20}, ink);
  const Box found = inked(canvas);
  EXPECT_TRUE((Box{10, 10, 20, 20}.contains(found)));
  EXPECT_GT(found.width, 15);
}

TEST(Canvas, PixelsOutsideAreRefused) {
  const Canvas canvas(4, 4);
  EXPECT_THROW(canvas.pixel(4, 0), InputError);
  EXPECT_THROW(canvas.pixel(0, -1), InputError);
}

TEST(Canvas, PngIsReadByLibpngPixelForPixel) {
  Canvas canvas(33, 17);
  canvas.image({3, 1, {0, 0.4f, 1}}, gray_blue, canvas.area(), Sampling::linear);
  const test::DecodedPng png = test::decode_png(canvas.png_bytes());
  ASSERT_EQ(png.width, 33);
  ASSERT_EQ(png.height, 17);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 33; ++x) {
      const unsigned char* rgb = &png.rgb[static_cast<std::size_t>(3 * (33 * y + x))];
      EXPECT_EQ(canvas.pixel(x, y), (Color{rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0}));
    }
}

TEST(Canvas, WritesThePngAndNothingElse) {
  const TemporaryDirectory folder;
  const Canvas canvas(8, 8, red);
  canvas.write_png(folder / "a.png");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.png"});
  EXPECT_EQ(read_file(folder / "a.png"), canvas.png_bytes());
}

TEST(Canvas, SaysWhichFileItCannotWrite) {
  const TemporaryDirectory folder;
  folder.write("file", "");
  for (const auto& path : {folder / "absent" / "a.png", folder / "file" / "a.png"})
    try {
      Canvas(8, 8).write_png(path);
      FAIL() << path;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("a.png"), std::string::npos) << error.what();
    }
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"file"});
}

TEST(DecodePng, RefusesATruncatedFile) {
  const std::string bytes = Canvas(64, 64, red).png_bytes();
  EXPECT_THROW(test::decode_png(bytes.substr(0, bytes.size() / 2)), std::runtime_error);
}

}  // namespace
}  // namespace ltc::picture
