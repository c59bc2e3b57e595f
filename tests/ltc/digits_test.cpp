// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Sampling, inversion and polygon integrals against more digits than double has.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <vector>

#include "brdf/ggx.h"
#include "core/angle.h"
#include "fit/lobe_frame.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "support/wide.h"

namespace ltc {
namespace {

using test::kDoubleRounding;
using test::logarithmic;
using test::Wide;
using test::WorstError;
using Vector3l = Eigen::Matrix<long double, 3, 1>;
using Matrix3l = Eigen::Matrix<long double, 3, 3>;

// The sine of samples near the axis is what the centre of a lobe is made of.
TEST(LtcDigits, SamplesNearTheAxis) {
  WorstError careful, naive;
  for (const double u : logarithmic(1e-16, 0.5, 40)) {
    const Wide height = u;
    // 1 - z^2 as printed; of the cube root by Newton's steps from that of double.
    Wide cube_root = std::cbrt(1 - u);
    for (int step = 0; step < 3; ++step)
      cube_root = cube_root - (cube_root * cube_root * cube_root - (Wide(1) - height)) /
                                  (Wide(3) * cube_root * cube_root);
    const std::pair<Original, Wide> cosines[] = {
        {Original::uniform_sphere, Wide(1) - Wide(2) * height},
        {Original::uniform_hemisphere, Wide(1) - height},
        {Original::clamped_cosine, sqrt(Wide(1) - height)},
        {Original::squared_clamped_cosine, cube_root}};
    for (const auto& [original, z] : cosines) {
      const Wide expected = sqrt(Wide(1) - z * z);
      const Eigen::Vector3d omega = sample_original(original, u, 0);
      careful.add_relative(omega.x(), expected);
      naive.add_relative(std::sqrt(std::max(0.0, 1 - omega.z() * omega.z())), expected);
    }
  }
  // Six roundings at most.
  test::expect_only_the_careful_one_within(4 * kDoubleRounding, careful, naive);
}

// A square about a direction far from the pole, turned so that nothing is zero.
std::vector<Eigen::Vector3d> square_polygon(double size) {
  const Eigen::Vector3d centre(0.8, 0.3, 1), x = Eigen::Vector3d(1, 0.2, -0.3) * size / 2,
                                             y = Eigen::Vector3d(-0.3, 1, 0.1) * size / 2;
  return {centre - x - y, centre + x - y, centre + x + y, centre - x + y};
}

struct PolygonIntegrals {
  long double cosine = 0, squared_cosine = 0, solid_angle = 0;
};

template <typename Scalar>
struct Vector {
  Scalar x, y, z;
  friend Scalar dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

// As printed: Lambert's sum over edges; Arvo's with the edge's normal; the angles of van Oosterom
// and Strackee from the triple product. `angle_over_sine` of an edge's two.
template <typename Scalar, typename AngleOverSine>
PolygonIntegrals printed(const std::vector<Eigen::Vector3d>& vertices,
                         AngleOverSine angle_over_sine) {
  using std::sqrt;
  std::vector<Vector<Scalar>> p;
  for (const Eigen::Vector3d& vertex : vertices) {
    const Scalar x = vertex.x(), y = vertex.y(), z = vertex.z();
    const Scalar length = sqrt(x * x + y * y + z * z);
    p.push_back({x / length, y / length, z / length});
  }
  Scalar cosine = 0, squared = 0;
  long double angle = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector<Scalar>&a = p[i], &b = p[(i + 1) % p.size()];
    const Vector<Scalar> normal = cross(a, b);
    cosine = cosine + Scalar(angle_over_sine(sqrt(dot(normal, normal)), dot(a, b))) * normal.z;
    squared = squared + normal.z * (a.z + b.z) / (Scalar(1) + dot(a, b));
  }
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Scalar below = Scalar(1) + dot(p[0], p[i - 1]) + dot(p[i - 1], p[i]) + dot(p[i], p[0]);
    angle += 2 * std::atan2(static_cast<long double>(dot(p[0], cross(p[i - 1], p[i]))),
                            static_cast<long double>(below));
  }
  return {static_cast<long double>(cosine) / 2, (static_cast<long double>(squared) + angle) / 3,
          angle};
}

// The products of edges in 38 digits, of which the sums leave twice as few as a polygon is small.
PolygonIntegrals exact_integrals(const std::vector<Eigen::Vector3d>& polygon) {
  return printed<Wide>(polygon, [](const Wide& sine, const Wide& cosine) {
    const auto s = static_cast<long double>(sine);
    return std::atan2(s, static_cast<long double>(cosine)) / s;
  });
}
PolygonIntegrals plain_integrals(const std::vector<Eigen::Vector3d>& polygon) {
  return printed<double>(polygon,
                         [](double sine, double cosine) { return std::acos(cosine) / sine; });
}

TEST(LtcDigits, PolygonsOfAllSizes) {
  WorstError careful, naive;
  for (const double size : logarithmic(1e-7, 1, 29)) {
    const std::vector<Eigen::Vector3d> polygon = square_polygon(size);
    const PolygonIntegrals expected = exact_integrals(polygon);
    const PolygonIntegrals plain = plain_integrals(polygon);
    const auto add = [&](WorstError& error, long double value, long double reference) {
      error.add(static_cast<double>((value - reference) / reference) * size);
    };
    add(careful, polygon_cosine_integral(polygon), expected.cosine);
    add(careful, polygon_squared_cosine_integral(polygon), expected.squared_cosine);
    add(careful, polygon_solid_angle(polygon), expected.solid_angle);
    add(naive, plain.squared_cosine, expected.squared_cosine);
  }
  // Relative, times the size: a vertex is a direction rounded to 2^-53, and no formula can tell how
  // wide a polygon is more exactly than that over its width.
  test::expect_only_the_careful_one_within(16 * kDoubleRounding, careful, naive);
}

// The other two as printed, each by itself: the test above needs but one to fail.
TEST(LtcDigits, EveryPolygonFormulaAsPrintedLosesTinyPolygons) {
  const std::vector<Eigen::Vector3d> polygon = square_polygon(1e-7);
  const PolygonIntegrals expected = exact_integrals(polygon), plain = plain_integrals(polygon);
  const double bound = 16 * kDoubleRounding / 1e-7;
  const auto error = [](long double value, long double reference) {
    return static_cast<double>(std::abs(value / reference - 1));
  };
  EXPECT_FALSE(error(plain.cosine, expected.cosine) <= bound);
  EXPECT_FALSE(error(plain.squared_cosine, expected.squared_cosine) <= bound);
  EXPECT_FALSE(error(plain.solid_angle, expected.solid_angle) <= bound);
}

// Matrices of lobes as the fits make them, M = Q P0 A.
std::vector<LobeFrame> frames() {
  std::vector<LobeFrame> frames;
  for (const double alpha_x : logarithmic(1e-6, 1, 4))
    for (const double alpha_y : logarithmic(1e-6, 1, 4))
      for (const double theta : {0.0, 1e-3, 0.7, 1.4, radians_of_degrees(89.999)})
        frames.emplace_back(Lobe{alpha_x, alpha_y, theta, 0.7});
  return frames;
}

double condition_number(const Eigen::Matrix3d& matrix) {
  const auto values = Eigen::JacobiSVD<Eigen::Matrix3d>(matrix).singularValues().eval();
  return values.x() / values.z();
}

// The density at directions of the lobe, by the inverse of M: (7) as printed, with 19 digits.
TEST(LtcDigits, DensityThroughTheInverse) {
  WorstError careful, naive;
  for (const LobeFrame& frame : frames()) {
    const Eigen::Matrix3d matrix = frame.to_matrix(frame.first_order);
    const LinearlyTransformed lobe(matrix);
    const Matrix3l exact = matrix.cast<long double>().inverse();
    const Eigen::Matrix3d plain = (matrix.transpose() * matrix).inverse() * matrix.transpose();
    const auto density = [](const auto& inverse, const Vector3l& omega) {
      const Vector3l transformed = inverse.template cast<long double>() * omega;
      const long double length = transformed.norm();
      return transformed.z() / length / std::numbers::pi_v<long double> *
             std::abs(inverse.template cast<long double>().determinant()) /
             (length * length * length);
    };
    const double unit = condition_number(matrix);
    const Eigen::Vector3d omega = lobe.sample(0.3, 0.1);
    const long double expected = density(exact, omega.cast<long double>());
    careful.add(static_cast<double>((lobe.density(omega) - expected) / expected) / unit);
    naive.add(
        static_cast<double>((density(plain, omega.cast<long double>()) - expected) / expected) /
        unit);
  }
  // Relative, over the condition number: by so much the rounding of the direction alone moves it.
  test::expect_only_the_careful_one_within(8 * kDoubleRounding, careful, naive);
}

// What costs a determinant digits is the angle between the columns, not their lengths.
double angular_condition(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d equal = matrix.colwise().normalized();
  return 1 / std::abs(equal.determinant());
}

TEST(LtcDigits, DeterminantOfNarrowLobes) {
  WorstError careful, naive;
  for (const LobeFrame& frame : frames()) {
    const Eigen::Matrix3d matrix = frame.to_matrix(frame.first_order);
    const long double expected = matrix.cast<long double>().determinant();
    const double unit = angular_condition(matrix);
    careful.add(static_cast<double>((matrix.determinant() - expected) / expected) / unit);
    // By the length of M^T M.
    naive.add(static_cast<double>(
                  (std::sqrt(std::abs((matrix.transpose() * matrix).determinant())) - expected) /
                  expected) /
              unit);
  }
  // Three products of three entries each, relative to the largest.
  test::expect_only_the_careful_one_within(4 * kDoubleRounding, careful, naive);
}

}  // namespace
}  // namespace ltc
