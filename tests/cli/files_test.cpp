// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// No output of any command takes the place of an input or of another output, through the real
// program.
#include <gtest/gtest.h>

#include "support/generate_runs.h"
#include "support/refused_run.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using namespace runs;

const Arguments unrefined = tiny + Arguments{"--set", "refine.steps=0"};

// A folder with a table of 16 entries, T.h5 and T.*.exr, and with a config, a scene and folders.
class OutputFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    table_ = new TemporaryDirectory;
    const ProgramResult made =
        run_ltcfit(generate(unrefined + Arguments{"--set", "output.name=T"}), table_->path());
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  static void TearDownTestSuite() {
    delete table_;
    table_ = nullptr;
  }

  void SetUp() override {
    for (const std::string name : {"T.h5", "T.0.exr", "T.1.exr", "T.2.exr"})
      fs::copy(*table_ / name, folder_ / name);
    folder_.write("c.toml", "[fit]\nseed = 2\n");
    folder_.write("s.toml", "[[material]]\nalpha_x = 0.3\nalpha_y = 0.1\n");
    fs::create_directory(folder_ / "maps");
    fs::create_directory_symlink(".", folder_ / "here");
    fs::create_symlink("T.h5", folder_ / "soft.h5");
    fs::create_hard_link(folder_ / "T.h5", folder_ / "hard.h5");
    before_ = names_in(folder_.path());
  }

  // Refused with one line that names both, and nothing touched.
  void expect_kept(const Arguments& command, const Arguments& parts) {
    const Files content = contents();
    expect_error(run_ltcfit(command, folder_.path()), 2, parts + Arguments{"is the same file as"});
    EXPECT_EQ(names_in(folder_.path()), before_);
    EXPECT_EQ(contents(), content);
  }

  Files contents() const {
    Files content;
    for (const std::string name : {"T.h5", "T.0.exr", "T.1.exr", "T.2.exr", "c.toml", "s.toml"})
      content[name] = read_file(folder_ / name);
    return content;
  }

  static TemporaryDirectory* table_;
  TemporaryDirectory folder_;
  std::vector<std::string> before_;
};
TemporaryDirectory* OutputFiles::table_ = nullptr;

TEST_F(OutputFiles, AreNoInputByAnyName) {
  const std::string absolute = (folder_ / "T.h5").string();
  for (const std::string& name :
       {std::string("T.h5"), std::string("./T.h5"), std::string("maps/../T.h5"),
        std::string("here/T.h5"), std::string("soft.h5"), std::string("hard.h5"), absolute}) {
    SCOPED_TRACE(name);
    expect_kept({"validate", "T.h5", "--json", name}, {"--json " + name, "TABLE T.h5"});
    expect_kept({"validate", name, "--json", "T.h5"}, {"--json T.h5", "TABLE " + name});
  }
}

TEST_F(OutputFiles, AreNoInputOfAnyCommand) {
  const auto kept = [&](const Arguments& command, const std::string& output,
                        const std::string& input) {
    SCOPED_TRACE(output + " and " + input);
    expect_kept(command, {output, input});
  };
  kept({"validate", "T.h5", "--config", "c.toml", "--json", "c.toml"}, "--json c.toml",
       "--config c.toml");
  kept({"validate", "T.0.exr", "--json", "T.2.exr"}, "--json T.2.exr", "TABLE T.2.exr");
  kept({"diff", "T.h5", "T.0.exr", "--csv", "T.0.exr"}, "--csv T.0.exr", "B T.0.exr");
  kept({"diff", "T.0.exr", "T.h5", "--json", "T.h5"}, "--json T.h5", "B T.h5");
  const Arguments fit = {"fit", "--entry", "1,1,1,1"};
  kept(fit + Arguments{"--config", "c.toml", "--trace", "c.toml"}, "--trace c.toml",
       "--config c.toml");
  kept(fit + Arguments{"--config", "T.h5", "--json", "T.h5"}, "--json T.h5", "--config T.h5");
  kept(fit + Arguments{"--start", "from=T.h5", "--trace", "T.h5"}, "--start T.h5", "--trace T.h5");
  kept(fit + Arguments{"--scene", "s.toml", "--trace", "s.toml"}, "--trace s.toml",
       "--scene s.toml");
  kept({"fit", "--as-in", "T.h5", "--entry", "1,1,1,1", "--json", "hard.h5"}, "--json hard.h5",
       "--as-in T.h5");
  const Arguments bench = {"bench", "--entries", "1", "--settings", "default"};
  kept(bench + Arguments{"--reference", "T.h5", "--csv", "T.h5"}, "--csv T.h5", "--reference T.h5");
  kept(bench + Arguments{"--published", "T.1.exr", "--json", "T.0.exr"}, "--json T.0.exr",
       "--published T.0.exr");
  kept(bench + Arguments{"--config", "c.toml", "--csv", "c.toml"}, "--csv c.toml",
       "--config c.toml");
  kept({"stress", "--quick", "--config", "c.toml", "--csv", "c.toml"}, "--csv c.toml",
       "--config c.toml");
  kept({"render", "T.h5", "--table-b", "T.0.exr", "--json", "T.0.exr"}, "--json T.0.exr",
       "--table-b T.0.exr");
}

