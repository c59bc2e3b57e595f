// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "support/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>
#include <thread>

#include "test_paths.h"

extern char** environ;

namespace ltc::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll_interval{2};

// The redirections of a child, released whatever happens.
struct FileActions {
  posix_spawn_file_actions_t actions;
  FileActions() { posix_spawn_file_actions_init(&actions); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
};

int exit_code_of(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& command,
                               const std::filesystem::path& folder) {
  const std::string out = outputs_.write("out", ""), err = outputs_.write("err", "");
  FileActions redirect;
  posix_spawn_file_actions_addopen(&redirect.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&redirect.actions, STDOUT_FILENO, out.c_str(), O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&redirect.actions, STDERR_FILENO, err.c_str(), O_WRONLY, 0);
  if (!folder.empty())
    posix_spawn_file_actions_addchdir_np(&redirect.actions, folder.c_str());

  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int error = ::posix_spawnp(&process_, arguments[0], &redirect.actions, nullptr,
                                   arguments.data(), environ);
  if (error != 0)
    throw std::runtime_error("cannot start " + command.at(0) + ": " + std::strerror(error));
}

RunningProgram::~RunningProgram() {
  if (!ended()) {
    send_signal(SIGKILL);
    wait(std::chrono::seconds(10));
  }
}

bool RunningProgram::ended() {
  int status = 0;
  if (!reaped_ && ::waitpid(process_, &status, WNOHANG) == process_) {
    exit_code_ = exit_code_of(status);
    reaped_ = true;
  }
  return reaped_;
}

bool RunningProgram::wait_until(const std::function<bool()>& condition,
                                std::chrono::seconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  while (Clock::now() < deadline) {
    const bool last_look = ended();
    if (condition())
      return !last_look;
    if (last_look)
      return false;
    std::this_thread::sleep_for(poll_interval);
  }
  return false;
}

bool RunningProgram::wait_for_error_text(std::string_view text, std::chrono::seconds limit) {
  return wait_until([&] { return read_file(outputs_ / "err").find(text) != std::string::npos; },
                    limit);
}

void RunningProgram::send_signal(int signal) {
  if (!ended())
    ::kill(process_, signal);
}

ProgramResult RunningProgram::wait(std::chrono::seconds limit) {
  const Clock::time_point deadline = Clock::now() + limit;
  bool killed = false;
  while (!ended()) {
    if (!killed && Clock::now() >= deadline) {
      ::kill(process_, SIGKILL);
      killed = true;
    }
    std::this_thread::sleep_for(poll_interval);
  }
  return {exit_code_, read_file(outputs_ / "out"), read_file(outputs_ / "err")};
}

ProgramResult run_program(const std::vector<std::string>& command,
                          const std::filesystem::path& folder, std::chrono::seconds limit) {
  return RunningProgram(command, folder).wait(limit);
}

ProgramResult run_ltcfit(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  arguments.insert(arguments.begin(), LTCFIT_PROGRAM);
  return run_program(arguments, folder);
}

}  // namespace ltc::test
