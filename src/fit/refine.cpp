// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/refine.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/query_system.h"
#include "fit/refine_step.h"

namespace ltc {
namespace {

// Damping falls after a step that was taken and rises after one that was not.
constexpr double damping_fall = 0.4, damping_rise = 6, least_damping = 1e-3;

// No node's matrix comes nearer to a singular one than this share of its determinant, nor do its
// columns, unless the fit was there already: rounded to half precision, with entries off by 2^-11
// of them, or by 2^-25 if they are near zero, it must still have a determinant of the same sign,
// and some digits of it.
constexpr double least_determinant_share = 0.1, least_solid_angle = 0.01, most_condition = 1e6;

// Sets of samples that the held-out queries do not share with those refined on.
constexpr double refined_shift = 0.0, held_out_shift = 0.4321;
constexpr std::uint64_t held_out_seed = 20220712;

struct Queries {
  std::vector<GgxLobe> lobes;
  std::vector<double> weights;
  void add(const std::vector<GgxLobe>& more, double share) {
    lobes.insert(lobes.end(), more.begin(), more.end());
    weights.insert(weights.end(), more.size(), share / static_cast<double>(more.size()));
  }
};

// `count` lobes, the ranges in turn, each with what `draw` makes of it for its own part.
template <typename Draw>
std::vector<GgxLobe> from_all(const std::vector<QueryRange>& asked, std::size_t count,
                              Draw&& draw) {
  std::vector<GgxLobe> lobes;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::size_t part = (count + asked.size() - 1 - i) / asked.size();
    const std::vector<GgxLobe> more = draw(asked[i], part, i);
    lobes.insert(lobes.end(), more.begin(), more.end());
  }
  return lobes;
}

// Uniform in the interpolation coordinates: no cell without a query.
std::vector<GgxLobe> lobes_of_table(const Grid& grid, std::size_t count) {
  std::vector<GgxLobe> lobes;
  for (const std::array<double, 4>& u : lattice_points(0, count)) {
    const double alpha = grid.alpha.value(u[0]);
    lobes.push_back({std::max(alpha, grid.alpha_min),
                     std::max(grid.lambda.value(u[1]) * alpha, grid.alpha_min),
                     grid.theta.value(u[2]), grid.phi.value(u[3])});
  }
  return lobes;
}

std::vector<GgxLobe> lobes_of_nodes(const Grid& grid, const std::vector<bool>& has_values) {
  std::vector<GgxLobe> lobes;
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    if (has_values[flat])
      lobes.push_back(grid.lobe(grid.node(flat)));
  return lobes;
}

// The cells that can be asked: each counts at its first node, the one with a next node that has
// values, or none before, along every axis.
std::size_t cell_count(const Grid& grid, const std::vector<bool>& has_values) {
  const auto shape = grid.shape();
  const std::array<std::size_t, 4> stride{shape[1] * shape[2] * shape[3], shape[2] * shape[3],
                                          shape[3], 1};
  std::size_t cells = 0;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    const std::array<std::size_t, 4> index{node.alpha, node.lambda, node.theta, node.phi};
    bool first = has_values[flat];
    for (std::size_t axis = 0; axis < 4 && first; ++axis)
      first = (index[axis] + 1 < shape[axis] && has_values[flat + stride[axis]]) ||
              index[axis] == 0 || !has_values[flat - stride[axis]];
    cells += first;
  }
  return cells;
}

Queries queries_to_refine_on(const Grid& grid, const std::vector<bool>& has_values,
                             const std::vector<QueryRange>& asked, const RefineSettings& settings) {
  const auto count =
      cell_count(grid, has_values) * static_cast<std::size_t>(settings.queries_per_cell);
  const auto of_table = static_cast<std::size_t>(settings.table_share * static_cast<double>(count));
  const double free_weight = 1 - settings.node_weight;
  Queries queries;
  queries.add(from_all(asked, count - of_table,
                       [&](const QueryRange& range, std::size_t part, std::size_t) {
                         return lattice_queries(range, 0, part, grid.alpha_min);
                       }),
              free_weight * (1 - settings.table_share));
  queries.add(lobes_of_table(grid, of_table), free_weight * settings.table_share);
  queries.add(lobes_of_nodes(grid, has_values), settings.node_weight);
  return queries;
}

// No more than there are queries to refine on: a small part of a table is not judged for longer
// than it is refined.
Queries queries_held_out(const Grid& grid, const std::vector<QueryRange>& asked,
                         const RefineSettings& settings, std::size_t most) {
  Queries queries;
  queries.add(from_all(asked, std::min(static_cast<std::size_t>(settings.held_out_queries), most),
                       [&](const QueryRange& range, std::size_t part, std::size_t i) {
                         return random_queries(range, part, held_out_seed + i, grid.alpha_min);
                       }),
              1);
  return queries;
}

