// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The errors of the library: one type for each exit code of the program.
#pragma once

#include <stdexcept>
#include <string>

namespace ltc {

// A value, key, file or table that cannot be used. The message names the bad
// value, the values allowed, and the file and key it came from where there is
// one. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file or folder that cannot be read or written. Exit code 3.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A check that ran to its end and failed. Exit code 1.
class CheckFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The caller asked for a stop while work was under way; no result was written. Exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : Interrupted("interrupted; nothing was written") {}
  explicit Interrupted(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace ltc
