// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// shaders/ on the drivers that this machine has, against the library: OpenGL and OpenGL ES, Vulkan
// by GLSL and HLSL, WebGPU, WebGL 2. What is missing is named.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <functional>
#include <numbers>

#include "shaders/cases.h"
#include "support/program.h"
#include "test_paths.h"

namespace ltc::test::shaders {
namespace {

constexpr std::size_t most_faults = 5;

// What one driver answered, and how far off it may be.
class Comparison {
 public:
  Comparison(const std::vector<Case>& cases, const Results& results) : cases_(cases) {
    EXPECT_EQ(results.size(), 4 * outputs * cases.size());
    if (results.size() != 4 * outputs * cases.size())
      return;
    for (std::size_t i = 0; i < cases.size(); ++i)
      results_.push_back(&results[4 * outputs * i]);
  }

  void with(const Tables& tables) {
    // Over alpha_y, which no lobe follows to 0, a node at lambda = 0 is hundreds of times its
    // neighbours, and so is the rounding of its weight.
    of_storage_ = tables.table.storage == Storage::roughness_scaled ? 3 : 1;
    for (std::size_t i = 0; i < results_.size(); ++i)
      compare(i, expected(tables, cases_[i]));
  }

  std::size_t faults = 0;
  std::string text;  // of the first few

 private:
  double at(std::size_t i, int row, int column) const {
    return static_cast<double>(results_[i][4 * row + column]);
  }

  void require(std::size_t i, const char* what, double error, double tolerance) {
    if (error <= tolerance)
      return;
    if (++faults > most_faults)
      return;
    const Case& c = cases_[i];
    text += fmt::format(
        "{} off by {:.2g} (allowed {:.2g}): look-up {}, light {}, alpha {} {}, view {} {} {}\n",
        what, error, tolerance, static_cast<int>(c.look_up), static_cast<int>(c.light), c.alpha_x,
        c.alpha_y, c.view.x(), c.view.y(), c.view.z());
  }

  void compare(std::size_t i, const Expected& e) {
    const Case& c = cases_[i];
    Eigen::Matrix3d m, w;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) {
        m(row, column) = at(i, row, column);
        w(row, column) = at(i, row + 3, column);
      }
    const bool filtered = c.look_up == LookUpKind::filtered ||
                          c.look_up == LookUpKind::stacked_filtered ||
                          c.look_up == LookUpKind::folded_filtered;
    // Texture units have weights of 8 bits and more: the nodes of these tables are some tenths
    // apart. Isotropic ones are 64 to an axis. At the last node of the warp complement-sqrt, whose
    // slope is infinite there, the rounding of theta itself is worth some 1e-4.
    const bool of_nodes = c.look_up != LookUpKind::field && c.look_up != LookUpKind::folded_field;
    const double tolerance = filtered                             ? 5e-3
                             : c.look_up == LookUpKind::isotropic ? 1e-4
                             : of_nodes && c.view.z() < 1e-3      ? 3e-4
                             : of_nodes && c.view.z() < 0.03      ? 3e-5
                                                                  : 1e-5;
    for (int column = 0; column < 3; ++column)
      require(i, "a column of M", (m.col(column) - e.matrix.col(column)).norm(),
              of_storage_ * tolerance * e.matrix.col(column).norm());
    require(i, "amplitude", std::abs(at(i, 0, 3) - e.amplitude), tolerance);
    require(i, "Fresnel term", std::abs(at(i, 1, 3) - e.fresnel), tolerance);
    // W against the M beside it: rows that M's columns are upright on.
    const Eigen::Matrix3d one = w * m;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        require(i, "W M", std::abs(one(row, column) - (row == column)),
                1e-5 * std::max(1.0, w.row(row).norm() * m.col(column).norm()));
    if (filtered || c.look_up == LookUpKind::isotropic)
      return;
    // A density is as large as the lobe is small; a sample is by the driver's own sine; a factor
    // feels what it is the inverse of by its square.
    const double scale = c.light == LightKind::density          ? std::max(1.0, e.share)
                         : c.light == LightKind::direction      ? 10
                         : c.light == LightKind::horizon_factor ? e.share * e.share
                                                                : 1;
    require(i, "a light's share", std::abs(at(i, 2, 3) - e.share), 1e-4 * scale);
    const bool folded = is_folded(c.look_up);
    for (int axis = 0; axis < 3; ++axis)
      require(i, folded ? "k, g or h" : "a picture's place or level",
              std::abs(at(i, 3 + axis, 3) - e.seen(axis)),
              folded ? tolerance * std::max(1.0, std::abs(e.seen(axis)))
              // Weights of 8 bits between texels, and between levels.
              : axis < 2 ? 2e-3
                         : 5e-3);
  }

