// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/validate_settings.h"
#include "test_paths.h"

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "core/error.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

using test::expect_one_line;
using test::message_of;
using test::TemporaryDirectory;

const std::filesystem::path shipped =
    std::filesystem::path(LTCFIT_SOURCE_DIR) / "config" / "validate.toml";

TEST(ValidateSettings, TheShippedFileSaysEveryKeyWithItsDefault) {
  const toml::table file = toml::parse_file(shipped.string());
  std::size_t said = 0;
  for (const auto& [section, keys] : file)
    said += keys.as_table()->size();
  EXPECT_EQ(said, validate_keys().size());
  for (const ConfigKey& key : validate_keys()) {
    const auto node = file.at_path(key.name);
    ASSERT_TRUE(node) << key.name << " is not in config/validate.toml";
    toml::table found;
    found.insert("value", *node.node());
    EXPECT_TRUE(found == toml::parse("value = " + key.default_value))
        << key.name << " in config/validate.toml is not " << key.default_value;
  }
  EXPECT_NO_THROW(load_validate_settings(shipped, {}));
}

// What the program demands of refined tables is what the file says.
TEST(ValidateSettings, ThoseOfRefinedTablesAreThoseOfTheirFile) {
  const auto of_refined = shipped.parent_path() / "validate-refined.toml";
  const ValidateSettings read = load_validate_settings(of_refined, {});
  const ValidateSettings built_in = settings_for_refined_tables();
  EXPECT_EQ(read.invariants, built_in.invariants);
  EXPECT_EQ(read.thresholds, built_in.thresholds);
  EXPECT_NE(built_in.invariants, InvariantLimits{});
  EXPECT_NE(built_in.thresholds, QualityThresholds{});
  // A file for a refined table needs only what differs from them.
  const std::vector<std::string> overrides = {"quality.query_loss=0.09"};
  const ValidateSettings changed = load_validate_settings({}, overrides, built_in);
  EXPECT_EQ(changed.thresholds.query_loss, 0.09);
  EXPECT_EQ(changed.invariants, built_in.invariants);
}

TEST(ValidateSettings, FollowWhatIsKnownOfTheTable) {
  Table table;
  table.refined = false;
  EXPECT_EQ(settings_for(table).invariants, InvariantLimits{});
  EXPECT_EQ(settings_for(table).thresholds, QualityThresholds{});
  table.refined = true;
  const ValidateSettings of_refined = settings_for_refined_tables();
  EXPECT_EQ(settings_for(table).invariants, of_refined.invariants);
  EXPECT_EQ(settings_for(table).thresholds, of_refined.thresholds);
  // Not known: what either may have.
  table.refined.reset();
  const ValidateSettings unknown = settings_for(table);
  EXPECT_EQ(unknown.invariants, of_refined.invariants);
  EXPECT_EQ(unknown.thresholds.node_loss, of_refined.thresholds.node_loss);
  EXPECT_EQ(unknown.thresholds.query_loss, QualityThresholds{}.query_loss);
  // Wide cells: half of alpha is 3.5 times the default's seventh.
  table.refined = true;
  table.grid = Grid::paper(3);
  InvariantLimits wide = of_refined.invariants;
  wide.neighbour_slack = settings_for(table).invariants.neighbour_slack;
  EXPECT_NEAR(wide.neighbour_slack, 3.5 * of_refined.invariants.neighbour_slack, 1e-9);
  EXPECT_EQ(settings_for(table).invariants, wide);
  table.refined = false;
  EXPECT_EQ(settings_for(table).invariants, InvariantLimits{});
  table.grid = Grid::paper(8);
  // 16 bits: what they cannot hold, and nothing else.
  table.refined = false;
  table.precision = Precision::half;
  InvariantLimits half;
  half.unit_length = half.albedo_error = 5e-4;
  half.neighbour_slack = 3e-4;
  half.alignment_degrees = 1;
  EXPECT_EQ(settings_for(table).invariants, half);
  table.refined = true;
  EXPECT_EQ(settings_for(table).invariants.neighbour_slack, of_refined.invariants.neighbour_slack);
  EXPECT_EQ(settings_for(table).thresholds, of_refined.thresholds);
}

TEST(ValidateSettings, FilesAndThenOverridesSetKeys) {
  const TemporaryDirectory folder;
  const auto file = folder.write("v.toml",
                                 "[invariants]\ncondition_number = 1e5\nsamples = 1024\n"
                                 "directions = 8\n");
  const std::vector<std::string> overrides = {"invariants.samples=4096"};
  const ValidateSettings settings = load_validate_settings(file, overrides);
  EXPECT_EQ(settings.invariants.condition_number, 1e5);
  EXPECT_EQ(settings.invariants.samples, 4096);
  EXPECT_EQ(settings.said, (std::set<std::string>{"invariants.condition_number",
                                                  "invariants.samples", "invariants.directions"}));
  EXPECT_EQ(settings.invariants.directions, 8);
  EXPECT_EQ(settings.invariants.loss_excess, InvariantLimits{}.loss_excess);
}

TEST(ValidateSettings, WhatIsWrongIsSaidInOneLine) {
  const TemporaryDirectory folder;
  const auto message = [&](std::string_view text) {
    const auto file = folder.write("v.toml", text);
    return message_of<InputError>([&] { load_validate_settings(file, {}); });
  };
  expect_one_line(message("[invariants]\ncondition_numbers = 1e5\n"),
                  {"v.toml:2", "unknown key invariants.condition_numbers",
                   "did you mean invariants.condition_number?"});
  expect_one_line(message("[invariant]\nzero = 0.0\n"), {"v.toml:1", "unknown section invariant"});
  expect_one_line(message("[elsewhere]\nxyz = 0.0\n"), {"v.toml:1", "config/validate.toml"});
  expect_one_line(message("[invariants]\nzero = \"none\"\n"),
                  {"v.toml:2", "invariants.zero = \"none\"", "a number in [0, 1e+300]"});
  expect_one_line(message("[invariants]\nsamples = 10\n"),
                  {"v.toml:2", "invariants.samples = 10", "[1024, 65536]"});
  expect_one_line(message("[invariants]\nbelow_horizon = 2\n"), {"v.toml:2", "[0, 1]"});
  expect_one_line(message("[invariants\n"), {"v.toml:1", "not TOML", "config/validate.toml lists"});
  const std::vector<std::string> overrides = {"invariants.samples"};
  expect_one_line(message_of<InputError>([&] { load_validate_settings(std::nullopt, overrides); }),
                  {"override invariants.samples", "key=value"});
  expect_one_line(message_of<IoError>([&] { load_validate_settings(folder / "none.toml", {}); }),
                  {"none.toml", "No such file"});
}

}  // namespace
}  // namespace ltc
