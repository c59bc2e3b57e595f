// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit fit, through the real program: what it prints, writes, reproduces and refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "export/table_file.h"
#include "support/program.h"
#include "table/table.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

using Json = nlohmann::json;

// One line on standard error with all the parts, the exit code, nothing else said or written.
void expect_refused(const std::vector<std::string>& arguments, int exit_code,
                    const std::vector<std::string>& parts) {
  const TemporaryDirectory folder;
  std::vector<std::string> command = {"fit"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const ProgramResult result = run_ltcfit(command, folder.path());
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.starts_with("ltcfit: ")) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos)
        << '"' << part << "\" is not in: " << result.err;
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

const std::vector<std::string> lobe = {"--alpha-x", "0.4", "--alpha-y", "0.2",
                                       "--theta",   "50",  "--phi",     "20"};

std::vector<std::string> fit_lobe(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"fit"};
  arguments.insert(arguments.end(), lobe.begin(), lobe.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Json json_of(const std::vector<std::string>& arguments) {
  const ProgramResult result = run_ltcfit(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

// ---- What it says ----

TEST(Fit, TellsAllOfALobe) {
  const ProgramResult result = run_ltcfit(fit_lobe({}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part :
       {"lobe     alpha_x 0.4, alpha_y 0.2, theta 50, phi 20 (degrees)", "solver   gauss-newton",
        "status   fitted", "start    moments\n", "coarse moments", "fine ", "\nfitted ",
        "\naligned ", "\nfinal ", "determinant ", "condition number ", "held out, ",
        "of the lobe's spread", "amplitude 0.", "Fresnel 0."})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in: " << result.out;
}

TEST(Fit, JsonHasTheNumbers) {
  const Json json = json_of(fit_lobe({"--json", "-"}));
  EXPECT_EQ(json["lobe"]["alpha_x"], 0.4);
  // Degrees to radians and back: a few units in the last place.
  EXPECT_NEAR(json["lobe"]["theta_degrees"].get<double>(), 50, 1e-12);
  EXPECT_EQ(json["status"], "fitted");
  EXPECT_GT(json["steps"].size(), 3u);
  EXPECT_GT(json["determinant"].get<double>(), 0);
  EXPECT_EQ(json["matrix"]["final"].size(), 3u);
  const double relative = json["loss"]["relative"];
  EXPECT_GT(relative, 0);
  // An LTC is within a few per cent of the spread of such a lobe.
  EXPECT_LT(relative, 0.1);
}

TEST(Fit, AFoldStandsBesideTheLtc) {
  const TemporaryDirectory folder;
  const std::vector<std::string> folded = {"--set", "fit.lobe=folded"};
  const ProgramResult result = run_ltcfit(fit_lobe(folded));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"coarse fold 1", "fine fold 1", "\nfold     k ", "kappa ", "gamma ",
                           "creases 0.4", "\nsingle   "})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in: " << result.out;
  const std::string picture = (folder / "lobe.png").string();
  const Json json = json_of(
      fit_lobe({folded[0], folded[1], "--check-gradient", "--plot", picture, "--json", "-"}));
  const Json plain = json_of(fit_lobe({"--json", "-"}));
  EXPECT_TRUE(json["gradient_check"]["passed"]);
  EXPECT_GT(json["determinant"].get<double>(), 0);
  EXPECT_EQ(json["fold"]["creases"], Json({0.4}));
  EXPECT_EQ(json["fold"]["gamma"], json["fold"]["g"]);
  // k = alpha_x^2 kappa / s_y; here s_y is 0.2 to a hundredth.
  const double k = json["fold"]["k"], kappa = json["fold"]["kappa"];
  EXPECT_NEAR(k / kappa, 0.4 * 0.4 / 0.2, 0.01 * k / kappa);
  EXPECT_EQ(json["fold"]["single"]["matrix"], plain["matrix"]["fitted"]);
  // Its matrix is aligned in the other one, which moves the samples it is judged by.
  EXPECT_NEAR(json["fold"]["single"]["loss"]["held_out"].get<double>() /
                  plain["loss"]["held_out"].get<double>(),
              1, 0.02);
  // Measured: 0.45 times.
  EXPECT_LT(json["loss"]["held_out"].get<double>(), 0.6 * plain["loss"]["held_out"].get<double>());
  EXPECT_GT(read_file(picture).size(), 10000u);
}

TEST(Fit, SolverSeedSamplesAndStart) {
  const Json gauss_newton = json_of(fit_lobe({"--json", "-", "--samples", "512", "--seed", "5"}));
  EXPECT_EQ(gauss_newton["solver"], "gauss-newton");
  EXPECT_EQ(gauss_newton["seed"], 5);
  const Json sgd = json_of(fit_lobe({"--json", "-", "--solver", "sgd", "--samples", "64", "--start",
                                     "first-order", "--set", "fit.sgd.steps=20"}));
  EXPECT_EQ(sgd["solver"], "sgd");
  EXPECT_EQ(sgd["steps"].size(), 20u);
  EXPECT_EQ(sgd["start"], "first-order");
  const Json simplex = json_of(fit_lobe({"--json", "-", "--solver", "l3-nelder-mead", "--samples",
                                         "64", "--set", "fit.l3.evaluations=50"}));
  EXPECT_EQ(simplex["solver"], "l3-nelder-mead");
  EXPECT_EQ(simplex["start"], "first-order");
  for (const Json& step : simplex["steps"])
    EXPECT_EQ(step["phase"], "simplex");
  for (const char* start : {"moments", "identity", "random"})
    EXPECT_EQ(json_of(fit_lobe({"--json", "-", "--start", start}))["steps"][0]["phase"],
              std::string("coarse ") + start);
}

TEST(Fit, TraceHasALineAStep) {
  const TemporaryDirectory folder;
  const std::string path = (folder / "trace.csv").string();
  const Json json = json_of(fit_lobe({"--json", "-", "--trace", path}));
  std::istringstream trace(read_file(path));
  std::string line;
  std::getline(trace, line);
  EXPECT_EQ(line, "phase,step,loss,gradient_norm,damping,seconds,accepted");
  std::size_t lines = 0;
  for (; std::getline(trace, line); ++lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6) << line;
    EXPECT_TRUE(line.starts_with(json["steps"][lines]["phase"].get<std::string>() + ",")) << line;
  }
  EXPECT_EQ(lines, json["steps"].size());
}

TEST(Fit, PlotIsAPicture) {
  const TemporaryDirectory folder;
  const std::string path = (folder / "lobe.png").string();
  ASSERT_EQ(run_ltcfit(fit_lobe({"--plot", path})).exit_code, 0);
  const std::string png = read_file(path);
  EXPECT_TRUE(png.starts_with("\x89PNG"));
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"lobe.png"});
}

