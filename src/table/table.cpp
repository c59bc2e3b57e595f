// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/table.h"

#include <limits>

namespace ltc {
namespace {

using RowMajorMatrix3f = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;

}  // namespace

Table Table::empty(const Grid& grid, Storage storage) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Table table;
  table.grid = grid;
  table.storage = storage;
  table.stored.assign(9 * grid.size(), nan);
  table.amplitude.assign(grid.size(), nan);
  table.fresnel.assign(grid.size(), nan);
  if (storage == Storage::folded)
    table.fold.assign(2 * grid.size(), nan);
  table.sw_loss.assign(grid.size(), nan);
  table.status.assign(grid.size(), Status::skipped);
  table.iterations.assign(grid.size(), 0);
  return table;
}

Eigen::Matrix3d Table::stored_at(std::size_t flat) const {
  return Eigen::Map<const RowMajorMatrix3f>(stored.data() + 9 * flat).cast<double>();
}

void Table::set_stored(std::size_t flat, const Eigen::Matrix3d& value) {
  Eigen::Map<RowMajorMatrix3f>(stored.data() + 9 * flat) = value.cast<float>();
}

Eigen::Matrix3d Table::matrix_at(std::size_t flat) const {
  return matrix_from_stored(storage, stored_at(flat), grid.lobe(flat));
}

Fold Table::fold_at(std::size_t flat) const {
  if (storage != Storage::folded)
    return {};
  return fold_of(fold[2 * flat], fold[2 * flat + 1], grid.lobe(flat), creases);
}

}  // namespace ltc
