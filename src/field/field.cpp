// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "field/field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ltc {
namespace {

constexpr std::size_t index(FieldPart part) {
  return static_cast<std::size_t>(part);
}

bool is_isotropic(FieldPart part) {
  return part <= FieldPart::d;
}

// Whether the part's orders are odd: entries that mix the mirror's direction with another.
bool is_odd(FieldPart part) {
  return part == FieldPart::m02 || part == FieldPart::m20 || part == FieldPart::m12 ||
         part == FieldPart::m21 || part == FieldPart::kappa;
}

// As near as single precision has it.
bool is_of_material(const std::array<double, 2>& material, const FieldVariables& at) {
  constexpr double tolerance = 1e-6;
  return std::abs(at.lobe.alpha_x - material[0]) <= tolerance * material[0] &&
         std::abs(at.lobe.alpha_y - material[1]) <= tolerance * material[1];
}

// (cos phi, sin phi, 0), exactly zero where phi is that of an axis; but for a rounding of its z.
Eigen::Vector3d azimuth_direction(const Lobe& lobe) {
  return Lobe{1, 1, std::numbers::pi / 2, lobe.phi_radians}.omega_v();
}

// T_0 .. T_n at 2u - 1.
template <typename Values>
void chebyshev(double u, std::size_t n, Values& values) {
  const double x = 2 * u - 1;
  values[0] = 1;
  if (n > 0)
    values[1] = x;
  for (std::size_t i = 2; i <= n; ++i)
    values[i] = 2 * x * values[i - 1] - values[i - 2];
}

}  // namespace

bool is_allowed(const FieldTerm& term) {
  for (const std::uint8_t degree : {term.alpha, term.lambda, term.radius, term.angle, term.order})
    if (degree > field_most_degree)
      return false;
  if (is_isotropic(term.part))
    return term.lambda == 0 && term.order == 0;
  if (is_odd(term.part))
    return term.lambda > 0 && term.order % 2 == 1;
  if (term.part == FieldPart::m01 || term.part == FieldPart::m10)
    return term.lambda > 0 && term.order % 2 == 0 && term.order > 0;
  return term.order % 2 == 0 && (term.lambda > 0 || (is_of_albedo(term.part) && term.order == 0));
}

double width_across(const Lobe& folded) {
  const double alpha = folded.alpha_x, lambda = folded.alpha_y / alpha;
  const double least = field_least_width * alpha;
  return alpha * std::sqrt(lambda * lambda + least * least * (1 - lambda * lambda));
}

FieldVariables::FieldVariables(const Lobe& folded, double alpha_min) : lobe(folded) {
  lobe.alpha_x = std::max(lobe.alpha_x, alpha_min);
  lobe.alpha_y = std::max(lobe.alpha_y, alpha_min);
  alpha = lobe.alpha_x;
  lambda = lobe.alpha_y / lobe.alpha_x;
  const Eigen::Vector3d v = lobe.omega_v();
  sin_theta = std::sin(lobe.theta_radians);
  cos_theta = v.z();
  width_y = width_across(lobe);
  const double length = Eigen::Vector3d(alpha * v.x(), width_y * v.y(), v.z()).norm();
  radius = std::sqrt(length);
  angle = cos_theta / length;
  const double albedo_length = Eigen::Vector3d(alpha * v.x(), lobe.alpha_y * v.y(), v.z()).norm();
  albedo_radius = std::sqrt(albedo_length);
  albedo_angle = cos_theta / albedo_length;
}

FieldBasis::FieldBasis(const FieldVariables& at, std::size_t n) {
  chebyshev(at.alpha, n, alpha_);
  chebyshev(at.radius, n, matrix_.radius);
  chebyshev(at.angle, n, matrix_.angle);
  chebyshev(at.albedo_radius, n, albedo_.radius);
  chebyshev(at.albedo_angle, n, albedo_.angle);
  lambda_[0] = 1;
  Values inner;
  chebyshev(at.lambda, n, inner);
  for (std::size_t j = 1; j <= n; ++j)
    lambda_[j] = (1 - at.lambda) * inner[j - 1];
  // By the sum formulas, which keep exact zeros.
  const Eigen::Vector3d v = azimuth_direction(at.lobe);
  cosine_[0] = 1;
  sine_[0] = 0;
  for (std::size_t m = 1; m <= n; ++m) {
    cosine_[m] = cosine_[m - 1] * v.x() - sine_[m - 1] * v.y();
    sine_[m] = sine_[m - 1] * v.x() + cosine_[m - 1] * v.y();
  }
  for (std::size_t m = 1; m <= n; ++m) {
    const double factor = m % 2 == 1 ? at.sin_theta : at.sin_theta * at.sin_theta;
    cosine_[m] *= factor;
    sine_[m] *= factor;
  }
}