TEST(Fit, ChecksTheGradient) {
  const ProgramResult result = run_ltcfit(fit_lobe({"--check-gradient"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("check    gradient check passed: largest relative error"),
            std::string::npos)
      << result.out;
}

// ---- The command that generate prints ----

// The words of a command as a shell would split them; nothing in them is quoted.
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

// Every "ltcfit fit …" line of a summary gives back the table's entry, bit for bit.
void expect_commands_reproduce(const std::vector<std::string>& generate, std::size_t commands) {
  const TemporaryDirectory folder;
  std::vector<std::string> arguments = {"generate", "--set", "refine.steps=0"};
  arguments.insert(arguments.end(), generate.begin(), generate.end());
  const ProgramResult made = run_ltcfit(arguments, folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Table table = read_table(folder / "out/ltc.h5");
  std::istringstream lines(made.out);
  std::size_t found = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find("ltcfit fit ");
    if (begin == std::string::npos)
      continue;
    ++found;
    std::vector<std::string> command = words_of(line.substr(begin));
    command.erase(command.begin());
    std::array<std::size_t, 4> index{};
    ASSERT_EQ(sscanf(command.back().c_str(), "%zu,%zu,%zu,%zu", &index[0], &index[1], &index[2],
                     &index[3]),
              4);
    const std::size_t flat = table.grid.flat({index[0], index[1], index[2], index[3]});
    command.insert(command.end(), {"--json", "-"});
    const Json json = json_of(command);
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_EQ(json["matrix"]["stored"][i / 3][i % 3].get<double>(),
                static_cast<double>(table.stored[9 * flat + i]))
          << line;
    EXPECT_EQ(json["loss"]["fit"].get<float>(), table.sw_loss[flat]);
    EXPECT_EQ(json["amplitude"].get<float>(), table.amplitude[flat]);
    EXPECT_EQ(json["fresnel"].get<float>(), table.fresnel[flat]);
    EXPECT_EQ(json["iterations"], table.iterations[flat]);
  }
  EXPECT_EQ(found, commands);
}

TEST(Fit, CommandOfGenerateReproducesTheEntry) {
  expect_commands_reproduce(
      {"--set", "table.alpha.nodes=3", "--set", "table.lambda.nodes=3", "--set",
       "table.theta.nodes=3", "--set", "table.phi.nodes=3", "--set", "fit.seed=3", "--set",
       "fit.target=rejection", "--set", "fit.gauss_newton.neighbour_sweeps=2"},
      5);
}

TEST(Fit, CommandOfGenerateForASceneReproducesTheEntry) {
  expect_commands_reproduce(
      {"--scene", LTCFIT_SOURCE_DIR "/config/scenes/isotropic-game.toml", "--set",
       "fit.gauss_newton.samples=256", "--set", "fit.gauss_newton.target_samples=256"},
      5);
}

TEST(Fit, StartsFromATable) {
  const TemporaryDirectory folder;
  const std::vector<std::string> small = {
      "--set", "table.alpha.nodes=2", "--set", "table.lambda.nodes=2",
      "--set", "table.theta.nodes=2", "--set", "table.phi.nodes=2"};
  std::vector<std::string> generate = {"generate"},
                           fit = {"fit", "--entry", "1,0,1,1",        "--json",
                                  "-",   "--start", "from=out/ltc.h5"};
  generate.insert(generate.end(), small.begin(), small.end());
  fit.insert(fit.end(), small.begin(), small.end());
  ASSERT_EQ(run_ltcfit(generate, folder.path()).exit_code, 0);
  const ProgramResult result = run_ltcfit(fit, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["start"], "from=out/ltc.h5");
  EXPECT_EQ(json["steps"][0]["phase"], "coarse from table");
  // It starts at a minimum and so ends at one as good; the samples are the same.
  const Table table = read_table(folder / "out/ltc.h5");
  EXPECT_LT(json["loss"]["fit"].get<double>(), 1.01 * table.sw_loss[table.grid.flat({1, 0, 1, 1})]);
}

TEST(Fit, TakesTheConfigOfATable) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit({"generate", "--set", "table.alpha.nodes=2", "--set", "table.lambda.nodes=1",
                        "--set", "table.theta.nodes=2", "--set", "table.phi.nodes=2", "--set",
                        "fit.seed=11"},
                       folder.path())
                .exit_code,
            0);
  const ProgramResult result = run_ltcfit(
      {"fit", "--config", "out/ltc.h5", "--entry", "1,0,1,1", "--json", "-"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out)["seed"], 11);
  folder.write("text.h5", "no table");
  EXPECT_EQ(
      run_ltcfit({"fit", "--config", "text.h5", "--entry", "0,0,0,0"}, folder.path()).exit_code, 2);
}

