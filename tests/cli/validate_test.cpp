// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit validate, through the real program: what it passes, what it finds, what it refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "export/table_file.h"
#include "support/broken_table.h"
#include "support/reference.h"
#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::vector<std::string> four_nodes = {
    "--set", "table.alpha.nodes=4", "--set", "table.lambda.nodes=4", "--set", "table.theta.nodes=4",
    "--set", "table.phi.nodes=4",   "--set", "refine.steps=0"};

// A table of 256 entries, made by the program once for all tests.
class Validate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryDirectory;
    std::vector<std::string> arguments = {"generate", "--output", folder_->path().string()};
    arguments.insert(arguments.end(), four_nodes.begin(), four_nodes.end());
    ASSERT_EQ(run_ltcfit(arguments).exit_code, 0);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static fs::path good() { return *folder_ / "ltc.h5"; }
  static fs::path in_folder(std::string_view name) { return *folder_ / name; }

 private:
  static inline TemporaryDirectory* folder_ = nullptr;
};

std::set<std::string> failed_entries(const Json& invariant) {
  std::set<std::string> entries;
  for (const Json& entry : invariant["failed_entries"])
    entries.insert(entry["entry"]);
  return entries;
}

const Json& named(const Json& report, const std::string& name) {
  for (const Json& invariant : report["invariants"])
    if (invariant["name"] == name)
      return invariant;
  throw std::runtime_error("no invariant " + name);
}

std::set<std::string> failed_names(const Json& report) {
  std::set<std::string> names;
  for (const Json& invariant : report["invariants"])
    if (invariant["passed"] == false)
      names.insert(invariant["name"]);
  return names;
}

TEST_F(Validate, PassesAGoodTable) {
  const TemporaryDirectory folder;
  const ProgramResult result = run_ltcfit(
      {"validate", "--no-quality", good().string(), "--json", "report.json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.out.find("FAILED"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(good().string() + ": 4x4x4x4 entries, storage matrix, 0 skipped\n"),
            std::string::npos)
      << result.out;
  const Json report = Json::parse(read_file(folder / "report.json"));
  EXPECT_EQ(report["table"], good().string());
  EXPECT_EQ(report["passed"], true);
  EXPECT_EQ(report["refined"], false);
  EXPECT_EQ(report["bits"], 32);
  EXPECT_EQ(report["invariants"].size(), 15u);
  for (const Json& invariant : report["invariants"]) {
    EXPECT_EQ(invariant["passed"], true) << invariant;
    EXPECT_NE(result.out.find(std::string("\n").append(invariant["name"]).append(" ")),
              std::string::npos)
        << result.out;
  }
  // The worst entry comes with the commands that show what the table holds, and its fit.
  const Json& worst = named(report, "condition number")["worst"];
  const std::string entry = worst["entry"];
  EXPECT_EQ(worst["command"], "ltcfit fit --as-in " + good().string() + " --entry " + entry);
  EXPECT_EQ(worst["fit_command"], "ltcfit fit --config " + good().string() + " --entry " + entry);
}

TEST_F(Validate, TheCommandsOfAnEntryShowWhatIsStoredAndWhatWasFitted) {
  const TemporaryDirectory folder;
  break_table(good(), folder / "bad.h5", "scaled", "2,1,1,2");
  const ProgramResult result =
      run_ltcfit({"validate", "--no-quality", (folder / "bad.h5").string()});
  ASSERT_EQ(result.exit_code, 1) << result.err;
  const auto shown_by = [&](const std::string& label) {
    const std::size_t line = result.out.find(label);
    EXPECT_NE(line, std::string::npos) << result.out;
    const std::size_t begin = result.out.find("ltcfit fit ", line);
    const std::string command = result.out.substr(begin, result.out.find('\n', begin) - begin);
    EXPECT_TRUE(command.ends_with("--entry 2,1,1,2")) << command;
    const ProgramResult fit = run_program(
        {"sh", "-c", std::string(LTCFIT_PROGRAM).append(command, 6).append(" --json -")});
    EXPECT_EQ(fit.exit_code, 0) << fit.err;
    return Json::parse(fit.out)["matrix"]["stored"];
  };
  const Json stored = shown_by("in the table:"), fitted = shown_by("fitted anew:");
  for (const auto& [file, shown] : {std::pair{folder / "bad.h5", stored}, {good(), fitted}}) {
    const Table table = read_table(file);
    const Eigen::Matrix3d expected = table.stored_at(table.grid.flat({2, 1, 1, 2}));
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        EXPECT_EQ(shown[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)],
                  expected(row, column));
  }
}

