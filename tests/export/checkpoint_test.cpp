// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Checkpoints: bit exact, and refused where they would make a table that no run makes.
#include "export/checkpoint.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <limits>

#include "core/error.h"
#include "core/version.h"
#include "export/files.h"
#include "fit/same_fits.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc {
namespace {

using test::message_of;
using test::TemporaryDirectory;

Config config_with(std::vector<std::string> more = {}) {
  std::vector<std::string> overrides = {"table.alpha.nodes=2", "table.lambda.nodes=2",
                                        "table.theta.nodes=2", "table.phi.nodes=2",
                                        "fit.gauss_newton.neighbour_sweeps=1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return load_config(std::nullopt, overrides);
}

const std::vector<bool> all_needed(16, true);

// Two rounds with fits of every kind and some that are not finished; no two values are equal.
FinishedFits example() {
  FinishedFits fits;
  constexpr std::array statuses = {Status::fitted, Status::skipped, Status::analytic,
                                   Status::failed};
  double value = 1.0 / 3;
  for (int round = 0; round < 2; ++round) {
    FitRound& entries = fits.rounds.emplace_back(16);
    for (std::size_t flat = 0; flat < 16; ++flat) {
      FittedEntry entry;
      for (double& element : entry.matrix.reshaped())
        element = value += 1.0 / 7;
      entry.loss = value * 1e-9;
      entry.steps = 70'000 * static_cast<int>(flat) + round;  // more than 16 bits hold
      entry.status = statuses[(flat + static_cast<std::size_t>(round)) % statuses.size()];
      if (entry.status == Status::skipped)
        entry.steps = 0;
      if (entry.status == Status::failed) {
        entry.matrix.setConstant(std::numeric_limits<double>::quiet_NaN());
        entry.loss = std::numeric_limits<double>::quiet_NaN();
      }
      entries.set(flat, entry);
    }
  }
  return fits;
}

TEST(Checkpoint, GivesBackTheSameBits) {
  const TemporaryDirectory folder;
  const FinishedFits fits = example();
  write_checkpoint(config_with(), all_needed, fits, folder / "c.h5");
  const FinishedFits read = read_checkpoint(config_with(), all_needed, folder / "c.h5");
  ASSERT_EQ(read.rounds.size(), fits.rounds.size());
  for (std::size_t round = 0; round < fits.rounds.size(); ++round)
    EXPECT_TRUE(test::same_bits(read.rounds[round], fits.rounds[round]));
  EXPECT_EQ(test::names_in(folder.path()), std::vector<std::string>{"c.h5"});
}

TEST(Checkpoint, IsHdf5ThatOthersRead) {
  const TemporaryDirectory folder;
  write_checkpoint(config_with(), all_needed, example(), folder / "c.h5");
  const testing::Finished dump = testing::run("h5dump -H " + (folder / "c.h5").string());
  EXPECT_EQ(dump.exit_code, 0) << dump.output;
  for (const char* part : {"\"format\"", "\"generator\"", "\"config\"", "\"needed\"",
                           "GROUP \"fit\"", "( 2, 16, 3, 3 )"})
    EXPECT_NE(dump.output.find(part), std::string::npos) << part;
}

// A stop does not wait for what is not there.
TEST(Checkpoint, HoldsWhatIsFinishedAlone) {
  const TemporaryDirectory folder;
  FinishedFits fits = example();
  for (FitRound& round : fits.rounds)
    for (std::size_t flat = 0; flat < round.size(); ++flat)
      if (flat != 6)
        round.set(flat, {});
  write_checkpoint(config_with(), all_needed, fits, folder / "c.h5");
  const FinishedFits read = read_checkpoint(config_with(), all_needed, folder / "c.h5");
  EXPECT_TRUE(test::same_bits(read.rounds[0], fits.rounds[0]));
  EXPECT_TRUE(test::same_bits(read.rounds[1], fits.rounds[1]));
  const testing::Finished dump = testing::run("h5dump -H " + (folder / "c.h5").string());
  EXPECT_NE(dump.output.find("( 2, 1, 3, 3 )"), std::string::npos) << dump.output;
}

TEST(Checkpoint, OfAShardSaysWhichOne) {
  const TemporaryDirectory folder;
  const FinishedFits fits = example();
  write_checkpoint(config_with(), all_needed, fits, folder / "s.h5", Shard{2, 3});
  const ShardHeader header = read_shard_header(folder / "s.h5");
  EXPECT_EQ(header.shard.number, 2);
  EXPECT_EQ(header.shard.count, 3);
  EXPECT_EQ(header.config, to_toml(config_with()));
  const FinishedFits read =
      read_checkpoint(config_with(), all_needed, folder / "s.h5", Shard{2, 3});
  EXPECT_TRUE(test::same_bits(read.rounds[0], fits.rounds[0]));
  const auto refusal = [&](const std::optional<Shard>& shard) {
    return message_of<InputError>(
        [&] { read_checkpoint(config_with(), all_needed, folder / "s.h5", shard); });
  };
  test::expect_one_line(refusal(Shard{3, 3}), {"s.h5", "of shard 2 of 3; expected 3 of 3"});
  test::expect_one_line(refusal(Shard{2, 4}), {"s.h5", "of shard 2 of 3; expected 2 of 4"});
  test::expect_one_line(refusal({}), {"s.h5", "\"ltc-shard\"", "\"ltc-checkpoint\""});
}

// ---- What it refuses ----

void expect_refused(const TemporaryDirectory& folder, const Config& config,
                    const std::vector<bool>& needed, std::vector<std::string> parts) {
  parts.push_back((folder / "c.h5").string());
  test::expect_one_line(
      message_of<InputError>([&] { read_checkpoint(config, needed, folder / "c.h5"); }), parts);
}

TEST(CheckpointRefused, OfAnotherConfig) {
  const TemporaryDirectory folder;
  write_checkpoint(config_with(), all_needed, example(), folder / "c.h5");
  expect_refused(folder, config_with({"fit.seed=2"}), all_needed, {"fit.seed = 1", "now it is 2"});
  expect_refused(folder, config_with({"table.phi.nodes=3"}), std::vector<bool>(24, true),
                 {"table.phi.nodes = 2", "now it is 3"});
  EXPECT_NO_THROW(read_checkpoint(config_with({"output.exr_half=true", "output.name=b"}),
                                  all_needed, folder / "c.h5"));
}

TEST(CheckpointRefused, AsAShard) {
  const TemporaryDirectory folder;
  const auto refusal = [&] {
    return message_of<InputError>([&] { read_shard_header(folder / "s.h5"); });
  };
  write_checkpoint(config_with(), all_needed, example(), folder / "s.h5");
  test::expect_one_line(refusal(), {"s.h5", "\"ltc-checkpoint\"; allowed: \"ltc-shard\""});
  for (const Shard shard : {Shard{0, 3}, Shard{4, 3}, Shard{1, most_shards + 1}, Shard{-1, -1}}) {
    write_checkpoint(config_with(), all_needed, example(), folder / "s.h5", shard);
    test::expect_one_line(refusal(), {"s.h5", "allowed: 1 to their number"});
  }
  EXPECT_THROW(read_shard_header(folder / "none.h5"), IoError);
}

TEST(CheckpointRefused, OfOtherEntries) {
  const TemporaryDirectory folder;
  std::vector<bool> fewer = all_needed;
  fewer[5] = false;
  write_checkpoint(config_with(), fewer, example(), folder / "c.h5");
  expect_refused(folder, config_with(), all_needed, {"other entries", "its scene"});
  EXPECT_NO_THROW(read_checkpoint(config_with(), fewer, folder / "c.h5"));
}

TEST(CheckpointRefused, WhatIsNoCheckpoint) {
  const TemporaryDirectory folder;
  folder.write("c.h5", "no HDF5");
  expect_refused(folder, config_with(), all_needed, {"HDF5"});
  EXPECT_THROW(read_checkpoint(config_with(), all_needed, folder / "none.h5"), IoError);
}

// What crashed the library as a table: some of these crash it before it can say what they are of.
TEST(CheckpointRefused, WhatTheLibraryCannotCopeWith) {
  const std::filesystem::path crashers = LTCFIT_SOURCE_DIR "/tests/fuzz/crashers/hdf5";
  int files = 0;
  for (const auto& crasher : std::filesystem::directory_iterator(crashers)) {
    SCOPED_TRACE(crasher.path());
    const TemporaryDirectory folder;
    folder.write("c.h5", test::read_file(crasher.path()));
    expect_refused(folder, config_with(), all_needed, {});
    ++files;
  }
  EXPECT_GE(files, 6);
  const TemporaryDirectory folder;  // a null pointer, wherever the library runs
  folder.write("c.h5", test::read_file(crashers / "object_of_a_fractal_heap.h5"));
  expect_refused(folder, config_with(), all_needed, {"damaged: the HDF5 library"});
}

// Opens the file, changes it, closes it.
void change(const std::filesystem::path& path, const std::function<void(hid_t)>& changes) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  changes(file);
  ASSERT_GE(H5Fclose(file), 0);
}

void set_text(hid_t file, const char* attribute, const char* value) {
  const hid_t handle = H5Aopen(file, attribute, H5P_DEFAULT), type = H5Aget_type(handle);
  EXPECT_GE(H5Awrite(handle, type, static_cast<const void*>(&value)), 0);
  H5Tclose(type);
  H5Aclose(handle);
}

template <class T>
void set_first_value(hid_t file, const char* dataset, hid_t type, std::size_t count, T value) {
  const hid_t handle = H5Dopen2(file, dataset, H5P_DEFAULT);
  std::vector<T> values(count);
  EXPECT_GE(H5Dread(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  values[0] = value;
  EXPECT_GE(H5Dwrite(handle, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Dclose(handle);
}

TEST(CheckpointRefused, OfAnotherProgramOrDamaged) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::function<void(hid_t)>, std::vector<std::string>>> cases = {
      {[](hid_t f) { set_text(f, "format", "ltc-table"); }, {"format", "\"ltc-table\""}},
      {[](hid_t f) { set_text(f, "generator", "ltcfit 0.0.1"); }, {"ltcfit 0.0.1", generator()}},
      {[](hid_t f) { set_text(f, "config", "[fit"); }, {"not TOML"}},
      {[](hid_t f) { set_text(f, "config", ""); }, {"nothing"}},
      {[](hid_t f) { H5Adelete(f, "config"); }, {"config", "missing"}},
      {[](hid_t f) { H5Ldelete(f, "fit/loss", H5P_DEFAULT); }, {"fit/loss", "missing"}},
      {[](hid_t f) { set_first_value<std::uint8_t>(f, "fit/status", H5T_NATIVE_UINT8, 32, 2); },
       {"fit/status holds 2", "0, 1, 3 and 4"}},
      {[](hid_t f) { set_first_value<std::uint8_t>(f, "fit/status", H5T_NATIVE_UINT8, 32, 77); },
       {"fit/status holds 77"}},
      {[](hid_t f) { set_first_value<std::int32_t>(f, "fit/steps", H5T_NATIVE_INT32, 32, -1); },
       {"fit/steps holds -1"}},
      {[](hid_t f) { set_first_value<std::int32_t>(f, "fit/entry", H5T_NATIVE_INT32, 16, 1); },
       {"fit/entry holds 1 after 1", "rising, up to 15"}},
      {[](hid_t f) { set_first_value<std::int32_t>(f, "fit/entry", H5T_NATIVE_INT32, 16, -2); },
       {"fit/entry holds -2"}},
      {[=](hid_t f) { set_first_value(f, "fit/matrix", H5T_NATIVE_DOUBLE, 32 * 9, infinity); },
       {"fit/matrix", "not finite"}},
  };
  for (const auto& [damage, parts] : cases) {
    SCOPED_TRACE(parts.front());
    const TemporaryDirectory folder;
    write_checkpoint(config_with(), all_needed, example(), folder / "c.h5");
    EXPECT_NO_THROW(read_checkpoint(config_with(), all_needed, folder / "c.h5"));
    change(folder / "c.h5", damage);
    expect_refused(folder, config_with(), all_needed, parts);
  }
}

TEST(CheckpointRefused, WithAnotherNumberOfRounds) {
  const TemporaryDirectory folder;
  FinishedFits one = example();
  one.rounds.pop_back();
  write_checkpoint(config_with(), all_needed, one, folder / "c.h5");
  expect_refused(folder, config_with(), all_needed, {"fit/matrix", "(1, 12, 3, 3)"});
}

}  // namespace
}  // namespace ltc
