// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit stress, through the real program.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.h"

namespace ltc::test {
namespace {

using Json = nlohmann::json;

// The words of a command as a shell would split them; nothing in them is quoted.
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

// Starves the solver: bars are missed, the files are written all the same, and the worst fit's
// command gives the fit again.
TEST(StressCommand, AMissedBarIsNamedAndReproducible) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(
      {"stress", "--quick", "--fits", "170", "--set", "fit.gauss_newton.coarse_steps=0", "--set",
       "fit.gauss_newton.steps=1", "--json", "stress.json", "--csv", "stress.csv", "--map", "maps"},
      folder.path());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("ltcfit: gauss-newton: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("starts"), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("MISSED: "), std::string::npos) << result.out;
  EXPECT_EQ(names_in(folder / "maps"),
            (std::vector<std::string>{"stress-gauss-newton-loss.png",
                                      "stress-gauss-newton-success.png"}));
  const Json solver = Json::parse(read_file(folder / "stress.json"))["solvers"][0];
  EXPECT_EQ(solver["fits"], 170);
  EXPECT_FALSE(solver["missed_bars"].empty());
  const std::string csv = read_file(folder / "stress.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 171);

  const Json worst = solver["worst"][0];
  std::vector<std::string> command = words_of(worst["command"]);
  ASSERT_GT(command.size(), 2u);
  EXPECT_EQ(command[0], "ltcfit");
  command.erase(command.begin());
  command.insert(command.end(), {"--json", "-"});
  const ProgramResult again = run_ltcfit(command, folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const Json rows = Json::parse(again.out)["matrix"]["fitted"];
  Eigen::Matrix3d fitted;
  for (int entry = 0; entry < 9; ++entry)
    fitted(entry / 3, entry % 3) = rows[entry / 3][entry % 3];
  // Entries that symmetry fixes are rounded to it, which moves the last digits.
  EXPECT_NEAR(fitted.determinant() / worst["determinant"].get<double>(), 1, 1e-12);
}

TEST(StressCommand, OtherSolversAreShownWithoutABar) {
  const ProgramResult result = run_ltcfit({"stress", "--quick", "--fits", "17", "--solver",
                                           "l3-nelder-mead", "--set", "fit.l3.evaluations=20"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("no bar"), std::string::npos) << result.out;
}

TEST(StressCommand, FoldsAreMeasuredAgainstTheLtc) {
  const ProgramResult result =
      run_ltcfit({"stress", "--quick", "--fits", "170", "--set", "fit.lobe=folded"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("does not fold"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("all bars reached"), std::string::npos) << result.out;
}

TEST(StressCommand, RefusesWhatItDoesNotTake) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"stress", "--solver", "newton"},
        {"stress", "--solver", "sgd", "--set", "fit.lobe=folded"},
        {"stress", "--fits", "0"},
        {"stress", "--fits", "many"},
        {"stress", "--seed", "-1"},
        {"stress", "--threads", "0"},
        {"stress", "--unknown"}}) {
    const ProgramResult result = run_ltcfit(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments.back();
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
}  // namespace ltc::test