// What is no table any more is refused: by name of the attribute, dataset or entry.
TEST_F(Validate, RefusesATableWhoseValuesOrShapeAreBroken) {
  const TemporaryDirectory folder;
  const fs::path bad = folder / "bad.h5";
  const auto refused = [&](const std::string& fault, const std::vector<std::string>& parts) {
    break_table(good(), bad, fault, "2,1,1,2");
    std::vector<std::string> all = {bad.string()};
    all.insert(all.end(), parts.begin(), parts.end());
    expect_refused({"validate", bad.string()}, 2, all);
  };
  refused("nan", {"matrix", "entry (2, 1, 1, 2)", "not finite"});
  refused("attribute", {"attribute storage", "missing"});
  refused("shape", {"dataset amplitude", "(16, 4, 4)", "(4, 4, 4, 4)"});
}

// A fault of an entry is a check that fails and names that entry alone.
TEST_F(Validate, NamesTheEntryThatIsBroken) {
  struct Case {
    std::string fault;
    std::string named_first;
    std::set<std::string> failed;  // besides `named_first`, at least
    std::set<std::string> entries = {"2,1,1,2"};
  };
  const std::vector<Case> cases = {
      {"rotated", "alignment", {"stored loss", "neighbours"}},
      {"scaled", "third column", {}},
      {"negated", "determinant", {"stored loss", "neighbours"}},
      {"singular", "determinant", {"condition number"}},
      {"swapped", "stored loss", {"neighbours"}, {"2,1,1,2", "2,1,2,2"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.fault);
    const TemporaryDirectory folder;
    break_table(good(), folder / "bad.h5", c.fault, "2,1,1,2");
    const ProgramResult result =
        run_ltcfit({"validate", "--no-quality", "bad.h5", "--json", "report.json"}, folder.path());
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.out.find(c.named_first + " fails at "), std::string::npos) << result.out;
    const Json report = Json::parse(read_file(folder / "report.json"));
    EXPECT_EQ(report["passed"], false);
    EXPECT_EQ(failed_entries(named(report, c.named_first)), c.entries);
    const std::set<std::string> failed = failed_names(report);
    for (const std::string& name : c.failed)
      EXPECT_TRUE(failed.contains(name)) << name << "\n" << result.out;
    for (const std::string& name : failed)
      for (const std::string& entry : failed_entries(named(report, name)))
        EXPECT_TRUE(c.entries.contains(entry)) << name << " names " << entry;
    // The last line of standard error: the check, and one of the entries.
    const std::size_t message = result.err.find("ltcfit: bad.h5: " + c.named_first + " of entry ");
    ASSERT_NE(message, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find('\n', message), result.err.size() - 1) << result.err;
    EXPECT_TRUE(c.entries.contains(
        result.err.substr(message + 26 + c.named_first.size(), std::string("2,1,1,2").size())))
        << result.err;
  }
}

TEST_F(Validate, SaysWhatAFileDoesNotHold) {
  const ProgramResult array =
      run_ltcfit({"validate", "--no-quality", in_folder("ltc.npy").string()});
  EXPECT_EQ(array.exit_code, 0) << array.out << array.err;
  const ProgramResult texture =
      run_ltcfit({"validate", "--no-quality", in_folder("ltc.0.exr").string()});
  EXPECT_EQ(texture.exit_code, 0) << texture.out << texture.err;
  const auto unchecked = [](const std::string& out) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = out.find("not in the file\n", at)) != std::string::npos; ++at)
      ++count;
    return count;
  };
  EXPECT_EQ(unchecked(array.out), 3u) << array.out;
  EXPECT_EQ(unchecked(texture.out), 1u) << texture.out;
}

