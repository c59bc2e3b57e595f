// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/config.h"

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc {
namespace {

using test::message_of;
using test::TemporaryDirectory;

Config load(const std::vector<std::string>& overrides) {
  return load_config(std::nullopt, overrides);
}

Config load_text(std::string_view text) {
  const TemporaryDirectory folder;
  return load_config(folder.write("config.toml", text), {});
}

void expect_refused(const std::string& override, const std::vector<std::string>& parts) {
  SCOPED_TRACE(override);
  test::expect_one_line(message_of<InputError>([&] { load({override}); }), parts);
}

TEST(Config, DefaultsAreThePapersGrid) {
  const Config config = load({});
  EXPECT_TRUE(config.grid == Grid::paper());  // bit for bit: Grid compares doubles exactly
  EXPECT_EQ(config.grid.theta.last(), 0.9999 * std::numbers::pi / 2);
  EXPECT_EQ(config.grid.phi.last(), std::numbers::pi / 2);
  EXPECT_EQ(to_toml(config), to_toml(Config{}));
}

TEST(Config, TextOfTheDefaultsIsPlain) {
  const std::string text = to_toml(Config{});
  EXPECT_NE(text.find("last_degrees = 89.991\n"), std::string::npos) << text;
  EXPECT_NE(text.find("last_degrees = 90.0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[fit.sgd]\n"), std::string::npos) << text;
}

// Another allowed value for the key, one that needs all its digits where it can.
std::string other_value(const ConfigKey& key) {
  const toml::table parsed = toml::parse("value = " + key.default_value);
  const toml::node& node = *parsed.get("value");
  if (const auto* flag = node.as_boolean())
    return flag->get() ? "false" : "true";
  if (const auto* integer = node.as_integer())
    return std::to_string(integer->get() + 1);
  if (node.as_floating_point()) {
    const bool last = key.name.find(".last") != std::string::npos;
    const bool angle = key.name.ends_with("_degrees");
    return angle ? (last ? "76.543210987654321" : "0.12345678901234567")
                 : (last ? "0.98765432109876543" : "0.12345678901234567");
  }
  const std::string quoted = key.allowed;  // `"a", "b" or "c"`: the last
  if (const std::size_t end = quoted.rfind('"'); quoted.front() == '"') {
    const std::size_t begin = quoted.rfind('"', end - 1);
    return quoted.substr(begin, end - begin + 1);
  }
  return "\"other\"";
}

TEST(Config, EveryKeyChangesTheTextAndReadsBack) {
  std::vector<std::string> all;
  for (const ConfigKey& key : config_keys()) {
    SCOPED_TRACE(key.name);
    // Of storages the last goes with isotropic grids only.
    const std::string value = key.name == "table.storage" ? "\"mirror-frame\"" : other_value(key);
    const Config changed = load({key.name + "=" + value});
    EXPECT_NE(to_toml(changed), to_toml(Config{}));
    EXPECT_EQ(to_toml(load_text(to_toml(changed))), to_toml(changed));
    // No files at all, lattices of rejected samples, folds and horizons by other solvers are
    // refused together only.
    const bool goes_with_all = (!key.name.starts_with("output.") || key.name == "output.name") &&
                               key.name != "fit.sgd.lattice_samples" && key.name != "fit.lobe" &&
                               key.name != "fit.horizon";
    if (goes_with_all)
      all.push_back(key.name + "=" + value);
  }
  const Config changed = load(all);
  const Config again = load_text(to_toml(changed));
  EXPECT_EQ(to_toml(again), to_toml(changed));
  EXPECT_TRUE(again.grid == changed.grid);
  EXPECT_EQ(again.fit.sgd.learning_rate, 0.12345678901234567);
  EXPECT_TRUE(again.output == changed.output);
  EXPECT_EQ(again.storage, Storage::mirror_frame);
  EXPECT_EQ(again.fit.seed, 2u);
}

TEST(Config, AnglesOfAnyDegreesReadBackToTheSameBits) {
  for (int i = 1; i < 2000; ++i) {
    const Config config =
        load({"table.theta.last_degrees=" + std::to_string(i * 0.0449) + std::to_string(i * 7919)});
    EXPECT_TRUE(load_text(to_toml(config)).grid == config.grid) << i;
  }
}

TEST(Config, OneNodeReadsBack) {
  const Config config = load({"table.lambda.nodes=1", "table.lambda.first=1"});
  EXPECT_EQ(config.grid.lambda.nodes, std::vector<double>{1.0});
  EXPECT_TRUE(load_text(to_toml(config)).grid == config.grid);
}

TEST(Config, LaterOverridesWin) {
  const TemporaryDirectory folder;
  const auto file = folder.write("c.toml", "[fit]\nseed = 5\nsolver = \"sgd\"\n");
  EXPECT_EQ(load_config(file, {}).fit.seed, 5u);
  const std::vector<std::string> overrides = {"fit.seed=6", "fit.seed=7"};
  const Config config = load_config(file, overrides);
  EXPECT_EQ(config.fit.seed, 7u);
  EXPECT_EQ(config.fit.solver, SolverKind::sgd);
}

TEST(Config, OverridesTakeBareStringsAndWholeNumbersForReals) {
  EXPECT_EQ(load({"fit.solver=sgd"}).fit.solver, SolverKind::sgd);
  EXPECT_EQ(load({"fit.solver=\"sgd\""}).fit.solver, SolverKind::sgd);
  EXPECT_EQ(load({"fit.sgd.learning_rate=2"}).fit.sgd.learning_rate, 2.0);
  EXPECT_EQ(load({"fit.sgd.steps=1e6"}).fit.sgd.steps, 1'000'000);
  EXPECT_EQ(load({"fit.seed=9007199254740992.0"}).fit.seed, 9007199254740992u);
}

TEST(Config, UnknownKeysAreNamedWithTheNearest) {
  expect_refused("fit.sgd.stepz=3",
                 {"override", "fit.sgd.stepz", "3", "did you mean fit.sgd.steps?"});
  expect_refused("learning_rate=3", {"did you mean fit.sgd.learning_rate?"});
  expect_refused("colour=\"red\"", {"unknown key colour", "config/default.toml"});
  expect_refused("fit.sgd=3", {"fit.sgd is a section"});
  expect_refused("fit.seed.more=3", {"unknown key fit.seed.more"});
}

TEST(Config, WrongTypesAreRefused) {
  expect_refused("fit.seed=inf", {"fit.seed = inf", "a whole number in [0, "});
  expect_refused("fit.seed=nan", {"fit.seed = nan", "a whole number in [0, "});
  expect_refused("fit.sgd.steps=1e8", {"fit.sgd.steps = 1", "[1, 10000000]"});
  expect_refused("fit.seed=1.5", {"fit.seed = 1.5", "a whole number in [0, "});
  expect_refused("fit.seed=many", {"fit.seed = \"many\"", "a whole number"});
  expect_refused("fit.seed=[1, 2]", {"fit.seed = an array", "a whole number"});
  expect_refused("fit.sgd.learning_rate=true", {"= true", "a number in (0, 1000]"});
  expect_refused("output.exr=1", {"output.exr = 1", "true or false"});
  expect_refused("fit.solver=3",
                 {"fit.solver = 3", "\"gauss-newton\", \"sgd\" or \"l3-nelder-mead\""});
  expect_refused("fit.sgd.steps={a = 1}", {"fit.sgd.steps", "a whole number"});
}

TEST(Config, ValuesOutOfRangeAreRefused) {
  expect_refused("fit.sgd.steps=0", {"override: fit.sgd.steps = 0", "[1, 10000000]"});
  expect_refused("fit.seed=-1", {"fit.seed = -1", "[0, 9007199254740992]"});
  expect_refused("fit.sgd.learning_rate=0", {"(0, 1000]"});
  expect_refused("fit.sgd.learning_rate=nan", {"= nan", "(0, 1000]"});
  expect_refused("fit.sgd.learning_rate=inf", {"= inf", "(0, 1000]"});
  expect_refused("table.alpha.nodes=65", {"[1, 64]"});
  expect_refused("table.theta.last_degrees=90.1", {"[0, 90]"});
  expect_refused("table.phi.last_degrees=90.5", {"[0, 90]"});
  expect_refused("table.alpha_min=0", {"table.alpha_min = 0"});
  expect_refused("table.storage=other", {"\"other\"", "\"inverse\" or \"folded\""});
  expect_refused("fit.solver=SGD", {"\"SGD\"", "\"sgd\""});
  for (const char* name : {"", "a/b", ".hidden", "-x", "a b"})
    expect_refused(std::string("output.name=") + name, {"output.name", "file name"});
}

TEST(Config, KeysThatDoNotGoTogetherAreRefused) {
  expect_refused("table.alpha.first=1",
                 {"override: table.alpha.first = 1", "table.alpha.last = 1"});
  expect_refused("table.theta.first_degrees=89.995", {"table.theta.first_degrees", "89.991"});
  const std::string message = message_of<InputError>([] {
    load({"output.hdf5=false", "output.exr=false", "output.npy=false"});
  });
  EXPECT_NE(message.find("at least one true"), std::string::npos) << message;
  const std::string lattice = message_of<InputError>([] {
    load({"fit.target=rejection", "fit.sgd.lattice_samples=true"});
  });
  test::expect_one_line(lattice, {"override: fit.sgd.lattice_samples = true",
                                  "fit.target = \"rejection\"", "\"weighted\""});
}

TEST(Config, OverridesNeedAnEqualsSign) {
  expect_refused("fit.seed", {"override fit.seed", "key=value"});
  expect_refused("=3", {"override =3", "key=value"});
  expect_refused("fit.seed=1\nfit.solver=3", {"fit.seed", "a whole number"});
}

TEST(Config, FilesAreNamedWithTheLine) {
  const TemporaryDirectory folder;
  const auto message = [&](std::string_view text) {
    const auto file = folder.write("bad.toml", text);
    const std::string all = message_of<InputError>([&] { load_config(file, {}); });
    EXPECT_EQ(all.find('\n'), std::string::npos) << all;
    EXPECT_EQ(all.find(file.string() + ":"), 0u) << all;
    return all.substr(std::min(all.size(), file.string().size()));
  };
  EXPECT_EQ(message("[fit]\n\nseed = -1\n").find(":3: fit.seed = -1: expected a whole"), 0u);
  EXPECT_EQ(
      message("[fitt]\nseed = 1\n").find(":1: unknown section fitt; config/default.toml lists"),
      0u);
  EXPECT_EQ(message("[fit]\nseed = \n").find(":2: not TOML"), 0u);
  EXPECT_EQ(message("fit = 3\n").find(":1: fit = 3: fit is a section"), 0u);
  EXPECT_EQ(message("[fit]\nseed = 1\nseed = 2\n").find(":3: not TOML"), 0u);
  EXPECT_EQ(message("\xff\xfe\x00").find(":1: not TOML"), 0u);
  EXPECT_EQ(message("[table.alpha]\nfirst = 0.5\nlast = 0.25\n").find(":"), 0u);
}

TEST(Config, TextAtHandReadsAsAFileDoes) {
  const Config config = parse_config("[fit]\nseed = 7\n", "t.h5", {});
  EXPECT_EQ(config.fit.seed, 7u);
  EXPECT_EQ(config.grid, Config{}.grid);
  const std::vector<std::string> overrides = {"fit.seed=9"};
  EXPECT_EQ(parse_config(to_toml(config), "t.h5", overrides).fit.seed, 9u);
  for (const auto& [text, fault] : {std::pair{"[fit]\nsed = 7\n", "t.h5:2: unknown key fit.sed"},
                                    {"[fit\n", "t.h5:1: not TOML"}})
    try {
      parse_config(text, "t.h5", {});
      ADD_FAILURE() << text << " was accepted";
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(fault)) << error.what();
    }
}

TEST(Config, FilesThatCannotBeReadAreIoErrors) {
  const TemporaryDirectory folder;
  const auto message = [](const std::filesystem::path& file) {
    return message_of<IoError>([&] { load_config(file, {}); });
  };
  EXPECT_EQ(message(folder / "none.toml"), "cannot read config " + (folder / "none.toml").string() +
                                               ": No such file or directory");
  EXPECT_NE(message(folder.path()).find("it is a folder"), std::string::npos);
  EXPECT_NE(message_of<InputError>([] { load_config("/dev/zero", {}); }).find("larger than"),
            std::string::npos);
}

// ---- The configs that come with the program ----

std::filesystem::path shipped(std::string_view name) {
  return std::filesystem::path(LTCFIT_SOURCE_DIR) / "config" / name;
}

TEST(ShippedConfigs, DefaultSaysEveryKeyWithItsDefault) {
  const toml::table file = toml::parse_file(shipped("default.toml").string());
  for (const ConfigKey& key : config_keys()) {
    const toml::table expected = toml::parse("value = " + key.default_value);
    const auto said = file.at_path(key.name);
    ASSERT_TRUE(said) << key.name << " is not in config/default.toml";
    toml::table found;
    found.insert("value", *said.node());
    EXPECT_TRUE(found == expected)
        << key.name << " in config/default.toml is not " << key.default_value;
  }
  EXPECT_EQ(to_toml(load_config(shipped("default.toml"), {})), to_toml(Config{}));
}

TEST(ShippedConfigs, PaperIsAsPublished) {
  const Config paper = load_config(shipped("paper.toml"), {});
  EXPECT_TRUE(paper.grid == Grid::paper());
  EXPECT_EQ(paper.storage, Storage::matrix);
  EXPECT_EQ(paper.fit.solver, SolverKind::sgd);
  EXPECT_EQ(paper.fit.target, TargetKind::rejection);
  EXPECT_EQ(paper.fit.sgd.steps, 10000);
  EXPECT_EQ(paper.fit.sgd.samples, 2048);
  EXPECT_EQ(paper.fit.sgd.directions, 64);
  EXPECT_EQ(paper.fit.sgd.learning_rate, 1.0);
  EXPECT_EQ(paper.fit.sgd.step_scale, 0.1);
  EXPECT_EQ(paper.fit.sgd.step_decay, 0.999);
  EXPECT_EQ(paper.fit.sgd.averaged_steps, 1);
  EXPECT_EQ(paper.fit.sgd.start, StartKind::identity);
  EXPECT_FALSE(paper.fit.sgd.scaled_variables);
  EXPECT_FALSE(paper.fit.sgd.lattice_samples);
  // "below some 3000 the step size has not died away": to a twentieth by then.
  EXPECT_NEAR(std::pow(paper.fit.sgd.step_decay, 3000), 0.05, 0.001);
}

TEST(ShippedConfigs, SgdIsAsItsCommentsSay) {
  const Config sgd = load_config(shipped("sgd.toml"), {});
  EXPECT_TRUE(sgd.grid == Grid::paper());
  EXPECT_EQ(sgd.fit.solver, SolverKind::sgd);
  EXPECT_EQ(sgd.fit.target, TargetKind::weighted);
  EXPECT_EQ(sgd.fit.sgd.start, StartKind::moments);
  EXPECT_TRUE(sgd.fit.sgd.scaled_variables);
  EXPECT_TRUE(sgd.fit.sgd.lattice_samples);
  // "the noise dies away within the steps above": the last step is 0.002 of the first.
  EXPECT_NEAR(std::pow(sgd.fit.sgd.step_decay, sgd.fit.sgd.steps), 0.002, 0.0005);
  EXPECT_GT(sgd.fit.sgd.averaged_steps, 1);
  EXPECT_LT(sgd.fit.sgd.averaged_steps, sgd.fit.sgd.steps / 10);
  // "a minute or two instead of hours": a five-hundredth of the paper's samples and more.
  const Config paper = load_config(shipped("paper.toml"), {});
  const auto work = [](const SgdSettings& settings) {
    return 1.0 * settings.steps * settings.samples * settings.directions;
  };
  EXPECT_LT(500 * work(sgd.fit.sgd), work(paper.fit.sgd));
}

TEST(ShippedConfigs, ReferenceSpendsMoreOnEverythingThanTheDefault) {
  const Config reference = load_config(shipped("reference.toml"), {});
  EXPECT_TRUE(reference.grid == Grid::paper());
  EXPECT_EQ(reference.fit.solver, SolverKind::gauss_newton);
  EXPECT_EQ(reference.fit.target, TargetKind::weighted);
  const GaussNewtonSettings more = reference.fit.gauss_newton, less;
  EXPECT_GT(more.coarse_samples, less.coarse_samples);
  EXPECT_GT(more.coarse_directions, less.coarse_directions);
  EXPECT_GT(more.coarse_steps, less.coarse_steps);
  EXPECT_LT(more.coarse_tolerance, less.coarse_tolerance);
  EXPECT_GT(more.samples, less.samples);
  EXPECT_GT(more.directions, less.directions);
  EXPECT_GT(more.steps, less.steps);
  EXPECT_LT(more.tolerance, less.tolerance);
  EXPECT_GT(more.target_samples, less.target_samples);
  EXPECT_GT(more.starts, less.starts);
  EXPECT_GT(more.neighbour_sweeps, less.neighbour_sweeps);
}

// "What is not said here is as in config/default.toml."
TEST(ShippedConfigs, WhatTheyDoNotSayIsTheDefault) {
  const toml::table defaults = toml::parse(to_toml(Config{}));
  for (const char* name : {"paper.toml", "sgd.toml", "reference.toml"}) {
    const toml::table said = toml::parse_file(shipped(name).string());
    const toml::table effective = toml::parse(to_toml(load_config(shipped(name), {})));
    int differ = 0;
    for (const ConfigKey& key : config_keys()) {
      toml::table a, b;
      a.insert("value", *effective.at_path(key.name).node());
      b.insert("value", *defaults.at_path(key.name).node());
      if (a == b)
        continue;
      ++differ;
      EXPECT_TRUE(said.at_path(key.name)) << key.name << " of " << name;
    }
    EXPECT_GT(differ, 0) << name;
  }
}

TEST(ShippedConfigs, AllOfThemLoad) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shipped("")))
    // Those of validate are of another kind: validate_settings_test.cpp.
    if (entry.path().extension() == ".toml" &&
        !entry.path().filename().string().starts_with("validate")) {
      EXPECT_NO_THROW(load_config(entry.path(), {})) << entry.path();
      ++count;
    }
  EXPECT_GE(count, 4);
}

