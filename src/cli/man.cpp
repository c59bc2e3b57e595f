// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit man: the manual page, made from the tables of options.
#include <fmt/format.h>

#include <string>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/output.h"
#include "core/version.h"

namespace ltc::cli {
namespace {

// Text that troff prints as it stands.
std::string plain(const std::string& text) {
  std::string result;
  if (text.starts_with('.') || text.starts_with('\''))
    result += "\\&";
  for (const char c : text)
    result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string{c};
  return result;
}

std::string entries(const std::vector<HelpGroup>& groups) {
  std::string text;
  for (const HelpGroup& group : groups) {
    text += fmt::format(".SS \"{}\"\n", plain(group.title));
    for (const HelpEntry& entry : group.entries)
      text += fmt::format(".TP\n.B {}\n{}\n", plain(entry.left), plain(entry.text));
  }
  return text;
}

std::string manual() {
  const std::unique_ptr<CLI::App> program = program_options();
  std::string text = fmt::format(
      ".TH LTCFIT 1 \"\" \"ltcfit {}\" \"User Commands\"\n"
      ".SH NAME\nltcfit \\- look\\-up tables of linearly transformed cosines for anisotropic GGX\n"
      ".SH SYNOPSIS\n.B ltcfit\n.I COMMAND\n[\\fIOPTION\\fR]...\n"
      ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      version(), plain(program->get_description()));
  text += entries(command_groups()) + ".SH OPTIONS\n" + entries(option_groups(*program));
  for (const Command& command : commands()) {
    const DeclaredCommand declaration = declared(command);
    text +=
        fmt::format(".SH \"LTCFIT {}\"\n.B {}\n.PP\n{}\n", command.name,
                    plain(usage_text(*declaration.app)), plain(declaration.app->get_description()));
    text += entries(option_groups(*declaration.app));
  }
  return text + fmt::format(".SH \"EXIT STATUS\"\n{}\n", plain(exit_codes));
}

}  // namespace

Action declare_man(CLI::App&) {
  return [](Files&) { print(manual()); };
}

}  // namespace ltc::cli
