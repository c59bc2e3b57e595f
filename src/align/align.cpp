// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Alignment in closed form.
#include "align/align.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ltc {
namespace {

// Cosine-distributed directions of one quadrant; the other three are their mirror images. The
// golden-ratio lattice over (azimuth, sin^2 theta).
constexpr std::size_t kQuadrantSamples = 256;

struct QuadrantSamples {
  std::array<double, kQuadrantSamples> x, y, z;

  QuadrantSamples() {
    const double golden = std::numbers::phi - 1;
    for (std::size_t i = 0; i < kQuadrantSamples; ++i) {
      const double turns = golden * static_cast<double>(i);
      const double azimuth = std::numbers::pi / 2 * (turns - std::floor(turns));
      const double sine_squared = (static_cast<double>(i) + 0.5) / kQuadrantSamples;
      const double sine = std::sqrt(sine_squared);
      x[i] = sine * std::cos(azimuth);
      y[i] = sine * std::sin(azimuth);
      z[i] = std::sqrt(1 - sine_squared);
    }
  }
};

// The upper left block of E[f w^T], f = M w/|M w|, over the mirrored samples, up to a factor. The
// images of a sample and its mirror images are summed first: sums that symmetry makes zero vanish
// to the last bit.
Eigen::Matrix2d correlation(const Eigen::Matrix3d& matrix) {
  static const QuadrantSamples samples;
  double c00 = 0, c01 = 0, c10 = 0, c11 = 0;
  for (std::size_t i = 0; i < kQuadrantSamples; ++i) {
    const Eigen::Vector3d x = samples.x[i] * matrix.col(0);
    const Eigen::Vector3d y = samples.y[i] * matrix.col(1);
    const Eigen::Vector3d z = samples.z[i] * matrix.col(2);
    auto image = [](const Eigen::Vector3d& f) -> Eigen::Vector2d {
      return f.head<2>() / std::sqrt(f.squaredNorm());
    };
    const Eigen::Vector2d right_up = image(x + y + z), right_down = image(x - y + z);
    const Eigen::Vector2d left_up = image(y - x + z), left_down = image(z - x - y);
    const Eigen::Vector2d along_x = (right_up + right_down) - (left_up + left_down);
    const Eigen::Vector2d along_y = (right_up - right_down) + (left_up - left_down);
    c00 += along_x.x() * samples.x[i];
    c10 += along_x.y() * samples.x[i];
    c01 += along_y.x() * samples.y[i];
    c11 += along_y.y() * samples.y[i];
  }
  Eigen::Matrix2d c;
  c << c00, c01, c10, c11;
  return c;
}

// Cosine and sine of an angle whose direction is (x, y), and its length.
struct Turn {
  double cosine = 1, sine = 0, length = 0;
  Turn(double x, double y) : length(std::hypot(x, y)) {
    if (length > 0) {
      cosine = x / length;
      sine = y / length;
    }
  }
};

// The cosine distribution does not change under R, so equation (12) is 2 - 2 E[f . R^T w] =
// const - 2 tr(R2 C), with f = M w/|M w|, C the upper left block of E[f w^T] and R2 that of R.
//   Rotation R2 = [c -s; s c]:   tr = c (C00 + C11) + s (C01 - C10),
//   reflection R2 = [c s; s -c]: tr = c (C00 - C11) + s (C01 + C10);
// each is largest where (c, s) points along its two coefficients, and worth their length. (This is
// V U^T of C's singular value decomposition, without the decomposition.) Multiplies the matrix by R
// and returns the sine of the angle that it turned by, 1 where it reflected.
double align_once(Handedness handedness, Eigen::Matrix3d& matrix) {
  const Eigen::Matrix2d c = correlation(matrix);
  const Turn rotation(c(0, 0) + c(1, 1), c(0, 1) - c(1, 0));
  const Turn reflection(c(0, 0) - c(1, 1), c(0, 1) + c(1, 0));
  const bool reflect = handedness == Handedness::positive ? matrix.determinant() < 0
                                                          : reflection.length > rotation.length;
  const Turn& turn = reflect ? reflection : rotation;
  const Eigen::Vector3d x = matrix.col(0), y = matrix.col(1);
  matrix.col(0) = x * turn.cosine + y * turn.sine;
  if (reflect)
    matrix.col(1) = x * turn.sine - y * turn.cosine;
  else
    matrix.col(1) = y * turn.cosine - x * turn.sine;
  return reflect ? 1 : std::abs(turn.sine);
}

}  // namespace

// The samples are finitely many, so a needle turned far from its place is put back with an error of
// up to 4 % of a radian (0.2 % in the mean over the paper's grid). Each pass divides it by ten or
// more; what is left when the last turn is below a tenth of a milliradian does not depend on how
// the matrix came.
Eigen::Matrix3d align(const Eigen::Matrix3d& matrix, Handedness handedness) {
  constexpr int kMostPasses = 5;
  constexpr double kSmallTurn = 1e-4;
  Eigen::Matrix3d aligned = matrix;
  for (int pass = 0; pass < kMostPasses; ++pass)
    if (align_once(handedness, aligned) < kSmallTurn)
      break;
  return aligned;
}

}  // namespace ltc
