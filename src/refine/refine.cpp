// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/refine.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/spread.h"
#include "field/field.h"
#include "fit/loss_meter.h"
#include "refine/query_system.h"
#include "refine/refine_step.h"

namespace ltc {
namespace {

// Damping falls after a step that was taken and rises after one that was not.
constexpr double damping_fall = 0.4, damping_rise = 6, least_damping = 1e-3;

// No node's matrix comes nearer to a singular one than this share of its determinant, nor do its
// columns, unless the fit was there already: rounded to half precision, with entries off by 2^-11
// of them, or by 2^-25 if they are near zero, it must still have a determinant of the same sign,
// and some digits of it.
constexpr double least_determinant_share = 0.1, least_solid_angle = 0.01, most_condition = 1e6;

// What a last step gains, as a share of the loss, where a refinement has converged.
constexpr double little_gain = 0.03;

// Sets of samples that the held-out queries do not share with those refined on.
constexpr double refined_shift = 0.0, held_out_shift = 0.4321;

// The condition is that of M, whatever the table stores.
template <typename Node>
std::vector<SingularityBound> bounds_at(const TableNodes& nodes, const std::vector<Node>& stored) {
  const double most_gamma = nodes.creases.empty() ? 0 : most_fold(nodes.creases);
  std::vector<SingularityBound> bounds;
  for (std::size_t flat = 0; flat < stored.size(); ++flat) {
    const Eigen::Matrix3d matrix = matrix_of(stored[flat]);
    const Eigen::Vector3d scale =
        matrix_from_stored(nodes.storage, Eigen::Matrix3d::Identity(), nodes.grid.lobe(flat))
            .colwise()
            .norm();
    bounds.push_back({least_determinant_share * matrix.determinant(),
                      std::min(least_solid_angle, solid_angle_of_columns(matrix)),
                      std::max(most_condition, frobenius_condition(matrix * scale.asDiagonal())),
                      scale, most_gamma});
  }
  return bounds;
}

// How often the queries are evaluated, at most.
std::size_t evaluations(const RefineSettings& settings) {
  return static_cast<std::size_t>(settings.steps) + 1;
}

template <typename Node>
std::size_t memory_bytes(const Grid& grid, const std::vector<bool>& has_values,
                         const RefineSettings& settings) {
  using System = QuerySystemOf<Node>;
  const std::size_t nodes = grid.size();
  const std::size_t refined_on = refined_query_count(grid, has_values, settings) + nodes;
  const std::size_t held_out =
      std::min(refined_on, static_cast<std::size_t>(settings.held_out_queries));
  // Three iterates and their bounds, the vectors and blocks of a step.
  constexpr std::size_t of_node = 3 * sizeof(Node) + sizeof(SingularityBound) +
                                  sizeof(FreeEntries) + 8 * sizeof(NodeVector<Node>) +
                                  2 * sizeof(NodeMatrix<Node>);
  return System::memory_bytes(settings.sampling, refined_on, nodes, nodes) +
         System::memory_bytes(settings.sampling, held_out, held_out, nodes) +
         (refined_on + held_out) * (sizeof(Lobe) + sizeof(double)) + nodes * of_node;
}

double node_loss(const LossMeter& meter, const LobeFrame& frame, const TableNodes& nodes,
                 const Eigen::Matrix3d& stored, FitWorkspace& workspace) {
  const Eigen::Matrix3d p =
      frame.from_matrix(matrix_from_stored(nodes.storage, stored, frame.lobe));
  return meter.loss(frame, p / p.col(2).norm(), workspace);
}
double node_loss(const LossMeter& meter, const LobeFrame& frame, const TableNodes& nodes,
                 const FoldedNode& node, FitWorkspace& workspace) {
  const Eigen::Matrix3d p =
      frame.from_matrix(matrix_from_stored(nodes.storage, matrix_of(node), frame.lobe));
  const Fold fold = fold_of(node[9], node[10], frame.lobe, nodes.creases);
  return meter.loss(frame, p, fold, workspace);
}

}  // namespace

std::size_t refinement_memory_bytes(const Grid& grid, Storage storage,
                                    const std::vector<bool>& has_values,
                                    const RefineSettings& settings) {
  return storage == Storage::folded ? memory_bytes<FoldedNode>(grid, has_values, settings)
                                    : memory_bytes<Eigen::Matrix3d>(grid, has_values, settings);
}

template <typename Node>
RefineReport refine(const TableNodes& nodes, const std::vector<bool>& movable,
                    const std::vector<QueryRange>& asked, const RefineSettings& settings,
                    const RunContext& run, std::vector<Node>& stored) {
  const WeightedLobes refined_on =
      queries_to_refine_on(nodes.grid, nodes.has_values, asked, settings);
  const WeightedLobes held_out = queries_held_out(nodes.grid.alpha_min, *nodes.grid.model, asked,
                                                  settings, refined_on.lobes.size());
  const Stage stage(run, "refine",
                    evaluations(settings) * (refined_on.lobes.size() + held_out.lobes.size()));
  QuerySystemOf<Node> queries(nodes, refined_on, settings.sampling, refined_shift, run);
  QuerySystemOf<Node> judge(nodes, held_out, settings.sampling, held_out_shift, run);
  RefineReport report;
  report.queries = queries.size();
  if (judge.size() == 0)
    return report;
  // What is left out needs no work.
  run.advance(evaluations(settings) *
              (refined_on.lobes.size() - queries.size() + held_out.lobes.size() - judge.size()));
  const NodeSpace space(nodes.grid, nodes.storage, movable);
  std::vector<Node> current = stored;
  space.symmetrise(current);
  double objective = queries.evaluate(current, run);
  queries.adopt();
  // Relative to the weight of the queries that could be judged.
  const double judged =
      static_cast<double>(judge.size()) / static_cast<double>(held_out.lobes.size());
  report.loss_before = report.loss_after = judge.evaluate(stored, run) / judged;
  const std::vector<SingularityBound> bounds = bounds_at(nodes, current);
  double damping = settings.damping;
  while (report.steps < settings.steps) {
    ++report.steps;
    const NodeVectorsOf<Node> step =
        refinement_step(queries, space, current, damping, settings.overshoot, run);
    const std::vector<Node> trial = stepped(nodes.storage, current, step, bounds);
    const double next = queries.evaluate(trial, run);
    if (!(next < objective)) {
      damping *= damping_rise;
      continue;
    }
    const double gain = objective - next;
    objective = next;
    report.converged = gain < little_gain * objective;
    queries.adopt();
    current = trial;
    damping = std::max(damping * damping_fall, least_damping);
    const double loss = judge.evaluate(current, run) / judged;
    if (loss < report.loss_after) {
      report.loss_after = loss;
      report.kept = true;
      stored = current;
    }
    if (gain < settings.tolerance * objective)
      break;
  }
  report.converged = report.converged && report.kept;
  return report;
}

template <typename Node>
std::vector<double> node_losses(const TableNodes& nodes, const std::vector<Node>& stored,
                                const RunContext& run) {
  const Grid& grid = nodes.grid;
  const LossMeter meter(nodes.creases);
  std::vector<double> losses(grid.size(), std::numeric_limits<double>::quiet_NaN());
  spread_for_each<FitWorkspace>(
      "node losses", Spreading::moving, grid.size(), run, [] { return FitWorkspace(); },
      [&](std::size_t flat, FitWorkspace& workspace) {
        if (!nodes.has_values[flat])
          return;
        const LobeFrame frame(grid.lobe(flat));
        meter.set_target(frame, workspace);
        losses[flat] = node_loss(meter, frame, nodes, stored[flat], workspace);
      },
      [&](std::size_t flat, auto&& take) { take(bytes_of(losses[flat])); });
  return losses;
}

template RefineReport refine(const TableNodes&, const std::vector<bool>&,
                             const std::vector<QueryRange>&, const RefineSettings&,
                             const RunContext&, std::vector<Eigen::Matrix3d>&);
template RefineReport refine(const TableNodes&, const std::vector<bool>&,
                             const std::vector<QueryRange>&, const RefineSettings&,
                             const RunContext&, std::vector<FoldedNode>&);
template std::vector<double> node_losses(const TableNodes&, const std::vector<Eigen::Matrix3d>&,
                                         const RunContext&);
template std::vector<double> node_losses(const TableNodes&, const std::vector<FoldedNode>&,
                                         const RunContext&);

}  // namespace ltc
