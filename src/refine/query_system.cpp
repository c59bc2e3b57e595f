// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/query_system.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "core/spread.h"

namespace ltc {
namespace {

// The matrix P in the mirror's frame of a matrix S that a table of this storage interpolates, and
// how it changes: dP = left dS right.
struct FrameOfStored {
  Eigen::Matrix3d p, left, right;
};
FrameOfStored frame_of_stored(Storage storage, const LobeFrame& frame,
                              const Eigen::Matrix3d& stored) {
  Eigen::Matrix3d left = Eigen::Matrix3d::Identity(), right = Eigen::Matrix3d::Identity();
  if (storage != Storage::mirror_frame)
    left = frame.rotation.transpose();
  if (storage == Storage::matrix || storage == Storage::inverse)
    right.diagonal() << 1 / frame.lobe.alpha_x, 1 / frame.lobe.alpha_y, 1;
  if (storage != Storage::inverse)
    return {left * stored * right, left, right};
  // d(S^-1) = -S^-1 dS S^-1. The loss does not feel a factor, which is left out of what changes.
  const Eigen::Matrix3d inverse = stored.inverse();
  const double length = inverse.col(2).norm();
  return {left * inverse * right / length, -left * inverse / length, inverse * right};
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

// P and the bend of a folded node, and what they change by with each of its numbers.
struct FoldedFrame {
  Eigen::Matrix3d p;
  Bend bend;
  FoldedNode scale;
};
FoldedFrame frame_of_folded(const LobeFrame& frame, const FoldedNode& node) {
  const Eigen::Vector3d of_columns(1, width_across(frame.lobe) / frame.lobe.alpha_y, 1);
  const double of_kappa = frame.lobe.alpha_x * frame.lobe.alpha_x / of_columns.y();
  FoldedNode scale;
  scale << of_columns, of_columns, of_columns, of_kappa, 1;
  const FoldedNode scaled = scale.cwiseProduct(node);
  return {matrix_of(scaled), scaled.tail<2>(), scale};
}

bool complete(const Interpolation& corners, const std::vector<bool>& has_values) {
  for (std::size_t corner = 0; corner < 16; ++corner)
    if (corners.weights[corner] != 0 && !has_values[corners.nodes[corner]])
      return false;
  return true;
}

// The lobes that a table can be asked for, cell by cell: sorted by the cell's first node, which
// tells the others, and within a cell as they came.
std::vector<std::size_t> ordered_by_cell(const TableNodes& nodes, const std::vector<Lobe>& lobes,
                                         const Reduction& reduction, const RunContext& run) {
  const Grid& grid = nodes.grid;
  const std::size_t left_out = grid.size();
  std::vector<std::size_t> first_node(lobes.size()), begin(grid.size() + 1);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    run.throw_if_stopped();
    const Interpolation corners = interpolation(grid, reduction.fold(lobes[i]).lobe);
    const bool asked = reduction.covers(lobes[i]) && complete(corners, nodes.has_values);
    first_node[i] = asked ? corners.nodes[0] : left_out;
    if (asked)
      ++begin[corners.nodes[0] + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::size_t> order(begin.back());
  for (std::size_t i = 0; i < lobes.size(); ++i)
    if (first_node[i] != left_out)
      order[begin[first_node[i]]++] = i;
  return order;
}

}  // namespace

template <typename Node>
QuerySystemOf<Node>::QuerySystemOf(const TableNodes& nodes, const WeightedLobes& asked,
                                   const QuerySampling& sampling, double shift,
                                   const RunContext& run)
    : storage_(nodes.storage), node_count_(nodes.grid.size()), meter_(sampling, shift) {
  if (is_folded_node<Node>)
    meter_.set_creases(nodes.creases);
  const Reduction reduction(nodes.grid);
  const std::vector<std::size_t> order = ordered_by_cell(nodes, asked.lobes, reduction, run);
  corners_of_node_.resize(node_count_);
  queries_.reserve(order.size());
  for (const std::size_t i : order) {
    const Lobe folded = reduction.fold(asked.lobes[i]).lobe;
    const Interpolation corners = interpolation(nodes.grid, folded);
    if (cells_.empty() || cells_.back().nodes != corners.nodes) {
      run.throw_if_stopped();
      for (std::size_t corner = 0; corner < 16; ++corner)
        corners_of_node_[corners.nodes[corner]].push_back({cells_.size(), corner});
      cells_.push_back({corners.nodes, queries_.size(), queries_.size()});
    }
    queries_.push_back({folded, corners.weights, asked.weights[i]});
    cells_.back().last = queries_.size();
  }
  models_.resize(queries_.size());
  evaluated_.resize(queries_.size());
  targets_.resize(queries_.size());
}

template <typename Node>
void QuerySystemOf<Node>::evaluate_query(std::size_t q, const Node& interpolated,
                                         QueryMeter::Buffers& buffers) {
  const Query& query = queries_[q];
  Model& model = evaluated_[q];
  const LobeFrame frame(query.lobe);
  const double spread = meter_.see(frame, q, targets_[q], buffers), share = query.weight / spread;
  const double expected = model.loss > 0 ? model.loss / share : spread;
  if (!interpolated.allFinite()) {
    model.loss = std::numeric_limits<double>::infinity();
    return;
  }
  const auto set_model = [&](const auto& value, const auto& to_frame) {
    model.loss = share * value.loss;
    model.gradient.noalias() = share * (to_frame.transpose() * value.gradient);
    // Symmetric on paper, and but for the rounding of the kernel's products.
    const NodeMatrix<Node> curvature = share * (to_frame.transpose() * value.curvature * to_frame);
    model.curvature = 0.5 * (curvature + curvature.transpose());
  };
  if constexpr (!is_folded_node<Node>) {
    const FrameOfStored map = frame_of_stored(storage_, frame, interpolated);
    if (!map.p.allFinite()) {
      model.loss = std::numeric_limits<double>::infinity();
      return;
    }
    ModelValue value;
    meter_.measure(frame, q, map.p, expected, buffers, value);
    set_model(value, jacobian(map));
  } else {
    const FoldedFrame map = frame_of_folded(frame, interpolated);
    FoldedModelValue value;
    meter_.measure(frame, q, map.p, column_of(map.p, map.bend), expected, buffers, value);
    set_model(bent(value, map.p, map.bend), NodeMatrix<Node>(map.scale.asDiagonal()));
  }
}

template <typename Node>
double QuerySystemOf<Node>::evaluate(const std::vector<Node>& stored, const RunContext& run) {
  // The loss at the model in use tells each query's smoothing.
  const auto size_of = [](const Cell& cell) { return cell.last - cell.first; };
  spread_for<QueryMeter::Buffers>(
      Spreading::kept, cells_.size(), run, [] { return QueryMeter::Buffers(); },
      [&](std::size_t c, QueryMeter::Buffers& buffers) {
        const Cell& cell = cells_[c];
        for (std::size_t q = cell.first; q < cell.last; ++q) {
          Node interpolated = Node::Zero();
          for (std::size_t corner = 0; corner < 16; ++corner)
            if (queries_[q].weights[corner] != 0)
              interpolated += queries_[q].weights[corner] * stored[cell.nodes[corner]];
          evaluated_[q].loss = models_[q].loss;
          evaluate_query(q, interpolated, buffers);
        }
        run.advance(size_of(cell));
      },
      [&](std::size_t c, auto&& take) {
        for (std::size_t q = cells_[c].first; q < cells_[c].last; ++q)
          take(bytes_of(evaluated_[q]));
      },
      [&](std::size_t c) { run.advance(size_of(cells_[c])); });
  return std::accumulate(evaluated_.begin(), evaluated_.end(), 0.0,
                         [](double sum, const Model& model) { return sum + model.loss; });
}

template <typename Node>
template <typename Value, typename Part>
void QuerySystemOf<Node>::gather(std::vector<Value>& result, const RunContext& run,
                                 const Value& zero, Part&& part) const {
  result.assign(node_count_, zero);
  parallel_for(node_count_, run, [&](std::size_t node) {
    for (const Corner& at : corners_of_node_[node]) {
      Value of_cell = zero;
      for (std::size_t q = cells_[at.cell].first; q < cells_[at.cell].last; ++q)
        part(q, queries_[q].weights[at.corner], of_cell);
      result[node] += of_cell;
    }
  });
}

template <typename Node>
void QuerySystemOf<Node>::gradient(NodeVectorsOf<Node>& result, const RunContext& run) const {
  using Vector = NodeVector<Node>;
  gather<Vector>(result, run, Vector::Zero(), [&](std::size_t q, double weight, Vector& sum) {
    sum += weight * models_[q].gradient;
  });
}

template <typename Node>
void QuerySystemOf<Node>::multiply(const NodeVectorsOf<Node>& step, NodeVectorsOf<Node>& result,
                                   const RunContext& run) const {
  using Vector = NodeVector<Node>;
  NodeVectorsOf<Node> pulled(queries_.size());
  parallel_for(cells_.size(), run, [&](std::size_t c) {
    for (std::size_t q = cells_[c].first; q < cells_[c].last; ++q) {
      Vector interpolated = Vector::Zero();
      for (std::size_t corner = 0; corner < 16; ++corner)
        interpolated += queries_[q].weights[corner] * step[cells_[c].nodes[corner]];
      // Into a value of its own: the order in which Eigen sums depends on where the result lies.
      alignas(16) Vector product;
      product = models_[q].curvature.lazyProduct(interpolated);
      pulled[q] = product;
    }
  });
  gather<Vector>(result, run, Vector::Zero(),
                 [&](std::size_t q, double weight, Vector& sum) { sum += weight * pulled[q]; });
}

template <typename Node>
void QuerySystemOf<Node>::diagonal_blocks(std::vector<NodeMatrix<Node>>& blocks,
                                          const RunContext& run) const {
  using Matrix = NodeMatrix<Node>;
  gather<Matrix>(blocks, run, Matrix::Zero(), [&](std::size_t q, double weight, Matrix& sum) {
    sum += weight * weight * models_[q].curvature;
  });
}

template <typename Node>
std::size_t QuerySystemOf<Node>::memory_bytes(const QuerySampling& sampling, std::size_t queries,
                                              std::size_t cells, std::size_t nodes) {
  const std::size_t query = sizeof(Query) + 2 * sizeof(Model) + sizeof(NodeVector<Node>) +
                            QueryMeter::target_bytes(sampling) + 2 * sizeof(std::size_t);
  // A node's corners grow by doubling, and may have just grown.
  return queries * query + cells * 2 * (sizeof(Cell) + 16 * sizeof(Corner)) +
         nodes * sizeof(std::vector<Corner>);
}

template class QuerySystemOf<Eigen::Matrix3d>;
template class QuerySystemOf<FoldedNode>;

}  // namespace ltc
