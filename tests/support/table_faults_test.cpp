// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The check of whole tables finds every fault that it is there to find.
#include "support/table_faults.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "postprocess/symmetry.h"
#include "table/synthetic.h"

namespace ltc::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// First-order matrices have all that is asked for but exact zeros.
Table good_table(Storage storage) {
  const Grid grid = Grid::paper(3);
  Table table = testing::synthetic_table(grid, storage);
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const Lobe lobe = grid.lobe(flat);
    Eigen::Matrix3d matrix = table.stored_at(flat);
    enforce_symmetry(lobe.theta_radians, lobe.phi_radians, matrix);
    table.set_stored(flat, matrix);
    table.amplitude[flat] = 1;
    table.fresnel[flat] = 0.5f;
    table.sw_loss[flat] = 1e-3f;
  }
  return table;
}

TEST(TableFaults, AGoodTableHasNone) {
  for (const Storage storage : {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame})
    EXPECT_EQ(faults_of(good_table(storage)), std::vector<std::string>{}) << name_of(storage);
}

TEST(TableFaults, EveryFaultIsFoundAndNamed) {
  const Grid grid = Grid::paper(3);
  const std::size_t general = grid.flat({1, 1, 1, 1}), at_phi_0 = grid.flat({1, 1, 1, 0});
  const std::size_t upward = grid.flat({1, 1, 0, 1});
  struct Damage {
    const char* fault;
    std::size_t entry;
    std::function<void(Table&)> damage;
  };
  const std::vector<Damage> damages = {
      {"status", general, [&](Table& t) { t.status[general] = Status::skipped; }},
      {"status", general, [&](Table& t) { t.status[general] = Status::failed; }},
      {"matrix is not finite", general, [&](Table& t) { t.stored[9 * general + 1] = nan; }},
      {"determinant", general, [&](Table& t) { t.set_stored(general, -t.stored_at(general)); }},
      {"equation (16)", at_phi_0, [&](Table& t) { t.stored[9 * at_phi_0 + 1] = 1e-30f; }},
      {"equation (16)", upward, [&](Table& t) { t.stored[9 * upward + 6] = 1e-30f; }},
      {"third column", general,
       [&](Table& t) { t.set_stored(general, (1 + 2e-6) * t.stored_at(general)); }},
      {"amplitude", general, [&](Table& t) { t.amplitude[general] = 1.0001f; }},
      {"amplitude", general, [&](Table& t) { t.amplitude[general] = nan; }},
      {"fresnel", general, [&](Table& t) { t.fresnel[general] = 0; }},
      {"fresnel", general, [&](Table& t) { t.amplitude[general] = 0.4f; }},
      {"loss", general, [&](Table& t) { t.sw_loss[general] = nan; }},
      {"phi = 0", upward,
       [&](Table& t) { t.stored[9 * upward] = std::nextafter(t.stored[9 * upward], 9.0f); }},
      {"phi = 0", upward, [&](Table& t) { t.fresnel[upward] = 0.4f; }},
  };
  for (const Damage& damage : damages) {
    Table table = good_table(Storage::matrix);
    damage.damage(table);
    const std::vector<std::string> faults = faults_of(table);
    ASSERT_FALSE(faults.empty()) << damage.fault;
    bool named = false;
    for (const std::string& fault : faults) {
      EXPECT_TRUE(fault.starts_with("entry " + std::to_string(damage.entry) + ": ")) << fault;
      named = named || fault.find(damage.fault) != std::string::npos;
    }
    EXPECT_TRUE(named) << damage.fault << " is not in " << faults.front();
  }
}

}  // namespace
}  // namespace ltc::test
