// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the library says when it refuses something.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace ltc::test {

// The message of the error that `action` ends with; empty if it ends well.
template <typename Error>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// There is a message, of one line, with all these parts.
inline void expect_one_line(const std::string& message, const std::vector<std::string>& parts) {
  EXPECT_FALSE(message.empty()) << "accepted";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << '"' << part << "\" is not in: " << message;
}

}  // namespace ltc::test
