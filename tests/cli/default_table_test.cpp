// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The default table, made once by the real program on the paper's whole grid: what it is, that its
// files agree, and how near it comes to fits with many more samples and starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "config/config.h"
#include "core/parallel.h"
#include "export/same_tables.h"
#include "export/table_file.h"
#include "fit/fit_table.h"
#include "fit/solver.h"
#include "judge/comparison_summary.h"
#include "judge/held_out.h"
#include "support/broken_table.h"
#include "support/program.h"
#include "support/reference.h"
#include "support/sanitizer.h"
#include "support/table_faults.h"
#include "table/lookup.h"
#include "table/queries.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

std::size_t count(const Table& table, Status status) {
  return static_cast<std::size_t>(std::count(table.status.begin(), table.status.end(), status));
}

void expect_summary(const std::string& out) {
  EXPECT_NE(out.find("entries  4096: 2850 fitted, 1239 copied by symmetry, 7 analytic, 0 skipped, "
                     "0 failed\n"),
            std::string::npos)
      << out;
  const std::size_t memory = out.find("memory   ");
  ASSERT_NE(memory, std::string::npos) << out;
  const double megabytes = std::strtod(out.c_str() + memory + 9, nullptr);
  EXPECT_GT(megabytes, 1) << out;
  if (under_sanitizer)
    std::cout << "not checked, for a sanitizer's memory counts too: " << megabytes
              << " MB < 200 MB\n";
  else
    EXPECT_LT(megabytes, 200) << out;  // what the project promises
  // Fits keep the zeros of equation (16); what rounding leaves of them is set to zero.
  const std::size_t zeroed = out.find("largest value zeroed ");
  ASSERT_NE(zeroed, std::string::npos) << out;
  EXPECT_LT(std::strtod(out.c_str() + zeroed + 21, nullptr), 1e-12) << out;
}

void expect_agreeing_files(const Table& table, const fs::path& folder) {
  const Table textures = read_table(folder / "ltc.0.exr");
  EXPECT_EQ(textures.grid, table.grid);
  EXPECT_EQ(textures.storage, table.storage);
  testing::expect_same_bits(textures.stored, table.stored, "stored");
  testing::expect_same_bits(textures.amplitude, table.amplitude, "amplitude");
  testing::expect_same_bits(textures.fresnel, table.fresnel, "fresnel");
  const Table array = read_table(folder / "ltc.npy");
  EXPECT_EQ(array.grid, table.grid);
  testing::expect_same_bits(array.stored, table.stored, "stored");
}

void expect_readable_by_others(const fs::path& folder) {
  const auto check = [&](const fs::path& array) {
    return run_program({"/usr/bin/python3", LTCFIT_SOURCE_DIR "/tests/cli/check_made_table.py",
                        (folder / "ltc.h5").string(), array.string()});
  };
  const ProgramResult checked = check(folder / "ltc.npy");
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  EXPECT_EQ(checked.out, "0 2850 1239 7 0\n");
  // And it sees one float that differs.
  Table other = read_table(folder / "ltc.npy");
  other.stored[9 * 2000] = std::nextafter(other.stored[9 * 2000], 9.0f);
  write_table(other, folder / "other.npy");
  EXPECT_EQ(check(folder / "other.npy").exit_code, 1);
  for (const fs::path& texture : files_of_table(folder / "ltc.0.exr")) {
    const ProgramResult header = run_program({"exrheader", texture.string()});
    EXPECT_EQ(header.exit_code, 0) << header.err;
    EXPECT_NE(header.out.find("dataWindow (type box2i): (0 0) - (63 63)"), std::string::npos)
        << header.out;
  }
}

// ---- Accuracy ----

