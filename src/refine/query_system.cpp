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
    right.diagonal() = frame.widths.cwiseInverse();
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

// Of a storage that is linear in M, which spares P and its Jacobian.
ArcPoint point_of_stored(Storage storage, const LobeFrame& frame, const Eigen::Matrix3d& stored) {
  const Eigen::Vector3d scale = scale_of_columns(storage, frame.lobe);
  ArcPoint point{frame, stored * scale.asDiagonal(), scale};
  if (!is_in_mirror_frame(storage))
    point.turn = frame.rotation;
  return point;
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
    : storage_(nodes.storage),
      node_count_(nodes.grid.size()),
      meter_(sampling, shift, is_folded_node<Node> ? nodes.creases : Creases{}) {
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
  for (const Query& query : queries_)
    for (const double weight : query.weights)
      weights_.push_back(static_cast<float>(weight));
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
  // Symmetric on paper, and but for the rounding of products.
  const auto set_model = [&](double loss, const NodeVector<Node>& gradient,
                             const NodeMatrix<Node>& curvature) {
    model.loss = std::isfinite(loss) ? share * loss : std::numeric_limits<double>::infinity();
    model.gradient = share * gradient;
    model.curvature.fill(0);
    for (Eigen::Index column = 0; column < numbers_of<Node>; ++column)
      for (Eigen::Index row = 0; row < numbers_of<Node>; ++row)
        model.curvature[static_cast<std::size_t>(column) * kernels::query_lanes +
                        static_cast<std::size_t>(row)] =
            static_cast<float>(0.5 * share * (curvature(row, column) + curvature(column, row)));
  };
  if constexpr (is_folded_node<Node>) {
    const FoldedFrame map = frame_of_folded(frame, interpolated);
    FoldedModelValue of_columns;
    meter_.measure(frame, q, map.p, column_of(map.p, map.bend), expected, buffers, of_columns);
    const BentModelValue value = bent(of_columns, map.p, map.bend);
    set_model(value.loss, map.scale.cwiseProduct(value.gradient),
              map.scale.asDiagonal() * value.curvature * map.scale.asDiagonal());
  } else {
    ModelValue value;
    if (meter_.by_arcs() && storage_ != Storage::inverse) {
      meter_.measure(point_of_stored(storage_, frame, interpolated), q, expected, buffers, value);
      set_model(value.loss, value.gradient, value.curvature);
      return;
    }
    const FrameOfStored map = frame_of_stored(storage_, frame, interpolated);
    if (!map.p.allFinite()) {
      model.loss = std::numeric_limits<double>::infinity();
      return;
    }
    meter_.measure(frame, q, map.p, expected, buffers, value);
    const Matrix9 to_frame = jacobian(map);
    set_model(value.loss, to_frame.transpose() * value.gradient,
              to_frame.transpose() * value.curvature * to_frame);
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
kernels::CellQueries QuerySystemOf<Node>::queries_of(const Cell& cell) const {
  return {models_[cell.first].curvature.data(), sizeof(Model) / sizeof(float),
          weights_.data() + cell.first * kernels::cell_corners, cell.last - cell.first, numbers};
}

template <typename Node>
void QuerySystemOf<Node>::gradient(NodeVectorsOf<Node>& result, const RunContext& run) const {
  using Vector = NodeVector<Node>;
  result.assign(node_count_, Vector::Zero());
  parallel_for(node_count_, run, [&](std::size_t node) {
    for (const Corner& at : corners_of_node_[node]) {
      Vector of_cell = Vector::Zero();
      for (std::size_t q = cells_[at.cell].first; q < cells_[at.cell].last; ++q)
        of_cell += queries_[q].weights[at.corner] * models_[q].gradient;
      result[node] += of_cell;
    }
  });
}

template <typename Node>
void QuerySystemOf<Node>::multiply(const NodeVectorsOf<Node>& step, NodeVectorsOf<Node>& result,
                                   const RunContext& run) const {
  AlignedFloats products(cells_.size() * cell_size);
  parallel_for(cells_.size(), run, [&](std::size_t c) {
    alignas(vector_alignment) float steps[cell_size] = {};
    for (std::size_t corner = 0; corner < kernels::cell_corners; ++corner)
      Eigen::Map<Eigen::Matrix<float, numbers_of<Node>, 1>>(steps + corner * kernels::query_lanes) =
          step[cells_[c].nodes[corner]].template cast<float>();
    kernels::multiply_cell(queries_of(cells_[c]), steps, products.data() + c * cell_size);
  });
  result.resize(node_count_);
  parallel_for(node_count_, run, [&](std::size_t node) {
    result[node].setZero();
    for (const Corner& at : corners_of_node_[node])
      result[node] += Eigen::Map<const Eigen::Matrix<float, numbers_of<Node>, 1>>(
                          products.data() + at.cell * cell_size + at.corner * kernels::query_lanes)
                          .template cast<double>();
  });
}

template <typename Node>
void QuerySystemOf<Node>::diagonal_blocks(std::vector<NodeMatrix<Node>>& blocks,
                                          const RunContext& run) const {
  blocks.resize(node_count_);
  parallel_for(node_count_, run, [&](std::size_t node) {
    alignas(vector_alignment) float block[padded_curvature] = {};
    for (const Corner& at : corners_of_node_[node])
      kernels::add_blocks(queries_of(cells_[at.cell]), at.corner, block);
    for (Eigen::Index column = 0; column < numbers_of<Node>; ++column)
      for (Eigen::Index row = 0; row < numbers_of<Node>; ++row)
        blocks[node](row, column) =
            static_cast<double>(block[static_cast<std::size_t>(column) * kernels::query_lanes +
                                      static_cast<std::size_t>(row)]);
  });
}

template <typename Node>
std::size_t QuerySystemOf<Node>::memory_bytes(const QuerySampling& sampling, std::size_t queries,
                                              std::size_t cells, std::size_t nodes) {
  const std::size_t query = sizeof(Query) + 2 * sizeof(Model) +
                            kernels::cell_corners * sizeof(float) +
                            QueryMeter::target_bytes(sampling) + 2 * sizeof(std::size_t);
  // A node's corners grow by doubling, and may have just grown.
  return queries * query +
         cells * (2 * (sizeof(Cell) + 16 * sizeof(Corner)) + cell_size * sizeof(float)) +
         nodes * sizeof(std::vector<Corner>);
}

template class QuerySystemOf<Eigen::Matrix3d>;
template class QuerySystemOf<FoldedNode>;

}  // namespace ltc
