// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Every seed of the fuzzers and everything they ever found, fed to the readers without a fuzzer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "fuzz/hdf5_checksums.h"
#include "fuzz/readers.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

// The files of tests/fuzz/<kind>/<reader>, sorted; none if there is no such folder.
std::vector<fs::path> inputs(std::string_view kind, const fuzz::Reader& reader) {
  const fs::path folder = fs::path(LTCFIT_SOURCE_DIR) / "tests/fuzz" / kind / reader.name;
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class FuzzReplay : public ::testing::TestWithParam<fuzz::Reader> {};

// The good files, by the start of their names; every other seed holds a lie.
bool is_good(const fs::path& file) {
  static const std::set<std::string> names = {"good",       "old_format", "new_format", "one_entry",
                                              "version_2",  "skipped",    "default",    "sections",
                                              "inline",     "all_keys",   "legacy",     "volume",
                                              "compressed", "babylon",    "playcanvas"};
  return names.contains(file.stem().string());
}

TEST_P(FuzzReplay, SeedsThatLieAreRefusedAndGoodOnesRead) {
  const test::TemporaryDirectory folder;
  int good = 0, lies = 0;
  for (const fs::path& file : inputs("seeds", GetParam())) {
    EXPECT_EQ(fuzz::accepts(GetParam(), folder.path(), test::read_file(file)), is_good(file))
        << file;
    ++(is_good(file) ? good : lies);
  }
  EXPECT_GE(good, 1);
  EXPECT_GE(lies, 5);
}

TEST_P(FuzzReplay, WhatOnceBrokeAReaderIsReadOrRefused) {
  const test::TemporaryDirectory folder;
  for (const fs::path& file : inputs("crashers", GetParam()))
    EXPECT_NO_THROW(fuzz::accepts(GetParam(), folder.path(), test::read_file(file))) << file;
}

// Seeds cut short anywhere and with single bytes changed: what a fuzzer does first.
TEST_P(FuzzReplay, ChangedSeedsAreReadOrRefused) {
  const test::TemporaryDirectory folder;
  for (const fs::path& file : inputs("seeds", GetParam())) {
    const std::string seed = test::read_file(file);
    const std::size_t step = seed.size() / 11 + 1;
    for (std::size_t i = 0; i < seed.size(); i += step) {
      std::string changed = seed;
      changed[i] = static_cast<char>(changed[i] ^ 0x81);
      EXPECT_NO_THROW(fuzz::accepts(GetParam(), folder.path(), changed)) << file << " at " << i;
      EXPECT_NO_THROW(fuzz::accepts(GetParam(), folder.path(), seed.substr(0, i))) << file;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzReplay, ::testing::ValuesIn(fuzz::readers()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(FuzzReaders, OtherErrorsThanTheDocumentedOnesAreNotTakenForARefusal) {
  const test::TemporaryDirectory folder;
  const fuzz::Reader faulty{"faulty", [](const fs::path&, std::string_view bytes) {
                              if (bytes == "bad_alloc")
                                throw std::bad_alloc();
                              throw InputError("refused");
                            }};
  EXPECT_THROW(fuzz::accepts(faulty, folder.path(), "bad_alloc"), std::bad_alloc);
  EXPECT_FALSE(fuzz::accepts(faulty, folder.path(), ""));
}

// Their metadata changed and its checksums made right, byte after byte, and files cut short.
TEST(FuzzCheckpoint, ChangedOnesAreReadOrRefused) {
  const test::TemporaryDirectory folder;
  const std::string good = fuzz::good_checkpoint(folder.path());
  EXPECT_TRUE(fuzz::accepts(fuzz::checkpoint_reader(), folder.path(), good));
  const std::vector<std::uint8_t> file(good.begin(), good.end());
  const auto blocks = fuzz::checksummed_blocks(file);
  EXPECT_GE(blocks.size(), 7u);  // the superblock and the headers of two groups, five datasets
  int refused = 0, tried = 0;
  for (const auto& [begin, length] : blocks)
    for (std::size_t i = begin + 4; i < begin + length; i += 17, ++tried) {
      std::vector<std::uint8_t> changed = file;
      changed[i] ^= 0x81;
      fuzz::renew_checksums(blocks, changed);
      const std::string bytes(changed.begin(), changed.end());
      bool accepted = true;
      EXPECT_NO_THROW(accepted = fuzz::accepts(fuzz::checkpoint_reader(), folder.path(), bytes))
          << i;
      refused += !accepted;
      EXPECT_FALSE(fuzz::accepts(fuzz::checkpoint_reader(), folder.path(), good.substr(0, i)));
    }
  EXPECT_GE(tried, 50);
  EXPECT_GE(refused, tried / 4);  // most bytes of metadata mean something
}

// The fuzzer of HDF5 gets nowhere without them: the published test vectors of lookup3, and a file
// whose change goes unnoticed once its checksum is made right.
TEST(FuzzChecksums, AreThoseOfHdf5) {
  EXPECT_EQ(fuzz::lookup3({}), 0xdeadbeefu);
  const std::string text = "Four score and seven years ago";
  EXPECT_EQ(fuzz::lookup3({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}),
            0x17770551u);
  const std::string seed =
      test::read_file(fs::path(LTCFIT_SOURCE_DIR) / "tests/fuzz/seeds/hdf5/good.h5");
  std::vector<std::uint8_t> file(seed.begin(), seed.end());
  const auto blocks = fuzz::checksummed_blocks(file);
  EXPECT_GE(blocks.size(), 10u);  // the superblock and the headers of two groups, ten datasets
  file[blocks[0].begin + 12] ^= 1;
  EXPECT_LT(fuzz::checksummed_blocks(file).size(), blocks.size());
  fuzz::renew_checksums(blocks, file);
  EXPECT_EQ(fuzz::checksummed_blocks(file).size(), blocks.size());
}

}  // namespace
}  // namespace ltc
