// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/lobe_class.h"

#include <algorithm>

#include "brdf/lobe_model.h"

namespace ltc {
namespace {

// Above it equally weighted samples do as well, in less time: the published table's first node
// beyond the mirror, 1/7, among them.
constexpr double sharp_alpha = 0.12;

constexpr double least_usual_alpha = 0.9999e-4, grazing_cosine = 1.4e-4;

double larger_roughness(const LobeFrame& frame) {
  return std::max(frame.lobe.alpha_x, frame.lobe.alpha_y);
}

}  // namespace

bool first_order_is_exact(const LobeFrame& frame) {
  const double cosine = frame.omega_v.z();
  return larger_roughness(frame) / (cosine * cosine) < frame.lobe.model->exact_first_order();
}

bool is_sharp(const LobeFrame& frame) {
  return frame.lobe.model->heavy_tails() && larger_roughness(frame) < sharp_alpha;
}

bool is_extreme(const LobeFrame& frame) {
  return std::min(frame.lobe.alpha_x, frame.lobe.alpha_y) < least_usual_alpha ||
         frame.omega_v.z() < grazing_cosine;
}

}  // namespace ltc
