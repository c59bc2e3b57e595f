// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/refine.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "refine/node_space.h"
#include "refine/query_system.h"
#include "refine/refine_step.h"
#include "table/symmetry.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

Grid small_grid() {
  Grid grid = Grid::paper(3);
  grid.alpha = Axis::make(0.1, 1, 3, Warp::linear);
  return grid;
}

// First-order matrices: symmetric, third column of unit length, good enough to begin with.
std::vector<Eigen::Matrix3d> matrices(const Grid& grid, Storage storage = Storage::matrix) {
  std::vector<Eigen::Matrix3d> stored;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const Lobe lobe = grid.lobe(flat);
    stored.push_back(stored_from_matrix(storage, testing::first_order_matrix(lobe), lobe));
    // At theta = 90 degrees the first two columns are almost one.
    stored.back().topLeftCorner<2, 2>().diagonal().array() +=
        storage == Storage::matrix ? 0.3 * lobe.alpha_y : 0.3;
    if (looks_upward(lobe.theta_radians))
      stored.back() = Eigen::Vector3d(stored.back()(0, 0), stored.back()(1, 1), 1).asDiagonal();
  }
  return stored;
}

NodeVectors random_step(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  NodeVectors step(count);
  for (Vector9& value : step)
    for (int i = 0; i < 9; ++i)
      value[i] = random.normal();
  return step;
}

double dot(const NodeVectors& a, const NodeVectors& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i].dot(b[i]);
  return sum;
}

const std::vector<bool> all_of(const Grid& grid) {
  return std::vector<bool>(grid.size(), true);
}

std::vector<SingularityBound> no_bounds(const Grid& grid) {
  return std::vector<SingularityBound>(grid.size(), {-1e300, -2, 1e300, Eigen::Vector3d::Ones()});
}

TEST(NodeSpace, ProjectionIsOrthogonal) {
  const Grid grid = small_grid();
  const NodeSpace space(grid, Storage::matrix, all_of(grid));
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  space.symmetrise(stored);
  const NodeVectors a = random_step(grid.size(), 1), b = random_step(grid.size(), 2);
  NodeVectors pa = a, pb = b;
  space.project(stored, pa);
  space.project(stored, pb);
  NodeVectors ppa = pa;
  space.project(stored, ppa);
  double change = 0;
  for (std::size_t i = 0; i < pa.size(); ++i)
    change = std::max(change, (ppa[i] - pa[i]).cwiseAbs().maxCoeff());
  EXPECT_LT(change, 1e-14);  // rounding of numbers of order 1
  EXPECT_NEAR(dot(pa, b), dot(a, pb), 1e-11);
  // It takes something away, and not everything.
  EXPECT_LT(dot(pa, pa), 0.9 * dot(a, a));
  EXPECT_GT(dot(pa, pa), 0.3 * dot(a, a));
}

// What a step must keep, by name: how far a table's matrices are from it.
struct Broken {
  double zeros = 0, upward = 0, isotropic = 0, length = 0;
};
Broken broken(const Grid& grid, const std::vector<Eigen::Matrix3d>& stored) {
  Broken result;
  Eigen::Matrix3d swap;
  swap << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    NodeIndex node = grid.node(flat);
    const Lobe lobe = grid.lobe(node);
    const auto zeros = symmetry_zeros(lobe.theta_radians, lobe.phi_radians);
    for (int i = 0; i < 9; ++i)
      if (zeros(i / 3, i % 3))
        result.zeros = std::max(result.zeros, std::abs(stored[flat](i / 3, i % 3)));
    result.length = std::max(result.length, std::abs(stored[flat].col(2).norm() - 1));
    if (node.lambda + 1 == grid.lambda.size()) {
      NodeIndex other = node;
      other.phi = grid.phi.size() - 1 - node.phi;
      result.isotropic =
          std::max(result.isotropic,
                   (stored[flat] - swap * stored[grid.flat(other)] * swap).cwiseAbs().maxCoeff());
    }
    if (node.theta == 0) {
      node.phi = 0;
      result.upward =
          std::max(result.upward, (stored[flat] - stored[grid.flat(node)]).cwiseAbs().maxCoeff());
    }
  }
  return result;
}

