// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// One lobe, evaluated and sampled in double precision. Densities are per steradian.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "brdf/lattice.h"
#include "brdf/lobe.h"

namespace ltc {

// One light direction that a point of the unit square gives.
struct LobeSample {
  // omega_l - mirror, accurate relative to the width of the lobe however sharp it is.
  Eigen::Vector3d offset;
  Eigen::Vector3d omega_l;
  double v_dot_h = 0;  // cosine between the view direction and the half vector
  // What is left of the cosine-weighted BRDF over the density of such samples, in [0, 1]. Zero
  // below the horizon. The mean over all samples is the amplitude.
  double weight = 0;
};

// Of one light direction: the cosine-weighted BRDF with F = 1, zero below the horizon, and the
// density that samples have before any is weighted or rejected, some of it below the horizon.
struct LobeDensities {
  double brdf_cosine = 0, sampling = 0;
};

// Light directions of a lobe. The distribution is proportional to the cosine-weighted BRDF when
// each is counted with its weight.
struct WeightedSamples {
  Eigen::ArrayX3d offset;  // omega_l - mirror, one row a sample, columns x, y, z contiguous
  Eigen::ArrayXd weight;   // in [0, 1]; their mean is the amplitude
  Eigen::Vector3d mirror;  // (-vx, -vy, vz): omega_l = mirror + offset
};

class LobeSampler {
 public:
  explicit LobeSampler(const Eigen::Vector3d& omega_v)
      : omega_v_(omega_v), mirror_(-omega_v.x(), -omega_v.y(), omega_v.z()) {}
  virtual ~LobeSampler() = default;

  const Eigen::Vector3d& omega_v() const { return omega_v_; }
  // Where a smooth surface would reflect to: (-vx, -vy, vz).
  const Eigen::Vector3d& mirror() const { return mirror_; }

  // At a unit direction, and at one relative to the mirror direction, which loses no digits in
  // lobes as narrow as 1e-6.
  virtual LobeDensities densities(const Eigen::Vector3d& omega_l) const = 0;
  virtual LobeDensities densities_at_offset(const Eigen::Vector3d& offset) const {
    return densities(mirror_ + offset);
  }

  double brdf_cosine(const Eigen::Vector3d& omega_l) const {
    return densities(omega_l).brdf_cosine;
  }
  double brdf_cosine_at_offset(const Eigen::Vector3d& offset) const {
    return densities_at_offset(offset).brdf_cosine;
  }

  // A light direction from two uniforms on [0, 1), the first as the cosine and sine of as many
  // turns: a map that is continuous in both and periodic in the azimuth, so that lattices do well;
  // where the lobe has heavy tails (LobeModel::tails), they are at u_height near 1.
  virtual LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const = 0;
  LobeSample sample(double u_azimuth, double u_height) const {
    const double azimuth = 2 * std::numbers::pi * u_azimuth;
    return sample(std::cos(azimuth), std::sin(azimuth), u_height);
  }
  LobeSample sample(const LatticePoint& point) const {
    return sample(std::cos(point.azimuth_radians), std::sin(point.azimuth_radians), point.height);
  }

  // One sample a lattice point. Reuses the memory of `samples`.
  virtual void sample_all(const SampleLattice& lattice, WeightedSamples& samples) const;

  // A light direction with density proportional to the cosine-weighted BRDF: algorithm 1 of Aakash
  // et al. 2022. `uniform()` returns independent uniforms on [0, 1).
  template <class Uniform>
  LobeSample sample_rejection(Uniform&& uniform) const {
    for (;;) {
      const double u_azimuth = uniform();
      const double u_height = uniform();
      const LobeSample found = sample(u_azimuth, u_height);
      if (uniform() < found.weight)
        return found;
    }
  }

 protected:
  // sample_all by `one`, for those whose samples are quicker than a virtual call.
  template <class One>
  void fill(const SampleLattice& lattice, WeightedSamples& samples, One&& one) const {
    const auto count = static_cast<Eigen::Index>(lattice.size());
    samples.offset.resize(count, 3);
    samples.weight.resize(count);
    samples.mirror = mirror_;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const LobeSample found =
          one(lattice.cos_azimuth[at], lattice.sin_azimuth[at], lattice.height[at]);
      samples.offset.row(i) = found.offset.transpose();
      samples.weight[i] = found.weight;
    }
  }

 private:
  Eigen::Vector3d omega_v_, mirror_;
};

}  // namespace ltc
