// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The same bits on any number of threads, through the real program: what is random has its seed.
#include <gtest/gtest.h>

#include "export/same_tables.h"
#include "export/table_file.h"
#include "support/program.h"

namespace ltc::test {
namespace {

// 81 entries; some copied, some analytic, some in the sweeps that see their neighbours.
const std::vector<std::string> small = {"generate",
                                        "--set",
                                        "table.alpha.nodes=3",
                                        "--set",
                                        "table.lambda.nodes=3",
                                        "--set",
                                        "table.theta.nodes=3",
                                        "--set",
                                        "table.phi.nodes=3"};

const std::vector<std::string> stochastic = {
    "--set", "fit.solver=sgd",     "--set", "fit.target=rejection", "--set", "fit.sgd.steps=5",
    "--set", "fit.sgd.samples=64", "--set", "fit.sgd.directions=4"};

struct Run {
  Table table;
  std::vector<std::string> other_files;  // the bytes of textures and array
};

Run run(std::vector<std::string> more) {
  const TemporaryDirectory folder;
  std::vector<std::string> arguments = small;
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {"--output", folder.path().string()});
  const ProgramResult result = run_ltcfit(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Run run{read_table(folder / "ltc.h5"), {}};
  run.table.created.clear();  // the one thing that may differ
  for (const char* name : {"ltc.0.exr", "ltc.1.exr", "ltc.2.exr", "ltc.npy"})
    run.other_files.push_back(read_file(folder / name));
  return run;
}

void expect_same_on_any_threads(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"--threads", "1"});
  const Run one = run(settings);
  for (const char* threads : {"2", "3", "16"}) {
    SCOPED_TRACE(std::string(threads) + " threads");
    settings.back() = threads;
    const Run other = run(settings);
    testing::expect_same_tables(other.table, one.table);
    EXPECT_EQ(other.other_files, one.other_files);
  }
}

TEST(SameBits, OnAnyNumberOfThreadsInEveryStorage) {
  for (const std::string storage : {"matrix", "roughness-scaled", "mirror-frame"}) {
    SCOPED_TRACE(storage);
    expect_same_on_any_threads({"--set", "table.storage=" + storage});
  }
}

TEST(SameBits, OnAnyNumberOfThreadsWithAStochasticSolver) {
  expect_same_on_any_threads(stochastic);
}

TEST(SameBits, OnAnyNumberOfThreadsWithRefinement) {
  const std::vector<std::string> refined = {"--set", "refine.steps=3",
                                            "--set", "refine.queries_per_cell=30",
                                            "--set", "refine.held_out_queries=100",
                                            "--set", "refine.roughness_first=0.5"};
  expect_same_on_any_threads(refined);
  // The refinement did something.
  EXPECT_NE(run(refined).table.stored, run({}).table.stored);
}

// The mathematical library picks its sines and logarithms by the processor, too: other ones where
// that has no fused products. The kernels go by the processor itself and stay as they are.
class OlderMathematicalLibrary {
 public:
  OlderMathematicalLibrary() {
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4", 1);
  }
  ~OlderMathematicalLibrary() { unsetenv("GLIBC_TUNABLES"); }
};

// Of a hundred thousand sines, to the last bit.
std::string checksum_of_sines() {
  return run_program({"/usr/bin/python3", "-c",
                      "import math, struct, zlib\n"
                      "sines = (math.sin(3.1e-6 * i) for i in range(1, 100000))\n"
                      "print(zlib.crc32(b''.join(struct.pack('d', sine) for sine in sines)))"})
      .out;
}

TEST(SameBits, WithTheMathematicalLibraryOfAnOlderProcessor) {
  const auto here = run({});
  const std::string sines = checksum_of_sines();
  const OlderMathematicalLibrary older;
  if (checksum_of_sines() == sines)
    GTEST_SKIP() << "this system has but one kind of sines";
  const auto there = run({});
  testing::expect_same_tables(there.table, here.table);
  EXPECT_EQ(there.other_files, here.other_files);
}

TEST(SameBits, AnotherSeedChangesWhatIsRandomAndNothingElse) {
  const auto with_seed = [](std::vector<std::string> settings, const char* seed) {
    settings.insert(settings.end(), {"--set", std::string("fit.seed=") + seed});
    return run(settings).table;
  };
  const Table one = with_seed(stochastic, "1"), two = with_seed(stochastic, "2");
  EXPECT_NE(one.stored, two.stored);
  EXPECT_NE(one.sw_loss, two.sw_loss);
  EXPECT_EQ(one.amplitude, two.amplitude);
  EXPECT_EQ(one.status, two.status);
  EXPECT_EQ(two.seed, 2u);
  // The default has nothing random: its starts and sets are fixed.
  EXPECT_EQ(with_seed({}, "1").stored, with_seed({}, "2").stored);
}

}  // namespace
}  // namespace ltc::test
