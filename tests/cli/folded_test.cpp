// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables of folded lobes through the real program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/refused_run.h"
#include "test_paths.h"

namespace ltc::test {
namespace {

using Arguments = std::vector<std::string>;

// Three nodes an axis, few look-ups.
Arguments make_table(const char* folder) {
  Arguments arguments = {"generate", "--config", LTCFIT_SOURCE_DIR "/config/folded.toml", "-o",
                         folder};
  for (const char* set :
       {"table.alpha.nodes=3", "table.lambda.nodes=3", "table.theta.nodes=3", "table.phi.nodes=3",
        "field.queries=1000", "refine.steps=2", "refine.queries_per_cell=4",
        "refine.held_out_queries=100"})
    arguments.insert(arguments.end(), {"--set", set});
  return arguments;
}

TEST(FoldedCommands, ATableGoesWhereTablesGo) {
  const TemporaryDirectory folder;
  const ProgramResult made = run_ltcfit(make_table("t"), folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("refined  2 steps"), std::string::npos) << made.out;
  EXPECT_EQ(names_in(folder / "t"), (std::vector<std::string>{"ltc.0.exr", "ltc.1.exr", "ltc.2.exr",
                                                             "ltc.3.exr", "ltc.h5"}));
  folder.write("q.csv", "alpha_x,alpha_y,theta,phi\n0.3,0.1,0.5,0.2\n0.1,0.3,0.5,4\n");
  const ProgramResult found = run_ltcfit({"lookup", "t/ltc.h5", "-q", "q.csv"}, folder.path());
  EXPECT_NE(found.out.find("amplitude,fresnel,k,g\n"), std::string::npos) << found.out << found.err;
  // OpenEXR holds the same, and can be had from HDF5 again.
  EXPECT_EQ(run_ltcfit({"lookup", "t/ltc.0.exr", "-q", "q.csv"}, folder.path()).out, found.out);
  ASSERT_EQ(run_ltcfit({"convert", "t/ltc.h5", "-o", "c.0.exr"}, folder.path()).exit_code, 0);
  EXPECT_EQ(read_file(folder / "c.3.exr"), read_file(folder / "t/ltc.3.exr"));
  for (const Arguments& arguments : std::vector<Arguments>{
           {"fit", "--as-in", "t/ltc.h5", "--entry", "1,1,1,1", "--plot", "p.png"},
           {"fit", "--as-in", "t/ltc.h5", "--alpha-x", "0.3", "--alpha-y", "0.1", "--theta", "60",
            "--phi", "40"},
           {"fit", "--config", "t/ltc.h5", "--entry", "1,1,1,1"},
           {"render", "t/ltc.h5", "--size", "16", "--samples", "16", "-o", "r"},
           {"convert", "t/ltc.h5", "-o", "t.glsl"},
           {"view", "t/ltc.h5", "-o", "v.html"},
           {"diff", "t/ltc.h5", "t/ltc.0.exr", "--queries", "20", "--tolerance", "0.001"}}) {
    const ProgramResult result = run_ltcfit(arguments, folder.path());
    EXPECT_EQ(result.exit_code, 0) << arguments[0] << ": " << result.err;
  }
  const ProgramResult judged = run_ltcfit(
      {"validate", "t/ltc.h5", "--set", "quality.queries=20", "--report", "page"}, folder.path());
  // So coarse a table need not pass.
  EXPECT_LE(judged.exit_code, 1) << judged.err;
  EXPECT_NE(judged.out.find("fold one to one"), std::string::npos) << judged.out;
  EXPECT_EQ(names_in(folder / "page").size(), 1u);
  for (const char* other : {"t.npy", "t.dds"})
    expect_error(run_ltcfit({"convert", "t/ltc.h5", "-o", other}, folder.path()), 2,
                 {"cannot hold"});
}

TEST(FoldedCommands, UnrefinedNodesAreFittedEach) {
  const TemporaryDirectory folder;
  Arguments make = make_table("t");
  make.insert(make.end(), {"--set", "refine.steps=0", "--json", "s.json"});
  const ProgramResult made = run_ltcfit(make, folder.path());
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult entry =
      run_ltcfit({"fit", "--as-in", "t/ltc.h5", "--entry", "2,1,1,2", "--json", "-"}, folder.path());
  const nlohmann::json stored = nlohmann::json::parse(entry.out);
  EXPECT_EQ(stored["status"], "fitted");
  // Bent: 0.6 of an LTC's loss.
  EXPECT_LT(stored["loss"]["held_out"], 0.8 * stored["floor"]["loss"]["held_out"].get<double>());
  EXPECT_LT(stored["fold"]["k"], -0.1);
}

TEST(FoldedCommands, TheSameBytesForAnyNumberOfThreadsAndThatAreAddedTo) {
  const TemporaryDirectory folder;
  Arguments one = make_table("a"), three = make_table("b");
  one.insert(one.end(), {"--threads", "1"});
  three.insert(three.end(), {"--threads", "3"});
  ASSERT_EQ(run_ltcfit(one, folder.path()).exit_code, 0);
  ASSERT_EQ(run_ltcfit(three, folder.path()).exit_code, 0);
  for (const char* name : {"ltc.0.exr", "ltc.3.exr"})
    EXPECT_EQ(read_file(folder / "a" / name), read_file(folder / "b" / name)) << name;
  folder.write("s.toml", "[[material]]\nname = \"m\"\nalpha_x = 0.9\nalpha_y = 0.8\n");
  Arguments part = make_table("p"), rest = make_table("r");
  part.insert(part.end(), {"--scene", "s.toml"});
  rest.insert(rest.end(), {"--extend", "p/ltc.h5"});
  const ProgramResult first = run_ltcfit(part, folder.path());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ProgramResult second = run_ltcfit(rest, folder.path());
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(run_ltcfit({"validate", "r/ltc.h5", "--no-quality"}, folder.path())
                .err.find("is nan"),
            std::string::npos);
}

}  // namespace
}  // namespace ltc::test
