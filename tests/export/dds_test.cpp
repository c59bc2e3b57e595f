// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// DDS: headers byte by byte, our reader, OpenSceneGraph's, published files, and what is refused.
#include "export/dds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "export/files.h"
#include "export/images.h"
#include "support/reference.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using testing::expect_refusal;
using testing::field;
using testing::numbered_image;
using testing::with;

Image read(const std::string& bytes) {
  return decode_dds(bytes, "x.dds");
}

TEST(Dds, EveryShapeAndFormatIsReadBack) {
  for (const ImageShape shape : testing::all_shapes)
    for (const Precision precision : testing::all_precisions)
      for (const std::size_t channels : {1, 2, 3, 4}) {
        const Image image = numbered_image(shape, precision, channels);
        if (channels == 3 && precision == Precision::half) {
          expect_refusal([&] { encode_dds(image); }, "3 channels of 16 bits; allowed: RGBA32F, ");
          continue;
        }
        EXPECT_EQ(read(encode_dds(image)), image);
        if (shape == ImageShape::array)
          expect_refusal([&] { encode_dds(image, DdsHeader::legacy); }, "image: an array; allowed");
        else if (channels == 3)
          expect_refusal([&] { encode_dds(image, DdsHeader::legacy); }, "3 channels of 32 bits");
        else
          EXPECT_EQ(read(encode_dds(image, DdsHeader::legacy)), image);
      }
}

TEST(Dds, HeadersAreThoseOfTheSpecification) {
  const std::string flat = encode_dds(numbered_image(ImageShape::flat, Precision::half));
  EXPECT_EQ(flat.size(), 148u + 5 * 3 * 8);
  EXPECT_EQ(flat.substr(0, 4), "DDS ");
  // size, flags, height, width, bytes of a row, depth, levels; pixel format; caps
  const std::uint32_t expected[][2] = {
      {4, 124}, {8, 0x100f},   {12, 3},  {16, 5},   {20, 40}, {24, 1},  {28, 1},  {76, 32},
      {80, 4},  {108, 0x1000}, {112, 0}, {128, 10}, {132, 3}, {136, 0}, {140, 1}, {144, 0}};
  for (const auto& [offset, value] : expected)
    EXPECT_EQ(field(flat, offset), value) << offset;
  EXPECT_EQ(flat.substr(84, 4), "DX10");
  EXPECT_EQ(flat.substr(148 + 8, 2), std::string("\x00\x2c", 2));  // 4/64 as a half

  const std::string array = encode_dds(numbered_image(ImageShape::array, Precision::single));
  EXPECT_EQ(field(array, 128), 2u);
  EXPECT_EQ(field(array, 140), 2u);
  const std::string volume = encode_dds(numbered_image(ImageShape::volume, Precision::single));
  EXPECT_EQ(field(volume, 8), 0x80100fu);
  EXPECT_EQ(field(volume, 24), 2u);
  EXPECT_EQ(field(volume, 112), 0x200000u);
  EXPECT_EQ(field(volume, 132), 4u);
  EXPECT_EQ(field(volume, 140), 1u);
  const std::string legacy =
      encode_dds(numbered_image(ImageShape::flat, Precision::half), DdsHeader::legacy);
  EXPECT_EQ(legacy.size(), 128u + 5 * 3 * 8);
  EXPECT_EQ(field(legacy, 84), 113u);
  EXPECT_EQ(
      field(encode_dds(numbered_image(ImageShape::flat, Precision::single), DdsHeader::legacy), 84),
      116u);
}

