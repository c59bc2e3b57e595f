// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the config's [fit] section says.
#pragma once

#include <cstdint>

#include "core/enum_names.h"
#include "fit/loss_kind.h"
#include "ltc/folded.h"
#include "ltc/horizon.h"

namespace ltc {

enum class SolverKind { gauss_newton, sgd, l3_nelder_mead };
constexpr EnumNames<SolverKind, 3> enum_names(SolverKind) {
  return {"solver",
          {{{SolverKind::gauss_newton, "gauss-newton"},
            {SolverKind::sgd, "sgd"},
            {SolverKind::l3_nelder_mead, "l3-nelder-mead"}}}};
}

// Whether big tables are fitted at some of their nodes and interpolated between them
// (interpolate/between_fits.h).
enum class InterpolationMode { automatic, off };
constexpr EnumNames<InterpolationMode, 2> enum_names(InterpolationMode) {
  return {"interpolation",
          {{{InterpolationMode::automatic, "automatic"}, {InterpolationMode::off, "off"}}}};
}

// What is fitted: an LTC, or one that is folded first (ltc/folded.h).
enum class LobeKind { single, folded };
constexpr EnumNames<LobeKind, 2> enum_names(LobeKind) {
  return {"lobe", {{{LobeKind::single, "single"}, {LobeKind::folded, "folded"}}}};
}

enum class TargetKind { weighted, rejection };
constexpr EnumNames<TargetKind, 2> enum_names(TargetKind) {
  return {"target", {{{TargetKind::weighted, "weighted"}, {TargetKind::rejection, "rejection"}}}};
}

enum class StartKind { first_order, moments, identity, random };
constexpr EnumNames<StartKind, 4> enum_names(StartKind) {
  return {"start",
          {{{StartKind::first_order, "first-order"},
            {StartKind::moments, "moments"},
            {StartKind::identity, "identity"},
            {StartKind::random, "random"}}}};
}

// Quantile Gauss-Newton, from a coarse sample set to a fine one.
struct GaussNewtonSettings {
  // By arcs (fit/arc_fit.h), numbers of samples are of the lobe alone. Sharp and thin lobes, and
  // with several starts all, are fitted on samples.
  LossKind loss = LossKind::arcs;
  int coarse_samples = 256;    // cosine samples of the coarse phase, [64, 65536]
  int coarse_directions = 16;  // projection directions of the coarse phase, [4, 4096]
  int coarse_steps = 12;       // most steps of the coarse phase, [0, 1000]
  int samples = 4096;          // cosine samples of the fine phase, [64, 65536]
  int directions = 32;         // projection directions of the fine phase, [4, 4096]
  int steps = 20;              // most steps of the fine phase, [1, 1000]
  int target_samples = 8192;   // GGX samples that the target's quantiles come from, [64, 1048576]
  // A phase ends when a step gains less than this share of the loss, [0, 1].
  double coarse_tolerance = 3e-3;
  double tolerance = 1e-4;
  // Lobes that no LTC comes near are fitted with down to a quarter of the samples: what is left of
  // their loss is not noise.
  bool adaptive = true;
  int starts = 1;  // starting points tried in the coarse phase, [1, 16]
  // A start is descended from where its loss exceeds the least of them by at most this share of it,
  // [0, 1e9].
  double start_margin = 0.5;
  int neighbour_sweeps = 0;  // how often an entry tries its neighbours' solutions, [0, 16]
};

// Algorithm 3 of Aakash et al. 2022: stochastic gradient descent, step size
// learning_rate * step_scale * step_decay^step.
struct SgdSettings {
  int steps = 10000;           // [1, 10000000]
  int samples = 2048;          // cosine and GGX samples of a step, [16, 1048576]
  int directions = 64;         // random directions of a step, [1, 4096]
  double learning_rate = 1.0;  // (0, 1000]
  double step_scale = 0.1;     // (0, 1000]
  double step_decay = 0.999;   // (0, 1]
  int averaged_steps = 1;      // the last steps whose matrices are averaged, [1, steps]
  StartKind start = StartKind::identity;
  // Descend in the entries of M as published (false), or in those of M expressed in the mirror's
  // frame and divided by the roughness (true), where lobes of every width have the same scale.
  bool scaled_variables = false;
  // Draw cosine samples and the weighted target from lattices that a random shift moves every step
  // (true), or independently as published (false). Far less noise; needs the weighted target.
  bool lattice_samples = false;
};

// Nelder and Mead's simplex on the L3 error, the method before the sliced-Wasserstein distance.
struct L3Settings {
  int samples = 1024;  // quadrature directions from the LTC, and as many from the lobe, [16, 65536]
  int evaluations = 1000;   // most evaluations of the error, [1, 1000000]
  double tolerance = 1e-5;  // ends when the simplex's errors differ by less than this share, [0, 1]
  StartKind start = StartKind::first_order;
};

struct FitSettings {
  SolverKind solver = SolverKind::gauss_newton;
  LobeKind lobe = LobeKind::single;  // folded ones by Gauss-Newton alone
  double crease = 0.4;               // h of a fold's first pair of creases, [0, 10]
  double second_crease = 0;          // of its second pair, above the first, [0, 10]; 0: none
  // Whether lobes are fitted for what is above the horizon alone; by Gauss-Newton alone.
  HorizonMode horizon = HorizonMode::clipped;
  InterpolationMode interpolation = InterpolationMode::automatic;
  TargetKind target = TargetKind::weighted;
  std::uint64_t seed = 1;
  GaussNewtonSettings gauss_newton;
  SgdSettings sgd;
  L3Settings l3;

  // None where lobes are not folded.
  Creases creases() const {
    return lobe == LobeKind::folded ? creases_at(crease, second_crease) : Creases{};
  }
};

}  // namespace ltc
