// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ltc {
namespace {

// ---- Lobes that a material can have, folded ----
//
// Folded lobes have alpha = the larger roughness, b = the smaller, lambda = b/alpha. Two kinds of
// limits bound them. The roughness itself: b in [b_low, b_high]. And the anisotropy, by the share q
// = anisotropy^2 of the way from b to 1 at which alpha stands: alpha = b + (1 - b) q, q in
// [q_low, q_high], which is b = (alpha - q)/(1 - q). Both bounds of b are bounds of lambda at a
// given alpha:
//
//   max(b_low, (alpha - q_high)/(1 - q_high))/alpha <= lambda
//   lambda <= min(b_high, (alpha - q_low)/(1 - q_low))/alpha
//
// Over alpha, b/alpha falls and (1 - q/alpha)/(1 - q) rises. So lambda is least where the two lower
// bounds cross, greatest where the two upper ones do, or as near to there as alpha may be.
struct FoldedLobes {
  Interval alpha;
  Interval smaller;  // b
  Interval share;    // q; [0, 1] does not bound lambda beyond [0, 1]
};

double alpha_of(double smaller, double share) {
  return std::lerp(smaller, 1.0, share);  // as in lobe_roughness, bit for bit
}

// b/alpha; its limit from above at alpha = 0. At most 1.
double ratio_by_smaller(double smaller, double alpha) {
  return smaller == 0 ? 0.0 : std::min(1.0, smaller / alpha);
}

// (alpha - q)/(1 - q)/alpha, for q < 1; its limit from above at alpha = 0.
double ratio_by_share(double share, double alpha) {
  return share == 0 ? 1.0 : (alpha - share) / ((1 - share) * alpha);
}

// The lambda of the lobes whose alpha > 0 lies in `alpha`, a part of lobes.alpha.
Interval lambda_range(const FoldedLobes& lobes, const Interval& alpha) {
  if (lobes.share.high == 0)
    return {1, 1};
  const double low_cross = alpha_of(lobes.smaller.low, lobes.share.high);
  const double low_at = std::clamp(low_cross, alpha.low, alpha.high);
  double low = low_at <= low_cross ? ratio_by_smaller(lobes.smaller.low, low_at)
                                   : ratio_by_share(lobes.share.high, low_at);
  const double high_cross = alpha_of(lobes.smaller.high, lobes.share.low);
  const double high_at = std::clamp(high_cross, alpha.low, alpha.high);
  const double high = high_at >= high_cross ? ratio_by_smaller(lobes.smaller.high, high_at)
                                            : ratio_by_share(lobes.share.low, high_at);
  return {low, high};
}

// The lobes of a box with alpha_x >= alpha_y, and the others, their axes swapped.
std::vector<FoldedLobes> folded_lobes(const RoughnessBox& box) {
  std::vector<FoldedLobes> parts;
  const auto add = [&](const Interval& larger, const Interval& smaller) {
    const Interval alpha{std::max(larger.low, smaller.low), larger.high};
    if (alpha.low <= alpha.high)
      parts.push_back({alpha, smaller, {0, 1}});
  };
  add(box.alpha_x, box.alpha_y);
  add(box.alpha_y, box.alpha_x);
  return parts;
}

std::vector<FoldedLobes> folded_lobes(const PerceptualRoughness& range) {
  const auto squared = [](const Interval& x) { return Interval{x.low * x.low, x.high * x.high}; };
  const Interval smaller = squared(range.roughness), share = squared(range.anisotropy);
  return {{{alpha_of(smaller.low, share.low), alpha_of(smaller.high, share.high)}, smaller, share}};
}

// ---- Nodes that they touch ----

// First and last node with a weight other than 0 for some value of the interval.
struct NodeRange {
  std::size_t first, last;
};
NodeRange nodes_touched(const Axis& axis, const Interval& values) {
  return {static_cast<std::size_t>(std::floor(axis.position(values.low))),
          static_cast<std::size_t>(std::ceil(axis.position(values.high)))};
}

// Collects what the materials touch. Every azimuth is asked for, and folding leads it into [0,
// pi/2], so phi is left out until the end.
class Marker {
 public:
  explicit Marker(const Grid& grid)
      : grid_(grid),
        phi_(nodes_touched(grid.phi, {0, std::numbers::pi / 2})),
        touched_(grid.size(), false) {}

  // Along alpha in pieces between the nodes: within a piece, every lambda meets both its nodes.
  // Beyond the ends of the axis, where a look-up clamps alpha but not lambda, there are pieces too.
  void mark(const FoldedLobes& lobes, const NodeRange& theta) {
    // At zero roughness every lambda is the same lobe, and look-ups take 1.
    if (lobes.alpha.low == 0)
      mark(nodes_touched(grid_.alpha, {0, 0}), nodes_touched(grid_.lambda, {1, 1}), theta);
    if (lobes.alpha.low == lobes.alpha.high && lobes.alpha.low > 0)
      mark_piece(lobes, lobes.alpha, theta);
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= grid_.alpha.size(); ++i) {
      const double begin = i == 0 ? -unbounded : grid_.alpha.nodes[i - 1];
      const double end = i == grid_.alpha.size() ? unbounded : grid_.alpha.nodes[i];
      const Interval piece{std::max(begin, lobes.alpha.low), std::min(end, lobes.alpha.high)};
      if (piece.low < piece.high)
        mark_piece(lobes, piece, theta);
    }
  }

  std::vector<bool> needed_entries() const {
    std::vector<bool> needed(grid_.size(), false);
    for (std::size_t flat = 0; flat < needed.size(); ++flat) {
      NodeIndex node = grid_.node(flat);
      const bool in_range = phi_.first <= node.phi && node.phi <= phi_.last;
      node.phi = phi_.first;
      needed[flat] = in_range && touched_[grid_.flat(node)];
    }
    return needed;
  }

 private:
  void mark_piece(const FoldedLobes& lobes, const Interval& alpha, const NodeRange& theta) {
    mark(nodes_touched(grid_.alpha, alpha), nodes_touched(grid_.lambda, lambda_range(lobes, alpha)),
         theta);
  }

  void mark(const NodeRange& alpha, const NodeRange& lambda, const NodeRange& theta) {
    for (std::size_t a = alpha.first; a <= alpha.last; ++a)
      for (std::size_t l = lambda.first; l <= lambda.last; ++l)
        for (std::size_t t = theta.first; t <= theta.last; ++t)
          touched_[grid_.flat({a, l, t, phi_.first})] = true;
  }

  const Grid& grid_;
  const NodeRange phi_;
  std::vector<bool> touched_;  // at the first phi
};

}  // namespace

std::vector<bool> needed_entries(const Scene& scene, const Grid& grid) {
  Marker marker(grid);
  for (const Material& material : scene.materials) {
    const NodeRange theta = nodes_touched(grid.theta, material.theta_radians);
    const auto parts = std::visit([](const auto& roughness) { return folded_lobes(roughness); },
                                  material.roughness);
    for (const FoldedLobes& lobes : parts)
      marker.mark(lobes, theta);
  }
  return marker.needed_entries();
}

}  // namespace ltc
