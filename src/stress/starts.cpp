// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/starts.h"

#include <Eigen/Geometry>
#include <limits>

#include "core/random.h"
#include "pipeline/fit_one.h"

namespace ltc {
namespace {

// Uniform: a unit quaternion uniform on the sphere of four dimensions.
Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  Random random(seed);
  Eigen::Vector4d q;
  for (double& entry : q)
    entry = random.normal();
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

Eigen::Matrix3d spoilt(StressStart start, Eigen::Matrix3d m) {
  switch (start) {
    case StressStart::scaled_down:
      return 1e-6 * m;
    case StressStart::scaled_up:
      return 1e6 * m;
    case StressStart::narrowed:
      m.leftCols<2>() *= 1e-6;
      return m;
    case StressStart::widened:
      m.leftCols<2>() *= 1e6;
      return m;
    case StressStart::reflected:
      m.col(1) = -m.col(1);
      return m;
    case StressStart::negated:
      return -m;
    case StressStart::exchanged:
      m.col(0).swap(m.col(1));
      return m;
    case StressStart::nearly_singular:
      m.col(1) = m.col(0) + 1e-9 * m.col(1);
      return m;
    case StressStart::singular:
      m.col(1).setZero();
      return m;
    case StressStart::other_hemisphere:
      m.rightCols<2>() = -m.rightCols<2>();
      return m;
    default:
      return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
}

constexpr StressStartKind all_starts[] = {
    {StressStart::solver_choice, "default", true},
    {StressStart::first_order, "first-order", true},
    {StressStart::moments, "moments", true},
    {StressStart::identity, "identity", false},
    {StressStart::random, "random", false},
    {StressStart::rotation, "rotation", false},
    {StressStart::scaled_down, "scaled 1e-6", false},
    {StressStart::scaled_up, "scaled 1e6", false},
    {StressStart::narrowed, "narrowed 1e-6", false},
    {StressStart::widened, "widened 1e6", false},
    {StressStart::reflected, "reflected", false},
    {StressStart::negated, "negated", false},
    {StressStart::exchanged, "exchanged", false},
    {StressStart::nearly_singular, "nearly singular", false},
    {StressStart::singular, "singular", false},
    {StressStart::other_hemisphere, "other hemisphere", false},
    {StressStart::not_a_number, "not a number", false},
};

}  // namespace

std::span<const StressStartKind> stress_starts() {
  return all_starts;
}

std::optional<Eigen::Matrix3d> start_matrix(StressStart start, const Lobe& lobe,
                                            std::uint64_t seed) {
  switch (start) {
    case StressStart::solver_choice:
      return std::nullopt;
    case StressStart::first_order:
      return starting_matrix(StartKind::first_order, lobe, seed);
    case StressStart::identity:
      return starting_matrix(StartKind::identity, lobe, seed);
    case StressStart::random:
      return starting_matrix(StartKind::random, lobe, seed);
    case StressStart::rotation:
      return random_rotation(seed);
    case StressStart::moments:
      return starting_matrix(StartKind::moments, lobe, seed);
    default:
      return spoilt(start, starting_matrix(StartKind::moments, lobe, seed));
  }
}

}  // namespace ltc