FieldDirections::FieldDirections(const FieldVariables& at) {
  const Eigen::Vector3d v = at.lobe.omega_v();  // (s cos phi, s sin phi, c)
  const double largest = std::hypot(at.cos_theta, at.alpha * at.sin_theta);
  const double k = at.alpha * at.alpha / largest, h = 1 / std::sqrt(largest);
  const double cos_2 = v.x() * v.x() - v.y() * v.y(), sin_2 = 2 * v.x() * v.y();
  const auto entry = [this](FieldPart part, int row, int column) -> double& {
    return direction[index(part)](row, column);
  };
  for (Eigen::Matrix3d& matrix : direction)
    matrix.setZero();
  const Eigen::Vector3d x = azimuth_direction(at.lobe);
  const Eigen::Vector3d across(-x.y(), x.x(), 0);
  const double u =
      std::sqrt(at.cos_theta * at.cos_theta + std::hypot(at.alpha * v.x(), at.width_y * v.y()));
  left = Eigen::Matrix3d::Identity() - (1 - u) * across * across.transpose();
  constant.setZero();
  constant(2, 2) = 1 - field_own_factor * std::pow(at.lobe.alpha_y * (1 - at.cos_theta), 2);
  entry(FieldPart::a, 0, 0) = entry(FieldPart::a, 1, 1) = 1;
  entry(FieldPart::b, 0, 0) = cos_2;
  entry(FieldPart::b, 1, 1) = -cos_2;
  entry(FieldPart::b, 0, 1) = entry(FieldPart::b, 1, 0) = sin_2;
  entry(FieldPart::c, 0, 2) = k * v.x();
  entry(FieldPart::c, 1, 2) = k * v.y();
  entry(FieldPart::d, 2, 0) = h * v.x();
  entry(FieldPart::d, 2, 1) = h * v.y();
  entry(FieldPart::m00, 0, 0) = entry(FieldPart::m01, 0, 1) = 1;
  entry(FieldPart::m10, 1, 0) = entry(FieldPart::m11, 1, 1) = 1;
  entry(FieldPart::m02, 0, 2) = entry(FieldPart::m12, 1, 2) = k;
  entry(FieldPart::m20, 2, 0) = entry(FieldPart::m21, 2, 1) = h;
}

Eigen::Matrix3d with_least_determinant(Eigen::Matrix3d t) {
  const double a = t(0, 0) - t(0, 2) * t(2, 0) / t(2, 2), d = t(1, 1) - t(1, 2) * t(2, 1) / t(2, 2);
  const double b = t(0, 1) - t(0, 2) * t(2, 1) / t(2, 2), c = t(1, 0) - t(1, 2) * t(2, 0) / t(2, 2);
  const double lacking = field_least_determinant / t(2, 2) - (a * d - b * c), trace = a + d;
  if (!(lacking > 0))
    return t;
  const double root = std::sqrt(trace * trace + 4 * lacking);
  // Of mu^2 + mu trace = lacking, without cancellation.
  const double mu = trace > 0 ? 2 * lacking / (root + trace) : (root - trace) / 2;
  t(0, 0) += mu;
  t(1, 1) += mu;
  return t;
}

FieldValues values_of(const Field& field, const FieldVariables& at) {
  const FieldBasis basis(at);
  FieldValues values{};
  for (std::size_t i = 0; i < field.terms.size(); ++i)
    values[index(field.terms[i].part)] +=
        static_cast<double>(field.coefficients[i]) * basis.value(field.terms[i]);
  return values;
}

double most_fold(const Creases& creases) {
  return 0.95 / sum_of(creases);
}

Fold fold_of(double kappa, double gamma, const Lobe& folded, const Creases& creases) {
  if (creases.empty())
    return {};
  return {folded.alpha_x * folded.alpha_x * kappa / width_across(folded),
          std::min(gamma, most_fold(creases))};
}

Eigen::Matrix3d field_frame_matrix(const double* values, const FieldVariables& at) {
  const FieldDirections directions(at);
  Eigen::Matrix3d t = directions.constant;
  for (std::size_t part = 0; part < field_matrix_part_count; ++part)
    t += values[part] * directions.direction[part];
  return directions.left * with_least_determinant(t) *
         Eigen::Vector3d(1, at.width_y / at.lobe.alpha_y, 1).asDiagonal();
}

FieldLobe lobe_of(const Field& field, const Lobe& folded) {
  const FieldVariables at(folded, field.alpha_min);
  if (field.material && !is_of_material(*field.material, at)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {Eigen::Matrix3d::Constant(none), none, none};
  }
  const FieldValues values = values_of(field, at);
  const double amplitude = std::clamp(values[index(FieldPart::amplitude)], 0.0, 1.0);
  const double x = std::clamp(values[index(FieldPart::view_cosine)], 0.0, 1.0);
  const Eigen::Matrix3d matrix = mirror_rotation(at.lobe.omega_v()) *
                                 field_frame_matrix(values.data(), at) *
                                 Eigen::Vector3d(at.lobe.alpha_x, at.lobe.alpha_y, 1).asDiagonal();
  const double kappa = values[index(FieldPart::kappa)];
  const Fold bend = fold_of(kappa, values[index(FieldPart::gamma)], at.lobe, field.creases);
  return {matrix, amplitude, amplitude * std::pow(1 - x, 5), bend, kappa, bend.g};
}

}  // namespace ltc
