// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The scripts of `ltcfit completion`, in the shells that they are for.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

using Words = std::vector<std::string>;

Words lines_of(const std::string& text) {
  Words lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

Words sorted(Words words) {
  std::sort(words.begin(), words.end());
  return words;
}

bool has_program(const std::string& name) {
  return run_program({"sh", "-c", "command -v " + name}).exit_code == 0;
}

// What bash offers for the last of the words.
Words completed(const Words& words) {
  std::string line;
  for (const std::string& word : words)
    line += " '" + word + "'";
  const ProgramResult result = run_program(
      {"bash", "-c",
       "source <(" LTCFIT_PROGRAM " completion bash); COMP_WORDS=(ltcfit" + line +
           "); COMP_CWORD=" + std::to_string(words.size()) +
           "; _ltcfit; ((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"; true"},
      LTCFIT_SOURCE_DIR "/config");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return sorted(lines_of(result.out));
}

TEST(Completion, OfBashKnowsCommandsOptionsAndValues) {
  EXPECT_EQ(completed({"gen"}), Words{"generate"});
  EXPECT_EQ(completed({"--v"}), Words{"--version"});
  EXPECT_EQ(completed({"generate", "--che"}), Words{"--checkpoint-seconds"});
  EXPECT_EQ(completed({"fit", "--solver", "s"}), Words{"sgd"});
  EXPECT_EQ(completed({"fit", "--solver", "=", "l"}), Words{"l3-nelder-mead"});
  EXPECT_EQ(completed({"fit", "--solver", "="}), (Words{"gauss-newton", "l3-nelder-mead", "sgd"}));
  EXPECT_EQ(completed({"generate", "--config", "pa"}), Words{"paper.toml"});
  EXPECT_EQ(completed({"generate", "-o", "sc"}), Words{"scenes"});
  EXPECT_EQ(completed({"diff", "pap"}), Words{"paper.toml"});  // the table's argument: files
  EXPECT_EQ(completed({"completion", "f"}), Words{"fish"});
  EXPECT_EQ(completed({"generate", "--threads", ""}), Words{});  // a number: nothing to offer
  EXPECT_EQ(completed({"unknown", ""}), Words{});
  EXPECT_EQ(completed({"man", ""}), (Words{"--help", "-h"}));
}

TEST(Completion, IsReadByItsShell) {
  const TemporaryDirectory folder;
  for (const auto& [shell, check] : {std::pair<std::string, std::string>{"bash", "-n"},
                                     {"zsh", "-n"},
                                     {"fish", "--no-execute"}}) {
    const ProgramResult script = run_ltcfit({"completion", shell});
    ASSERT_EQ(script.exit_code, 0);
    const std::string file = folder.write("script." + shell, script.out).string();
    if (!has_program(shell))
      continue;
    const ProgramResult result = run_program({shell, check, file});
    EXPECT_EQ(result.exit_code, 0) << shell << ": " << result.err;
    EXPECT_EQ(result.err, "") << shell;
  }
}

// What is asked of zsh and fish, which take whole lines, in the folder of configs; the offers are
// sorted.
struct Completed {
  std::string line;
  Words offers;
};
const std::vector<Completed> asked{
    {"ltcfit gen", {"generate"}},
    {"ltcfit --v", {"--version"}},
    {"ltcfit generate --che", {"--checkpoint-seconds"}},
    {"ltcfit fit --solver s", {"sgd"}},
    {"ltcfit fit --solver ", {"gauss-newton", "l3-nelder-mead", "sgd"}},
    {"ltcfit fit --scene generate --sol", {"--solver"}},  // a file that is called as a command is
    {"ltcfit generate --set a=1 --set b=2 --se", {"--set"}},
    {"ltcfit generate --config pa", {"paper.toml"}},
    {"ltcfit generate -o sc", {"scenes"}},
    {"ltcfit diff pap", {"paper.toml"}},
    {"ltcfit diff paper.toml sg", {"sgd.toml"}},
    {"ltcfit completion f", {"fish"}},
    {"ltcfit generate --threads ", {}},
    {"ltcfit unknown ", {}},
};
const std::string solver_with_equals_sign = "ltcfit fit --solver=l";

const std::string configs = LTCFIT_SOURCE_DIR "/config";

// On a terminal: zsh has no line editor, and so no completion, without one. In place of the first
// line that it would read it completes all those of the file `lines`, and writes what it is given
// to offer to the file `offered`, behind each line.
constexpr const char* zsh_startup = R"(
fpath=($ZDOTDIR $fpath)
autoload -Uz compinit
compinit -u -D
compadd() {
  if [[ -z ${(M)@[1,(i)(-|--)]:#-(O|A|D)*} ]]; then
    local -a offers
    builtin compadd -O offers "$@"
    (($#offers)) && print -rl -- "${(@)offers}" >> $ZDOTDIR/offered
  fi
  builtin compadd "$@"
}
offer() {
  _main_complete
  compstate[insert]=
}
zle -C offer complete-word offer
zle-line-init() {
  local line
  for line in "${(@f)$(<$ZDOTDIR/lines)}"; do
    print -r -- "> $line" >> $ZDOTDIR/offered
    BUFFER=$line CURSOR=$#line
    zle offer
  done
  exit
}
zle -N zle-line-init
)";

// The offers by line.
std::map<std::string, Words> offered_by_zsh(const Words& lines) {
  const TemporaryDirectory folder;
  folder.write(".zshrc", zsh_startup);
  folder.write("_ltcfit", run_ltcfit({"completion", "zsh"}).out);
  std::string text;
  for (const std::string& line : lines)
    text += (text.empty() ? "" : "\n") + line;
  folder.write("lines", text);
  run_program({"env", "ZDOTDIR=" + folder.path().string(), "TERM=xterm", "script", "-qec",
               "zsh -o noglobalrcs -i", "/dev/null"},
              configs);
  std::map<std::string, Words> offered;
  std::string line;
  for (const std::string& offer :
       lines_of(run_program({"cat", (folder.path() / "offered").string()}).out))
    if (offer.starts_with("> "))
      offered[line = offer.substr(2)];
    else
      offered[line].push_back(offer);
  for (auto& [of_line, offers] : offered) {
    offers = sorted(offers);
    offers.erase(std::unique(offers.begin(), offers.end()), offers.end());
  }
  return offered;
}

TEST(Completion, OfZshKnowsCommandsOptionsAndValues) {
  if (!has_program("zsh") || !has_program("script"))
    GTEST_SKIP() << "no zsh, or no script";
  Words lines{solver_with_equals_sign};
  for (const Completed& completed : asked)
    lines.push_back(completed.line);
  std::map<std::string, Words> offered = offered_by_zsh(lines);
  ASSERT_EQ(offered.size(), lines.size());
  for (const Completed& completed : asked)
    EXPECT_EQ(offered[completed.line], completed.offers) << completed.line;
  EXPECT_EQ(offered[solver_with_equals_sign], Words{"l3-nelder-mead"});
}

Words offered_by_fish(const std::string& line) {
  const ProgramResult result = run_program(
      {"fish", "-N", "-c", LTCFIT_PROGRAM " completion fish | source; complete -C '" + line + "'"},
      configs);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  Words offers;
  for (const std::string& offer : lines_of(result.out)) {
    offers.push_back(offer.substr(0, offer.find('\t')));  // a description follows
    if (offers.back().ends_with('/'))
      offers.back().pop_back();
  }
  return sorted(offers);
}

TEST(Completion, OfFishKnowsCommandsOptionsAndValues) {
  if (!has_program("fish"))
    GTEST_SKIP() << "no fish";
  for (const Completed& completed : asked)
    EXPECT_EQ(offered_by_fish(completed.line), completed.offers) << completed.line;
  EXPECT_EQ(offered_by_fish(solver_with_equals_sign), Words{"--solver=l3-nelder-mead"});
}

}  // namespace
}  // namespace ltc::test
