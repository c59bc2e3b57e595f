// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/table_map.h"

#include <fmt/format.h>

#include <utility>

#include "core/angle.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

picture::MapAxis map_axis(const char* title, const Axis& axis, double unit, const char* sign) {
  picture::MapAxis result{axis.size(), title};
  for (const double node : axis.nodes)
    result.labels.push_back(fmt::format("{:.3g}{}", node / unit, sign));
  return result;
}

}  // namespace

picture::CellMark mark_of(const Grid& grid, std::size_t flat) {
  return {grid.indices(flat), entry_text(grid, flat)};
}

picture::TiledMap table_map(const Grid& grid, const std::vector<double>& values,
                            picture::ColorScale colors) {
  picture::TiledMap map{.colors = std::move(colors)};
  const bool both = grid.layout == Layout::alphax_alphay;
  map.tile_rows = map_axis(both ? "αx" : "α", grid.alpha, 1, "");
  map.tile_columns = map_axis(both ? "αy" : "λ", grid.lambda, 1, "");
  map.rows = map_axis("θ", grid.theta, radians_per_degree, "°");
  map.columns = map_axis("φ", grid.phi, radians_per_degree, "°");
  map.values.assign(values.begin(), values.end());
  return map;
}

}  // namespace ltc
