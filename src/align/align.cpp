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

// An R of O(2) about z: a rotation [c -s; s c], or a reflection [c s; s -c].
struct Orthogonal {
  Turn turn;
  bool reflects = false;
};

Orthogonal rotation_for(const Eigen::Matrix2d& c) {
  return {Turn(c(0, 0) + c(1, 1), c(0, 1) - c(1, 0)), false};
}
Orthogonal reflection_for(const Eigen::Matrix2d& c) {
  return {Turn(c(0, 0) - c(1, 1), c(0, 1) + c(1, 0)), true};
}

// The R that makes tr(R2 C) largest, R2 being its upper left block:
//   rotation:   tr = c (C00 + C11) + s (C01 - C10),
//   reflection: tr = c (C00 - C11) + s (C01 + C10);
// each is largest where (c, s) points along its two coefficients, and worth their length. (This is
// V U^T of C's singular value decomposition, without the decomposition.)
Orthogonal best_for(const Eigen::Matrix2d& c) {
  const Orthogonal rotation = rotation_for(c), reflection = reflection_for(c);
  return reflection.turn.length > rotation.turn.length ? reflection : rotation;
}

// M R.
void apply(const Orthogonal& r, Eigen::Matrix3d& matrix) {
  const Eigen::Vector3d x = matrix.col(0), y = matrix.col(1);
  matrix.col(0) = x * r.turn.cosine + y * r.turn.sine;
  if (r.reflects)
    matrix.col(1) = x * r.turn.sine - y * r.turn.cosine;
  else
    matrix.col(1) = y * r.turn.cosine - x * r.turn.sine;
}

// The cosine distribution does not change under R, so equation (12) is 2 - 2 E[f . R^T w] =
// const - 2 tr(R2 C), with f = M w/|M w| and C the upper left block of E[f w^T]. Multiplies the
// matrix by the best R and returns the sine of the angle that it turned by, 1 where it reflected.
double align_once(Handedness handedness, Eigen::Matrix3d& matrix) {
  const Eigen::Matrix2d c = correlation(matrix);
  const Orthogonal best = handedness == Handedness::any ? best_for(c)
                          : matrix.determinant() < 0    ? reflection_for(c)
                                                        : rotation_for(c);
  apply(best, matrix);
  return best.reflects ? 1 : std::abs(best.turn.sine);
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

// |A - M R|^2 = const - 2 tr(A^T M R), of which R moves only what the first two columns say.
Eigen::Matrix3d align_to(const Eigen::Matrix3d& reference, const Eigen::Matrix3d& matrix) {
  // As single products of columns, so that C is symmetric to the last bit where A = M.
  Eigen::Matrix2d c;
  c << reference.col(0).dot(matrix.col(0)), reference.col(0).dot(matrix.col(1)),
      reference.col(1).dot(matrix.col(0)), reference.col(1).dot(matrix.col(1));
  Eigen::Matrix3d aligned = matrix;
  apply(best_for(c), aligned);
  return aligned;
}

}  // namespace ltc
