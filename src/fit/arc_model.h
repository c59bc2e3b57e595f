// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The local model that a Gauss-Newton step minimises (quantile_model.h), with the distribution of
// the LTC in closed form (arc_kernels.h) in place of samples.
//
// Along a direction d the Wasserstein distance of two lobes is the area between their distribution
// functions, int |F(t) - G(t)| dt: of the LTC's F, a function of P, and the lobe's G, counted once
// on weighted samples. Thresholds t are even in arccot z, z = (t - centre)/scale, with the lobe's
// mean and mean absolute deviation along d: as the Student distribution is that GGX slopes have.
// With w the length that a threshold stands for, rho = F - G and J = dF/dP,
//     loss = sum w |rho|,  gradient = sum w rho/(|rho| + e) J,  curvature = sum w/(|rho| + e) J
//     J^T,
// each divided by the number of directions; w e is a share of the mean threshold's part of the
// loss.
//
// Folded lobes (ltc/folded.h) are linear maps between creases only, and lobes of a scaled horizon
// (ltc/horizon.h) are cut once more: their cones end at two planes, a direction's distribution is a
// sum of up to six arcs whose ends move with t, and samples are cheaper.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/arc_kernels.h"
#include "fit/lobe_frame.h"
#include "fit/quantile_model.h"

namespace ltc {

// Where along a direction distributions are compared, and by how many nodes along arcs.
class ArcRule {
 public:
  // With `far`, also thresholds beyond the last ones, in powers of two, to the end of the sphere
  // for all but mirrors: what an LTC far too wide loses by.
  enum class Reach { near, far };
  ArcRule(std::size_t thresholds, std::size_t nodes, Reach reach = Reach::near);

  std::size_t thresholds() const { return z_.size(); }
  std::size_t near_thresholds() const { return ramp_.size(); }  // the first ones
  const std::vector<double>& z() const { return z_; }
  const std::vector<double>& length() const { return length_; }  // w over the scale
  // kernels::count_above, of the near ones.
  const std::vector<double>& ramp() const { return ramp_; }
  // The thinner a lobe, the more of them.
  const kernels::ArcNodes& nodes(const Lobe& lobe) const;

 private:
  std::vector<double> z_, length_, ramp_;
  kernels::ArcNodes usual_, of_thin_, of_thinnest_;
};

using ArcDirections = std::vector<Eigen::Vector3f>;  // in the mirror's frame

// What a lobe is compared by, small enough to keep for every lobe of a table.
struct ArcTarget {
  struct Along {
    float centre, scale;
  };
  std::vector<Along> along;  // of each direction
  std::vector<float> above;  // G, direction-major
  double spread = 0;         // mean of the scales
};
// `xi` is scratch.
void set_target(const TargetSamples& samples, const ArcDirections& directions, const ArcRule& rule,
                AlignedFloats& xi, ArcTarget& target);

// Where the model is evaluated: at the linear map W = S diag(scale) of an LTC, as a function of S;
// W is not singular. `turn` takes the mirror's frame to that of W.
struct ArcPoint {
  const LobeFrame& frame;
  Eigen::Matrix3d w;
  Eigen::Vector3d scale;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};
// S = P.
ArcPoint point_of_frame(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix);

// Against what: a target of these directions and this rule.
struct ArcView {
  const ArcDirections& directions;
  const ArcRule& rule;
  const ArcTarget& target;
};

// One a thread.
struct ArcWorkspace {
  AlignedVector<double> dx, dy, dz, t, length, first, second;
  kernels::ArcDistributions distributions;
};

// The model with respect to S. Below a share of the loss that is `smoothing`, in units of length,
// residuals count as zero.
void evaluate_arcs(const ArcPoint& point, const ArcView& view, double smoothing,
                   ArcWorkspace& workspace, ModelValue& value);

// Its loss alone.
double arc_loss(const ArcPoint& point, const ArcView& view, ArcWorkspace& workspace);

}  // namespace ltc
