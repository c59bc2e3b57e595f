// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Isotropic tables that need no fit.
#pragma once

#include <Eigen/LU>

#include "export/isotropic_layout.h"
#include "table/table.h"

namespace ltc::testing {

// The grid of `ltc`: perceptual roughness sqrt(alpha) and sqrt(1 - cos(theta)) even on [0, 1].
inline Grid isotropic_grid(std::size_t alphas, std::size_t thetas) {
  return grid_of(isotropic_layout(TextureLayout::ltc)->axes, alphas, thetas);
}

// Of lobes of first order about the mirror's direction, scaled as the storage asks.
inline Table mirror_table(const Grid& grid, Storage storage) {
  Table table = Table::empty(grid, storage);
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const Lobe lobe = table.grid.lobe(flat);
    Eigen::Matrix3d matrix = mirror_rotation(lobe.omega_v());
    // The width of first order, without its turn.
    const double width = std::sqrt(lobe.model->first_order(lobe).determinant());
    matrix.leftCols<2>() *= width * lobe.alpha_x;
    const Eigen::Matrix3d stored = stored_from_matrix(storage, matrix, lobe);
    table.set_stored(flat, stored / scale_of(storage, stored));
    table.amplitude[flat] = static_cast<float>(1 - 0.1 * lobe.alpha_x);
    table.fresnel[flat] = static_cast<float>(0.1 * lobe.theta_radians);
    table.status[flat] = Status::fitted;
  }
  return table;
}

}  // namespace ltc::testing
