// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"

namespace ltc {
namespace {

constexpr std::size_t bytes_per_entry = (9 + 2 + 3) * sizeof(float) + sizeof(Status) + 2;
static_assert(max_nodes_per_axis * max_nodes_per_axis * max_nodes_per_axis * max_nodes_per_axis *
                      bytes_per_entry <
                  std::size_t{2} << 30,
              "the bound on the nodes of an axis keeps every table below 2 GiB");

// What is wrong with an axis whose values may lie in [least, most]; empty if nothing is.
std::string fault(const Axis& axis, double least, double most) {
  const std::vector<double>& nodes = axis.nodes;
  if (nodes.empty() || nodes.size() > max_nodes_per_axis)
    return fmt::format("{} nodes; allowed: 1 to {}", nodes.size(), max_nodes_per_axis);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!(nodes[i] >= least && nodes[i] <= most))
      return fmt::format("node {} is {}; allowed: {} to {}", i, nodes[i], least, most);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (!(nodes[i - 1] < nodes[i]))
      return fmt::format("node {} is {} after {}; nodes must strictly increase", i, nodes[i],
                         nodes[i - 1]);
  // A look-up goes by the first and last node and the warp alone: a node elsewhere would be read in
  // the wrong place. Far above rounding, far below any distance between nodes that matters.
  const double tolerance = 1e-6 * (axis.last() - axis.first());
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const double expected =
        axis.value(static_cast<double>(i) / static_cast<double>(nodes.size() - 1));
    if (std::abs(nodes[i] - expected) > tolerance)
      return fmt::format("node {} is {}; warp {} puts it at {}", i, nodes[i], name_of(axis.warp),
                         expected);
  }
  return {};
}

}  // namespace

void require_consistent(const Grid& grid, const std::filesystem::path& file) {
  constexpr double quarter_turn = std::numbers::pi / 2 * (1 + 1e-12);
  constexpr double largest_float = 3.4e38;
  const std::array<double, 4> most = {largest_float, 1, quarter_turn, quarter_turn};
  for (std::size_t i = 0; i < Grid::axis_count; ++i)
    if (const std::string what = fault(grid.axis(i), 0, most[i]); !what.empty())
      refuse_file(file, fmt::format("axis {}: {}", grid.axis_names()[i], what));
  if (!(grid.alpha_min > 0 && std::isfinite(grid.alpha_min)))
    refuse_file(file, fmt::format("alpha_min is {}; it must be positive", grid.alpha_min));
}

void require_shapes(const Table& table, const std::filesystem::path& file) {
  require_consistent(table.grid, file);
  const std::size_t entries = table.grid.size();
  const auto require = [&](std::string_view name, std::size_t size, std::size_t expected) {
    if (size != expected)
      refuse_file(file, fmt::format("{} has {} values; the axes ask for {}", name, size, expected));
  };
  require("matrix", table.stored.size(), 9 * entries);
  require("amplitude", table.amplitude.size(), entries);
  require("fresnel", table.fresnel.size(), entries);
  require("sw_loss", table.sw_loss.size(), entries);
  require("status", table.status.size(), entries);
  require("iterations", table.iterations.size(), entries);
  require("fold", table.fold.size(), is_folded(table) ? 2 * entries : 0);
  if (is_folded(table))
    require_creases(table.creases, file);
}

void require_creases(const Creases& creases, const std::filesystem::path& file) {
  constexpr double most = 100;
  const bool in_range = std::ranges::all_of(creases, [](double h) { return h >= 0 && h <= most; });
  if (creases.empty() || creases.size() > most_creases || !in_range)
    refuse_file(file, fmt::format("creases are [{}]; allowed: one to {} numbers of 0 to {}",
                                  fmt::join(creases, ", "), most_creases, most));
  if (std::ranges::adjacent_find(creases, std::greater_equal()) != creases.end())
    refuse_file(file,
                fmt::format("creases are [{}]; they must increase", fmt::join(creases, ", ")));
}

void require_consistent(const Table& table, const std::filesystem::path& file) {
  require_shapes(table, file);
  if (table.storage == Storage::inverse && !is_isotropic(table.grid))
    refuse_file(file, "storage is inverse, yet lambda = 1 and phi = 0 are not its only nodes");
  for (std::size_t i = 0; i < table.grid.size(); ++i) {
    if (!has_values(table.status[i]))
      continue;
    const auto require_finite = [&](const char* name, const std::vector<float>& values,
                                    std::size_t count) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(count * i);
      if (!std::all_of(first, first + static_cast<std::ptrdiff_t>(count),
                       [](float value) { return std::isfinite(value); }))
        refuse_file(file,
                    fmt::format("{} of entry ({}) is not finite, yet its status is {}; only a "
                                "skipped (0) or failed (4) entry has none",
                                name, fmt::join(table.grid.indices(i), ", "),
                                static_cast<int>(table.status[i])));
    };
    require_finite("matrix", table.stored, 9);
    if (is_folded(table))
      require_finite("fold", table.fold, 2);
  }
}

void require_albedo(const Table& table, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < table.grid.size(); ++i)
    if (has_values(table.status[i]) &&
        !(std::isfinite(table.amplitude[i]) && std::isfinite(table.fresnel[i])))
      refuse_file(file, fmt::format("the table has no amplitude or no Fresnel term at entry ({}); "
                                    "such files hold both",
                                    fmt::join(table.grid.indices(i), ", ")));
}

}  // namespace ltc