TEST_F(OutputFiles, InAFolderAreNoInputEither) {
  expect_kept(generate({"--config", "T.h5", "--set", "output.name=T"}),
              {"--output ./T.h5", "--config T.h5"});
  expect_kept(generate({"--config", "T.h5", "--json", "T.h5"}), {"--json T.h5", "--config T.h5"});
  // Files of one command that are called alike whatever it is told.
  fs::create_hard_link(folder_ / "T.h5", folder_ / "maps/index.html");
  expect_kept({"validate", "T.h5", "--report", "maps"}, {"--report maps/index.html", "TABLE T.h5"});
  fs::create_hard_link(folder_ / "c.toml", folder_ / "maps/stress-sgd-loss.png");
  expect_kept({"stress", "--quick", "--config", "c.toml", "--solver", "sgd", "--map", "maps"},
              {"--map maps/stress-sgd-loss.png", "--config c.toml"});
  fs::create_hard_link(folder_ / "T.0.exr", folder_ / "maps/spheres_0.5_1.exr");
  expect_kept({"render", "T.0.exr", "-o", "maps"},
              {"--output maps/spheres_0.5_1.exr", "TABLE T.0.exr"});
}

TEST_F(OutputFiles, AreNoOtherOutput) {
  expect_kept({"diff", "T.h5", "T.h5", "--json", "new", "--csv", "maps/../new"},
              {"--csv maps/../new", "--json new"});
  expect_kept({"fit", "--entry", "1,1,1,1", "--trace", "a.png", "--plot", "here/a.png"},
              {"--plot here/a.png", "--trace a.png"});
  expect_kept(generate(tiny + Arguments{"--json", "ltc.npy"}), {"--output ./ltc.npy", "--json"});
  expect_kept(generate(tiny + Arguments{"--json", "./ltc.checkpoint.h5"}),
              {"--output ./ltc.checkpoint.h5", "--json"});
  expect_kept({"render", "T.h5", "-o", ".", "--json", "spheres.png"},
              {"--output ./spheres.png", "--json spheres.png"});
}

// What the table holds stays, bit for bit: the one output that may take an input's place.
TEST_F(OutputFiles, MayBeTheTableThatIsExtended) {
  const Arguments extend = unrefined + Arguments{"--extend", "T.h5", "--set", "output.name=T"};
  const ProgramResult result = run_ltcfit(generate(extend), folder_.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_table(folder_ / "T.h5").stored, read_table(*table_ / "T.h5").stored);
}

// What cannot be written is refused before there is anything to write.
TEST_F(OutputFiles, AreTriedBeforeTheWork) {
  const auto refused = [&](const Arguments& command, int exit_code, const Arguments& parts) {
    const ProgramResult result = run_ltcfit(command, folder_.path());
    expect_error(result, exit_code, parts);
    EXPECT_EQ(names_in(folder_.path()), before_);
  };
  const std::string long_name(300, 'x');
  for (const std::string option : {"--json", "--csv"}) {
    const auto diff = [&](const std::string& file) {
      return Arguments{"diff", "T.h5", "T.h5", option, file};
    };
    refused(diff("/dev/full"), 3, {"cannot write /dev/full", "device or a pipe"});
    refused(diff("maps"), 3, {"cannot write maps", "is a folder"});
    refused(diff("none/x"), 3, {"cannot write none/x", "no folder none"});
    refused(diff("c.toml/x"), 3, {"cannot write c.toml/x", "no folder c.toml"});
    refused(diff("/proc/self/x"), 3, {"cannot write /proc/self/x"});
    refused(diff(long_name), 3, {"cannot write xxx", "File name too long"});
    refused(diff(""), 2, {option + " ''", "expected a file"});
  }
  refused({"diff", "T.h5", "T.h5", "--csv", "-"}, 2, {"--csv -", "./-"});
  refused({"fit", "--entry", "1,1,1,1", "--plot", "none/x.png"}, 3, {"no folder none"});
  refused({"render", "T.h5", "-o", "none/x.png"}, 3, {"no folder none"});
  refused(generate({"--extend", "T.npy"}), 2, {"--extend T.npy", "a table's .h5"});
}

}  // namespace
}  // namespace ltc::test
