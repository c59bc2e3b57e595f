// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a look-up finds at a node is the lobe that was asked for, not the folded one: it is as near
// to that lobe as a fit of its own, in all quadrants and both orders of the roughnesses.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <iostream>
#include <numbers>

#include "fit/lobes.h"
#include "fit/solver.h"
#include "pipeline/generate.h"
#include "table/lookup.h"
#include "validate/held_out.h"

namespace ltc {
namespace {

constexpr double pi = std::numbers::pi;

// Sixteen anisotropic lobes away from every symmetry, each of which all wrong folds change.
Config config_of(Storage storage) {
  Config config;
  config.storage = storage;
  config.grid.alpha = Axis::make(0.3, 0.7, 2, Warp::linear);
  config.grid.lambda = Axis::make(0.3, 0.6, 2, Warp::linear);
  config.grid.theta = Axis::make(0.6, 1.2, 2, Warp::linear);
  config.grid.phi = Axis::make(0.4, 1.1, 2, Warp::linear);
  return config;
}

// The lobes that fold to a node.
std::vector<GgxLobe> queries_of(const GgxLobe& node) {
  const auto [alpha, smaller, theta, phi] = node;
  return {{alpha, smaller, theta, phi},
          {alpha, smaller, theta, pi - phi},
          {alpha, smaller, theta, pi + phi},
          {alpha, smaller, theta, 2 * pi - phi},
          {smaller, alpha, theta, pi / 2 - phi},
          {smaller, alpha, theta, pi / 2 + phi},
          {smaller, alpha, theta, 3 * pi / 2 - phi},
          {smaller, alpha, theta, 3 * pi / 2 + phi}};
}

TEST(LookUpOfFits, IsAsNearAsADirectFitInEveryQuadrantAndBothRoughnessOrders) {
  const std::unique_ptr<Solver> solver = make_solver({});
  FitWorkspacePointer workspace = make_fit_workspace();
  HeldOutJudge judge(4096, 32);
  double least = 1, most = 1, least_wrong = 1e9;
  for (const Storage storage : {Storage::matrix, Storage::mirror_frame}) {
    const Config config = config_of(storage);
    const Table table = generate_table(config, 2, nullptr, nullptr);
    for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
      const GgxLobe node = table.grid.lobe(table.grid.node(flat));
      for (const GgxLobe& query : queries_of(node)) {
        judge.set_lobe(query);
        FitRequest request;
        request.lobe = query;
        const double direct = judge.loss(solver->fit(request, *workspace, nullptr).matrix);
        const Eigen::Matrix3d found = look_up(table, query).matrix;
        const double ratio = judge.loss(found) / direct;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        EXPECT_LT(ratio, 1.02) << storage_name(storage) << " " << test::describe(query);
        EXPECT_GT(ratio, 0.98) << storage_name(storage) << " " << test::describe(query);
        // Any other unfolding is another lobe.
        const Eigen::Matrix3d unfold = fold(query).unfold;
        for (const GgxLobe& other : queries_of(node)) {
          const Eigen::Matrix3d wrong = fold(other).unfold;
          if (wrong == unfold)
            continue;
          const double wrong_ratio = judge.loss(wrong * unfold.inverse() * found) / direct;
          least_wrong = std::min(least_wrong, wrong_ratio);
          EXPECT_GT(wrong_ratio, 2) << test::describe(query);
        }
      }
    }
  }
  std::cout << "ratios " << least << " to " << most << ", wrong " << least_wrong << '\n';
}

}  // namespace
}  // namespace ltc
