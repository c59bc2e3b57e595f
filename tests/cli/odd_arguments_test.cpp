// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Command lines as people mistype them, all commands, through the real program: none crashes,
// hangs, overwrites or half-writes.
#include <gtest/gtest.h>

#include "support/generate_runs.h"
#include "support/refused_run.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

const Arguments unrefined = tiny + Arguments{"--set", "refine.steps=0"};

// Arguments between spaces, and what becomes of them. '~' stands for an argument that is empty, '^'
// within one for a space.
struct Case {
  const char* arguments;
  int exit_code;
  const char* part;  // of the message; with exit code 0, of what is printed
};

Arguments split(std::string_view text) {
  Arguments arguments;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    std::string argument(text.substr(at, end - at));
    std::replace(argument.begin(), argument.end(), '^', ' ');
    arguments.push_back(argument == "~" ? "" : argument);
    at = end + 1;
  }
  return arguments;
}

// A folder with files good and bad; every case finds it as it was made.
class OddArguments : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryDirectory;
    ASSERT_EQ(run_ltcfit(generate(unrefined + Arguments{"--set", "output.name=T"}), folder_->path())
                  .exit_code,
              0);
    const std::string table = read_file(*folder_ / "T.h5");
    folder_->write("cut.h5", table.substr(0, table.size() / 2));
    folder_->write("text.h5", "no table");
    folder_->write("empty.h5", "");
    folder_->write("empty.npy", "");
    folder_->write("empty.0.exr", "");
    folder_->write("-x.h5", table);
    folder_->write(
        "t\xc3\xa4"
        "ble \xe2\x98\x83.h5",
        table);
    folder_->write("byte\xff.h5", table);
    folder_->write("empty.toml", "");
    folder_->write("seed.toml", "fit.seed = 3\n");
    folder_->write("twice.toml", "fit.seed = 3\nfit.seed = 3\n");
    folder_->write("open.toml", "[fit\n");
    folder_->write("bytes.toml", std::string("\0\xff\xfe", 3));
    folder_->write("open.gltf", "{\"asset\": ");
    folder_->write("empty.glb", "");
    folder_->write("nothing.toml", "material = []\n");
    fs::create_directory(*folder_ / "d");
    fs::create_directory(*folder_ / "d.h5");
    fs::create_directory(*folder_ / "d.toml");
    fs::create_symlink("loop", *folder_ / "loop");
    fs::create_symlink("nowhere", *folder_ / "dangling.h5");
    before_ = names_in(folder_->path());
    table_ = table;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static void expect(const std::vector<Case>& cases) {
    for (const auto& [text, exit_code, part] : cases) {
      SCOPED_TRACE(text);
      const ProgramResult result = run_ltcfit(split(text), folder_->path());
      EXPECT_EQ(result.exit_code, exit_code) << result.err;
      if (exit_code == 0)
        EXPECT_NE(result.out.find(part), std::string::npos) << result.out << result.err;
      else
        expect_error(result, exit_code, {part});
      EXPECT_EQ(names_in(folder_->path()), before_);
    }
    EXPECT_TRUE(read_file(*folder_ / "T.h5") == table_);
  }

  static TemporaryDirectory* folder_;
  static std::vector<std::string> before_;
  static std::string table_;
};
TemporaryDirectory* OddArguments::folder_ = nullptr;
std::vector<std::string> OddArguments::before_;
std::string OddArguments::table_;