// A reduced config/reference.toml: the samples of the default, twice its directions, four times its
// starts and its target.
FitSettings reference_settings() {
  FitSettings settings;
  settings.gauss_newton.coarse_samples = 512;
  settings.gauss_newton.coarse_directions = 24;
  settings.gauss_newton.coarse_steps = 30;
  settings.gauss_newton.samples = 4096;
  settings.gauss_newton.directions = 64;
  settings.gauss_newton.steps = 40;
  settings.gauss_newton.tolerance = 1e-5;
  settings.gauss_newton.target_samples = 32768;
  settings.gauss_newton.starts = 4;
  return settings;
}

// Every 47th of the lobes that were fitted, so that all values of all four axes occur.
std::vector<std::size_t> stratified_entries(const Table& table) {
  std::vector<std::size_t> entries;
  std::size_t fitted = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (table.status[flat] == Status::fitted && fitted++ % 47 == 0)
      entries.push_back(flat);
  return entries;
}

// The loss of `matrix` at an entry, on samples that no fit has seen.
double held_out_loss(HeldOutJudge& judge, const Lobe& lobe, const Eigen::Matrix3d& matrix) {
  judge.set_lobe(lobe);
  return judge.loss(matrix);
}

const HeldOutJudge prototype(8192, 32);

// The reference's matrices: the better of a fit from its own starts and one from the table's.
std::vector<Eigen::Matrix3d> reference_matrices(const Table& table,
                                                const std::vector<std::size_t>& entries) {
  struct State {
    HeldOutJudge judge = prototype;
    FitWorkspacePointer workspace = make_fit_workspace();
  };
  const std::unique_ptr<Solver> solver = make_solver(reference_settings());
  std::vector<Eigen::Matrix3d> matrices(entries.size());
  parallel_for_each<State>(
      "fit", entries.size(), {2}, [] { return State(); },
      [&](std::size_t i, State& state) {
        FitRequest request;
        request.lobe = table.grid.lobe(entries[i]);
        const Eigen::Matrix3d found = solver->fit(request, *state.workspace, nullptr).matrix;
        request.starts = {table.matrix_at(entries[i])};
        const Eigen::Matrix3d polished = solver->fit(request, *state.workspace, nullptr).matrix;
        const bool better = held_out_loss(state.judge, request.lobe, polished) <
                            held_out_loss(state.judge, request.lobe, found);
        matrices[i] = better ? polished : found;
      });
  return matrices;
}

Statistics ratios_to(const std::vector<Eigen::Matrix3d>& reference, const Table& table,
                     const std::vector<std::size_t>& entries) {
  HeldOutJudge judge = prototype;
  std::vector<EntryComparison> comparisons(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Lobe lobe = table.grid.lobe(entries[i]);
    comparisons[i] = {held_out_loss(judge, lobe, table.matrix_at(entries[i])),
                      held_out_loss(judge, lobe, reference[i]), judge.spread()};
  }
  return ratio_statistics(comparisons);
}

// The practical setting of the stochastic descent, at the same entries.
Table fitted_by_sgd(Table table, const std::vector<std::size_t>& entries) {
  const Config config = load_config(LTCFIT_SOURCE_DIR "/config/sgd.toml", {});
  std::vector<bool> needed(table.grid.size());
  for (const std::size_t flat : entries)
    needed[flat] = true;
  const std::vector<FittedEntry> fitted = fit_table(table.grid, config.fit, needed, {2});
  for (const std::size_t flat : entries)
    table.set_stored(flat, fitted[flat].matrix / fitted[flat].matrix.col(2).norm());
  return table;
}

