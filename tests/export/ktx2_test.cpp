// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// KTX 2.0: headers byte by byte, our reader, ktx-parse, a published file, and what is refused.
#include "export/ktx2.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "export/dds.h"
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
  return decode_ktx2(bytes, "x.ktx2");
}

TEST(Ktx2, EveryShapeAndFormatIsReadBack) {
  for (const ImageShape shape : testing::all_shapes)
    for (const Precision precision : testing::all_precisions)
      for (const std::size_t channels : {1, 2, 3, 4})
        for (const bool zstd : {false, true}) {
          const Image image = numbered_image(shape, precision, channels);
          EXPECT_EQ(read(encode_ktx2(image, zstd)), image);
        }
  Image one_layer = numbered_image(ImageShape::flat, Precision::half);
  one_layer.shape = ImageShape::array;
  EXPECT_EQ(read(encode_ktx2(one_layer, true)), one_layer);
}

TEST(Ktx2, HeadersAreThoseOfTheSpecification) {
  for (const bool zstd : {false, true}) {
    const std::string bytes = encode_ktx2(numbered_image(ImageShape::array, Precision::half), zstd);
    EXPECT_EQ(bytes.substr(0, 12), "\xABKTX 20\xBB\r\n\x1A\n");
    // vkFormat, typeSize, width, height, depth, layers, faces, levels, supercompression; format
    // descriptor, metadata, no global data
    const std::uint32_t metadata = field(bytes, 60);
    const std::uint32_t expected[] = {97,  2,  5,   3,        0, 2, 1, 1, zstd ? 2u : 0u,
                                      104, 92, 196, metadata, 0, 0, 0, 0};
    for (std::size_t i = 0; i < std::size(expected); ++i)
      EXPECT_EQ(field(bytes, 12 + 4 * i), expected[i]) << i;
    const auto offset = field<std::uint64_t>(bytes, 80);
    EXPECT_EQ(metadata % 4, 0u);
    EXPECT_EQ(offset, zstd ? 196 + metadata : (196 + metadata + 7) / 8 * 8);
    EXPECT_EQ(offset + field<std::uint64_t>(bytes, 88), bytes.size());
    EXPECT_EQ(field<std::uint64_t>(bytes, 96), 5u * 3 * 2 * 8);
    EXPECT_EQ(bytes.substr(200, 9), std::string("KTXwriter"));
    EXPECT_EQ(bytes.substr(210, 7 + version().size() + 1),
              "ltcfit " + std::string(version()) + '\0');
  }
  const std::string volume =
      encode_ktx2(numbered_image(ImageShape::volume, Precision::single), false);
  EXPECT_EQ(field(volume, 12), 109u);
  EXPECT_EQ(field(volume, 16), 4u);
  EXPECT_EQ(field(volume, 28), 2u);
  EXPECT_EQ(field(volume, 32), 0u);
  EXPECT_EQ(field<std::uint64_t>(volume, 80) % 16, 0u);
}

// The published file is made by another program, of the same kind of texels as ours.
std::filesystem::path published() {
  return test::reference_file("bevy_ltc.ktx2");
}

TEST(Ktx2, ThePublishedTextureIsReadAndDescribedAsWeDo) {
  if (!std::filesystem::exists(published()))
    GTEST_SKIP() << "no " << published() << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const std::string bytes = test::read_file(published());
  const Image image = decode_ktx2(bytes, published());
  EXPECT_EQ(image.width, 64u);
  EXPECT_EQ(image.height, 64u);
  EXPECT_EQ(image.layers, 2u);
  EXPECT_EQ(image.shape, ImageShape::array);
  EXPECT_EQ(image.precision, Precision::half);
  const std::string ours = encode_ktx2(image, true);
  EXPECT_EQ(ours.substr(12, 48), bytes.substr(12, 48));
  EXPECT_EQ(ours.substr(104, 92), bytes.substr(104, 92)) << "the format descriptor";
  EXPECT_LT(ours.size(), bytes.size() * 11 / 10);
}

