// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/fit_one.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "fit/lobes.h"
#include "pipeline/generate.h"
#include "support/refusal.h"

namespace ltc {
namespace {

// Little work, and neighbours that still differ: what is tested is which bits come out.
Config small_config(const std::array<std::size_t, 4>& shape, int sweeps) {
  Config config;
  config.grid = Grid::paper(shape);
  config.fit.gauss_newton.samples = 128;
  config.fit.gauss_newton.directions = 8;
  config.fit.gauss_newton.target_samples = 256;
  config.fit.gauss_newton.coarse_samples = 64;
  config.fit.gauss_newton.coarse_directions = 4;
  config.fit.gauss_newton.coarse_steps = 2;
  config.fit.gauss_newton.steps = 2;
  config.fit.gauss_newton.starts = 1;
  config.fit.gauss_newton.neighbour_sweeps = sweeps;
  config.refine.steps = 0;  // an entry by itself is the fitted one
  return config;
}

template <typename Value>
bool same_bits(Value a, Value b) {
  return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

// Everything that a table holds of an entry.
void expect_same_entry(const Table& table, std::size_t flat, const LobeFit& fit) {
  SCOPED_TRACE("entry " + std::to_string(flat));
  const Eigen::Matrix3d stored = table.stored_at(flat);
  for (int i = 0; i < 9; ++i)
    EXPECT_TRUE(same_bits(stored(i), fit.finished.stored(i))) << i;
  EXPECT_TRUE(same_bits(table.sw_loss[flat], static_cast<float>(fit.fitted.loss)));
  EXPECT_TRUE(same_bits(table.amplitude[flat], static_cast<float>(fit.albedo.amplitude)));
  EXPECT_TRUE(same_bits(table.fresnel[flat], static_cast<float>(fit.albedo.fresnel)));
  EXPECT_EQ(table.status[flat], fit.fitted.status);
  EXPECT_EQ(static_cast<int>(table.iterations[flat]), fit.fitted.steps);
}

TEST(FitOne, EntriesOfASmallTableBitForBit) {
  for (const auto& [sweeps, target] :
       {std::pair{0, TargetKind::weighted}, std::pair{1, TargetKind::rejection},
        std::pair{3, TargetKind::weighted}}) {
    Config config = small_config({3, 4, 3, 3}, sweeps);
    config.fit.target = target;
    config.storage = Storage::mirror_frame;
    const Table table = generate_table(config, {2});
    const std::vector<bool> all(config.grid.size(), true);
    // Of the 108 entries every fifth, in turn of all indices.
    for (std::size_t flat = 0; flat < config.grid.size(); flat += 5)
      expect_same_entry(table, flat, fit_table_entry(config, all, flat, {1}));
  }
}

TEST(FitOne, SampledEntriesOfThePapersGridBitForBit) {
  const Config config = small_config({8, 8, 8, 8}, 2);
  const Table table = generate_table(config, {2});
  const std::vector<bool> all(config.grid.size(), true);
  std::size_t copies = 0;
  // 131 shares no factor with 4096: the sample meets all indices of every axis.
  for (std::size_t i = 0; i < 24; ++i) {
    const std::size_t flat = 131 * i * 3 % config.grid.size();
    expect_same_entry(table, flat, fit_table_entry(config, all, flat, {1}));
    copies += table.status[flat] == Status::copied;
  }
  EXPECT_GE(copies, 3u);
}

TEST(FitOne, EntriesOfAPartialTableBitForBit) {
  const Config config = small_config({4, 4, 3, 4}, 2);
  // Holes, so that representatives and neighbours are others than in the whole table.
  std::vector<bool> needed(config.grid.size());
  for (std::size_t flat = 0; flat < needed.size(); ++flat)
    needed[flat] = flat % 5 != 0 && flat % 7 != 2;
  const Table table = generate_table(config, needed, {2}, nullptr);
  for (std::size_t flat = 1; flat < needed.size(); flat += 11)
    if (needed[flat])
      expect_same_entry(table, flat, fit_table_entry(config, needed, flat, {1}));
    else
      test::expect_one_line(
          test::message_of<InputError>([&] { fit_table_entry(config, needed, flat, {1}); }),
          {"not among"});
}

// Without the neighbourhood the bits differ somewhere: the tests above can fail.
TEST(FitOne, SweepsMatter) {
  const Config config = small_config({3, 4, 3, 3}, 1);
  const Table table = generate_table(config, {2});
  std::size_t different = 0;
  for (std::size_t flat = 0; flat < config.grid.size(); flat += 5) {
    std::vector<bool> alone(config.grid.size());
    alone[flat] = true;
    different += fit_table_entry(config, alone, flat, {1}).finished.stored != table.stored_at(flat);
  }
  EXPECT_GT(different, 2u);
}

TEST(FitOne, FitsNoMoreThanTheNeighbourhood) {
  const Grid grid = Grid::paper();
  const std::vector<bool> all(grid.size(), true);
  const std::size_t inner = grid.flat({3, 3, 3, 3});
  const auto count = [&](std::size_t flat, int sweeps) {
    const std::vector<bool> behind = entries_behind(grid, all, flat, sweeps);
    return std::count(behind.begin(), behind.end(), true);
  };
  EXPECT_EQ(count(inner, 0), 1);
  EXPECT_EQ(count(inner, 1), 9);
  // Points of Z^4 at distance 2 at most.
  EXPECT_EQ(count(inner, 2), 41);
  // A copy and its representative.
  EXPECT_EQ(count(grid.flat({3, 7, 4, 5}), 0), 2);
}

TEST(FitOne, WatchesEveryFit) {
  Config config = small_config({8, 8, 8, 8}, 2);
  const LobeFit fit = fit_table_entry(config, std::vector<bool>(config.grid.size(), true),
                                      config.grid.flat({3, 3, 3, 3}), {1});
  ASSERT_EQ(fit.fits.size(), 3u);
  EXPECT_FALSE(fit.fits.front().steps.empty());
  for (int sweep = 0; sweep < 3; ++sweep) {
    EXPECT_EQ(fit.fits[static_cast<std::size_t>(sweep)].sweep, sweep);
    EXPECT_EQ(fit.fits[static_cast<std::size_t>(sweep)].neighbours, sweep == 0 ? 0u : 8u);
  }
}

TEST(FitOne, LobeByItself) {
  const Lobe lobe{0.5, 0.2, 0.9, 0.4};
  const Config config;
  const LobeFit own = fit_lobe(config, lobe, 1, std::nullopt);
  EXPECT_EQ(own.fitted.status, Status::fitted);
  EXPECT_NEAR(own.matrix.col(2).norm(), 1, 1e-6);  // rounded to floats
  EXPECT_GT(own.matrix.determinant(), 0);
  // 16,384 samples against the fit's 2,048: both within some per cent of the lobe's own distance.
  EXPECT_LT(own.held_out_loss, 1.2 * own.fitted.loss);
  for (const StartKind kind :
       {StartKind::first_order, StartKind::moments, StartKind::identity, StartKind::random}) {
    const LobeFit from = fit_lobe(config, lobe, 1, starting_matrix(kind, lobe, 1));
    ASSERT_FALSE(from.fits.front().steps.empty());
    // An ordinary lobe has one minimum worth the name; descents end within a few per cent of it.
    EXPECT_NEAR(from.fitted.loss / own.fitted.loss, 1, 0.05) << static_cast<int>(kind);
  }
}

TEST(FitOne, GradientChecksPassAfterTheFit) {
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFit fit = fit_lobe(Config(), lobe, 1, std::nullopt);
    const GradientCheck check = check_lobe_gradient(lobe, fit.matrix);
    EXPECT_TRUE(check.passed) << test::describe(lobe) << ": " << check.describe();
  }
}

TEST(FitOne, GradientCheckFailsWithoutAMatrix) {
  const Eigen::Matrix3d none = Eigen::Matrix3d::Constant(std::nan(""));
  EXPECT_FALSE(check_lobe_gradient({0.5, 0.2, 0.9, 0.4}, none).passed);
}

}  // namespace
}  // namespace ltc
