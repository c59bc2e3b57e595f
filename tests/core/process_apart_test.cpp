// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Work in a copy of the process, and the guard of the HDF5 reader that is built on it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/error.h"
#include "core/hdf5_guard.h"
#include "core/platform.h"
#include "support/refusal.h"
#include "support/sanitizer.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

constexpr platform::WorkLimits generous{std::size_t{256} << 20, 60};

TEST(ProcessApart, ReturnsWhatTheWorkReturnsAndLeavesThisProcessAlone) {
  int here = 1;
  const std::string text(1000000, 'x');  // more than a pipe holds
  EXPECT_EQ(platform::in_a_process_apart(
                [&] {
                  here = 2;
                  return text;
                },
                generous),
            text);
  EXPECT_EQ(platform::in_a_process_apart([] { return std::string(); }, generous), "");
  EXPECT_EQ(here, 1);
}

TEST(ProcessApart, ACrashIsNothingAndNothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(platform::in_a_process_apart(
                []() -> std::string {
                  std::fputs("about to crash\n", stderr);
                  std::abort();
                },
                generous),
            std::nullopt);
  EXPECT_EQ(platform::in_a_process_apart(
                []() -> std::string { throw std::runtime_error("unexpected"); }, generous),
            std::nullopt);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// Else the lock of a run that is killed while it reads a checkpoint would outlive it.
TEST(ProcessApart, HasNoneOfThisProcessesOpenFiles) {
  const test::TemporaryDirectory folder;
  const auto path = folder.write("open", "any");
  const auto opened_here = [&path] {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      if (std::filesystem::read_symlink(entry.path(), gone) == path)
        return std::string("yes");
    }
    return std::string("no");
  };
  const std::ifstream file(path);
  EXPECT_EQ(opened_here(), "yes");
  EXPECT_EQ(platform::in_a_process_apart(opened_here, generous), "no");
}

TEST(ProcessApart, EndlessWorkAndEndlessMemoryEnd) {
  EXPECT_EQ(platform::in_a_process_apart(
                []() -> std::string {
                  for (volatile unsigned i = 0;;)
                    i = i + 1;
                },
                {std::size_t{256} << 20, 1}),
            std::nullopt);
  if (test::under_thread_sanitizer)
    GTEST_SKIP() << "the thread sanitizer gives out memory that it has reserved before the bound";
  EXPECT_EQ(platform::in_a_process_apart(
                [] { return std::string(std::size_t{512} << 20, 'x').substr(0, 1); }, generous),
            std::nullopt);
}

TEST(Hdf5Guard, PassesOnWhatTheReaderThrowsAndRefusesWhatItCrashesOn) {
  const test::TemporaryDirectory folder;
  const auto file = folder.write("t.h5", "any");
  int reads = 0;
  EXPECT_NO_THROW(require_harmless(file, [&] { ++reads; }));
  EXPECT_EQ(reads, 0) << "read in this process";
  EXPECT_EQ(test::message_of<InputError>(
                [&] { require_harmless(file, [] { throw InputError("bad value"); }); }),
            "bad value");
  EXPECT_EQ(
      test::message_of<IoError>([&] { require_harmless(file, [] { throw IoError("no disk"); }); }),
      "no disk");
  test::expect_one_line(
      test::message_of<InputError>([&] { require_harmless(file, [] { std::abort(); }); }),
      {file.string(), "damaged", "HDF5 library"});
  EXPECT_THROW(require_harmless(folder / "none.h5", [] {}), IoError);
}

}  // namespace
}  // namespace ltc
