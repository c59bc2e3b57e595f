// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/node_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "align/align.h"
#include "core/spread.h"
#include "field/field.h"
#include "fit/fit_journal.h"
#include "fit/lobe_frame.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A fit that ends above the loss that others tell of its lobe by this factor may have fallen into
// another minimum.
constexpr double led_astray = 1.3;

// What a loss is taken for at least: it has a logarithm.
constexpr double least_loss = 1e-30;

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
      solver_(make_solver(settings)) {}

std::vector<std::size_t> NodeFits::unknown_of(const std::vector<std::size_t>& nodes) {
  std::vector<std::size_t> unknown;
  for (const std::size_t flat : nodes)
    if (const std::size_t first = first_of(flat); !known_.contains(first))
      unknown.push_back(first);
  std::ranges::sort(unknown);
  unknown.erase(std::ranges::unique(unknown).begin(), unknown.end());
  // The first rank has the journal.
  std::string is_known, known;
  for (const std::size_t first : unknown) {
    FittedEntry entry;
    is_known += journal_ && journal_->recall(0, first, entry) ? 'k' : 'u';
    if (is_known.back() == 'k')
      append_bytes(entry, known);
  }
  share_from_first(run_.ranks, is_known);
  share_from_first(run_.ranks, known);
  std::size_t at = 0, i = 0;
  std::erase_if(unknown, [&](std::size_t first) {
    if (is_known[i++] == 'u')
      return false;
    FittedEntry entry;
    at += take_bytes(known, at, entry);
    known_.emplace(first, entry);
    return true;
  });
  return unknown;
}

void NodeFits::note(std::size_t first, const FittedEntry& entry) const {
  // A stop ends a fit early, with whatever it has.
  if (journal_ && !run_.stop_requested())
    journal_->note(0, first, entry);
}

void NodeFits::fit(std::string_view stage, const std::vector<std::size_t>& nodes,
                   const std::function<NodeValues(std::size_t)>& near) {
  const std::vector<std::size_t> unknown = unknown_of(nodes);
  std::vector<FittedEntry> fitted(unknown.size());
  spread_for_each<FitWorkspacePointer>(
      stage, Spreading::moving, unknown.size(), run_, make_fit_workspace,
      [&](std::size_t i, FitWorkspacePointer& workspace) {
        const NodeValues start = near ? near(unknown[i]) : NodeValues::Constant(nan);
        fitted[i] = fit_alone(unknown[i], *workspace, &start);
        note(unknown[i], fitted[i]);
      },
      [&](std::size_t i, auto&& take) { take(bytes_of(fitted[i])); },
      [&](std::size_t i) { note(unknown[i], fitted[i]); });
  for (std::size_t i = 0; i < unknown.size(); ++i)
    known_.emplace(unknown[i], fitted[i]);
}

FittedEntry NodeFits::fit_alone(std::size_t first, FitWorkspace& workspace,
                                const NodeValues* near) const {
  FitRequest request;
  request.lobe = grid_.lobe(first);
  request.seed = entry_seed(settings_.seed, first);
  request.progress = run_.progress;
  if (near && near->isFinite().all())
    if (const Eigen::Matrix3d start = matrix_of(request.lobe, *near); start.determinant() > 0)
      request.near = start;
  FittedEntry entry;
  fit_entry(*solver_, request, workspace, nullptr, entry);
  if (!request.near || (has_values(entry.status) && entry.loss < led_astray * loss_of(*near)))
    return entry;
  request.near.reset();
  FittedEntry anew;
  fit_entry(*solver_, request, workspace, nullptr, anew);
  return has_values(entry.status) && entry.loss <= anew.loss ? entry : anew;
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
  return values_at(flat, known_.at(first_of(flat)));
}

NodeValues NodeFits::values_at(std::size_t flat, const FittedEntry& fitted) const {
  if (!has_values(fitted.status))
    return NodeValues::Constant(nan);
  return values_of(grid_.lobe(flat), align(turned(fitted.matrix, turn_radians(flat))), fitted.loss);
}

double NodeFits::excess_of(std::size_t flat, const NodeValues& own, const NodeValues& interpolated,
                           FitWorkspace& workspace) const {
  if (!own.isFinite().all() || !interpolated.isFinite().all())
    return nan;
  const LobeFrame frame(grid_.lobe(flat));
  meter_.set_target(frame, workspace);
  const auto loss = [&](const NodeValues& values) {
    return meter_.loss(frame, frame.from_matrix(matrix_of(frame.lobe, values)), workspace);
  };
  return loss(interpolated) / loss(own) - 1;
}

std::vector<double> NodeFits::excess(std::string_view stage, const std::vector<std::size_t>& nodes,
                                     const std::vector<NodeValues>& interpolated) {
  // Those of lobes that are not known first, each once, so that no two threads fit the same.
  const std::vector<std::size_t> unknown = unknown_of(nodes);
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    place.emplace(unknown[i], i);
  std::vector<std::vector<std::size_t>> of_unknown(unknown.size());
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const auto found = place.find(first_of(nodes[i])); found != place.end())
      of_unknown[found->second].push_back(i);
    else
      others.push_back(i);

  std::vector<double> result(nodes.size());
  std::vector<FittedEntry> fitted(unknown.size());
  const auto compare = [&](std::size_t i, const FittedEntry& entry, FitWorkspace& workspace) {
    result[i] = excess_of(nodes[i], values_at(nodes[i], entry), interpolated[i], workspace);
  };
  spread_for_each<FitWorkspacePointer>(
      stage, Spreading::moving, unknown.size() + others.size(), run_, make_fit_workspace,
      [&](std::size_t i, FitWorkspacePointer& workspace) {
        if (i >= unknown.size()) {
          const std::size_t at = others[i - unknown.size()];
          compare(at, known_.at(first_of(nodes[at])), *workspace);
          return;
        }
        // Another node of the lobe has it turned.
        const std::size_t asked = of_unknown[i].front();
        fitted[i] = fit_alone(unknown[i], *workspace,
                              nodes[asked] == unknown[i] ? &interpolated[asked] : nullptr);
        note(unknown[i], fitted[i]);
        for (const std::size_t at : of_unknown[i])
          compare(at, fitted[i], *workspace);
      },
      [&](std::size_t i, auto&& take) {
        if (i >= unknown.size()) {
          take(bytes_of(result[others[i - unknown.size()]]));
          return;
        }
        take(bytes_of(fitted[i]));
        for (const std::size_t at : of_unknown[i])
          take(bytes_of(result[at]));
      },
      [&](std::size_t i) {
        if (i < unknown.size())
          note(unknown[i], fitted[i]);
      });
  for (std::size_t i = 0; i < unknown.size(); ++i)
    known_.emplace(unknown[i], fitted[i]);
  return result;
}

}  // namespace ltc
