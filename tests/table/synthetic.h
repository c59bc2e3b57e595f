// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A table whose every value is known in closed form, to test look-ups and files with.
#pragma once

#include <Eigen/Core>

#include "table/table.h"

namespace ltc::testing {

// The matrix of a lobe to first order in the slopes of its microfacets: columns
// alpha_x (2 vz, 0, 2 vx), alpha_y (0, 2 vz, 2 vy) and the mirror direction. It obeys the
// symmetries of equations (13) to (16), its third column has unit length.
inline Eigen::Matrix3d first_order_matrix(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  Eigen::Matrix3d matrix;
  matrix.col(0) = 2 * lobe.alpha_x * Eigen::Vector3d(v.z(), 0, v.x());
  matrix.col(1) = 2 * lobe.alpha_y * Eigen::Vector3d(0, v.z(), v.y());
  matrix.col(2) = Eigen::Vector3d(-v.x(), -v.y(), v.z());
  return matrix;
}

// Any functions of the lobe with its symmetries, different in every argument.
inline double synthetic_amplitude(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  return 1 - 0.25 * lobe.alpha_x * lobe.alpha_y - 0.5 * (1 - v.z()) * (lobe.alpha_x + lobe.alpha_y);
}
inline double synthetic_fresnel(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  return 0.1 + 0.2 * (lobe.alpha_x * v.x() * v.x() + lobe.alpha_y * v.y() * v.y());
}

inline double synthetic_kappa(const Lobe& lobe) {
  return -0.8 * (1 - lobe.alpha_y / lobe.alpha_x) * lobe.omega_v().y();
}
inline double synthetic_gamma(const Lobe& lobe) {
  return 0.3 * (1 - lobe.alpha_y / lobe.alpha_x) * lobe.alpha_x;
}

// Every entry fitted, with the values above; loss and steps differ from entry to entry.
inline Table synthetic_table(const Grid& grid, Storage storage) {
  Table table = Table::empty(grid, storage);
  table.seed = 0x8000000000000001u;  // more than a signed integer or a double can hold
  table.config = "[fit]\nseed = 1  # α\n";
  table.generator = "ltcfit test";
  table.created = "2026-01-02T03:04:05Z";
  if (is_folded(table))
    table.creases = {0.4, 1.5};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Lobe lobe = grid.lobe(i);
    table.set_stored(i, stored_from_matrix(storage, first_order_matrix(lobe), lobe));
    table.amplitude[i] = static_cast<float>(synthetic_amplitude(lobe));
    table.fresnel[i] = static_cast<float>(synthetic_fresnel(lobe));
    table.sw_loss[i] = 1e-3f * static_cast<float>(i);
    table.status[i] = static_cast<Status>(1 + i % 3);
    table.iterations[i] = static_cast<std::uint16_t>(i);
    if (is_folded(table)) {
      table.fold[2 * i] = static_cast<float>(synthetic_kappa(lobe));
      table.fold[2 * i + 1] = static_cast<float>(synthetic_gamma(lobe));
    }
  }
  return table;
}

// Axes of different lengths, ranges and warps, so that no two of them can be mistaken.
inline Grid uneven_grid() {
  Grid grid;
  grid.alpha = Axis::make(0.1, 1, 3, Warp::sqrt);
  grid.lambda = Axis::make(0.2, 1, 2, Warp::linear);
  grid.theta = Axis::make(0, 1.5, 5, Warp::complement_sqrt);
  grid.phi = Axis::make(0, 1.5707963267948966, 4, Warp::linear);
  grid.alpha_min = 2e-4;
  return grid;
}

}  // namespace ltc::testing
