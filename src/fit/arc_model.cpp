// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/arc_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace ltc {
namespace {

// Of the smaller over the larger roughness, below which lobes want more nodes along an arc.
constexpr double thin = 0.3, thinnest = 0.08;
constexpr std::size_t more_for_thin = 2, more_for_thinnest = 4;

// Thresholds are soft over this share of the length that they stand for: counted so, few samples
// tell a lobe's distribution with a fifth less noise.
constexpr double soft_share = 0.1;

constexpr int far_octaves = 10;

// The pairs (d, t); those beyond the last one have no length.
kernels::ArcPairs make_pairs(const Eigen::Matrix3d& turn, const ArcView& view,
                             ArcWorkspace& workspace) {
  const ArcRule& rule = view.rule;
  const std::size_t size = kernels::padded_to_lanes(view.directions.size() * rule.thresholds());
  for (AlignedVector<double>* array :
       {&workspace.dx, &workspace.dy, &workspace.dz, &workspace.t, &workspace.length})
    array->resize(size);
  std::size_t i = 0;
  for (std::size_t k = 0; k < view.directions.size(); ++k) {
    const Eigen::Vector3d d = view.directions[k].cast<double>(), turned = turn * d;
    const auto centre = static_cast<double>(view.target.along[k].centre);
    const auto scale = static_cast<double>(view.target.along[k].scale);
    for (std::size_t j = 0; j < rule.thresholds(); ++j, ++i) {
      workspace.dx[i] = turned.x();
      workspace.dy[i] = turned.y();
      workspace.dz[i] = turned.z();
      const double t = d.z() + (centre + scale * rule.z()[j]);
      workspace.t[i] = std::copysign(std::max(std::abs(t), kernels::least_arc_threshold), t);
      workspace.length[i] = scale * rule.length()[j];
    }
  }
  for (; i < size; ++i) {
    workspace.dx[i] = workspace.dy[i] = workspace.length[i] = 0;
    workspace.dz[i] = 1;
    workspace.t[i] = 2;
  }
  return {workspace.dx.data(), workspace.dy.data(), workspace.dz.data(), workspace.t.data(), size};
}

// The distributions of all pairs; returns the loss.
double evaluate_distributions(const ArcPoint& point, const ArcView& view, bool derivatives,
                              ArcWorkspace& workspace) {
  double w[9];
  for (int i = 0; i < 9; ++i)
    w[i] = point.w(i / 3, i % 3);
  const kernels::ArcPairs pairs = make_pairs(point.turn, view, workspace);
  workspace.distributions.evaluate(w, pairs, view.rule.nodes(point.frame.lobe), derivatives);
  double loss = 0;
  for (std::size_t i = 0; i < view.target.above.size(); ++i)
    loss += workspace.length[i] *
            std::abs(workspace.distributions.f[i] - static_cast<double>(view.target.above[i]));
  return loss / static_cast<double>(view.directions.size());
}

// What each moving pair's derivative counts in gradient and curvature.
void weigh_residuals(const ArcView& view, double smoothing, ArcWorkspace& workspace) {
  const kernels::ArcDistributions& distributions = workspace.distributions;
  const double share = 1 / static_cast<double>(view.directions.size());
  const double area = smoothing / static_cast<double>(view.rule.thresholds());
  workspace.first.assign(distributions.moving.size(), 0);
  workspace.second.assign(distributions.moving.size(), 0);
  for (std::size_t m = 0; m < distributions.moving.size(); ++m) {
    if (distributions.moving[m] < 0)
      continue;
    const auto i = static_cast<std::size_t>(distributions.moving[m]);
    const double length = workspace.length[i];
    const double residual = distributions.f[i] - static_cast<double>(view.target.above[i]);
    const double weight = share * length * length / (length * std::abs(residual) + area);
    workspace.first[m] = std::copysign(weight, workspace.t[i]) * residual;
    workspace.second[m] = weight;
  }
}

}  // namespace

