// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/validation_page.h"

#include <gtest/gtest.h>

#include "table/synthetic.h"

namespace ltc {
namespace {

// Little work and small pictures.
std::string page(double query_loss) {
  Validation validation{
      "t.h5", testing::synthetic_table(Grid::paper(3), Storage::matrix), {}, std::nullopt, {}};
  QualitySettings settings;
  settings.node_samples = settings.query_samples = settings.quad_samples = 64;
  settings.node_directions = settings.query_directions = 4;
  settings.queries = 20;
  settings.floor_fit.gauss_newton.samples = 64;
  settings.floor_fit.gauss_newton.target_samples = 64;
  validation.quality = measure_quality(validation.table, settings, {2});
  validation.thresholds = check_thresholds(*validation.quality, {1e9, query_loss, 1e9});
  return validation_page(validation, {1, 8, 16}, {2});
}

TEST(ValidationPage, SaysWhetherTheTableIsSound) {
  const std::string sound = page(1e9), failed = page(1e-9);
  EXPECT_NE(sound.find("✓ Sound"), std::string::npos);
  EXPECT_EQ(sound.find("above quality."), std::string::npos);
  EXPECT_NE(failed.find("✗ Not sound"), std::string::npos);
  EXPECT_NE(failed.find("above quality.query_loss = 1e-09"), std::string::npos);
}

}  // namespace
}  // namespace ltc
