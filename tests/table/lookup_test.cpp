// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The look-up: folding by equations (13) to (15), interpolation, and the two together.
#include "table/lookup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "table/folding.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Storage all_storages[] = {Storage::matrix, Storage::roughness_scaled,
                                    Storage::mirror_frame};

Eigen::Matrix3d diagonal(double x, double y) {
  return Eigen::Vector3d(x, y, 1).asDiagonal();
}

Eigen::Matrix3d swap_of_x_and_y() {
  Eigen::Matrix3d swap;
  swap << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  return swap;
}

// Two matrices are the same lobe where these agree: M may be followed by a flip of x or y, or by
// their swap, without changing the lobe (section 5.1 of the paper), and so do the flips of equation
// (13) at the seams between quadrants.
double lobe_difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a * a.transpose() - b * b.transpose()).norm() + (a.col(2) - b.col(2)).norm();
}

double largest_entry(const LookUp& a, const LookUp& b) {
  return std::max({lobe_difference(a.matrix, b.matrix), std::abs(a.amplitude - b.amplitude),
                   std::abs(a.fresnel - b.fresnel)});
}

TEST(Fold, FourQuadrantsOfEquation13) {
  struct Case {
    double phi, folded;
    Eigen::Matrix3d unfold;
  };
  const std::vector<Case> cases = {
      {0.0, 0.0, diagonal(1, 1)},
      {0.4, 0.4, diagonal(1, 1)},
      {pi / 2, pi / 2, diagonal(-1, 1)},
      {pi - 0.4, 0.4, diagonal(-1, 1)},
      {pi, 0.0, diagonal(-1, -1)},
      {pi + 0.4, 0.4, diagonal(-1, -1)},
      {3 * pi / 2, pi / 2, diagonal(1, -1)},
      {2 * pi - 0.4, 0.4, diagonal(1, -1)},
      // Any real number is an azimuth.
      {-0.4, 0.4, diagonal(1, -1)},
      {2 * pi + 0.4, 0.4, diagonal(1, 1)},
      {-1000 * pi + 0.4, 0.4, diagonal(1, 1)},
      {-1e-300, 0.0, diagonal(1, 1)},
  };
  for (const Case& c : cases) {
    const FoldedLobe folded = fold({0.5, 0.2, 1.0, c.phi});
    // fmod by a rounded 2 pi: 500 turns of 2.4e-16 each.
    EXPECT_NEAR(folded.lobe.phi_radians, c.folded, 1e-12) << c.phi;
    EXPECT_EQ(folded.unfold, c.unfold) << c.phi;
    EXPECT_EQ(folded.lobe.alpha_x, 0.5);
    EXPECT_EQ(folded.lobe.alpha_y, 0.2);
    EXPECT_EQ(folded.lobe.theta_radians, 1.0);
  }
}

TEST(Fold, RoughnessOrderOfEquation15) {
  const FoldedLobe folded = fold({0.2, 0.5, 1.0, 0.4});
  EXPECT_EQ(folded.lobe.alpha_x, 0.5);
  EXPECT_EQ(folded.lobe.alpha_y, 0.2);
  EXPECT_DOUBLE_EQ(folded.lobe.phi_radians, pi / 2 - 0.4);
  EXPECT_EQ(folded.unfold, swap_of_x_and_y());
}

TEST(Fold, FlipComesAfterSwap) {
  const FoldedLobe folded = fold({0.2, 0.5, 1.0, pi - 0.4});
  EXPECT_DOUBLE_EQ(folded.lobe.phi_radians, pi / 2 - 0.4);
  EXPECT_EQ(folded.unfold, diagonal(-1, 1) * swap_of_x_and_y());
}