ArcRule::ArcRule(std::size_t thresholds, std::size_t nodes, Reach reach)
    : usual_(nodes), of_thin_(more_for_thin * nodes), of_thinnest_(more_for_thinnest * nodes) {
  const double step = std::numbers::pi / static_cast<double>(thresholds);
  for (std::size_t j = 0; j < thresholds; ++j) {
    const double angle = step * (static_cast<double>(j) + 0.5), sine = std::sin(angle);
    z_.push_back(std::cos(angle) / sine);
    length_.push_back(step / (sine * sine));
    ramp_.push_back(soft_share * length_.back());
  }
  if (reach == Reach::near)
    return;
  // The middle of each octave, by its logarithm, for all of it.
  const double end = z_.front() + length_.front() / 2;
  for (int octave = 0; octave < far_octaves; ++octave)
    for (const double side : {1.0, -1.0}) {
      z_.push_back(side * std::ldexp(end * std::numbers::sqrt2, octave));
      length_.push_back(std::ldexp(end, octave));
    }
}

const kernels::ArcNodes& ArcRule::nodes(const Lobe& lobe) const {
  const double ratio = std::min(lobe.alpha_x, lobe.alpha_y) / std::max(lobe.alpha_x, lobe.alpha_y);
  return ratio < thinnest ? of_thinnest_ : ratio < thin ? of_thin_ : usual_;
}

void set_target(const TargetSamples& samples, const ArcDirections& directions, const ArcRule& rule,
                AlignedFloats& xi, ArcTarget& target) {
  if (xi.size() < samples.size)
    xi.resize(samples.size);
  const std::size_t count = rule.thresholds(), near = rule.near_thresholds();
  std::vector<double> above(near);
  target.along.resize(directions.size());
  target.above.resize(directions.size() * count);
  target.spread = 0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const kernels::ArcCounts counts = kernels::count_above(
        directions[k].data(),
        {samples.gx.data(), samples.gy.data(), samples.gz.data(), samples.size},
        samples.weight.data(), rule.z().data(), rule.ramp().data(), near, xi.data(), above.data());
    target.along[k] = {static_cast<float>(counts.centre), static_cast<float>(counts.scale)};
    for (std::size_t j = 0; j < near; ++j)
      target.above[k * count + j] = static_cast<float>(above[j]);
    // Far thresholds find tails as those of GGX slopes, of what is left above the last near ones,
    // or nothing of a lobe that has no such tails.
    for (std::size_t j = near; j < count; ++j) {
      const bool upper = rule.z()[j] > 0;
      const double beyond = upper ? above.front() : 1 - above.back();
      const double ratio = samples.heavy_tails ? rule.z().front() / rule.z()[j] : 0;
      const double left = beyond * ratio * ratio;
      target.above[k * count + j] = static_cast<float>(upper ? left : 1 - left);
    }
    target.spread += counts.scale / static_cast<double>(directions.size());
  }
}

ArcPoint point_of_frame(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix) {
  return {frame, frame_matrix * frame.widths.asDiagonal(), frame.widths};
}

double arc_loss(const ArcPoint& point, const ArcView& view, ArcWorkspace& workspace) {
  return evaluate_distributions(point, view, false, workspace);
}

void evaluate_arcs(const ArcPoint& point, const ArcView& view, double smoothing,
                   ArcWorkspace& workspace, ModelValue& value) {
  value.loss = evaluate_distributions(point, view, true, workspace);
  weigh_residuals(view, smoothing, workspace);
  alignas(vector_alignment) double gradient[9], curvature[81];
  kernels::arc_sums(workspace.distributions, workspace.first.data(), workspace.second.data(),
                    gradient, curvature);
  for (int a = 0; a < 9; ++a) {
    value.gradient[a] = gradient[a] * point.scale[a % 3];
    for (int b = 0; b < 9; ++b)
      value.curvature(a, b) = curvature[9 * a + b] * (point.scale[a % 3] * point.scale[b % 3]);
  }
}

}  // namespace ltc
