// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables compared lobe against lobe: planted differences come out as large as they are.
#include "judge/compare.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

CompareSettings quick() {
  CompareSettings settings;
  settings.samples = 512;
  settings.directions = 8;
  return settings;
}

std::vector<EntryComparison> compare(const Table& a, const Table& b,
                                     const CompareSettings& settings = quick()) {
  return compare_tables(a, b, settings, {1});
}

Table example() {
  return testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
}

Eigen::Matrix3d turn(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ())
      .toRotationMatrix();
}

// Every matrix M of the example as change(M, flat).
template <class Change>
Table changed(Change&& change) {
  Table table = example();
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    table.set_stored(flat, change(table.stored_at(flat), flat));
  return table;
}

TEST(Compare, MatricesOfOneLobeHaveNoDistance) {
  const Table a = example();
  const Table b = changed([](const Eigen::Matrix3d& matrix, std::size_t flat) {
    const Eigen::Vector3d flip(1, flat % 2 ? -1 : 1, 1);
    return (3 * matrix * turn(13.0 * static_cast<double>(flat)) * flip.asDiagonal()).eval();
  });
  for (const EntryComparison& entry : compare(a, b)) {
    // Tables hold single precision: 6e-8 of an entry of 1, and a lobe's spread is 0.05 at least.
    EXPECT_LT(entry.matrix_difference, 3e-7);
    EXPECT_LT(entry.relative_distance(), 3e-6);
    EXPECT_NEAR(entry.ratio(), 1, 1e-5);
  }
}

TEST(Compare, ATableHasNoDistanceToItselfWhateverTheStorage) {
  const Table a = example();
  const Table folded = testing::synthetic_table(testing::uneven_grid(), Storage::folded);
  EXPECT_GT(compare(a, folded).back().relative_distance(), 0) << "a fold is seen";
  for (const EntryComparison& entry : compare(folded, folded))
    EXPECT_EQ(entry.distance, 0);
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    const Table b = testing::synthetic_table(testing::uneven_grid(), storage);
    for (const EntryComparison& entry : compare(a, b)) {
      EXPECT_LT(entry.matrix_difference, 5e-7) << name_of(storage);
      EXPECT_LT(entry.relative_distance(), 5e-6) << name_of(storage);
      EXPECT_EQ(entry.amplitude_difference, 0);
    }
    for (const EntryComparison& entry : compare(b, b)) {
      EXPECT_EQ(entry.matrix_difference, 0);
      EXPECT_EQ(entry.distance, 0);
      EXPECT_EQ(entry.loss_a, entry.loss_b);
    }
  }
}

// Lobes 1e-4 wide are points on the sphere, and the distance between two points is the mean of
// |d.(p - q)| over all directions, |p - q|/2.
TEST(Compare, ALobeTurnedBy30DegreesIsThatFarAway) {
  Grid grid;
  grid.alpha = Axis::make(1e-4, 1e-4, 1, Warp::linear);
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  grid.theta = Axis::make(0, 1.4, 4, Warp::linear);
  grid.phi = Axis::make(0, 1.5, 2, Warp::linear);
  const Table a = testing::synthetic_table(grid, Storage::matrix);
  Table b = a;
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    b.set_stored(flat, turn(30) * b.stored_at(flat));
  CompareSettings settings;
  settings.samples = 64;
  settings.directions = 4096;
  const std::vector<EntryComparison> entries = compare(a, b, settings);
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const double theta = grid.lobe(flat).theta_radians;
    const double chord = 2 * std::sin(theta) * std::sin(15 * std::numbers::pi / 180);
    // |cos| of a random direction is uniform on [0, 1]: a mean of 1/2, and over 4096 directions a
    // standard deviation of 0.0045, of which this allows four. And lobes are 1e-4 wide.
    EXPECT_NEAR(entries[flat].distance, chord / 2, 4 * 0.0045 * chord + 2e-4) << theta;
    EXPECT_NEAR(entries[flat].relative_distance(), entries[flat].distance / entries[flat].spread,
                1e-9);
    // The mirror direction is the third column; the others are 2e-4 long.
    EXPECT_NEAR(
        entries[flat].matrix_difference,
        (turn(30) * a.stored_at(flat).col(2) - a.stored_at(flat).col(2)).cwiseAbs().maxCoeff(),
        4e-4);
  }
}

