// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Arrays without axes through the real program: both published layouts, told apart or named.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "export/table_file.h"
#include "support/reference.h"
#include "support/refused_run.h"
#include "table/lookup.h"
#include "table/synthetic.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* told = "read with axes alpha_x, alpha_y, theta, phi";

// Tables of first-order matrices in either layout, as arrays.
struct Arrays {
  Arrays() {
    write_table(testing::synthetic_table(Grid::paper(4), Storage::matrix), folder / "ratio.npy");
    Grid grid = Grid::paper(4);
    grid.layout = Layout::alphax_alphay;
    Table both = testing::synthetic_table(grid, Storage::matrix);
    both.grid.layout = Layout::alpha_lambda;  // the array says nothing of it
    write_table(both, folder / "both.npy");
  }
  ProgramResult entry(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"fit", "--as-in", file, "--entry", "1,2,1,1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_ltcfit(arguments, folder.path());
  }
  TemporaryDirectory folder;
};

TEST(LayoutOfArrays, IsToldBySymmetryAndSaid) {
  const Arrays arrays;
  const ProgramResult both = arrays.entry("both.npy"), ratio = arrays.entry("ratio.npy");
  EXPECT_NE(both.err.find(std::string("both.npy: ") + told), std::string::npos) << both.err;
  EXPECT_NE(both.out.find("1,2,1,1: alpha_x 0.333, alpha_y 0.667, "), std::string::npos)
      << both.out;
  EXPECT_EQ(ratio.err, "");
  EXPECT_NE(ratio.out.find("1,2,1,1: alpha 0.333, lambda 0.667, "), std::string::npos) << ratio.out;
}

TEST(LayoutOfArrays, NamesTheColumnsOfDiff) {
  const Arrays arrays;
  const auto first_line = [&](const char* layout) {
    const ProgramResult result =
        run_ltcfit({"diff", "both.npy", "both.npy", "--layout", layout, "--samples", "64",
                    "--directions", "1", "--queries", "0", "--csv", "all.csv"},
                   arrays.folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string text = read_file(arrays.folder / "all.csv");
    return text.substr(0, text.find('\n'));
  };
  EXPECT_TRUE(
      first_line("alphax-alphay").starts_with("alpha_x_node,alpha_y_node,theta,phi,loss_a,"));
  EXPECT_TRUE(first_line("alpha-lambda").starts_with("alpha,lambda,theta,phi,loss_a,"));
}

TEST(LayoutOfArrays, IsToldOfStartsAndReferencesToo) {
  const Arrays arrays;
  const std::vector<std::string> start{"fit",     "--alpha-x", "0.3",   "--alpha-y", "0.2",
                                       "--theta", "40",        "--phi", "30",        "--start"};
  const auto fit = [&](std::vector<std::string> more) {
    more.insert(more.begin(), start.begin(), start.end());
    return run_ltcfit(more, arrays.folder.path());
  };
  EXPECT_NE(fit({"from=both.npy"}).err.find(std::string("both.npy: ") + told), std::string::npos);
  EXPECT_EQ(fit({"from=both.npy", "--layout", "alpha-lambda"}).err, "");
  EXPECT_EQ(fit({"from=ratio.npy"}).err, "");
  const ProgramResult none = fit({"identity", "--layout", "alpha-lambda"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("--layout needs a table"), std::string::npos) << none.err;
  // Its nodes are not those of any grid that bench fits.
  std::vector<std::string> bench{"bench", "--entries", "1", "--settings", "default"};
  for (const char* axis : {"alpha", "lambda", "theta", "phi"}) {
    bench.push_back("--set");
    bench.push_back(std::string("table.") + axis + ".nodes=4");
  }
  bench.insert(bench.end(), {"--reference", "both.npy"});
  const ProgramResult refused = run_ltcfit(bench, arrays.folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find(told), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("alphax-alphay"), std::string::npos) << refused.err;
  bench.insert(bench.end(), {"--layout", "alpha-lambda"});
  EXPECT_EQ(run_ltcfit(bench, arrays.folder.path()).exit_code, 0);
}

TEST(LayoutOfArrays, IsWhatTheOptionSays) {
  const Arrays arrays;
  const ProgramResult both = arrays.entry("both.npy", {"--layout", "alpha-lambda"});
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_EQ(both.err, "");
  EXPECT_NE(both.out.find("alpha 0.333, lambda 0.667"), std::string::npos) << both.out;
  const ProgramResult ratio = arrays.entry("ratio.npy", {"--layout", "alphax-alphay"});
  EXPECT_EQ(ratio.err, "");
  EXPECT_NE(ratio.out.find("alpha_x 0.333, alpha_y 0.667"), std::string::npos) << ratio.out;
  for (const char* command : {"validate", "render"})
    expect_refused({command, "t.npy", "--layout", "both"}, 2,
                   {"--layout", "both", "alpha-lambda, alphax-alphay, ltc"});
  expect_refused({"diff", "a.npy", "b.npy", "--layout", ""}, 2, {"--layout"});
}

TEST(LayoutOfArrays, ALookUpTakesBothRoughnesses) {
  const Arrays arrays;
  const ProgramResult result =
      run_ltcfit({"fit", "--as-in", "both.npy", "--alpha-x", "0.2", "--alpha-y", "0.6", "--theta",
                  "30", "--phi", "20", "--json", "-"},
                 arrays.folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json report = Json::parse(result.out);
  const Eigen::Matrix3d expected =
      look_up(read_table(arrays.folder / "both.npy"),
              {0.2, 0.6, 30 * std::numbers::pi / 180, 20 * std::numbers::pi / 180})
          .matrix;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(report["matrix"]["final"][row][column].get<double>(),
                  expected(static_cast<int>(row), static_cast<int>(column)), 1e-12);
  EXPECT_EQ(report["within_axes"], true);
  double weights = 0;
  for (const Json& node : report["nodes"])
    weights += node["weight"].get<double>();
  EXPECT_NEAR(weights, 1, 1e-12);
}

// Every entry of the other published table is a fit of the lobe that its axes name; read in the
// ratio it would be another one's.
TEST(LayoutOfArrays, TheOtherPublishedTableFitsTheLobesOfItsAxes) {
  const fs::path file = reference_file("alphax_alphay_theta_phi.npy");
  if (!fs::exists(file))
    GTEST_SKIP() << "no " << file << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const auto loss = [&](const char* layout) {
    const ProgramResult result = run_ltcfit(
        {"fit", "--as-in", file.string(), "--entry", "3,5,2,3", "--json", "-", "--layout", layout});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Json::parse(result.out)["loss"]["relative"].get<double>();
  };
  EXPECT_LT(loss("alphax-alphay"), 0.05);
  EXPECT_GT(loss("alpha-lambda"), 0.15);
}

}  // namespace
}  // namespace ltc::test