TEST_F(OddArguments, OfTheProgram) {
  expect({
      {"", 2, "no command given; expected generate, merge, fit"},
      {"~", 2, "unknown command ''"},
      {"^", 2, "unknown command ' '"},
      {"Generate", 2, "unknown command Generate"},
      {"help", 2, "unknown command help"},
      {"--", 2, "no command given"},
      {"-", 2, "unexpected word -"},
      {"-x", 2, "unknown option -x"},
      {"--vers", 2, "unknown option --vers"},
      {"--version=2", 2, "--version takes no value"},
      {"--help=me", 2, "--help takes no value"},
      {"--help generate", 0, "Usage: ltcfit COMMAND"},
      {"--version fit", 0, "ltcfit 0."},
      {"-t 2 generate", 2, "unknown option -t"},
      {"generate fit", 2, "unexpected word fit"},
      {"generate generate", 2, "unexpected word generate"},
      {"generate --set table.alpha.nodes=2 stray", 2, "unexpected word stray"},
      {"fit --entry 1,1,1,1 generate", 2, "unexpected word generate"},
      {"diff T.h5 T.h5 T.h5", 2, "unexpected word T.h5"},
      {"validate T.h5 bench", 2, "unexpected word bench"},
      {"completion", 2, "SHELL is missing"},
      {"completion tcsh", 2, "SHELL tcsh: expected bash, zsh or fish"},
      {"completion bash zsh", 2, "unexpected word zsh"},
      {"completion --shell bash", 2, "unknown option --shell"},
      {"man page", 2, "unexpected word page"},
      {"man --json -", 2, "unknown option --json"},
  });
}

TEST_F(OddArguments, OfGenerate) {
  expect({
      {"generate --config", 2, "--config has no value; expected --config FILE"},
      {"generate --config --threads 2", 2, "--config has no value"},
      {"generate --config ~", 2, "--config '': expected a file"},
      {"generate --config none.toml", 3, "none.toml: No such file"},
      {"generate --config d.toml", 3, "it is a folder"},
      {"generate --config d.h5", 3, "no regular file"},
      {"generate --config loop", 3, "loop"},
      {"generate --config seed.toml/", 3, "Not a directory"},
      {"generate --config open.toml", 2, "open.toml:1: not TOML"},
      {"generate --config bytes.toml", 2, "not TOML"},
      {"generate --config twice.toml", 2, "twice.toml:2: not TOML"},
      {"generate --config T.npy", 2, "not TOML"},
      {"generate --config text.h5", 2, "text.h5"},
      {"generate --config cut.h5", 2, "cut.h5"},
      {"generate --config empty.h5", 2, "empty.h5"},
      {"generate --config seed.toml --config seed.toml", 2, "--config is given 2 times"},
      {"generate -c seed.toml --config=seed.toml", 2, "--config is given 2 times"},
      {"generate --set", 2, "--set has no value"},
      {"generate --set ~", 2, "--set : expected key=value"},
      {"generate --set =", 2, "expected key=value"},
      {"generate --set fit.seed", 2, "expected key=value"},
      {"generate --set fit.seed=", 2, "expected a whole number"},
      {"generate --set fit.seed=-1", 2, "fit.seed = -1"},
      {"generate --set fit.seed=1e400", 2, "fit.seed"},
      {"generate --set fit.seed=99999999999999999999", 2, "fit.seed"},
      {"generate --set fit.seed=0x", 2, "fit.seed"},
      {"generate --set fit.seed=nan", 2, "fit.seed = nan"},
      {"generate --set fit.sead=1", 2, "did you mean fit.seed?"},
      {"generate --set table.alpha.nodes=1e9", 2, "[1, 64]"},
      {"generate --set table.theta.last_degrees=90.1", 2, "[0, 90]"},
      {"generate --set table.alpha.first=1", 2, "table.alpha.first = 1"},
      {"generate --set output.name=../T", 2, "a file name"},
      {"generate --set output.name=-x", 2, "a file name"},
      {"generate --set output.name=~", 2, "a file name"},
      {"generate --threads", 2, "--threads has no value"},
      {"generate --threads 0", 2, "--threads 0: expected a whole number in [1, 1024]"},
      {"generate --threads -1", 2, "--threads -1: expected a whole number in [1, 1024]"},
      {"generate --threads 1.5", 2, "--threads 1.5"},
      {"generate --threads 1e9", 2, "--threads 1e9"},
      {"generate --threads nan", 2, "--threads nan"},
      {"generate --threads two", 2, "--threads two"},
      {"generate --threads ~", 2, "--threads ''"},
      {"generate --threads 2 -t 2", 2, "--threads is given 2 times"},
      {"generate --checkpoint-seconds inf", 2, "expected a number in [0, 86400]"},
      {"generate --checkpoint-seconds 1s", 2, "expected a number in [0, 86400]"},
      {"generate --resume=yes^please", 2, "--resume takes no value"},
      {"generate --output", 2, "--output has no value"},
      {"generate -o ~", 2, "--output '': expected a folder"},
      {"generate -o T.h5", 3, "T.h5 is a file"},
      {"generate -o T.h5/x", 3, "T.h5/x"},
      {"generate -o loop", 3, "loop"},
      {"generate -o /dev/full", 3, "/dev/full"},
      {"generate --json d", 3, "it is a folder"},
      {"generate --json none/x", 3, "no folder none"},
      {"generate --scene none.toml", 3, "none.toml"},
      {"generate --scene nothing.toml", 2, "nothing.toml"},
      {"generate --scene open.gltf", 2, "open.gltf"},
      {"generate --scene empty.glb", 2, "empty.glb"},
      {"generate --scene d", 3, "it is a folder"},
      {"generate --scene T.h5", 2, "T.h5"},
      {"generate --scene ~", 2, "--scene ''"},
      {"generate --extend T.npy", 2, "--extend T.npy: expected a table's .h5"},
      {"generate --extend none.h5", 3, "none.h5"},
      {"generate --extend cut.h5", 2, "cut.h5"},
      {"generate --extend T.h5", 2, "T.h5"},  // another grid
      {"generate --outptu x", 2, "did you mean --output?"},
      {"generate --output-x x", 2, "unknown option --output-x"},
      {"generate -o dangling.h5", 3, "dangling.h5"},
      {"generate --output --json x", 2,
       "--output has no value; expected --output DIR, or --output=--json"},
      {"generate -tx", 2, "--threads x"},
      {"generate -q", 2, "unknown option -q"},
  });
}

