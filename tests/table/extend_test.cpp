// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/extend.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <set>

#include "brdf/separable_ggx.h"
#include "config/config.h"
#include "core/error.h"
#include "export/same_tables.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

using test::message_of;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// The synthetic table with the entries that are not in `kept` skipped.
Table part_of(const Table& table, const std::vector<bool>& kept) {
  Table part = table;
  for (std::size_t flat = 0; flat < kept.size(); ++flat) {
    if (kept[flat])
      continue;
    part.set_stored(flat, Eigen::Matrix3d::Constant(nan));
    part.amplitude[flat] = part.fresnel[flat] = part.sw_loss[flat] = nan;
    part.status[flat] = Status::skipped;
    part.iterations[flat] = 0;
  }
  return part;
}

std::vector<bool> random_flags(std::size_t count, std::mt19937& random) {
  std::vector<bool> flags(count);
  for (std::size_t i = 0; i < count; ++i)
    flags[i] = random() % 2;
  return flags;
}

bool same_entry(const Table& a, const Table& b, std::size_t flat) {
  const auto same = [flat](const auto& x, const auto& y, std::size_t values) {
    return std::memcmp(x.data() + values * flat, y.data() + values * flat, values * sizeof(x[0])) ==
           0;
  };
  return same(a.stored, b.stored, 9) && same(a.amplitude, b.amplitude, 1) &&
         same(a.fresnel, b.fresnel, 1) && same(a.sw_loss, b.sw_loss, 1) &&
         same(a.status, b.status, 1) && same(a.iterations, b.iterations, 1);
}

TEST(Extend, KeepsWhatThereIsAndAddsTheRest) {
  std::mt19937 random(20260106);
  const Grid grid = testing::uneven_grid();
  const Table whole = testing::synthetic_table(grid, Storage::mirror_frame);
  Table other = whole;  // other values everywhere
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    other.set_stored(flat, 2 * whole.stored_at(flat));
    for (auto* values : {&other.amplitude, &other.fresnel, &other.sw_loss})
      (*values)[flat] += 1;
    other.iterations[flat] += 1;
  }
  for (int trial = 0; trial < 20; ++trial) {
    const auto has = random_flags(grid.size(), random), gets = random_flags(grid.size(), random);
    const Table existing = part_of(whole, has), additions = part_of(other, gets);
    const Table result = extended(existing, additions);
    for (std::size_t flat = 0; flat < grid.size(); ++flat)
      EXPECT_TRUE(same_entry(result, has[flat] ? existing : additions, flat)) << flat;
    EXPECT_EQ(result.grid, grid);
    EXPECT_EQ(result.storage, Storage::mirror_frame);
  }
}

TEST(Extend, EntriesThatFailedStay) {
  const Grid grid = Grid::paper(2);
  const Table whole = testing::synthetic_table(grid, Storage::matrix);
  Table existing = part_of(whole, std::vector<bool>(grid.size(), false));
  existing.status[3] = Status::failed;
  existing.iterations[3] = 17;
  std::vector<bool> needed(grid.size(), false);
  needed[3] = needed[4] = true;
  const auto lacking = lacking_entries(existing, needed);
  for (std::size_t flat = 0; flat < grid.size(); ++flat)
    EXPECT_EQ(lacking[flat], flat == 4);
  EXPECT_TRUE(same_entry(extended(existing, whole), existing, 3));
  EXPECT_TRUE(same_entry(extended(existing, whole), whole, 4));
}

TEST(Extend, NothingToAddChangesNothing) {
  const Grid grid = Grid::paper(2);
  const Table existing = testing::synthetic_table(grid, Storage::matrix);
  Table additions = part_of(existing, std::vector<bool>(grid.size(), false));
  additions.created = "later";
  testing::expect_same_tables(extended(existing, additions), existing);
}

TEST(Extend, IsRefinedWhereEitherPartIs) {
  const Table whole = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  const auto of = [&](std::size_t entry, std::optional<bool> refined) {
    std::vector<bool> flags(whole.grid.size());
    flags[entry] = true;
    Table table = part_of(whole, flags);
    table.refined = refined;
    return table;
  };
  const auto extended_by = [&](std::optional<bool> existing, std::optional<bool> added) {
    return extended(of(0, existing), of(1, added)).refined;
  };
  EXPECT_EQ(extended_by(false, false), false);
  EXPECT_EQ(extended_by(false, true), true);
  EXPECT_EQ(extended_by(true, std::nullopt), true);
  EXPECT_EQ(extended_by(std::nullopt, false), std::nullopt);
}

