// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Comparing tables bit by bit: NaN equals NaN.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "table/table.h"

namespace ltc::testing {

inline void expect_same_bits(const std::vector<float>& a, const std::vector<float>& b,
                             const char* name) {
  ASSERT_EQ(a.size(), b.size()) << name;
  ASSERT_FALSE(a.empty()) << name;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0) << name;
}

inline void expect_same_tables(const Table& a, const Table& b) {
  EXPECT_EQ(a.grid, b.grid);
  EXPECT_EQ(a.storage, b.storage);
  EXPECT_EQ(a.grid.model, b.grid.model);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.config, b.config);
  EXPECT_EQ(a.generator, b.generator);
  EXPECT_EQ(a.created, b.created);
  EXPECT_EQ(a.refined, b.refined);
  expect_same_bits(a.stored, b.stored, "stored");
  expect_same_bits(a.amplitude, b.amplitude, "amplitude");
  expect_same_bits(a.fresnel, b.fresnel, "fresnel");
  expect_same_bits(a.sw_loss, b.sw_loss, "sw_loss");
  EXPECT_EQ(a.fold, b.fold);
  EXPECT_EQ(a.creases, b.creases);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.iterations, b.iterations);
}

}  // namespace ltc::testing