TEST(Dds, ValuesBeyondHalvesAreRefusedByNumber) {
  Image image = numbered_image(ImageShape::array, Precision::half);
  image.name = "ltc_1";
  image.values[4 * (15 + 7) + 3] = 65520;
  expect_refusal([&] { encode_dds(image); },
                 "image ltc_1: channel 3 of texel (2, 1) in layer 1 is 65520; 16 bits hold finite "
                 "values up to 65504");
  image.values[4 * (15 + 7) + 3] = -65504;
  EXPECT_EQ(read(encode_dds(image)).values, image.values);
  image.precision = Precision::single;
  image.values[0] = std::numeric_limits<float>::quiet_NaN();
  expect_refusal([&] { encode_dds(image); }, "is nan; 32 bits");
  image.values.pop_back();
  expect_refusal([&] { encode_dds(image); },
                 "119 values; 5 x 3 x 2 texels of 4 channels ask for 120");
  image.channels = 5;
  image.values.assign(150, 0);
  expect_refusal([&] { encode_dds(image); }, "5 channels of 32 bits; allowed");
}

TEST(Dds, HalvesAreTheNearest) {
  Image image = numbered_image(ImageShape::flat, Precision::half);
  image.values[0] = 1 + 1.0f / 2048;  // a tie: to even
  image.values[1] = 1 + 3.0f / 2048;  // a tie: to even
  image.values[2] = 1 + 1.0f / 2048 + 1e-6f;
  const Image found = read(encode_dds(image));
  EXPECT_EQ(found.values[0], 1);
  EXPECT_EQ(found.values[1], 1 + 2.0f / 1024);
  EXPECT_EQ(found.values[2], 1 + 1.0f / 1024);
}

TEST(Dds, OtherFilesAreRefusedByFault) {
  const std::string good = encode_dds(numbered_image(ImageShape::flat, Precision::half));
  const std::string volume = encode_dds(numbered_image(ImageShape::volume, Precision::half));
  const std::string legacy =
      encode_dds(numbered_image(ImageShape::flat, Precision::half), DdsHeader::legacy);
  using u32 = std::uint32_t;
  const std::pair<std::string, std::string> cases[] = {
      {"", "no DDS file"},
      {"PNG" + good.substr(3), "no DDS file"},
      {good.substr(0, 4), "cut short in the header: 4 of 128 bytes"},
      {good.substr(0, 127), "cut short in the header: 127 of 128"},
      {good.substr(0, 147), "cut short in the header: 147 of 148"},
      {good.substr(0, 148), "148 bytes long; its header asks for 268"},
      {good.substr(0, good.size() - 1), "267 bytes long; its header asks for 268"},
      {good + '\0', "269 bytes long; its header asks for 268"},
      {with(good, 4, u32(100)), "size of the header is 100; allowed: 124"},
      {with(good, 76, u32(0)), "size of the pixel format is 0; allowed: 32"},
      {with(good, 80, u32(0x41)), "bit masks"},
      {with(good, 28, u32(7)), "7 mip levels; allowed: 1"},
      {with(good, 112, u32(0xfe00)), "a cube map; allowed: 2-D, arrays, 3-D"},
      {with(good, 136, u32(4)), "a cube map"},
      {with(good, 128, u32(98)),
       "DXGI format is 98; allowed: 2 (RGBA32F), 6 (RGB32F), 10 (RGBA16F)"},
      {with(good, 84, u32(0x31545844)), "FourCC is 827611204; allowed: 111 (R16F)"},
      {with(legacy, 84, u32(117)), "FourCC is 117; allowed"},
      {with(good, 132, u32(2)), "resource dimension is 2; allowed: 3 (2-D), 4 (3-D)"},
      {with(volume, 140, u32(2)), "number of 3-D textures is 2; allowed: 1"},
      {with(good, 140, u32(0)), "5 x 3 x 0 texels"},
      {with(good, 140, u32(1) << 31), "5 x 3 x 2147483648 texels"},
      {with(good, 12, u32(0)), "5 x 0 x 1 texels of 4 channels; allowed: 1 to 16384"},
      {with(good, 16, u32(0xffffffff)), "4294967295 x 3 x 1 texels"},
      {with(with(good, 12, u32(16384)), 16, u32(16384)),
       "16384 x 16384 x 1 texels of 4 channels; "
       "allowed: up to"},
      {with(with(good, 12, u32(4096)), 16, u32(4096)),
       "268 bytes long; its header asks for "
       "134217876"},
  };
  for (const auto& [bytes, fault] : cases)
    expect_refusal([&] { read(bytes); }, fault);
  expect_refusal([] { decode_dds("", "folder/x.dds"); }, "folder/x.dds: ");
}

