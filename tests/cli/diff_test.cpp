// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff, through the real program: what it finds, writes and refuses.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "export/hdf5.h"
#include "export/npy.h"
#include "export/reader.h"
#include "picture/png.h"
#include "support/refused_run.h"
#include "table/synthetic.h"
#include "validate/compare.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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
  EXPECT_NE(result.out.find("\nLargest ratios\n0,1,0,2 (alpha 0.100, lambda 1.000, "
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
  EXPECT_EQ(lines[0],
            "alpha,lambda,theta,phi,loss_a,loss_b,spread,distance,"
            "matrix_difference,amplitude_difference,fresnel_difference");
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
                          expected[flat].loss_a, expected[flat].loss_b, expected[flat].spread,
                          expected[flat].distance, expected[flat].matrix_difference,
                          expected[flat].amplitude_difference, expected[flat].fresnel_difference}))
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

// ---- What it reports ----

TEST(Diff, TheJsonHasTheReport) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "good.h5");
  write_hdf5(damaged_example(), folder / "bad.h5");
  const ProgramResult result =
      run_ltcfit(diff("bad.h5", "good.h5", {"--json", "new/all.json"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(read_file(folder / "new/all.json"));
  EXPECT_EQ(json["a"], "bad.h5");
  EXPECT_EQ(json["shape"], (std::vector<int>{3, 2, 5, 4}));
  EXPECT_EQ(json["compared"], 120);
  EXPECT_TRUE(json["tolerance"].is_null());
  const std::vector<EntryComparison> expected =
      compare_tables(damaged_example(), example(), quick_settings(), 1, nullptr);
  const std::size_t bad = example().grid.flat(damaged_node);
  ASSERT_EQ(json["entries"].size(), 120u);
  EXPECT_EQ(json["entries"][bad]["entry"], "0,1,0,2");
  EXPECT_EQ(json["entries"][bad]["distance"], expected[bad].distance);
  EXPECT_EQ(json["rows"][0]["name"], "all");
  EXPECT_EQ(json["rows"][0]["a_nearer"], 0);
  EXPECT_EQ(json["rows"][0]["b_nearer"], 1);
  EXPECT_EQ(json["rows"][0]["distance"]["largest"], expected[bad].distance);
  EXPECT_EQ(json["rows"][0]["distance"]["largest_entry"], "0,1,0,2");
  for (const char* list : {"ratio", "distance"}) {
    ASSERT_EQ(json["worst"][list].size(), 1u) << "the others are equal";
    EXPECT_EQ(json["worst"][list][0]["command_a"], "ltcfit fit --config bad.h5 --entry 0,1,0,2");
    EXPECT_EQ(json["worst"][list][0]["relative_distance"], expected[bad].relative_distance());
  }
}

TEST(Diff, ArraysOfMatricesHaveNoTermsToCompare) {
  const TemporaryDirectory folder;
  const Table table = testing::synthetic_table(Grid::paper(2), Storage::mirror_frame);
  write_hdf5(table, folder / "t.h5");
  write_npy(table, folder / "t.npy");
  const ProgramResult result =
      run_ltcfit(diff("t.h5", "t.npy", {"--tolerance", "1e-5"}), folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("amplitude and Fresnel terms are not compared: B has none\n"),
            std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find("Differences of the integrals"), std::string::npos);
  // The plane alpha = 0 stands apart.
  EXPECT_EQ(row(result.out, "alpha > min").at(0), 8);
  EXPECT_EQ(row(result.out, "alpha 0.000").at(0), 8);
}

TEST(Diff, ATableWithoutConfigIsLookedIntoByItsOwnMatrix) {
  const TemporaryDirectory folder;
  const auto command_for = [&](const Grid& grid) {
    Table table = testing::synthetic_table(grid, Storage::matrix);
    write_npy(table, folder / "good.npy");
    table.set_stored(table.grid.size() - 1, Eigen::Matrix3d::Identity());
    write_npy(table, folder / "bad.npy");
    run_ltcfit(diff("bad.npy", "good.npy", {"--json", "all.json"}), folder.path());
    return Json::parse(read_file(folder / "all.json"))["worst"]["distance"][0]["command_a"]
        .get<std::string>();
  };
  EXPECT_EQ(command_for(Grid::paper({8, 8, 8, 8})),
            "ltcfit fit --entry 7,7,7,7 --start from=bad.npy");
  EXPECT_EQ(command_for(Grid::paper(2)),
            "ltcfit fit --alpha-x 1 --alpha-y 1 --theta 89.991 --phi 90 --start from=bad.npy");
}

TEST(Diff, TheMapIsAPicture) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "good.h5");
  write_hdf5(damaged_example(), folder / "bad.h5");
  const ProgramResult result =
      run_ltcfit(diff("bad.h5", "good.h5", {"--map", "map.png"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const picture::test::DecodedPng png = picture::test::decode_png(read_file(folder / "map.png"));
  // 3 x 2 tiles of 5 x 4 cells of 40 pixels, and words.
  EXPECT_GT(png.width, 500);
  EXPECT_GT(png.height, 600);
  // The damaged entry's red is there, and elsewhere no colour but white.
  std::size_t red = 0, blue = 0;
  for (std::size_t i = 0; i < png.rgb.size(); i += 3) {
    red += png.rgb[i] > png.rgb[i + 2] + 60;
    blue += png.rgb[i + 2] > png.rgb[i] + 60;
  }
  EXPECT_GT(red, 500u);
  EXPECT_GT(blue, 500u) << "the legend's blue half";
  EXPECT_LT(blue, 20000u);
}

// ---- The check ----

TEST(DiffTolerance, BoundsTheDistanceBetweenTheLobes) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "good.h5");
  write_hdf5(damaged_example(), folder / "bad.h5");
  const std::size_t bad = example().grid.flat(damaged_node);
  const double distance =
      compare_tables(damaged_example(), example(), quick_settings(), 1, nullptr)[bad]
          .relative_distance();
  const auto run = [&](const std::string& tolerance) {
    return run_ltcfit(diff("bad.h5", "good.h5", {"--tolerance", tolerance, "--json", "all.json"}),
                      folder.path());
  };
  const ProgramResult passed = run(fmt::format("{}", distance));
  EXPECT_EQ(passed.exit_code, 0) << passed.err;
  EXPECT_NE(passed.out.find(": passed\n"), std::string::npos) << passed.out;
  EXPECT_EQ(Json::parse(read_file(folder / "all.json"))["tolerance"]["passed"], true);
  const ProgramResult failed = run(fmt::format("{}", 0.999 * distance));
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_TRUE(failed.err.ends_with(
      fmt::format("ltcfit: tolerance {} exceeded: lobe distance in 1 entry, at most {:.4g} at "
                  "entry 0,1,0,2\n",
                  0.999 * distance, distance)))
      << failed.err;
  EXPECT_NE(failed.out.find("Largest distances"), std::string::npos) << "the report stands";
  EXPECT_EQ(Json::parse(read_file(folder / "all.json"))["tolerance"]["passed"], false);
}

TEST(DiffTolerance, BoundsAmplitudeFresnelTermAndCoverage) {
  const TemporaryDirectory folder;
  write_hdf5(example(), folder / "a.h5");
  const auto expect = [&](const Table& b, const std::string& tolerance, int exit_code,
                          const std::string& what) {
    write_hdf5(b, folder / "b.h5");
    const ProgramResult result =
        run_ltcfit(diff("a.h5", "b.h5", {"--tolerance", tolerance}), folder.path());
    EXPECT_EQ(result.exit_code, exit_code) << what;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  };
  Table b = example();
  expect(b, "0", 0, "");
  b.amplitude[4] += 0.25f;
  expect(b, "0.2", 1, "exceeded: amplitude in 1 entry, at most 0.25 at entry 0,0,1,0");
  expect(b, "0.3", 0, "");
  b = example();
  b.fresnel[4] += 0.25f;
  expect(b, "0.2", 1, "exceeded: Fresnel term in 1 entry, at most 0.25 at entry 0,0,1,0");
  b = example();
  b.amplitude[4] = std::nanf("");
  expect(b, "1", 1, "exceeded: 1 entry with values that cannot be judged, the first is 0,0,1,0");
  b = example();
  b.set_stored(4, Eigen::Matrix3d::Zero());
  expect(b, "1", 1, "exceeded: 1 entry with values that cannot be judged, the first is 0,0,1,0");
  b = example();
  b.set_stored(4, Eigen::Matrix3d::Constant(std::nan("")));
  b.status[4] = Status::skipped;
  expect(b, "1", 1, "exceeded: 1 entry only in A, the first is 0,0,1,0");
}

// The fit is deterministic, and its seed matters.
TEST(DiffTolerance, TwoRunsOfOneConfigDifferByNothing) {
  const TemporaryDirectory folder;
  const auto generate = [&](const std::string& output, const std::string& seed) {
    const ProgramResult made = run_ltcfit(
        {"generate", "--output", output, "--set", "table.alpha.nodes=2", "--set",
         "table.lambda.nodes=2", "--set", "table.theta.nodes=3", "--set", "table.phi.nodes=2",
         "--set", "fit.target=rejection", "--set", "fit.seed=" + seed},
        folder.path());
    EXPECT_EQ(made.exit_code, 0) << made.err;
  };
  generate("one", "1");
  generate("two", "1");
  generate("other", "2");
  const ProgramResult same =
      run_ltcfit(diff("one/ltc.h5", "two/ltc.h5", {"--tolerance", "0"}), folder.path());
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("\ntolerance 0: passed\n"), std::string::npos) << same.out;
  EXPECT_EQ(same.out.find("Largest ratios"), std::string::npos) << "no entry is worse";
  const ProgramResult other =
      run_ltcfit(diff("one/ltc.h5", "other/ltc.h5", {"--tolerance", "0"}), folder.path());
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("tolerance 0 exceeded: lobe distance in "), std::string::npos)
      << other.err;

  // The command for a worst entry gives back that entry of the table, bit for bit.
  const std::size_t begin = other.out.find("ltcfit fit --config one/ltc.h5 --entry ");
  ASSERT_NE(begin, std::string::npos) << other.out;
  const std::string command = other.out.substr(begin, other.out.find('\n', begin) - begin);
  const std::string entry = command.substr(command.rfind(' ') + 1);
  const ProgramResult fit =
      run_ltcfit({"fit", "--config", "one/ltc.h5", "--entry", entry, "--json"}, folder.path());
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const Table table = read_table(folder / "one/ltc.h5");
  NodeIndex node;
  ASSERT_EQ(
      sscanf(entry.c_str(), "%zu,%zu,%zu,%zu", &node.alpha, &node.lambda, &node.theta, &node.phi),
      4);
  const Json json = Json::parse(fit.out);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_EQ(json["matrix"]["stored"][i / 3][i % 3].get<double>(),
              static_cast<double>(table.stored[9 * table.grid.flat(node) + i]));
}