  const std::vector<Case>& cases_;
  std::vector<const float*> results_;
  double of_storage_ = 1;
};

struct Driver {
  const char* name;
  std::string Job::*source;
  std::function<Results(const Job&)> run;
};
void PrintTo(const Driver& driver, std::ostream* out) {
  *out << driver.name;
}
const std::array<Driver, 6> drivers = {
    {{"OpenGL", &Job::glsl, [](const Job& job) { return run_gl(job, GlApi::gl); }},
     {"OpenGLES", &Job::glsl, [](const Job& job) { return run_gl(job, GlApi::es); }},
     {"VulkanByGLSL", &Job::glsl,
      [](const Job& job) { return run_vulkan(job, VulkanSource::glsl); }},
     {"VulkanByHLSL", &Job::hlsl,
      [](const Job& job) { return run_vulkan(job, VulkanSource::hlsl); }},
     {"WebGPU", &Job::wgsl, run_webgpu},
     {"WebGL2", &Job::glsl, run_webgl}}};

// Warped axes and the storage that takes the most steps.
Grid warped_grid() {
  Grid grid = Grid::paper({5, 4, 5, 4});
  grid.alpha = Axis::make(0, 1, 5, Warp::sqrt);
  grid.theta = Axis::make(0, steepest_theta, 5, Warp::complement_sqrt);
  return grid;
}

class Shaders : public ::testing::TestWithParam<Driver> {
 protected:
  // Skips where the machine lacks the driver.
  void compare(const Job& job, const Tables& tables, const std::vector<Case>& cases) {
    Results results;
    try {
      results = GetParam().run(job);
    } catch (const Missing& missing) {
      GTEST_SKIP() << GetParam().name << ": " << missing.what();
    }
    Comparison comparison(cases, results);
    comparison.with(tables);
    faults = comparison.faults;
    text = comparison.text;
    ran = true;
  }

  bool ran = false;
  std::size_t faults = 0;
  std::string text;
};

TEST_P(Shaders, AgreeWithTheLibrary) {
  const Tables tables = make_tables(warped_grid(), Storage::mirror_frame);
  const std::vector<Case> cases = make_cases(20'000, 1);
  compare(make_job(tables, cases), tables, cases);
  EXPECT_EQ(faults, 0u) << text;
}

// A number that is 2 % off: one of each file on OpenGL ES, two on every other driver.
TEST_P(Shaders, APlantedErrorIsNoticed) {
  const Tables tables = make_tables(warped_grid(), Storage::mirror_frame);
  const std::vector<Case> cases = make_cases(800, 2);
  const Job sound = make_job(tables, cases);
  std::vector<std::string> all = {"dot(lobe.w2, p)", "folded.k * unfolding"};
  if (GetParam().name == std::string("OpenGLES"))
    all = {"dot(lobe.w2, p)",
           "0.5 / LTC_PI * normal.z",
           "1.0 - ltc_below_horizon(lobe)",
           "1.0 - ltc_below_horizon_folded(folded)",
           "1.0 / (1.0 + v.z)",
           "1.0 - sqrt(1.0 - x)",
           "radius / LTC_PI * sum",
           "-mu * slope",
           "0.75 * place",
           "folded.k * unfolding",
           "ltc_angle(abs(horizon.y), horizon.x)",
           "0.5 * side",
           "1.0057411",
           "alpha * alpha * f_kappa",
           "scale.x * scale.x * fold.x"};
  for (const std::string& planted : all) {
    Job job = sound;
    std::string& source = job.*GetParam().source;
    const std::size_t place = source.find(planted);
    ASSERT_NE(place, std::string::npos) << planted;
    source.replace(place, planted.size(), "1.02 * (" + planted + ")");
    compare(job, tables, cases);
    if (!ran)
      return;
    EXPECT_GT(faults, 0u) << planted;
  }
}

INSTANTIATE_TEST_SUITE_P(On, Shaders, ::testing::ValuesIn(drivers),
                         [](const auto& tested) { return tested.param.name; });

// On one driver: folded along x = 0, and where creases are far out.
TEST(ShaderFolds, OfOtherCreasesAgree) {
  std::vector<Case> cases = make_cases(3'000, 4);
  for (Case& one : cases)
    one.look_up = LookUpKind::folded_field;
  for (const double crease : {0.0, 1.5}) {
    SCOPED_TRACE(crease);
    const Tables tables = make_tables(Grid::paper(2), Storage::matrix, {crease});
    Results results;
    try {
      results = run_gl(make_job(tables, cases), GlApi::es);
    } catch (const Missing& missing) {
      GTEST_SKIP() << missing.what();
    }
    Comparison comparison(cases, results);
    comparison.with(tables);
    EXPECT_EQ(comparison.faults, 0u) << comparison.text;
  }
}

// On one driver, for all storages and axes.
TEST(ShaderTables, OfAllStoragesAgree) {
  Grid isotropic;
  isotropic.alpha = Axis::make(0, 1, 6, Warp::sqrt);
  isotropic.lambda = Axis::make(1, 1, 1, Warp::linear);
  isotropic.theta = Axis::make(0, std::numbers::pi / 2, 6, Warp::half_sine);
  isotropic.phi = Axis::make(0, 0, 1, Warp::linear);
  std::vector<Case> cases = make_cases(4'000, 3);
  for (const auto& [grid, storage] : {std::pair(Grid::paper(4), Storage::matrix),
                                      {warped_grid(), Storage::roughness_scaled},
                                      {isotropic, Storage::inverse},
                                      {isotropic, Storage::mirror_frame}}) {
    SCOPED_TRACE(name_of(storage));
    if (is_isotropic(grid))
      for (Case& one : cases)
        one.alpha_y = one.alpha_x;
    const Tables tables = make_tables(grid, storage);
    Results results;
    try {
      results = run_gl(make_job(tables, cases), GlApi::es);
    } catch (const Missing& missing) {
      GTEST_SKIP() << missing.what();
    }
    Comparison comparison(cases, results);
    comparison.with(tables);
    EXPECT_EQ(comparison.faults, 0u) << comparison.text;
  }
}

TEST(ShaderFiles, AreWhatTheirSourceGives) {
  const ProgramResult result =
      run_program({"/usr/bin/python3", LTCFIT_SOURCE_DIR "/scripts/translate-shaders", "--check"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace ltc::test::shaders