// ---- Bad input ----

// glTF's mapping: alpha = 0.3^2 across, mix(0.09, 1, 0.5^2) = 0.3175 along x.
TEST(Fit, TakesRoughnessAsEditorsHaveIt) {
  const auto lobe_of = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fit");
    arguments.insert(arguments.end(), {"--theta", "40", "--phi", "10", "--json", "-"});
    const ProgramResult result = run_ltcfit(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["lobe"];
  };
  const auto anisotropic = lobe_of({"--roughness", "0.3", "--anisotropy", "0.5"});
  EXPECT_NEAR(anisotropic["alpha_x"], 0.3175, 1e-15);
  EXPECT_NEAR(anisotropic["alpha_y"], 0.09, 1e-15);
  const auto isotropic = lobe_of({"--roughness", "0.3"});
  EXPECT_EQ(isotropic["alpha_x"], isotropic["alpha_y"]);
}

TEST(FitBadInput, WhichLobe) {
  expect_refused({}, 2, {"no lobe named", "--entry", "--alpha-x"});
  expect_refused({"--entry", "1,1,1,1", "--phi", "3"}, 2, {"not by both"});
  expect_refused({"--alpha-x", "0.1", "--theta", "3"}, 2, {"--phi is missing"});
  expect_refused({"--theta", "3", "--phi", "3"}, 2, {"--roughness, is missing"});
  const auto roughness = [](std::vector<std::string> arguments, const std::string& part) {
    arguments.insert(arguments.end(), {"--theta", "3", "--phi", "3"});
    expect_refused(arguments, 2, {part});
  };
  roughness({"--alpha-x", "0.1"}, "--alpha-x without --alpha-y");
  roughness({"--anisotropy", "0.1"}, "--anisotropy without --roughness");
  roughness({"--alpha-y", "0.1", "--roughness", "0.3"}, "--alpha-y and --roughness: expected ");
  roughness({"--roughness", "1.1"}, "--roughness 1.1: expected a number in [1e-06, 1]");
  roughness({"--roughness", "0.3", "--anisotropy", "nan"}, "a number in [0, 1]");
  for (const char* entry : {"8,0,0,0", "0,0,0,8", "-1,0,0,0", "1,2,3", "1,2,3,4,5", "a", "1,,2,3",
                            "1.5,0,0,0", "99999999999999999999,0,0,0"})
    expect_refused({"--entry", entry}, 2, {entry, "7,7,7,7"});
  expect_refused({"--entry", "2,0,0,0", "--set", "table.alpha.nodes=2"}, 2, {"1,7,7,7"});
}