// The view direction itself must follow the symmetry: unfold * v_folded = v. This needs no table
// and is independent of how the equations are written down.
TEST(Fold, UnfoldTakesTheFoldedViewToTheView) {
  for (const double alpha_y : {0.1, 0.3, 0.7}) {
    for (double phi = -20; phi < 20; phi += 0.173) {
      const Lobe lobe{0.3, alpha_y, 1.1, phi};
      const FoldedLobe folded = fold(lobe);
      EXPECT_GE(folded.lobe.alpha_x, folded.lobe.alpha_y);
      EXPECT_GE(folded.lobe.phi_radians, 0);
      EXPECT_LE(folded.lobe.phi_radians, pi / 2);
      EXPECT_LT((folded.unfold * folded.lobe.omega_v() - lobe.omega_v()).norm(), 1e-14);
    }
  }
}

TEST(Interpolation, WeightsSumToOneAndReproduceMultilinearCoordinates) {
  const Grid grid = testing::uneven_grid();
  for (int i = 0; i < 200; ++i) {
    // Golden-ratio lattice over the axes.
    const auto lattice = [i](double g) { return std::fmod(0.5 + i * g, 1.0); };
    const double alpha = grid.alpha.value(lattice(0.8566749));
    const double lambda = grid.lambda.value(lattice(0.7338919));
    const Lobe lobe{alpha, lambda * alpha, grid.theta.value(lattice(0.6287067)),
                       grid.phi.value(lattice(0.5385973))};
    const Interpolation corners = interpolation(grid, lobe);
    double sum = 0, u_alpha = 0, u_lambda = 0, u_theta = 0, u_phi = 0;
    for (std::size_t c = 0; c < 16; ++c) {
      ASSERT_LT(corners.nodes[c], grid.size());
      EXPECT_GE(corners.weights[c], 0);
      const NodeIndex node = grid.node(corners.nodes[c]);
      const double w = corners.weights[c];
      sum += w;
      u_alpha += w * static_cast<double>(node.alpha) / 2;
      u_lambda += w * static_cast<double>(node.lambda);
      u_theta += w * static_cast<double>(node.theta) / 4;
      u_phi += w * static_cast<double>(node.phi) / 3;
    }
    // Snapping to a node moves a coordinate by at most 1e-9 of a step.
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(u_alpha, grid.alpha.coordinate(alpha), 1e-9);
    EXPECT_NEAR(u_lambda, grid.lambda.coordinate(lambda), 1e-9);
    EXPECT_NEAR(u_theta, grid.theta.coordinate(lobe.theta_radians), 1e-9);
    EXPECT_NEAR(u_phi, grid.phi.coordinate(lobe.phi_radians), 1e-9);
  }
}

TEST(Interpolation, OneNodeAxesTakeTheWholeWeight) {
  const Grid grid = Grid::paper({1, 1, 1, 1});
  const Interpolation corners = interpolation(grid, {0.7, 0.1, 1.2, 0.3});
  double sum = 0;
  for (std::size_t c = 0; c < 16; ++c) {
    EXPECT_EQ(corners.nodes[c], 0u);
    sum += corners.weights[c];
  }
  EXPECT_EQ(sum, 1);
}

TEST(Interpolation, LobeOutsideTheAxesIsClamped) {
  const Grid grid = testing::uneven_grid();  // alpha in [0.1, 1], lambda in [0.2, 1]
  const Table table = testing::synthetic_table(grid, Storage::matrix);
  const LookUp below = look_up(table, {0.05, 0.001, 0.5, 0.5});
  const LookUp at_first = look_up(table, {0.1, 0.02, 0.5, 0.5});
  EXPECT_LT(largest_entry(below, at_first), 1e-14);
  const LookUp above = look_up(table, {3, 3, 1.57, 0.5});
  const LookUp at_last = look_up(table, {1, 1, 1.5, 0.5});
  EXPECT_LT(largest_entry(above, at_last), 1e-14);
}

