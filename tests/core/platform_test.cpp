// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Files that take their places together, what killed processes leave, and the lock on a folder.
#include "core/platform.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/write_file.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc::platform {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::names_in;
using test::read_file;
using test::TemporaryDirectory;
using Names = std::vector<std::string>;

TEST(FileSet, TakesItsPlacesOnlyWhenCommitted) {
  const TemporaryDirectory folder;
  folder.write("a", "old a");
  FileSet files;
  add_file(files, folder / "a", "new a");
  add_file(files, folder / "b", "new b");
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_FALSE(fs::exists(folder / "b"));
  files.commit();
  EXPECT_EQ(names_in(folder.path()), (Names{"a", "b"}));
  EXPECT_EQ(read_file(folder / "a"), "new a");
  EXPECT_EQ(read_file(folder / "b"), "new b");
}

TEST(FileSet, LeavesTheOlderSetWholeWhereALaterFileFails) {
  const TemporaryDirectory folder;
  folder.write("a", "old a");
  folder.write("b", "old b");
  {
    FileSet files;
    add_file(files, folder / "a", "new a");
    const auto refuse = [](const fs::path&) { throw IoError("no space"); };
    EXPECT_EQ(message_of<IoError>([&] { files.add(folder / "b", refuse); }), "no space");
  }
  EXPECT_EQ(names_in(folder.path()), (Names{"a", "b"}));
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_EQ(read_file(folder / "b"), "old b");
}

TEST(FileSet, RemovesWithTheOthersOrNotAtAll) {
  const TemporaryDirectory folder;
  folder.write("a", "old a");
  folder.write("b", "old b");
  {
    FileSet files;
    add_file(files, folder / "a", "new a");
    files.remove(folder / "b");
  }
  EXPECT_EQ(read_file(folder / "b"), "old b");
  FileSet files;
  add_file(files, folder / "a", "new a");
  files.remove(folder / "b");
  files.remove(folder / "none");
  files.commit();
  EXPECT_EQ(names_in(folder.path()), (Names{"a"}));
  EXPECT_EQ(read_file(folder / "a"), "new a");
  // What cannot be removed keeps the others from taking their places.
  fs::create_directory(folder / "folder");
  FileSet refused;
  add_file(refused, folder / "a", "newer a");
  refused.remove(folder / "folder");
  EXPECT_NE(message_of<IoError>([&] { refused.commit(); }).find("cannot remove"),
            std::string::npos);
  EXPECT_EQ(read_file(folder / "a"), "new a");
}

TEST(Time, IsWrittenInUtc) {
  EXPECT_EQ(utc_iso8601(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(utc_iso8601(1700000000), "2023-11-14T22:13:20Z");
}

TEST(FileSet, DevicesAndPipesAreNotReplaced) {
  const TemporaryDirectory folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(pipe, folder / "link");
  for (const char* name : {"pipe", "link"})
    test::expect_one_line(message_of<IoError>([&] { write_file(folder / name, "x"); }),
                          {"cannot write", (folder / name).string(), "a device or a pipe"});
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(names_in(folder.path()), (Names{"link", "pipe"}));
}

TEST(FileSet, RefusedNamesAndVanishedFoldersAreErrors) {
  const TemporaryDirectory folder;
  fs::create_directories(folder / "taken/by a folder");
  test::expect_one_line(message_of<IoError>([&] { write_file(folder / "taken", "x"); }),
                        {"cannot write", (folder / "taken").string()});
  EXPECT_EQ(names_in(folder.path()), Names{"taken"});
  FileSet files;
  fs::create_directory(folder / "gone");
  add_file(files, folder / "gone/file", "x");
  fs::remove_all(folder / "gone");
  test::expect_one_line(message_of<IoError>([&] { files.commit(); }),
                        {"cannot write", (folder / "gone/file").string(), "No such file"});
  test::expect_one_line(message_of<IoError>([&] { write_file(folder / "gone/file", "x"); }),
                        {"cannot write", (folder / "gone/file").string(), "No such file"});
}

TEST(AbandonedTemporaries, AreRemovedAndNothingElseIs) {
  const TemporaryDirectory folder;
  const Names others = {".a.h5.12x.tmp", ".a.h5.tmp", ".ab.h5.1.tmp",
                        ".b.h5.12.tmp",  "a.h5",      "a.h5.12.tmp"};
  for (const std::string& name : others)
    folder.write(name, "");
  folder.write(".a.h5.12.tmp", "");
  folder.write(".a.h5.99999.tmp", "");
  remove_abandoned_temporaries(folder / "a.h5");
  EXPECT_EQ(names_in(folder.path()), others);
  EXPECT_NO_THROW(remove_abandoned_temporaries(folder / "none/a.h5"));
}

// What the test above plants is what a process that is killed leaves.
TEST(AbandonedTemporaries, HaveTheNamesOfThoseThatAreWritten) {
  const TemporaryDirectory folder;
  FileSet files;
  add_file(files, folder / "a.h5", "x");
  ASSERT_EQ(names_in(folder.path()).size(), 1u);
  remove_abandoned_temporaries(folder / "a.h5");
  EXPECT_EQ(names_in(folder.path()), Names{});
}

TEST(FolderLock, IsHeldByOneAtATimeAndLeavesNothing) {
  const TemporaryDirectory folder, other;
  std::optional<FolderLock> lock(folder.path());
  test::expect_one_line(message_of<IoError>([&] { FolderLock second(folder.path()); }),
                        {"another run", folder.path().string()});
  EXPECT_NO_THROW(FolderLock{other.path()});
  lock.reset();
  EXPECT_NO_THROW(FolderLock{folder.path()});
  EXPECT_EQ(names_in(folder.path()), Names{});
}

TEST(FolderLock, IsSharedByThoseThatAskSo) {
  const TemporaryDirectory folder;
  std::optional<FolderLock> one(std::in_place, folder.path(), true);
  std::optional<FolderLock> two(std::in_place, folder.path(), true);
  EXPECT_THROW(FolderLock{folder.path()}, IoError);
  one.reset();
  EXPECT_THROW(FolderLock{folder.path()}, IoError);
  two.reset();
  const FolderLock alone(folder.path());
  EXPECT_THROW(FolderLock(folder.path(), true), IoError);
}

TEST(Processors, AreThoseThatThreadsMayUse) {
  const std::vector<std::uint8_t> allowed = allowed_processors();
  EXPECT_EQ(std::ranges::count(allowed, 1), processor_count());
  EXPECT_EQ(std::ranges::count(allowed, 0) + processor_count(), std::ssize(allowed));
}

TEST(FolderLock, RefusesWhatIsNoFolder) {
  const TemporaryDirectory folder;
  const fs::path file = folder.write("file", "");
  test::expect_one_line(message_of<IoError>([&] { FolderLock lock(file); }),
                        {"cannot open", file.string()});
}

}  // namespace
}  // namespace ltc::platform
