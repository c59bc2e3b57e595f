// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// examples/opengl draws what `ltcfit render` computes.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "support/program.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

constexpr int side = 256;

void expect_success(const ProgramResult& result) {
  ASSERT_EQ(result.exit_code, 0) << result.err;
}

std::vector<float> channel_of(const std::filesystem::path& file, const std::string& channel) {
  Imf::InputFile input(file.c_str());
  std::vector<float> values(std::size_t{side} * side);
  Imf::FrameBuffer buffer;
  buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                    sizeof(float), sizeof(float) * side));
  input.setFrameBuffer(buffer);
  input.readPixels(0, side - 1);
  return values;
}

class OpenGlExample : public ::testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult configured =
        run_program({"cmake", "-S", LTCFIT_SOURCE_DIR "/examples/opengl", "-B", folder / "b"});
    if (configured.exit_code != 0)
      GTEST_SKIP() << "no EGL: libegl-dev, libgles-dev";
    expect_success(run_program({"cmake", "--build", folder / "b"}));
    expect_success(run_ltcfit({"generate", "-o", "t", "--set", "refine.steps=0"}, folder.path()));
    expect_success(
        run_ltcfit({"convert", "t/ltc.h5", "-o", "t.dds", "--as", "stacked"}, folder.path()));
    expect_success(run_ltcfit({"convert", "t/ltc.h5", "-o", "t.glsl"}, folder.path()));
  }

  ProgramResult draw(const std::string& texture, const std::vector<std::string>& more) {
    std::vector<std::string> command = {folder / "b/ltcfit_opengl", texture, "t.glsl",
                                        LTCFIT_SOURCE_DIR "/shaders/glsl", "spheres.png"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program(command, folder.path());
  }

  const TemporaryDirectory folder;
};

TEST_F(OpenGlExample, DrawsWhatRenderComputes) {
  const ProgramResult drawn = draw("t.dds", {"--raw", "spheres.raw"});
  if (drawn.err.find("no EGL") != std::string::npos)
    GTEST_SKIP() << drawn.err;
  expect_success(drawn);
  const std::string bytes = read_file(folder / "spheres.raw");
  ASSERT_EQ(bytes.size(), std::size_t{16} * side * side * 4);
  std::vector<float> raw(bytes.size() / 4);
  std::memcpy(raw.data(), bytes.data(), bytes.size());
  expect_success(run_ltcfit({"render", "t/ltc.h5", "--size", "256", "--samples", "16", "-o", "r"},
                            folder.path()));
  const char* const materials[] = {"0.05_0.25", "0.5_0.02", "0.5_0.25", "0.5_1"};
  for (std::size_t sphere = 0; sphere < 4; ++sphere) {
    SCOPED_TRACE(materials[sphere]);
    const std::vector<float> ltc =
        channel_of(folder / ("r/spheres_" + std::string(materials[sphere]) + ".exr"), "ltc.Y");
    float largest = 0, off = 0;
    for (std::size_t row = 0; row < side; ++row)
      for (std::size_t column = 0; column < side; ++column) {
        // render's first row is the highest.
        const float expected = ltc[(side - 1 - row) * side + column];
        const float found = raw[4 * (row * 4 * side + sphere * side + column)];
        largest = std::max(largest, expected);
        off = std::max(off, std::abs(found - expected));
      }
    EXPECT_GT(largest, 0.1f);
    // Single precision; at the outline a pixel's points may fall on either side of it.
    EXPECT_LT(off, 1e-3f);
  }
  EXPECT_EQ(read_file(folder / "spheres.png").substr(1, 3), "PNG");
}

TEST_F(OpenGlExample, WhatItCannotDrawIsRefused) {
  folder.write("bad.dds", "DDS and no more");
  const ProgramResult result = draw("bad.dds", {});
  if (result.err.find("no EGL") != std::string::npos)
    GTEST_SKIP() << result.err;
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("bad.dds is no DDS"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ltc::test
