// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Polygon integrals in closed cases and where formulas break.
#include "ltc/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace ltc {
namespace {

constexpr double kPi = std::numbers::pi;
using Polygon = std::vector<Eigen::Vector3d>;

double clamped_cosine(const Polygon& polygon) {
  return polygon_cosine_integral(clip_to_upper_hemisphere(polygon));
}

Polygon reversed(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

// A rectangle at height 1, counter-clockwise from above.
Polygon rectangle(double x0, double x1, double y0, double y1) {
  return {{x0, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {x0, y1, 1}};
}

// Irradiance below a corner of an a x b rectangle at height 1 (configuration factor C-11, times
// pi).
double corner_rectangle(double a, double b) {
  const double p = std::hypot(1, a), q = std::hypot(1, b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / 2;
}

TEST(Polygon, CosineOfARectangleIsTheConfigurationFactor) {
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.01, 3.0}, {1e4, 1e4}, {1e-5, 1e-5}}) {
    const double expected = corner_rectangle(a, b);
    EXPECT_NEAR(clamped_cosine(rectangle(0, a, 0, b)), expected, 1e-11 * expected);
    EXPECT_NEAR(clamped_cosine(reversed(rectangle(0, a, 0, b))), -expected, 1e-11 * expected);
  }
}

TEST(Polygon, TinyPolygonsKeepTheirDigits) {
  // Far from the pole, 1e-7 wide: z/r^3 times the area, to the second order of the size. Lambert's
  // sum as printed has an error of 1e-16/1e-14 = 1 % here.
  const double size = 1e-7, x = 0.8, y = 0.3;
  const double distance = std::sqrt(x * x + y * y + 1);
  const double expected = size * size / std::pow(distance, 4);
  const Polygon polygon = rectangle(x - size / 2, x + size / 2, y - size / 2, y + size / 2);
  EXPECT_NEAR(clamped_cosine(polygon), expected, 1e-7 * expected);
  EXPECT_NEAR(polygon_solid_angle(polygon), expected * distance, 1e-7 * expected);
}

TEST(Polygon, AllOfTheHemisphere) {
  // An octant's corner lies on the pole, its other vertices exactly on the horizon.
  const Polygon octant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(clamped_cosine(octant), kPi / 4, 1e-15);
  EXPECT_NEAR(polygon_solid_angle(octant), kPi / 2, 1e-15);
  EXPECT_NEAR(polygon_squared_cosine_integral(octant), kPi / 6, 1e-15);
  // A square around the horizon: four edges of 90 degrees in the plane z = 0.
  const Polygon horizon = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_NEAR(clamped_cosine(horizon), kPi, 1e-15);
  // A huge square overhead is nearly all of it.
  EXPECT_NEAR(clamped_cosine(rectangle(-1e9, 1e9, -1e9, 1e9)), kPi, 1e-15);
}

TEST(Polygon, ClipsAtTheHorizon) {
  // A wall at x = 1 from far below to far above, as wide as the world: half of a half.
  const double far = 1e8;
  const Polygon wall = {{1, -far, -far}, {1, far, -far}, {1, far, far}, {1, -far, far}};
  EXPECT_NEAR(clamped_cosine(wall), kPi / 2, 1e-7);
  EXPECT_NEAR(polygon_solid_angle(clip_to_upper_hemisphere(wall)), kPi, 1e-7);
  EXPECT_NEAR(polygon_solid_angle(wall), 2 * kPi, 1e-7);
  EXPECT_NEAR(polygon_squared_cosine_integral(clip_to_upper_hemisphere(wall)), kPi / 3, 1e-7);
  // All below.
  Polygon below = rectangle(-1, 1, -1, 1);
  for (Eigen::Vector3d& vertex : below)
    vertex.z() = -1;
  EXPECT_EQ(clamped_cosine(below), 0);
  EXPECT_TRUE(clip_to_upper_hemisphere(below).empty());
  // Touching the horizon from below with one vertex and with an edge.
  EXPECT_EQ(clamped_cosine({{1, 0, 0}, {1, 1, -1}, {1, -1, -1}}), 0);
  EXPECT_EQ(clamped_cosine({{1, 1, 0}, {1, -1, 0}, {1, 0, -1}}), 0);
}

TEST(Polygon, AVertexOnTheHorizonIsTheLimitOfOneNearIt) {
  for (const double z : {0.0, 1e-300, -1e-300, 1e-17, -1e-17, 1e-12, -1e-12})
    EXPECT_NEAR(clamped_cosine({{1, -1, z}, {1, 1, z}, {1, 0, 2}}),
                clamped_cosine({{1, -1, 0}, {1, 1, 0}, {1, 0, 2}}), 1e-11);
}

TEST(Polygon, ClippingAddsUp) {
  // Cutting a polygon at the horizon by hand changes nothing; nor does cutting it in two.
  const Polygon triangle = {{2, 1, -1}, {1, 3, 2}, {-1, 0.5, 1}};
  const Polygon first = {triangle[0], triangle[1], (triangle[1] + triangle[2]) / 2};
  const Polygon second = {triangle[0], (triangle[1] + triangle[2]) / 2, triangle[2]};
  EXPECT_NEAR(clamped_cosine(triangle), clamped_cosine(first) + clamped_cosine(second), 1e-15);
}

TEST(Polygon, NonConvexPolygonIsItsParts) {
  // An arrow that crosses the horizon twice, and its two halves.
  const Polygon arrow = {{2, 0, 1.5}, {2, -2, -1}, {2, 0, 0.5}, {2, 2, -1}};
  const Polygon left = {{2, 0, 1.5}, {2, -2, -1}, {2, 0, 0.5}};
  const Polygon right = {{2, 0, 1.5}, {2, 0, 0.5}, {2, 2, -1}};
  EXPECT_NEAR(clamped_cosine(arrow), clamped_cosine(left) + clamped_cosine(right), 1e-15);
}

TEST(Polygon, EdgeThroughThePole) {
  const double expected = corner_rectangle(1, 1);
  EXPECT_NEAR(clamped_cosine(rectangle(0, 1, -1, 1)), 2 * expected, 1e-15);
  // With the pole among the vertices.
  EXPECT_NEAR(clamped_cosine({{0, -1, 1}, {1, -1, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}}),
              2 * expected, 1e-15);
}

TEST(Polygon, DegenerateOnesAreZero) {
  EXPECT_EQ(clamped_cosine({}), 0);
  EXPECT_EQ(clamped_cosine({{1, 0, 1}}), 0);
  EXPECT_EQ(clamped_cosine({{1, 0, 1}, {0, 1, 1}}), 0);
  EXPECT_EQ(clamped_cosine({{1, 0, 1}, {1, 0, 1}, {1, 0, 1}}), 0);
  EXPECT_NEAR(clamped_cosine({{1, 0, 1}, {2, 0, 2}, {3, 0, 1}, {1, 0, 5}}), 0, 1e-15);
  EXPECT_NEAR(polygon_solid_angle(Polygon{{1, 0, 1}, {2, 0, 2}, {3, 0, 1}}), 0, 1e-15);
  // The origin on an edge: no arc, no crash.
  EXPECT_TRUE(std::isfinite(clamped_cosine({{1, 0, 1}, {-1, 0, -1}, {0, 1, 1}})));
  EXPECT_TRUE(
      std::isfinite(polygon_squared_cosine_integral(Polygon{{1, 0, 0}, {-1, 0, 0}, {0, 1, 1}})));
}

TEST(Polygon, RefusesVerticesWithoutDirection) {
  EXPECT_THROW(clamped_cosine({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}}), InputError);
  EXPECT_THROW(clamped_cosine({{std::nan(""), 0, 0}, {1, 0, 1}, {0, 1, 1}}), InputError);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(polygon_solid_angle(Polygon{{infinite, 0, 0}, {1, 0, 1}, {0, 1, 1}}), InputError);
}

}  // namespace
}  // namespace ltc
