// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The transformed distributions against the printed results of the supplemental of Heitz et al.
// 2016, and their sampler against their density.
#include "ltc/ltsd.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "ltc/sphere_chi_squared.h"

namespace ltc {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr Original kOriginals[] = {Original::uniform_sphere, Original::uniform_hemisphere,
                                   Original::clamped_cosine, Original::squared_clamped_cosine};

Eigen::Matrix3d printed_matrix() {
  Eigen::Matrix3d matrix;
  matrix << 0.1, 0.5, 1, 0.2, 1, 1, 0, 2, 0.5;
  return matrix;
}

std::vector<Eigen::Vector3d> printed_triangle() {
  return {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}};
}

Eigen::Vector3d direction(double theta, double azimuth) {
  return {std::cos(azimuth) * std::sin(theta), std::sin(azimuth) * std::sin(theta),
          std::cos(theta)};
}

// Zeroth and first moments of a density by the rule of the supplemental: theta from 0 to pi and the
// azimuth from 0 to 2 pi in steps of 0.01, each step with full weight.
struct Moments {
  double mass = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
};

Moments moments_by_printed_rule(const LinearlyTransformed& distribution) {
  Moments moments;
  const double step = 0.01;
  for (int i = 0; i * step <= kPi; ++i)
    for (int j = 0; j * step <= 2 * kPi; ++j) {
      const Eigen::Vector3d omega = direction(i * step, j * step);
      const double weight = step * step * std::sin(i * step) * distribution.density(omega);
      moments.mass += weight;
      moments.mean += weight * omega;
    }
  return moments;
}

// Midpoint rule in cos(theta) and azimuth.
Moments moments(const LinearlyTransformed& distribution) {
  Moments moments;
  const int heights = 1000, azimuths = 2000;
  for (int i = 0; i < heights; ++i)
    for (int j = 0; j < azimuths; ++j) {
      const Eigen::Vector3d omega =
          direction(std::acos(1 - 2 * (i + 0.5) / heights), 2 * kPi * (j + 0.5) / azimuths);
      const double weight = 4 * kPi / (heights * azimuths) * distribution.density(omega);
      moments.mass += weight;
      moments.mean += weight * omega;
    }
  return moments;
}

TEST(LinearlyTransformed, IntegratesToOne) {
  for (const Original original : kOriginals) {
    // The uniform hemisphere's edge is a jump, which the rule resolves to about its step.
    const double tolerance = original == Original::uniform_hemisphere ? 1e-3 : 1e-5;
    EXPECT_NEAR(moments(LinearlyTransformed(printed_matrix(), original)).mass, 1, tolerance);
  }
}

TEST(LinearlyTransformed, ReproducesThePrintedNormalisation) {
  const double printed[] = {1.0003, 1.0019, 1.0006, 1.0006};
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(moments_by_printed_rule(LinearlyTransformed(printed_matrix(), kOriginals[i])).mass,
                printed[i], 0.5e-4 + 1e-9);  // the printed digits
}

TEST(LinearlyTransformed, ReproducesThePrintedMoments) {
  const LinearlyTransformed distribution(printed_matrix(), Original::squared_clamped_cosine);
  const Eigen::Vector3d printed(0.54400, 0.49160, 0.10410);
  const Eigen::Vector3d by_printed_rule = moments_by_printed_rule(distribution).mean;
  const Eigen::Vector3d exact = moments(distribution).mean;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(by_printed_rule[axis], printed[axis], 0.5e-5 + 1e-9);  // the printed digits
    EXPECT_NEAR(exact[axis], printed[axis], 1e-3);  // the printed rule's own error, 6e-4
  }
}

// The rule of the supplemental: points of the triangle over a square of (1/step + 1)^2, each with
// the weight step^2 times the area.
double polygon_by_printed_rule(const LinearlyTransformed& distribution,
                               const std::vector<Eigen::Vector3d>& p, int steps) {
  const Eigen::Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]) / 2;
  double sum = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const double larger = static_cast<double>(std::max(i, j)) / steps;
      const double smaller = static_cast<double>(std::min(i, j)) / steps;
      const Eigen::Vector3d point =
          (1 - larger) * p[0] + (larger - smaller) * p[1] + smaller * p[2];
      const double distance = point.norm();
      sum += distribution.density(point / distance) * std::abs(point.dot(area)) /
             (distance * distance * distance);
    }
  return sum / (static_cast<double>(steps) * steps);
}

TEST(LinearlyTransformed, ReproducesThePrintedPolygon) {
  const LinearlyTransformed distribution(printed_matrix());
  const auto triangle = printed_triangle();
  EXPECT_NEAR(polygon_by_printed_rule(distribution, triangle, 400), 0.0059141, 0.5e-7);
  // The printed rule counts the square's border in full, an error of the order of its step: the
  // printed number is 0.4 % above the integral, and the rule approaches ours as its step shrinks.
  const double exact = std::abs(distribution.integrate_polygon(triangle));
  EXPECT_NEAR(exact, 0.0059141, 0.005 * exact);
  const double coarse = polygon_by_printed_rule(distribution, triangle, 400);
  const double fine = polygon_by_printed_rule(distribution, triangle, 800);
  // The first-order error extrapolated away; the second-order one is 6e-5.
  EXPECT_NEAR(2 * fine - coarse, exact, 1e-4 * exact);
}

