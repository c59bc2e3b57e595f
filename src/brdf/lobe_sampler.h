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
  // omega_l - LobeSampler::axis, accurate relative to the width of the lobe however sharp it is.
  Eigen::Vector3d offset;
  Eigen::Vector3d omega_l;
  double v_dot_h = 0;  // cosine between the view direction and the half vector
  // What is left of the cosine-weighted BRDF over the density of such samples, in [0,
  // LobeSampler::most_weight]. Zero below the horizon. The mean over all samples is the amplitude.
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
  Eigen::ArrayX3d offset;  // omega_l - axis, one row a sample, columns x, y, z contiguous
  Eigen::ArrayXd weight;   // their mean is the amplitude
  Eigen::Vector3d axis;    // the sampler's: omega_l = axis + offset
};

class LobeSampler {
 public:
  // Of lobes about the mirror direction (-vx, -vy, vz), and about any other.
  explicit LobeSampler(const Eigen::Vector3d& omega_v)
      : LobeSampler(omega_v, {-omega_v.x(), -omega_v.y(), omega_v.z()}) {}
  LobeSampler(const Eigen::Vector3d& omega_v, const Eigen::Vector3d& axis)
      : omega_v_(omega_v), axis_(axis) {}
  virtual ~LobeSampler() = default;

  const Eigen::Vector3d& omega_v() const { return omega_v_; }
  // Whence offsets are counted: the third column of LobeModel::frame.
  const Eigen::Vector3d& axis() const { return axis_; }

  // At a unit direction, and at one relative to the axis, which loses no digits in lobes as narrow
  // as 1e-6.
  virtual LobeDensities densities(const Eigen::Vector3d& omega_l) const = 0;
  virtual LobeDensities densities_at_offset(const Eigen::Vector3d& offset) const {
    return densities(axis_ + offset);
  }

  // Not below the weight of any sample.
  virtual double most_weight() const { return 1; }

  double brdf_cosine(const Eigen::Vector3d& omega_l) const {
    return densities(omega_l).brdf_cosine;
  }
  double brdf_cosine_at_offset(const Eigen::Vector3d& offset) const {
    return densities_at_offset(offset).brdf_cosine;
  }

  // A light direction from two uniforms on [0, 1), the first as the cosine and sine of as many
  // turns: a map that is continuous in both and periodic in the azimuth, so that lattices do well;
  // where the lobe has heavy tails (LobeModel::heavy_tails), they are at u_height near 1.
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
      if (uniform() * most_weight() < found.weight)
        return found;
    }
  }

 protected:
  // The view direction reflected about a unit microfacet normal on or above the horizon, of weight
  // zero, for a lobe about the mirror direction m. l = 2 (v.h) h - v and m = (-vx, -vy, vz), so
  //   l - m = 2 ((v.h) hx, (v.h) hy, (v.h) hz - vz),
  //   (v.h) hz - vz = (v.h - vz) hz + vz (hz - 1),  v.h - vz = vx hx + vy hy + vz (hz - 1),
  // with hz - 1 = -(hx^2 + hy^2)/(1 + hz): every term is as small as the lobe is narrow.
  LobeSample reflected(const Eigen::Vector3d& omega_h) const {
    const double hz_minus_one =
        -(omega_h.x() * omega_h.x() + omega_h.y() * omega_h.y()) / (1 + omega_h.z());
    const double vz = omega_v_.z();
    const double v_dot_h_minus_vz =
        omega_v_.x() * omega_h.x() + omega_v_.y() * omega_h.y() + vz * hz_minus_one;
    LobeSample sample;
    sample.v_dot_h = vz + v_dot_h_minus_vz;
    sample.offset = 2 * Eigen::Vector3d(sample.v_dot_h * omega_h.x(), sample.v_dot_h * omega_h.y(),
                                        v_dot_h_minus_vz * omega_h.z() + vz * hz_minus_one);
    sample.omega_l = axis_ + sample.offset;
    return sample;
  }

  // sample_all by `one`, for those whose samples are quicker than a virtual call.
  template <class One>
  void fill(const SampleLattice& lattice, WeightedSamples& samples, One&& one) const {
    const auto count = static_cast<Eigen::Index>(lattice.size());
    samples.offset.resize(count, 3);
    samples.weight.resize(count);
    samples.axis = axis_;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const LobeSample found =
          one(lattice.cos_azimuth[at], lattice.sin_azimuth[at], lattice.height[at]);
      samples.offset.row(i) = found.offset.transpose();
      samples.weight[i] = found.weight;
    }
  }

 private:
  Eigen::Vector3d omega_v_, axis_;
};

}  // namespace ltc
