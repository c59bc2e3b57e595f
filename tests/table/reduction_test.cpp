// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/reduction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/separable_ggx.h"
#include "table/lookup.h"
#include "table/query_range.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Storage all_storages[] = {Storage::matrix, Storage::roughness_scaled,
                                    Storage::mirror_frame};

Axis one_node(double value) {
  return Axis::make(value, value, 1, Warp::linear);
}

// lambda = 1 alone and one node along phi.
Grid isotropic_grid(double phi_radians = 0) {
  Grid grid = Grid::paper({8, 1, 8, 1});
  grid.lambda = one_node(1);
  grid.phi = one_node(phi_radians);
  return grid;
}

Grid one_azimuth_grid() {
  Grid grid = Grid::paper({4, 4, 4, 1});
  grid.phi = one_node(0.5);
  return grid;
}

Eigen::Matrix3d turned_by(double radians, const Eigen::Matrix3d& matrix) {
  return Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitZ()).toRotationMatrix() * matrix;
}

TEST(Reduction, LookUpsOfAnIsotropicTableTurnWithTheAzimuth) {
  for (const double node : {0.0, 0.7})
    for (const Storage storage : all_storages) {
      const Table table = testing::synthetic_table(isotropic_grid(node), storage);
      for (const double alpha : {0.03, 0.4})
        for (const double theta : {0.0, 0.3, 1.2}) {
          const LookUp at_node = look_up(table, {alpha, alpha, theta, node});
          for (int degrees = 0; degrees <= 360; degrees += 15) {
            const double phi = degrees * pi / 180;
            const LookUp found = look_up(table, {alpha, alpha, theta, phi});
            // Entries of order 1, rounded some times.
            EXPECT_LT((found.matrix - turned_by(phi - node, at_node.matrix)).norm(), 1e-14)
                << name_of(storage) << " phi " << degrees;
            EXPECT_EQ(found.amplitude, at_node.amplitude);
            EXPECT_EQ(found.fresnel, at_node.fresnel);
          }
        }
    }
}

// What the test above compares with is right too: at a node, the matrix of the lobe itself.
TEST(Reduction, ATurnedLookUpIsTheLobes) {
  const Table table = testing::synthetic_table(isotropic_grid(), Storage::matrix);
  const double alpha = table.grid.alpha.nodes[3], theta = table.grid.theta.nodes[5];
  for (const double phi : {0.2, 2.0, -1.0}) {
    const Eigen::Matrix3d found = look_up(table, {alpha, alpha, theta, phi}).matrix;
    const Eigen::Matrix3d wanted = testing::first_order_matrix({alpha, alpha, theta, phi});
    // A matrix stands for its lobe up to a rotation of the cosine: compare M M^T. From floats.
    EXPECT_LT((found * found.transpose() - wanted * wanted.transpose()).norm(), 1e-6) << phi;
  }
}

TEST(Reduction, KeepsTheModel) {
  const Grid turning = isotropic_grid(), folding = Grid::paper(2);
  for (const Grid* grid : {&turning, &folding})
    EXPECT_EQ(Reduction(*grid).fold({0.2, 0.3, 1, 4, &test::separable_ggx()}).lobe.model,
              &test::separable_ggx());
}