// ---- Bad input ----

// Every fault of a file, on either side: one line that names the file and the fault, exit code 2.
TEST(DiffBadInput, FilesThatAreNoTables) {
  const TemporaryDirectory folder;
  const Table table = testing::synthetic_table(testing::uneven_grid(), Storage::matrix);
  write_hdf5(table, folder / "t.h5");
  const ProgramResult damage =
      run_program({"/usr/bin/python3", LTCFIT_SOURCE_DIR "/tests/export/damage_h5.py",
                   (folder / "t.h5").string(), folder.path().string()});
  ASSERT_EQ(damage.exit_code, 0) << damage.err;
  const std::string whole = read_file(folder / "t.h5");
  folder.write("cut.h5", whole.substr(0, whole.size() * 2 / 3));
  folder.write("empty.h5", "");
  folder.write("text.h5", "no table at all");
  write_npy(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "t.npy");
  const std::string array = read_file(folder / "t.npy");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = array;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
  };
  folder.write("f8.npy", replaced("<f4", "<f8"));
  folder.write("big_endian.npy", replaced("<f4", ">f4"));
  folder.write("order.npy", replaced("False", "True "));
  folder.write("shape.npy", replaced("(2, 2, 2, 2, 3, 3)", "(2, 2, 2, 2, 9, 1)"));
  folder.write("cut.npy", array.substr(0, array.size() - 4));
  std::string not_finite = array;
  not_finite.replace(not_finite.size() - 4, 4, std::string("\0\0\xc0\x7f", 4));
  folder.write("nan.npy", not_finite);
  const std::pair<std::string, std::string> faults[] = {
      {"text.h5", "HDF5"},
      {"empty.h5", "HDF5"},
      {"cut.h5", "cut.h5"},
      {"other_format.h5", "format is \"lut\""},
      {"version_2.h5", "format_version is 2; allowed: 1"},
      {"matrix_has_nan.h5", "matrix of entry (1, 1, 2, 3) is not finite"},
      {"matrix_transposed.h5", "matrix has shape (4, 5, 2, 3, 3, 3)"},
      {"axis_shorter.h5", "expected: (3, 2, 5, 2, 3, 3)"},
      {"no_dataset_amplitude.h5", "dataset amplitude is missing"},
      {"no_storage.h5", "attribute storage of / is missing"},
      {"f8.npy", "type of the array is '<f8'"},
      {"big_endian.npy", "type of the array is '>f4'"},
      {"order.npy", "fortran_order of the array is True"},
      {"shape.npy", "shape of the array is (2, 2, 2, 2, 9, 1)"},
      {"cut.npy", "bytes long; its shape asks for"},
      {"nan.npy", "matrix of entry (1, 1, 1, 1) is not finite"},
  };
  for (const auto& [name, fault] : faults) {
    expect_refused(diff(folder / name, folder / "t.h5"), 2, {(folder / name).string(), fault});
    expect_refused(diff(folder / "t.h5", folder / name), 2, {(folder / name).string(), fault});
  }
  expect_refused(diff(folder / "t.h5", folder / "t.npy"), 2,
                 {(folder / "t.h5").string(), (folder / "t.npy").string(), "different shapes"});
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
  for (const char* tolerance : {"nan", "-1", "inf", "1x", ""})
    expect_refused({"diff", a.string(), a.string(), "--tolerance", tolerance}, 2,
                   {"--tolerance", "expected a number, 0 or more"});
  expect_refused(diff(a, a, {"--json", tables.path().string()}), 3, {"is a folder"});
  expect_refused(diff(a, a, {"--map", tables.path().string()}), 3, {"is a folder"});
  expect_refused({"diff", a.string()}, 2, {"B", "required"});
}

}  // namespace
}  // namespace ltc::test