TEST(Dds, ThePublishedTexturesAreRead) {
  const auto first = test::reference_file("ltc_code_1.dds");
  const auto second = test::reference_file("ltc_code_2.dds");
  if (!std::filesystem::exists(first) || !std::filesystem::exists(second))
    GTEST_SKIP() << "no " << first << " or " << second
                 << "; set LTCFIT_REFERENCE_DIR to the folder that has them";
  for (const auto& path : {first, second}) {
    const std::string bytes = test::read_file(path);
    const Image image = decode_dds(bytes, path);
    EXPECT_EQ(image.width, 64u);
    EXPECT_EQ(image.height, 64u);
    EXPECT_EQ(image.shape, ImageShape::flat);
    EXPECT_EQ(image.precision, Precision::half);
    for (const float value : image.values)
      ASSERT_TRUE(std::isfinite(value));
    EXPECT_EQ(encode_dds(image, DdsHeader::legacy), bytes) << "the same header as theirs";
  }
  // Roughness 1 seen from above is the cosine itself: Minv = (1, 0, 0, 1) to a few hundredths.
  const Image matrix = decode_dds(test::read_file(first), first);
  const float* const rough = &matrix.values[4 * 63];
  EXPECT_NEAR(rough[0], 1, 0.05);
  EXPECT_NEAR(rough[1], 0, 0.05);
  EXPECT_NEAR(rough[2], 0, 0.05);
}

// What osgconv prints of an image: its sizes, OpenGL's names of its texels, and the base64 of its
// data. Empty if it could not read it.
std::string seen_by_openscenegraph(const test::TemporaryDirectory& folder,
                                   const std::string& bytes) {
  folder.write("x.dds", bytes);
  std::filesystem::remove(folder / "x.osgt");
  testing::run("cd " + folder.path().string() +
               " && osgconv x.dds x.osgt -O WriteImageHint=IncludeData");
  return std::filesystem::exists(folder / "x.osgt") ? test::read_file(folder / "x.osgt") : "";
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

TEST(Dds, OpenSceneGraphFindsSizeFormatAndValues) {
  const test::TemporaryDirectory folder;
  for (const Precision precision : testing::all_precisions)
    for (const ImageShape shape : {ImageShape::flat, ImageShape::volume})
      for (const DdsHeader header : {DdsHeader::dx10, DdsHeader::legacy}) {
        const Image image = numbered_image(shape, precision, 4, 8, 4);
        const std::string bytes = encode_dds(image, header);
        const std::size_t begin = header == DdsHeader::dx10 ? 148 : 128;
        std::string seen = seen_by_openscenegraph(folder, bytes);
        const bool half = precision == Precision::half;
        // GL_RGBA, GL_HALF_FLOAT or GL_FLOAT
        for (const std::string part :
             {shape == ImageShape::flat ? "Size 8 4 1" : "Size 8 4 2", "PixelFormat 6408",
              half ? "DataType 5131" : "DataType 5126"})
          EXPECT_NE(seen.find(part), std::string::npos) << part << " is not in: " << seen;
        std::erase_if(seen, [](char c) { return c == '\n' || c == ' '; });
        EXPECT_NE(seen.find('"' + base64(std::string_view(bytes).substr(begin)) + '"'),
                  std::string::npos)
            << seen;
      }
  // And it can fail.
  EXPECT_EQ(seen_by_openscenegraph(folder, "DDS nothing"), "");
}

}  // namespace
}  // namespace ltc
