// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/symmetry_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/lobes.h"
#include "fit/solver.h"
#include "judge/held_out.h"

namespace ltc {
namespace {

std::size_t fitted_count(const Grid& grid) {
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  std::size_t count = 0;
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    count += plan[flat].representative == flat;
  return count;
}

TEST(SymmetryPlan, FitsEveryLobeOfThePapersGridOnce) {
  // alpha = 0: both roughnesses are alpha_min, theta alone matters: 8. Each other alpha: lambda < 1
  // has one entry at theta = 0 and 7 x 8 above it, lambda = 1 one for every theta: 7 x 57 + 8.
  EXPECT_EQ(fitted_count(Grid::paper()), 8u + 7u * (7u * 57u + 8u));
  // Without the symmetric nodes nothing is saved.
  Grid grid = Grid::paper(4);
  grid.alpha = Axis::make(0.2, 0.9, 4, Warp::linear);
  grid.lambda = Axis::make(0.2, 0.9, 4, Warp::linear);
  grid.theta = Axis::make(0.2, 1.5, 4, Warp::linear);
  EXPECT_EQ(fitted_count(grid), grid.size());
}

TEST(SymmetryPlan, EntriesShareARepresentativeExactlyIfTheirLobesAreTurnsOfEachOther) {
  const Grid grid = Grid::paper(4);
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  const auto equal = [&](std::size_t a, std::size_t b) {
    const Lobe l = grid.lobe(a), m = grid.lobe(b);
    return l.alpha_x == m.alpha_x && l.alpha_y == m.alpha_y && l.theta_radians == m.theta_radians &&
           (l.phi_radians == m.phi_radians || l.theta_radians == 0 || l.alpha_x == l.alpha_y);
  };
  for (std::size_t a = 0; a < grid.size(); ++a) {
    EXPECT_LE(plan[a].representative, a);
    EXPECT_EQ(plan[plan[a].representative].representative, plan[a].representative);
    EXPECT_EQ(plan[plan[a].representative].turn_radians, 0);
    for (std::size_t b = 0; b < a; ++b)
      ASSERT_EQ(plan[a].representative == plan[b].representative, equal(a, b)) << a << " " << b;
  }
}

TEST(SymmetryPlan, TurnsTheViewOfTheRepresentativeIntoTheEntrysOwn) {
  const Grid grid = Grid::paper(4);
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  bool some_turned = false;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const Lobe lobe = grid.lobe(flat);
    const Lobe source = grid.lobe(plan[flat].representative);
    const double c = std::cos(plan[flat].turn_radians), s = std::sin(plan[flat].turn_radians);
    const Eigen::Vector3d v = source.omega_v();
    const Eigen::Vector3d view(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z());
    EXPECT_LT((view - lobe.omega_v()).norm(), 1e-14) << test::describe(lobe);
    // Only a lobe without an axis of its own may be turned.
    if (plan[flat].turn_radians != 0) {
      EXPECT_EQ(lobe.alpha_x, lobe.alpha_y);
      some_turned = true;
    }
  }
  EXPECT_TRUE(some_turned);
}

TEST(SymmetryPlan, EachLobeOnceKeepsTheFirstOfItsCopies) {
  const Grid grid = Grid::paper(3);
  // theta = 0: one lobe for all phi; lambda = 1: turned ones; the last two are lobes of their own.
  const std::vector<std::size_t> entries = {grid.flat({1, 1, 0, 2}), grid.flat({1, 1, 0, 0}),
                                            grid.flat({2, 2, 1, 1}), grid.flat({2, 2, 1, 2}),
                                            grid.flat({1, 1, 1, 1}), grid.flat({1, 1, 1, 2})};
  EXPECT_EQ(each_lobe_once(grid, entries),
            (std::vector<std::size_t>{entries[0], entries[2], entries[4], entries[5]}));
}

TEST(SymmetryPlan, TurnedIsTheRotatedLobesMatrix) {
  Eigen::Matrix3d m;
  m << 0.6, 0.1, -0.4, 0.05, 0.3, -0.2, 0.3, 0.1, 0.9;
  EXPECT_EQ(turned(m, 0), m);
  EXPECT_LT((turned(turned(m, 0.7), -0.7) - m).norm(), 1e-15);
  // A quarter turn takes x to y, y to -x.
  Eigen::Matrix3d quarter;
  quarter << 0.3, -0.05, 0.2, -0.1, 0.6, -0.4, -0.1, 0.3, 0.9;
  EXPECT_LT((turned(m, std::numbers::pi / 2) - quarter).norm(), 1e-15);
}

TEST(SymmetryPlan, ACopyIsAsGoodAsAFitOfItsOwn) {
  const Grid grid = Grid::paper(4);
  const std::vector<PlannedEntry> plan = plan_by_symmetry(grid);
  const std::unique_ptr<Solver> solver = make_solver({});
  FitWorkspacePointer workspace = make_fit_workspace();
  HeldOutJudge judge(4096, 32);
  const auto fit = [&](std::size_t flat) {
    FitRequest request;
    request.lobe = grid.lobe(flat);
    return solver->fit(request, *workspace, nullptr).matrix;
  };
  int turned_copies = 0;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const PlannedEntry& entry = plan[flat];
    if (entry.representative == flat)
      continue;
    const Eigen::Matrix3d source = fit(entry.representative);
    judge.set_lobe(grid.lobe(flat));
    const double copy = judge.loss(turned(source, entry.turn_radians));
    const double direct = judge.loss(fit(flat));
    // Measured: 0.94 to 1.06. The fit's lattices are not turned with the lobe.
    EXPECT_NEAR(copy / direct, 1, 0.1) << test::describe(grid.lobe(flat));
    // A wrong turn is found out, but at alpha = 1, where D is constant and the lobe, a function of
    // the light's elevation alone, does not lean.
    const Lobe lobe = grid.lobe(flat);
    if (entry.turn_radians != 0 && lobe.theta_radians > 0 && lobe.alpha_x < 1) {
      EXPECT_GT(judge.loss(turned(source, -entry.turn_radians)), 2 * direct)
          << test::describe(lobe);
      EXPECT_GT(judge.loss(source), 2 * direct) << test::describe(lobe);
      ++turned_copies;
    }
  }
  // theta > 0 and phi > 0, 3 x 3 nodes, of alpha = 0 with 4 lambda and of two alpha with one.
  EXPECT_EQ(turned_copies, 9 * (4 + 2));
}

}  // namespace
}  // namespace ltc
