// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sgd_solver.h"

#include <hwy/contrib/sort/vqsort.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/lobe_model.h"
#include "core/ordered_float.h"
#include "core/random.h"
#include "core/stopwatch.h"
#include "fit/starting_points.h"
#include "fit/workspace.h"

namespace ltc {
namespace {

// The variables that are descended in: M = left * W * right. As published W is M itself; scaled, W
// is M in the mirror's frame with all but the axis e_z divided by the lobe's width s, so that the
// loss over s has gradients of the order of one for every lobe.
struct Variables {
  bool scaled;
  double scale;  // s
  const LobeFrame& frame;

  Eigen::Matrix3d to_frame_direction(const Eigen::Matrix3d& w) const {
    // Q^T M: what the samples are multiplied with.
    if (!scaled)
      return frame.rotation.transpose() * w;
    Eigen::Matrix3d m = scale * w;
    m(2, 2) += 1;
    return m;
  }
  Eigen::Matrix3d from_frame_direction(const Eigen::Matrix3d& m) const {
    if (!scaled)
      return frame.rotation * m;
    Eigen::Matrix3d w = m / m.col(2).norm();
    w(2, 2) -= 1;
    return w / scale;
  }
  // Gradient of the loss that is descended, from the one with respect to Q^T M.
  Eigen::Matrix3d gradient(const Eigen::Matrix3d& of_frame_direction) const {
    // dL/dW = s dL/d(Q^T M), and it is L/s that is descended.
    return scaled ? of_frame_direction : (frame.rotation * of_frame_direction).eval();
  }
};

class Descender {
 public:
  Descender(const SgdSettings& settings, TargetKind kind, const FitRequest& request,
            const TargetLattice& lattice, FitWorkspace& workspace)
      : settings_(settings),
        kind_(kind),
        lattice_(lattice),
        frame_(request.lobe),
        sampler_(request.lobe.model->sampler(request.lobe)),
        free_(free_entries(request.lobe)),
        progress_(request.progress),
        workspace_(workspace),
        seed_(request.seed),
        random_(request.seed),
        count_((static_cast<std::size_t>(settings.samples) + 15) / 16 * 16) {
    for (AlignedFloats* array : {&workspace.cosine_x, &workspace.cosine_y, &workspace.cosine_z,
                                 &workspace.sorted_target, &workspace.sorted_projections})
      array->resize(count_);
    workspace.keys.resize(count_);
    for (AlignedFloats* array : {&workspace.model.gx, &workspace.model.gy, &workspace.model.gz})
      if (array->size() < count_)
        array->resize(count_);
    for (AlignedFloats* array : {&workspace.lattice.cos_azimuth, &workspace.lattice.sin_azimuth,
                                 &workspace.lattice.height})
      array->resize(count_);
    sample_rejection_target(frame_, count_, request.seed ^ 0x9e3779b97f4a7c15u, workspace.target);
  }

  FitResult run(const std::vector<Eigen::Matrix3d>& starts, std::vector<FitStep>* trace) {
    const Clock::time_point begin = Clock::now();
    const double width = std::max(frame_.widths.x(), frame_.widths.y());
    const Variables variables{settings_.scaled_variables, width, frame_};
    const Eigen::Matrix3d start = starts.empty() ? own_start() : starts.front();
    Eigen::Matrix3d w = variables.from_frame_direction(frame_.rotation.transpose() * start);
    Eigen::Matrix3d average = Eigen::Matrix3d::Zero();
    double average_loss = 0;
    int averaged = 0;
    FitResult result;
    double step_size = settings_.learning_rate * settings_.step_scale;
    for (int step = 0; step < settings_.steps; ++step) {
      if (progress_ && progress_->stop_requested())
        break;
      if (settings_.lattice_samples) {
        shift_lattices();
      } else {
        refresh_target();
        draw_cosines();
      }
      const auto [loss, frame_gradient] = loss_and_gradient(variables.to_frame_direction(w));
      const Eigen::Matrix3d gradient = restricted(variables.gradient(frame_gradient));
      const Eigen::Matrix3d next = w - step_size * gradient;
      const bool usable = next.allFinite();
      if (usable)
        w = next;
      if (trace)
        trace->push_back({loss, gradient.norm(), step_size, seconds_since(begin), usable});
      step_size *= settings_.step_decay;
      ++result.steps;
      if (usable && step >= settings_.steps - settings_.averaged_steps) {
        average += w;
        average_loss += loss;
        ++averaged;
      }
    }
    if (averaged > 0)
      w = average / averaged;
    result.loss = averaged > 0 ? average_loss / averaged : std::numeric_limits<double>::quiet_NaN();
    result.matrix = frame_.rotation * variables.to_frame_direction(w);
    if (result.matrix.determinant() < 0)
      result.matrix.col(1) = -result.matrix.col(1);
    if (!result.matrix.allFinite() || !(result.matrix.determinant() > 0)) {
      result.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
      result.outcome = FitOutcome::non_finite;
    }
    return result;
  }

