// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/beckmann.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "brdf/microfacet-inl.h"
#include "core/gauss_rule.h"

namespace ltc {
namespace {

constexpr double inv_sqrt_pi = std::numbers::inv_sqrtpi;

double square(double x) {
  return x * x;
}

double stretched_sine(double alpha_x, double alpha_y, const Eigen::Vector3d& omega) {
  return std::hypot(alpha_x * omega.x(), alpha_y * omega.y());
}

// z Lambda = (s exp(-a^2)/sqrt(pi) - z erfc(a))/2, a = z/s; finite at the horizon.
double z_lambda(double z, double s) {
  const double a = z / s;
  return std::max(0.0, (s * std::exp(-a * a) * inv_sqrt_pi - z * std::erfc(a)) / 2);
}

// vz (1 + Lambda(v)).
double visible_area(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  const double s = stretched_sine(lobe.alpha_x, lobe.alpha_y, v);
  return v.z() + (s > 0 ? z_lambda(v.z(), s) : 0);
}

// The mass of a unit normal slope's visible part beyond x and below it, of the density
// (c + s x)+ exp(-x^2)/sqrt(pi); all of it is c (1 + Lambda) = `total`.
class VisibleMass {
 public:
  VisibleMass(double s, double c) : s_(s), c_(c), least_(s > 0 ? -c / s : -far) {
    c_lambda_ = s > 0 ? z_lambda(c, s) : 0;
  }
  double total() const { return c_ + c_lambda_; }
  double least() const { return least_; }  // slopes that are seen lie above it
  double density(double x) const {
    return std::max(0.0, c_ + s_ * x) * std::exp(-x * x) * inv_sqrt_pi;
  }
  double above(double x) const {
    return (c_ * std::erfc(x) + s_ * std::exp(-x * x) * inv_sqrt_pi) / 2;
  }
  double below(double x) const {
    // Near the least slope the mass grows with the square of the distance, and is the difference of
    // much larger terms: there by Gauss's rule, exact to all digits for such a smooth density.
    const double width = x - least_;
    if (width < 0.5)
      return near_least(width);
    return (c_ * std::erfc(-x) - s_ * std::exp(-x * x) * inv_sqrt_pi) / 2 + c_lambda_;
  }

 private:
  static constexpr double far = 1e3;

  double near_least(double width) const {
    static const std::vector<GaussNode> nodes = gauss_nodes_of_unit(8);
    double sum = 0;
    for (const GaussNode& node : nodes) {
      const double from_least = width * node.place;
      sum += node.weight * s_ * from_least * std::exp(-square(least_ + from_least));
    }
    return sum * width * inv_sqrt_pi;
  }

