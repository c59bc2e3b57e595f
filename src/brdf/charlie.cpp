// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/charlie.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/gauss_rule.h"

namespace ltc {
namespace {

// The paper's l(x): a/(1 + b x^c) + d x + e, its numbers between those of alpha = 1 and alpha = 0.
double fitted_shadowing(double alpha, double x) {
  const double t = (1 - alpha) * (1 - alpha);
  const auto between = [t](double of_one, double of_zero) {
    return of_one + t * (of_zero - of_one);
  };
  const double a = between(21.5473, 25.3245), b = between(3.82987, 3.32435);
  const double c = between(0.19823, 0.16801), d = between(-1.97760, -1.27393);
  const double e = between(-4.32054, -4.85967);
  return a / (1 + b * std::pow(x, c)) + d * x + e;
}

// Cells of light, even in the cube root of the height: sheen of roughness alpha is at heights of
// about alpha. Within a cell a density that falls by its exponential is at most some times its
// mean.
constexpr std::size_t rows = 32, columns = 40;
constexpr double room = 1.5;  // of weights within a cell over those at its corners

// By what lobes fitted for lights alone have, seen from above: hardly more at the least roughness,
// and wide lobes stay below it by themselves.
constexpr double most_sheen_tilt = 0.2;

}  // namespace

// sin^2 = (Hx^2 + Hy^2)/|H|^2: of sheen at the horizon 1 - z^2 would do as well, not from above.
double charlie_ndf(double alpha, const Eigen::Vector3d& omega_h) {
  const double sine_squared = omega_h.head<2>().squaredNorm() / omega_h.squaredNorm();
  return (2 + 1 / alpha) * std::pow(sine_squared, 0.5 / alpha) / (2 * std::numbers::pi);
}

double charlie_lambda(double alpha, double cosine) {
  const double z = std::abs(cosine);
  return z < 0.5 ? std::exp(fitted_shadowing(alpha, z))
                 : std::exp(2 * fitted_shadowing(alpha, 0.5) - fitted_shadowing(alpha, 1 - z));
}

CharlieSampler::CharlieSampler(const Lobe& lobe, SheenVisibility visibility)
    : LobeSampler(lobe.omega_v(), Eigen::Vector3d::UnitZ()),
      visibility_(visibility),
      alpha_(lobe.alpha_x),
      lambda_v_(charlie_lambda(alpha_, omega_v().z())),
      along_(omega_v().head<2>().norm() > 0 ? omega_v().head<2>().normalized().eval()
                                            : Eigen::Vector2d::UnitX()),
      cells_(cells()),
      most_weight_(room * cells_.total() * cells_.steepest()) {}

LightCells CharlieSampler::cells() const {
  std::vector<double> heights, azimuths, values;
  for (std::size_t i = 0; i <= rows; ++i) {
    const double t = 1 - static_cast<double>(i) / rows;
    heights.push_back(t * t * t);
  }
  for (std::size_t j = 0; j <= columns; ++j)
    azimuths.push_back(2 * std::numbers::pi * static_cast<double>(j) / columns);
  for (const double height : heights) {
    // At the horizon itself nothing comes back, and just above it much.
    const double seen = std::max(height, 1e-6);
    for (std::size_t j = 0; j <= columns; ++j)
      values.push_back(j <= columns / 2 ? brdf_cosine_of(direction(seen, azimuths[j]))
                                        : values[values.size() - 2 * j + columns]);
  }
  return {std::move(heights), std::move(azimuths), std::move(values), CellMeasure::solid_angle};
}

Eigen::Vector3d CharlieSampler::direction(double height, double azimuth) const {
  const double sine = std::sqrt((1 - height) * (1 + height));
  const double x = sine * std::cos(azimuth), y = sine * std::sin(azimuth);
  return {along_.x() * x - along_.y() * y, along_.y() * x + along_.x() * y, height};
}

double CharlieSampler::brdf_cosine_of(const Eigen::Vector3d& omega_l) const {
  const double vz = omega_v().z(), lz = omega_l.z();
  if (!(lz > 0))
    return 0;
  const double ndf = charlie_ndf(alpha_, omega_v() + omega_l);
  if (visibility_ == SheenVisibility::ashikhmin)
    return ndf * lz / (4 * (vz + lz - vz * lz));
  return ndf / ((1 + lambda_v_ + charlie_lambda(alpha_, lz)) * 4 * vz);
}

LobeDensities CharlieSampler::densities(const Eigen::Vector3d& omega_l) const {
  if (!(omega_l.z() > 0))
    return {};
  const double azimuth = std::atan2(along_.x() * omega_l.y() - along_.y() * omega_l.x(),
                                    along_.x() * omega_l.x() + along_.y() * omega_l.y());
  return {brdf_cosine_of(omega_l), cells_.density(cells_.spot_of(omega_l.z(), azimuth))};
}

LobeSample CharlieSampler::sample(double cos_azimuth, double sin_azimuth, double u_height) const {
  const LightCells::Spot spot = cells_.draw(cos_azimuth, sin_azimuth, u_height);
  const Eigen::Vector3d omega_l = direction(spot.height, spot.azimuth);
  return sample_about_normal(omega_v(), omega_l, brdf_cosine_of(omega_l), cells_.density(spot));
}

Albedo CharlieSampler::albedo(std::size_t points) const {
  const auto heights = static_cast<std::size_t>(std::sqrt(static_cast<double>(points)) / 2) + 2;
  const std::size_t azimuths = 2 * heights;
  static thread_local std::vector<GaussNode> nodes;
  if (nodes.size() != heights)
    nodes = gauss_nodes_of_unit(heights);
  Albedo sum;
  for (const auto& [t, weight] : nodes) {
    const double height = std::pow(t, 6);
    const double share =
        weight * 6 * std::pow(t, 5) * 2 * std::numbers::pi / static_cast<double>(azimuths);
    for (std::size_t j = 0; j < azimuths; ++j) {
      const Eigen::Vector3d l =
          direction(height, std::numbers::pi * (static_cast<double>(j) + 0.5) /
                                static_cast<double>(azimuths));
      const double value = share * brdf_cosine_of(l);
      const Eigen::Vector3d half = omega_v() + l;
      sum.amplitude += value;
      sum.fresnel += value * std::pow(1 - omega_v().dot(half) / half.norm(), 5);
    }
  }
  return sum;
}

namespace {

class CharlieModel final : public LobeModel {
 public:
  CharlieModel(std::string_view name, SheenVisibility visibility)
      : name_(name), visibility_(visibility) {}

