// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit completion: scripts by which shells complete commands, options and values, made from the
// tables of options.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"

namespace ltc::cli {
namespace {

// An option, or an argument without a name, as a shell needs to know it.
struct Word {
  std::vector<std::string> names;  // "--config", "-c"; none for an argument
  std::string description, kind, shown_as;
  bool repeats = false;

  bool takes_value() const { return !shown_as.empty(); }
  bool is_folder() const { return kind == value_kind::folder; }
  bool is_file() const {
    return kind == value_kind::input || kind == value_kind::image || kind == value_kind::output ||
           kind == value_kind::json;
  }
  // The values between braces, with spaces between; empty if there is no such list.
  std::string choices() const {
    if (!kind.starts_with('{'))
      return "";
    std::string list = kind.substr(1, kind.size() - 2);
    std::replace(list.begin(), list.end(), ',', ' ');
    return list;
  }
};

struct CommandWords {
  std::string name, summary;
  std::vector<Word> options, arguments;
};

Word word_of(const CLI::Option& option) {
  Word word;
  for (const std::string& name : option.get_lnames())
    word.names.push_back("--" + name);
  for (const std::string& name : option.get_snames())
    word.names.push_back("-" + name);
  word.description = option.get_description();
  word.kind = option.get_type_name();
  if (option.get_items_expected_max() > 0)
    word.shown_as = option.get_option_text();
  word.repeats = option.get_items_expected_max() > 1;
  return word;
}

bool is_long(const std::string& name) {
  return name.starts_with("--");
}

CommandWords words_of(const std::string& name, const CLI::App& app) {
  CommandWords words{name, app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? words.arguments : words.options).push_back(word_of(*option));
  return words;
}

std::vector<CommandWords> all_words() {
  std::vector<CommandWords> all;
  for (const Command& command : commands())
    all.push_back(words_of(command.name, *declared(command).app));
  return all;
}

// What stands in place of a command.
std::vector<Word> program_words() {
  return words_of("", *program_options()).options;
}

std::vector<std::string> names_of(const std::vector<Word>& words) {
  std::vector<std::string> names;
  for (const Word& word : words)
    names.insert(names.end(), word.names.begin(), word.names.end());
  return names;
}

std::vector<std::string> command_names(const std::vector<CommandWords>& all) {
  std::vector<std::string> names;
  for (const CommandWords& command : all)
    names.push_back(command.name);
  return names;
}

// ---- bash ----

// What compgen is asked for the value, if it can help.
std::string bash_values(const Word& word) {
  if (word.is_folder())
    return "-d";
  if (word.is_file())
    return "-f";
  const std::string choices = word.choices();
  return choices.empty() ? "" : fmt::format("-W '{}'", choices);
}

std::string bash_case(const CommandWords& command) {
  std::string text = fmt::format("    {})\n      options='{}'\n", command.name,
                                 fmt::join(names_of(command.options), " "));
  if (!command.arguments.empty())
    text += fmt::format("      arguments=({})\n", bash_values(command.arguments.front()));
  text += "      case $previous in\n";
  for (const Word& option : command.options)
    if (option.takes_value())
      text += fmt::format("        {}) values=({}) takes_value=1 ;;\n",
                          fmt::join(option.names, " | "), bash_values(option));
  return text + "      esac\n      ;;\n";
}

std::string bash_script(const std::vector<CommandWords>& all) {
  std::string text = R"(# bash completion of ltcfit, made by: ltcfit completion bash
_ltcfit() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local options='' takes_value='' values=() arguments=()
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W ')";
  text += fmt::format("{} {}", fmt::join(command_names(all), " "),
                      fmt::join(names_of(program_words()), " "));
  text += R"(' -- "$current")
    return
  fi
  # "--config=x" arrives as three words.
  if [[ $current == = ]]; then
    current=''
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  case ${COMP_WORDS[1]} in
)";
  for (const CommandWords& command : all)
    text += bash_case(command);
  return text + R"(    *) return ;;
  esac
  if [[ ! $takes_value ]]; then
    if [[ $current == -* ]] || ((${#arguments[@]} == 0)); then
      values=(-W "$options")
    else
      values=("${arguments[@]}")
    fi
  fi
  ((${#values[@]})) || return
  [[ ${values[0]} == -W ]] || compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "${values[@]}" -- "$current")
}
complete -F _ltcfit ltcfit
)";
}

// ---- zsh ----

// Between single quotes, with what _arguments gives a meaning to escaped.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      result += {'\\', c};
    else
      result += c;
  return result;
}

std::string zsh_values(const Word& word) {
  if (word.is_folder())
    return "_files -/";
  if (word.is_file())
    return "_files";
  const std::string choices = word.choices();
  return choices.empty() ? " " : fmt::format("({})", choices);
}

std::string zsh_option(const Word& word) {
  const std::string value =
      word.takes_value() ? fmt::format(":{}:{}", zsh_text(word.shown_as), zsh_values(word)) : "";
  std::string text;
  for (const std::string& name : word.names)
    text += fmt::format(" \\\n        '{}{}{}[{}]{}'", word.repeats ? "*" : "", name,
                        word.takes_value() && is_long(name) ? "=" : "", zsh_text(word.description),
                        value);
  return text;
}

std::string zsh_script(const std::vector<CommandWords>& all) {
  std::string text =
      "#compdef ltcfit\n# zsh completion of ltcfit, made by: ltcfit completion zsh\n_ltcfit() {\n"
      "  local -a commands=(\n";
  for (const CommandWords& command : all)
    text += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.summary));
  text += R"(  )
  if ((CURRENT == 2)); then
    if [[ $PREFIX == -* ]]; then
      _arguments)";
  for (const Word& option : program_words())
    text += zsh_option(option);
  text += R"(
    else
      _describe command commands
    fi
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
)";
  for (const CommandWords& command : all) {
    text += fmt::format("    {})\n      _arguments", command.name);
    for (const Word& option : command.options)
      text += zsh_option(option);
    for (const Word& argument : command.arguments)
      text += fmt::format(" \\\n        '{}:{}:{}'", argument.repeats ? "*" : "",
                          zsh_text(argument.description), zsh_values(argument));
    text += "\n      ;;\n";
  }
  // A function of a folder in $fpath, or sourced.
  return text + R"(  esac
}
if [[ ${funcstack[1]} == _ltcfit ]]; then
  _ltcfit "$@"
