// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs programs for tests: ltcfit itself, and the readers of others that check its files.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/temporary_directory.h"

namespace ltc::test {

// How long tests wait for what should happen: so long that only a hang comes to its end, on a busy
// machine and with sanitizers too.
inline constexpr std::chrono::seconds patience{600};

struct ProgramResult {
  int exit_code = -1;  // 128 + the signal's number if a signal ended the program
  std::string out;     // standard output
  std::string err;     // standard error
};

// A program under way. Its outputs go to files, so it never waits for a reader. The destructor
// kills it if it still runs.
class RunningProgram {
 public:
  // `command` is the program, found on PATH unless it has a slash, and its arguments. `folder` is
  // the working directory, the caller's own if empty. Throws std::runtime_error if it cannot start.
  explicit RunningProgram(const std::vector<std::string>& command,
                          const std::filesystem::path& folder = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  // Waits until `condition` holds; false if the program ended or `limit` passed first.
  bool wait_until(const std::function<bool()>& condition, std::chrono::seconds limit);

  // Waits until standard error contains `text`; false if the program ended or `limit` passed first.
  bool wait_for_error_text(std::string_view text, std::chrono::seconds limit);

  void send_signal(int signal);

  // Waits for the end; a program that is not done after `limit` is killed, which shows as 128 + 9.
  ProgramResult wait(std::chrono::seconds limit);

 private:
  bool ended();  // reaps the process if it has ended

  TemporaryDirectory outputs_;
  pid_t process_ = -1;
  int exit_code_ = -1;
  bool reaped_ = false;
};

// Runs a program to its end.
ProgramResult run_program(const std::vector<std::string>& command,
                          const std::filesystem::path& folder = {},
                          std::chrono::seconds limit = patience);

// Runs the ltcfit of this build with the given arguments.
ProgramResult run_ltcfit(std::vector<std::string> arguments,
                         const std::filesystem::path& folder = {});

}  // namespace ltc::test
