// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables with one thing broken, made by tests/support/break_table.py.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/program.h"
#include "test_paths.h"

namespace ltc::test {

// Copies `good`, unless it is `bad`, and breaks the copy. `fault` is one of the script's, `entry`
// as `ltcfit fit --entry` takes it.
inline void break_table(const std::filesystem::path& good, const std::filesystem::path& bad,
                        const std::string& fault, const std::string& entry) {
  const ProgramResult result =
      run_program({"/usr/bin/python3", LTCFIT_SOURCE_DIR "/tests/support/break_table.py",
                   good.string(), bad.string(), fault, entry});
  ASSERT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace ltc::test