// ---- What tells two configs apart ----

TEST(ConfigDifference, IsTheFirstKeyThatMakesOtherFits) {
  const Config config = load({"fit.seed=3", "fit.sgd.steps=7"});
  EXPECT_FALSE(first_difference(config, to_toml(config), "x.h5"));
  const auto found = first_difference(config, to_toml(load({"fit.sgd.steps=8"})), "x.h5");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->key, "fit.seed");  // not the steps, which come later
  EXPECT_EQ(found->value, "3");
  EXPECT_EQ(found->other, "1");
}

TEST(ConfigDifference, SeesEveryKeyButThoseOfTheOutput) {
  const Config config = load({});
  const std::string text = to_toml(config);
  std::size_t seen = 0;
  for (const ConfigKey& key : config_keys()) {
    SCOPED_TRACE(key.name);
    toml::table table = toml::parse(text);
    // No key takes a list, so this is another value whatever the key takes.
    const std::size_t dot = key.name.rfind('.');
    table.at_path(key.name.substr(0, dot))
        .as_table()
        ->insert_or_assign(key.name.substr(dot + 1), toml::array{});
    std::ostringstream changed;
    changed << table;
    const auto found = first_difference(config, changed.str(), "x.h5");
    if (key.name.starts_with("output.")) {
      EXPECT_FALSE(found);
    } else {
      ASSERT_TRUE(found);
      EXPECT_EQ(found->key, key.name);
      ++seen;
    }
  }
  EXPECT_GT(seen, 40u);
}

TEST(ConfigDifference, AKeyThatIsMissingDiffers) {
  const auto found = first_difference(load({}), "[fit]\nseed = 1\n", "x.h5");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->other, "");
}

TEST(ConfigDifference, RefusesWhatIsNoToml) {
  test::expect_one_line(
      message_of<InputError>([] { first_difference(Config{}, "[fit\n", "x.h5"); }),
      {"x.h5:1", "not TOML"});
}

}  // namespace
}  // namespace ltc