// Every node is hit exactly, from every quadrant and in both orders of the roughnesses, and the
// unfolded matrix is the lobe that was asked for: `first_order_matrix` of the query knows nothing
// of folding.
TEST(LookUp, ExactAtNodesInEveryQuadrantAndBothRoughnessOrders) {
  for (const Storage storage : all_storages) {
    for (const Grid& grid : {testing::uneven_grid(), Grid::paper(4)}) {
      const Table table = testing::synthetic_table(grid, storage);
      for (std::size_t i = 0; i < grid.size(); ++i) {
        const NodeIndex node = grid.node(i);
        const double alpha = grid.alpha.nodes[node.alpha];
        const double smaller = grid.lambda.nodes[node.lambda] * alpha;
        const Lobe folded{alpha, smaller, grid.theta.nodes[node.theta],
                             grid.phi.nodes[node.phi]};
        for (const Lobe& query : testing::lobes_that_fold_to(folded)) {
          const LookUp found = look_up(table, query);
          Lobe bounded = query;
          bounded.alpha_x = std::max(query.alpha_x, grid.alpha_min);
          bounded.alpha_y = std::max(query.alpha_y, grid.alpha_min);
          // Entries of order 2 were rounded to float.
          EXPECT_LT(lobe_difference(found.matrix, testing::first_order_matrix(bounded)), 2e-6)
              << name_of(storage) << " node " << i << " phi " << query.phi_radians;
          EXPECT_NEAR(found.amplitude, testing::synthetic_amplitude(bounded), 2e-7);
          EXPECT_NEAR(found.fresnel, testing::synthetic_fresnel(bounded), 2e-7);
        }
      }
    }
  }
}

TEST(LookUp, MatrixIsTheFoldedOneTimesUnfold) {
  const Table table = testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
  const Eigen::Matrix3d first = look_up(table, {0.5, 0.2, 1.0, 0.4}).matrix;
  const Eigen::Matrix3d swapped = look_up(table, {0.5, 0.2, 1.0, pi / 2 - 0.4}).matrix;
  // The same corners and weights up to rounding of the azimuth.
  constexpr double rounding = 1e-14;
  const auto at = [&table](double alpha_x, double alpha_y, double phi) {
    return look_up(table, {alpha_x, alpha_y, 1.0, phi}).matrix;
  };
  EXPECT_LT((at(0.5, 0.2, pi - 0.4) - diagonal(-1, 1) * first).norm(), rounding);
  EXPECT_LT((at(0.5, 0.2, pi + 0.4) - diagonal(-1, -1) * first).norm(), rounding);
  EXPECT_LT((at(0.5, 0.2, 2 * pi - 0.4) - diagonal(1, -1) * first).norm(), rounding);
  EXPECT_LT((at(0.2, 0.5, 0.4) - swap_of_x_and_y() * swapped).norm(), rounding);
  EXPECT_LT((at(0.2, 0.5, pi + 0.4) - diagonal(-1, -1) * swap_of_x_and_y() * swapped).norm(),
            rounding);
}

// Between nodes the table errs by its interpolation, but both sides of a seam must err alike.
TEST(LookUp, ContinuousAcrossTheSeams) {
  constexpr double step = 1e-7;
  // The synthetic values move by at most about 5 per radian or unit of roughness; times 2 steps.
  constexpr double bound = 10 * 2 * step;
  for (const Storage storage : all_storages) {
    const Table table = testing::synthetic_table(testing::uneven_grid(), storage);
    for (const double alpha_y : {0.15, 0.3, 0.45}) {
      for (const double seam : {0.0, pi / 2, pi, 3 * pi / 2, 2 * pi}) {
        const LookUp before = look_up(table, {0.3, alpha_y, 1.1, seam - step});
        const LookUp after = look_up(table, {0.3, alpha_y, 1.1, seam + step});
        EXPECT_LT(largest_entry(before, after), bound) << "phi = " << seam;
      }
    }
    for (double phi = 0.05; phi < 2 * pi; phi += 0.3) {
      const LookUp before = look_up(table, {0.3, 0.3 - step, 1.1, phi});
      const LookUp after = look_up(table, {0.3, 0.3 + step, 1.1, phi});
      EXPECT_LT(largest_entry(before, after), bound) << "equal roughness, phi = " << phi;
    }
  }
}

