// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What an interrupt does to work that does not heed it. Each run is a process of its own, which
// ends by itself after a while so that no mistake hangs.
#include "cli/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/platform.h"
#include "core/uninterrupted.h"
#include "support/temporary_directory.h"

namespace ltc::cli {
namespace {

struct UnheededProgress : Progress {
  void begin_stage(std::string_view, std::size_t) override {}
  void end_stage() override {}
};

constexpr int not_ended = 7;

// Never looks at its progress, and keeps a processor busy.
void work(std::chrono::seconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
  }
}

class InterruptDeathTest : public ::testing::Test {
 protected:
  InterruptDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(InterruptDeathTest, EndsWorkThatDoesNotHeedIt) {
  EXPECT_EXIT(
      {
        UnheededProgress progress;
        const StopOnInterrupt stop(progress);
        std::raise(SIGINT);
        work(std::chrono::minutes(10));
        std::_Exit(not_ended);
      },
      ::testing::ExitedWithCode(130), "^ltcfit: interrupted, and ended in mid-work\n$");
}

TEST_F(InterruptDeathTest, EndsWorkThatWaitsForSomething) {
  EXPECT_EXIT(
      {
        UnheededProgress progress;
        const StopOnInterrupt stop(progress);
        std::raise(SIGHUP);
        std::this_thread::sleep_for(std::chrono::minutes(10));
        std::_Exit(not_ended);
      },
      ::testing::ExitedWithCode(130), "^ltcfit: interrupted, and ended in mid-work\n$");
}

TEST_F(InterruptDeathTest, NamesTheCheckpointThatThereIs) {
  EXPECT_EXIT(
      {
        const test::TemporaryDirectory folder;
        UnheededProgress progress;
        StopOnInterrupt stop(progress);
        stop.set_checkpoint(folder.write("t.checkpoint.h5", ""));
        std::raise(SIGTERM);
        work(std::chrono::minutes(10));
        std::_Exit(not_ended);
      },
      ::testing::ExitedWithCode(130), "mid-work; --resume goes on from .*t.checkpoint.h5\n$");
}

TEST_F(InterruptDeathTest, LeavesOlderFilesAndNoTemporaryOnes) {
  const test::TemporaryDirectory folder;
  const std::filesystem::path file = folder.write("t.h5", "older");
  EXPECT_EXIT(
      {
        UnheededProgress progress;
        const StopOnInterrupt stop(progress);
        platform::FileSet files;
        files.add(file, [&](const std::filesystem::path& temporary) {
          std::ofstream(temporary) << "newer";
        });
        files.add(folder / "u.h5", [&](const std::filesystem::path& temporary) {
          std::ofstream(temporary) << "begun";
          std::raise(SIGINT);
          work(std::chrono::minutes(10));
        });
        std::_Exit(not_ended);
      },
      ::testing::ExitedWithCode(130), "interrupted");
  EXPECT_EQ(test::names_in(folder.path()), std::vector<std::string>{"t.h5"});
  EXPECT_EQ(test::read_file(file), "older");
}

TEST_F(InterruptDeathTest, WaitsForWhatIsUninterrupted) {
  EXPECT_EXIT(
      {
        const Uninterrupted whole;
        {
          UnheededProgress progress;
          const StopOnInterrupt stop(progress);
          std::raise(SIGINT);
          work(std::chrono::seconds(2));  // five times what others get
        }
        std::_Exit(not_ended);
      },
      ::testing::ExitedWithCode(not_ended), "^$");
}

TEST_F(InterruptDeathTest, LetsWorkThatHeedsItEndByItself) {
  EXPECT_EXIT(
      {
        UnheededProgress progress;
        {
          const StopOnInterrupt stop(progress);
          std::raise(SIGINT);
        }
        std::_Exit(progress.stop_requested() ? not_ended : 0);
      },
      ::testing::ExitedWithCode(not_ended), "^$");
}

}  // namespace
}  // namespace ltc::cli
