// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Alignment of LTC matrices, so that interpolating between them is well defined: section 5 of
// Aakash et al. 2022, "Bringing Linearly Transformed Cosines to Anisotropic GGX".
#pragma once

#include <Eigen/Core>

namespace ltc {

// M and M R describe the same LTC for every rotation and reflection R about z.
enum class Handedness {
  // The best R of all, which is what equation (12) asks for. With det(M) < 0 it is nearly always a
  // reflection, so that the result's determinant is positive; not where a lobe is so poor a fit
  // that both hands are about as good (one of the 4096 published matrices).
  any,
  // The best R of those that make the determinant of M R positive, so that no cell of a table
  // interpolates through a singular matrix.
  positive,
};

// M R with the R that minimises equation (12), the mean square distance between cosine directions
// and their images, E |M R w/|M R w| - w|^2. Closed form, by a fixed set of cosine directions that
// is symmetric in x and y: a matrix with the zeros of equation (16) keeps them exactly. Singular
// matrices count as positive. NaN in, NaN out.
Eigen::Matrix3d align(const Eigen::Matrix3d& matrix, Handedness handedness = Handedness::positive);

// M R with the R that brings M nearest to another matrix A: the least |A - M R| (Frobenius) of all
// rotations and reflections about z, whatever the lengths of both; closed form. Two matrices of one
// lobe, A = s M R, become equal up to their scale s and rounding. A itself comes back unchanged.
Eigen::Matrix3d align_to(const Eigen::Matrix3d& reference, const Eigen::Matrix3d& matrix);

}  // namespace ltc
