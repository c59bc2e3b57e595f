// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The judge of what a renderer sees: the light that a lobe takes from random rectangles about it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/lobe.h"
#include "brdf/lobe_sampler.h"
#include "ltc/folded.h"
#include "ltc/horizon.h"

namespace ltc {

struct AreaLightSettings {
  std::size_t quads = 64;       // random rectangles a lobe, >= 1
  std::size_t samples = 16384;  // weighted samples of the lobe, >= 64, in two independent halves
  std::uint64_t seed = 20220712;
  HorizonMode horizon = HorizonMode::clipped;  // of the lobes that are judged
};

// Over the rectangles of one lobe, all in units of the light that the whole lobe reflects.
struct AreaLightError {
  double mean_absolute = 0;  // |LTC - GGX|
  double largest = 0;
  double standard_error = 0;  // of the sampled GGX integral, root mean square over the rectangles
};

// A rectangle is flat, at distance 1 from the shaded point, perpendicular to its central direction
// and turned about it at random. Its central direction is a sample of the lobe; each of its half
// sides is the lobe's mean distance from its mean direction times a factor whose logarithm is
// uniform from log(1/2) to log(2). All six choices are made by one low-discrepancy sequence, of
// which every draw takes a part of its own: rectangles are spread evenly about each lobe and over
// all lobes, and do not depend on the samples.
class AreaLightJudge {
 public:
  // Throws InputError for settings out of range.
  explicit AreaLightJudge(const AreaLightSettings& settings = {});

  // Draws the rectangles and integrates GGX (F = 1) over them; before anything below. The same lobe
  // and draw get the same rectangles, whatever came before. Rectangles of one draw stand alike
  // about every lobe, so a mean over lobes wants another draw for each, as their errors then
  // cancel.
  void set_lobe(const Lobe& lobe, std::uint64_t draw = 0);

  // The error of an LTC, folded or not, integrated exactly (equation 11 of Heitz et al. 2016),
  // times `amplitude` (the lobe's own if empty, so that only the lobe's shape counts). Light below
  // the horizon is cut off, as GGX reflects none of it, and the rest scaled up if the settings say
  // so. NaN for a matrix or an amplitude that is not finite, or a matrix without an inverse.
  AreaLightError error(const LtcLobe& ltc, std::optional<double> amplitude = std::nullopt) const;

  // What is judged against: corners of the rectangles, relative to the shaded point in the tangent
  // frame, and the share of the lobe's light that comes from each.
  using Quad = std::array<Eigen::Vector3d, 4>;
  const std::vector<Quad>& quads() const { return quads_; }
  const std::vector<double>& fractions() const { return fractions_; }
  double amplitude() const { return amplitude_; }  // of the lobe

 private:
  void draw_quads(const LobeSampler& sampler, std::uint64_t draw);

  AreaLightSettings settings_;
  std::array<SampleLattice, 2> lattices_;
  std::array<WeightedSamples, 2> samples_;
  std::vector<Quad> quads_;
  std::vector<double> fractions_;
  double amplitude_ = 0, standard_error_ = 0;
};

}  // namespace ltc
