// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Grids and storages: index order, the paper's nodes, S from M and back, the mirror rotation.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/error.h"
#include "support/refusal.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

TEST(Grid, FlatIndexIsCOrderWithPhiFastest) {
  const Grid grid = testing::uneven_grid();
  ASSERT_EQ(grid.size(), 3u * 2 * 5 * 4);
  EXPECT_EQ(grid.flat({0, 0, 0, 1}), 1u);
  EXPECT_EQ(grid.flat({0, 0, 1, 0}), 4u);
  EXPECT_EQ(grid.flat({0, 1, 0, 0}), 20u);
  EXPECT_EQ(grid.flat({1, 0, 0, 0}), 40u);
  for (std::size_t i = 0; i < grid.size(); ++i)
    EXPECT_EQ(grid.flat(grid.node(i)), i);
}

TEST(Grid, NeighboursAreOneStepAwayAlongOneAxis) {
  const Grid grid = testing::uneven_grid();
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const auto at = grid.indices(flat);
    std::vector<std::size_t> neighbours;
    for (std::size_t axis = 0; axis < Grid::axis_count; ++axis)
      for (const bool up : {false, true}) {
        const bool there = up ? at[axis] + 1 < grid.shape()[axis] : at[axis] > 0;
        auto next = at;
        next[axis] += up ? 1 : -1;
        const auto found = up ? grid.after(flat, axis) : grid.before(flat, axis);
        ASSERT_EQ(found.has_value(), there) << flat << " along axis " << axis;
        if (!there)
          continue;
        EXPECT_EQ(grid.indices(*found), next);
        neighbours.push_back(*found);
      }
    EXPECT_EQ(grid.neighbours(flat), neighbours);
  }
}

TEST(Grid, AxesHaveTheNumbersAndNamesOfTheirLayout) {
  Grid grid = testing::uneven_grid();
  EXPECT_EQ(&grid.axis(0), &grid.alpha);
  EXPECT_EQ(&grid.axis(1), &grid.lambda);
  EXPECT_EQ(&grid.axis(2), &grid.theta);
  EXPECT_EQ(&grid.axis(3), &grid.phi);
  EXPECT_THROW(grid.axis(4), std::out_of_range);
  EXPECT_EQ(grid.axis_names()[1], "lambda");
  grid.layout = Layout::alphax_alphay;
  EXPECT_EQ(grid.axis_names()[0], "alpha_x");
  EXPECT_EQ(grid.axis_names()[1], "alpha_y");
}

TEST(Grid, PaperNodesAreThePublishedOnes) {
  const Grid grid = Grid::paper();
  ASSERT_EQ(grid.size(), 4096u);
  const Lobe lobe = grid.lobe({3, 2, 5, 6});
  // Four roundings of doubles near 1.
  EXPECT_NEAR(lobe.alpha_x, 3.0 / 7, 1e-15);
  EXPECT_NEAR(lobe.alpha_y, 6.0 / 49, 1e-15);
  EXPECT_NEAR(lobe.theta_radians, 0.9999 * std::numbers::pi / 2 * 5 / 7, 1e-15);
  EXPECT_NEAR(lobe.phi_radians, std::numbers::pi / 2 * 6 / 7, 1e-15);
  EXPECT_EQ(grid.lobe({0, 3, 0, 0}).alpha_x, 1e-4);
  EXPECT_EQ(grid.lobe({0, 3, 0, 0}).alpha_y, 1e-4);
  EXPECT_EQ(grid.lobe({7, 0, 0, 0}).alpha_y, 1e-4);
  EXPECT_EQ(Grid::paper({8, 8, 8, 8}), grid);
}

TEST(Storage, MirrorRotationTakesZToTheMirrorDirectionByTheLeastTurn) {
  for (const double theta : {0.0, 0.3, 1.2, 1.5706}) {
    for (const double phi : {0.0, 0.8, 2.5, 4.0, 6.1}) {
      const Eigen::Vector3d v = Lobe{1, 1, theta, phi}.omega_v();
      const Eigen::Matrix3d q = mirror_rotation(v);
      // All entries are sums of a few products below 1.
      constexpr double rounding = 1e-14;
      EXPECT_LT((q * q.transpose() - Eigen::Matrix3d::Identity()).norm(), rounding);
      EXPECT_NEAR(q.determinant(), 1, rounding);
      EXPECT_LT((q.col(2) - Eigen::Vector3d(-v.x(), -v.y(), v.z())).norm(), rounding);
      // The least turn is by theta: trace = 1 + 2 cos(angle).
      EXPECT_NEAR(q.trace(), 1 + 2 * std::cos(theta), rounding);
    }
  }
}