// What the test above would say of a table without the symmetry.
TEST(LookUp, SeamOfATableWithoutSymmetryShows) {
  Table table = testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
  for (std::size_t i = 0; i < table.grid.size(); ++i)
    table.stored[9 * i + 1] += 0.01f;  // m01 is zero at phi = 0 by equation (16)
  const LookUp before = look_up(table, {0.3, 0.2, 1.1, -1e-7});
  const LookUp after = look_up(table, {0.3, 0.2, 1.1, 1e-7});
  EXPECT_GT(largest_entry(before, after), 1e-3);
}

// alpha_min bounds the lobe, not its place between the nodes: no step where a roughness passes it.
TEST(LookUp, ContinuousAcrossAlphaMin) {
  for (const Storage storage : all_storages) {
    const Table table = testing::synthetic_table(Grid::paper(4), storage);
    const LookUp before = look_up(table, {0.5, 1e-4 - 1e-9, 1.1, 0.4});
    const LookUp after = look_up(table, {0.5, 1e-4 + 1e-9, 1.1, 0.4});
    EXPECT_LT(largest_entry(before, after), 1e-7);
    const LookUp mirror = look_up(table, {0, 0, 1.1, 0.4});
    const LookUp sharp = look_up(table, {1e-9, 1e-9, 1.1, 0.4});
    EXPECT_LT(largest_entry(mirror, sharp), 1e-7);
    EXPECT_GT(mirror.matrix.col(0).norm(), 1e-5) << "no lobe is narrower than alpha_min";
  }
}

// The fold is that of the reduced query, whatever quadrant and order of roughnesses was asked for.
TEST(LookUp, FoldsAreInterpolatedAndStayOneToOne) {
  const Grid grid = Grid::paper(4);
  Table table = testing::synthetic_table(grid, Storage::folded);
  const std::size_t a = grid.flat({3, 1, 2, 1}), b = grid.flat({3, 1, 2, 2});
  Lobe between = grid.lobe(a);
  between.phi_radians = 0.5 * (between.phi_radians + grid.lobe(b).phi_radians);
  const auto mean_of = [&](std::size_t number) {
    return 0.5 * table.fold[2 * a + number] + 0.5 * table.fold[2 * b + number];
  };
  const Fold mean = fold_of(mean_of(0), mean_of(1), between, table.creases);
  EXPECT_GT(std::abs(mean.k), 0.1);
  EXPECT_GT(mean.g, 0.1);
  // Weights of rounded azimuths.
  for (const Lobe& query : testing::lobes_that_fold_to(between)) {
    const LookUp found = look_up(table, query);
    EXPECT_NEAR(found.fold.k, mean.k, 1e-12);
    EXPECT_NEAR(found.fold.g, mean.g, 1e-12);
    EXPECT_EQ(found.creases, table.creases);
  }
  // Of others' files.
  table.fold[2 * a + 1] = 9;
  EXPECT_TRUE(is_one_to_one(table.fold_at(a), table.creases));
  EXPECT_TRUE(is_one_to_one(look_up(table, between).fold, table.creases));
}

// With the mirror-frame storage nothing of the first-order matrix is left to interpolate but the
// smooth change of the view, so that a coarse table is right between its nodes for all roughnesses.
TEST(LookUp, StorageIsUndoneWithTheQuerysRoughness) {
  const Grid grid = Grid::paper(8);
  const Table table = testing::synthetic_table(grid, Storage::mirror_frame);
  for (const double alpha_y : {0.001, 0.05, 0.3, 0.8}) {
    const Lobe query{0.3, alpha_y, grid.theta.nodes[4], grid.phi.nodes[3] + pi};
    // Along alpha and lambda S does not change at all. Entries of M of order 1 from floats; where
    // the roughnesses swap, phi falls on a node again, pi/2 - phi.
    EXPECT_LT(lobe_difference(look_up(table, query).matrix, testing::first_order_matrix(query)),
              2e-6);
  }
}

