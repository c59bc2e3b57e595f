// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Refinement through the real program: a whole table, a scene's part of one, what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "export/hdf5.h"
#include "export/same_tables.h"
#include "support/refused_run.h"
#include "table/lookup.h"
#include "table/queries.h"
#include "validate/held_out.h"

namespace ltc::test {
namespace {

std::vector<std::string> generate(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"generate",
                                        "--set",
                                        "table.alpha.nodes=3",
                                        "--set",
                                        "table.lambda.nodes=3",
                                        "--set",
                                        "table.theta.nodes=3",
                                        "--set",
                                        "table.phi.nodes=3",
                                        "--set",
                                        "refine.queries_per_cell=60",
                                        "--set",
                                        "refine.held_out_queries=200",
                                        "--set",
                                        "refine.roughness_first=0.5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double mean_relative_loss(const Table& table) {
  HeldOutJudge judge(1024, 16);
  double sum = 0;
  const std::vector<GgxLobe> queries =
      random_queries({0.5, 1, 0, 1, 0, 1}, 200, 31, table.grid.alpha_min);
  for (const GgxLobe& lobe : queries) {
    judge.set_lobe(lobe);
    sum += judge.loss(look_up(table, lobe).matrix) / judge.spread();
  }
  return sum / static_cast<double>(queries.size());
}

TEST(RefineProgram, BettersWhatLiesBetweenTheNodes) {
  const TemporaryDirectory folder;
  const ProgramResult fitted =
      run_ltcfit(generate({"-o", "fitted", "--set", "refine.steps=0"}), folder.path());
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_EQ(fitted.out.find("refined "), std::string::npos);
  const ProgramResult result = run_ltcfit(
      generate({"-o", "refined", "--set", "refine.steps=4", "--set", "refine.keep_smoothest=true"}),
      folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("refined  4 steps over "), std::string::npos) << result.out;
  const Table before = read_hdf5(folder / "fitted/ltc.h5"),
              after = read_hdf5(folder / "refined/ltc.h5");
  // These queries are neither refined on nor those that decide what is kept; the
  // mean of 200 has a standard error of some 5 %, the same on both sides.
  EXPECT_LT(mean_relative_loss(after), 0.85 * mean_relative_loss(before));
  // Nodes at alpha = 0 are kept as they are, and the losses stated are those of what is stored.
  EXPECT_EQ(after.matrix_at(0), before.matrix_at(0));
  const std::size_t moved = before.grid.flat({1, 1, 1, 1});
  EXPECT_NE(after.matrix_at(moved), before.matrix_at(moved));
  EXPECT_NE(after.sw_loss[moved], before.sw_loss[moved]);
}

TEST(RefineProgram, ServesAScene) {
  const TemporaryDirectory folder;
  folder.write("scene.toml",
               "[[material]]\nname = \"m\"\nalpha_x = [0.55, 0.9]\nalpha_y = [0.5, 0.6]\n");
  const ProgramResult result = run_ltcfit(
      generate({"--scene", "scene.toml", "--set", "refine.steps=2", "-o", "out"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("refined  2 steps over "), std::string::npos) << result.out;
  const Table table = read_hdf5(folder / "out/ltc.h5");
  EXPECT_EQ(table.status[0], Status::skipped);
  EXPECT_TRUE(std::isnan(table.stored[0]));
  EXPECT_TRUE(std::isfinite(look_up(table, {0.7, 0.5, 0.8, 0.4}).matrix.sum()));
}

TEST(RefineProgram, MovesOnlyWhatAnExtensionAdds) {
  const TemporaryDirectory folder;
  folder.write("scene.toml",
               "[[material]]\nname = \"m\"\nalpha_x = [0.55, 0.9]\nalpha_y = [0.5, 0.6]\n");
  const auto run = [&](const std::vector<std::string>& more) {
    const ProgramResult result = run_ltcfit(generate(more), folder.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
  };
  run({"--scene", "scene.toml", "--set", "refine.steps=2", "-o", "old"});
  run({"--extend", "old/ltc.h5", "--set", "refine.steps=2", "-o", "new"});
  run({"--extend", "old/ltc.h5", "--set", "refine.steps=0", "-o", "unrefined"});
  const Table old = read_hdf5(folder / "old/ltc.h5"), table = read_hdf5(folder / "new/ltc.h5"),
              unrefined = read_hdf5(folder / "unrefined/ltc.h5");
  std::size_t kept = 0, moved = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    ASSERT_TRUE(has_values(table.status[flat])) << flat;
    if (has_values(old.status[flat])) {
      EXPECT_EQ(table.matrix_at(flat), old.matrix_at(flat)) << flat;
      ++kept;
    } else {
      moved += table.matrix_at(flat) != unrefined.matrix_at(flat);
    }
  }
  EXPECT_EQ(kept, 36u);  // two values of alpha and of lambda with all nine views
  EXPECT_GT(moved, 30u);
  EXPECT_LT(mean_relative_loss(table), mean_relative_loss(unrefined));
}

}  // namespace
}  // namespace ltc::test
