// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit prefilter as a user runs it.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfTiledInputFile.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "render/image_exr.h"
#include "render/light_texture.h"
#include "render/png_writer.h"
#include "support/program.h"
#include "support/refusal.h"

namespace ltc::test {
namespace {

class Prefilter : public ::testing::Test {
 protected:
  Prefilter() { folder_.write("window.png", testing::window_png(32)); }

  ProgramResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"prefilter"});
    return run_ltcfit(arguments, folder_.path());
  }
  std::vector<Image> expected(std::size_t side) {
    return ltc::prefilter(read_light_image(folder_ / "window.png"), side, "", {1});
  }

  TemporaryDirectory folder_;
};

std::uint32_t field(const std::string& bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST_F(Prefilter, WritesKtx2WithAllLevels) {
  const ProgramResult result = run({"window.png", "-o", "window.ktx2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "wrote window.ktx2\n");
  const std::string bytes = read_file(folder_ / "window.ktx2");
  EXPECT_EQ(field(bytes, 12), 97u) << "R16G16B16A16_SFLOAT";
  EXPECT_EQ(field(bytes, 20), 512u);
  EXPECT_EQ(field(bytes, 24), 512u);
  EXPECT_EQ(field(bytes, 40), 10u);
  EXPECT_EQ(field(bytes, 44), 2u) << "Zstandard";
  EXPECT_EQ(run({"window.png", "-o", "plain.ktx2", "--size", "16", "--no-zstd"}).exit_code, 0);
  const std::string plain = read_file(folder_ / "plain.ktx2");
  EXPECT_EQ(field(plain, 44), 0u);
  EXPECT_EQ(field(plain, 40), 5u);
  EXPECT_EQ(
      run({"window.png", "-o", "again.ktx2", "--size", "16", "--no-zstd", "-t", "3"}).exit_code, 0);
  EXPECT_EQ(read_file(folder_ / "again.ktx2"), plain) << "the same bytes by any number of threads";
}

TEST_F(Prefilter, WritesMipmappedOpenExr) {
  EXPECT_EQ(run({"window.png", "-o", "window.exr", "--size", "128"}).exit_code, 0);
  const std::vector<Image> levels = expected(128);
  Imf::TiledInputFile file((folder_ / "window.exr").c_str());
  ASSERT_EQ(file.numLevels(), 8);
  EXPECT_EQ(file.levelMode(), Imf::MIPMAP_LEVELS);
  const char* const names[] = {"R", "G", "B", "A"};
  for (int level = 0; level < 8; ++level) {
    const Image& image = levels[static_cast<std::size_t>(level)];
    const std::size_t side = image.width;
    ASSERT_EQ(file.levelWidth(level), static_cast<int>(side));
    std::vector<float> values(4 * side * side);
    Imf::FrameBuffer buffer;
    for (std::size_t channel = 0; channel < 4; ++channel)
      buffer.insert(names[channel],
                    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + channel),
                               4 * sizeof(float), 4 * sizeof(float) * side));
    file.setFrameBuffer(buffer);
    file.readTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_NEAR(values[i], image.values[i], 0x1p-11) << "rounded to halves" << level << ' ' << i;
  }
}

TEST_F(Prefilter, RefusesBadInputInOneLineAndWritesNothing) {
  folder_.write("text.png", "no picture");
  folder_.write("cut.png", testing::window_png(32).substr(0, 60));
  picture::Field negative{2, 1, {1, -1}}, bright{1, 1, {1e6f}};
  const ImageLayer layers[] = {{"Y", &negative}};
  write_image_exr(layers, {}, folder_ / "negative.exr");
  const ImageLayer bright_layers[] = {{"Y", &bright}};
  write_image_exr(bright_layers, {}, folder_ / "bright.exr");
  const auto expect_refusal = [&](const std::vector<std::string>& arguments, int exit_code,
                                  const std::vector<std::string>& parts) {
    const std::vector<std::string> before = names_in(folder_.path());
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    const std::size_t begin = result.err.find("ltcfit: ");
    ASSERT_NE(begin, std::string::npos) << result.err;
    expect_one_line(result.err.substr(begin, result.err.size() - begin - 1), parts);
    EXPECT_EQ(names_in(folder_.path()), before);
  };
  expect_refusal({}, 2, {"IMAGE"});
  expect_refusal({"window.png"}, 2, {"--output"});
  expect_refusal({"none.png", "-o", "x.ktx2"}, 3, {"none.png"});
  expect_refusal({".", "-o", "x.ktx2"}, 3, {"."});
  expect_refusal({"text.png", "-o", "x.ktx2"}, 2, {"text.png", "no image"});
  expect_refusal({"cut.png", "-o", "x.ktx2"}, 2, {"cut.png", "damaged PNG"});
  expect_refusal({"negative.exr", "-o", "x.ktx2"}, 2, {"negative.exr", "-1", "column 1"});
  expect_refusal({"bright.exr", "-o", "x.ktx2"}, 2, {"1000000", "16 bits"});
  expect_refusal({"bright.exr", "-o", "x.exr"}, 2, {"1000000", "16 bits"});
  expect_refusal({"window.png", "-o", "x.png"}, 2, {"--output x.png", ".ktx2 or .exr"});
  expect_refusal({"negative.exr", "-o", "./negative.exr"}, 2, {"negative.exr", "same file"});
  expect_refusal({"window.png", "-o", "no/x.ktx2"}, 3, {"no folder no"});
  for (const char* size : {"0", "4", "100", "8192", "x", "-8"})
    expect_refusal({"window.png", "-o", "x.ktx2", "--size", size}, 2,
                   {"--size", size, "power of two in [8, 4096]"});
}

}  // namespace
}  // namespace ltc::test
