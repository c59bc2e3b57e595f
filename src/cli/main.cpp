// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The program: reads the command line, runs a subcommand, turns exceptions into exit codes.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/launch.h"
#include "cli/output.h"
#include "core/error.h"
#include "core/platform.h"
#include "core/version.h"

namespace ltc::cli {
namespace {

enum ExitCode {
  success = 0,
  failure = 1,
  bad_input = 2,
  io_failure = 3,
  interrupted = StopOnInterrupt::exit_code
};

using Arguments = std::span<const char* const>;

std::string command_names() {
  std::string all;
  for (const Command& command : commands())
    all += (all.empty() ? "" : ", ") + std::string(command.name);
  return all + " (see ltcfit --help)";
}

const Command& command_named(std::string_view name) {
  for (const Command& command : commands())
    if (name == command.name)
      return command;
  throw InputError(
      fmt::format("unknown command {}; expected {}", shell_quoted(name), command_names()));
}

// Without a command there is only help to ask for.
void run_without_command(Arguments arguments) {
  const std::unique_ptr<CLI::App> app = program_options();
  switch (read_arguments(*app, arguments)) {
    case Request::help:
      print(program_help(*app, platform::terminal_columns()));
      return;
    case Request::version:
      print(generator() + "\n");
      return;
    case Request::work:
      throw InputError("no command given; expected " + command_names());
  }
}

// Of several ranks one does what cannot be shared.
void run_command(const Command& command, Arguments arguments) {
  if (!command.is_shared && !is_first(launched_ranks()))
    return;
  const DeclaredCommand declaration = declared(command);
  if (read_arguments(*declaration.app, arguments) == Request::help) {
    if (is_first(launched_ranks()))
      print(command_help(*declaration.app, platform::terminal_columns()));
    return;
  }
  Files files;
  if (is_first(launched_ranks()))
    tell_files(*declaration.app, files);
  declaration.action(files);
}

void run(Arguments arguments) {
  if (!arguments.empty() && arguments[0][0] != '-')
    run_command(command_named(arguments[0]), arguments.subspan(1));
  else if (is_first(launched_ranks()))
    run_without_command(arguments);
}

// What becomes of the work, as the process says it at its end.
RankEnd end_of(const std::function<void()>& work) {
  try {
    work();
    return {success, ""};
  } catch (const InputError& error) {
    return {bad_input, error.what()};
  } catch (const IoError& error) {
    return {io_failure, error.what()};
  } catch (const Interrupted& error) {
    return {interrupted, error.what()};
  } catch (const CheckFailure& error) {
    return {failure, error.what()};
  } catch (const std::bad_alloc&) {
    return {io_failure, "out of memory; a table with fewer nodes needs less"};
  } catch (const std::exception& error) {
    return {failure, error.what()};
  }
}

int report(const RankEnd& end) {
  if (end.exit_code != success)
    tell(fmt::format("ltcfit: {}\n", one_line(end.message)));
  return end.exit_code;
}

// Alone, or as one of several ranks, of which the first one tells what became of all.
int run_launched(const std::optional<LaunchedAs>& launched, Arguments arguments) {
  const Launch launch(launched);
  RankEnd end = end_of([&] { run(arguments); });
  Ranks* const ranks = launched_ranks();
  if (ranks)
    end = agree_on_end(*ranks, end, interrupted);
  return is_first(ranks) ? report(end) : end.exit_code;
}

}  // namespace
}  // namespace ltc::cli

int main(int argument_count, char** arguments) {
  using namespace ltc;
  using namespace ltc::cli;
  const std::optional<LaunchedAs> launched =
      launched_as([](const char* name) { return std::getenv(name); });
  int exit_code = success;
  const RankEnd end = end_of([&] {
    platform::occupy_closed_standard_streams();
    platform::report_failed_writes_as_errors();
    const auto count = static_cast<std::size_t>(std::max(argument_count, 1));
    // Without the program's own name.
    exit_code = run_launched(launched, {arguments + 1, count - 1});
  });
  if (end.exit_code == success)
    return exit_code;
  // None were joined: that one speaks is enough.
  return launched && launched->rank != 0 ? success : report(end);
}