  std::string_view name() const override { return name_; }
  std::string_view label() const override {
    return visibility_ == SheenVisibility::charlie ? "Charlie" : "Charlie (Ashikhmin)";
  }
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    require(lobe);
    return std::make_unique<CharlieSampler>(lobe, visibility_);
  }

  // By Gauss's rule in the sixth root of the height, which makes the fitted shadowing smooth, and
  // evenly in the azimuth; of samples on cells a lattice would make too little.
  Albedo albedo(const Lobe& lobe, const AlbedoRule& rule) const override {
    require(lobe);
    return CharlieSampler(lobe, visibility_).albedo(rule.size());
  }

  Eigen::Matrix3d frame(const Lobe&) const override { return Eigen::Matrix3d::Identity(); }
  Eigen::Vector3d widths(const Lobe&) const override { return Eigen::Vector3d::Ones(); }
  // Seen from above the light is at the height of about alpha, where a clamped cosine widened by
  // 1/alpha has it.
  Eigen::Matrix3d first_order(const Lobe& lobe) const override {
    const double width = 1 / std::sqrt(lobe.alpha_x);
    return Eigen::Vector3d(width, width, 1).asDiagonal();
  }
  bool about_mirror() const override { return false; }
  double most_tilt() const override { return most_sheen_tilt; }
  bool conserves_energy() const override { return false; }
  double least_alpha() const override { return least_sheen_alpha; }

  void require(const Lobe& lobe) const override {
    if (lobe.alpha_x != lobe.alpha_y)
      throw InputError(
          fmt::format("BRDF \"{}\" of the roughnesses {} and {}; expected one (lambda "
                      "= 1): it is isotropic",
                      name_, lobe.alpha_x, lobe.alpha_y));
    if (!(lobe.alpha_x >= least_sheen_alpha && lobe.alpha_x <= 1))
      throw InputError(
          fmt::format("BRDF \"{}\" of the roughness {}; expected at least {}, at most 1", name_,
                      lobe.alpha_x, least_sheen_alpha));
  }

 private:
  std::string_view name_;
  SheenVisibility visibility_;
};

}  // namespace

const LobeModel& charlie(SheenVisibility visibility) {
  static const CharlieModel by_charlie("charlie", SheenVisibility::charlie);
  static const CharlieModel by_ashikhmin("charlie-ashikhmin", SheenVisibility::ashikhmin);
  return visibility == SheenVisibility::charlie ? by_charlie : by_ashikhmin;
}

}  // namespace ltc
