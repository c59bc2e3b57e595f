// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A planted fault proves that each sanitizer of this build is on. Only in builds with sanitizers:
// without them a fault does whatever it likes, and there is nothing to assert.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "export/files.h"

namespace ltc {
namespace {

constexpr std::string_view sanitizers = LTCFIT_SANITIZERS;

testing::Finished planted(const std::string& fault) {
  return testing::run(LTCFIT_PLANTED_FAULT " " + fault);
}

void expect_noticed(const std::string& fault, std::string_view report) {
  const testing::Finished finished = planted(fault);
  EXPECT_NE(finished.exit_code, 0) << fault << ": " << finished.output;
  EXPECT_NE(finished.output.find(report), std::string::npos) << fault << ": " << finished.output;
}

TEST(PlantedFault, OfEverySanitizerOfThisBuildIsNoticed) {
  int kinds = 0;
  if (sanitizers.find("address") != std::string_view::npos) {
    expect_noticed("heap-overflow", "heap-buffer-overflow");
    ++kinds;
  }
  if (sanitizers.find("undefined") != std::string_view::npos) {
    expect_noticed("signed-overflow", "signed integer overflow");
    ++kinds;
  }
  if (sanitizers.find("leak") != std::string_view::npos) {
    expect_noticed("leak", "detected memory leaks");
    ++kinds;
  }
  if (sanitizers.find("thread") != std::string_view::npos) {
    expect_noticed("data-race", "data race");
    expect_noticed("openmp-race", "data race");
    ++kinds;
  }
  EXPECT_GT(kinds, 0) << "no fault is planted for " << sanitizers;
}

TEST(PlantedFault, NothingIsNoticedWhereThereIsNone) {
  const testing::Finished finished = planted("none");
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  EXPECT_EQ(finished.output, "done 0\n");
}

}  // namespace
}  // namespace ltc
