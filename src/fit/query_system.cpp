// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/query_system.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/random.h"

namespace ltc {
namespace {

constexpr std::size_t set_count = 8;
constexpr std::size_t bins = 32;
// As in the descent of one lobe: below this share of the loss a residual counts as zero.
constexpr double smoothing_share = 0.05;

Eigen::Matrix3d random_rotation(Random& random) {
  const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  return turn.normalized().toRotationMatrix();
}

// P = left S right for the matrix S that a table of this storage interpolates.
struct FrameOfStored {
  Eigen::Matrix3d left, right;
};
FrameOfStored frame_of_stored(Storage storage, const LobeFrame& frame) {
  FrameOfStored map{Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  if (storage != Storage::mirror_frame)
    map.left = frame.rotation.transpose();
  if (storage == Storage::matrix)
    map.right.diagonal() << 1 / frame.lobe.alpha_x, 1 / frame.lobe.alpha_y, 1;
  return map;
}

// dP/dS as a 9 x 9 matrix between row-major matrices.
Matrix9 jacobian(const FrameOfStored& map) {
  Matrix9 result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      for (int from = 0; from < 3; ++from)
        for (int to = 0; to < 3; ++to)
          result(3 * row + column, 3 * from + to) = map.left(row, from) * map.right(to, column);
  return result;
}

}  // namespace

QuerySystem::QuerySystem(const Grid& grid, Storage storage, const std::vector<bool>& has_values,
                         const std::vector<GgxLobe>& lobes, const std::vector<double>& weights,
                         const QuerySampling& sampling, double shift)
    : storage_(storage), node_count_(grid.size()) {
  make_sets(sampling, shift);
  std::vector<Interpolation> corners;
  std::vector<std::size_t> order;
  for (const GgxLobe& lobe : lobes)
    corners.push_back(interpolation(grid, lobe));
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    bool complete = true;
    for (std::size_t corner = 0; corner < 16; ++corner)
      complete =
          complete && (corners[i].weights[corner] == 0 || has_values[corners[i].nodes[corner]]);
    if (complete)
      order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return corners[a].nodes < corners[b].nodes;
  });
  corners_of_node_.resize(node_count_);
  for (const std::size_t i : order) {
    if (cells_.empty() || cells_.back().nodes != corners[i].nodes) {
      for (std::size_t corner = 0; corner < 16; ++corner)
        corners_of_node_[corners[i].nodes[corner]].push_back({cells_.size(), corner});
      cells_.push_back({corners[i].nodes, queries_.size(), queries_.size()});
    }
    // Neighbours in a cell are measured with different sets.
    queries_.push_back({lobes[i], corners[i].weights, weights[i], queries_.size() % set_count});
    cells_.back().last = queries_.size();
  }
  models_.resize(queries_.size());
  evaluated_.resize(queries_.size());
  targets_.resize(queries_.size());
}

void QuerySystem::make_sets(const QuerySampling& sampling, double shift) {
  Random random(static_cast<std::uint64_t>(shift * 0x1p32));
  for (std::size_t set = 0; set < set_count; ++set) {
    const double turned = shift + static_cast<double>(set) / set_count;
    sets_.push_back({make_cosine_set(static_cast<std::size_t>(sampling.samples), turned),
                     make_target_lattice(static_cast<std::size_t>(sampling.target_samples), turned),
                     {}});
    const Eigen::Matrix3d rotation = random_rotation(random);
    for (const Eigen::Vector3d& d :
         fibonacci_directions(static_cast<std::size_t>(sampling.directions)))
      sets_.back().directions.push_back((rotation * d).cast<float>());
  }
}

void QuerySystem::see_target(const LobeFrame& frame, const SampleSet& set, Buffers& buffers,
                             BinnedTarget& binned) const {
  if (!binned.values.empty()) {
    buffers.quantiles.rebuild(binned, set.directions, bins);
    return;
  }
  sample_weighted_target(frame, set.lattice, buffers.target);
  buffers.quantiles.build(buffers.target, set.directions, bins, buffers.model.xi,
                          buffers.model.bins);
  buffers.quantiles.keep(binned);
}

