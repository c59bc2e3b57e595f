// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a driver is asked in a test of shaders/, and how each of them is asked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ltc::test::shaders {

// RGBA32F, linear filter between texels and levels, clamped to the edge.
struct Texture {
  std::string name;
  std::uint32_t width = 1, height = 1, depth = 0;  // 0: two-dimensional
  std::uint32_t levels = 1;                        // each half as wide as the one before
  std::vector<float> values = {};                  // level after level
};

constexpr std::size_t inputs = 4, outputs = 6;  // of a case, in vectors of four

// The functions of shaders/ and cases.glsl in a language, with what a table and a field are.
struct Job {
  std::string glsl, hlsl, wgsl;
  std::vector<float> input;  // 4 inputs a case
  std::vector<Texture> textures;  // in the order of ltc_case's parameters

  std::size_t count() const { return input.size() / (4 * inputs); }
};

// A machine lacks something; what() names it.
struct Missing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Each runs every case and returns 4 outputs a case. Throws Missing, or std::runtime_error with
// what compiler or driver have to say.
using Results = std::vector<float>;
enum class GlApi { gl, es };
Results run_gl(const Job& job, GlApi api);
enum class VulkanSource { glsl, hlsl };
Results run_vulkan(const Job& job, VulkanSource source);
Results run_webgpu(const Job& job);
Results run_webgl(const Job& job);

// The pattern for each texture, one after another: {0} its name, {1} its number, {2} 2 or 3, its
// dimensions.
std::string for_textures(const Job& job, std::string_view pattern);

// GLSL of a fragment that writes output `which` of the case at its pixel, `width` cases a row; what
// stands before "#version" and after is the caller's.
std::string fragment_of(const Job& job);
constexpr std::uint32_t row_width = 1024;

}  // namespace ltc::test::shaders
