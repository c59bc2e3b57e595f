// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// docs/json.md lists the keys that --json writes, and no others.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "support/generate_runs.h"

namespace ltc::test {
namespace {

using namespace runs;
using Json = nlohmann::json;
using Keys = std::set<std::string>;

// "a.b", "a[]", "a[].b" of all that the value holds; of null and of empty lists their own name.
void add_keys(const Json& value, const std::string& name, Keys& keys) {
  if (value.is_object() && !value.empty())
    for (const auto& [key, member] : value.items())
      add_keys(member, name.empty() ? key : name + "." + key, keys);
  else if (value.is_array() && !value.empty())
    for (const Json& member : value)
      add_keys(member, name + "[]", keys);
  else
    keys.insert(name);
}

// Between backticks in the first column of a command's tables.
Keys documented_keys(const std::string& command) {
  std::istringstream lines(read_file(LTCFIT_SOURCE_DIR "/docs/json.md"));
  Keys keys;
  bool of_command = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## "))
      of_command = line == "## " + command;
    if (!of_command || !line.starts_with("| `"))
      continue;
    const std::string cell = line.substr(0, line.find('|', 1));
    const std::regex quoted("`([^`]+)`");
    for (std::sregex_iterator key(cell.begin(), cell.end(), quoted), end; key != end; ++key)
      keys.insert((*key)[1]);
  }
  return keys;
}

// Whether a printed key is a documented one, or one of its ".*", or a list of it that is empty.
bool matches(const std::string& printed, const std::string& documented) {
  if (documented.ends_with(".*"))
    return printed.starts_with(documented.substr(0, documented.size() - 1));
  return printed == documented || printed + "[]" == documented;
}

// Whether it holds a documented one, and is null or empty.
bool holds(const std::string& printed, const std::string& documented) {
  return documented.starts_with(printed + ".") || documented.starts_with(printed + "[");
}

void expect_same(const Keys& printed, const Keys& documented) {
  for (const std::string& key : printed)
    EXPECT_TRUE(std::any_of(
        documented.begin(), documented.end(),
        [&](const std::string& known) { return matches(key, known) || holds(key, known); }))
        << key << " is printed and not documented";
  for (const std::string& key : documented)
    EXPECT_TRUE(std::any_of(printed.begin(), printed.end(),
                            [&](const std::string& known) { return matches(known, key); }))
        << key << " is documented and not printed";
}

TEST(JsonDocument, TellsKeysApart) {
  Keys keys;
  add_keys(Json::parse(R"({"a": {"b": 1}, "c": [{"d": null}, {"e": []}], "f": [[1]], "g": {}})"),
           "", keys);
  EXPECT_EQ(keys, (Keys{"a.b", "c[].d", "c[].e", "f[][]", "g"}));
  EXPECT_TRUE(matches("a.b", "a.*"));
  EXPECT_FALSE(matches("ab", "a.*"));
  EXPECT_FALSE(matches("a", "a.b"));
  EXPECT_TRUE(holds("a", "a.b"));
  EXPECT_FALSE(holds("a", "ab.c"));
}

class JsonDocumentOf : public ::testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult made =
        run_ltcfit(generate(tiny + Arguments{"--set", "output.name=T"}), folder_.path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  // Under the heading of the command, or another one.
  void expect_documented(const std::vector<Arguments>& runs, const std::string& heading = "") {
    Keys printed;
    for (const Arguments& run : runs) {
      const ProgramResult result = run_ltcfit(run + Arguments{"--json", "-"}, folder_.path());
      ASSERT_TRUE(Json::accept(result.out)) << result.err;
      add_keys(Json::parse(result.out), "", printed);
    }
    expect_same(printed, documented_keys(heading.empty() ? runs.front().front() : heading));
  }

  TemporaryDirectory folder_;
};

TEST_F(JsonDocumentOf, Generate) {
  expect_documented({generate(tiny), generate(tiny + Arguments{"--set", "refine.steps=0"})});
}

TEST_F(JsonDocumentOf, Shard) {
  expect_documented({generate(tiny + Arguments{"--shard", "1/2"})}, "generate --shard");
}

TEST_F(JsonDocumentOf, Fit) {
  const Arguments lobe = {"--alpha-x", "0.3", "--alpha-y", "0.1", "--theta", "40", "--phi", "20"};
  const Arguments entry = {"--entry", "1,1,1,1"};
  expect_documented(
      {Arguments{"fit", "--samples", "64", "--check-gradient"} + lobe,
       Arguments{"fit", "--samples", "64", "--set", "fit.lobe=folded"} + lobe,
       Arguments{"fit", "--samples", "64", "--solver", "sgd", "--set", "fit.sgd.steps=2"} + lobe,
       {"fit", "--entry", "1,7,1,7"},
       Arguments{"fit", "--set", "table.storage=mirror-frame"} + entry,
       Arguments{"fit", "--as-in", "T.h5"} + entry,
       Arguments{"fit", "--as-in", "T.h5"} + lobe});
}

TEST_F(JsonDocumentOf, Diff) {
  run_ltcfit(generate(tiny + Arguments{"--set", "output.name=U", "--set", "refine.steps=0"}),
             folder_.path());
  // Another grid.
  run_ltcfit(generate(tiny + Arguments{"--set", "output.name=V", "--set", "refine.steps=0", "--set",
                                       "table.phi.nodes=3"}),
             folder_.path());
  const Arguments quick = {"--samples", "64", "--directions", "2", "--queries", "8"};
  expect_documented({Arguments{"diff", "T.h5", "V.h5", "--tolerance", "0"} + quick,
                     Arguments{"diff", "T.h5", "U.h5", "--tolerance", "0"} + quick,
                     Arguments{"diff", "T.h5", "U.h5"} + quick});
}

TEST_F(JsonDocumentOf, Validate) {
  expect_documented({{"validate", "T.h5", "--set", "quality.queries=20", "--set",
                      "invariants.condition_number=1"},
                     {"validate", "T.npy", "--no-quality"}});
}

TEST_F(JsonDocumentOf, Bench) {
  expect_documented({{"bench", "--entries", "1", "--settings", "default", "--samples", "64"}});
}

TEST_F(JsonDocumentOf, Stress) {
  expect_documented({{"stress", "--quick", "--solver", "gauss-newton", "--fits", "1"}});
}

TEST_F(JsonDocumentOf, Render) {
  // A table whose axes do not reach the material.
  run_ltcfit(generate(tiny + Arguments{"--set", "output.name=V", "--set", "refine.steps=0", "--set",
                                       "table.alpha.first=0.2"}),
             folder_.path());
  expect_documented(
      {{"render", "V.h5", "--size", "8", "--samples", "16", "--material", "0.1,0.05"}});
}

}  // namespace
}  // namespace ltc::test
