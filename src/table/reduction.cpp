// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/reduction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ltc {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;
constexpr double half_turn = std::numbers::pi;
constexpr double full_turn = 2 * std::numbers::pi;

// By so much a lobe may be beyond an axis: of a roughness or a ratio a share, of an angle radians.
constexpr double no_matter = 1e-3;

// The same azimuth in [0, 2 pi).
double wrapped(double phi_radians) {
  double phi = std::fmod(phi_radians, full_turn);
  if (phi < 0)
    phi += full_turn;
  // A tiny negative azimuth rounds to the full turn itself.
  return phi >= full_turn ? 0.0 : phi;
}

// Equation (13): the azimuth of the first quadrant, and the signs of x and y that lead back.
struct FoldedAzimuth {
  double phi_radians;
  double sign_x, sign_y;
};
FoldedAzimuth fold_azimuth(double phi_radians) {
  const double phi = wrapped(phi_radians);
  if (phi < quarter_turn)
    return {phi, 1, 1};
  if (phi < half_turn)
    return {half_turn - phi, -1, 1};
  if (phi < half_turn + quarter_turn)
    return {phi - half_turn, -1, -1};
  return {full_turn - phi, 1, -1};
}

// Equation (13) alone.
FoldedLobe mirrored(const Lobe& lobe) {
  const FoldedAzimuth azimuth = fold_azimuth(lobe.phi_radians);
  FoldedLobe folded{lobe, Eigen::Vector3d(azimuth.sign_x, azimuth.sign_y, 1).asDiagonal()};
  folded.lobe.phi_radians = azimuth.phi_radians;
  return folded;
}

// The lobe of the larger roughness turned to an azimuth.
FoldedLobe turn(const Lobe& lobe, double phi_radians) {
  // max(NaN, y) is NaN, max(x, NaN) is x.
  const double alpha =
      std::isnan(lobe.alpha_y) ? lobe.alpha_y : std::max(lobe.alpha_x, lobe.alpha_y);
  const Eigen::AngleAxisd back(wrapped(lobe.phi_radians) - phi_radians, Eigen::Vector3d::UnitZ());
  return {{alpha, alpha, lobe.theta_radians, phi_radians, lobe.model}, back.toRotationMatrix()};
}

double clamped(const Axis& axis, double value, double below, double above) {
  return value < axis.first() - below  ? axis.first()
         : value > axis.last() + above ? axis.last()
                                       : value;
}

}  // namespace

FoldedLobe fold(const Lobe& lobe) {
  FoldedLobe folded = mirrored(lobe);
  if (lobe.alpha_y > lobe.alpha_x) {
    std::swap(folded.lobe.alpha_x, folded.lobe.alpha_y);
    folded.lobe.phi_radians = quarter_turn - folded.lobe.phi_radians;
    // Equation (14) stands inside equation (13), so the swap applies first: its columns swap here.
    folded.unfold.col(0).swap(folded.unfold.col(1));
  }
  return folded;
}

double second_roughness(const Grid& grid, const Lobe& folded) {
  if (grid.layout == Layout::alphax_alphay)
    return folded.alpha_y;
  return folded.alpha_x == 0 ? 1.0 : folded.alpha_y / folded.alpha_x;
}

double clamped_to_roughness_axis(const Axis& axis, double value) {
  return clamped(axis, value, no_matter * axis.first(), no_matter * axis.last());
}

double clamped_to_angle_axis(const Axis& axis, double radians) {
  return clamped(axis, radians, no_matter, no_matter);
}

Reduction::Reduction(const Grid& grid)
    : grid_(grid),
      turns_(grid.layout == Layout::alpha_lambda && grid.phi.size() == 1 &&
             grid.lambda.size() == 1 && grid.lambda.first() == 1) {}

FoldedLobe Reduction::fold(const Lobe& lobe) const {
  if (grid_.layout == Layout::alphax_alphay)
    return mirrored(lobe);
  return turns_ ? turn(lobe, grid_.phi.first()) : ltc::fold(lobe);
}

bool Reduction::covers(const Lobe& lobe) const {
  // Of a table that turns lobes, too: one of two roughnesses is none of its own.
  const Lobe folded = turns_ ? ltc::fold(lobe).lobe : fold(lobe).lobe;
  const double second = second_roughness(grid_, folded);
  // A smaller roughness below alpha_min is raised to it at the nodes too: there, every ratio from
  // the axis' last one on is the same lobe.
  const bool has_second = clamped_to_roughness_axis(grid_.lambda, second) == second ||
                          (second > grid_.lambda.last() && folded.alpha_y <= grid_.alpha_min);
  return has_second && clamped_to_roughness_axis(grid_.alpha, folded.alpha_x) == folded.alpha_x &&
         clamped_to_angle_axis(grid_.theta, folded.theta_radians) == folded.theta_radians &&
         (turns_ || clamped_to_angle_axis(grid_.phi, folded.phi_radians) == folded.phi_radians);
}

}  // namespace ltc
