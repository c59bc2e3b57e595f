// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "bench/setting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "config/config.h"
#include "core/error.h"
#include "support/refusal.h"
#include "test_paths.h"

namespace ltc {
namespace {

const BenchSetting& setting(std::string_view name) {
  static const std::vector<BenchSetting> all = bench_settings(1);
  const auto found = std::find_if(all.begin(), all.end(), [&](const BenchSetting& candidate) {
    return candidate.name == name;
  });
  if (found == all.end())
    throw std::runtime_error("no such setting");
  return *found;
}

std::string as_toml(const FitSettings& fit) {
  Config config;
  config.fit = fit;
  return to_toml(config);
}

FitSettings shipped(const std::string& file) {
  return load_config(std::string(LTCFIT_SOURCE_DIR) + "/config/" + file, {}).fit;
}

TEST(BenchSettings, AreThoseOfTheShippedConfigs) {
  EXPECT_EQ(as_toml(setting("default").fit), as_toml(shipped("default.toml")));
  EXPECT_EQ(as_toml(setting("sgd-practical").fit), as_toml(shipped("sgd.toml")));
  EXPECT_EQ(as_toml(setting("sgd-published").fit), as_toml(shipped("paper.toml")));
  FitSettings reference = shipped("reference.toml");
  EXPECT_NE(as_toml(setting("reference").fit), as_toml(reference));
  reference.gauss_newton.neighbour_sweeps = 0;
  EXPECT_EQ(as_toml(setting("reference").fit), as_toml(reference));
}

TEST(BenchSettings, DifferInNameAndContent) {
  std::set<std::string> names, contents;
  for (const BenchSetting& one : bench_settings(1)) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_TRUE(contents.insert(as_toml(one.fit)).second) << one.name;
  }
}

TEST(BenchSettings, TakeTheSeed) {
  for (const BenchSetting& one : bench_settings(7))
    EXPECT_EQ(one.fit.seed, 7u) << one.name;
}

TEST(BenchSettings, AreSelectedByNameInTheOrderOfTheList) {
  const std::vector<BenchSetting> all = bench_settings(1);
  EXPECT_EQ(select_settings(all, "").size(), all.size());
  const std::vector<BenchSetting> two = select_settings(all, "reference,default");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].name, "reference");
  EXPECT_EQ(two[1].name, "default");
}

TEST(BenchSettings, UnknownEmptyAndRepeatedNamesAreRefused) {
  const auto refusal = [](std::string_view list) {
    return test::message_of<InputError>([&] { select_settings(bench_settings(1), list); });
  };
  test::expect_one_line(refusal("defualt"), {"unknown setting \"defualt\"", "sgd-published"});
  test::expect_one_line(refusal("default,"), {"\"\""});
  test::expect_one_line(refusal(","), {"\"\""});
  test::expect_one_line(refusal("default,default"), {"\"default\" stands twice"});
}

}  // namespace
}  // namespace ltc
