// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "interpolate/between_fits.h"

#include <Eigen/LU>
#include <memory>
#include <numeric>

#include "align/align.h"
#include "core/parallel.h"

namespace ltc {
namespace {

constexpr std::size_t axis_count = Grid::axis_count;

// The first two, for the losses at their ends lie far apart, every second of the others, and the
// last.
AxisNodes every_second(const AxisNodes& nodes) {
  AxisNodes some;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (i == 0 || i % 2 == 1 || i + 1 == nodes.size())
      some.push_back(nodes[i]);
  return some;
}

class Filling {
 public:
  Filling(const Grid& grid, const FitSettings& fit, const BetweenFitsSettings& settings,
          const RunContext& run, FitJournal* journal)
      : grid_(grid), settings_(settings), run_(run), fits_(grid, fit, run, journal) {}

  BetweenFitsReport fill(const std::function<void(std::size_t, FittedEntry)>& store) {
    BetweenFitsReport report;
    report.axes = probe_axes(grid_, settings_.probe, fits_);
    Lattice lattice(grid_, report.axes);
    fit_all_of(lattice);
    report.lattice_fits = fits_.count();
    LatticeCells open(lattice.axes(), true);
    while (largest_gap(lattice.axes()) > 2) {
      LatticeCells failing = failing_cells(lattice, open);
      const LatticeAxes finer = halved(lattice.axes());
      fit_nodes_of(failing, finer, lattice);
      open = cells_within(failing, finer);
      lattice = interpolated(lattice, finer);
    }
    LatticeAxes all;
    for (std::size_t axis = 0; axis < axis_count; ++axis)
      all[axis] = every(1, grid_.axis(axis).size());
    fit_nodes_of(failing_cells(lattice, open), all, lattice);
    store_all(lattice, store);
    report.fits = fits_.count();
    return report;
  }

 private:
  std::size_t flat(const LatticePlace& at) const {
    return grid_.flat({at[0], at[1], at[2], at[3]});
  }

  // Every second node of each axis first, and the others from what these tell of them.
  void fit_all_of(Lattice& lattice) {
    LatticeAxes some = lattice.axes();
    for (AxisNodes& nodes : some)
      nodes = every_second(nodes);
    Lattice sparse(grid_, some);
    fits_.fit("fit", nodes_of(sparse));
    read_values(sparse);
    fit_near(sparse, nodes_of(lattice));
    read_values(lattice);
  }
  // From what a lattice tells of their lobes.
  void fit_near(const Lattice& known, const std::vector<std::size_t>& nodes) {
    fits_.fit("fit", nodes, [&](std::size_t first) { return known.at(grid_.indices(first)); });
  }
  static std::vector<std::size_t> nodes_of(const Lattice& lattice) {
    std::vector<std::size_t> nodes(lattice.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i] = lattice.flat(i);
    return nodes;
  }
  void read_values(Lattice& lattice) const {
    parallel_for(lattice.size(), run_,
                 [&](std::size_t i) { lattice[i] = fits_.values_at(lattice.flat(i)); });
  }

  // Those that are open, have nodes inside, and are not well enough interpolated in their middle.
  LatticeCells failing_cells(const Lattice& lattice, const LatticeCells& open) {
    std::vector<std::size_t> cells, middles;
    for (std::size_t cell = 0; cell < open.size(); ++cell)
      if (open[cell] && open.has_inside(cell)) {
        cells.push_back(cell);
        middles.push_back(fits_.first_of(flat(open.middle(cell))));
      }
    std::vector<NodeValues> values(middles.size());
    parallel_for(middles.size(), run_,
                 [&](std::size_t i) { values[i] = lattice.at(grid_.indices(middles[i])); });
    const std::vector<double> excess = fits_.excess("check", middles, values);
    LatticeCells failing(lattice.axes(), false);
    for (std::size_t i = 0; i < cells.size(); ++i)
      failing.set(cells[i], !(excess[i] <= settings_.tolerance));
    return failing;
  }

  // Fits what failing cells hold of the nodes of a finer lattice, from what the coarse one has
  // there.
  void fit_nodes_of(const LatticeCells& failing, const LatticeAxes& finer, const Lattice& coarse) {
    std::vector<std::size_t> nodes;
    for_each_place(finer, [&](const LatticePlace& at) {
      if (failing.any_at(at))
        nodes.push_back(flat(at));
    });
    fit_near(coarse, nodes);
  }

  template <typename Work>
  static void for_each_place(const LatticeAxes& axes, Work&& work) {
    for (const std::size_t alpha : axes[0])
      for (const std::size_t lambda : axes[1])
        for (const std::size_t theta : axes[2])
          for (const std::size_t phi : axes[3])
            work(LatticePlace{alpha, lambda, theta, phi});
  }

  // The cells of a finer lattice that lie in failing ones.
  static LatticeCells cells_within(const LatticeCells& failing, const LatticeAxes& finer) {
    LatticeCells open(finer, false);
    for (std::size_t cell = 0; cell < open.size(); ++cell)
      open.set(cell, failing.behind(open.corner(cell)));
    return open;
  }

