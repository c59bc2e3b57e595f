// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/starting_points.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <iostream>
#include <numbers>

#include "fit/lobes.h"
#include "table/grid.h"

namespace ltc {
namespace {

TEST(StartingPoints, HaveTheirZerosAndAPositiveDeterminantAllOverThePapersGrid) {
  const Grid grid = Grid::paper(4);
  const TargetLattice lattice = make_target_lattice(1024, 0.3);
  TargetSamples target;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const Lobe lobe = grid.lobe(flat);
    const LobeFrame frame(lobe);
    const FreeEntries free = free_entries(lobe);
    sample_weighted_target(frame, lattice, target);
    const Eigen::Matrix3d starts[] = {first_order_start(frame), moment_start(frame, target),
                                      identity_start(frame), random_start(frame, target, flat)};
    for (std::size_t s = 0; s < std::size(starts); ++s) {
      EXPECT_GT(starts[s].determinant(), 0) << "start " << s << " of " << test::describe(lobe);
      // The zeros hold for M too, to the last bit, since Q has the same ones.
      const Eigen::Matrix3d m = frame.to_matrix(starts[s]);
      for (int entry = 0; entry < 9; ++entry)
        if (!free[entry]) {
          EXPECT_EQ(starts[s](entry / 3, entry % 3), 0) << s << " " << test::describe(lobe);
          EXPECT_EQ(m(entry / 3, entry % 3), 0) << s << " " << test::describe(lobe);
        }
    }
  }
}

TEST(StartingPoints, FreeEntriesAreEquation16s) {
  constexpr double right = std::numbers::pi / 2;
  const auto count = [](const Lobe& lobe) {
    const FreeEntries free = free_entries(lobe);
    return std::count(free.begin(), free.end(), true);
  };
  EXPECT_EQ(count({0.5, 0.2, 0.0, 0.7}), 3);
  EXPECT_EQ(count({0.5, 0.2, 0.5, 0.0}), 5);
  EXPECT_EQ(count({0.5, 0.2, 0.5, right}), 5);
  EXPECT_EQ(count({0.5, 0.2, 0.5, 0.7}), 9);
  // At phi = 0 x and z mix, at pi/2 y and z.
  EXPECT_TRUE(free_entries({0.5, 0.2, 0.5, 0.0})[2]);
  EXPECT_FALSE(free_entries({0.5, 0.2, 0.5, 0.0})[5]);
  EXPECT_TRUE(free_entries({0.5, 0.2, 0.5, right})[5]);
  EXPECT_FALSE(free_entries({0.5, 0.2, 0.5, right})[2]);
}

// Loss of the first-order start relative to the lobe's spread.
double first_order_share(double alpha, double theta, double phi) {
  const Lobe lobe{alpha, 0.5 * alpha, theta, phi};
  const LobeFrame frame(lobe);
  const CosineSet cosines = make_cosine_set(4096);
  TargetSamples target;
  sample_weighted_target(frame, make_target_lattice(4096, test::kMiddleShift), target);
  const auto directions = fibonacci_directions(16);
  const SlicedWassersteinLoss loss(test::in_double(cosines), test::in_double(target), directions);
  const Eigen::Matrix3d p = first_order_start(frame);
  const Eigen::Matrix3d m = p * Eigen::Vector3d(lobe.alpha_x, lobe.alpha_y, 1).asDiagonal();
  // The axis alone, all samples at one point, is as far from the lobe as the lobe is wide.
  const double width = loss(p * Eigen::Vector3d(1e-9 * alpha, 1e-9 * alpha, 1).asDiagonal()).loss;
  return loss(m).loss / width;
}

TEST(StartingPoints, FirstOrderBecomesExactAsTheRoughnessVanishes) {
  for (const double theta : {0.0, 0.5, 1.2}) {
    // Two sets of 4096 samples of a lobe with tails as 1/r^3 are 0.029 to 0.030 of its width
    // apart (measured at alpha 1e-4): what is below that is noise.
    constexpr double noise = 0.037;
    double previous = 1;
    for (const double alpha : {0.3, 0.03, 0.003, 1e-4}) {
      const double share = first_order_share(alpha, theta, 0.6);
      std::cout << "share " << share << " " << alpha << " " << theta << "\n";
      EXPECT_LT(share, std::max(previous, noise)) << "alpha " << alpha << " theta " << theta;
      previous = share;
    }
    EXPECT_LT(previous, noise);
  }
  // Measured: 0.71. It is not that any start would do.
  EXPECT_GT(first_order_share(0.3, 1.2, 0.6), 0.5);
}

TEST(StartingPoints, IdentityIsTheClampedCosineItself) {
  for (const Lobe& lobe : test::all_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d m = frame.to_matrix(identity_start(frame));
    EXPECT_LT((m - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12)
        << test::describe(lobe);
  }
}

TEST(StartingPoints, MomentStartHasTheLobesMeanDirectionAndWidth) {
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    TargetSamples target;
    sample_weighted_target(frame, make_target_lattice(4096, 0.3), target);
    const TargetMoments moments = target_moments(target);
    const Eigen::Vector3d axis = (moments.mean + Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Matrix3d p = moment_start(frame, target);
    // Exact but for the symmetry zeros, which the lattice's own mean misses by 1e-3 at theta = 0.
    EXPECT_NEAR(p.col(2).normalized().dot(axis), 1, 1e-5) << test::describe(lobe);
    const SlicedWassersteinLoss loss(test::in_double(make_cosine_set(1024)),
                                     test::in_double(target), fibonacci_directions(16));
    const auto at = [&](double factor) {
      return loss(p * Eigen::Vector3d(factor * lobe.alpha_x, factor * lobe.alpha_y, 1).asDiagonal())
          .loss;
    };
    EXPECT_LT(at(1), at(2)) << test::describe(lobe);
    // The tails of narrower lobes make the covariance overstate the width: 0.1 against 0.024 with
    // half of it at (0.3, 0.1).
    if (lobe.alpha_x >= 0.5) {
      EXPECT_LT(at(1), at(0.5)) << test::describe(lobe);
    }
  }
}

TEST(StartingPoints, RandomStartsDependOnTheSeedAlone) {
  const LobeFrame frame({0.5, 0.3, 0.8, 0.5});
  TargetSamples target;
  sample_weighted_target(frame, make_target_lattice(1024, 0.3), target);
  EXPECT_EQ(random_start(frame, target, 5), random_start(frame, target, 5));
  EXPECT_NE(random_start(frame, target, 5), random_start(frame, target, 6));
}

TEST(StartingPoints, AdmissibleTurnsAMirroredMatrixWithoutMovingItsLobe) {
  const Lobe lobe{0.5, 0.3, 0.8, 0.5};
  const Eigen::Matrix3d p = LobeFrame(lobe).first_order;
  Eigen::Matrix3d mirrored = p;
  mirrored.col(1) = -mirrored.col(1);
  EXPECT_LT(mirrored.determinant(), 0);
  EXPECT_EQ(admissible(mirrored, free_entries(lobe)), p);
}

}  // namespace
}  // namespace ltc
