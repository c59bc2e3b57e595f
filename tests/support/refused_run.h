// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the program does when it refuses something: one line, an exit code, and no file.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/program.h"

namespace ltc::test {

// One line on standard error with all the parts, the exit code, and nothing else said.
inline void expect_error(const ProgramResult& result, int exit_code,
                         const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(result.err.starts_with("ltcfit: ")) << result.err;
  EXPECT_TRUE(result.err.ends_with('\n')) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos)
        << '"' << part << "\" is not in: " << result.err;
}

// Runs in an empty folder, where the default output folder would appear; nothing must.
inline void expect_refused(const std::vector<std::string>& arguments, int exit_code,
                           const std::vector<std::string>& parts) {
  const TemporaryDirectory folder;
  expect_error(run_ltcfit(arguments, folder.path()), exit_code, parts);
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

}  // namespace ltc::test
