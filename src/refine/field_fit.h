// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The fit of a field: which terms it has, and their coefficients.
//
// Least squares to a few hundred fitted lobes, by the curvature of each one's loss, give a start of
// low degree. From there Gauss-Newton steps on the losses of thousands of look-ups
// (field_system.h), first over a pool of terms larger than what is asked for; then those that buy
// least are taken away (field_terms.h), in two rounds, and steps over those left end it. Losses are
// those of the coefficients as they will be stored, so that their rounding is fitted too. Look-ups
// that are not fitted to decide which iterate is the best.
#pragma once

#include <cstddef>
#include <vector>

#include "core/run_context.h"
#include "field/field.h"
#include "refine/field_settings.h"
#include "refine/refine_settings.h"

namespace ltc {

struct FieldReport {
  std::size_t queries = 0;  // fitted to
  std::size_t pool = 0;     // terms of the matrix to choose from
  double loss = 0;          // mean relative loss of the held-out queries
  double whole_loss = 0;    // of a contraction: that of the field it is made from
  int steps = 0;
  double amplitude_error = 0, fresnel_error = 0;            // mean, over the queries
  double amplitude_error_most = 0, fresnel_error_most = 0;  // largest
};

// `asked` are the ranges to draw queries from in turn, at least one; `edge_share` of them are
// spread over the whole domain (theta to `last_theta_radians`). Throws InputError where no field of
// the size allowed reaches the loss that is asked for, Interrupted when a stop is asked for. The
// same bits for any number of threads.
Field fit_field(double alpha_min, const LobeModel& model, const std::vector<QueryRange>& asked,
                const FieldSettings& settings, const RefineSettings& judging, const RunContext& run,
                FieldReport* report = nullptr);

// The field contracted to one material, alpha_x >= alpha_y >= its alpha_min: of theta and phi
// alone, at most `size` numbers, nearly half of them for amplitude and Fresnel term. Terms are
// chosen, and stepped on, as above. Coefficients are halves. Throws Interrupted.
Field contracted_field(const Field& field, double alpha_x, double alpha_y, std::size_t size,
                       const RunContext& run, FieldReport* report = nullptr);

std::size_t field_fit_memory_bytes(const FieldSettings& settings, const QuerySampling& sampling);

}  // namespace ltc
