// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Identities of the distance. Tolerances of 1e-14: a few hundred additions of numbers of the order
// of one, each rounded to 1e-16.
#include "fit/sliced_wasserstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "fit/sample_sets.h"
#include "statistics.h"

namespace ltc {
namespace {

constexpr double kRounding = 1e-14;

PointSet random_set(std::size_t count, std::uint64_t seed, bool weighted) {
  test::Uniform uniform(seed);
  PointSet set;
  for (std::size_t i = 0; i < count; ++i) {
    set.points.emplace_back(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
    if (weighted)
      set.weights.push_back(uniform());
  }
  return set;
}

const std::vector<Eigen::Vector3d> kDirections = fibonacci_directions(12);

TEST(SlicedWasserstein, EqualSetsAreAtDistanceZeroInAnyOrder) {
  const PointSet set = random_set(50, 1, true);
  PointSet reversed;
  reversed.points.assign(set.points.rbegin(), set.points.rend());
  reversed.weights.assign(set.weights.rbegin(), set.weights.rend());
  EXPECT_LT(sliced_wasserstein(set, reversed, kDirections), kRounding);
  // One point moved a little is seen.
  reversed.points[7].x() += 1e-3;
  EXPECT_GT(sliced_wasserstein(set, reversed, kDirections), 1e-6);
}

TEST(SlicedWasserstein, ATranslationMovesByItsProjection) {
  const Eigen::Vector3d shift(0.3, -0.7, 0.2);
  for (const bool weighted : {false, true}) {
    const PointSet set = random_set(40, 2, weighted);
    PointSet moved = set;
    for (auto& point : moved.points)
      point += shift;
    for (const Eigen::Vector3d& d : kDirections)
      EXPECT_NEAR(sliced_wasserstein(set, moved, {d}), std::abs(d.dot(shift)), kRounding);
  }
}

TEST(SlicedWasserstein, IsExactInOneDimensionForDifferentSizes) {
  // Mass 1/2 at 0 and 1/2 at 1 against thirds at 0, 0.5 and 2: the quantile functions differ by 0
  // on [0, 1/3], 0.5 on [1/3, 1/2], 0.5 on [1/2, 2/3] and 1 on [2/3, 1].
  const PointSet f{{{0, 0, 0}, {1, 0, 0}}, {}};
  const PointSet g{{{2, 0, 0}, {0, 0, 0}, {0.5, 0, 0}}, {}};
  EXPECT_NEAR(sliced_wasserstein(f, g, {{1, 0, 0}}), 0.5 / 6 + 0.5 / 6 + 1.0 / 3, kRounding);
}

TEST(SlicedWasserstein, IsSymmetric) {
  const PointSet f = random_set(30, 3, true), g = random_set(47, 4, false);
  EXPECT_NEAR(sliced_wasserstein(f, g, kDirections), sliced_wasserstein(g, f, kDirections),
              kRounding);
}

TEST(SlicedWasserstein, AWeightCountsAsThatManyPoints) {
  PointSet weighted = random_set(20, 5, false), repeated;
  for (std::size_t i = 0; i < weighted.points.size(); ++i) {
    const std::size_t times = i % 4;  // zero among them
    weighted.weights.push_back(0.7 * static_cast<double>(times));
    repeated.points.insert(repeated.points.end(), times, weighted.points[i]);
  }
  const PointSet other = random_set(31, 6, true);
  EXPECT_LT(sliced_wasserstein(weighted, repeated, kDirections), kRounding);
  EXPECT_NEAR(sliced_wasserstein(weighted, other, kDirections),
              sliced_wasserstein(repeated, other, kDirections), kRounding);
  // Ignoring the weights would not pass.
  EXPECT_GT(sliced_wasserstein({weighted.points, {}}, repeated, kDirections), 1e-3);
}

TEST(SlicedWasserstein, ObeysTheTriangleInequality) {
  for (std::uint64_t seed = 10; seed < 40; ++seed) {
    const PointSet a = random_set(1 + seed % 7, seed, true);
    const PointSet b = random_set(1 + seed % 11, seed + 100, false);
    const PointSet c = random_set(1 + seed % 13, seed + 200, true);
    EXPECT_LE(
        sliced_wasserstein(a, c, kDirections),
        sliced_wasserstein(a, b, kDirections) + sliced_wasserstein(b, c, kDirections) + kRounding);
  }
}

TEST(SlicedWasserstein, RefusesSetsThatAreNone) {
  const PointSet good = random_set(3, 7, false);
  PointSet infinite = good;
  infinite.points[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sliced_wasserstein(good, {}, kDirections), InputError);
  EXPECT_THROW(sliced_wasserstein(good, infinite, kDirections), InputError);
  EXPECT_THROW(sliced_wasserstein(good, {good.points, {1, 1}}, kDirections), InputError);
  EXPECT_THROW(sliced_wasserstein(good, {good.points, {1, -1, 1}}, kDirections), InputError);
  EXPECT_THROW(sliced_wasserstein(good, {good.points, {0, 0, 0}}, kDirections), InputError);
  EXPECT_THROW(sliced_wasserstein(good, good, {}), InputError);
}

TEST(SlicedWassersteinLoss, IsTheDistanceOfTheTransformedSamples) {
  test::Uniform uniform(8);
  std::vector<Eigen::Vector3d> omega_o;
  for (int i = 0; i < 40; ++i) {
    const double r = std::sqrt(uniform()), azimuth = 6.283185307179586 * uniform();
    omega_o.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - r * r));
  }
  Eigen::Matrix3d m;
  m << 0.6, 0.1, -0.4, 0.05, 0.3, -0.2, 0.3, 0.1, 0.9;
  const PointSet target = random_set(55, 9, true);
  PointSet transformed;
  for (const Eigen::Vector3d& omega : omega_o)
    transformed.points.push_back((m * omega).normalized());
  const SlicedWassersteinLoss loss(omega_o, target, kDirections);
  EXPECT_NEAR(loss(m).loss, sliced_wasserstein(transformed, target, kDirections), kRounding);
  // Scaling M moves nothing: neither the loss nor, to first order, anything along M.
  EXPECT_NEAR(loss(3 * m).loss, loss(m).loss, kRounding);
  EXPECT_NEAR((loss(m).gradient.array() * m.array()).sum(), 0, kRounding);
  EXPECT_TRUE(std::isnan(loss(Eigen::Matrix3d::Zero()).loss));
  EXPECT_TRUE(std::isnan(loss(m * std::numeric_limits<double>::infinity()).loss));
}

}  // namespace
}  // namespace ltc
