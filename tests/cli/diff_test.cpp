// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff, through the real program: what it finds, writes and refuses.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "export/hdf5.h"
#include "support/refused_run.h"
#include "table/synthetic.h"
#include "validate/compare.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> quick = {"--samples", "256", "--directions", "4"};

CompareSettings quick_settings() {
  CompareSettings settings;
  settings.samples = 256;
  settings.directions = 4;
  return settings;
}

std::vector<std::string> diff(const fs::path& a, const fs::path& b,
                              std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"diff", a.string(), b.string()};
  arguments.insert(arguments.end(), quick.begin(), quick.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Table example() {
  return testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
}

// alpha 0.1 seen from above, where the example's matrix is nearly the best: the one that is named
// last in the file's order.
constexpr NodeIndex damaged_node{0, 1, 0, 2};

Table damaged_example() {
  Table table = example();
  const std::size_t flat = table.grid.flat(damaged_node);
  Eigen::Matrix3d matrix = table.stored_at(flat);
  matrix.col(0) *= 20;
  table.set_stored(flat, matrix);
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

// The numbers after the name of a row of the report; empty if there is no such row.
std::vector<double> row(const std::string& report, const std::string& name) {
  for (const std::string& line : lines_of(report)) {
    if (!line.starts_with(name + " "))
      continue;
    std::istringstream numbers(line.substr(name.size()));
    std::vector<double> values;
    for (double value; numbers >> value;)
      values.push_back(value);
    return values;
  }
  return {};
}

TEST(Diff, ATableAgainstItselfHasTheRatioOne) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "a.h5");
  const ProgramResult result = run_ltcfit(diff(folder / "a.h5", folder / "a.h5"), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.h5"});
  // The whole grid, and each of its three planes of alpha: 0.1, 0.325 and 1.
  for (const auto& [name, entries] :
       {std::pair{"all", 120}, {"alpha 0.100", 40}, {"alpha 0.325", 40}, {"alpha 1.000", 40}}) {
    const std::vector<double> values = row(result.out, name);
    ASSERT_EQ(values.size(), 8u) << name << "\n" << result.out;
    EXPECT_EQ(values[0], entries) << name;
    EXPECT_GT(values[1], 0) << name;
    EXPECT_EQ(values[1], values[2]) << name;
    for (std::size_t ratio = 3; ratio < 8; ++ratio)
      EXPECT_EQ(values[ratio], 1) << name;
  }
}

TEST(Diff, FindsTheDamagedEntry) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "good.h5");
  write_hdf5(damaged_example(), folder / "bad.h5");
  const ProgramResult result =
      run_ltcfit(diff(folder / "bad.h5", folder / "good.h5"), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("largest ratio at entry 0,1,0,2 (alpha 0.100, lambda 1.000, "
                            "theta 0.0, phi 60.0)\n"),
            std::string::npos)
      << result.out;
  EXPECT_GT(row(result.out, "all").at(7), 5) << result.out;
  EXPECT_EQ(row(result.out, "alpha 0.100").at(7), row(result.out, "all").at(7));
  EXPECT_EQ(row(result.out, "alpha 1.000").at(7), 1);
  // The other way round it is the smallest, and the largest is 1.
  const ProgramResult reversed =
      run_ltcfit(diff(folder / "good.h5", folder / "bad.h5"), folder.path());
  EXPECT_EQ(row(reversed.out, "all").at(7), 1) << reversed.out;
}