void QuerySystem::evaluate_query(const Query& query, const Eigen::Matrix3d& interpolated,
                                 BinnedTarget& binned, Buffers& buffers, Model& model) const {
  const LobeFrame frame(query.lobe);
  const SampleSet& set = sets_[query.set];
  see_target(frame, set, buffers, binned);
  const FrameOfStored map = frame_of_stored(storage_, frame);
  const Eigen::Matrix3d p = map.left * interpolated * map.right;
  const double spread = buffers.quantiles.spread(), share = query.weight / spread;
  if (!p.allFinite()) {
    model.loss = std::numeric_limits<double>::infinity();
    return;
  }
  ModelValue value;
  const double expected = model.loss > 0 ? model.loss / share : spread;
  evaluate_model(frame, p, set.cosines, buffers.quantiles, 1, smoothing_share * expected,
                 buffers.model, value);
  const Matrix9 to_frame = jacobian(map);
  model.loss = share * value.loss;
  model.gradient.noalias() = share * (to_frame.transpose() * value.gradient);
  // Symmetric on paper, and but for the rounding of the kernel's products.
  const Matrix9 curvature = share * (to_frame.transpose() * value.curvature * to_frame);
  model.curvature = 0.5 * (curvature + curvature.transpose());
}

double QuerySystem::evaluate(const std::vector<Eigen::Matrix3d>& stored, int threads,
                             Progress* progress) {
  // The loss at the model in use tells each query's smoothing.
#pragma omp parallel num_threads(threads)
  {
    Buffers buffers;
#pragma omp for schedule(dynamic)
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const Cell& cell = cells_[c];
      if (progress && progress->stop_requested())
        continue;
      for (std::size_t q = cell.first; q < cell.last; ++q) {
        Eigen::Matrix3d interpolated = Eigen::Matrix3d::Zero();
        for (std::size_t corner = 0; corner < 16; ++corner)
          if (queries_[q].weights[corner] != 0)
            interpolated += queries_[q].weights[corner] * stored[cell.nodes[corner]];
        evaluated_[q].loss = models_[q].loss;
        evaluate_query(queries_[q], interpolated, targets_[q], buffers, evaluated_[q]);
      }
      if (progress)
        progress->advance(cell.last - cell.first);
    }
  }
  if (progress)
    progress->throw_if_stopped();
  return std::accumulate(evaluated_.begin(), evaluated_.end(), 0.0,
                         [](double sum, const Model& model) { return sum + model.loss; });
}

template <typename Value, typename Fill>
void QuerySystem::gather(std::vector<Value>& result, int threads, const Value& zero,
                         Fill&& fill) const {
  std::vector<std::array<Value, 16>> sums(cells_.size());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    sums[c].fill(zero);
    for (std::size_t q = cells_[c].first; q < cells_[c].last; ++q)
      fill(cells_[c], queries_[q], models_[q], sums[c]);
  }
  result.assign(node_count_, zero);
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::size_t node = 0; node < node_count_; ++node)
    for (const Corner& at : corners_of_node_[node])
      result[node] += sums[at.cell][at.corner];
}

void QuerySystem::gradient(NodeVectors& result, int threads) const {
  gather<Vector9>(result, threads, Vector9::Zero(),
                  [](const Cell&, const Query& query, const Model& model, auto& sums) {
                    for (std::size_t corner = 0; corner < 16; ++corner)
                      sums[corner] += query.weights[corner] * model.gradient;
                  });
}

void QuerySystem::multiply(const NodeVectors& step, NodeVectors& result, int threads) const {
  gather<Vector9>(result, threads, Vector9::Zero(),
                  [&](const Cell& cell, const Query& query, const Model& model, auto& sums) {
                    Vector9 interpolated = Vector9::Zero();
                    for (std::size_t corner = 0; corner < 16; ++corner)
                      interpolated += query.weights[corner] * step[cell.nodes[corner]];
                    Vector9 pulled;
                    pulled = model.curvature.lazyProduct(interpolated);
                    for (std::size_t corner = 0; corner < 16; ++corner)
                      sums[corner] += query.weights[corner] * pulled;
                  });
}

void QuerySystem::diagonal_blocks(std::vector<Matrix9>& blocks, int threads) const {
  gather<Matrix9>(blocks, threads, Matrix9::Zero(),
                  [](const Cell&, const Query& query, const Model& model, auto& sums) {
                    for (std::size_t corner = 0; corner < 16; ++corner)
                      sums[corner] +=
                          query.weights[corner] * query.weights[corner] * model.curvature;
                  });
}

}  // namespace ltc
