// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Ellipses against closed cases, against polygons of many corners, and where formulas break.
#include "ltc/disk.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
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

constexpr double kPi = std::numbers::pi;
using Eigen::Vector3d;

Ellipse level_disk(double radius, double height) {
  return {{0, 0, height}, {radius, 0, 0}, {0, radius, 0}};
}

// A polygon of the ellipse's area: its error falls with the fourth power of the edges where nothing
// is cut off, and with the second where a cut meets the rim.
std::vector<Vector3d> polygon_of(const Ellipse& e, int corners) {
  std::vector<Vector3d> polygon;
  const double step = 2 * kPi / corners, factor = std::sqrt(step / std::sin(step));
  for (int i = 0; i < corners; ++i)
    polygon.push_back(e.center +
                      factor * (std::cos(i * step) * e.half_u + std::sin(i * step) * e.half_v));
  return polygon;
}
// (2 pi/20000)^2 is 1e-7, and of the rim only the two ends at a cut have it as their error.
constexpr int kCorners = 20000;
constexpr double kPolygonError = 2e-8;

double polygon_share(const Ellipse& e) {
  return std::abs(polygon_cosine_integral(clip_to_upper_hemisphere(polygon_of(e, kCorners)))) / kPi;
}

Ellipse random_ellipse(Random& random) {
  const auto vector = [&](double length) { return (length * random.direction()).eval(); };
  return {vector(1), vector(0.1 + random.uniform()), vector(0.1 + 2 * random.uniform())};
}

TEST(Ellipse, OfACircleOverheadIsTheClosedForm) {
  for (const double radius : {1e-6, 0.01, 0.5, 1.0, 30.0, 1e6}) {
    const double expected = radius * radius / (1 + radius * radius);
    EXPECT_NEAR(clamped_cosine_share(level_disk(radius, 1)), expected, 1e-15 * expected);
    EXPECT_NEAR(clamped_cosine_share(level_disk(2 * radius, 2)), expected, 1e-15 * expected);
  }
}

// A level disk beside the point: E = (1 - (1 + h^2 - r^2)/sqrt((1 + h^2 + r^2)^2 - 4 r^2))/2 with
// lengths in units of the distance to its axis (configuration factor C-40 or so).
TEST(Ellipse, OfALevelCircleAsideIsTheClosedForm) {
  for (const double radius : {0.2, 0.9, 1.5, 8.0})
    for (const double height : {0.05, 0.7, 3.0}) {
      const Ellipse disk{{1, 0, height}, {0, radius, 0}, {radius, 0, 0}};
      const double sum = 1 + height * height + radius * radius;
      const double expected = 0.5 * (1 - (1 + height * height - radius * radius) /
                                             std::sqrt(sum * sum - 4 * radius * radius));
      EXPECT_NEAR(clamped_cosine_share(disk), expected, 1e-14);
    }
}

TEST(Ellipse, IsAPolygonOfManyCorners) {
  Random random(5);
  int whole = 0, cut = 0;
  for (int i = 0; i < 60; ++i) {
    Ellipse e = random_ellipse(random);
    e.center.z() = std::abs(e.center.z());
    const double expected = polygon_share(e);
    EXPECT_NEAR(clamped_cosine_share(e), expected, kPolygonError) << i;
    const double lowest = e.center.z() - std::hypot(e.half_u.z(), e.half_v.z());
    (lowest > 0 ? whole : cut) += expected > 0;
  }
  EXPECT_GT(whole, 5);
  EXPECT_GT(cut, 20);
}

// The closed form of the whole and the sum of its parts' arcs: three cuts through the axis, one cut
// that leaves both halves, and a cut that leaves all but nothing.
TEST(Ellipse, PartsMakeUpTheWhole) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    Ellipse e = random_ellipse(random);
    e.center.z() = std::abs(e.center.z());
    const double scale = i % 2 ? 1 : 1e-3;
    e.half_u *= scale;
    e.half_v *= scale;
    const double whole = clamped_cosine_share(e);
    // Through a point of it, so that it cuts.
    const Vector3d through = e.center + 0.7 * e.half_u - 0.4 * e.half_v;
    const Vector3d normal = through.cross(random.direction()), other = -normal;
    const double parts = clamped_cosine_share(e, std::span(&normal, 1)) +
                         clamped_cosine_share(e, std::span(&other, 1));
    EXPECT_NEAR(parts, whole, 1e-14) << i;
    const Vector3d both[] = {normal, other};
    EXPECT_NEAR(clamped_cosine_share(e, both), 0, 1e-15);
  }
}

