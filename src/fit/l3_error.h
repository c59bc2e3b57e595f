// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The point-wise distance that older fits minimise: Heitz et al. 2016, "Real-Time Polygonal-Light
// Shading with Linearly Transformed Cosines", section 3.
//
// With the densities p of the LTC and q of the lobe, both normalised, it is
//     (int |p - q|^3 d omega)^(1/3),
// estimated by multiple importance sampling: n directions drawn from p and n from a density s that
// covers the lobe, each counting |p - q|^3 / (p + s).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "brdf/lattice.h"
#include "brdf/lobe.h"
#include "fit/sample_sets.h"

namespace ltc {

class L3Error {
 public:
  // Densities per steradian at a unit direction: q of the lobe, and s of the samples.
  struct Densities {
    double lobe = 0, sampling = 0;
  };
  using Target = std::function<Densities(const Eigen::Vector3d& omega)>;

  // `samples` are directions of density s. Keeps a reference to `cosines`.
  L3Error(Target target, std::vector<Eigen::Vector3d> samples, const CosineSet& cosines);

  // The distance of the LTC of M, whose sign and scale do not matter; infinite where M is not
  // finite or has no inverse.
  double operator()(const Eigen::Matrix3d& matrix) const;

 private:
  struct Sample {
    Eigen::Vector3d omega;
    Densities densities;
  };
  Target target_;
  std::vector<Sample> samples_;
  const CosineSet& cosines_;
};

// The distance to a lobe of the given amplitude (the integral of its cosine-weighted BRDF).
L3Error lobe_l3_error(const Lobe& lobe, double amplitude, const TargetLattice& lattice,
                      const CosineSet& cosines);

}  // namespace ltc