TEST(NodeSpace, StepsKeepSymmetryAndLength) {
  const Grid grid = small_grid();
  const NodeSpace space(grid, Storage::matrix, all_of(grid));
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  space.symmetrise(stored);
  NodeVectors step = random_step(grid.size(), 3);
  for (Vector9& value : step)
    value *= 0.02;
  // As drawn, the step breaks everything that the projection keeps.
  const Broken as_drawn = broken(grid, stepped(Storage::matrix, stored, step, no_bounds(grid)));
  EXPECT_GT(as_drawn.zeros, 1e-3);
  EXPECT_GT(as_drawn.upward, 1e-3);
  EXPECT_GT(as_drawn.isotropic, 1e-3);
  space.project(stored, step);
  const Broken projected = broken(grid, stepped(Storage::matrix, stored, step, no_bounds(grid)));
  EXPECT_EQ(projected.zeros, 0);
  EXPECT_LT(projected.upward, 1e-15);
  EXPECT_LT(projected.isotropic, 1e-15);
  EXPECT_LT(projected.length, 1e-15);
}

TEST(NodeSpace, WhatIsNotMovableAndWhatIsTiedToItStays) {
  const Grid grid = small_grid();
  std::vector<bool> movable = all_of(grid);
  const std::size_t held = grid.flat({1, 1, 0, 1});
  movable[held] = false;
  const NodeSpace space(grid, Storage::matrix, movable);
  NodeVectors step = random_step(grid.size(), 4);
  space.project(matrices(grid), step);
  for (std::size_t phi = 0; phi < 3; ++phi)
    EXPECT_EQ(step[grid.flat({1, 1, 0, phi})].norm(), 0) << phi;
  EXPECT_GT(step[grid.flat({1, 1, 1, 1})].norm(), 0);
}

TEST(NodeSpace, StepsAreShortenedBeforeADeterminantTurns) {
  const Grid grid = small_grid();
  const std::vector<Eigen::Matrix3d> stored = matrices(grid);
  NodeVectors step(grid.size(), Vector9::Zero());
  const std::size_t node = grid.flat({1, 1, 1, 1});
  for (int row = 0; row < 3; ++row)
    step[node][3 * row] = -3 * stored[node](row, 0);  // turns the first column round
  std::vector<SingularityBound> bounds = no_bounds(grid);
  bounds[node].determinant = 0.3 * stored[node].determinant();
  const std::vector<Eigen::Matrix3d> result = stepped(Storage::matrix, stored, step, bounds);
  EXPECT_GE(result[node].determinant(), bounds[node].determinant);
  EXPECT_LT(result[node].determinant(), stored[node].determinant());
}

TEST(NodeSpace, StepsAreShortenedBeforeColumnsMeet) {
  const Grid grid = small_grid();
  const std::vector<Eigen::Matrix3d> stored = matrices(grid);
  NodeVectors step(grid.size(), Vector9::Zero());
  const std::size_t node = grid.flat({1, 1, 1, 1});
  for (int row = 0; row < 3; ++row)  // the first column almost along the third, and much longer
    step[node][3 * row] = 500 * stored[node](row, 2);
  std::vector<SingularityBound> bounds = no_bounds(grid);
  bounds[node].solid_angle = 0.03;
  EXPECT_LT(solid_angle_of_columns(stepped(Storage::matrix, stored, step, no_bounds(grid))[node]),
            0.01);
  const std::vector<Eigen::Matrix3d> result = stepped(Storage::matrix, stored, step, bounds);
  EXPECT_GE(solid_angle_of_columns(result[node]), 0.03);
  EXPECT_NE(result[node], stored[node]);
  EXPECT_NEAR(solid_angle_of_columns(2 * Eigen::Matrix3d::Identity()), 1, 1e-15);
}

TEST(NodeSpace, StepsAreShortenedBeforeAColumnVanishes) {
  const Grid grid = small_grid();
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  const std::size_t node = grid.flat({1, 1, 1, 1});
  stored[node] = Eigen::Vector3d(0.1, 1e-4, 1).asDiagonal();
  // The second column a hundredth as long and the first longer: the determinant keeps a tenth.
  NodeVectors step(grid.size(), Vector9::Zero());
  step[node][0] = 0.9;
  step[node][4] = -0.99e-4;
  std::vector<SingularityBound> bounds = no_bounds(grid);
  bounds[node].determinant = 0.1 * stored[node].determinant();
  EXPECT_GT(frobenius_condition(stepped(Storage::matrix, stored, step, bounds)[node]), 1e6);
  bounds[node].condition = 3e4;
  const std::vector<Eigen::Matrix3d> result = stepped(Storage::matrix, stored, step, bounds);
  EXPECT_LE(frobenius_condition(result[node]), 3e4);
  EXPECT_NE(result[node], stored[node]);
  // A table that stores M without its roughness is bound by M.
  bounds[node].scale = {1, 0.5, 1};
  EXPECT_LE(frobenius_condition(stepped(Storage::matrix, stored, step, bounds)[node]), 1.5e4);
  EXPECT_NEAR(frobenius_condition(-2 * Eigen::Matrix3d::Identity()), 3, 1e-12);
  EXPECT_NEAR(frobenius_condition(stored[node]), std::sqrt(1.01) * 1e4, 10);
  EXPECT_FALSE(std::isfinite(frobenius_condition(Eigen::Matrix3d::Zero())));
}

