// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What 16-bit textures cost, lobe by lobe, for every storage.
#include "judge/half_precision.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "export/files.h"
#include "export/table_file.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

// Up to 69 degrees: the matrices of the synthetic table are nearly singular at the horizon.
Table table_of(Storage storage) {
  Grid grid = Grid::paper(4);
  grid.theta = Axis::make(0, 1.2, 4, Warp::linear);
  return testing::synthetic_table(grid, storage);
}

std::vector<double> errors_of(const Table& table) {
  return half_precision_errors(table, std::vector<bool>(table.grid.size(), true), {2});
}

double largest(const Table& table, bool smoothest) {
  const std::vector<double> errors = errors_of(table);
  double result = 0;
  for (std::size_t flat = 0; flat < errors.size(); ++flat)
    if ((table.grid.node(flat).alpha == 0) == smoothest)
      result = std::max(result, errors[flat]);
  return result;
}

TEST(HalfPrecision, MovesTheSmoothestLobesByTheirSpreadUnlessStoredInTheMirrorsFrame) {
  // A direction is rounded by up to some 2e-4 radians; a lobe of alpha = 1e-4 is as wide.
  for (const Storage storage : {Storage::matrix, Storage::roughness_scaled}) {
    EXPECT_GT(largest(table_of(storage), true), 0.3) << name_of(storage);
    EXPECT_LT(largest(table_of(storage), true), 5) << name_of(storage);
  }
  // There the mirror direction is the exact axis z; what is left is 2^-11 of each column.
  EXPECT_LT(largest(table_of(Storage::mirror_frame), true), 2e-3);
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    EXPECT_GT(largest(table_of(storage), false), 1e-5) << name_of(storage);
    EXPECT_LT(largest(table_of(storage), false), 5e-3) << name_of(storage);
  }
}

TEST(HalfPrecision, WhatTheFilesHoldHasNoErrorLeft) {
  const testing::TemporaryFolder folder;
  for (const Storage storage : {Storage::matrix, Storage::mirror_frame}) {
    const Table table = table_of(storage);
    write_table(table, folder / "t.0.exr", {true});
    const Table kept = read_table(folder / "t.0.exr");
    for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
      ASSERT_EQ(kept.stored_at(flat), rounded(table.stored_at(flat), Precision::half)) << flat;
    for (const double error : errors_of(kept))
      EXPECT_EQ(error, 0);
  }
}

TEST(HalfPrecision, AMatrixThatIsLostIsInfinitelyFar) {
  Table table = table_of(Storage::matrix);
  const auto lost = [&](const Eigen::Matrix3d& matrix) {
    table.set_stored(100, matrix);
    return errors_of(table)[100];
  };
  // Half the least number that is not zero; beyond 65504; two columns nearer to each other than
  // rounding, whose order it turns round.
  EXPECT_TRUE(std::isinf(lost(Eigen::Vector3d(1, 0x1p-26, 1).asDiagonal())));
  EXPECT_TRUE(std::isinf(lost(Eigen::Vector3d(1, 70000, 1).asDiagonal())));
  Eigen::Matrix3d matrix;
  matrix << 1.0004, 1, 0, 1.0006, 1.0004, 0, 0, 0, 1;
  EXPECT_TRUE(std::isinf(lost(matrix)));
  EXPECT_NE(half_precision_text(table.grid, errors_of(table)).find("make a matrix singular"),
            std::string::npos);
}

TEST(HalfPrecision, WordsNameTheWorstEntryAndWhatIsLeftElsewhere) {
  const Grid grid = Grid::paper(2);
  std::vector<double> errors(grid.size(), 0.001);
  errors[3] = 1.25;
  errors[9] = 0.0125;
  EXPECT_EQ(
      half_precision_text(grid, errors),
      "16 bits move lobes by up to 1.2 of their spread, at entry 0,0,1,1 (alpha 0.000, lambda "
      "0.000, theta 89.991, phi 90.0); at other alpha by up to 0.013");
  EXPECT_EQ(half_precision_text(grid, std::vector<double>(grid.size(), NAN)), "");
}

}  // namespace
}  // namespace ltc
