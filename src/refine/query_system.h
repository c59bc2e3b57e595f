// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The loss of many look-ups as a function of all the table's matrices, to second order.
//
// A look-up at query p interpolates S_p = sum_i w_pi S_i over its 16 nodes; its loss relative to
// the lobe's spread has, at S_p, the gradient g_p and the Gauss-Newton curvature H_p of the
// quantile model (quantile_model.h), nine and nine by nine numbers. The objective
//     F = sum_p c_p loss_p / spread_p
// therefore has, in the steps s_i of all nodes, the gradient and curvature
//     (grad F)_i = sum_p c_p w_pi g_p,   (H s)_i = sum_p c_p w_pi H_p sum_j w_pj s_j.
// The curvature is never formed: it couples a node with its 80 neighbours, but each query's part is
// a 9 x 9 matrix between two interpolations, kept and multiplied with in single precision
// (query_kernels.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/aligned.h"
#include "core/run_context.h"
#include "fit/quantile_model.h"
#include "refine/node_space.h"
#include "refine/query_kernels.h"
#include "refine/query_meter.h"
#include "refine/refine_queries.h"
#include "refine/refine_settings.h"
#include "table/lookup.h"
#include "table/storage.h"

namespace ltc {

// Of a folded table (Node = FoldedNode, eleven numbers) the model is one of twelve, (P q)
// (quantile_model.h): q = S (0, alpha_x^2 kappa, gamma)^T changes with S too.
template <typename Node>
class QuerySystemOf {
 public:
  // The look-ups of the lobes with weights c_p. Those beyond the axes, which no table serves, and
  // those that need a node without values are left out. Systems of different `shift` in [0, 1)
  // share no samples.
  QuerySystemOf(const TableNodes& nodes, const WeightedLobes& asked, const QuerySampling& sampling,
                double shift, const RunContext& run = {});

  // What so many queries in so many cells need, about, and while they are multiplied with.
  static std::size_t memory_bytes(const QuerySampling& sampling, std::size_t queries,
                                  std::size_t cells, std::size_t nodes);

  std::size_t size() const { return queries_.size(); }

  // F at `stored`; also makes the model there, which adopt() takes into use. Infinite where a
  // matrix is not finite. Throws Interrupted when a stop is asked for.
  double evaluate(const std::vector<Node>& stored, const RunContext& run);
  void adopt() { models_.swap(evaluated_); }

  // Throw Interrupted too. Of the model in use: gradient, curvature times a step, the curvature's
  // blocks on the diagonal. Sums have a fixed order: the same bits for any number of threads.
  void gradient(NodeVectorsOf<Node>& result, const RunContext& run = {}) const;
  void multiply(const NodeVectorsOf<Node>& step, NodeVectorsOf<Node>& result,
                const RunContext& run = {}) const;
  void diagonal_blocks(std::vector<NodeMatrix<Node>>& blocks, const RunContext& run = {}) const;

 private:
  static constexpr std::size_t numbers = numbers_of<Node>;
  static constexpr std::size_t padded_curvature = numbers * kernels::query_lanes;
  struct Query {
    Lobe lobe;
    std::array<double, 16> weights;  // of the cell's nodes
    double weight;                   // c_p
  };
  // In the stored variables, times c_p / spread.
  struct Model {
    double loss = 0;
    NodeVector<Node> gradient;
    alignas(vector_alignment) std::array<float, padded_curvature> curvature;
  };
  // Neighbouring queries, which share their 16 nodes.
  struct Cell {
    std::array<std::size_t, 16> nodes;
    std::size_t first, last;  // queries
  };
  kernels::CellQueries queries_of(const Cell& cell) const;
  void evaluate_query(std::size_t q, const Node& interpolated, QueryMeter::Buffers& buffers);
  struct Corner {
    std::size_t cell, corner;
  };
  static constexpr std::size_t cell_size = kernels::cell_corners * kernels::query_lanes;

  Storage storage_;
  std::size_t node_count_;
  QueryMeter meter_;
  std::vector<Query> queries_;  // cell by cell
  AlignedFloats weights_;       // theirs, cell_corners a query
  std::vector<Cell> cells_;
  std::vector<std::vector<Corner>> corners_of_node_;
  std::vector<Model> models_, evaluated_;
  std::vector<QueryTarget> targets_;
};
using QuerySystem = QuerySystemOf<Eigen::Matrix3d>;
using FoldedQuerySystem = QuerySystemOf<FoldedNode>;

}  // namespace ltc