TEST_F(OddArguments, OfFit) {
  expect({
      {"fit", 2, "no lobe named"},
      {"fit --entry", 2, "--entry has no value"},
      {"fit --entry ~", 2, "no lobe named"},
      {"fit --entry 1,1,1", 2, "--entry 1,1,1: expected"},
      {"fit --entry 1,1,1,1,1", 2, "expected"},
      {"fit --entry 1e0,1,1,1", 2, "expected"},
      {"fit --entry 99999999999999999999,0,0,0", 2, "expected"},
      {"fit --entry 1,1,1,1 --entry 1,1,1,1", 2, "--entry is given 2 times"},
      {"fit --entry 1,1,1,1 --theta 3", 2, "not by both"},
      {"fit --alpha-x 0.1", 2, "--theta is missing"},
      {"fit --alpha-x abc --alpha-y 1 --theta 0 --phi 0", 2, "--alpha-x abc: expected a number"},
      {"fit --alpha-x 0 --alpha-y 1 --theta 0 --phi 0", 2, "[1e-12, 1]"},
      {"fit --alpha-x nan --alpha-y 1 --theta 0 --phi 0", 2, "--alpha-x nan"},
      {"fit --alpha-x 1e-400 --alpha-y 1 --theta 0 --phi 0", 2, "--alpha-x 1e-400"},
      {"fit --alpha-x 0,1 --alpha-y 1 --theta 0 --phi 0", 2, "--alpha-x 0,1"},
      {"fit --alpha-x 1 --alpha-y 1 --theta 90 --phi 0", 2, "[0, 90)"},
      {"fit --alpha-x 1 --alpha-y 1 --theta 0 --phi 361", 2, "[-360, 360]"},
      {"fit --alpha-x 1 --alpha-y 1 --theta 0 --phi -1e99", 2, "[-360, 360]"},
      {"fit --entry 1,1,1,1 --solver best", 2, "expected gauss-newton, sgd or l3-nelder-mead"},
      {"fit --entry 1,1,1,1 --seed abc", 2, "--seed abc: expected a whole number in [0, 9007"},
      {"fit --entry 1,1,1,1 --seed 1e99", 2, "--seed 1e99"},
      {"fit --entry 1,1,1,1 --samples 1e6 --seed 1e3", 2, "fit.gauss_newton.samples"},
      {"fit --entry 1,1,1,1 --start from=", 2, "expected from= and a table's file"},
      {"fit --entry 1,1,1,1 --start from=d.h5", 3, "no regular file"},
      {"fit --entry 1,1,1,1 --start matrix=1,2,3", 2, "nine numbers"},
      {"fit --entry 1,1,1,1 --start matrix=", 2, "nine numbers"},
      {"fit --entry 1,1,1,1 --start middle", 2, "expected first-order"},
      {"fit --entry 1,1,1,1 --trace d", 3, "it is a folder"},
      {"fit --entry 1,1,1,1 --trace -", 2, "--trace -: expected a file"},
      {"fit --entry 1,1,1,1 --plot x.jpg", 2, "ends in .png"},
      {"fit --entry 1,1,1,1 --plot ~", 2, "ends in .png"},
      {"fit --entry 1,1,1,1 --plot none/x.png", 3, "no folder none"},
      {"fit --entry 1,1,1,1 --json", 2, "--json has no value; expected --json FILE"},
      {"fit --entry 1,1,1,1 --json ~", 2, "expected a file, or - for standard output"},
      {"fit --entry 1,1,1,1 --json d", 3, "it is a folder"},
      {"fit --as-in T.h5", 2, "no lobe named"},
      {"fit --as-in ~ --entry 0,0,0,0", 2, "--as-in ''"},
      {"fit --as-in T.h5 --entry 2,0,0,0", 2, "1,1,1,1"},
      {"fit --as-in T.h5 --entry 0,0,0,0 --seed 1", 2, "does not go with"},
      {"fit --as-in empty.npy --entry 0,0,0,0", 2, "empty.npy"},
      {"fit --as-in dangling.h5 --entry 0,0,0,0", 3, "dangling.h5"},
      {"fit --as-in byte\xff.h5 --entry 0,0,0,0 --json -", 0, "byte\xef\xbf\xbd.h5"},
      {"fit --scene seed.toml --entry 0,0,0,0", 2, "seed.toml"},
      {"fit --check-gradient=no --entry 0,0,0,0", 2, "--check-gradient takes no value"},
  });
}

