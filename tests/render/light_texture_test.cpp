// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Prefiltered textures against sums over every pixel, and where they are fetched.
#include "render/light_texture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "support/refusal.h"

namespace ltc {
namespace {

LightImage noise(std::size_t width, std::size_t height) {
  LightImage image{width, height, std::vector<float>(4 * width * height)};
  Random random(17);
  for (float& value : image.rgba)
    value = static_cast<float>(random.uniform());
  return image;
}

LightImage plain(std::size_t width, std::size_t height, float value) {
  return {width, height, std::vector<float>(4 * width * height, value)};
}

// The definition, pixel by pixel.
double by_sum(const LightImage& image, double s, double t, double deviation, std::size_t channel) {
  const auto mass = [&](double at, std::size_t index, std::size_t count) {
    const auto below = [&](std::size_t edge) {
      const double position = static_cast<double>(edge) / static_cast<double>(count);
      return std::erf((position - at) / (std::sqrt(2.0) * deviation));
    };
    return below(index + 1) - below(index);
  };
  double sum = 0, total = 0;
  for (std::size_t row = 0; row < image.height; ++row)
    for (std::size_t column = 0; column < image.width; ++column) {
      const double weight = mass(s, column, image.width) * mass(t, row, image.height);
      sum += weight * image.texel(row, column)[channel];
      total += weight;
    }
  return sum / total;
}

TEST(LightTexture, IsTheMeanUnderTheGaussian) {
  const LightImage image = noise(50, 37);
  const std::vector<Image> levels = prefilter(image, 64, "prefilter", {2});
  ASSERT_EQ(levels.size(), 7u);
  Random random(3);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const Image& level = levels[k];
    const std::size_t side = 64 >> k;
    ASSERT_EQ(level.width, side);
    ASSERT_EQ(level.height, side);
    ASSERT_EQ(level.channels, 4u);
    for (int i = 0; i < 60; ++i) {
      const auto column = static_cast<std::size_t>(random.uniform() * static_cast<double>(side)),
                 row = static_cast<std::size_t>(random.uniform() * static_cast<double>(side));
      const double s = ((static_cast<double>(column) + 0.5) / static_cast<double>(side) - 0.125) /
                       0.75,
                   t = ((static_cast<double>(row) + 0.5) / static_cast<double>(side) - 0.125) /
                       0.75;
      const double outside = std::hypot(std::max({0.0, -s, s - 1}), std::max({0.0, -t, t - 1}));
      const double deviation = std::max(std::ldexp(1.0 / 64, static_cast<int>(k)), outside / 2);
      const std::size_t channel = static_cast<std::size_t>(i) % 4;
      // What the sums over coarse cells cost, 1e-4 or so of the range, half of what halves have.
      EXPECT_NEAR(level.values[4 * (row * side + column) + channel],
                  by_sum(image, s, t, deviation, channel), 5e-4)
          << k << ' ' << row << ' ' << column;
    }
  }
}

TEST(LightTexture, OfOneColorIsThatColor) {
  for (const LightImage& image : {plain(1, 1, 0.7f), plain(300, 2, 0.7f), plain(64, 64, 0.7f)})
    for (const Image& level : prefilter(image, 32, "prefilter", {1}))
      for (const float value : level.values)
        ASSERT_NEAR(value, 0.7f, 1e-6f);
}

// From texel to texel no more than the steps of a Gaussian's mean of black and white, margin
// included: 0.4 a deviation's worth, and a texel of level k is 4/3 deviations wide.
TEST(LightTexture, IsContinuousInTheMargin) {
  LightImage image = plain(64, 64, 0);
  for (std::size_t row = 0; row < 64; ++row)
    for (std::size_t column = 0; column < 32; ++column)
      for (std::size_t channel = 0; channel < 4; ++channel)
        image.rgba[4 * (64 * row + column) + channel] = 1;
  const std::vector<Image> levels = prefilter(image, 256, "prefilter", {1});
  const Image& level = levels[2];
  double largest = 0;
  for (std::size_t row = 1; row < level.height; ++row)
    for (std::size_t column = 1; column < level.width; ++column)
      for (const std::size_t other :
           {row * level.width + column - 1, (row - 1) * level.width + column})
        largest = std::max<double>(
            largest,
            std::abs(level.values[4 * (row * level.width + column)] - level.values[4 * other]));
  EXPECT_LT(largest, 0.4 * 4 / 3);
  EXPECT_GT(largest, 0.3) << "the edge is there";
}

TEST(LightTexture, HasTheSameBitsWithAnyNumberOfThreads) {
  const LightImage image = noise(20, 33);
  const std::vector<Image> one = prefilter(image, 32, "prefilter", {1});
  EXPECT_EQ(one, prefilter(image, 32, "prefilter", {3}));
}

TEST(LightTexture, IsFetchedAtTheProjection) {
  // Straight above a point of a rectangle: its coordinates, v downwards.
  const TextureFetch level = texture_fetch({-0.5, -0.3, 2}, {1, 0, 0}, {0, 0.6, 0});
  EXPECT_NEAR(level.s, 0.75, 1e-15);
  EXPECT_NEAR(level.t, 0.25, 1e-15);
  EXPECT_NEAR(level.standard_deviation, std::sqrt(4 / (2 * 4 * 0.6)), 1e-15);
  // Of a parallelogram, any: the foot is where the plane's normal through the origin meets it.
  const Eigen::Vector3d center(0.3, 0.4, 1.2), u(1, 0.5, -0.2), v(0.4, 0.9, 0.6);
  const TextureFetch fetch = texture_fetch(center, u, v);
  const Eigen::Vector3d foot = center + (2 * fetch.s - 1) * u + (1 - 2 * fetch.t) * v;
  EXPECT_LT(foot.cross(u.cross(v)).norm(), 1e-14);
  EXPECT_NEAR(fetch.standard_deviation, foot.norm() / std::sqrt(2 * 4 * u.cross(v).norm()), 1e-15);
  // No area: anything finite.
  EXPECT_EQ(texture_fetch(center, u, 2 * u).s, 0.5);
}

TEST(LightTexture, IsSampledTrilinearly) {
  const std::vector<Image> levels = prefilter(noise(16, 16), 16, "prefilter", {1});
  // At a texel's centre and a level's deviation: that texel.
  const auto at = [&](double column, double row, double deviation) {
    return fetched(levels, {((column + 0.5) / 16 - 0.125) / 0.75, ((row + 0.5) / 16 - 0.125) / 0.75,
                            deviation});
  };
  const auto texel = [&](std::size_t column, std::size_t row) {
    return levels[0].values[4 * (16 * row + column)];
  };
  EXPECT_NEAR(at(5, 9, 1.0 / 16)[0], texel(5, 9), 1e-6);
  EXPECT_NEAR(at(5, 9, 0)[0], texel(5, 9), 1e-6);
  EXPECT_NEAR(at(5.5, 9, 1.0 / 16)[0], (texel(5, 9) + texel(6, 9)) / 2, 1e-6);
  EXPECT_NEAR(at(-50, 99, 0)[0], texel(0, 15), 1e-6) << "clamped to the edge";
  EXPECT_NEAR(at(5, 9, 100)[2], levels.back().values[2], 1e-6);
  const double between = std::sqrt(2.0) / 16;
  EXPECT_NEAR(at(5, 9, between)[0], (at(5, 9, 1.0 / 16)[0] + at(5, 9, 2.0 / 16)[0]) / 2, 1e-6);
}

TEST(LightTexture, EmitsWhatTheImageHasThere) {
  LightImage image = plain(2, 2, 0);
  for (std::size_t channel = 0; channel < 3; ++channel)
    image.rgba[4 + channel] = 1;  // top right
  const LightTexture texture(image);
  EXPECT_NEAR(texture.emitted({0.5, 0.5}), 1, 1e-7);
  EXPECT_EQ(texture.emitted({-0.5, 0.5}), 0);
  EXPECT_EQ(texture.emitted({0.5, -0.5}), 0);
  // Sharply and far to the top right.
  EXPECT_GT(texture.fetched({-0.9, -0.9, 0.01}, {1, 0, 0}, {0, 1, 0}), 0.99);
  EXPECT_LT(texture.fetched({-0.9, 0.9, 0.01}, {1, 0, 0}, {0, 1, 0}), 0.01);
  // From far away the mean.
  EXPECT_NEAR(texture.fetched({0, 0, 100}, {1, 0, 0}, {0, 1, 0}), 0.25, 0.01);
}

TEST(LightTexture, RefusesWhatCannotBeFiltered) {
  for (const std::size_t side : {0, 4, 100, 8192})
    test::expect_one_line(
        test::message_of<InputError>([&] { prefilter(plain(2, 2, 1), side, "", {1}); }),
        {std::to_string(side), "power of two in [8, 4096]"});
  EXPECT_THROW(prefilter({}, 8, "", {1}), InputError);
  EXPECT_THROW(prefilter({2, 2, {1, 1, 1}}, 8, "", {1}), InputError);
  EXPECT_EQ(usual_light_texture_side(plain(3, 3, 1)), 512u);
  EXPECT_EQ(usual_light_texture_side(plain(3, 513, 1)), 1024u);
  EXPECT_EQ(usual_light_texture_side(plain(1024, 1, 1)), 1024u);
}

}  // namespace
}  // namespace ltc
