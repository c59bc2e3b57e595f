// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/tangent_frame.h"

#include <Eigen/Geometry>

namespace ltc {

Eigen::Matrix3d tangent_frame(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d along_parallel = Eigen::Vector3d::UnitY().cross(normal);
  const double length = along_parallel.norm();
  const Eigen::Vector3d east =
      length > 0 ? (along_parallel / length).eval() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d frame;
  frame << east.transpose(), normal.cross(east).transpose(), normal.transpose();
  return frame;
}

}  // namespace ltc