  double s_, c_, least_, c_lambda_;
};

// The x of `mass.above(x) = share total` or, where `lower`, of `mass.below(x)`; from a first guess.
// Both are logarithmically concave, so that Newton's steps in their logarithms come from one side;
// where one leaves the bracket that is known by then, it is halved.
double slope_of(const VisibleMass& mass, double share, bool lower, double guess) {
  const double wanted = share * mass.total();
  double low = mass.least(), high = 8, x = std::clamp(guess, low, high);
  for (int step = 0; step < 60; ++step) {
    const double at = lower ? mass.below(x) : mass.above(x);
    const double excess = std::log(at / wanted);  // of below, rising; of above, falling
    (lower ? excess > 0 : excess < 0) ? high = x : low = x;
    const double slope = (lower ? 1 : -1) * mass.density(x) / at;
    double next = x - excess / slope;
    if (!(next > low && next < high))
      next = (low + high) / 2;
    const bool done = std::abs(next - x) < 1e-12;
    x = next;
    if (done)
      break;
  }
  return x;
}

}  // namespace

// With h = H/|H|: no normalised z^2 = 1 - x^2 - y^2 is ever formed.
double beckmann_ndf(double alpha_x, double alpha_y, const Eigen::Vector3d& omega_h) {
  if (!(omega_h.z() > 0))
    return 0;
  const double z_squared = square(omega_h.z());
  const double steepness =
      (square(omega_h.x() / alpha_x) + square(omega_h.y() / alpha_y)) / z_squared;
  return std::exp(-steepness) * square(omega_h.squaredNorm() / z_squared) /
         (std::numbers::pi * alpha_x * alpha_y);
}

double beckmann_lambda(double alpha_x, double alpha_y, const Eigen::Vector3d& omega) {
  const double z = std::abs(omega.z()), s = stretched_sine(alpha_x, alpha_y, omega);
  return s > 0 ? z_lambda(z, s) / z : 0;
}

template class MicrofacetSampler<BeckmannSampler, beckmann_ndf, beckmann_lambda>;

BeckmannSampler::BeckmannSampler(const Lobe& lobe) : MicrofacetSampler(lobe, visible_area(lobe)) {
  const double s = stretched_sine(alpha_x(), alpha_y(), omega_v()), z = omega_v().z();
  const double length = std::hypot(s, z);
  s_ = s / length;
  c_ = z / length;
  along_x_ = s > 0 ? alpha_x() * omega_v().x() / s : 1;
  along_y_ = s > 0 ? alpha_y() * omega_v().y() / s : 0;
  tabulate();
}

// T with (c + s T) exp(-T^2) T' = c (1 + Lambda) exp(-X^2), and once more differentiated.
void BeckmannSampler::tabulate() {
  const VisibleMass mass(s_, c_);
  constexpr double distance = 1.0 / knots_a_unit;
  const auto fill = [&](int i, double guess) {
    const double x = i * distance;
    const bool lower = i < 0;
    const double t = slope_of(mass, std::erfc(std::abs(x)) / 2, lower, guess);
    const double density = mass.density(t);
    const double first = mass.total() * std::exp(-x * x) * inv_sqrt_pi / density;
    const double second = first * (-2 * x - first * (s_ / (c_ + s_ * t) - 2 * t));
    knots_[static_cast<std::size_t>(i + last_knot)] = {t, first * distance,
                                                       second * distance * distance};
    return t + (lower ? -1 : 1) * first * distance;
  };
  double guess = fill(0, 0);
  for (int i = 1; i <= last_knot; ++i)
    guess = fill(i, guess);
  const Knot& middle = knots_[last_knot];
  guess = middle[0] - middle[1];
  for (int i = -1; i >= -last_knot; --i)
    guess = fill(i, guess);
}

namespace {

// Hermite's interpolation of fifth degree between two knots: coefficients of the powers of the
// place between them, from values and derivatives.
std::array<double, 6> hermite(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double rise = b[0] - a[0], half_a = a[2] / 2, half_b = b[2] / 2;
  return {a[0],
          a[1],
          half_a,
          10 * rise - 6 * a[1] - 4 * b[1] - 3 * half_a + half_b,
          -15 * rise + 8 * a[1] + 7 * b[1] + 3 * half_a - 2 * half_b,
          6 * rise - 3 * a[1] - 3 * b[1] - half_a + half_b};
}

}  // namespace

double BeckmannSampler::visible_slope(double normal_slope) const {
  const double place = std::clamp(normal_slope * knots_a_unit + last_knot, 0.0, 2.0 * last_knot);
  const auto at = std::min(static_cast<std::size_t>(place), knots_.size() - 2);
  const double t = place - static_cast<double>(at);
  double value = 0;
  for (const double coefficient : hermite(knots_[at], knots_[at + 1]) | std::views::reverse)
    value = value * t + coefficient;
  return value;
}

BeckmannSampler::SlopeMap BeckmannSampler::slope_map() const {
  SlopeMap map;
  map.along_x = along_x_;
  map.along_y = along_y_;
  map.one_plus_lambda_v = 1 + lambda_v();
  for (std::size_t cell = 0; cell < SlopeMap::cells; ++cell) {
    const std::array<double, 6> coefficients = hermite(knots_[cell], knots_[cell + 1]);
    for (std::size_t power = 0; power < 6; ++power)
      map.coefficients[power][cell] = static_cast<float>(coefficients[power]);
  }
  return map;
}

LobeSample BeckmannSampler::sample(double cos_azimuth, double sin_azimuth, double u_height) const {
  const double radius = std::sqrt(-std::log1p(-u_height));
  const double along = visible_slope(radius * cos_azimuth);
  // Beyond six the normal density has nothing left; and an infinite radius times zero is no number.
  const double across = std::min(radius, 7.0) * sin_azimuth;
  const Eigen::Vector3d half(alpha_x() * (along * along_x_ - across * along_y_),
                             alpha_y() * (along * along_y_ + across * along_x_), 1);
  return weighted(half.normalized());
}

}  // namespace ltc