TEST(Diff, TheCsvHasEveryEntryInTheOrderOfTheGrid) {
  const TemporaryDirectory folder;
  const Table good = example(), bad = damaged_example();
  write_hdf5(good, folder / "good.h5");
  write_hdf5(bad, folder / "bad.h5");
  const ProgramResult result = run_ltcfit(
      diff(folder / "bad.h5", folder / "good.h5", {"--csv", (folder / "all.csv").string()}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = lines_of(read_file(folder / "all.csv"));
  ASSERT_EQ(lines.size(), 1 + good.grid.size());
  EXPECT_EQ(lines[0], "alpha,lambda,theta,phi,loss_a,loss_b,spread");
  const std::vector<EntryComparison> expected =
      compare_tables(bad, good, quick_settings(), 1, nullptr);
  for (std::size_t flat = 0; flat < good.grid.size(); ++flat) {
    std::istringstream line(lines[1 + flat]);
    std::vector<double> values;
    for (std::string field; std::getline(line, field, ',');)
      values.push_back(std::strtod(field.c_str(), nullptr));
    const NodeIndex node = good.grid.node(flat);
    // Numbers are written with all their digits.
    EXPECT_EQ(values, (std::vector<double>{
                          static_cast<double>(node.alpha), static_cast<double>(node.lambda),
                          static_cast<double>(node.theta), static_cast<double>(node.phi),
                          expected[flat].loss_a, expected[flat].loss_b, expected[flat].spread}))
        << lines[1 + flat];
    EXPECT_EQ(expected[flat].loss_a != expected[flat].loss_b, node == damaged_node) << flat;
  }
}

TEST(Diff, EntriesThatOneTableLacksDoNotCount) {
  const TemporaryDirectory folder;
  Table part = example();
  const std::size_t flat = part.grid.flat({1, 0, 2, 1});
  part.set_stored(flat, Eigen::Matrix3d::Constant(std::nan("")));
  part.amplitude[flat] = part.fresnel[flat] = part.sw_loss[flat] = std::nanf("");
  part.status[flat] = Status::skipped;
  write_hdf5(part, folder / "part.h5");
  write_hdf5(example(), folder / "whole.h5");
  const ProgramResult result = run_ltcfit(
      diff(folder / "part.h5", folder / "whole.h5", {"--csv", (folder / "all.csv").string()}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(row(result.out, "all").at(0), 119);
  EXPECT_EQ(row(result.out, "all").at(7), 1);
  EXPECT_TRUE(lines_of(read_file(folder / "all.csv")).at(1 + flat).starts_with("1,0,2,1,nan,"));
}

TEST(DiffBadInput, IsRefusedInOneLineAndWritesNothing) {
  const TemporaryDirectory tables;
  write_hdf5(example(), tables / "a.h5");
  write_hdf5(testing::synthetic_table(Grid::paper(2), Storage::matrix), tables / "small.h5");
  Grid finer = testing::uneven_grid();
  finer.alpha_min = 1e-5;
  write_hdf5(testing::synthetic_table(finer, Storage::matrix), tables / "finer.h5");
  const fs::path a = tables / "a.h5", garbage = tables.write("garbage.h5", "no table at all");
  const std::string whole = read_file(a);
  const fs::path cut = tables.write("cut.h5", whole.substr(0, whole.size() / 2));
  const std::vector<std::string> csv = {"--csv", "all.csv"};
  expect_refused(diff(a, tables / "small.h5", csv), 2,
                 {"different shapes", "3x2x5x4", "2x2x2x2", "same grid"});
  expect_refused(diff(a, tables / "finer.h5", csv), 2, {"alpha_min", "same grid"});
  expect_refused(diff(a, tables / "none.h5", csv), 3, {"none.h5", "No such file"});
  expect_refused(diff(tables / "none.npy", a, csv), 3, {"none.npy", "No such file"});
  expect_refused(diff(tables.path(), a, csv), 2, {tables.path().string(), ".h5"});
  expect_refused(diff(a, garbage, csv), 2, {"garbage.h5"});
  expect_refused(diff(cut, a, csv), 2, {"cut.h5"});
  expect_refused(diff(a, tables.write("a.txt", "x"), csv), 2, {"a.txt", ".h5", ".npy"});
  expect_refused(diff(a, a, {"--csv", "/proc/none/all.csv"}), 3, {"/proc/none"});
  expect_refused(diff(a, a, {"--csv", (a / "all.csv").string()}), 3, {a.string()});
  expect_refused(diff(a, a, {"--csv", tables.path().string()}), 3,
                 {tables.path().string(), "is a folder"});
  // Nor does a folder for the file stay where the tables turn out not to match.
  expect_refused(diff(a, tables / "small.h5", {"--csv", "new/all.csv"}), 2, {"different shapes"});
  expect_refused({"diff", a.string(), a.string(), "--samples", "1"}, 2, {"--samples"});
  expect_refused({"diff", a.string(), a.string(), "--directions", "0"}, 2, {"--directions"});
  expect_refused({"diff", a.string(), a.string(), "--seed", "-1"}, 2, {"--seed"});
  expect_refused({"diff", a.string()}, 2, {"B", "required"});
}

}  // namespace
}  // namespace ltc::test