void expect_near_reference(const Table& table) {
  const std::vector<std::size_t> entries = stratified_entries(table);
  ASSERT_EQ(entries.size(), 61u);
  const std::vector<Eigen::Matrix3d> reference = reference_matrices(table, entries);
  const Statistics ratios = ratios_to(reference, table, entries);
  EXPECT_EQ(ratios.count, entries.size());
  // What the project promises for the whole grid. Measured: 1.0008 and 1.019.
  EXPECT_LE(ratios.mean, 1.01);
  EXPECT_LE(ratios.largest, 1.15) << "entry " << entries[ratios.largest_index];
  // Were the reference worse than what it judges, the comparison would say nothing.
  EXPECT_GT(ratios.mean, 0.995);
  const Statistics sgd = ratios_to(reference, fitted_by_sgd(table, entries), entries);
  EXPECT_LE(sgd.mean, 1.03);  // measured: 1.003, and 1.025 at worst
  // And the comparison sees lobes that are too wide along x.
  Table wider = table;
  for (const std::size_t flat : entries) {
    Eigen::Matrix3d matrix = table.stored_at(flat);
    matrix.col(0) *= 1.05;
    wider.set_stored(flat, matrix);
  }
  EXPECT_GT(ratios_to(reference, wider, entries).mean, 1.01);
}

// ---- Soundness ----

std::set<std::string> entries_named(const nlohmann::json& report,
                                    bool in_check(const std::string&)) {
  std::set<std::string> entries;
  for (const nlohmann::json& invariant : report["invariants"])
    if (in_check(invariant["name"]))
      for (const nlohmann::json& entry : invariant["failed_entries"])
        entries.insert(entry["entry"]);
  return entries;
}

// `ltcfit validate` passes the table, its quality measured with a twentieth of the effort, and
// names each of five broken entries, and no other.
void expect_sound(const fs::path& folder) {
  std::vector<std::string> quick{"validate", "ltc.h5"};
  for (const char* key : {"node_samples=2048", "node_directions=8", "queries=300",
                          "query_samples=2048", "query_directions=16", "quad_samples=2048"}) {
    quick.push_back("--set");
    quick.push_back(std::string("quality.") + key);
  }
  const ProgramResult good = run_ltcfit(quick, folder);
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  const fs::path bad = folder / "bad.h5";
  fs::copy_file(folder / "ltc.h5", bad);
  break_table(bad, bad, "rotated", "5,5,5,5");
  break_table(bad, bad, "scaled", "2,2,2,2");
  break_table(bad, bad, "negated", "6,1,3,2");
  break_table(bad, bad, "singular", "1,6,3,5");
  break_table(bad, bad, "swapped", "3,3,4,1");
  const ProgramResult broken =
      run_ltcfit({"validate", "bad.h5", "--no-quality", "--json", "report.json"}, folder);
  EXPECT_EQ(broken.exit_code, 1) << broken.out;
  const nlohmann::json report = nlohmann::json::parse(read_file(folder / "report.json"));
  EXPECT_EQ(
      entries_named(report, [](const std::string&) { return true; }),
      (std::set<std::string>{"5,5,5,5", "2,2,2,2", "6,1,3,2", "1,6,3,5", "3,3,4,1", "3,3,5,1"}));
  // Neighbours alone find what changes the lobe: one of the two that are swapped at least.
  const std::set<std::string> jumps =
      entries_named(report, [](const std::string& name) { return name == "neighbours"; });
  EXPECT_TRUE(jumps.contains("5,5,5,5") && jumps.contains("6,1,3,2") &&
              (jumps.contains("3,3,4,1") || jumps.contains("3,3,5,1")))
      << broken.out;
}

// ---- Against the published table ----

// The row "all" of `ltcfit diff A B`, at the nodes alone.
nlohmann::json compared(const fs::path& folder, const std::string& a, const std::string& b,
                        const char* samples, const char* directions) {
  const ProgramResult result = run_ltcfit({"diff", a, b, "--queries", "0", "--samples", samples,
                                           "--directions", directions, "--json", "diff.json"},
                                          folder);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(read_file(folder / "diff.json"))["rows"][0];
}

bool is_nearer(const nlohmann::json& row) {
  return row["ratio"]["mean"] < 1.0 && row["ratio"]["largest"] <= 1.05 &&
         row["loss_a"]["mean"] < row["loss_b"]["mean"] &&
         // Where no LTC comes near, all are alike; to 0.1 %.
         row["loss_a"]["p95"] < 1.002 * row["loss_b"]["p95"].get<double>();
}

