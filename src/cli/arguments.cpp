// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/options.h"
#include "config/suggestion.h"
#include "core/error.h"

namespace ltc::cli {
namespace {

std::string see_help(const CLI::App& app) {
  return fmt::format(" (see {} --help)", app.get_name());
}

// "--config FILE", "TABLE".
std::string usage_of(const CLI::Option& option) {
  const std::string name = option.get_name();
  return option.get_positional() ? name : fmt::format("{} {}", name, option.get_option_text());
}

bool looks_like_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-';
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0;
}

// CLI11 begins a message with the option that it is about.
const CLI::Option* named_first(const CLI::App& app, const std::string& message) {
  const std::string name = message.substr(0, message.find_first_of(": "));
  return name.empty() ? nullptr : app.get_option_no_throw(name);
}

std::string no_value(const CLI::Option& option) {
  return fmt::format("{} has no value; expected {}", option.get_name(), usage_of(option));
}

// The words that no option takes; one of them is the reason.
std::string of_extra_word(const CLI::App& app, const std::string& word) {
  if (!looks_like_option(word))
    return fmt::format("unexpected word {}", shell_quoted(word)) + see_help(app);
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_positional())
      known.push_back(option->get_name());
  return fmt::format(
      "unknown option {}{}", shell_quoted(name),
      config::suggestion(name, known, "expected one of " + app.get_name() + " --help"));
}

// What CLI11 found wrong, in the words of this program.
std::string in_own_words(const CLI::ParseError& error, const CLI::App& app) {
  const std::string message = error.what();
  std::vector<std::string> extra = app.remaining();
  std::erase(extra, "--");
  // A misspelt option first: its value may have been taken for something else.
  const auto unknown = std::find_if(extra.begin(), extra.end(), looks_like_option);
  if (unknown != extra.end())
    return of_extra_word(app, *unknown);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !extra.empty())
    return of_extra_word(app, extra.front());
  if (dynamic_cast<const CLI::ExcludesError*>(&error)) {
    constexpr std::string_view between = " excludes ";
    const std::size_t place = message.find(between);
    return fmt::format("{} does not go with {}{}", message.substr(0, place),
                       message.substr(place + between.size()), see_help(app));
  }
  const CLI::Option* const option = named_first(app, message);
  if (!option)
    return message + see_help(app);
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    return fmt::format("{} is missing{}", usage_of(*option), see_help(app));
  if (option->count() > 1)
    return fmt::format("{} is given {} times; expected once", option->get_name(), option->count());
  return no_value(*option);
}

// What CLI11 would take: a value for a flag, and the next option for a value that was forgotten.
void refuse_misplaced_values(const CLI::App& app, std::span<const char* const> arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i];
    if (word == "--")
      return;
    if (!looks_like_option(word))
      continue;
    const std::size_t equals = word.find('=');
    const CLI::Option* const option = app.get_option_no_throw(word.substr(0, equals));
    if (!option)
      continue;
    if (is_flag(*option)) {
      if (equals != std::string::npos)
        throw InputError(fmt::format("{} takes no value{}", option->get_name(), see_help(app)));
    } else if (equals == std::string::npos && i + 1 < arguments.size()) {
      const std::string value = arguments[++i];
      if (looks_like_option(value) && app.get_option_no_throw(value))
        throw InputError(fmt::format("{}, or {}={}", no_value(*option), word, value));
    }
  }
}

}  // namespace

Request read_arguments(CLI::App& app, std::span<const char* const> arguments) {
  refuse_misplaced_values(app, arguments);
  try {
    // CLI11 takes them from the back.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    return Request::help;
  } catch (const CLI::CallForVersion&) {
    return Request::version;
  } catch (const CLI::ParseError& error) {
    throw InputError(in_own_words(error, app));
  }
  return Request::work;
}

void tell_files(const CLI::App& app, Files& files) {
  const auto each = [&](auto&& action) {
    for (const CLI::Option* option : app.get_options())
      for (const std::string& value : option->results())
        action(option->get_type_name(), option->get_name(), value);
  };
  each([&](const std::string& kind, const std::string& name, const std::string& value) {
    if (kind == value_kind::input)
      files.read(name, value);
    else if (kind == value_kind::image)
      files.read_alone(name, value);
  });
  each([&](const std::string& kind, const std::string& name, const std::string& value) {
    if (kind == value_kind::output || (kind == value_kind::json && value != "-"))
      files.write(name, value);
  });
}

}  // namespace ltc::cli
