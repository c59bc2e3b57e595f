// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/progress.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "support/program.h"
#include "test_paths.h"

namespace ltc::cli {
namespace {

TEST(Progress, BarShowsShareRateAndTimeLeft) {
  const StageState half{"fit", 2048, 4096, 4.0};
  EXPECT_EQ(bar_text(half, 200),
            "fit         [==========>         ]  50 %  2048/4096  512/s  4.0 s left");
  EXPECT_EQ(line_text(half), "fit: 2048 of 4096, 512/s, 4.0 s left");
  EXPECT_EQ(line_text({"refine", 2048, 4096, 4.0}),
            "refine: 2048 of 4096 evaluations of queries, 512/s, 4.0 s left");
}

TEST(Progress, NothingIsPromisedBeforeTheFirstUnit) {
  const StageState begun{"fit", 0, 4096, 0.0};
  EXPECT_EQ(bar_text(begun, 200), "fit         [>                   ]   0 %  0/4096");
  EXPECT_EQ(line_text(begun), "fit: 0 of 4096");
}

TEST(Progress, BarIsFullAtTheEnd) {
  const StageState done{"fit", 10, 10, 5.0};
  EXPECT_EQ(bar_text(done, 200),
            "fit         [====================] 100 %  10/10  2.0/s  0.00 s left");
}

TEST(Progress, BarFitsTheTerminal) {
  // The widest there is in practice: 64^4 entries and minutes to go.
  const StageState wide{"postprocess", 8'000'000, 16'777'216, 9000.0};
  EXPECT_LT(bar_text(wide, 1000).size(), 80u + 10u);
  for (const std::size_t columns : {1u, 20u, 79u})
    EXPECT_LT(bar_text(wide, columns).size(), columns);
  EXPECT_EQ(bar_text({"fit", 2048, 4096, 200.0}, 80).find("left"),
            bar_text({"fit", 2048, 4096, 200.0}, 1000).find("left"));
}

TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(duration_text(0.004), "0.00 s");
  EXPECT_EQ(duration_text(0.42), "0.42 s");
  EXPECT_EQ(duration_text(12.34), "12.3 s");
  EXPECT_EQ(duration_text(99.96), "1 min 40 s");
  EXPECT_EQ(duration_text(3599.6), "1 h 0 min");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

TEST(Progress, CountsAfreshEachStage) {
  ProgressDisplay progress;
  progress.begin_stage("fit", 2);
  progress.advance(2);
  progress.end_stage();
  progress.begin_stage("align", 3);
  EXPECT_EQ(progress.done(), 0u);
  progress.end_stage();
  EXPECT_FALSE(progress.stop_requested());
  progress.request_stop();
  EXPECT_THROW(progress.throw_if_stopped(), Interrupted);
}

// The command line by which a terminal of the kind runs the program; what it shows goes to `shown`
// too.
std::vector<std::string> on_terminal(const std::string& kind, const std::string& arguments,
                                     const std::filesystem::path& shown) {
  return {"script", "-qfec", "TERM=" + kind + " " LTCFIT_PROGRAM " " + arguments, shown.string()};
}

constexpr const char* escape = "\033[";

TEST(Progress, ADumbTerminalGetsLinesAndNoEscapes) {
  if (test::run_program({"sh", "-c", "command -v script"}).exit_code != 0)
    GTEST_SKIP() << "no script, which makes terminals";
  const test::TemporaryDirectory folder;
  const auto shown = folder / "shown";
  ASSERT_EQ(test::run_program(on_terminal("dumb",
                                          "generate --set table.alpha.nodes=2 --set "
                                          "table.lambda.nodes=2 --set table.theta.nodes=2 --set "
                                          "table.phi.nodes=2 --set refine.steps=0",
                                          shown),
                              folder.path())
                .exit_code,
            0);
  const std::string text = test::read_file(shown);
  EXPECT_NE(text.find("align: 16 to do"), std::string::npos) << text;
  EXPECT_EQ(text.find(escape), std::string::npos) << text;
}

TEST(Progress, AnotherTerminalGetsABar) {
  if (test::run_program({"sh", "-c", "command -v script"}).exit_code != 0)
    GTEST_SKIP() << "no script, which makes terminals";
  const test::TemporaryDirectory folder;
  const auto shown = folder.write("shown", "");
  test::RunningProgram run(on_terminal("xterm", "generate --set table.alpha.nodes=40", shown),
                           folder.path());
  EXPECT_TRUE(run.wait_until(
      [&] { return test::read_file(shown).find(escape) != std::string::npos; }, test::patience));
}

}  // namespace
}  // namespace ltc::cli