TEST(Ellipse, TransformsAsThePolygonsOfLtcs) {
  Random random(11);
  int cut_before = 0;
  for (int i = 0; i < 60; ++i) {
    const Ellipse e = random_ellipse(random);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        matrix(row, column) += 0.6 * (2 * random.uniform() - 1);
    if (i % 3 == 0)
      matrix.col(0) *= -0.05;  // sharp, and mirrored
    if (std::abs(matrix.determinant()) < 1e-3)
      continue;
    const LinearlyTransformed cosine(matrix);
    const std::vector<Vector3d> polygon = polygon_of(e, kCorners);
    const double once = std::abs(cosine.integrate_polygon(polygon));
    const double expected = std::abs(cosine.integrate_polygon(clip_to_upper_hemisphere(polygon)));
    EXPECT_NEAR(ltc_share(matrix, e), expected, 20 * kPolygonError) << i;
    cut_before += std::abs(once - expected) > 1e-3;
  }
  EXPECT_GT(cut_before, 5);
}

// Of a sharp lobe in the middle of a disk all but (alpha/radius)^2 arrives; numbers as large as
// those that M^-1 makes of it.
TEST(Ellipse, KeepsItsDigitsUnderSharpLobes) {
  for (const double alpha : {1e-2, 1e-4, 1e-6}) {
    const Eigen::Matrix3d matrix = Vector3d(alpha, alpha, 1).asDiagonal();
    const double radius = 3 * alpha, ratio = radius / alpha;
    EXPECT_NEAR(ltc_share(matrix, level_disk(radius, 1)), ratio * ratio / (1 + ratio * ratio),
                1e-14);
    // Its rim through the middle of the lobe: half of it, but for its curvature. The closed form
    // for a level circle aside, at its own radius.
    const Ellipse aside{{1, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    const double h = alpha, sum = 2 + h * h;
    EXPECT_NEAR(ltc_share(matrix, aside), 0.5 * (1 - h * h / std::sqrt(sum * sum - 4)), 1e-10);
  }
}

TEST(Ellipse, OfASphereCoversItsCone) {
  // Overhead, and low: (r/d)^2 cos(theta) above the horizon, as every textbook has it.
  for (const double radius : {1e-4, 0.3, 0.7})
    for (const double theta : {0.0, 0.5, 0.75}) {
      const Vector3d center = 2 * Vector3d(std::sin(theta), 0, std::cos(theta));
      const double expected = radius * radius / 4 * std::cos(theta);
      EXPECT_NEAR(clamped_cosine_share(disk_of_sphere(center, radius)), expected, 1e-15);
      const Ellipse disk = disk_of_sphere(center, radius);
      // Every point of the rim is where a ray touches the sphere.
      const Vector3d rim = disk.center + disk.half_u * 0.6 + disk.half_v * 0.8;
      EXPECT_NEAR((rim - center).norm(), radius, 1e-14);
      EXPECT_NEAR(rim.dot(rim - center), 0, 1e-14);
    }
  // Half set: its centre on the horizon.
  const double r = 0.5;
  const double sine = r, half = (std::asin(sine) - sine * std::sqrt(1 - sine * sine)) / kPi;
  // Of a cap about a level axis: 1/pi (gamma - sin gamma cos gamma).
  EXPECT_NEAR(clamped_cosine_share(disk_of_sphere({1, 0, 0}, r)), half, 1e-14);
}

TEST(Ellipse, ThatIsNotSeenHasNoShare) {
  EXPECT_EQ(clamped_cosine_share(level_disk(1, -1)), 0);
  EXPECT_EQ(clamped_cosine_share({{1, 0, 0.5}, {0, 0, 0}, {0, 1, 0}}), 0);
  // Edge on, and one on whose rim the origin lies.
  EXPECT_EQ(clamped_cosine_share({{2, 0, 1}, {1, 0, 0.5}, {0, 1, 0}}), 0);
  EXPECT_EQ(clamped_cosine_share({{1, 0, 1}, {1, 0, 1}, {0, 1, 0}}), 0);
  // On the horizon from below.
  EXPECT_NEAR(clamped_cosine_share({{1, 0, -0.5}, {0, 0, 0.5}, {0, 0.5, 0}}), 0, 1e-15);
}

TEST(Ellipse, RefusesWhatHasNoMeaning) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(clamped_cosine_share({{nan, 0, 1}, {1, 0, 0}, {0, 1, 0}}), InputError);
  EXPECT_THROW(ltc_share(Eigen::Matrix3d::Zero(), level_disk(1, 1)), InputError);
  for (const double radius : {0.0, -1.0, 1.0, 2.0, nan})
    EXPECT_THROW(disk_of_sphere({0, 0, 1}, radius), InputError) << radius;
}

}  // namespace
}  // namespace ltc