QuerySampling fine_sampling(LossKind loss = LossKind::samples) {
  QuerySampling sampling;
  sampling.loss = loss;
  sampling.samples = 1024;
  sampling.directions = sampling.thresholds = 16;
  sampling.target_samples = 4096;
  return sampling;
}

struct System {
  explicit System(const Grid& grid, Storage storage = Storage::matrix,
                  LossKind loss = LossKind::samples)
      : asked{random_queries({0.4, 1, 0.2, 1, 0.1, 1}, 60, 5, 1e-4),
              std::vector<double>(60, 1.0 / 60)},
        queries({grid, storage, all_of(grid)}, asked, fine_sampling(loss), 0.0) {}
  WeightedLobes asked;
  QuerySystem queries;
};

TEST(QuerySystem, GradientIsThatOfItsValue) {
  const Grid grid = small_grid();
  for (const LossKind loss : {LossKind::samples, LossKind::arcs})
    for (const Storage storage :
         {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
      System system(grid, storage, loss);
      const std::vector<Eigen::Matrix3d> stored = matrices(grid, storage);
      // Twice: the second time the smoothing goes by the loss of the first.
      system.queries.evaluate(stored, {1});
      system.queries.adopt();
      const double value = system.queries.evaluate(stored, {1});
      system.queries.adopt();
      NodeVectors gradient;
      system.queries.gradient(gradient, {1});
      NodeVectors step = random_step(grid.size(), 6);
      // Downhill, so that there is something to see.
      const double length = 2e-3 / std::sqrt(dot(gradient, gradient));
      for (std::size_t i = 0; i < step.size(); ++i)
        step[i] = length * gradient[i];
      const auto moved = [&](double sign) {
        std::vector<Eigen::Matrix3d> result = stored;
        for (std::size_t n = 0; n < stored.size(); ++n)
          for (int i = 0; i < 9; ++i)
            result[n](i / 3, i % 3) += sign * step[n][i];
        return result;
      };
      const double difference =
          (system.queries.evaluate(moved(1), {1}) - system.queries.evaluate(moved(-1), {1})) / 2;
      // The loss is binned and its gradient smoothed near zero residuals by 5 % of the loss: some
      // per cent on each query, less in the sum.
      EXPECT_NEAR(difference / dot(gradient, step), 1, 0.1) << name_of(storage);
      EXPECT_GT(value, 0);
    }
}

// Eleven numbers a node, with folds that are seen.
std::vector<FoldedNode> folded_nodes(const Grid& grid) {
  const std::vector<Eigen::Matrix3d> stored = matrices(grid, Storage::folded);
  std::vector<FoldedNode> nodes(grid.size());
  for (std::size_t flat = 0; flat < nodes.size(); ++flat) {
    const Lobe lobe = grid.lobe(flat);
    const double bend = (1 - lobe.alpha_y / lobe.alpha_x) * std::sin(lobe.theta_radians);
    nodes[flat] << flattened(stored[flat]), -0.7 * bend * std::sin(lobe.phi_radians), 0.2 * bend;
  }
  return nodes;
}

TEST(QuerySystem, GradientOfFoldedNodesIsThatOfItsValue) {
  const Grid grid = small_grid();
  const System plain(grid);
  FoldedQuerySystem queries({grid, Storage::folded, all_of(grid), usual_creases}, plain.asked,
                            fine_sampling(), 0.0);
  const std::vector<FoldedNode> nodes = folded_nodes(grid);
  for (int twice = 0; twice < 2; ++twice) {
    queries.evaluate(nodes, {1});
    queries.adopt();
  }
  NodeVectorsOf<FoldedNode> gradient;
  queries.gradient(gradient, {1});
  // All numbers; and those of the fold alone.
  for (const int first : {0, 9}) {
    double square = 0;
    for (const FoldedNode& g : gradient)
      square += g.tail(11 - first).squaredNorm();
    const double length = 2e-3 / std::sqrt(square);
    const auto value_at = [&](double sign) {
      std::vector<FoldedNode> moved = nodes;
      for (std::size_t n = 0; n < nodes.size(); ++n)
        moved[n].tail(11 - first) += sign * length * gradient[n].tail(11 - first);
      return queries.evaluate(moved, {1});
    };
    // As for plain nodes.
    EXPECT_NEAR((value_at(1) - value_at(-1)) / 2 / (length * square), 1, 0.1) << first;
  }
}

TEST(NodeSpace, FoldsKeepTheirSymmetries) {
  const Grid grid = small_grid();
  const NodeSpace space(grid, Storage::folded, all_of(grid));
  const std::vector<FoldedNode> nodes = folded_nodes(grid);
  NodeVectorsOf<FoldedNode> step(grid.size(), FoldedNode::Ones());
  space.project(nodes, step);
  for (std::size_t flat = 0; flat < step.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    const bool isotropic = grid.lambda.nodes[node.lambda] == 1;
    const bool along_x = node.phi == 0 || looks_upward(grid.theta.nodes[node.theta]);
    EXPECT_EQ(step[flat][9], isotropic || along_x ? 0 : 1) << flat;
    EXPECT_EQ(step[flat][10], isotropic ? 0 : 1) << flat;
  }
  // Gamma stays below its bound.
  const std::vector<SingularityBound> bounds(grid.size(),
                                             {-1e300, -2, 1e300, Eigen::Vector3d::Ones(), 1.0});
  NodeVectorsOf<FoldedNode> far(grid.size(), FoldedNode::Zero());
  const std::size_t free = grid.flat({1, 1, 1, 1});
  far[free][10] = 3;
  const double gamma = stepped(Storage::folded, nodes, far, bounds)[free][10];
  EXPECT_GT(gamma, nodes[free][10]);
  EXPECT_LE(gamma, 1);
}

TEST(QuerySystem, CurvatureIsSymmetricPositiveAndHasItsBlocks) {
  const Grid grid = small_grid();
  System system(grid);
  system.queries.evaluate(matrices(grid), {1});
  system.queries.adopt();
  const NodeVectors a = random_step(grid.size(), 7), b = random_step(grid.size(), 8);
  NodeVectors ha, hb;
  system.queries.multiply(a, ha, {1});
  system.queries.multiply(b, hb, {1});
  const double scale = std::sqrt(dot(a, ha) * dot(b, hb));
  EXPECT_GT(dot(a, ha), 0);
  // Products are in single precision.
  EXPECT_NEAR(dot(a, hb) / scale, dot(b, ha) / scale, 1e-5);
  std::vector<Matrix9> blocks;
  system.queries.diagonal_blocks(blocks, {1});
  for (const std::size_t node : {grid.flat({1, 1, 1, 1}), grid.flat({2, 2, 1, 0})}) {
    NodeVectors unit(grid.size(), Vector9::Zero()), column;
    unit[node][4] = 1;
    system.queries.multiply(unit, column, {1});
    EXPECT_LT((column[node] - blocks[node].col(4)).norm(), 1e-5 * blocks[node].norm());
    EXPECT_GT(blocks[node].norm(), 0);
  }
}

TEST(QuerySystem, LeavesOutWhatNeedsANodeWithoutValues) {
  const Grid grid = small_grid();
  std::vector<bool> present = all_of(grid);
  present[grid.flat({2, 2, 2, 2})] = false;
  const System whole(grid);
  const QuerySystem part({grid, Storage::matrix, present}, whole.asked, fine_sampling(), 0.0);
  EXPECT_LT(part.size(), whole.queries.size());
  EXPECT_GT(part.size(), 30u);
  EXPECT_EQ(whole.queries.size(), 60u);
}

TEST(RefinementStep, SolvesTheDampedNormalEquations) {
  const Grid grid = small_grid();
  System system(grid);
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  const NodeSpace space(grid, Storage::matrix, all_of(grid));
  space.symmetrise(stored);
  system.queries.evaluate(stored, {1});
  system.queries.adopt();
  const NodeVectors step = refinement_step(system.queries, space, stored, 1.0, 1.0, {1});
  NodeVectors gradient, product;
  system.queries.gradient(gradient, {1});
  system.queries.multiply(step, product, {1});
  std::vector<Matrix9> blocks;
  system.queries.diagonal_blocks(blocks, {1});
  Vector9 mean = Vector9::Zero();
  for (const Matrix9& block : blocks)
    mean += block.diagonal() / static_cast<double>(blocks.size());
  NodeVectors residual(grid.size());
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] =
        product[i] + (blocks[i].diagonal() + 1e-4 * mean).cwiseProduct(step[i]) + gradient[i];
  space.project(stored, residual);
  space.project(stored, gradient);
  // Solved to 1e-2 in the norm of the preconditioner, which is not this one.
  EXPECT_LT(std::sqrt(dot(residual, residual)), 0.05 * std::sqrt(dot(gradient, gradient)));
  EXPECT_LT(dot(step, gradient), 0);
}