TEST(Compare, FindsTheChangedMatrixAndNoOther) {
  const std::size_t bad = 77;
  const Table b = changed([&](Eigen::Matrix3d matrix, std::size_t flat) {
    if (flat == bad)
      matrix(1, 1) += 0.25;
    return matrix;
  });
  const std::vector<EntryComparison> entries = compare(example(), b);
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    EXPECT_EQ(entries[flat].distance > 0, flat == bad) << flat;
    EXPECT_EQ(entries[flat].matrix_difference > 0, flat == bad) << flat;
    EXPECT_EQ(entries[flat].loss_a != entries[flat].loss_b, flat == bad) << flat;
  }
  // A turn about z may take up a part of the change, not all of it.
  EXPECT_LE(entries[bad].matrix_difference, 0.25 + 1e-6);
  EXPECT_GT(entries[bad].matrix_difference, 0.1);
}

TEST(Compare, DifferencesOfAmplitudeAndFresnelTerm) {
  const Table a = example();
  Table b = a;
  b.amplitude[5] += 0.125f;
  b.fresnel[6] -= 0.0625f;
  const std::vector<EntryComparison> entries = compare(a, b);
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    // Sums of single-precision values below 1.
    EXPECT_NEAR(entries[flat].amplitude_difference, flat == 5 ? 0.125 : 0, 1e-7);
    EXPECT_NEAR(entries[flat].fresnel_difference, flat == 6 ? 0.0625 : 0, 1e-7);
    EXPECT_EQ(entries[flat].distance, 0);
  }
}

TEST(Compare, WhatATableLacksHasNoFigures) {
  const Table a = example();
  Table b = a;
  b.set_stored(9, Eigen::Matrix3d::Constant(std::nan("")));
  b.amplitude[9] = std::nanf("");
  b.status[9] = Status::skipped;
  const std::vector<EntryComparison> entries = compare(a, b);
  for (std::size_t flat = 0; flat < entries.size(); ++flat) {
    EXPECT_EQ(std::isnan(entries[flat].loss_b), flat == 9);
    EXPECT_EQ(std::isnan(entries[flat].distance), flat == 9);
    EXPECT_EQ(std::isnan(entries[flat].matrix_difference), flat == 9);
    EXPECT_EQ(std::isnan(entries[flat].amplitude_difference), flat == 9);
    EXPECT_FALSE(std::isnan(entries[flat].loss_a));
  }
}

// A matrix that sends all directions nowhere is finite, and no lobe.
TEST(Compare, AMatrixOfZerosHasNoFigures) {
  const Table b = changed([](const Eigen::Matrix3d& matrix, std::size_t flat) {
    return flat == 3 ? Eigen::Matrix3d::Zero().eval() : matrix;
  });
  const std::vector<EntryComparison> entries = compare(example(), b);
  EXPECT_TRUE(std::isnan(entries[3].loss_b));
  EXPECT_TRUE(std::isnan(entries[3].distance));
  EXPECT_TRUE(std::isnan(entries[3].matrix_difference));
  EXPECT_EQ(entries[4].distance, 0);
}

// At theta = 0 all phi are one lobe, judged once; a table in which one of them differs shows it.
TEST(Compare, EqualLobesShareTheirFiguresAndOthersDoNot) {
  const Table a = example();
  Table b = a;
  const std::size_t odd = b.grid.flat({1, 0, 0, 2});
  b.set_stored(odd, Eigen::Vector3d(1.5, 1, 1).asDiagonal() * b.stored_at(odd));
  b.fresnel[b.grid.flat({1, 0, 0, 3})] += 0.5f;
  const std::vector<EntryComparison> entries = compare(a, b);
  for (std::size_t phi = 0; phi < 4; ++phi) {
    const EntryComparison& entry = entries[b.grid.flat({1, 0, 0, phi})];
    EXPECT_EQ(entry.loss_a, entries[b.grid.flat({1, 0, 0, 0})].loss_a);
    EXPECT_EQ(entry.distance > 0, phi == 2) << phi;
    EXPECT_EQ(entry.fresnel_difference > 0, phi == 3) << phi;
  }
}

TEST(Compare, TheNumberOfThreadsChangesNoBit) {
  const Table a = example();
  const Table b = changed([](Eigen::Matrix3d matrix, std::size_t flat) {
    matrix.col(0) *= 1 + 0.01 * static_cast<double>(flat % 7);
    return matrix;
  });
  const std::vector<EntryComparison> one = compare(a, b),
                                     three = compare_tables(a, b, quick(), {3});
  for (std::size_t flat = 0; flat < one.size(); ++flat) {
    EXPECT_EQ(one[flat].loss_a, three[flat].loss_a);
    EXPECT_EQ(one[flat].loss_b, three[flat].loss_b);
    EXPECT_EQ(one[flat].distance, three[flat].distance);
  }
}

TEST(Compare, OtherGridsAreRefused) {
  const Table a = example();
  EXPECT_THROW(compare(a, testing::synthetic_table(Grid::paper(2), Storage::matrix)), InputError);
}

}  // namespace
}  // namespace ltc
