// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a shader's inverse costs.
#include "judge/shader_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fit/lobe_frame.h"
#include "fit/lobes.h"
#include "ltc/ltsd.h"
#include "table/lookup.h"

namespace ltc {
namespace {

constexpr InverseOrder all_orders[] = {InverseOrder::divided, InverseOrder::adjugate,
                                       InverseOrder::factored};
constexpr Storage all_storages[] = {Storage::matrix, Storage::roughness_scaled,
                                    Storage::mirror_frame};

// A lobe as a table has it: P0 of the fits, a little away from it.
Eigen::Matrix3d matrix_of(const LobeFrame& frame) {
  Eigen::Matrix3d p = frame.first_order;
  p(0, 1) += 0.2;
  p(1, 0) -= 0.1;
  p(0, 2) += 0.3 * frame.lobe.alpha_x;
  return frame.to_matrix(p);
}

TEST(ShaderInverse, SinglePrecisionKeepsOrdinaryLobesInEveryOrder) {
  InversionMeter meter(512, 8);
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d m = matrix_of(frame);
    for (const Storage storage : all_storages)
      for (const InverseOrder order : all_orders) {
        const Eigen::Matrix3d seen =
            seen_by_shader(storage, stored_from_matrix(storage, m, lobe), frame, order,
                           Precision::single, Precision::single);
        // Some ten roundings of 6e-8, times what a narrow lobe and a slanted view make of them.
        EXPECT_LT(meter.error(frame, m, seen), 2e-5) << test::describe(lobe);
        // It does round.
        EXPECT_GT((seen / seen.norm() - m / m.norm()).norm(), 1e-9);
      }
  }
}

TEST(ShaderInverse, HalfPrecisionMovesThem) {
  InversionMeter meter(512, 8);
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d m = matrix_of(frame);
    const double in_memory =
        meter.error(frame, m,
                    seen_by_shader(Storage::matrix, m, frame, InverseOrder::adjugate,
                                   Precision::half, Precision::single));
    // Entries of 1 are rounded by up to 2^-12; these lobes are a tenth wide and more.
    EXPECT_LT(in_memory, 0.02) << test::describe(lobe);
    EXPECT_GT(in_memory, 1e-5) << test::describe(lobe);
    EXPECT_GT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, InverseOrder::adjugate,
                                         Precision::half, Precision::half)),
              in_memory / 2)
        << test::describe(lobe);
  }
}

TEST(ShaderInverse, FactoringOutTheRoughnessKeepsNarrowLobesInHalfPrecision) {
  // alpha_x alpha_y is below what half precision can hold.
  const Lobe lobe{1e-4, 1e-4, 0.6, 0.4};
  const LobeFrame frame(lobe);
  const Eigen::Matrix3d m = matrix_of(frame),
                        stored = stored_from_matrix(Storage::mirror_frame, m, lobe);
  InversionMeter meter(512, 8);
  const auto error = [&](InverseOrder order) {
    return meter.error(frame, m,
                       seen_by_shader(Storage::mirror_frame, stored, frame, order, Precision::half,
                                      Precision::half));
  };
  EXPECT_EQ(error(InverseOrder::adjugate), std::numeric_limits<double>::infinity());
  // Eleven bits, of a matrix of the order of one.
  EXPECT_LT(error(InverseOrder::factored), 0.01);
}

TEST(ShaderInverse, AMirroredMatrixIsAsGoodAsAny) {
  const LobeFrame frame({0.5, 0.3, 0.9, 0.4});
  const Eigen::Matrix3d m = Eigen::Vector3d(-1, 1, 1).asDiagonal() * matrix_of(frame);
  ASSERT_LT(m.determinant(), 0);
  InversionMeter meter(512, 8);
  for (const InverseOrder order : all_orders)
    EXPECT_LT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, order, Precision::single,
                                         Precision::single)),
              2e-5);
}

// A needle in a direction that all three columns nearly have.
TEST(ShaderInverse, WhatRoundingMakesSingularIsLost) {
  const LobeFrame frame({0.5, 0.3, 0.9, 0.4});
  Eigen::Matrix3d m = matrix_of(frame);
  m.leftCols<2>() = 1e-8 * m.leftCols<2>() + 0.02 * m.col(2).rowwise().replicate<2>();
  InversionMeter meter(512, 8);
  for (const InverseOrder order : all_orders)
    EXPECT_GT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, order, Precision::single,
                                         Precision::single)),
              0.01);
}

}  // namespace
}  // namespace ltc