TEST_F(OddArguments, OfCommandsOnTables) {
  expect({
      {"diff", 2, "A is missing"},
      {"diff T.h5", 2, "B is missing"},
      {"diff ~ T.h5", 2, "A '': expected a file"},
      {"diff T.h5 none.h5", 3, "none.h5"},
      {"diff T.h5 T.txt", 2, "no suffix of a table"},
      {"diff T.h5 d", 2, "no suffix of a table"},
      {"diff T.h5 d.h5", 3, "no regular file"},
      {"diff T.h5 cut.h5", 2, "cut.h5"},
      {"diff T.h5 empty.0.exr", 2, "empty.0.exr"},
      {"diff T.h5 T.h5 --tolerance -1", 2, "--tolerance -1: expected a number, 0 or more"},
      {"diff T.h5 T.h5 --tolerance nan", 2, "expected a number, 0 or more"},
      {"diff T.h5 T.h5 --tolerance 1e999", 2, "expected a number, 0 or more"},
      {"diff T.h5 T.h5 --samples 63", 2, "--samples 63: expected a whole number in [64, 1048576]"},
      {"diff T.h5 T.h5 --samples 64.5", 2, "--samples 64.5"},
      {"diff T.h5 T.h5 --directions 0", 2, "--directions 0"},
      {"diff T.h5 T.h5 --seed -1", 2, "--seed -1"},
      {"diff T.h5 T.h5 --seed ~", 2, "--seed ''"},
      {"diff T.h5 T.h5 --map x", 2, "ends in .png"},
      {"diff T.h5 T.h5 --csv", 2, "--csv has no value; expected --csv FILE"},
      {"diff T.h5 T.h5 --csv d", 3, "it is a folder"},
      {"diff T.h5 T.h5 --csv /dev/full", 3, "device"},
      {"diff t\xc3\xa4"
       "ble^\xe2\x98\x83.h5 T.h5 --samples 64 --directions 1e0 --queries 0",
       0, "\xe2\x98\x83"},
      {"diff ./-x.h5 -- -x.h5 --samples", 2, "--samples"},
      {"validate", 2, "TABLE is missing"},
      {"validate -x.h5", 2, "unknown option"},
      {"diff --samples 64 --directions 1 --queries 0 -- -x.h5 T.h5", 0, "A = -x.h5"},
      {"validate T.h5 T.h5", 2, "unexpected word T.h5"},
      {"validate T", 2, "no suffix of a table"},
      {"validate T.3.exr", 2, "of a folded table"},
      {"validate empty.h5", 2, "empty.h5"},
      {"validate empty.npy", 2, "empty.npy"},
      {"validate text.h5", 2, "text.h5"},
      {"validate loop", 2, "no suffix of a table"},
      {"validate T.h5 --config T.h5", 2, "T.h5"},
      {"validate T.h5 --set fit.seed=1", 2, "fit.seed"},
      {"validate T.h5 --set quality.queries=1e99", 2, "quality.queries"},
      {"validate T.h5 --report T.h5", 3, "T.h5 is a file"},
      {"validate T.h5 --report ~", 2, "--report '': expected a folder"},
      {"validate T.h5 --report d --no-quality", 2, "does not go with"},
      {"validate T.h5 --json=", 2, "--json"},
      {"validate T.h5 --json /dev/none", 3, "device or a pipe"},
      {"validate T.h5 --json /proc/self/none", 3, "device or a pipe"},
      {"validate T.h5 --json T.h5", 2, "is the same file as TABLE T.h5"},
      {"view", 2, "TABLE is missing"},
      {"view none.h5", 3, "none.h5"},
      {"view T.h5 T.h5 T.h5", 2, "T.h5"},
      {"view T.h5 -o ~", 2, "--output '': expected a file"},
      {"view T.h5 -o T.h5", 2, "expected a file that ends in .html"},
      {"view T.h5 -o d/none/x.html", 3, "d/none"},
      {"render", 2, "TABLE is missing"},
      {"render none.h5", 3, "none.h5"},
      {"render T.h5 --material 0.3", 2, "0.3"},
      {"render T.h5 --material ~", 2, "--material"},
      {"render T.h5 --material 0.3,nan", 2, "0.3,nan"},
      {"render T.h5 --alpha-x 0.3", 2, "--alpha-y"},
      {"render T.h5 --alpha-x 2 --alpha-y 1", 2, "--alpha-x 2: expected a number in [0.0001, 1]"},
      {"render T.h5 --size 7", 2, "--size 7: expected a whole number in [8, 2048]"},
      {"render T.h5 --size 1e9", 2, "--size 1e9"},
      {"render T.h5 --samples -1", 2, "--samples -1"},
      {"render T.h5 --f0 1.1", 2, "--f0 1.1: expected a number in [0, 1]"},
      {"render T.h5 --light-size x", 2, "--light-size x: expected a number in [0.001, 2]"},
      {"render T.h5 --table-b none.npy", 3, "none.npy"},
      {"render T.h5 -o x.jpg", 2, "--output x.jpg: expected a folder, or a file that ends in .png"},
      {"render T.h5 -o T.h5", 3, "T.h5 is a file"},
      {"render T.h5 -o none/x.png", 3, "no folder none"},
      {"bench --entries 0", 2, "--entries 0: expected a whole number in [1, 16777216]"},
      {"bench --entries 4 --all", 2, "does not go with"},
      {"bench --settings fast", 2, "\"fast\""},
      {"bench --settings ~,", 2, "--settings"},
      {"bench --settings config", 2, "\"config\""},
      {"bench --reference T.txt", 2, "no suffix of a table"},
      {"bench --reference T.h5 --csv T.h5", 2, "is the same file as --reference T.h5"},
      {"bench --published none.npy", 3, "none.npy"},
      {"bench --full-sgd 1.5", 2, "--full-sgd 1.5"},
      {"bench --picture x", 2, "ends in .png"},
      {"bench stray", 2, "unexpected word stray"},
      {"stress --solver x", 2, "expected gauss-newton, sgd or l3-nelder-mead"},
      {"stress --fits 0", 2, "--fits 0"},
      {"stress --fits 1e99", 2, "--fits 1e99"},
      {"stress --seed 0.5", 2, "--seed 0.5"},
      {"stress --map T.h5", 3, "T.h5 is a file"},
      {"stress --csv -", 2, "./-"},
      {"stress --quick=2x", 2, "--quick takes no value"},
  });
}

}  // namespace
}  // namespace ltc::test
