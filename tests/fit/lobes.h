// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Lobes and sample sets that the tests of the fit share.
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/ggx.h"
#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"
#include "fit/sample_sets.h"
#include "fit/sliced_wasserstein.h"

namespace ltc::test {

// The last node of the paper's theta axis.
inline constexpr double kGrazing = 0.9999 * std::numbers::pi / 2;

// Moves the azimuths of a target's lattice and leaves its heights in the middle of their strata.
// Where they stand at the upper end, the outermost of n samples is several times as far out, and
// its share of the loss of a sharp lobe, whose tails fall as 1/r^3, is as large as the rest.
inline constexpr double kMiddleShift = 1 / std::numbers::sqrt2;

// Where a fit is an ordinary problem: no roughness near zero, no grazing view.
inline std::vector<Lobe> ordinary_lobes() {
  return {{0.5, 0.5, 0.0, 0.0}, {0.8, 0.3, 0.6, 0.4}, {0.3, 0.1, 1.0, 1.2}, {1.0, 0.9, 1.2, 0.8}};
}

// The corners of what the project promises to handle.
inline std::vector<Lobe> extreme_lobes() {
  return {{1e-4, 1e-4, 0.0, 0.0},      {1e-4, 1e-4, 0.7, 0.3},   {1e-6, 1e-6, 0.3, 1.0},
          {1e-6, 1e-6, kGrazing, 0.7}, {0.5, 1e-4, 0.8, 0.5},    {1.0, 1e-6, kGrazing, 0.2},
          {1.0, 1.0, kGrazing, 0.0},   {1.0, 0.2, kGrazing, 1.5}};
}

inline std::vector<Lobe> all_lobes() {
  std::vector<Lobe> lobes = ordinary_lobes();
  for (const Lobe& lobe : extreme_lobes())
    lobes.push_back(lobe);
  return lobes;
}

inline std::string describe(const Lobe& lobe) {
  return fmt::format("alpha_x {} alpha_y {} theta {} phi {}", lobe.alpha_x, lobe.alpha_y,
                     lobe.theta_radians, lobe.phi_radians);
}

inline std::vector<Eigen::Vector3d> in_double(const CosineSet& set) {
  std::vector<Eigen::Vector3d> points(set.size());
  for (std::size_t i = 0; i < set.size(); ++i)
    points[i] = {set.x[i], set.y[i], set.z[i]};
  return points;
}

// Target samples as directions in the mirror's frame, e_z + g.
inline PointSet in_double(const TargetSamples& samples) {
  PointSet set;
  for (std::size_t i = 0; i < samples.size; ++i) {
    set.points.push_back(Eigen::Vector3d(samples.gx[i], samples.gy[i], 1.0 + samples.gz[i]));
    set.weights.push_back(samples.weight[i]);
  }
  return set;
}

// The directions of the LTC of P, as samples of a target: a planted optimum. In the mirror's frame.
inline TargetSamples planted_target(const LobeFrame& frame, const Eigen::Matrix3d& p,
                                    const CosineSet& cosines) {
  TargetSamples samples;
  samples.size = cosines.size();
  for (AlignedFloats* array : {&samples.gx, &samples.gy, &samples.gz, &samples.weight})
    array->resize(cosines.size());
  const Eigen::Matrix3d m =
      p * Eigen::Vector3d(frame.lobe.alpha_x, frame.lobe.alpha_y, 1).asDiagonal();
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    const Eigen::Vector3d f = (m * Eigen::Vector3d(cosines.x[i], cosines.y[i], cosines.z[i]));
    const double length = f.norm(), lateral = f.x() * f.x() + f.y() * f.y();
    samples.gx[i] = static_cast<float>(f.x() / length);
    samples.gy[i] = static_cast<float>(f.y() / length);
    samples.gz[i] =
        static_cast<float>(f.z() > 0 ? -lateral / (length * (length + f.z())) : f.z() / length - 1);
    samples.weight[i] = 1;
  }
  return samples;
}

}  // namespace ltc::test
