// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The program: reads the command line, runs a subcommand, turns exceptions into exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/output.h"
#include "core/error.h"
#include "core/platform.h"
#include "core/version.h"

namespace ltc::cli {
namespace {

enum ExitCode { success = 0, failure = 1, bad_input = 2, io_failure = 3, interrupted = 130 };

constexpr const char* footer =
    "Exit codes: 0 done, 1 a check failed, 2 bad input, 3 a file could not be read or written,\n"
    "130 interrupted. Run 'ltcfit COMMAND --help' for a command's options.";

int report(ExitCode code, std::string_view message) {
  fmt::print(stderr, "ltcfit: {}\n", one_line(message));
  return code;
}

// CLI11's layout, with the usage in the words of this program and one blank line between groups.
class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(24); }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    const bool whole_program = app->get_parent() == nullptr;
    return fmt::format("\nUsage: {}{} [OPTION]...\n", name, whole_program ? " COMMAND" : "");
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    const std::string text = CLI::Formatter::make_group(group, is_positional, options);
    return group == last_group ? text : text.substr(0, text.find_last_not_of('\n') + 1);
  }

  static constexpr const char* last_group = "About";
};

void add_help_option(CLI::App& app) {
  app.set_help_flag("");  // CLI11 puts its own first; help stands last
  app.set_help_flag("-h,--help", "print this help and exit")->group(HelpFormatter::last_group);
}

// The command line: one action for each subcommand, in the order of commands().
struct Program {
  CLI::App app{
      "ltcfit makes look-up tables of linearly transformed cosines (LTC) for anisotropic GGX.",
      "ltcfit"};
  std::vector<std::pair<CLI::App*, Action>> actions;

  Program() {
    app.formatter(std::make_shared<HelpFormatter>());
    add_help_option(app);
    app.set_version_flag("--version", generator(), "print version and commit and exit")
        ->group(HelpFormatter::last_group);
    app.footer(footer);
    for (const Command& command : commands()) {
      CLI::App* subcommand = app.add_subcommand(command.name, command.summary);
      subcommand->group(command.group);
      subcommand->footer("");
      actions.emplace_back(subcommand, command.declare(*subcommand));
      add_help_option(*subcommand);
    }
  }

  void run() {
    bool any = false;
    for (const auto& [subcommand, action] : actions)
      if (subcommand->parsed()) {
        any = true;
        action();
      }
    if (!any)
      throw InputError(fmt::format("no command given; expected {}", names()));
  }

  // Names what a misspelt command should have been; CLI11 only says that it did not expect it.
  void require_known_command(std::string_view name) const {
    for (const auto& [subcommand, action] : actions)
      if (subcommand->get_name() == name)
        return;
    throw InputError(fmt::format("unknown command {}; expected {}", shell_quoted(name), names()));
  }

 private:
  std::string names() const {
    std::string all;
    for (const auto& [subcommand, action] : actions)
      all += (all.empty() ? "" : ", ") + subcommand->get_name();
    return all + " (see ltcfit --help)";
  }
};

int usage_error(const CLI::ParseError& error) {
  return report(bad_input, fmt::format("{} (see ltcfit --help)", error.what()));
}

int run(int argument_count, char** arguments) {
  Program program;
  if (argument_count > 1 && arguments[1][0] != '-')
    program.require_known_command(arguments[1]);
  try {
    program.app.parse(argument_count, arguments);
  } catch (const CLI::CallForHelp&) {
    print(program.app.help());
    return success;
  } catch (const CLI::CallForVersion&) {
    print(generator() + "\n");
    return success;
  } catch (const CLI::ParseError& error) {
    return usage_error(error);
  }
  program.run();
  return success;
}

}  // namespace
}  // namespace ltc::cli

int main(int argument_count, char** arguments) {
  using namespace ltc;
  using namespace ltc::cli;
  try {
    platform::report_file_size_limit_as_error();
    return run(argument_count, arguments);
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