else
  compdef _ltcfit ltcfit
fi
)";
}

// ---- fish ----

std::string fish_text(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '\'' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return result;
}

std::string fish_values(const Word& word) {
  if (word.is_folder())
    return " -x -a '(__fish_complete_directories)'";
  if (word.is_file())
    return " -r -F";
  const std::string choices = word.choices();
  if (!choices.empty())
    return fmt::format(" -x -a '{}'", choices);
  return word.takes_value() ? " -x" : "";
}

std::string fish_option(const std::string& line, const Word& option) {
  std::string text = line;
  for (const std::string& name : option.names)
    text += is_long(name) ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return fmt::format("{}{} -d '{}'\n", text, fish_values(option), fish_text(option.description));
}

std::string fish_script(const std::vector<CommandWords>& all) {
  // The command is the first word and no other: a file may be called as one is.
  std::string text = R"(# fish completion of ltcfit, made by: ltcfit completion fish
function __ltcfit_command_is
  set -l words (commandline -opc)
  test "$words[2]" = "$argv[1]"
end
complete -c ltcfit -f
)";
  const std::string first = "complete -c ltcfit -n '__ltcfit_command_is \"\"'";
  for (const Word& option : program_words())
    text += fish_option(first, option);
  for (const CommandWords& command : all) {
    text += fmt::format("{} -a {} -d '{}'\n", first, command.name, fish_text(command.summary));
    const std::string line =
        fmt::format("complete -c ltcfit -n '__ltcfit_command_is {}'", command.name);
    for (const Word& option : command.options)
      text += fish_option(line, option);
    for (const Word& argument : command.arguments)
      text += line + (argument.is_file() ? " -F" : fish_values(argument)) + "\n";
  }
  return text;
}

}  // namespace

Action declare_completion(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  allow_names(app.add_option("SHELL", *shell, "bash, zsh or fish"), {"bash", "zsh", "fish"})
      ->required()
      ->option_text("SHELL");
  return [shell](Files&) {
    const std::vector<CommandWords> all = all_words();
    print(*shell == "bash"  ? bash_script(all)
          : *shell == "zsh" ? zsh_script(all)
                            : fish_script(all));
  };
}

}  // namespace ltc::cli
