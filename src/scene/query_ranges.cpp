// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/query_ranges.h"

#include <algorithm>
#include <cmath>

namespace ltc {
namespace {

// alpha_x and alpha_y of all lobes of a material.
RoughnessBox box_of(const Material& material) {
  if (const auto* box = std::get_if<RoughnessBox>(&material.roughness))
    return *box;
  const auto& perceptual = std::get<PerceptualRoughness>(material.roughness);
  const LobeRoughness low = lobe_roughness(perceptual.roughness.low, perceptual.anisotropy.low);
  const LobeRoughness high = lobe_roughness(perceptual.roughness.high, perceptual.anisotropy.high);
  return {{low.alpha_x, high.alpha_x}, {low.alpha_y, high.alpha_y}};
}

double ratio(double smaller, double larger) {
  return larger > 0 ? std::min(smaller / larger, 1.0) : 1.0;
}

QueryRange range_of(const Material& material) {
  const auto [x, y] = box_of(material);
  QueryRange range;
  range.roughness_first = std::sqrt(std::max(x.low, y.low));
  range.roughness_last = std::sqrt(std::max(x.high, y.high));
  range.lambda_first = std::min(ratio(x.low, y.high), ratio(y.low, x.high));
  if (x.low > y.high)
    range.lambda_last = ratio(y.high, x.low);
  else if (y.low > x.high)
    range.lambda_last = ratio(x.high, y.low);
  range.cos_theta_first = std::max(0.0, std::cos(material.theta_radians.high));
  range.cos_theta_last = std::cos(material.theta_radians.low);
  return range;
}

}  // namespace

std::vector<QueryRange> query_ranges(const Scene& scene) {
  std::vector<QueryRange> ranges;
  for (const Material& material : scene.materials)
    ranges.push_back(range_of(material));
  return ranges;
}

}  // namespace ltc
