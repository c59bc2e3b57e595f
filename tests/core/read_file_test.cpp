// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/read_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

TEST(ReadFile, UpToABoundOfBytes) {
  const test::TemporaryDirectory folder;
  const auto file = folder.write("f", std::string("a\0b", 3));
  EXPECT_EQ(read_whole_file(file, "scene", 3), std::string("a\0b", 3));
  EXPECT_EQ(read_first_bytes(file, "scene", 2), std::string("a\0", 2));
  EXPECT_EQ(read_first_bytes(file, "scene", 9), std::string("a\0b", 3));
  EXPECT_EQ(read_whole_file(folder.write("empty", ""), "scene", 3), "");
  test::expect_one_line(test::message_of<InputError>([&] { read_whole_file(file, "scene", 2); }),
                        {file.string(), "larger than 2 bytes", "no scene"});
}

TEST(ReadFile, NamesWhatCannotBeRead) {
  const test::TemporaryDirectory folder;
  const auto refused = [](const std::filesystem::path& file, const std::string& reason) {
    test::expect_one_line(test::message_of<IoError>([&] { read_whole_file(file, "scene", 9); }),
                          {"cannot read scene " + file.string(), reason});
  };
  refused(folder.path(), "it is a folder");
  refused(folder / "none", "No such file or directory");
  refused(folder.write("file", "") / "below", "Not a directory");
}

}  // namespace
}  // namespace ltc
