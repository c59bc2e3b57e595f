// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What symmetry makes of a lobe before a table is asked, and of the table's matrix afterwards.
#pragma once

#include <Eigen/Core>

#include "table/grid.h"

namespace ltc {

// A lobe brought into a table's domain: the lobe asked for is `unfold` applied to the folded one,
// M = unfold * M_folded.
struct FoldedLobe {
  Lobe lobe;
  Eigen::Matrix3d unfold;  // orthogonal
};

// Equations (13) to (15) of Aakash et al. 2022: alpha_x >= alpha_y and phi in [0, pi/2]. `unfold`
// is a diagonal of +-1, times the swap of x and y where alpha_y > alpha_x.
FoldedLobe fold(const Lobe& lobe);

// Where a folded lobe stands on the grid's second axis: its alpha_y where that is the axis, else
// the ratio of its roughnesses. At zero roughness every ratio is the same lobe; 1 is the one that
// takes no lower bound to be so.
double second_roughness(const Grid& grid, const Lobe& folded);

// How a table of this grid is asked; every look-up, and all that judges one, goes by it.
//
// Where the table is isotropic (lambda = 1 alone) and has one node along phi, the azimuth is no
// axis of it: a lobe is turned about the normal to that node's azimuth, and back by `unfold`.
// With Layout::alphax_alphay, which has both orders of the roughnesses, the azimuth is folded by
// equation (13) and nothing is swapped, as that table's users do. Everywhere else lobes are folded.
// A table with one node along phi and lobes of other lambda serves views along that azimuth alone.
class Reduction {
 public:
  // Keeps a reference to the grid.
  explicit Reduction(const Grid& grid);

  // Whether lobes are turned to the one azimuth there is.
  bool turns() const { return turns_; }

  // A table that turns lobes has isotropic ones only, so that of a lobe with two roughnesses the
  // larger one counts.
  FoldedLobe fold(const Lobe& lobe) const;

  // Whether a lobe, folded or not, is on the axes, or so little beyond them that clamping is no
  // matter: the last node of the paper's theta is 1.6e-4 from the horizon.
  bool covers(const Lobe& lobe) const;

 private:
  const Grid& grid_;
  bool turns_;
};

// The nearest value to this one that an axis covers in the same sense: itself, or the end of the
// axis. Roughnesses count by their ratio, angles by their difference.
double clamped_to_roughness_axis(const Axis& axis, double value);
double clamped_to_angle_axis(const Axis& axis, double radians);

}  // namespace ltc
