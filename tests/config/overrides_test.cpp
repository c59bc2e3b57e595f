// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/overrides.h"

#include <gtest/gtest.h>

#include "config/config.h"

namespace ltc {
namespace {

TEST(Overrides, OfTheDefaultsAreNone) {
  EXPECT_EQ(overrides_of(to_toml(Config{})), std::vector<std::string>{});
}

TEST(Overrides, LoadToTheSameConfig) {
  const std::vector<std::string> changes = {"table.storage=mirror-frame",
                                            "table.alpha.nodes=3",
                                            "table.theta.last_degrees=80.123",
                                            "fit.seed=9007199254740992",
                                            "fit.solver=sgd",
                                            "fit.sgd.step_decay=0.1",
                                            "output.name=a.b",
                                            "fit.sgd.averaged_steps=2"};
  const Config config = load_config(std::nullopt, changes);
  const std::vector<std::string> overrides = overrides_of(to_toml(config));
  EXPECT_EQ(overrides.size(), changes.size());
  EXPECT_EQ(to_toml(load_config(std::nullopt, overrides)), to_toml(config));
}

TEST(Overrides, LeaveOutWhatIsNotKnown) {
  EXPECT_EQ(overrides_of("[fit]\nseed = 2\nolder = 3\n[other]\nx = 1\n"),
            std::vector<std::string>{"fit.seed=2"});
  EXPECT_EQ(overrides_of("no TOML"), std::vector<std::string>{});
  EXPECT_EQ(overrides_of(""), std::vector<std::string>{});
}

}  // namespace
}  // namespace ltc
