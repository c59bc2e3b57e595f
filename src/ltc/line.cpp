// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltc/line.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

using Eigen::Vector3d;

void require_valid(const Line& line) {
  if (!line.from.allFinite() || !line.to.allFinite())
    throw InputError(fmt::format("line from ({}, {}, {}) to ({}, {}, {}): it must be finite",
                                 line.from.x(), line.from.y(), line.from.z(), line.to.x(),
                                 line.to.y(), line.to.z()));
  if (!(line.radius > 0 && std::isfinite(line.radius)))
    throw InputError(fmt::format("line of radius {}: it must be positive", line.radius));
}

// The part at z >= 0.
std::optional<Line> above_horizon(Line line) {
  const double from = line.from.z(), to = line.to.z();
  if (from <= 0 && to <= 0)
    return std::nullopt;
  if (from < 0 || to < 0) {
    Vector3d crossing = line.from + from / (from - to) * (line.to - line.from);
    crossing.z() = 0;
    (from < 0 ? line.from : line.to) = crossing;
  }
  return line;
}

}  // namespace

double clamped_cosine_share(const Line& line) {
  require_valid(line);
  const auto seen = above_horizon(line);
  const double length = seen ? (seen->to - seen->from).norm() : 0;
  if (!(length > 0))
    return 0;
  const Vector3d along = (seen->to - seen->from) / length;
  const double first = seen->from.dot(along), last = seen->to.dot(along);
  const Vector3d nearest = seen->from - first * along;
  // Of the straight: from the longer product, which keeps the digits of straights that pass near.
  const double d = seen->from.cross(seen->to).norm() / length;
  if (!(d > 0))
    return 0;
  const double at_first = d * d + first * first, at_last = d * d + last * last;
  const double of_point = (last / at_last - first / at_first) / d +
                          std::atan2((last - first) * d, d * d + first * last) / (d * d);
  const double of_direction = d * (last - first) * (last + first) / (at_first * at_last);
  return seen->radius / std::numbers::pi * (of_point * nearest.z() + of_direction * along.z());
}

double ltc_share(const Eigen::Matrix3d& matrix, const Line& line) {
  require_valid(line);
  if (!is_invertible(matrix))
    throw InputError(fmt::format("matrix of determinant {}: it must be finite and have an inverse",
                                 matrix.determinant()));
  const auto seen = above_horizon(line);
  if (!seen)
    return 0;
  const Vector3d normal = seen->from.cross(seen->to);
  if (!(normal.norm() > 0))
    return 0;
  const double widening = 1 / (matrix.transpose() * normal.normalized()).norm();
  const Eigen::Matrix3d inverse = matrix.inverse();
  return clamped_cosine_share(
      Line{inverse * seen->from, inverse * seen->to, widening * seen->radius});
}

}  // namespace ltc
