// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The program: reads the command line, runs a subcommand, turns exceptions into exit codes.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/interrupt.h"
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

int report(ExitCode code, std::string_view message) {
  tell(fmt::format("ltcfit: {}\n", one_line(message)));
  return code;
}

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

void run_command(const Command& command, Arguments arguments) {
  const DeclaredCommand declaration = declared(command);
  if (read_arguments(*declaration.app, arguments) == Request::help) {
    print(command_help(*declaration.app, platform::terminal_columns()));
    return;
  }
  Files files;
  tell_files(*declaration.app, files);
  declaration.action(files);
}

void run(Arguments arguments) {
  if (!arguments.empty() && arguments[0][0] != '-')
    run_command(command_named(arguments[0]), arguments.subspan(1));
  else
    run_without_command(arguments);
}

}  // namespace
}  // namespace ltc::cli

int main(int argument_count, char** arguments) {
  using namespace ltc;
  using namespace ltc::cli;
  try {
    platform::occupy_closed_standard_streams();
    platform::report_failed_writes_as_errors();
    const auto count = static_cast<std::size_t>(std::max(argument_count, 1));
    run({arguments + 1, count - 1});  // without the program's own name
    return success;
  } catch (const InputError& error) {
    return report(bad_input, error.what());
  } catch (const IoError& error) {
    return report(io_failure, error.what());
  } catch (const Interrupted& error) {
    return report(interrupted, error.what());
  } catch (const CheckFailure& error) {
    return report(failure, error.what());
  } catch (const std::bad_alloc&) {
    return report(io_failure, "out of memory; a table with fewer nodes needs less");
  } catch (const std::exception& error) {
    return report(failure, error.what());
  }
}