// The density over the triangle, summed at the centres of its n^2 equal parts.
double integrate_numerically(const LinearlyTransformed& distribution,
                             const std::vector<Eigen::Vector3d>& triangle, int n) {
  const Eigen::Vector3d u = (triangle[1] - triangle[0]) / n, v = (triangle[2] - triangle[0]) / n;
  const Eigen::Vector3d area = u.cross(v) / 2;
  double sum = 0;
  auto add = [&](double i, double j) {
    const Eigen::Vector3d p = triangle[0] + i * u + j * v;
    const double distance = p.norm();
    sum += distribution.density(p / distance) * p.dot(area) / (distance * distance * distance);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add(i + 1.0 / 3, j + 1.0 / 3);
      if (i + j + 1 < n)
        add(i + 2.0 / 3, j + 2.0 / 3);
    }
  return sum;
}

TEST(LinearlyTransformed, PolygonIntegralsEqualNumericalOnes) {
  // Triangles overhead, across the transformed horizon, and behind.
  const std::vector<std::vector<Eigen::Vector3d>> triangles = {
      printed_triangle(),
      {{2, 1, -1}, {1, 3, 2}, {-1, 0.5, 1}},
      {{1, 1, 0.3}, {0.8, 1.2, 0.3}, {0.9, 1, 1.1}},
      {{-1, -1, -0.5}, {-2, 1, -1}, {1, -1, -1}}};
  Eigen::Matrix3d mirrored = printed_matrix();
  mirrored.col(0) *= -1;
  for (const Eigen::Matrix3d& matrix : {printed_matrix(), mirrored})
    for (const Original original : kOriginals)
      for (const auto& triangle : triangles) {
        const LinearlyTransformed distribution(matrix, original);
        // The numerical rule's error: of first order in its step at the hemisphere's jump. The sign
        // is that of the winding.
        const double tolerance = original == Original::uniform_hemisphere ? 2e-3 : 1e-4;
        EXPECT_NEAR(distribution.integrate_polygon(triangle),
                    integrate_numerically(distribution, triangle, 300), tolerance);
      }
}

TEST(LinearlyTransformed, TheScaleOfTheMatrixIsNothing) {
  const LinearlyTransformed one(printed_matrix()), other(1e-3 * printed_matrix());
  const Eigen::Vector3d omega = Eigen::Vector3d(1, 1, 0.3).normalized();
  EXPECT_NEAR(one.density(omega), other.density(omega), 1e-12 * one.density(omega));
}

TEST(ShareBelowHorizon, IsWhatThePolygonOfTheHorizonLeavesOut) {
  // Four octants: the horizon as one polygon would not say on which side it lies.
  const std::vector<Eigen::Vector3d> horizon = {
      {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}};
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d matrix =
        Eigen::Matrix3d::NullaryExpr([&](auto, auto) { return 2 * random.uniform() - 1; });
    double above = 0;
    for (std::size_t k = 0; k < 4; ++k)
      above += LinearlyTransformed(matrix).integrate_polygon(
          std::vector<Eigen::Vector3d>{horizon[k], horizon[k + 1], {0, 0, 1}});
    // Rounding, times the condition of a random matrix.
    EXPECT_NEAR(share_below_horizon(matrix), 1 - above, 1e-9) << matrix;
  }
}

TEST(ShareBelowHorizon, KeepsTheDigitsOfSmallShares) {
  EXPECT_EQ(share_below_horizon(Eigen::Matrix3d::Identity()), 0);
  EXPECT_EQ(share_below_horizon(Eigen::Vector3d(1, 1, -1).asDiagonal()), 1);
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(2, 0) = 2e-9;  // tilts the half-space by as many radians
  EXPECT_NEAR(share_below_horizon(matrix), 1e-18, 1e-30);
  matrix.row(2) << 1, 0, 0;
  EXPECT_NEAR(share_below_horizon(matrix), 0.5, 1e-15);
}

TEST(LinearlyTransformed, RefusesAMatrixWithoutInverse) {
  EXPECT_THROW(LinearlyTransformed{Eigen::Matrix3d::Zero()}, InputError);
  EXPECT_THROW(LinearlyTransformed{Eigen::Matrix3d::Constant(std::nan(""))}, InputError);
}

test::ChiSquared sampler_against(const Eigen::Matrix3d& sampled, const Eigen::Matrix3d& expected,
                                 Original original) {
  return test::sampler_against(LinearlyTransformed(sampled, original),
                               LinearlyTransformed(expected, original));
}

TEST(LinearlyTransformedChiSquared, SamplerFollowsTheDensity) {
  Eigen::Matrix3d matrix;
  matrix << 0.6, 0.1, 0.5, -0.2, 0.9, 0.1, 0.1, 0, 0.8;
  Eigen::Matrix3d wrong = matrix;
  wrong(0, 0) *= 1.1;
  for (const Original original : kOriginals) {
    const test::ChiSquared right = sampler_against(matrix, matrix, original);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 50u);
    EXPECT_FALSE(sampler_against(matrix, wrong, original).accepted());
  }
}

}  // namespace
}  // namespace ltc
