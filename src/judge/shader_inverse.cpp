// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/shader_inverse.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace ltc {
namespace {

template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Nearest, ties to even, as both processors and texture units do.
template <typename Scalar>
Scalar rounded(double value) {
  return static_cast<Scalar>(static_cast<float>(value));
}
template <typename Scalar>
Matrix3<Scalar> rounded(const Eigen::Matrix3d& matrix) {
  return matrix.unaryExpr([](double value) { return rounded<Scalar>(value); });
}
template <typename Scalar>
Eigen::Matrix3d in_double(const Matrix3<Scalar>& matrix) {
  return matrix.unaryExpr(
      [](Scalar value) { return static_cast<double>(static_cast<float>(value)); });
}

// Products and sums as a shader writes them: every one is rounded.
template <typename Scalar>
Scalar dot(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
template <typename Scalar>
Vector3<Scalar> cross(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}
template <typename Scalar>
Matrix3<Scalar> product(const Matrix3<Scalar>& a, const Matrix3<Scalar>& b) {
  Matrix3<Scalar> result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result(row, column) = dot<Scalar>(a.row(row).transpose(), b.col(column));
  return result;
}

// M^-1 times the determinant, and that.
template <typename Scalar>
struct Adjugate {
  Matrix3<Scalar> matrix;
  Scalar determinant;
};
template <typename Scalar>
Adjugate<Scalar> adjugate(const Matrix3<Scalar>& m) {
  const Vector3<Scalar> r0 = m.row(0), r1 = m.row(1), r2 = m.row(2);
  Adjugate<Scalar> result;
  result.matrix.col(0) = cross<Scalar>(r1, r2);
  result.matrix.col(1) = cross<Scalar>(r2, r0);
  result.matrix.col(2) = cross<Scalar>(r0, r1);
  result.determinant = dot<Scalar>(r0, result.matrix.col(0));
  return result;
}

// What `inverse`, in all digits, is the inverse of; NaN where it has none.
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d& inverse) {
  if (!inverse.allFinite())
    return Eigen::Matrix3d::Constant(nan);
  const Eigen::Matrix3d matrix = inverse.inverse();
  return matrix.allFinite() ? matrix : Eigen::Matrix3d::Constant(nan);
}

template <typename Scalar>
Eigen::Matrix3d seen_in(Storage storage, const Eigen::Matrix3d& stored, const LobeFrame& frame,
                        InverseOrder order) {
  const bool scaled = storage != Storage::matrix, turned = is_in_mirror_frame(storage);
  const Eigen::Vector3d scale = scaled ? scale_of_columns(storage, frame.lobe) : frame.widths;
  const Vector3<Scalar> roughness(rounded<Scalar>(scale.x()), rounded<Scalar>(scale.y()),
                                  Scalar(1));
  const Matrix3<Scalar> q = rounded<Scalar>(frame.rotation);
  const bool factored = order == InverseOrder::factored;
  Matrix3<Scalar> m = rounded<Scalar>(stored);
  if (storage == Storage::inverse)  // the shader takes it as it is
    return inverse_of(in_double<Scalar>(m));
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      if (scaled && !factored)
        m(row, column) = m(row, column) * roughness[column];
      if (!scaled && factored)
        m(row, column) = m(row, column) / roughness[column];
    }
  if (turned && !factored)
    m = product<Scalar>(q, m);
  if (!turned && factored)
    m = product<Scalar>(Matrix3<Scalar>(q.transpose()), m);
  auto [inverse, determinant] = adjugate<Scalar>(m);
  const bool mirrored = stored.determinant() < 0;
  if (mirrored ? !(determinant < Scalar(0)) : !(determinant > Scalar(0)))
    return Eigen::Matrix3d::Constant(nan);
  if (order == InverseOrder::divided)
    for (int entry = 0; entry < 9; ++entry)
      inverse(entry / 3, entry % 3) = inverse(entry / 3, entry % 3) / determinant;
  if (order != InverseOrder::divided && mirrored)
    inverse = -inverse;
  const Eigen::Matrix3d seen = inverse_of(in_double<Scalar>(inverse));
  return factored ? frame.rotation * seen * scale.asDiagonal() : seen;
}

}  // namespace

Eigen::Matrix3d seen_by_shader(Storage storage, const Eigen::Matrix3d& stored,
                               const LobeFrame& frame, InverseOrder order, Precision memory,
                               Precision arithmetic) {
  const Eigen::Matrix3d kept = rounded(stored, memory);
  return arithmetic == Precision::half ? seen_in<Eigen::half>(storage, kept, frame, order)
                                       : seen_in<float>(storage, kept, frame, order);
}

InversionMeter::InversionMeter(std::size_t samples, std::size_t directions)
    : quantiles_(samples, directions, 32), exact_(quantiles_.size()), seen_(quantiles_.size()) {}

double InversionMeter::error(const LobeFrame& frame, const LtcLobe& exact, const LtcLobe& seen) {
  if (!seen.matrix.allFinite())
    return std::numeric_limits<double>::infinity();
  quantiles_.of_ltc(frame, exact, exact_.data());
  quantiles_.of_ltc(frame, seen, seen_.data());
  return quantiles_.distance(exact_.data(), seen_.data()) / quantiles_.spread(exact_.data());
}

std::vector<double> inversion_errors(
    const Table& table, const std::vector<bool>& judged, std::string_view stage,
    const RunContext& run, const std::function<LtcLobe(std::size_t, const LobeFrame&)>& seen) {
  constexpr std::size_t samples = 512, directions = 8;
  std::vector<double> errors(table.grid.size(), nan);
  parallel_for_each<InversionMeter>(
      stage, errors.size(), run, [] { return InversionMeter(samples, directions); },
      [&](std::size_t flat, InversionMeter& meter) {
        if (!judged[flat])
          return;
        const LobeFrame frame(table.grid.lobe(flat));
        errors[flat] = meter.error(frame, table.ltc_at(flat), seen(flat, frame));
      });
  return errors;
}

}  // namespace ltc
