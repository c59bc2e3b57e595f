// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "validate/validate_settings.h"

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

TEST(ValidateSettings, FilesAndThenOverridesSetKeys) {
  const TemporaryDirectory folder;
  const auto file = folder.write("v.toml",
                                 "[invariants]\ncondition_number = 1e5\nsamples = 512\n"
                                 "directions = 8\n");
  const std::vector<std::string> overrides = {"invariants.samples=1024"};
  const ValidateSettings settings = load_validate_settings(file, overrides);
  EXPECT_EQ(settings.invariants.condition_number, 1e5);
  EXPECT_EQ(settings.invariants.samples, 1024);
  EXPECT_EQ(settings.invariants.directions, 8);
  EXPECT_EQ(settings.invariants.loss_excess, InvariantLimits{}.loss_excess);
}

TEST(ValidateSettings, WhatIsWrongIsSaidInOneLine) {
  const TemporaryDirectory folder;
  const auto message = [&](std::string_view text) {
    const auto file = folder.write("v.toml", text);
    return message_of<InputError>([&] { load_validate_settings(file, {}); });
  };
  expect_one_line(message("[invariants]\ncondition = 1e5\n"),
                  {"v.toml:2", "unknown key invariants.condition", "condition_number"});
  expect_one_line(message("[invariant]\nzero = 0.0\n"), {"v.toml:1", "unknown key invariant"});
  expect_one_line(message("[elsewhere]\nxyz = 0.0\n"), {"v.toml:1", "config/validate.toml"});
  expect_one_line(message("[invariants]\nzero = \"none\"\n"),
                  {"v.toml:2", "invariants.zero = \"none\"", "a number in [0, 1e+300]"});
  expect_one_line(message("[invariants]\nsamples = 10\n"),
                  {"v.toml:2", "invariants.samples = 10", "[256, 65536]"});
  expect_one_line(message("[invariants]\nhalf_determinant = 1\n"), {"v.toml:2", "[0, 1)"});
  expect_one_line(message("[invariants\n"), {"v.toml:1", "not TOML"});
  const std::vector<std::string> overrides = {"invariants.samples"};
  expect_one_line(message_of<InputError>([&] { load_validate_settings(std::nullopt, overrides); }),
                  {"--set invariants.samples", "key=value"});
  expect_one_line(message_of<IoError>([&] { load_validate_settings(folder / "none.toml", {}); }),
                  {"none.toml", "No such file"});
}

}  // namespace
}  // namespace ltc