RefineSettings quick_settings() {
  RefineSettings settings;
  settings.steps = 3;
  settings.queries_per_cell = 30;
  settings.held_out_queries = 150;
  settings.sampling = {LossKind::arcs, 8, 8, 256, 512};
  settings.range = {0.4, 1, 0, 1, 0, 1};
  return settings;
}

RefineReport refined(const RefineSettings& settings, int threads, const Grid& grid,
                     std::vector<Eigen::Matrix3d>& stored) {
  return refine({grid, Storage::matrix, all_of(grid)}, all_of(grid), {settings.range}, settings,
                {threads}, stored);
}

TEST(Refine, LowersTheHeldOutLossAndKeepsSymmetry) {
  const Grid grid = small_grid();
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  const RefineReport report = refined(quick_settings(), 2, grid, stored);
  EXPECT_TRUE(report.kept);
  // First-order matrices are far from good: much is to be had.
  EXPECT_LT(report.loss_after, 0.8 * report.loss_before);
  const Broken after = broken(grid, stored);
  EXPECT_EQ(after.zeros, 0);
  EXPECT_LT(after.upward, 1e-14);
  EXPECT_LT(after.isotropic, 1e-14);
  EXPECT_LT(after.length, 1e-14);
  for (const Eigen::Matrix3d& matrix : stored)
    EXPECT_GT(matrix.determinant(), 0);
}

