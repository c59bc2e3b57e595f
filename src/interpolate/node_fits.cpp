// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/node_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "align/align.h"
#include "core/parallel.h"
#include "field/field.h"
#include "fit/fit_journal.h"
#include "fit/lobe_frame.h"
#include "fit/sample_ladder.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// What a loss is taken for at least: it has a logarithm.
constexpr double least_loss = 1e-30;

// Enough to tell a per cent, in a fifth of the time of a fit.
constexpr int compared_samples = 1024;
constexpr std::size_t compared_directions = 24;

Eigen::Vector3d widths_of(const Lobe& lobe) {
  return {lobe.alpha_x, width_across(lobe), 1};
}

}  // namespace

NodeValues values_of(const Lobe& lobe, const Eigen::Matrix3d& aligned, double loss) {
  const Eigen::Matrix3d inner = mirror_rotation(lobe.omega_v()).transpose() *
                                (aligned / aligned.col(2).norm()) *
                                widths_of(lobe).cwiseInverse().asDiagonal();
  NodeValues values;
  for (int i = 0; i < 9; ++i)
    values[i] = inner(i / 3, i % 3);
  values[9] = std::log(std::max(loss, least_loss));
  return values;
}

Eigen::Matrix3d matrix_of(const Lobe& lobe, const NodeValues& values) {
  Eigen::Matrix3d inner;
  for (int i = 0; i < 9; ++i)
    inner(i / 3, i % 3) = values[i];
  return mirror_rotation(lobe.omega_v()) * inner * widths_of(lobe).asDiagonal();
}

double loss_of(const NodeValues& values) {
  return std::exp(values[9]);
}

NodeFits::NodeFits(const Grid& grid, const FitSettings& settings, const RunContext& run,
                   FitJournal* journal)
    : grid_(grid),
      settings_(settings),
      run_(run),
      journal_(journal),
      equal_(grid),
      solver_(make_solver(settings)),
      meter_(bins_for(compared_samples), compared_samples, compared_directions) {}

void NodeFits::fit(std::string_view stage, const std::vector<std::size_t>& nodes) {
  std::vector<std::size_t> unknown;
  for (const std::size_t flat : nodes)
    if (const std::size_t first = first_of(flat); !known_.contains(first))
      unknown.push_back(first);
  std::ranges::sort(unknown);
  unknown.erase(std::ranges::unique(unknown).begin(), unknown.end());
  std::erase_if(unknown, [&](std::size_t first) {
    FittedEntry entry;
    const bool recalled = journal_ && journal_->recall(0, first, entry);
    if (recalled)
      known_.emplace(first, entry);
    return recalled;
  });
  std::vector<FittedEntry> fitted(unknown.size());
  parallel_for_each<FitWorkspacePointer>(stage, unknown.size(), run_, make_fit_workspace,
                                         [&](std::size_t i, FitWorkspacePointer& workspace) {
                                           fitted[i] = fit_alone(unknown[i], *workspace);
                                           // A stop ends a fit early, with whatever it has.
                                           if (journal_ && !run_.stop_requested())
                                             journal_->note(0, unknown[i], fitted[i]);
                                         });
  for (std::size_t i = 0; i < unknown.size(); ++i)
    known_.emplace(unknown[i], fitted[i]);
}

FittedEntry NodeFits::fit_alone(std::size_t first, FitWorkspace& workspace) const {
  FittedEntry entry;
  fit_entry(*solver_, {grid_.lobe(first), entry_seed(settings_.seed, first), {}, {}, run_.progress},
            workspace, nullptr, entry);
  return entry;
}

double NodeFits::turn_radians(std::size_t flat) const {
  const NodeIndex node = grid_.node(flat);
  if (looks_upward(grid_.theta.nodes[node.theta]))
    return 0;
  return grid_.phi.nodes[node.phi] - grid_.phi.nodes[grid_.node(first_of(flat)).phi];
}

const FittedEntry* NodeFits::find(std::size_t first) const {
  const auto found = known_.find(first);
  return found == known_.end() ? nullptr : &found->second;
}

NodeValues NodeFits::values_at(std::size_t flat) const {
  const FittedEntry& entry = known_.at(first_of(flat));
  if (!has_values(entry.status))
    return NodeValues::Constant(nan);
  return values_of(grid_.lobe(flat), align(turned(entry.matrix, turn_radians(flat))), entry.loss);
}

std::vector<double> NodeFits::excess(const std::vector<std::size_t>& nodes,
                                     const std::vector<NodeValues>& interpolated) const {
  std::vector<double> result(nodes.size(), nan);
  parallel_for_each<FitWorkspacePointer>(
      "compare", nodes.size(), run_, make_fit_workspace,
      [&](std::size_t i, FitWorkspacePointer& workspace) {
        const NodeValues own = values_at(nodes[i]);
        if (!own.isFinite().all() || !interpolated[i].isFinite().all())
          return;
        const LobeFrame frame(grid_.lobe(nodes[i]));
        meter_.set_target(frame, *workspace);
        const auto loss = [&](const NodeValues& values) {
          return meter_.loss(frame, frame.from_matrix(matrix_of(frame.lobe, values)), *workspace);
        };
        result[i] = loss(interpolated[i]) / loss(own) - 1;
      });
  return result;
}

}  // namespace ltc
