// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/start_table.h"

#include <limits>

#include "core/spread.h"
#include "fit/arc_model.h"
#include "fit/lobe_class.h"
#include "fit/lobe_frame.h"
#include "fit/starting_points.h"

namespace ltc {
namespace {

constexpr std::size_t target_samples = 1024, direction_count = 8, thresholds = 8, arc_nodes = 6;

class Starts {
 public:
  struct Workspace {
    TargetSamples samples;
    AlignedFloats xi;
    ArcTarget target;
    ArcWorkspace arcs;
  };

  FittedEntry of(const Lobe& lobe, Workspace& workspace) const {
    const LobeFrame frame(lobe);
    FittedEntry entry;
    entry.status = first_order_is_exact(frame) ? Status::analytic : Status::fitted;
    const Eigen::Matrix3d p = entry.status == Status::analytic
                                  ? admissible(frame.first_order, free_entries(lobe))
                                  : better_start(frame, workspace);
    entry.matrix = rounded_to_symmetry(lobe, frame.to_matrix(p));
    entry.loss = std::numeric_limits<double>::quiet_NaN();
    return entry;
  }

 private:
  Eigen::Matrix3d better_start(const LobeFrame& frame, Workspace& workspace) const {
    sample_weighted_target(frame, lattice_, workspace.samples);
    set_target(workspace.samples, directions_, rule_, workspace.xi, workspace.target);
    const auto loss = [&](const Eigen::Matrix3d& p) {
      return arc_loss(point_of_frame(frame, p), {directions_, rule_, workspace.target},
                      workspace.arcs);
    };
    const Eigen::Matrix3d by_moments = moment_start(frame, workspace.samples);
    const Eigen::Matrix3d by_first_order = first_order_start(frame);
    return loss(by_first_order) < loss(by_moments) ? by_first_order : by_moments;
  }

  const TargetLattice lattice_ = make_target_lattice(target_samples);
  const ArcDirections directions_ = in_float(fibonacci_directions(direction_count));
  const ArcRule rule_{thresholds, arc_nodes};
};

}  // namespace

std::vector<FittedEntry> start_table(const Grid& grid, const std::vector<PlannedEntry>& plan,
                                     const RunContext& run) {
  const Starts starts;
  std::vector<FittedEntry> entries(grid.size());
  spread_for_each<Starts::Workspace>(
      "starts", Spreading::moving, plan.size(), run, [] { return Starts::Workspace(); },
      [&](std::size_t flat, Starts::Workspace& workspace) {
        if (plan[flat].representative == flat)
          entries[flat] = starts.of(grid.lobe(flat), workspace);
      },
      [&](std::size_t flat, auto&& take) { take(bytes_of(entries[flat])); });
  copy_by_symmetry(plan, run, entries);
  return entries;
}

}  // namespace ltc