// Of a file that does not say whether the table was refined, what holds for both kinds is demanded.
TEST_F(Validate, JudgesWithoutKnowingWhetherTheTableIsRefined) {
  const TemporaryDirectory folder;
  ASSERT_EQ(run_ltcfit({"generate", "-o", folder.path().string(), "--set", "table.alpha.nodes=4",
                        "--set", "table.lambda.nodes=4", "--set", "table.theta.nodes=4", "--set",
                        "table.phi.nodes=4", "--set", "refine.steps=4"})
                .exit_code,
            0);
  // With so few nodes, those at alpha = 0 jump far.
  const auto out = [&](const char* file) {
    const ProgramResult result =
        run_ltcfit({"validate", "--no-quality", file, "--set", "invariants.neighbour_excess=1e9"},
                   folder.path());
    EXPECT_EQ(result.exit_code, 0) << file << result.out << result.err;
    return result.out;
  };
  for (const char* file : {"ltc.h5", "ltc.0.exr"}) {
    EXPECT_NE(out(file).find("\nrefined for what lies between the nodes\n"), std::string::npos);
    EXPECT_NE(out(file).find("not checked: nodes of a refined table"), std::string::npos);
  }
  EXPECT_NE(out("ltc.npy").find("\nrefined: unknown, the file does not say; judged by limits that "
                                "hold for both kinds\n"),
            std::string::npos);
  EXPECT_EQ(out("ltc.npy").find("alignment fails"), std::string::npos);
}