TEST(Ktx2, ThePublishedLayersAreThePublishedTexturesToTheLastBit) {
  std::vector<float> textures;
  for (const char* const name : {"ltc_code_1.dds", "ltc_code_2.dds"}) {
    const auto path = test::reference_file(name);
    if (!std::filesystem::exists(path) || !std::filesystem::exists(published()))
      GTEST_SKIP() << "no " << path << " or " << published()
                   << "; set LTCFIT_REFERENCE_DIR to the folder that has them";
    const Image texture = decode_dds(test::read_file(path), path);
    textures.insert(textures.end(), texture.values.begin(), texture.values.end());
  }
  const Image image = decode_ktx2(test::read_file(published()), published());
  ASSERT_EQ(image.values.size(), textures.size());
  // They were rounded to halves by different means: a few differ, by one unit in the last place.
  int different = 0;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    different += image.values[i] != textures[i];
    ASSERT_NEAR(image.values[i], textures[i], std::max(std::abs(textures[i]), 1e-4f) / 1024) << i;
  }
  EXPECT_LE(different, 30);
}

TEST(Ktx2, ValuesThatCannotBeStoredAreRefused) {
  Image image = numbered_image(ImageShape::flat, Precision::half);
  image.values[5] = 1e5f;
  expect_refusal([&] { encode_ktx2(image, true); }, "is 100000; 16 bits hold");
  image.values[5] = 0;
  image.channels = 5;
  image.values.resize(75);
  expect_refusal([&] { encode_ktx2(image, true); }, "5 channels of 16 bits; allowed: R16F, ");
}

std::string frame_of(const std::string& bytes, bool with_size = true) {
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, with_size);
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), bytes.data(), bytes.size()));
  ZSTD_freeCCtx(context);
  return frame;
}

// The compressed file with another level.
std::string with_level(const std::string& bytes, const std::string& level) {
  const std::string start = bytes.substr(0, field<std::uint64_t>(bytes, 80));
  return with(start, 88, std::uint64_t{level.size()}) + level;
}

TEST(Ktx2, OtherFilesAreRefusedByFault) {
  const Image image = numbered_image(ImageShape::array, Precision::half);
  const std::string good = encode_ktx2(image, false), zstd = encode_ktx2(image, true);
  const std::string volume = encode_ktx2(numbered_image(ImageShape::volume, Precision::half), true);
  const std::string content(240, 'x');
  using u32 = std::uint32_t;
  using u64 = std::uint64_t;
  const u64 offset = field<u64>(good, 80);
  const std::pair<std::string, std::string> cases[] = {
      {"", "no KTX 2.0 file"},
      {good.substr(0, 11), "no KTX 2.0 file"},
      {with(good, 5, '1'), "no KTX 2.0 file"},
      {good.substr(0, 12), "cut short in the header: 12 of 104 bytes"},
      {good.substr(0, 103), "cut short in the header: 103 of 104"},
      {good.substr(0, 104), "92 bytes of format descriptor at 104; the file has 104"},
      {good.substr(0, 200), "bytes of metadata at 196; the file has 200"},
      {good.substr(0, offset), "a level of 240 bytes at"},
      {good.substr(0, good.size() - 1), "a level of 240 bytes at"},
      {good + '\0', "a level of 240 bytes at"},
      {with(good, 12, u32(37)), "vkFormat is 37; allowed: 76 (R16F), 83 (RG16F)"},
      {with(good, 12, u32(0)), "vkFormat is 0; allowed"},
      {with(good, 16, u32(1)), "typeSize is 1; allowed: 2"},
      {with(good, 20, u32(0)), "0 x 3 x 2 texels"},
      {with(good, 24, u32(0)), "5 x 0 x 2 texels"},
      {with(good, 24, ~u32(0)), "5 x 4294967295 x 2 texels"},
      {with(good, 32, ~u32(0)), "5 x 3 x 4294967295 texels"},
      {with(with(good, 20, u32(16384)), 24, u32(16384)), "values"},
      {with(volume, 32, u32(2)), "number of 3-D textures is 2; allowed: 0"},
      {with(good, 36, u32(6)), "number of faces is 6; allowed: 1"},
      {with(good, 36, u32(0)), "number of faces is 0; allowed: 1"},
      {with(good, 40, u32(4)), "number of mip levels is 4; allowed: 1"},
      {with(good, 44, u32(1)), "supercompression scheme is 1; allowed: 0 (none), 2 (Zstandard)"},
      {with(good, 44, u32(3)), "supercompression scheme is 3; allowed"},
      {with(good, 44, u32(2)), "is no Zstandard frame"},
      {with(good, 48, ~u32(0)), "format descriptor at 4294967295"},
      {with(good, 60, ~u32(0)), "4294967295 bytes of metadata"},
      {with(good, 80, u64(0)), "a level of 240 bytes at 0"},
      {with(good, 80, offset + 1), "a level of 240 bytes at"},
      {with(good, 80, u64(1) << 60), "bytes at 1152921504606846976"},
      {with(good, 80, ~u64(0)), "bytes at 18446744073709551615"},
      {with(good, 88, u64(239)), "a level of 239 bytes"},
      {with(good, 88, ~u64(0)), "a level of 18446744073709551615 bytes"},
      {with(good, 96, u64(0)), "has 0 bytes uncompressed; its size asks for 240"},
      {with(good, 96, u64(1) << 60), "uncompressed; its size asks for 240"},
      {with(good, 20, u32(6)), "has 240 bytes uncompressed; its size asks for 288"},
      {with(with(good, 20, u32(6)), 96, u64(288)), "has 240 bytes; its size asks for 288"},
      {with(with(zstd, 20, u32(6)), 96, u64(288)), "frame holds 240 bytes; its size asks for 288"},
      {with_level(zstd, frame_of(std::string(1 << 20, 'x'))), "frame holds 1048576 bytes"},
      {with_level(zstd, frame_of(content, false)), "frame does not say its size"},
      {with_level(zstd, frame_of(content) + frame_of(content)), "frame is damaged: Destination"},
      {with_level(zstd, frame_of(content) + "xy"), "frame is damaged"},
      {with_level(zstd, frame_of(content).substr(0, 12)), "frame is damaged"},
      {with_level(zstd, ""), "is no Zstandard frame"},
  };
  for (const auto& [bytes, fault] : cases)
    expect_refusal([&] { read(bytes); }, fault);
  EXPECT_NO_THROW(read(with_level(zstd, frame_of(content)))) << "the frame of the cases is good";
  EXPECT_EQ(read(with(good, 40, u32(0))), image) << "0 levels: one, others may be made of it";
}

