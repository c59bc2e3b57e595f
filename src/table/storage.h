// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a table interpolates, and how the matrix of a query is had from it (docs: table format).
#pragma once

#include <Eigen/Core>

#include "brdf/ggx.h"
#include "core/enum_names.h"

namespace ltc {

// With A = diag(alpha_x, alpha_y, 1) of the query and S the stored (interpolated) matrix:
enum class Storage {
  matrix,            // M = S, the published table's
  roughness_scaled,  // M = S A
  mirror_frame,      // M = Q S A, Q = mirror_rotation(omega_v)
  // M = S^-1, S with the middle entry 1: what shaders of isotropic tables read and engines ship.
  // Only of grids with lambda = 1 and phi = 0 alone, whose S is symmetric where x and y are.
  inverse,
  // M = Q S diag(alpha_x, s_y, 1) of a folded lobe (ltc/folded.h), s_y = width_across(lobe), with
  // kappa and gamma (field/field.h) interpolated beside S.
  folded,
};

constexpr EnumNames<Storage, 5> enum_names(Storage) {
  return {"storage",
          {{{Storage::matrix, "matrix"},
            {Storage::roughness_scaled, "roughness-scaled"},
            {Storage::mirror_frame, "mirror-frame"},
            {Storage::inverse, "inverse"},
            {Storage::folded, "folded"}}}};
}

// What S is multiplied by on the right, the diagonal of A or of what stands in its place; and
// whether Q stands on its left. Not of `inverse`.
Eigen::Vector3d scale_of_columns(Storage storage, const Lobe& lobe);
constexpr bool is_in_mirror_frame(Storage storage) {
  return storage == Storage::mirror_frame || storage == Storage::folded;
}

// What S is divided by to have the scale of the storage: the length of its third column, or its
// middle entry. 1 of every S in a table, but for rounding.
double scale_of(Storage storage, const Eigen::Matrix3d& stored);

// M of a lobe from the stored S, and S from M. Neither normalises.
Eigen::Matrix3d matrix_from_stored(Storage storage, const Eigen::Matrix3d& stored,
                                   const Lobe& lobe);
Eigen::Matrix3d stored_from_matrix(Storage storage, const Eigen::Matrix3d& matrix,
                                   const Lobe& lobe);

}  // namespace ltc