// The condition is that of M, whatever the table stores.
std::vector<SingularityBound> bounds_at(const Grid& grid, Storage storage,
                                        const std::vector<Eigen::Matrix3d>& stored) {
  std::vector<SingularityBound> bounds;
  for (std::size_t flat = 0; flat < stored.size(); ++flat) {
    const Eigen::Matrix3d& matrix = stored[flat];
    const Eigen::Vector3d scale =
        matrix_from_stored(storage, Eigen::Matrix3d::Identity(), grid.lobe(grid.node(flat)))
            .colwise()
            .norm();
    bounds.push_back({least_determinant_share * matrix.determinant(),
                      std::min(least_solid_angle, solid_angle_of_columns(matrix)),
                      std::max(most_condition, frobenius_condition(matrix * scale.asDiagonal())),
                      scale});
  }
  return bounds;
}

}  // namespace

RefineReport refine(const Grid& grid, Storage storage, const std::vector<bool>& has_values,
                    const std::vector<bool>& movable, const std::vector<QueryRange>& asked,
                    const RefineSettings& settings, int threads, Progress* progress,
                    std::vector<Eigen::Matrix3d>& stored) {
  const Queries refined_on = queries_to_refine_on(grid, has_values, asked, settings);
  const Queries held_out = queries_held_out(grid, asked, settings, refined_on.lobes.size());
  QuerySystem queries(grid, storage, has_values, refined_on.lobes, refined_on.weights,
                      settings.sampling, refined_shift);
  QuerySystem judge(grid, storage, has_values, held_out.lobes, held_out.weights, settings.sampling,
                    held_out_shift);
  RefineReport report;
  report.queries = queries.size();
  if (judge.size() == 0)
    return report;
  if (progress)
    progress->begin_stage(
        "refine", (static_cast<std::size_t>(settings.steps) + 1) * (queries.size() + judge.size()));
  const NodeSpace space(grid, movable);
  std::vector<Eigen::Matrix3d> current = stored;
  space.symmetrise(current);
  double objective = queries.evaluate(current, threads, progress);
  queries.adopt();
  // Relative to the weight of the queries that could be judged.
  const double judged =
      static_cast<double>(judge.size()) / static_cast<double>(held_out.lobes.size());
  report.loss_before = report.loss_after = judge.evaluate(stored, threads, progress) / judged;
  const std::vector<SingularityBound> bounds = bounds_at(grid, storage, current);
  double damping = settings.damping;
  while (report.steps < settings.steps) {
    ++report.steps;
    const NodeVectors step =
        refinement_step(queries, space, current, damping, settings.overshoot, threads);
    const std::vector<Eigen::Matrix3d> trial = stepped(current, step, bounds);
    const double next = queries.evaluate(trial, threads, progress);
    if (!(next < objective)) {
      damping *= damping_rise;
      continue;
    }
    const double gain = objective - next;
    objective = next;
    queries.adopt();
    current = trial;
    damping = std::max(damping * damping_fall, least_damping);
    const double loss = judge.evaluate(current, threads, progress) / judged;
    if (loss < report.loss_after) {
      report.loss_after = loss;
      report.kept = true;
      stored = current;
    }
    if (gain < settings.tolerance * objective)
      break;
  }
  if (progress)
    progress->end_stage();
  return report;
}

std::vector<double> node_losses(const Grid& grid, Storage storage,
                                const std::vector<bool>& has_values,
                                const std::vector<Eigen::Matrix3d>& stored, int threads) {
  const CosineSet cosines = make_cosine_set(2048);
  const TargetLattice lattice = make_target_lattice(4096, 0.3);
  const std::vector<Eigen::Vector3f> directions = in_float(fibonacci_directions(32));
  constexpr std::size_t bins = 64;
  std::vector<double> losses(grid.size(), std::numeric_limits<double>::quiet_NaN());
#pragma omp parallel num_threads(threads)
  {
    TargetSamples target;
    TargetQuantiles quantiles;
    ModelWorkspace workspace;
    ModelValue value;
#pragma omp for schedule(dynamic)
    for (std::size_t flat = 0; flat < grid.size(); ++flat) {
      if (!has_values[flat])
        continue;
      const LobeFrame frame(grid.lobe(grid.node(flat)));
      sample_weighted_target(frame, lattice, target);
      quantiles.build(target, directions, bins, workspace.xi, workspace.bins);
      const Eigen::Matrix3d p =
          frame.from_matrix(matrix_from_stored(storage, stored[flat], frame.lobe));
      evaluate_model(frame, p / p.col(2).norm(), cosines, quantiles, 1, quantiles.spread(),
                     workspace, value);
      losses[flat] = value.loss;
    }
  }
  return losses;
}

}  // namespace ltc
