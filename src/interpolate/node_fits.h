// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fits of some nodes of a grid, and what of them is interpolated. Those without values to start
// from are the same as in a table of which every node is fitted.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "fit/fit_table.h"
#include "fit/loss_meter.h"
#include "fit/symmetry_plan.h"

namespace ltc {

// The nine numbers of W = Q^T M diag(1/alpha_x, 1/s_y, 1), by rows, of an aligned M with a third
// column of unit length, and the logarithm of its loss. Q is mirror_rotation, s_y width_across of
// field/field.h: alpha_y as far as it matters. P of fit/lobe_frame.h has alpha_y in its place and
// grows without bound where lambda goes to 0, W does not.
using NodeValues = Eigen::Array<double, 10, 1>;

NodeValues values_of(const Lobe& lobe, const Eigen::Matrix3d& aligned, double loss);
Eigen::Matrix3d matrix_of(const Lobe& lobe, const NodeValues& values);  // M
double loss_of(const NodeValues& values);

class NodeFits {
 public:
  // `journal` as for fit_table; may be null. All of them outlive this.
  NodeFits(const Grid& grid, const FitSettings& settings, const RunContext& run,
           FitJournal* journal);

  // Fits the lobes of these nodes that are not known yet; from values near theirs, where there is
  // what tells them of a lobe's first node. Throws Interrupted.
  void fit(std::string_view stage, const std::vector<std::size_t>& nodes,
           const std::function<NodeValues(std::size_t)>& near = {});
  std::size_t count() const { return known_.size(); }

  // The node whose fit is that of another, and by how much that has to be turned about the normal.
  std::size_t first_of(std::size_t flat) const { return equal_.first_of(flat); }
  double turn_radians(std::size_t flat) const;
  const EqualLobes& equal() const { return equal_; }

  // Of a lobe that is known, of the node that is its first; null where it is not.
  const FittedEntry* find(std::size_t first) const;
  // NaN where its fit failed.
  NodeValues values_at(std::size_t flat) const;

  // One more fit, which is not kept; from near values, where these are finite. From any thread.
  FittedEntry fit_alone(std::size_t first, FitWorkspace& workspace,
                        const NodeValues* near = nullptr) const;

  // By how much the loss of interpolated values exceeds that of the node's own fit, as a share of
  // it, on samples that are not those of the fit; one a node, of which those that are not known are
  // fitted, from these values if the node is its lobe's first. NaN where there is no fit. Throws
  // Interrupted.
  std::vector<double> excess(std::string_view stage, const std::vector<std::size_t>& nodes,
                             const std::vector<NodeValues>& interpolated);

 private:
  // Those of the nodes' lobes that are not known, each once; what the journal knows of them is.
  std::vector<std::size_t> unknown_of(const std::vector<std::size_t>& nodes);
  void note(std::size_t first, const FittedEntry& entry) const;
  NodeValues values_at(std::size_t flat, const FittedEntry& fitted) const;
  double excess_of(std::size_t flat, const NodeValues& own, const NodeValues& interpolated,
                   FitWorkspace& workspace) const;

  const Grid& grid_;
  const FitSettings& settings_;
  const RunContext run_;
  FitJournal* const journal_;
  const EqualLobes equal_;
  const std::unique_ptr<Solver> solver_;
  const LossMeter meter_;
  std::unordered_map<std::size_t, FittedEntry> known_;
};

}  // namespace ltc