TEST(Refine, GivesTheSameBitsForAnyNumberOfThreads) {
  const Grid grid = small_grid();
  std::vector<Eigen::Matrix3d> one = matrices(grid), three = one, untouched = one;
  refined(quick_settings(), 1, grid, one);
  refined(quick_settings(), 3, grid, three);
  double largest_change = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE((one[i].array() == three[i].array()).all()) << i;
    largest_change = std::max(largest_change, (one[i] - untouched[i]).norm());
  }
  EXPECT_GT(largest_change, 1e-3);
}

TEST(Refine, KeepsTheTableWhereItWouldNotBeBetter) {
  const Grid grid = small_grid();
  RefineSettings settings = quick_settings();
  std::vector<Eigen::Matrix3d> stored = matrices(grid);
  ASSERT_TRUE(refined(settings, 2, grid, stored).kept);
  const std::vector<Eigen::Matrix3d> before = stored;
  // All weight on the nodes' own lobes, which the queries held out do not ask for.
  settings.node_weight = 1;
  const RefineReport report = refined(settings, 2, grid, stored);
  EXPECT_FALSE(report.kept);
  EXPECT_GT(report.steps, 0);
  EXPECT_EQ(report.loss_after, report.loss_before);
  for (std::size_t i = 0; i < stored.size(); ++i)
    EXPECT_TRUE((stored[i].array() == before[i].array()).all()) << i;
}

TEST(Refine, NodeLossesAreThoseOfTheNodes) {
  const Grid grid = small_grid();
  const std::vector<Eigen::Matrix3d> stored = matrices(grid);
  std::vector<bool> present = all_of(grid);
  present[5] = false;
  const std::vector<double> losses = node_losses({grid, Storage::matrix, present}, stored, {2});
  EXPECT_TRUE(std::isnan(losses[5]));
  std::vector<Eigen::Matrix3d> worse = stored;
  worse[7].col(2) = Eigen::Vector3d(0.6, 0, 0.8);
  const std::vector<double> other = node_losses({grid, Storage::matrix, present}, worse, {1});
  EXPECT_EQ(other[6], losses[6]);
  EXPECT_GT(other[7], 1.1 * losses[7]);
}

}  // namespace
}  // namespace ltc
