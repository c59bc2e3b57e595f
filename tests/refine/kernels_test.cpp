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

// Numbers of rows and within them that no tile or stretch divides, and that are parts of longer
// ones.
template <typename Number>
void check_products(double tolerance) {
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  using kernels::Products;
  constexpr Eigen::Index depth = 2053;
  for (const Eigen::Index count : {3, 77}) {
    const Matrix a = Matrix::Random(count + 4, depth), b = Matrix::Random(count + 1, depth);
    const Eigen::Matrix<Number, Eigen::Dynamic, 1> weights =
        Eigen::Matrix<Number, Eigen::Dynamic, 1>::Random(depth);
    const auto rows = [](const Matrix& of, Eigen::Index first, Eigen::Index numbers) {
      return kernels::RowsOf<Number>{of.data() + first, static_cast<std::size_t>(numbers), depth,
                                     static_cast<std::size_t>(of.rows())};
    };
    const Eigen::MatrixXd of_a = a.middleRows(2, count).template cast<double>(),
                          of_b = b.middleRows(1, count).template cast<double>();
    const Eigen::MatrixXd plain = of_a * of_b.transpose();
    const Eigen::MatrixXd weighted =
        of_a * weights.template cast<double>().asDiagonal() * of_b.transpose();
    const auto stride = static_cast<std::size_t>(count + 2);
    Eigen::MatrixXd result = Eigen::MatrixXd::Constant(count + 2, count, 42);
    add_products(rows(a, 2, count), nullptr, rows(b, 1, count), -2, result.data(), stride,
                 Products::all);
    EXPECT_LT(((result.topRows(count).array() - 42) + 2 * plain.array()).abs().maxCoeff(),
              tolerance);
    EXPECT_TRUE((result.bottomRows(2).array() == 42).all());
    result.setConstant(42);
    add_products(rows(a, 2, count), weights.data(), rows(b, 1, count), 1, result.data(), stride,
                 Products::upper);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = 0; i <= j; ++i)
        EXPECT_NEAR(result(i, j) - 42, weighted(i, j), tolerance);
    EXPECT_TRUE((result.bottomRows(2).array() == 42).all());
  }
}

TEST(RefineKernels, ProductsAreThoseOfEigen) {
  check_products<double>(1e-12);
  // 2053 products below one, summed in single precision in stretches of 256.
  check_products<float>(1e-4);
}

}  // namespace
}  // namespace ltc
