// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "core/aligned.h"
#include "core/random.h"
#include "refine/field_kernels.h"
#include "refine/query_kernels.h"

namespace ltc {
namespace {

using kernels::cell_corners;
using kernels::query_lanes;

// The products of plain loops, in double precision.
TEST(RefineKernels, CellsMultiplyAndAddBlocks) {
  for (const std::size_t numbers : {9u, 11u}) {
    constexpr std::size_t count = 5;
    Random random(3);
    AlignedFloats curvatures(count * numbers * query_lanes), weights(count * cell_corners),
        steps(cell_corners * query_lanes), products(cell_corners * query_lanes);
    const auto curvature = [&](std::size_t q, std::size_t row, std::size_t column) -> float& {
      return curvatures[(q * numbers + column) * query_lanes + row];
    };
    for (std::size_t q = 0; q < count; ++q)
      for (std::size_t column = 0; column < numbers; ++column)
        for (std::size_t row = 0; row < numbers; ++row)
          curvature(q, row, column) = static_cast<float>(random.normal());
    for (float& weight : weights)
      weight = static_cast<float>(random.uniform());
    for (std::size_t corner = 0; corner < cell_corners; ++corner)
      for (std::size_t i = 0; i < numbers; ++i)
        steps[corner * query_lanes + i] = static_cast<float>(random.normal());
    const kernels::CellQueries cell{curvatures.data(), numbers * query_lanes, weights.data(), count,
                                    numbers};
    kernels::multiply_cell(cell, steps.data(), products.data());
    AlignedFloats block(numbers * query_lanes);
    constexpr std::size_t at = 3;
    kernels::add_blocks(cell, at, block.data());
    for (std::size_t row = 0; row < numbers; ++row) {
      double product = 0;
      for (std::size_t q = 0; q < count; ++q) {
        double pulled = 0;
        for (std::size_t column = 0; column < numbers; ++column)
          for (std::size_t corner = 0; corner < cell_corners; ++corner)
            pulled += static_cast<double>(curvature(q, row, column)) *
                      static_cast<double>(weights[q * cell_corners + corner]) *
                      static_cast<double>(steps[corner * query_lanes + column]);
        product += static_cast<double>(weights[q * cell_corners + at]) * pulled;
      }
      // A few hundred terms of about one, in single precision.
      EXPECT_NEAR(products[at * query_lanes + row], product, 1e-4);
      for (std::size_t column = 0; column < numbers; ++column) {
        double sum = 0;
        for (std::size_t q = 0; q < count; ++q) {
          const auto weight = static_cast<double>(weights[q * cell_corners + at]);
          sum += weight * weight * static_cast<double>(curvature(q, row, column));
        }
        EXPECT_NEAR(block[column * query_lanes + row], sum, 1e-5);
      }
    }
  }
}

TEST(RefineKernels, TransposedProductsAreThoseOfEigen) {
  // Numbers of rows and columns that no tile or stretch divides.
  const Eigen::MatrixXf a = Eigen::MatrixXf::Random(2053, 7), b = Eigen::MatrixXf::Random(2053, 5);
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(9, 5, 42);
  kernels::multiply_transposed({a.data(), 2053, 7}, {b.data(), 2053, 5}, result.data(), 9);
  const Eigen::MatrixXd expected = a.cast<double>().transpose() * b.cast<double>();
  // 2053 products below one, summed in single precision in stretches of 256.
  EXPECT_LT((result.topRows(7) - expected).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(result(7, 0), 42);
  const Eigen::VectorXf weights = Eigen::VectorXf::Random(2053);
  kernels::multiply_weighted({a.data(), 2053, 7}, weights.data(), {b.data(), 2053, 5},
                             result.data(), 9);
  const Eigen::MatrixXd weighted =
      a.cast<double>().transpose() * weights.cast<double>().asDiagonal() * b.cast<double>();
  EXPECT_LT((result.topRows(7) - weighted).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(result(7, 0), 42);
}

TEST(RefineKernels, TransposedProductsOfDoublesAreThoseOfEigen) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(600, 7), b = Eigen::MatrixXd::Random(600, 5);
  Eigen::MatrixXd result(7, 5);
  // Some rows of the columns.
  kernels::multiply_transposed(kernels::ColumnsOf<double>{a.data() + 3, 589, 7, 600},
                               kernels::ColumnsOf<double>{b.data() + 5, 589, 5, 600}, result.data(),
                               7);
  const Eigen::MatrixXd expected = a.middleRows(3, 589).transpose() * b.middleRows(5, 589);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace ltc
