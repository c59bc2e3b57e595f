// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Refinement through the real program: a whole table, a scene's part of one, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "export/same_tables.h"
#include "export/table_file.h"
#include "judge/held_out.h"
#include "support/refused_run.h"
#include "table/lookup.h"
#include "table/queries.h"
#include "test_paths.h"

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
  const std::vector<Lobe> queries =
      random_queries({0.5, 1, 0, 1, 0, 1}, 200, 31, table.grid.alpha_min);
  for (const Lobe& lobe : queries) {
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
  const Table before = read_table(folder / "fitted/ltc.h5"),
              after = read_table(folder / "refined/ltc.h5");
  // These queries are neither refined on nor those that decide what is kept; the
  // mean of 200 has a standard error of some 5 %, the same on both sides.
  EXPECT_LT(mean_relative_loss(after), 0.85 * mean_relative_loss(before));
  // Nodes at alpha = 0 are kept as they are, and the losses stated are those of what is stored.
  EXPECT_EQ(after.matrix_at(0), before.matrix_at(0));
  const std::size_t moved = before.grid.flat({1, 1, 1, 1});
  EXPECT_NE(after.matrix_at(moved), before.matrix_at(moved));
  EXPECT_NE(after.sw_loss[moved], before.sw_loss[moved]);
}

// Only a refinement that was kept makes a table a refined one, whatever its config asks for.
TEST(RefineProgram, FilesSayWhetherTheTableIsRefined) {
  const TemporaryDirectory folder;
  const auto refined = [&](const std::vector<std::string>& more, const std::string& words) {
    const ProgramResult made = run_ltcfit(generate(more), folder.path());
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find(words), std::string::npos) << made.out;
    EXPECT_EQ(read_table(folder / "out/ltc.0.exr").refined,
              read_table(folder / "out/ltc.h5").refined);
    return read_table(folder / "out/ltc.h5").refined;
  };
  EXPECT_EQ(refined({"--set", "refine.steps=0"}, "entries "), false);
  // So short a step betters nothing.
  EXPECT_EQ(refined({"--set", "refine.steps=1", "--set", "refine.damping=1e6", "--set",
                     "refine.queries_per_cell=1", "--set", "refine.start=fits", "--set",
                     "refine.loss=samples"},
                    "refined  not: "),
            false);
  EXPECT_EQ(refined({"--set", "refine.steps=2"}, "refined  2 steps"), true);
  // Nothing is added to it, so it is as it was.
  EXPECT_EQ(refined({"--set", "refine.steps=0", "--extend", "out/ltc.h5"}, "entries "), true);
}

// The matrix that a printed command shows as stored.
Eigen::Matrix3d shown_by(const std::string& command, const TemporaryDirectory& folder) {
  const ProgramResult fit =
      run_program({"sh", "-c", std::string(LTCFIT_PROGRAM).append(command, 6).append(" --json -")},
                  folder.path());
  EXPECT_EQ(fit.exit_code, 0) << command << fit.err;
  const auto rows = nlohmann::json::parse(fit.out)["matrix"]["stored"];
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix(row, column) = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  return matrix;
}

// Every line of `text` that has `label` in front of a command names an entry of the table, and the
// command shows it bit for bit.
void expect_commands_show(const std::string& text, const std::string& label, const Table& table,
                          const TemporaryDirectory& folder, std::size_t commands) {
  std::istringstream lines(text);
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(label), begin = line.find("ltcfit fit ");
    if (at == std::string::npos || begin == std::string::npos)
      continue;
    ++found;
    NodeIndex node;
    ASSERT_EQ(sscanf(line.c_str() + line.rfind(' '), "%zu,%zu,%zu,%zu", &node.alpha, &node.lambda,
                     &node.theta, &node.phi),
              4);
    EXPECT_EQ(shown_by(line.substr(begin), folder), table.stored_at(table.grid.flat(node))) << line;
  }
  EXPECT_EQ(found, commands) << text;
}

// Fits of few samples: each command makes one of its own.
TEST(RefineProgram, CommandsShowWhatIsStoredAndWhatWasFitted) {
  const TemporaryDirectory folder;
  const auto make = [&](const std::string& name, const std::string& steps) {
    return run_ltcfit(
        generate({"-o", name, "--set", "refine.steps=" + steps, "--set",
                  "fit.gauss_newton.samples=128", "--set", "fit.gauss_newton.target_samples=512"}),
        folder.path());
  };
  ASSERT_EQ(make("fitted", "0").exit_code, 0);
  const ProgramResult made = make("refined", "2");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Table before = read_table(folder / "fitted/ltc.h5"),
              after = read_table(folder / "refined/ltc.h5");
  expect_commands_show(made.out, "in the table:", after, folder, 5);
  expect_commands_show(made.out, "before refinement:", before, folder, 5);
  // So do those of validate; and diff prints what tells the two tables apart.
  const ProgramResult checked = run_ltcfit(
      {"validate", "--no-quality", "refined/ltc.h5", "--set", "invariants.condition_number=1",
       "--set", "invariants.alignment_degrees=180", "--set", "invariants.neighbour_excess=1e9"},
      folder.path());
  EXPECT_EQ(checked.exit_code, 1);
  expect_commands_show(checked.out, "in the table:", after, folder, 5);
  expect_commands_show(checked.out, "before refinement:", before, folder, 5);
  const ProgramResult compared = run_ltcfit(
      {"diff", "refined/ltc.h5", "fitted/ltc.h5", "--samples", "256", "--directions", "4"},
      folder.path());
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_NE(compared.out.find("    A: ltcfit fit --as-in refined/ltc.h5 --entry "),
            std::string::npos);
  EXPECT_NE(compared.out.find("    B: ltcfit fit --config fitted/ltc.h5 --entry "),
            std::string::npos);
}

TEST(RefineProgram, ServesAScene) {
  const TemporaryDirectory folder;
  folder.write("scene.toml",
               "[[material]]\nname = \"m\"\nalpha_x = [0.55, 0.9]\nalpha_y = [0.5, 0.6]\n");
  const ProgramResult result = run_ltcfit(
      generate({"--scene", "scene.toml", "--set", "refine.steps=2", "-o", "out"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("refined  2 steps over "), std::string::npos) << result.out;
  const Table table = read_table(folder / "out/ltc.h5");
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
  const Table old = read_table(folder / "old/ltc.h5"), table = read_table(folder / "new/ltc.h5"),
              unrefined = read_table(folder / "unrefined/ltc.h5");
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