// 69 MB of zeros, whose frame says so and is what it says: some kB.
TEST(Ktx2, BombsAreRefusedAndNotWritten) {
  Image image = numbered_image(ImageShape::flat, Precision::half, 4, 4096, 2112);
  image.values.assign(image.values.size(), 0);
  const std::string plain = encode_ktx2(image, true);
  EXPECT_EQ(field(plain, 44), 0u);
  EXPECT_EQ(read(plain), image);
  const std::string level = frame_of(std::string(image.values.size() * 2, '\0'));
  ASSERT_LT(level.size(), 20000u);
  expect_refusal([&] { read(with(with_level(plain, level), 44, std::uint32_t{2})); },
                 "bytes that expand to 69206016; allowed beyond 64 MiB: 256 times");
}

// 5 x 3, 2 x 1, 1 x 1.
std::vector<Image> mip_levels() {
  std::vector<Image> levels;
  for (const auto& [width, height] : {std::pair{5, 3}, std::pair{2, 1}, std::pair{1, 1}})
    levels.push_back(numbered_image(ImageShape::flat, Precision::half, 4,
                                    static_cast<std::size_t>(width),
                                    static_cast<std::size_t>(height)));
  return levels;
}

TEST(Ktx2, MipLevelsLieFromTheSmallestToTheLargest) {
  const std::vector<Image> levels = mip_levels();
  for (const bool zstd : {false, true}) {
    const std::string bytes = encode_ktx2(std::span(levels), zstd);
    EXPECT_EQ(field(bytes, 40), 3u);
    EXPECT_EQ(field(bytes, 48), 104u + 2 * 24) << "the descriptor follows the index";
    std::uint64_t end = bytes.size();
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const auto offset = field<std::uint64_t>(bytes, 80 + 24 * i),
                 length = field<std::uint64_t>(bytes, 88 + 24 * i);
      EXPECT_LE(offset + length, end);
      EXPECT_LT(end - offset - length, 8u);
      end = offset;
      const std::string values = encode_dds(levels[i]).substr(148);
      EXPECT_EQ(field<std::uint64_t>(bytes, 96 + 24 * i), values.size());
      std::string found = bytes.substr(offset, length);
      if (zstd) {
        std::string plain(values.size(), ' ');
        EXPECT_EQ(ZSTD_decompress(plain.data(), plain.size(), found.data(), found.size()),
                  values.size());
        found = plain;
      } else {
        EXPECT_EQ(offset % 8, 0u);
      }
      EXPECT_EQ(found, values);
    }
  }
  EXPECT_EQ(encode_ktx2(std::span(levels).first(1), true), encode_ktx2(levels[0], true));
  expect_refusal([&] { encode_ktx2(std::span<const Image>(), true); }, "without a mip level");
  std::vector<Image> wrong = levels;
  std::swap(wrong[1], wrong[2]);
  expect_refusal([&] { encode_ktx2(std::span(wrong), true); },
                 "mip level 1 is 1 x 1 texels of 4 channels; expected a flat one, 2 x 1 of 4");
}