 private:
  Eigen::Matrix3d own_start() {
    return frame_.to_matrix(start_of_kind(settings_.start, frame_, workspace_.target, seed_));
  }

  // Symmetry zeros of M are zeros of Q^T M too.
  Eigen::Matrix3d restricted(Eigen::Matrix3d gradient) const {
    for (int entry = 0; entry < 9; ++entry)
      if (!free_[entry])
        gradient(entry / 3, entry % 3) = 0;
    return gradient;
  }

  // The published buffer: every sample gets one proposal a step and keeps its old value, itself an
  // earlier accepted proposal, where this one is rejected.
  void refresh_target() {
    TargetSamples& target = workspace_.target;
    const Eigen::Matrix3d to_frame = frame_.rotation.transpose();
    for (std::size_t i = 0; i < count_; ++i) {
      const double u_azimuth = random_.uniform();
      const double u_height = random_.uniform();
      const LobeSample sample = sampler_->sample(u_azimuth, u_height);
      if (kind_ == TargetKind::rejection && random_.uniform() >= sample.weight)
        continue;
      const Eigen::Vector3d g = to_frame * sample.offset;
      target.gx[i] = static_cast<float>(g.x());
      target.gy[i] = static_cast<float>(g.y());
      target.gz[i] = static_cast<float>(g.z());
      target.weight[i] = kind_ == TargetKind::rejection ? 1.0f : static_cast<float>(sample.weight);
    }
  }

  // Lattices of this step: a random turn of the azimuth and a random height within the strata.
  void shift_lattices() {
    const double turn = 2 * std::numbers::pi * random_.uniform();
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    const double height = random_.uniform();
    const double target_height = random_.uniform();
    TargetLattice& shifted = workspace_.lattice;
    for (std::size_t i = 0; i < count_; ++i) {
      const float x = lattice_.cos_azimuth[i], y = lattice_.sin_azimuth[i];
      shifted.cos_azimuth[i] = c * x - s * y;
      shifted.sin_azimuth[i] = s * x + c * y;
      const auto stratum = static_cast<double>(i);
      shifted.height[i] =
          static_cast<float>((stratum + target_height) / static_cast<double>(count_));
      // The cosine set takes its strata in another order, so that the two are not the same points.
      const double u = (static_cast<double>(count_ - 1 - i) + height) / static_cast<double>(count_);
      const auto radius = static_cast<float>(std::sqrt(u));
      workspace_.cosine_x[i] = radius * shifted.cos_azimuth[i];
      workspace_.cosine_y[i] = radius * shifted.sin_azimuth[i];
      workspace_.cosine_z[i] = static_cast<float>(std::sqrt(1 - u));
    }
    sample_weighted_target(frame_, shifted, workspace_.target);
  }

  void draw_cosines() {
    for (std::size_t i = 0; i < count_; ++i) {
      const double height = random_.uniform();
      const double azimuth = 2 * std::numbers::pi * random_.uniform();
      const double radius = std::sqrt(height);
      workspace_.cosine_x[i] = static_cast<float>(radius * std::cos(azimuth));
      workspace_.cosine_y[i] = static_cast<float>(radius * std::sin(azimuth));
      workspace_.cosine_z[i] = static_cast<float>(std::sqrt(1 - height));
    }
  }

  struct LossGradient {
    double loss;
    Eigen::Matrix3d gradient;
  };

  // Loss and its gradient with respect to Q^T M on the current samples and fresh directions.
  LossGradient loss_and_gradient(const Eigen::Matrix3d& frame_direction);

