// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/progress.h"

#include <gtest/gtest.h>

namespace ltc::cli {
namespace {

TEST(Progress, BarShowsShareRateAndTimeLeft) {
  const StageState half{"fit", 2048, 4096, 4.0};
  EXPECT_EQ(bar_text(half, 200),
            "fit         [==========>         ]  50 %  2048/4096  512/s  4.0 s left");
  EXPECT_EQ(line_text(half), "fit: 2048 of 4096, 512/s, 4.0 s left");
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

}  // namespace
}  // namespace ltc::cli
