// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit diff, through the real program: what it finds and writes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/diff_tables.h"
#include "export/table_file.h"
#include "judge/compare.h"
#include "picture/png.h"
#include "support/program.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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
  write_table(example(), folder / "a.h5");
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
  write_table(example(), folder / "good.h5");
  write_table(damaged_example(), folder / "bad.h5");
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
  write_table(good, folder / "good.h5");
  write_table(bad, folder / "bad.h5");
  const ProgramResult result = run_ltcfit(
      diff(folder / "bad.h5", folder / "good.h5", {"--csv", (folder / "all.csv").string()}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> lines = lines_of(read_file(folder / "all.csv"));
  ASSERT_EQ(lines.size(), 1 + good.grid.size() + 16);  // and the look-ups between the nodes
  EXPECT_EQ(lines[0],
            "alpha,lambda,theta,phi,loss_a,loss_b,spread,distance,"
            "matrix_difference,amplitude_difference,fresnel_difference,alpha_x,alpha_y,"
            "theta_degrees,phi_degrees,area_light_error_a,area_light_error_b,"
            "area_light_error_with_amplitude_a,area_light_error_with_amplitude_b");
  EXPECT_TRUE(lines.back().starts_with("nan,nan,nan,nan,0.")) << lines.back();
  const std::vector<EntryComparison> expected = compare_tables(bad, good, quick_settings(), {1});
  for (std::size_t flat = 0; flat < good.grid.size(); ++flat) {
    std::istringstream line(lines[1 + flat]);
    std::vector<double> values;
    for (std::string field; std::getline(line, field, ',');)
      values.push_back(std::strtod(field.c_str(), nullptr));
    const NodeIndex node = good.grid.node(flat);
    values.resize(11);  // the lobe's own parameters follow
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
  write_table(part, folder / "part.h5");
  write_table(example(), folder / "whole.h5");
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
  write_table(example(), folder / "good.h5");
  write_table(damaged_example(), folder / "bad.h5");
  const ProgramResult result =
      run_ltcfit(diff("bad.h5", "good.h5", {"--json", "all.json"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(read_file(folder / "all.json"));
  EXPECT_EQ(json["a"], "bad.h5");
  EXPECT_EQ(json["shape"], (std::vector<int>{3, 2, 5, 4}));
  EXPECT_EQ(json["compared"], 120);
  EXPECT_TRUE(json["tolerance"].is_null());
  const std::vector<EntryComparison> expected =
      compare_tables(damaged_example(), example(), quick_settings(), {1});
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
    EXPECT_EQ(json["worst"][list][0]["command_a"], "ltcfit fit --as-in bad.h5 --entry 0,1,0,2");
    EXPECT_EQ(json["worst"][list][0]["relative_distance"], expected[bad].relative_distance());
  }
}

// ---- Between the nodes ----

std::string verdict_line(const std::string& report) {
  for (const std::string& line : lines_of(report))
    if (line.starts_with("nearer to GGX: "))
      return line;
  return "";
}

TEST(Diff, SaysInOneLineWhichTableIsNearerInUse) {
  const TemporaryDirectory folder;
  Table wide = example();
  for (std::size_t flat = 0; flat < wide.grid.size(); ++flat) {
    Eigen::Matrix3d matrix = wide.stored_at(flat);
    matrix.leftCols(2) *= 3;
    wide.set_stored(flat, matrix);
  }
  write_table(example(), folder / "good.h5");
  write_table(wide, folder / "wide.h5");
  const auto run = [&](const char* a, const char* b) {
    const ProgramResult result = run_ltcfit(diff(a, b, {"--json", "all.json"}), folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return std::pair(verdict_line(result.out), Json::parse(read_file(folder / "all.json")));
  };
  const auto [line, json] = run("good.h5", "wide.h5");
  for (const char* part : {"in use A (", "under area lights A (", "at nodes A ("})
    EXPECT_NE(line.find(part), std::string::npos) << line;
  EXPECT_EQ(json["nearer"], Json({{"in_use", "A"}, {"under_area_lights", "A"}, {"at_nodes", "A"}}));
  EXPECT_EQ(json["use"]["queries"], 16);
  EXPECT_EQ(json["queries"].size(), 16u);
  EXPECT_LT(json["use"]["loss"]["a"]["mean"], json["use"]["loss"]["b"]["mean"]);
  const auto [reversed_line, reversed] = run("wide.h5", "good.h5");
  EXPECT_EQ(reversed["nearer"]["in_use"], "B") << reversed_line;
  EXPECT_EQ(reversed["nearer"]["under_area_lights"], "B");
  const auto [same_line, same] = run("good.h5", "good.h5");
  EXPECT_EQ(same["nearer"]["in_use"], "alike") << same_line;
  EXPECT_EQ(same["nearer"]["at_nodes"], "alike");
}

TEST(Diff, TablesOfDifferentGridsAreComparedInUse) {
  const TemporaryDirectory folder;
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "coarse.h5");
  write_table(testing::synthetic_table(Grid::paper({4, 3, 5, 4}), Storage::matrix),
              folder / "fine.npy");
  const ProgramResult result = run_ltcfit(
      diff("coarse.h5", "fine.npy", {"--json", "all.json", "--csv", "all.csv"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("nodes are not compared: the tables have different grids (2x2x2x2 and "
                            "4x3x5x4); only use is judged\n"),
            std::string::npos)
      << result.out;
  EXPECT_NE(verdict_line(result.out).find("under area lights B ("), std::string::npos)
      << result.out;
  EXPECT_EQ(verdict_line(result.out).find("at nodes"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("Ratio of the losses"), std::string::npos) << result.out;
  const Json json = Json::parse(read_file(folder / "all.json"));
  EXPECT_EQ(json["same_grid"], false);
  EXPECT_FALSE(json.contains("entries"));
  EXPECT_TRUE(json["nearer"]["at_nodes"].is_null());
  EXPECT_EQ(json["use"]["compared"], 16);
  EXPECT_EQ(lines_of(read_file(folder / "all.csv")).size(), 17u);
}

TEST(Diff, SaysThatNodesOfARefinedTableAreNoFits) {
  const TemporaryDirectory folder;
  const auto write = [&](const char* name, bool refined) {
    Table table = example();
    table.refined = refined;
    write_table(table, folder / name);
  };
  write("refined.h5", true);
  write("fitted.h5", false);
  const auto text = [&](const char* a, const char* b) {
    return run_ltcfit(diff(a, b), folder.path()).out;
  };
  EXPECT_NE(text("refined.h5", "fitted.h5").find("\nA is refined: "), std::string::npos);
  EXPECT_NE(text("fitted.h5", "refined.h5").find("\nB is refined: "), std::string::npos);
  EXPECT_NE(text("refined.h5", "refined.h5").find("\nA and B are refined: "), std::string::npos);
  EXPECT_EQ(text("fitted.h5", "fitted.h5").find("refined: "), std::string::npos);
}

TEST(Diff, NamesThatAreNoUtf8HaveAReportToo) {
  const TemporaryDirectory folder;
  write_table(example(), folder / "a\xff.h5");
  const ProgramResult result = run_ltcfit(
      diff("a\xff.h5", "a\xff.h5", {"--json", "all.json", "--map", "map.png"}), folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(read_file(folder / "all.json"))["a"], "a\xef\xbf\xbd.h5");
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"all.json", "a\xff.h5", "map.png"}));
}

TEST(Diff, ArraysOfMatricesHaveNoTermsToCompare) {
  const TemporaryDirectory folder;
  const Table table = testing::synthetic_table(Grid::paper(2), Storage::mirror_frame);
  write_table(table, folder / "t.h5");
  write_table(table, folder / "t.npy");
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

TEST(Diff, ATableWithoutConfigIsLookedIntoAsItIs) {
  const TemporaryDirectory folder;
  Table table = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  write_table(table, folder / "good.npy");
  table.set_stored(table.grid.size() - 1, Eigen::Matrix3d::Identity());
  write_table(table, folder / "it's bad.npy");
  run_ltcfit(diff("it's bad.npy", "good.npy", {"--json", "all.json"}), folder.path());
  EXPECT_EQ(Json::parse(read_file(folder / "all.json"))["worst"]["distance"][0]["command_a"],
            "ltcfit fit --as-in 'it'\\''s bad.npy' --entry 1,1,1,1");
}

TEST(Diff, TheMapIsAPicture) {
  const TemporaryDirectory folder;
  write_table(example(), folder / "good.h5");
  write_table(damaged_example(), folder / "bad.h5");
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

}  // namespace
}  // namespace ltc::test