TEST(Storage, StoredGoesToMatrixAndBack) {
  Eigen::Matrix3d matrix;
  matrix << 0.3, -0.1, 0.2, 0.05, 0.4, -0.6, 0.7, 0.1, 0.77;
  const Lobe lobe{0.3, 0.02, 1.1, 0.4};
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    const Eigen::Matrix3d stored = stored_from_matrix(storage, matrix, lobe);
    // Division by 0.02 and multiplication by it round to 1e-16 each, relative.
    EXPECT_LT((matrix_from_stored(storage, stored, lobe) - matrix).norm(), 1e-14);
    EXPECT_NEAR(stored.col(2).norm(), matrix.col(2).norm(), 1e-14);
  }
}

TEST(Storage, FormulasOfTheTableFormat) {
  const Lobe lobe{0.3, 0.02, 1.1, 0.4};
  const Eigen::Matrix3d stored = Eigen::Matrix3d::Random();
  const Eigen::Matrix3d scale = Eigen::Vector3d(0.3, 0.02, 1).asDiagonal();
  EXPECT_EQ(matrix_from_stored(Storage::matrix, stored, lobe), stored);
  EXPECT_LT((matrix_from_stored(Storage::roughness_scaled, stored, lobe) - stored * scale).norm(),
            1e-15);
  EXPECT_LT((matrix_from_stored(Storage::mirror_frame, stored, lobe) -
             mirror_rotation(lobe.omega_v()) * stored * scale)
                .norm(),
            1e-15);
}

TEST(Storage, SymmetryZerosOfEquation16HoldForStoredToo) {
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    const Lobe at_phi_0{0.5, 0.1, 0.9, 0};
    const Eigen::Matrix3d stored =
        stored_from_matrix(storage, testing::first_order_matrix(at_phi_0), at_phi_0);
    // Exact: phi = 0 makes vy exactly 0.
    EXPECT_EQ(stored(0, 1), 0);
    EXPECT_EQ(stored(1, 0), 0);
    EXPECT_EQ(stored(1, 2), 0);
    EXPECT_EQ(stored(2, 1), 0);
  }
}

TEST(Storage, NamesGoThereAndBackAndOthersAreRefused) {
  for (const Storage storage : {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame})
    EXPECT_EQ(value_named<Storage>(name_of(storage)), storage);
  EXPECT_EQ(name_of(Storage::mirror_frame), "mirror-frame");
  EXPECT_EQ(test::message_of<InputError>([] { value_named<Storage>("cholesky"); }),
            "storage \"cholesky\" is unknown; allowed: matrix, roughness-scaled, mirror-frame, inverse, folded");
  EXPECT_THROW(name_of(static_cast<Storage>(9)), InputError);
}

TEST(Table, EmptyIsAllNanAndSkipped) {
  const Table table = Table::empty(testing::uneven_grid(), Storage::matrix);
  ASSERT_EQ(table.stored.size(), 9u * 120);
  ASSERT_EQ(table.iterations.size(), 120u);
  for (std::size_t i = 0; i < 120; ++i) {
    EXPECT_TRUE(table.stored_at(i).array().isNaN().all());
    EXPECT_TRUE(std::isnan(table.amplitude[i]) && std::isnan(table.fresnel[i]));
    EXPECT_TRUE(std::isnan(table.sw_loss[i]));
    EXPECT_EQ(table.status[i], Status::skipped);
  }
}

TEST(Table, StoredIsRowMajorAndMatrixAtUndoesTheStorage) {
  Table table = Table::empty(testing::uneven_grid(), Storage::mirror_frame);
  Eigen::Matrix3d counted;
  counted << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  table.set_stored(7, counted);
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(table.stored[7 * 9 + static_cast<std::size_t>(i)], static_cast<float>(i));
  EXPECT_EQ(table.stored_at(7), counted);

  const Grid grid = testing::uneven_grid();
  const Table synthetic = testing::synthetic_table(grid, Storage::mirror_frame);
  for (std::size_t i = 0; i < grid.size(); ++i)
    // S is of order 2 and rounded to float: 1.2e-7 each in nine entries.
    EXPECT_LT((synthetic.matrix_at(i) - testing::first_order_matrix(grid.lobe(i))).norm(), 1e-6);
}

}  // namespace
}  // namespace ltc