  const SgdSettings& settings_;
  TargetKind kind_;
  const TargetLattice& lattice_;
  LobeFrame frame_;
  std::unique_ptr<LobeSampler> sampler_;
  FreeEntries free_;
  const Progress* progress_;
  FitWorkspace& workspace_;
  std::uint64_t seed_;
  Random random_;
  std::size_t count_;
  hwy::Sorter sorter_;
};

// Target quantiles at the ranks' midpoints, u = (i + 1/2)/count, from sorted keys whose indices
// point at the weights.
void quantiles_at_midpoints(const AlignedVector<std::uint64_t>& keys, const TargetSamples& target,
                            AlignedFloats& quantiles) {
  const std::size_t count = keys.size();
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    total += target.weight[i];
  double below = 0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * total;
    while (j + 1 < count && below + target.weight[key_index(keys[j])] < u)
      below += target.weight[key_index(keys[j++])];
    quantiles[i] = key_value(keys[j]);
  }
}

Descender::LossGradient Descender::loss_and_gradient(const Eigen::Matrix3d& frame_direction) {
  ModelWorkspace& model = workspace_.model;
  const TargetSamples& target = workspace_.target;
  model.rows.resize(std::max(model.rows.size(), count_ * kernels::row_width));
  model.xi.resize(std::max(model.xi.size(), count_));
  model.bins.resize(std::max(model.bins.size(), count_));
  float m[9];
  for (int i = 0; i < 9; ++i)
    m[i] = static_cast<float>(frame_direction(i / 3, i % 3));
  kernels::transform_samples(
      {m, 1, 1},
      {workspace_.cosine_x.data(), workspace_.cosine_y.data(), workspace_.cosine_z.data(), count_},
      {model.gx.data(), model.gy.data(), model.gz.data(), model.rows.data()});
  LossGradient result{0, Eigen::Matrix3d::Zero()};
  auto& keys = workspace_.keys;
  for (int k = 0; k < settings_.directions; ++k) {
    const Eigen::Vector3f d = random_.direction().cast<float>();
    for (std::uint32_t i = 0; i < count_; ++i)
      keys[i] = sort_key(d.x() * target.gx[i] + d.y() * target.gy[i] + d.z() * target.gz[i], i);
    sorter_(keys.data(), count_, hwy::SortAscending());
    quantiles_at_midpoints(keys, target, workspace_.sorted_target);
    for (std::uint32_t i = 0; i < count_; ++i) {
      model.xi[i] = d.x() * model.gx[i] + d.y() * model.gy[i] + d.z() * model.gz[i];
      keys[i] = sort_key(model.xi[i], i);
    }
    sorter_(keys.data(), count_, hwy::SortAscending());
    double loss = 0;
    for (std::size_t rank = 0; rank < count_; ++rank) {
      const float difference = key_value(keys[rank]) - workspace_.sorted_target[rank];
      loss += std::abs(difference);
      model.bins[key_index(keys[rank])] = difference > 0;
    }
    // The sums of dx/dM over the samples that lie too low (0) and too high (1).
    alignas(vector_alignment) float sums[2 * kernels::row_width] = {};
    std::int32_t populations[2] = {};
    kernels::accumulate_rows({model.xi.data(), model.bins.data(), count_, 2}, model.rows.data(),
                             &d.z(), 1, {sums, populations});
    float low[9], high[9];
    kernels::jacobian_of_sums({d.x(), d.y(), d.z(), 0, 1}, sums, low);
    kernels::jacobian_of_sums({d.x(), d.y(), d.z(), 0, 1}, sums + kernels::row_width, high);
    for (int i = 0; i < 9; ++i)
      result.gradient(i / 3, i % 3) += high[i] - low[i];
    result.loss += loss;
  }
  const double share = 1.0 / (static_cast<double>(count_) * settings_.directions);
  result.loss *= share;
  result.gradient *= share;
  return result;
}

}  // namespace

SgdSolver::SgdSolver(const SgdSettings& settings, TargetKind target)
    : settings_(settings),
      target_kind_(target),
      lattice_(make_target_lattice(static_cast<std::size_t>(settings.samples))) {}

FitResult SgdSolver::fit(const FitRequest& request, FitWorkspace& workspace,
                         std::vector<FitStep>* trace) const {
  return Descender(settings_, target_kind_, request, lattice_, workspace)
      .run(request.starts, trace);
}

}  // namespace ltc
