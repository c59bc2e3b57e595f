// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/queries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ltc {
namespace {

TEST(Queries, StandWhereTheUniformNumbersSay) {
  const QueryRange range{0.2, 0.6, 0.5, 1.0, 0.0, 0.5, 0.1, 0.3};
  const Lobe lobe = query_lobe(range, {0.5, 0.5, 0.5, 0.5}, 1e-4);
  EXPECT_DOUBLE_EQ(lobe.alpha_x, 0.16);
  EXPECT_DOUBLE_EQ(lobe.alpha_y, 0.12);
  EXPECT_DOUBLE_EQ(lobe.theta_radians, std::acos(0.25));
  EXPECT_DOUBLE_EQ(lobe.phi_radians, 0.2);
}

TEST(Queries, AreNeverSmootherThanAlphaMin) {
  const Lobe lobe = query_lobe({}, {0, 0, 0.5, 0.5}, 0.05);
  EXPECT_EQ(lobe.alpha_x, 0.05);
  EXPECT_EQ(lobe.alpha_y, 0.05);
}

// Means of the four uniform quantities and the mean of their squares.
std::array<double, 8> moments(const std::vector<Lobe>& queries) {
  std::array<double, 8> sums{};
  for (const Lobe& lobe : queries) {
    const double values[] = {(std::sqrt(lobe.alpha_x) - 0.1) / 0.9, lobe.alpha_y / lobe.alpha_x,
                             std::cos(lobe.theta_radians),
                             lobe.phi_radians / (std::numbers::pi / 2)};
    for (int i = 0; i < 4; ++i) {
      sums[i] += values[i] / static_cast<double>(queries.size());
      sums[4 + i] += values[i] * values[i] / static_cast<double>(queries.size());
    }
  }
  return sums;
}

TEST(Queries, AreUniform) {
  // 4096 independent ones: standard errors 0.0045 and 0.0047; 5 of them for eight checks.
  // Lattice: the discrepancy of 4096 points of the sequence stays well below 0.004.
  const auto check = [](const std::vector<Lobe>& queries, double tolerance) {
    const auto sums = moments(queries);
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(sums[i], 0.5, tolerance);
      EXPECT_NEAR(sums[4 + i], 1.0 / 3, tolerance);
    }
  };
  // A smallest roughness of 1e-6 keeps lambda free of alpha_min.
  check(random_queries({}, 4096, 7, 1e-6), 0.023);
  check(lattice_queries({}, 0, 4096, 1e-6), 0.004);
}

TEST(Queries, AreTheSameForTheSameSeedAndGoOnWhereTheSequenceStopped) {
  EXPECT_EQ(random_queries({}, 3, 5, 1e-4)[2].alpha_x, random_queries({}, 3, 5, 1e-4)[2].alpha_x);
  EXPECT_NE(random_queries({}, 3, 5, 1e-4)[2].alpha_x, random_queries({}, 3, 6, 1e-4)[2].alpha_x);
  EXPECT_EQ(lattice_queries({}, 0, 8, 1e-4)[6].alpha_x, lattice_queries({}, 4, 4, 1e-4)[2].alpha_x);
}

}  // namespace
}  // namespace ltc
