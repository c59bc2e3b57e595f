// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The form in which a table keeps a matrix: section 7 of Aakash et al. 2022.
#pragma once

#include <Eigen/Core>

#include "table/storage.h"

namespace ltc {

// The matrix divided by its scale (scale_of) and rounded to single precision: every entry is a
// float, the scale is 1 within 1e-6, and the determinant is positive. Where
// rounding would make a nearly singular matrix's determinant zero or negative, entries move by a
// few units in the last place of a float until it is not; zeros stay zeros. Works for M and for the
// stored S of every storage.
//
// Throws InputError for a matrix that is not finite, whose scale is not positive or whose
// determinant is not positive (see align), and CheckFailure where no neighbour in single precision
// has a positive determinant.
Eigen::Matrix3d normalise(Storage storage, const Eigen::Matrix3d& matrix);

}  // namespace ltc
