// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the fit, the judges, the albedo and the renderer need to know of a BRDF. A model is one file
// that implements this and one line in the list of lobe_model.cpp, or one call of add_lobe_model;
// `brdf` in a config then chooses it.
//
// Tables rely on symmetries that every model must have: lobes are mirrored with the view in the
// planes x = 0 and y = 0, and where alpha_x = alpha_y, they turn with it about z.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/albedo.h"
#include "brdf/lattice.h"
#include "brdf/lobe_sampler.h"

namespace ltc {

// Samples of a lobe as offsets from its axis, in a frame whose z that is: what the fit's kernels
// take. Weights are relative to one another.
struct TargetSamples {
  AlignedFloats gx, gy, gz, weight;
  std::size_t size = 0;     // multiple of 16
  bool heavy_tails = true;  // LobeModel::heavy_tails of the lobe

  void reserve(std::size_t count);
};

class LobeModel {
 public:
  virtual ~LobeModel() = default;

  // As configs and files have it; and as people read it above a picture.
  virtual std::string_view name() const = 0;
  virtual std::string_view label() const { return name(); }

  virtual std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const = 0;

  // The hot ones, by the sampler where a model has nothing faster: weighted samples on a lattice in
  // the frame of `rotation` (its columns the frame's axes, as frame() has them), and the integrals
  // of albedo.h.
  virtual void sample_target(const Lobe& lobe, const Eigen::Matrix3d& rotation,
                             const TargetLattice& lattice, TargetSamples& samples) const;
  virtual Albedo albedo(const Lobe& lobe, const AlbedoRule& rule) const;

  // Where a lobe is fitted: Q, a rotation whose last column is the axis that samplers count from,
  // and A, the lengths that the columns of M are divided by, so that P = Q^T M A^-1 is of the order
  // of 1 (fit/lobe_frame.h). The least rotation to the mirror direction, and (alpha_x, alpha_y, 1).
  virtual Eigen::Matrix3d frame(const Lobe& lobe) const;
  virtual Eigen::Vector3d widths(const Lobe& lobe) const;

  // M A^-1 to first order in the slopes, up to a rotation about the axis: a clamped cosine's slopes
  // sent to where microfacets of such slopes reflect. Where a lobe is no mirror's, a likely start.
  virtual Eigen::Matrix3d first_order(const Lobe& lobe) const;
  // Up to which larger roughness over the squared cosine of the view's elevation that matrix needs
  // no fit; 0 where it always does.
  virtual double exact_first_order() const { return 0; }

  // Whether the lobe's slopes have tails without a variance, whose quantiles grow as tau^(-1/2)
  // with the mass tau beyond them, as GGX has. Then sharp lobes are fitted with graded samples.
  virtual bool heavy_tails() const { return false; }

  // Whether lobes gather about the mirror direction, as those of every microfacet model do: so that
  // fields, folds and the reading of others' tables make sense of them.
  virtual bool about_mirror() const { return true; }

  // By how much fits may tilt the horizon, which is what they put below it and lights lose: the most
  // of |(M20, M21)|/|M22|, in the frame. A lobe along the horizon, seen from above, is as near
  // beyond it as before it for the sliced Wasserstein distance.
  virtual double most_tilt() const { return std::numeric_limits<double>::infinity(); }

  // Whether no lobe reflects more light than it gets, so that amplitudes are at most 1.
  virtual bool conserves_energy() const { return true; }

  // The least roughness of its lobes.
  virtual double least_alpha() const { return 0; }
  // Throws InputError, in one line, for a lobe that the model has no values for.
  virtual void require(const Lobe&) const {}
};

// The one of this name, which may be that of a file of values (brdf/measured.h). Throws InputError,
// naming those there are.
const LobeModel& lobe_model(std::string_view name);
const std::vector<const LobeModel*>& lobe_models();

// For programs that bring a model of their own: it must live as long as the program does. Before
// other threads ask for models.
void add_lobe_model(const LobeModel& model);

}  // namespace ltc