TEST(Reduction, CoversWhatATableServes) {
  const Grid isotropic = isotropic_grid();
  EXPECT_TRUE(Reduction(isotropic).turns());
  for (const double phi : {0.0, 0.8, 3.0, -2.0})
    EXPECT_TRUE(Reduction(isotropic).covers({0.3, 0.3, 1.0, phi})) << phi;
  EXPECT_FALSE(Reduction(isotropic).covers({0.3, 0.2, 1.0, 0.0}));

  // One azimuth of lobes that are not isotropic serves that azimuth, and its mirror images.
  const Grid one = one_azimuth_grid();
  EXPECT_FALSE(Reduction(one).turns());
  EXPECT_TRUE(Reduction(one).covers({0.3, 0.2, 1.0, 0.5}));
  EXPECT_TRUE(Reduction(one).covers({0.3, 0.2, 1.0, -0.5}));
  EXPECT_FALSE(Reduction(one).covers({0.3, 0.2, 1.0, 0.6}));

  const Grid paper = Grid::paper();
  EXPECT_TRUE(Reduction(paper).covers({0.3, 0.2, pi / 2, 0.6})) << "next to the last node";
  EXPECT_TRUE(Reduction(paper).covers({0.2, 0.3, 1, 4}));
  EXPECT_FALSE(Reduction(paper).covers({1.1, 0.3, 1, 0}));
  EXPECT_FALSE(Reduction(paper).covers({0.3, 0.2, 1, std::numeric_limits<double>::quiet_NaN()}));
  // A factor of roughness matters where a difference of 1e-3 is large.
  Grid glossy = Grid::paper();
  glossy.alpha = Axis::make(0.001, 0.1, 4, Warp::linear);
  EXPECT_FALSE(Reduction(glossy).covers({0.0005, 0.0005, 1, 0}));
  EXPECT_TRUE(Reduction(glossy).covers({0.0010001, 0.001, 1, 0}));
  // Ratios that alpha_min leaves no room for are the lobe of the last one.
  Grid brushed = Grid::paper();
  brushed.lambda = Axis::make(0, 0.005, 2, Warp::linear);
  EXPECT_TRUE(Reduction(brushed).covers({0.01, 1e-4, 1, 0}));
  EXPECT_FALSE(Reduction(brushed).covers({0.01, 2e-4, 1, 0}));
}

TEST(QueryRanges, AreTheWantedOneOnThePapersAxes) {
  EXPECT_EQ(query_range_of(Grid::paper(), {}), QueryRange());
  EXPECT_EQ(query_range_of(isotropic_grid(), {}).phi_last, QueryRange{}.phi_last);
  EXPECT_EQ(query_range_of(isotropic_grid(), {}).lambda_first, 1);
}

TEST(QueryRanges, EndWhereTheAxesEnd) {
  Grid grid = Grid::paper();
  grid.alpha = Axis::make(0.04, 0.64, 4, Warp::linear);
  grid.lambda = Axis::make(0.5, 0.9, 4, Warp::linear);
  grid.theta = Axis::make(0.2, 1.2, 4, Warp::linear);
  grid.phi = Axis::make(0.1, 0.4, 4, Warp::linear);
  const QueryRange range = query_range_of(grid, {});
  EXPECT_EQ(range, (QueryRange{0.2, 0.8, 0.5, 0.9, std::cos(1.2), std::cos(0.2), 0.1, 0.4}));
  for (const Lobe& lobe : random_queries(range, 100, 1, grid.alpha_min))
    EXPECT_TRUE(Reduction(grid).covers(lobe));
  // What is asked for within the axes stays as it is.
  const QueryRange within{0.3, 0.3, 0.6, 0.7, 0.5, 0.5, 0.2, 0.2};
  EXPECT_EQ(query_range_of(grid, within), within);
}

TEST(QueryRanges, AreTheAxesOwnWhereNothingWantedIsLeft) {
  Grid grid = Grid::paper();
  grid.alpha = Axis::make(0.0004, 0.0025, 4, Warp::linear);
  EXPECT_EQ(query_range_of(grid, {}).roughness_first, std::sqrt(0.0004));
  EXPECT_EQ(query_range_of(grid, {}).roughness_last, std::sqrt(0.0025));
  EXPECT_EQ(query_range_of(grid, {}).lambda_first, 0);
  // Of a material beyond the axes a table serves the nearest lobe.
  const QueryRange clamped = clamped_range(grid, {0.5, 0.6});
  EXPECT_EQ(clamped.roughness_first, std::sqrt(0.0025));
  EXPECT_EQ(clamped.roughness_last, std::sqrt(0.0025));
}

}  // namespace
}  // namespace ltc