// What ktx-parse, which npm puts into tests/node_modules, finds in the bytes.
nlohmann::json seen_by_ktx_parse(const test::TemporaryDirectory& folder, const std::string& bytes) {
  const auto path = folder.write("x.ktx2", bytes);
  const auto seen =
      testing::run("node " LTCFIT_SOURCE_DIR "/tests/export/ktx_parse.mjs " + path.string());
  return nlohmann::json::parse(seen.output, nullptr, false);
}

std::string hex(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes)
    text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

TEST(Ktx2, KtxParseFindsSizeFormatAndValues) {
  if (!std::filesystem::exists(LTCFIT_SOURCE_DIR "/tests/node_modules/ktx-parse") ||
      testing::run("node --version").exit_code != 0)
    GTEST_SKIP() << "no node, or no ktx-parse for it: npm ci --prefix tests";
  const test::TemporaryDirectory folder;
  for (const ImageShape shape : testing::all_shapes)
    for (const Precision precision : testing::all_precisions)
      for (const bool zstd : {false, true}) {
        const Image image = numbered_image(shape, precision);
        const std::string bytes = encode_ktx2(image, zstd);
        const bool half = precision == Precision::half;
        const auto found = seen_by_ktx_parse(folder, bytes);
        ASSERT_TRUE(found.is_object()) << found;
        EXPECT_EQ(found["vkFormat"], half ? 97 : 109);
        EXPECT_EQ(found["typeSize"], half ? 2 : 4);
        EXPECT_EQ(found["pixelWidth"], 5);
        EXPECT_EQ(found["pixelHeight"], 3);
        EXPECT_EQ(found["pixelDepth"], shape == ImageShape::volume ? 2 : 0);
        EXPECT_EQ(found["layerCount"], shape == ImageShape::array ? 2 : 0);
        EXPECT_EQ(found["faceCount"], 1);
        EXPECT_EQ(found["supercompressionScheme"], zstd ? 2 : 0);
        EXPECT_EQ(found["keyValue"]["KTXwriter"], "ltcfit " + std::string(version()));
        const auto& description = found["dataFormatDescriptor"][0];
        EXPECT_EQ(description["bytesPlane"][0], half ? 8 : 16);
        ASSERT_EQ(description["samples"].size(), 4u);
        EXPECT_EQ(description["samples"][3]["bitOffset"], half ? 48 : 96);
        EXPECT_EQ(description["samples"][3]["bitLength"], half ? 15 : 31);
        EXPECT_EQ(description["samples"][3]["channelType"], 0xcf);
        // The values as DDS has them, which other readers see.
        const std::string values = encode_dds(image).substr(148);
        ASSERT_EQ(found["levels"].size(), 1u);
        EXPECT_EQ(found["levels"][0]["uncompressedByteLength"], values.size());
        EXPECT_EQ(found["levels"][0]["levelData"],
                  hex(zstd ? bytes.substr(field<std::uint64_t>(bytes, 80)) : values));
      }
  const std::vector<Image> levels = mip_levels();
  for (const bool zstd : {false, true}) {
    const std::string bytes = encode_ktx2(std::span(levels), zstd);
    const auto found = seen_by_ktx_parse(folder, bytes);
    ASSERT_TRUE(found.is_object()) << found;
    EXPECT_EQ(found["pixelWidth"], 5);
    ASSERT_EQ(found["levels"].size(), levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const std::string values = encode_dds(levels[i]).substr(148);
      EXPECT_EQ(found["levels"][i]["uncompressedByteLength"], values.size());
      if (!zstd) {
        EXPECT_EQ(found["levels"][i]["levelData"], hex(values)) << i;
      }
    }
  }
  // And it can fail.
  EXPECT_FALSE(seen_by_ktx_parse(folder, "\xABKTX 11").is_object());
}

}  // namespace
}  // namespace ltc