TEST(FitBadInput, Parameters) {
  const auto refuse = [](const std::string& option, const std::string& value,
                         const std::string& allowed) {
    std::vector<std::string> arguments = lobe;
    *(std::find(arguments.begin(), arguments.end(), option) + 1) = value;
    expect_refused(arguments, 2, {option, allowed});
  };
  for (const char* option : {"--alpha-x", "--alpha-y"})
    for (const char* value : {"0", "-0.1", "1.01", "nan", "inf"})
      refuse(option, value, "[1e-12, 1]");
  for (const char* value : {"-1", "90", "nan"})
    refuse("--theta", value, "[0, 90)");
  for (const char* value : {"-361", "1000", "nan"})
    refuse("--phi", value, "[-360, 360]");
  refuse("--phi", "east", "east");
}

TEST(FitBadInput, HowToFit) {
  const auto refuse = [](std::vector<std::string> more, int exit_code,
                         const std::vector<std::string>& parts) {
    more.insert(more.begin(), {"--entry", "1,1,1,1"});
    expect_refused(more, exit_code, parts);
  };
  refuse({"--solver", "newton"}, 2, {"newton", "gauss-newton", "sgd"});
  refuse({"--seed", "-3"}, 2, {"--seed -3: expected a whole number in [0, 9007199254740992]"});
  refuse({"--seed", "abc"}, 2, {"--seed abc: expected a whole number in [0, 9007199254740992]"});
  refuse({"--samples", "3"}, 2, {"fit.gauss_newton.samples", "3", "[64, 65536]"});
  refuse({"--samples", "3", "--solver", "l3-nelder-mead"}, 2, {"fit.l3.samples", "[16, 65536]"});
  refuse({"--samples", "3", "--solver", "sgd"}, 2, {"fit.sgd.samples", "[16, 1048576]"});
  refuse({"--set", "fit.lobe=bent"}, 2, {"fit.lobe", "bent", "single", "folded"});
  refuse({"--set", "fit.horizon=scaled", "--solver", "sgd"}, 2,
         {"fit.horizon", "sgd", "gauss-newton"});
  refuse({"--set", "fit.lobe=folded", "--solver", "sgd"}, 2,
         {"fit.lobe", "fit.solver = \"sgd\"", "gauss-newton"});
  refuse({"--set", "fit.lobe=folded", "--set", "fit.crease=1", "--set", "fit.second_crease=0.5"}, 2,
         {"fit.second_crease = 0.5", "fit.crease = 1"});
  refuse({"--start", "zero"}, 2, {"zero", "first-order", "from="});
  refuse({"--start", "from=none.h5"}, 3, {"none.h5", "No such file"});
  refuse({"--start", "from=none.txt"}, 2, {"none.txt", ".h5"});
  refuse({"--config", "none.toml"}, 3, {"none.toml"});
  refuse({"--scene", "none.toml"}, 3, {"none.toml"});
  refuse({"--scene", LTCFIT_SOURCE_DIR "/config/scenes/isotropic-game.toml"}, 2,
         {"1,1,1,1", "does not need"});
  refuse({"--scene", "none.toml", "--start", "moments"}, 2, {"--scene"});
}

TEST(FitBadInput, WhereToWrite) {
  expect_refused({"--entry", "1,1,1,1", "--plot", "/proc/none/a.png"}, 3, {"/proc/none"});
  expect_refused({"--entry", "1,1,1,1", "--plot", "a.jpg"}, 2, {"--plot", "a.jpg", ".png"});
  expect_refused({"--entry", "1,1,1,1", "--trace", "/proc/none/a.csv"}, 3, {"/proc/none"});
}

}  // namespace
}  // namespace ltc::test
