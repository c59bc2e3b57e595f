// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/starting_points.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"

namespace ltc {
namespace {

// Length of a column of M, with a third column of unit length, for a mean absolute deviation of the
// lobe along it: equal for narrow lobes (projected slopes have mean absolute deviation 1 for M =
// I), and 1 for the clamped cosine itself, whose deviation along x is 4/(3 pi) = 0.4244.
double column_length(double deviation) {
  constexpr double of_cosine = 4 / (3 * std::numbers::pi);
  return deviation / std::max(1 - deviation * (1 - of_cosine) / of_cosine, 0.1);
}

// A column of M never starts thinner than this share of the other one. A lobe with one roughness
// near zero is bent, and a flat LTC cannot tell which way to open: one that starts flat may end so.
constexpr double thinnest_start = 0.1;

}  // namespace

Eigen::Matrix3d admissible(const Eigen::Matrix3d& frame_matrix, const FreeEntries& free) {
  Eigen::Matrix3d p = frame_matrix;
  for (int entry = 0; entry < 9; ++entry)
    if (!free[entry])
      p(entry / 3, entry % 3) = 0;
  if (p.determinant() < 0)
    p.col(1) = -p.col(1);
  return p;
}

Eigen::Matrix3d repaired(const LobeFrame& frame, const Eigen::Matrix3d& matrix) {
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!matrix.allFinite() || !(largest > 0))
    return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  // By a power of two: no digit of a good start changes.
  Eigen::Matrix3d p = frame.from_matrix(matrix * std::ldexp(1.0, -std::ilogb(largest)));
  if (p(2, 2) < 0)
    p = -p;
  return admissible(p, free_entries(frame.lobe));
}

Eigen::Matrix3d first_order_start(const LobeFrame& frame) {
  Eigen::Matrix3d p = frame.first_order;
  const double width_x = frame.widths.x() * p.col(0).norm();
  const double width_y = frame.widths.y() * p.col(1).norm();
  if (width_y < thinnest_start * width_x)
    p.col(1) *= thinnest_start * width_x / width_y;
  else if (width_x < thinnest_start * width_y)
    p.col(0) *= thinnest_start * width_y / width_x;
  return admissible(p, free_entries(frame.lobe));
}

Eigen::Matrix3d moment_start(const LobeFrame& frame, const TargetSamples& target) {
  const TargetMoments moments = target_moments(target);
  const Eigen::Vector3d axis = (moments.mean + Eigen::Vector3d::UnitZ()).normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spectrum(across * moments.covariance *
                                                                across);
  // Eigenvalues ascend: the last two belong to the plane across the axis.
  const auto column = [&](int which) -> Eigen::Vector3d {
    const Eigen::Vector3d along = spectrum.eigenvectors().col(which);
    return column_length(target_deviation(target, along, along.dot(moments.mean))) * along;
  };
  Eigen::Matrix3d m;
  m.col(0) = column(2);
  m.col(1) = column(1);
  m.col(1) *= std::max(1.0, thinnest_start * m.col(0).norm() / std::max(m.col(1).norm(), 1e-30));
  m.col(2) = axis;
  if (m.determinant() < 0)
    m.col(1) = -m.col(1);
  // Of all rotations about z, which leave the lobe as it is, the one nearest to the first-order
  // matrix: only so do the symmetry zeros fall on their places.
  const Eigen::Matrix3d first_order = frame.first_order * frame.widths.asDiagonal();
  const Eigen::Matrix2d overlap = m.leftCols<2>().transpose() * first_order.leftCols<2>();
  const double angle = std::atan2(overlap(1, 0) - overlap(0, 1), overlap(0, 0) + overlap(1, 1));
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  m.leftCols<2>() = (m.leftCols<2>() * turn).eval();
  return admissible(m * frame.widths.cwiseInverse().asDiagonal(), free_entries(frame.lobe));
}

Eigen::Matrix3d identity_start(const LobeFrame& frame) {
  return admissible(frame.from_matrix(Eigen::Matrix3d::Identity()), free_entries(frame.lobe));
}

Eigen::Matrix3d random_start(const LobeFrame& frame, const TargetSamples& target,
                             std::uint64_t seed) {
  Random random(seed);
  Eigen::Matrix3d p = moment_start(frame, target);
  const Eigen::RowVector3d typical = p.colwise().norm() / std::sqrt(3.0);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      p(row, column) += 0.4 * random.normal() * typical[column];
  return admissible(p, free_entries(frame.lobe));
}

Eigen::Matrix3d start_of_kind(StartKind kind, const LobeFrame& frame, const TargetSamples& target,
                              std::uint64_t seed) {
  switch (kind) {
    case StartKind::first_order:
      return first_order_start(frame);
    case StartKind::moments:
      return moment_start(frame, target);
    case StartKind::random:
      return random_start(frame, target, seed);
    case StartKind::identity:
      break;
  }
  return identity_start(frame);
}

}  // namespace ltc
