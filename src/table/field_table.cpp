// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/field_table.h"

#include "core/error.h"
#include "core/parallel.h"

namespace ltc {

Table table_of_field(const Field& field, Grid grid, Storage storage, const RunContext& run) {
  grid.alpha_min = field.alpha_min;
  grid.model = field.model;
  if (storage == Storage::inverse && !is_isotropic(grid))
    throw InputError(
        "storage inverse: only of a grid whose only nodes of lambda and phi are 1 and 0");
  if (!field.creases.empty())
    storage = Storage::folded;
  Table table = Table::empty(grid, storage);
  table.field = field;
  table.creases = field.creases;
  table.refined = true;
  parallel_for(grid.size(), run, [&](std::size_t flat) {
    const Lobe lobe = grid.lobe(flat);
    const FieldLobe found = lobe_of(field, lobe);
    if (!found.matrix.allFinite())
      return;  // of another material than the field's
    const Eigen::Matrix3d stored = stored_from_matrix(storage, found.matrix, lobe);
    table.set_stored(flat, stored / scale_of(storage, stored));
    if (is_folded(table)) {
      table.fold[2 * flat] = static_cast<float>(found.kappa);
      table.fold[2 * flat + 1] = static_cast<float>(found.gamma);
    }
    table.amplitude[flat] = static_cast<float>(found.amplitude);
    table.fresnel[flat] = static_cast<float>(found.fresnel);
    table.status[flat] = Status::fitted;
  });
  return table;
}

}  // namespace ltc
