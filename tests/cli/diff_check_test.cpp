// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff, through the real program: its tolerance, and what it refuses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/diff_tables.h"
#include "export/table_file.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// ---- The check ----

TEST(DiffTolerance, BoundsTheDistanceBetweenTheLobes) {
  const TemporaryDirectory folder;
  write_table(example(), folder / "good.h5");
  write_table(damaged_example(), folder / "bad.h5");
  const std::size_t bad = example().grid.flat(damaged_node);
  const double distance =
      compare_tables(damaged_example(), example(), quick_settings(), {1})[bad].relative_distance();
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
  write_table(example(), folder / "a.h5");
  const auto expect = [&](const Table& b, const std::string& tolerance, int exit_code,
                          const std::string& what) {
    write_table(b, folder / "b.h5");
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

// Where nodes cannot be compared one by one, the look-ups are bound.
TEST(DiffTolerance, BoundsTheLookUpsOfTablesOfDifferentGrids) {
  const TemporaryDirectory folder;
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "a.h5");
  write_table(testing::synthetic_table(Grid::paper(3), Storage::matrix), folder / "b.h5");
  const auto run = [&](const std::string& b, const std::string& tolerance) {
    return run_ltcfit(diff("a.h5", b, {"--tolerance", tolerance, "--json", "all.json"}),
                      folder.path());
  };
  run("b.h5", "1");
  const Json use = Json::parse(read_file(folder / "all.json"))["use"];
  const double largest = std::max({use["relative_distance"]["largest"].get<double>(),
                                   use["amplitude_difference"]["largest"].get<double>(),
                                   use["fresnel_difference"]["largest"].get<double>()});
  EXPECT_GT(largest, 0.01);
  const ProgramResult passed = run("b.h5", fmt::format("{}", largest));
  EXPECT_EQ(passed.exit_code, 0) << passed.err;
  const ProgramResult failed = run("b.h5", fmt::format("{}", 0.999 * largest));
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.err.find(" in 1 query, at most "), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find(" at alpha_x "), std::string::npos) << failed.err;
  const Json exceeded = Json::parse(read_file(folder / "all.json"))["tolerance"]["exceeded"];
  EXPECT_EQ(exceeded[0]["queries"], 1);
  // A table that lacks what the look-ups need exceeds every tolerance.
  Table part = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  for (std::size_t flat = 27; flat < part.grid.size(); ++flat) {
    part.set_stored(flat, Eigen::Matrix3d::Constant(std::nan("")));
    part.amplitude[flat] = part.fresnel[flat] = part.sw_loss[flat] = std::nanf("");
    part.status[flat] = Status::skipped;
  }
  write_table(part, folder / "part.h5");
  const ProgramResult lacking = run("part.h5", "100");
  EXPECT_EQ(lacking.exit_code, 1);
  EXPECT_NE(lacking.err.find("16 queries in need of an entry that B has not"), std::string::npos)
      << lacking.err;
}

// The fit is deterministic, and its seed matters.
TEST(DiffTolerance, TwoRunsOfOneConfigDifferByNothing) {
  const TemporaryDirectory folder;
  const auto generate = [&](const std::string& output, const std::string& seed) {
    const ProgramResult made = run_ltcfit(
        {"generate", "--output", output, "--set", "table.alpha.nodes=2", "--set",
         "table.lambda.nodes=2", "--set", "table.theta.nodes=3", "--set", "table.phi.nodes=2",
         "--set", "fit.target=rejection", "--set", "refine.steps=0", "--set", "fit.seed=" + seed},
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
      run_ltcfit({"fit", "--config", "one/ltc.h5", "--entry", entry, "--json", "-"}, folder.path());
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
  write_table(table, folder / "t.h5");
  const ProgramResult damage =
      run_program({"/usr/bin/python3", LTCFIT_SOURCE_DIR "/tests/export/damage_h5.py",
                   (folder / "t.h5").string(), folder.path().string()});
  ASSERT_EQ(damage.exit_code, 0) << damage.err;
  const std::string whole = read_file(folder / "t.h5");
  folder.write("cut.h5", whole.substr(0, whole.size() * 2 / 3));
  folder.write("empty.h5", "");
  folder.write("text.h5", "no table at all");
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "t.npy");
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
}

TEST(DiffBadInput, IsRefusedInOneLineAndWritesNothing) {
  const TemporaryDirectory tables;
  write_table(example(), tables / "a.h5");
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), tables / "small.h5");
  Grid finer = testing::uneven_grid();
  finer.alpha_min = 1e-5;
  write_table(testing::synthetic_table(finer, Storage::matrix), tables / "finer.h5");
  const fs::path a = tables / "a.h5", garbage = tables.write("garbage.h5", "no table at all");
  const std::string whole = read_file(a);
  const fs::path cut = tables.write("cut.h5", whole.substr(0, whole.size() / 2));
  const std::vector<std::string> csv = {"--csv", "all.csv"};
  const auto without_use = [&](const char* b) {
    return std::vector<std::string>{"diff",  a.string(), (tables / b).string(), "--queries", "0",
                                    "--csv", "all.csv"};
  };
  expect_refused(without_use("small.h5"), 2,
                 {a.string(), (tables / "small.h5").string(), "different shapes", "3x2x5x4",
                  "2x2x2x2", "same grid", "--queries"});
  expect_refused(without_use("finer.h5"), 2, {"alpha_min", "same grid"});
  expect_refused(diff(a, tables / "small.h5", {"--map", "map.png"}), 2,
                 {"different shapes", "same grid", "--map"});
  Grid sharp = Grid::paper(2);
  sharp.alpha = Axis::make(0.01, 0.05, 2, Warp::linear);
  write_table(testing::synthetic_table(sharp, Storage::matrix), tables / "sharp.h5");
  expect_refused(diff(a, tables / "sharp.h5", csv), 2, {"different", "no lobe in common"});
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
  expect_refused({"diff", a.string(), a.string(), "--samples", "1"}, 2, {"--samples"});
  expect_refused({"diff", a.string(), a.string(), "--directions", "0"}, 2, {"--directions"});
  expect_refused({"diff", a.string(), a.string(), "--seed", "-1"}, 2, {"--seed"});
  for (const char* tolerance : {"nan", "-1", "inf", "1x", ""})
    expect_refused({"diff", a.string(), a.string(), "--tolerance", tolerance}, 2,
                   {"--tolerance", "expected a number, 0 or more"});
  expect_refused(diff(a, a, {"--json", tables.path().string()}), 3, {"is a folder"});
  expect_refused(diff(a, a, {"--map", tables.path().string()}), 3, {"is a folder"});
  expect_refused({"diff", a.string()}, 2, {"B is missing"});
}

}  // namespace
}  // namespace ltc::test