void expect_nearer_than_the_published(const fs::path& folder) {
  const fs::path published = reference_file("upstream_alpha_lambda_theta_phi.npy");
  if (!fs::exists(published))
    GTEST_SKIP() << "no " << published << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const nlohmann::json row = compared(folder, "ltc.h5", published.string(), "4096", "32");
  EXPECT_EQ(row["entries"], 4096);
  EXPECT_TRUE(is_nearer(row)) << row;
  // Measured: 0.905; 0.893 with all samples of `diff`, which tell lobes at alpha 0 better apart.
  EXPECT_LT(row["ratio"]["mean"], 0.92) << row;
  EXPECT_FALSE(is_nearer(compared(folder, published.string(), "ltc.h5", "1024", "8")));
}

// ---- Refined ----

double mean_relative_loss(const Table& table, const std::vector<Lobe>& lobes) {
  HeldOutJudge judge(2048, 16);
  double sum = 0;
  for (const Lobe& lobe : lobes) {
    judge.set_lobe(lobe);
    sum += judge.loss(look_up(table, lobe).matrix) / judge.spread();
  }
  return sum / static_cast<double>(lobes.size());
}

double mean_node_loss(const Table& table) {
  HeldOutJudge judge(1024, 16);
  double sum = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); flat += 5) {
    judge.set_lobe(table.grid.lobe(flat));
    sum += judge.loss(table.matrix_at(flat));
  }
  return sum;
}

void expect_refined(const std::string& out, const fs::path& folder, const Table& fitted) {
  expect_summary(out);
  EXPECT_NE(out.find("refined  "), std::string::npos) << out;
  const Table table = read_table(folder / "ltc.h5");
  EXPECT_EQ(table.config, to_toml(Config{}));
  EXPECT_EQ(faults_of(table), std::vector<std::string>{});
  expect_agreeing_files(table, folder);
  expect_readable_by_others(folder);
  // Queries that no refinement has seen. Measured over 2,400: 0.081 against 0.112; 300 of them tell
  // the ratio to some 4 %: 0.775.
  const std::vector<Lobe> lobes = random_queries({}, 300, 77, table.grid.alpha_min);
  EXPECT_LT(mean_relative_loss(table, lobes), 0.80 * mean_relative_loss(fitted, lobes));
  // The price at the nodes; measured: 1.28.
  EXPECT_LT(mean_node_loss(table), 1.35 * mean_node_loss(fitted));
}

// One test, since the tables take some seconds and tests share nothing.
TEST(DefaultTable, IsWholeReadableAndNearTheReference) {
  const TemporaryDirectory folder;
  const fs::path fitted = folder / "fitted";
  const ProgramResult result =
      run_ltcfit({"generate", "-o", "fitted", "--set", "refine.steps=0"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_summary(result.out);
  const Table table = read_table(fitted / "ltc.h5");
  EXPECT_EQ(table.grid, Grid::paper(8));
  Config config;
  config.refine.steps = 0;
  EXPECT_EQ(table.config, to_toml(config));
  EXPECT_EQ(count(table, Status::fitted), 2850u);
  EXPECT_EQ(count(table, Status::analytic), 7u);
  EXPECT_EQ(count(table, Status::copied), 1239u);
  EXPECT_EQ(faults_of(table), std::vector<std::string>{});
  expect_agreeing_files(table, fitted);
  expect_readable_by_others(fitted);
  expect_near_reference(table);
  expect_nearer_than_the_published(fitted);
  // What `ltcfit generate` makes without options.
  const ProgramResult refined = run_ltcfit({"generate"}, folder.path());
  ASSERT_EQ(refined.exit_code, 0) << refined.err;
  expect_refined(refined.out, folder / "out", table);
  expect_sound(fitted);
}

}  // namespace
}  // namespace ltc::test
