// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/command.h"
#include "cli/wrap.h"

namespace ltc::cli {
namespace {

constexpr std::size_t column = 24;  // where descriptions begin

HelpEntry entry_of(const CLI::Option& option) {
  if (option.get_positional())
    return {option.get_name(true, false), option.get_description()};
  std::string left = option.get_name(false, true);
  if (const std::size_t comma = left.find(','); comma != std::string::npos)
    left.insert(comma + 1, " ");
  if (!option.get_option_text().empty())
    left += " " + option.get_option_text();
  return {left, option.get_description()};
}

// "  -c, --config FILE     TOML file that ...", the rest of the text below its beginning.
std::string entry_text(const HelpEntry& entry, std::size_t columns) {
  std::string text = "  " + entry.left;
  text += text.size() + 2 > column ? "\n" + std::string(column, ' ')
                                   : std::string(column - text.size(), ' ');
  return text + wrapped(entry.text, columns, column, column) + "\n";
}

std::string groups_text(const std::vector<HelpGroup>& groups, std::size_t columns) {
  std::string text;
  for (const HelpGroup& group : groups) {
    text += fmt::format("\n{}:\n", group.title);
    for (const HelpEntry& entry : group.entries)
      text += entry_text(entry, columns);
  }
  return text;
}

std::string beginning(const CLI::App& app, std::size_t columns) {
  return fmt::format("{}\n\nUsage: {}\n", wrapped(app.get_description(), columns, 0, 0),
                     wrapped(usage_text(app), columns, 7, 9));
}

HelpEntry& add_entry(std::vector<HelpGroup>& groups, const std::string& title, HelpEntry entry) {
  auto group = std::find_if(groups.begin(), groups.end(),
                            [&](const HelpGroup& known) { return known.title == title; });
  if (group == groups.end())
    group = groups.insert(groups.end(), {title, {}});
  return group->entries.emplace_back(std::move(entry));
}

}  // namespace

std::string usage_text(const CLI::App& app) {
  std::string text = app.get_name() + " [OPTION]...";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional()) {
      text += option->get_required() ? " " + option->get_name() : " [" + option->get_name() + "]";
      text += option->get_items_expected_max() > 1 ? "..." : "";
    }
  return text;
}

std::vector<HelpGroup> option_groups(const CLI::App& app) {
  std::vector<HelpGroup> groups;
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      add_entry(groups, "Arguments", entry_of(*option));
  for (const CLI::Option* option : app.get_options())
    if (!option->get_positional())
      add_entry(groups, option->get_group(), entry_of(*option));
  return groups;
}

std::vector<HelpGroup> command_groups() {
  std::vector<HelpGroup> groups;
  for (const Command& command : commands())
    add_entry(groups, command.group, {command.name, command.summary});
  return groups;
}

std::string command_help(const CLI::App& app, std::size_t columns) {
  return beginning(app, columns) + groups_text(option_groups(app), columns);
}

std::string program_help(const CLI::App& app, std::size_t columns) {
  std::string text = fmt::format("{}\n\nUsage: ltcfit COMMAND [OPTION]...\n",
                                 wrapped(app.get_description(), columns, 0, 0));
  text += groups_text(command_groups(), columns) + groups_text(option_groups(app), columns);
  return text + "\n" +
         wrapped(std::string(exit_codes) + " Run 'ltcfit COMMAND --help' for a command's options.",
                 columns, 0, 0) +
         "\n";
}

}  // namespace ltc::cli
