// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Lines against quadrature and against the thin rectangles that they are the limit of.
#include "ltc/line.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"

namespace ltc {
namespace {

using Eigen::Vector3d;

// 2 R/pi integral of max(z, 0) sin(angle)/|p|^3 dl by the midpoint rule.
double by_quadrature(const Line& line) {
  constexpr int steps = 200000;
  const Vector3d step = (line.to - line.from) / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const Vector3d p = line.from + (i + 0.5) * step;
    const double squared = p.squaredNorm();
    sum += std::max(p.z(), 0.0) * p.cross(step).norm() / (squared * squared);
  }
  return 2 * line.radius / std::numbers::pi * sum;
}

// The rectangle that a line stands for.
std::vector<Vector3d> strip(const Line& line) {
  const Vector3d aside = line.radius * line.from.cross(line.to).normalized();
  return {line.from - aside, line.to - aside, line.to + aside, line.from + aside};
}

Line random_line(Random& random) {
  return {random.direction() * (0.5 + random.uniform()),
          random.direction() * (0.5 + random.uniform()), 1e-4};
}

TEST(LineLight, IsItsQuadrature) {
  Random random(3);
  int cut = 0;
  for (int i = 0; i < 40; ++i) {
    Line line = random_line(random);
    line.radius = 0.02;
    // Steps of 1e-5 at distances down to some 1e-1: 1e-8, and as much at the cut.
    EXPECT_NEAR(clamped_cosine_share(line), by_quadrature(line), 2e-8) << i;
    cut += line.from.z() * line.to.z() < 0;
  }
  EXPECT_GT(cut, 10);
}

// Their difference is of second order in the width: at 1e-4 some 1e-8 of the share, at 1e-2 it must
// show.
TEST(LineLight, IsTheLimitOfRectanglesUnderEveryTransform) {
  Random random(5);
  double largest = 0;
  for (int i = 0; i < 60; ++i) {
    Line line = random_line(random);
    if (line.from.cross(line.to).norm() < 0.2)
      continue;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        matrix(row, column) += 0.5 * (2 * random.uniform() - 1);
    matrix.col(i % 3) *= i % 2 ? -0.3 : 0.3;
    if (std::abs(matrix.determinant()) < 1e-2)
      continue;
    const LinearlyTransformed cosine(matrix);
    const auto exact = [&] {
      return std::abs(cosine.integrate_polygon(clip_to_upper_hemisphere(strip(line))));
    };
    const double share = exact();
    EXPECT_NEAR(ltc_share(matrix, line), share, 1e-5 * share + 1e-9) << i;
    line.radius = 1e-2;
    largest = std::max(largest, std::abs(ltc_share(matrix, line) - exact()));
  }
  EXPECT_GT(largest, 1e-5);
}

TEST(LineLight, OverheadIsTheClosedForm) {
  // An endless line at height 1: R/pi pi/d^2 d.
  EXPECT_NEAR(clamped_cosine_share(Line{{-1e8, 0, 1}, {1e8, 0, 1}, 0.01}), 0.01, 1e-15);
  EXPECT_NEAR(clamped_cosine_share(Line{{-1e8, 0, 2}, {1e8, 0, 2}, 0.01}), 0.005, 1e-15);
  // Upwards from the horizon at distance 1: R/pi.
  EXPECT_NEAR(clamped_cosine_share(Line{{1, 0, 0}, {1, 0, 1e9}, 0.01}), 0.01 / std::numbers::pi,
              1e-15);
}

TEST(LineLight, ThatIsNotSeenHasNoShare) {
  EXPECT_EQ(clamped_cosine_share(Line{{1, 0, -1}, {0, 1, -0.1}, 0.1}), 0);
  EXPECT_EQ(clamped_cosine_share(Line{{0, 0, 1}, {0, 0, 2}, 0.1}), 0);
  EXPECT_EQ(clamped_cosine_share(Line{{1, 0, 1}, {1, 0, 1}, 0.1}), 0);
  EXPECT_EQ(ltc_share(Eigen::Matrix3d::Identity(), Line{{0, 0, 1}, {0, 0, 2}, 0.1}), 0);
  EXPECT_EQ(ltc_share(Eigen::Matrix3d::Identity(), Line{{1, 0, -1}, {0, 1, -2}, 0.1}), 0);
}

TEST(LineLight, RefusesWhatHasNoMeaning) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(clamped_cosine_share(Line{{nan, 0, 1}, {1, 0, 1}, 0.1}), InputError);
  for (const double radius : {0.0, -1.0, nan})
    EXPECT_THROW(clamped_cosine_share(Line{{0, 0, 1}, {1, 0, 1}, radius}), InputError);
  EXPECT_THROW(ltc_share(Eigen::Matrix3d::Zero(), Line{{0, 0, 1}, {1, 0, 1}, 0.1}), InputError);
}

}  // namespace
}  // namespace ltc
