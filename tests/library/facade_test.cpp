// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The public header: what it gives is what the parts behind it give.
#include "ltcfit/ltcfit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/fit_one.h"
#include "pipeline/generate.h"
#include "support/temporary_directory.h"
#include "table/lookup.h"

namespace ltcfit {
namespace {

const Config small{.file = {},
                   .overrides = {"table.alpha.nodes=2", "table.lambda.nodes=2",
                                 "table.theta.nodes=3", "table.phi.nodes=2", "refine.steps=0"}};

TEST(Facade, FitsALobeAsThePipelineDoes) {
  const FittedLobe fitted = fit({0.4, 0.1, 1.0, 0.5});
  const ltc::Config config;
  const ltc::LobeFit expected =
      ltc::fit_lobe(config, {0.4, 0.1, 1.0, 0.5}, config.fit.seed, std::nullopt);
  EXPECT_EQ(fitted.shading.matrix, expected.matrix);
  EXPECT_EQ(fitted.shading.amplitude, expected.albedo.amplitude);
  EXPECT_EQ(fitted.shading.fresnel, expected.albedo.fresnel);
  EXPECT_EQ(fitted.loss, expected.held_out_loss);
  EXPECT_EQ(fitted.spread, expected.spread);
}

TEST(Facade, RefusesALobeOutOfRange) {
  for (const Lobe& lobe : {Lobe{0, 0.1, 1, 0}, Lobe{0.1, 1.5, 1, 0}, Lobe{0.1, 0.1, 1.6, 0},
                           Lobe{0.1, 0.1, -0.1, 0}, Lobe{0.1, 0.1, 1, INFINITY}})
    EXPECT_THROW(fit(lobe), InputError);
}

TEST(Facade, MakesWritesReadsAndLooksUpATable) {
  const Table made = generate(small);
  const ltc::Table expected =
      ltc::generate_table(ltc::load_config(std::nullopt, small.overrides), {1});
  const ltc::test::TemporaryDirectory folder;
  for (const char* name : {"t.h5", "t.npy", "t.0.exr"}) {
    SCOPED_TRACE(name);
    made.write(folder / name);
    const Table table = Table::read(folder / name);
    EXPECT_EQ(table.shape(), (std::array<std::size_t, 4>{2, 2, 3, 2}));
    EXPECT_EQ(table.axis(2), expected.grid.theta.nodes);
    EXPECT_TRUE(std::ranges::equal(table.stored(), expected.stored));
    EXPECT_EQ(table.matrix({1, 0, 2, 1}), expected.matrix_at(expected.grid.flat({1, 0, 2, 1})));
    const ltc::Lobe lobe{0.3, 0.6, 0.7, 4.0};
    EXPECT_EQ(table.look_up({0.3, 0.6, 0.7, 4.0}).matrix, ltc::look_up(expected, lobe).matrix);
  }
  EXPECT_THROW(made.write(folder / "t.png"), InputError);
  EXPECT_THROW(made.matrix({2, 0, 0, 0}), InputError);
  EXPECT_THROW(made.axis(4), InputError);
  EXPECT_THROW(Table::read(folder / "none.h5"), IoError);
}

TEST(Facade, ValidatesATableAndNoticesADamagedOne) {
  const Table table = generate(small);
  const Validation sound = validate(table, {}, false);
  EXPECT_TRUE(sound.passed());
  EXPECT_FALSE(sound.quality);
  // No table can be held to this: the quadrature of the check is another than the table's.
  const Validation held =
      validate(table, {.file = {}, .overrides = {"invariants.albedo_error=0"}}, false);
  EXPECT_FALSE(held.passed());
  EXPECT_EQ(std::ranges::count(held.checks, false, &Check::passed), 1);
}

TEST(Facade, AWatcherSeesStagesAndStopsTheWork) {
  std::vector<std::string> stages;
  const ltcfit::Run stopping{.threads = 1,
                             .progress = [&](std::string_view stage, std::size_t, std::size_t) {
                               stages.emplace_back(stage);
                               return stage != "fit";
                             }};
  // Long enough that a watcher is asked: the descent of the paper takes minutes.
  const Config slow{.file = {}, .overrides = {"fit.solver=sgd", "table.alpha.nodes=2"}};
  EXPECT_THROW(generate(slow, stopping), Interrupted);
  EXPECT_FALSE(stages.empty());
  const ltcfit::Run throwing{.threads = 1, .progress = [](auto...) -> bool { throw 7; }};
  EXPECT_THROW(generate(slow, throwing), int);
  EXPECT_THROW(generate(small, {.threads = -1, .progress = {}}), InputError);
}

}  // namespace
}  // namespace ltcfit