  // Own fits where there are any.
  Lattice interpolated(const Lattice& coarse, const LatticeAxes& finer) const {
    Lattice lattice(grid_, finer);
    const std::size_t plane = finer[2].size() * finer[3].size();
    struct None {};
    parallel_for<None>(
        lattice.size() / plane, run_, [] { return None(); },
        [&](std::size_t pair, None&) {
          const std::size_t alpha = finer[0][pair / finer[1].size()];
          const std::size_t lambda = finer[1][pair % finer[1].size()];
          const std::vector<NodeValues> values = coarse.plane(alpha, lambda, finer[2], finer[3]);
          for (std::size_t i = 0; i < plane; ++i) {
            const std::size_t number = pair * plane + i, node = lattice.flat(number);
            lattice[number] = fits_.find(fits_.first_of(node)) ? fits_.values_at(node) : values[i];
          }
        });
    return lattice;
  }

  void store_all(const Lattice& lattice,
                 const std::function<void(std::size_t, FittedEntry)>& store) const {
    const auto& groups = fits_.equal().pairs();
    const std::size_t plane = grid_.theta.size() * grid_.phi.size();
    const Stage stage(run_, "interpolate", grid_.size());
    parallel_for<FitWorkspacePointer>(
        groups.size(), run_, make_fit_workspace,
        [&](std::size_t group, FitWorkspacePointer& workspace) {
          const std::vector<FittedEntry> entries =
              entries_of(lattice, groups[group].front() * plane, *workspace);
          for (const std::size_t pair : groups[group])
            for (std::size_t i = 0; i < plane; ++i) {
              FittedEntry entry = entries[i];
              if (pair != groups[group].front() && has_values(entry.status)) {
                entry.status = Status::copied;
                entry.steps = 0;
              }
              store(pair * plane + i, entry);
            }
          run_.advance(groups[group].size() * plane);
        });
  }

  // All of one alpha and lambda, whose first node is `first`.
  std::vector<FittedEntry> entries_of(const Lattice& lattice, std::size_t first,
                                      FitWorkspace& workspace) const {
    const NodeIndex at = grid_.node(first);
    const std::vector<NodeValues> values = lattice.plane(
        at.alpha, at.lambda, every(1, grid_.theta.size()), every(1, grid_.phi.size()));
    std::vector<FittedEntry> entries(values.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::size_t node = first + i, representative = fits_.first_of(node);
      if (representative == node) {
        entries[i] = entry_of(node, values[i], workspace);
        continue;
      }
      const FittedEntry& source = entries[representative - first];
      entries[i] = {turned(source.matrix, fits_.turn_radians(node)), source.loss, 0,
                    has_values(source.status) ? Status::copied : source.status};
    }
    for (FittedEntry& entry : entries)
      if (has_values(entry.status))
        entry.matrix = align(entry.matrix);
    return entries;
  }

  FittedEntry entry_of(std::size_t node, const NodeValues& values, FitWorkspace& workspace) const {
    if (const FittedEntry* const fitted = fits_.find(node))
      return *fitted;
    const FittedEntry entry{matrix_of(grid_.lobe(node), values), loss_of(values), 0,
                            Status::interpolated};
    // Never seen: the middle of its cell was no better then.
    if (!values.isFinite().all() || !(entry.matrix.determinant() > 0))
      return fits_.fit_alone(node, workspace);
    return entry;
  }

  const Grid& grid_;
  const BetweenFitsSettings& settings_;
  const RunContext run_;
  NodeFits fits_;
};

// Of an axis: what probing leaves of it, measured with the paper's.
double lattice_nodes(std::size_t size) {
  const auto n = static_cast<double>(size);
  return size <= 12 ? n : std::min(n, 7.5 + n / 6.7);
}

}  // namespace

std::size_t estimated_fits(const Grid& grid) {
  double fits = 1;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    fits *= lattice_nodes(grid.axis(axis).size());
  return std::min(static_cast<std::size_t>(2 * fits), EqualLobes(grid).count());
}

std::size_t between_fits_memory_bytes(const Grid& grid) {
  // The last lattice has about every second node of each axis, and the one before is still there;
  // a fit is known here, in the journal and in the checkpoint that is being written.
  constexpr std::size_t of_fit = 2 * (sizeof(FittedEntry) + 48) + sizeof(FittedEntry);
  double lattice = sizeof(NodeValues) * 1.2;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    lattice *= std::min(static_cast<double>(grid.axis(axis).size()),
                        static_cast<double>(grid.axis(axis).size()) / 2 + 4);
  return static_cast<std::size_t>(lattice) + estimated_fits(grid) * of_fit;
}

BetweenFitsReport fill_between_fits(const Grid& grid, const FitSettings& fit,
                                    const BetweenFitsSettings& settings, const RunContext& run,
                                    FitJournal* journal,
                                    const std::function<void(std::size_t, FittedEntry)>& store) {
  return Filling(grid, fit, settings, run, journal).fill(store);
}

}  // namespace ltc