TEST(LookUp, NanOfASkippedCornerShowsAndOneOfWeightZeroDoesNot) {
  const Grid grid = testing::uneven_grid();
  Table table = testing::synthetic_table(grid, Storage::matrix);
  const std::size_t skipped = grid.flat({1, 1, 2, 2});
  table.set_stored(skipped, Eigen::Matrix3d::Constant(nan));
  table.amplitude[skipped] = table.fresnel[skipped] = static_cast<float>(nan);
  table.status[skipped] = Status::skipped;
  const auto middle = [](const Axis& axis, std::size_t lower) {
    return (axis.nodes[lower] + axis.nodes[lower + 1]) / 2;
  };
  // Inside a cell that has the skipped node for a corner.
  const double alpha = middle(grid.alpha, 0);
  const LookUp inside =
      look_up(table, {alpha, alpha * 0.6, middle(grid.theta, 1), middle(grid.phi, 2)});
  EXPECT_TRUE(inside.matrix.array().isNaN().all());
  EXPECT_TRUE(std::isnan(inside.amplitude) && std::isnan(inside.fresnel));
  // At every other node: the skipped one is a corner of their cells with weight 0.
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (i == skipped)
      continue;
    const NodeIndex node = grid.node(i);
    const double larger = grid.alpha.nodes[node.alpha];
    const LookUp found = look_up(table, {larger, grid.lambda.nodes[node.lambda] * larger,
                                         grid.theta.nodes[node.theta], grid.phi.nodes[node.phi]});
    EXPECT_TRUE(found.matrix.allFinite() && std::isfinite(found.amplitude)) << "node " << i;
  }
}

TEST(LookUp, NanInNanOut) {
  const Table table = testing::synthetic_table(testing::uneven_grid(), Storage::mirror_frame);
  const Lobe lobes[] = {
      {nan, 0.2, 1, 0}, {0.3, nan, 1, 0}, {0.3, 0.2, nan, 0}, {0.3, 0.2, 1, nan}};
  for (const Lobe& lobe : lobes)
    EXPECT_TRUE(look_up(table, lobe).matrix.array().isNaN().any());
  EXPECT_TRUE(
      std::isnan(look_up(table, {0.3, 0.2, 1, std::numeric_limits<double>::infinity()}).amplitude));
}

// The other published layout: exact at its nodes, whichever roughness is larger, and linear in
// alpha_x and alpha_y between them.
TEST(LookUp, InterpolatesBothRoughnessesWhereTheTableHasThem) {
  Grid grid = Grid::paper(5);
  grid.layout = Layout::alphax_alphay;
  const Table table = testing::synthetic_table(grid, Storage::matrix);
  const Reduction reduction(grid);
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    const Lobe lobe = {grid.alpha.nodes[node.alpha], grid.lambda.nodes[node.lambda],
                          grid.theta.nodes[node.theta], grid.phi.nodes[node.phi]};
    const FoldedLobe folded = reduction.fold(lobe);
    EXPECT_TRUE(reduction.covers(lobe));
    EXPECT_EQ(look_up(table, lobe).matrix, folded.unfold * table.matrix_at(flat)) << flat;
  }
  const Lobe a = {0.25, 0.75, 0, 0}, b = {0.5, 1, 0, 0}, between = {0.375, 0.875, 0, 0};
  // The synthetic matrix is linear in both roughnesses; rounding to 32 bits.
  const Eigen::Matrix3d mean = 0.5 * (look_up(table, a).matrix + look_up(table, b).matrix);
  EXPECT_LT((look_up(table, between).matrix - mean).cwiseAbs().maxCoeff(), 1e-7);
  // Mirrored views are looked up as those of the first quadrant.
  Lobe mirrored = {0.5, 0.75, 0.7, 0.4};
  const Eigen::Matrix3d first = look_up(table, mirrored).matrix;
  mirrored.phi_radians = -0.4;
  const Eigen::Matrix3d flipped = Eigen::Vector3d(1, -1, 1).asDiagonal() * first;
  EXPECT_LT((look_up(table, mirrored).matrix - flipped).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace ltc