TEST(Extend, TellsOfBothRuns) {
  const Grid grid = Grid::paper(2);
  const Table whole = testing::synthetic_table(grid, Storage::matrix);
  const auto part = [&](std::set<std::size_t> kept, const std::string& config,
                        const std::string& created) {
    std::vector<bool> flags(grid.size());
    for (const std::size_t flat : kept)
      flags[flat] = true;
    Table table = part_of(whole, flags);
    table.config = config;
    table.created = created;
    return table;
  };
  const test::TemporaryDirectory folder;
  const std::string one = to_toml(Config{});
  Config changed;
  changed.fit.seed = 7;
  const std::string two = to_toml(changed);
  const Table first = part({0}, one, "2026-01-01T00:00:00Z");
  Table again = part({1}, two, "2026-01-02T00:00:00Z");
  again.seed = 7;
  again.generator = "ltcfit later";
  const Table second = extended(first, again);
  EXPECT_EQ(second.seed, 7u);
  EXPECT_EQ(second.generator, "ltcfit later");
  EXPECT_EQ(second.created, "2026-01-02T00:00:00Z");
  EXPECT_TRUE(second.config.starts_with(two));
  EXPECT_NE(second.config.find("# Extends a table of 2026-01-01T00:00:00Z by ltcfit test"),
            std::string::npos);
  EXPECT_NE(second.config.find("\n# [fit]\n"), std::string::npos);
  // It still reads as the config of the run that made the file.
  EXPECT_EQ(to_toml(load_config(folder.write("c.toml", second.config), {})), two);

  // Of the same config a line suffices, and the history before stays.
  const Table third = extended(second, part({2}, two, "2026-01-03T00:00:00Z"));
  EXPECT_EQ(to_toml(load_config(folder.write("c.toml", third.config), {})), two);
  EXPECT_LT(third.config.size(), second.config.size() + 200);
  EXPECT_NE(third.config.find("of 2026-01-01T"), std::string::npos);
  EXPECT_NE(third.config.find("of 2026-01-02T"), std::string::npos);
}

void expect_refused(const Table& existing, const Grid& grid, Storage storage,
                    const std::vector<std::string>& parts) {
  const std::string message =
      message_of<InputError>([&] { require_extendable(existing, "out/ltc.h5", grid, storage); });
  test::expect_one_line(message, parts);
  test::expect_one_line(message, {"out/ltc.h5: cannot be extended"});
}

TEST(Extend, OnlyTablesOfTheSameKindGoTogether) {
  const Grid grid = testing::uneven_grid();
  const Table table = Table::empty(grid, Storage::matrix);
  EXPECT_NO_THROW(require_extendable(table, "t.h5", grid, Storage::matrix));
  Grid of_another = grid;
  of_another.model = &test::separable_ggx();
  expect_refused(table, of_another, Storage::matrix,
                 {"its BRDF is \"ggx\"; expected \"separable-ggx\""});
  expect_refused(table, grid, Storage::mirror_frame,
                 {"its storage is \"matrix\"; expected \"mirror-frame\""});
  const auto with = [&](auto change) {
    Grid other = grid;
    change(other);
    return other;
  };
  const auto expect_grid_refused = [&](const Grid& other, const std::vector<std::string>& parts) {
    expect_refused(table, other, Storage::matrix, parts);
    EXPECT_THROW(extended(table, Table::empty(other, Storage::matrix)), InputError);
  };
  expect_grid_refused(with([](Grid& g) { g.alpha = Axis::make(0.1, 1, 4, Warp::sqrt); }),
                      {"alpha axis is 3 nodes from 0.1 to 1, sqrt; expected 4 nodes"});
  expect_grid_refused(with([](Grid& g) { g.lambda = Axis::make(0.3, 1, 2, Warp::linear); }),
                      {"lambda axis is 2 nodes from 0.2 to 1, linear; expected 2 nodes from 0.3"});
  expect_grid_refused(with([](Grid& g) { g.theta = Axis::make(0, 1.5, 5, Warp::linear); }),
                      {"theta axis (in degrees)", "complement-sqrt; expected", "linear"});
  expect_grid_refused(
      with([](Grid& g) { g.phi.nodes[1] += 1e-3; }),
      {"phi axis (in degrees)", "from 0 to 90, linear;", "linear but for its nodes"});
  expect_grid_refused(with([](Grid& g) { g.alpha_min = 1e-4; }),
                      {"alpha_min is 0.0002; expected 0.0001"});
}

}  // namespace
}  // namespace ltc
