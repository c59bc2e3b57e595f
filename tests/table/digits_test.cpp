// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The frame of a view and the warps of axes with all their digits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/ggx.h"
#include "core/angle.h"
#include "support/wide.h"
#include "table/axis.h"
#include "table/storage.h"

namespace ltc {
namespace {

using test::kDoubleRounding;
using test::logarithmic;
using test::Wide;
using test::WorstError;

TEST(TableDigits, MirrorRotationOfAGrazingView) {
  WorstError careful, naive;
  for (const double elevation : logarithmic(radians_of_degrees(0.001), 1, 20))
    for (const double phi : {0.0, 1e-3, 0.7}) {
      const Eigen::Vector3d v = Lobe{1, 1, std::numbers::pi / 2 - elevation, phi}.omega_v();
      // x from y and z, whose digits tell it; the other way round they do not.
      const Wide y = v.y(), z = v.z(), x_squared = Wide(1) - y * y - z * z;
      const Wide expected = Wide(1) - x_squared / (Wide(1) + z);
      careful.add_relative(mirror_rotation(v)(0, 0), expected);
      naive.add_relative(1 - v.x() * v.x() / (1 + v.z()), expected);
    }
  // Four roundings of positive terms.
  test::expect_only_the_careful_one_within(4 * kDoubleRounding, careful, naive);
}

TEST(TableDigits, ComplementSqrtNearItsFirstNode) {
  const Axis axis = Axis::make(0, 1, 8, Warp::complement_sqrt);
  WorstError careful, naive;
  for (const double x : logarithmic(1e-15, 1, 31)) {
    const Wide expected = Wide(1) - sqrt(Wide(1) - Wide(x));
    careful.add_relative(axis.coordinate(x), expected);
    naive.add_relative(1 - std::sqrt(1 - x), expected);
  }
  // Near x = 1 the root's argument has the rounding of 1 - x, which is exact there.
  test::expect_only_the_careful_one_within(4 * kDoubleRounding, careful, naive);
}

}  // namespace
}  // namespace ltc