TEST_F(Validate, Passes16BitTexturesAndSaysWhatTheyAre) {
  const TemporaryDirectory folder;
  for (const char* storage : {"matrix", "roughness-scaled", "mirror-frame"}) {
    std::vector<std::string> arguments = {"generate", "--set", "output.exr_half=true", "--set",
                                          std::string("table.storage=") + storage};
    arguments.insert(arguments.end(), four_nodes.begin(), four_nodes.end());
    ASSERT_EQ(run_ltcfit(arguments, folder.path()).exit_code, 0);
    const ProgramResult result =
        run_ltcfit({"validate", "--no-quality", "out/ltc.0.exr"}, folder.path());
    EXPECT_EQ(result.exit_code, 0) << storage << result.out << result.err;
    EXPECT_NE(result.out.find("\n16-bit values, not refined\n"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("not checked: its values have 16 bits already"), std::string::npos);
  }
  // The limits of 32 bits are no limits for them.
  EXPECT_EQ(run_ltcfit({"validate", "--no-quality", "out/ltc.0.exr", "--set",
                        "invariants.unit_length=1e-6"},
                       folder.path())
                .exit_code,
            1);
}

TEST_F(Validate, ListsEachLobeOnce) {
  const TemporaryDirectory folder;
  Table table = read_table(good());
  for (std::size_t phi = 0; phi < 4; ++phi) {
    const std::size_t flat = table.grid.flat({2, 1, 0, phi});
    table.set_stored(flat, 1.5 * table.stored_at(flat));
  }
  write_table(table, folder / "bad.h5");
  const ProgramResult result =
      run_ltcfit({"validate", "--no-quality", (folder / "bad.h5").string()});
  EXPECT_EQ(result.exit_code, 1);
  const std::size_t list =
      result.out.find("third column fails at 4 entries, worst first:\n  2,1,0,");
  ASSERT_NE(list, std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\n  and 3 more; --json lists all\n", list), std::string::npos)
      << result.out;
}

TEST_F(Validate, LimitsComeFromTheConfig) {
  const TemporaryDirectory folder;
  const fs::path config =
      folder.write("strict.toml", "[invariants]\ncondition_number = 10.0\nsamples = 1024\n");
  const ProgramResult strict =
      run_ltcfit({"validate", "--no-quality", good().string(), "--config", config.string()});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_NE(strict.err.find("condition number of entry "), std::string::npos) << strict.err;
  EXPECT_NE(strict.err.find("allowed at most 10\n"), std::string::npos) << strict.err;
  EXPECT_NE(strict.out.find(" more; --json lists all\n"), std::string::npos) << strict.out;
  const ProgramResult shipped = run_ltcfit({"validate", "--no-quality", good().string(), "--config",
                                            LTCFIT_SOURCE_DIR "/config/validate.toml"});
  EXPECT_EQ(shipped.exit_code, 0) << shipped.err;
  EXPECT_EQ(shipped.out, run_ltcfit({"validate", "--no-quality", good().string()}).out);
}

TEST_F(Validate, TakesATableOfAScene) {
  const TemporaryDirectory folder;
  folder.write("scene.toml", "[[material]]\nname = \"m\"\nalpha_x = 0.5\nalpha_y = 0.1\n");
  std::vector<std::string> arguments = {"generate", "--scene", "scene.toml"};
  arguments.insert(arguments.end(), four_nodes.begin(), four_nodes.end());
  ASSERT_EQ(run_ltcfit(arguments, folder.path()).exit_code, 0);
  const ProgramResult result =
      run_ltcfit({"validate", "--no-quality", "out/ltc.h5"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.out.find(" 0 skipped"), std::string::npos) << result.out;
}

TEST_F(Validate, RefusesBadInputInOneLine) {
  const TemporaryDirectory folder;
  const std::string table = good().string();
  expect_refused({"validate"}, 2, {"TABLE is missing"});
  expect_refused({"validate", "none.h5"}, 3, {"none.h5", "No such file"});
  expect_refused({"validate", folder.write("t.txt", "x").string()}, 2, {"t.txt", ".h5", ".npy"});
  const std::string whole = read_file(good());
  expect_refused({"validate", folder.write("cut.h5", whole.substr(0, whole.size() / 2)).string()},
                 2, {"cut.h5"});
  expect_refused({"validate", table, "--set", "invariants.zeros=1"}, 2,
                 {"--set", "invariants.zeros", "did you mean invariants.zero?"});
  expect_refused({"validate", table, "--config", "none.toml"}, 3, {"none.toml"});
  expect_refused({"validate", table, "--json", folder.path().string()}, 3, {"is a folder"});
  expect_refused({"validate", table, "--json", "none/r.json"}, 3, {"no folder none"});
  expect_refused({"validate", table, "--threads", "0"}, 2, {"--threads"});
}

TEST(ValidatePublished, TheMirroredMatricesAreFound) {
  const fs::path file = reference_file("upstream_alpha_lambda_theta_phi.npy");
  if (!fs::exists(file))
    GTEST_SKIP() << "no " << file << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const TemporaryDirectory folder;
  const ProgramResult result =
      run_ltcfit({"validate", "--no-quality", file.string(), "--json", "r.json"}, folder.path());
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const Json report = Json::parse(read_file(folder / "r.json"));
  EXPECT_EQ(failed_entries(named(report, "determinant")).size(), 48u);
  // Of an array it is not known whether it was refined; of this one it is.
  const std::set<std::string> of_any = {"determinant", "condition number", "half precision"};
  EXPECT_EQ(failed_names(report), of_any);
  run_ltcfit({"validate", "--no-quality", file.string(), "--json", "u.json", "--config",
              LTCFIT_SOURCE_DIR "/config/validate.toml"},
             folder.path());
  std::set<std::string> of_unrefined = of_any;
  of_unrefined.insert({"alignment", "neighbours"});
  EXPECT_EQ(failed_names(Json::parse(read_file(folder / "u.json"))), of_unrefined);
  EXPECT_NEAR(named(report, "condition number")["value"].get<double>(), 2.69e8, 0.01e8);
  EXPECT_EQ(named(report, "stored loss")["checked"], false);
  EXPECT_TRUE(named(report, "stored loss")["passed"].is_null());
}

}  // namespace
}  // namespace ltc::test
