// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// HDF5: read back by h5py and h5dump, by our own reader, and everything that must be refused.
#include "export/table_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/error.h"
#include "export/consistency.h"
#include "export/files.h"
#include "export/same_tables.h"
#include "table/synthetic.h"
#include "test_paths.h"

namespace ltc {
namespace {

using testing::bytes_of;
using testing::Finished;
using testing::TemporaryFolder;

// A table with everything in it: a skipped entry and a failed one too.
Table example() {
  Table table = testing::synthetic_table(testing::uneven_grid(), Storage::mirror_frame);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [entry, status] : {std::pair{17, Status::skipped}, {99, Status::failed}}) {
    const auto i = static_cast<std::size_t>(entry);
    table.set_stored(i, Eigen::Matrix3d::Constant(nan));
    table.amplitude[i] = table.fresnel[i] = table.sw_loss[i] = nan;
    table.status[i] = status;
    table.iterations[i] = 65535;
  }
  return table;
}

nlohmann::json with_nulls(const std::vector<float>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const float value : values)
    list.push_back(std::isnan(value) ? nlohmann::json() : nlohmann::json(value));
  return list;
}

// What check_h5.py should find, taken from the table in memory.
nlohmann::json expectation(const Table& table) {
  nlohmann::json expected;
  expected["attributes"] = {{"format", "ltc-table"},
                            {"format_version", 1},
                            {"brdf", std::string(table.grid.model->name())},
                            {"storage", name_of(table.storage)},
                            {"alpha_min", table.grid.alpha_min},
                            {"seed", table.seed},
                            {"generator", table.generator},
                            {"config", table.config},
                            {"created", table.created}};
  if (table.refined)
    expected["attributes"]["refined"] = static_cast<int>(*table.refined);
  for (std::size_t i = 0; i < Grid::axis_count; ++i) {
    const std::string name(table.grid.axis_names()[i]);
    expected["axes"][name] = table.grid.axis(i).nodes;
    expected["warp"][name] = name_of(table.grid.axis(i).warp);
  }
  expected["matrix"] = with_nulls(table.stored);
  expected["amplitude"] = with_nulls(table.amplitude);
  expected["fresnel"] = with_nulls(table.fresnel);
  expected["sw_loss"] = with_nulls(table.sw_loss);
  for (const Status status : table.status)
    expected["status"].push_back(static_cast<int>(status));
  expected["iterations"] = table.iterations;
  return expected;
}

std::set<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.insert(line);
  return lines;
}

// Writes the example as t.h5 and every damaged copy of it; the names of the damages.
std::set<std::string> write_damaged(const TemporaryFolder& folder) {
  write_table(example(), folder / "t.h5");
  const Finished damage = testing::run_python(
      "damage_h5.py", (folder / "t.h5").string() + " " + folder.path().string());
  EXPECT_EQ(damage.exit_code, 0) << damage.output;
  return lines_of(damage.output);
}

// The message of the InputError that reading throws; empty if it throws none.
std::string refusal(const std::filesystem::path& path) {
  try {
    read_table(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Hdf5, H5pyFindsTypesShapesAttributesAndValues) {
  const TemporaryFolder folder;
  Table table = example();
  table.refined = true;
  write_table(table, folder / "t.h5");
  testing::write_bytes(folder / "t.json", expectation(table).dump());
  const Finished check = testing::run_python(
      "check_h5.py", (folder / "t.h5").string() + " " + (folder / "t.json").string());
  EXPECT_EQ(check.exit_code, 0) << check.output;
}

TEST(Hdf5, CheckerRejectsEveryOtherFile) {
  const TemporaryFolder folder;
  const std::set<std::string> written = write_damaged(folder);
  testing::write_bytes(folder / "t.json", expectation(example()).dump());
  // One of each kind of difference: starting Python for all of them takes long.
  for (const char* name :
       {"no_seed", "matrix_transposed", "matrix_rows_for_columns", "matrix_is_f64", "other_seed",
        "format_is_bytes", "extra_dataset", "one_value_off", "axis_off_warp", "unknown_warp"}) {
    const Finished check =
        testing::run_python("check_h5.py", (folder / (std::string(name) + ".h5")).string() + " " +
                                               (folder / "t.json").string());
    EXPECT_EQ(check.exit_code, 1) << name << ": " << check.output;
    EXPECT_TRUE(check.output.starts_with("check_h5: ")) << check.output;
  }
}

TEST(Hdf5, WhetherATableIsRefinedIsKeptAndMayBeUnknown) {
  const TemporaryFolder folder;
  for (const std::optional<bool> refined : {std::optional<bool>(), {false}, {true}}) {
    Table table = example();
    table.refined = refined;
    write_table(table, folder / "t.h5");
    EXPECT_EQ(read_table(folder / "t.h5").refined, refined);
  }
}

TEST(Hdf5, H5dumpReadsTheFile) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.h5");
  const Finished dump = testing::run("h5dump -A " + (folder / "t.h5").string());
  EXPECT_EQ(dump.exit_code, 0) << dump.output;
  EXPECT_NE(dump.output.find("DATASET \"matrix\""), std::string::npos);
  EXPECT_NE(dump.output.find("( 3, 2, 5, 4, 3, 3 ) / ( 3, 2, 5, 4, 3, 3 )"), std::string::npos);
  EXPECT_NE(dump.output.find("\"mirror-frame\""), std::string::npos);
}

TEST(Hdf5, OurReaderGivesTheSameTableBack) {
  const TemporaryFolder folder;
  for (const Grid& grid : {testing::uneven_grid(), Grid::paper({1, 2, 1, 3})}) {
    for (const Storage storage : {Storage::roughness_scaled, Storage::folded}) {
      const Table table = testing::synthetic_table(grid, storage);
      write_table(table, folder / "t.h5");
      testing::expect_same_tables(read_table(folder / "t.h5"), table);
    }
  }
  write_table(example(), folder / "t.h5");
  testing::expect_same_tables(read_table(folder / "t.h5"), example());
}

TEST(Hdf5, FoldsThatAreNoneAreRefused) {
  const TemporaryFolder folder;
  const Table table = testing::synthetic_table(testing::uneven_grid(), Storage::folded);
  const auto refused = [&](const std::function<void(Table&)>& change, const char* what) {
    Table broken = table;
    change(broken);
    try {
      write_table(broken, folder / "t.h5");
      ADD_FAILURE() << what;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused([](Table& t) { t.fold.pop_back(); }, "fold has 239 values");
  refused([](Table& t) { t.fold[5] = std::numeric_limits<float>::quiet_NaN(); },
          "fold of entry (0, 0, 0, 2) is not finite");
  refused([](Table& t) { t.creases = {}; }, "creases are []");
  refused([](Table& t) { t.creases = {0.4, 0.4}; }, "must increase");
  refused([](Table& t) { t.storage = Storage::mirror_frame; }, "fold has 240 values");
}

TEST(Hdf5, ALongConfigAndAnEmptyTextGoThereAndBack) {
  const TemporaryFolder folder;
  Table table = example();
  table.config = std::string(200000, 'x') + "\n[fit]";  // beyond the 64 KiB of a plain attribute
  table.generator.clear();
  write_table(table, folder / "t.h5");
  testing::expect_same_tables(read_table(folder / "t.h5"), table);
}

TEST(Hdf5, TheSameTableGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_table(example(), folder / "a.h5");
  ::sleep(1);  // a recorded time would show
  write_table(example(), folder / "b.h5");
  EXPECT_EQ(bytes_of(folder / "a.h5"), bytes_of(folder / "b.h5"));
}

TEST(Hdf5, FixedLengthTextIsReadToo) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_damaged(folder).contains("format_is_bytes"));
  testing::expect_same_tables(read_table(folder / "format_is_bytes.h5"), example());
}

TEST(Hdf5, DamagedFilesAreRefusedByNameAndFault) {
  const TemporaryFolder folder;
  const std::set<std::string> written = write_damaged(folder);
  const std::map<std::string, std::string> faults = {
      {"other_format", "format is \"lut\""},
      {"format_is_number", "format of / is no string"},
      {"version_2", "format_version is 2; allowed: 1"},
      {"version_is_text", "format_version of / has another type"},
      {"version_is_list", "format_version of / is not a single value"},
      {"unknown_storage", "storage \"cholesky\" is unknown"},
      {"unknown_warp", "axis/theta: warp \"cubic\" is unknown"},
      {"no_warp", "attribute warp of axis/theta is missing"},
      {"seed_is_signed", "seed of / has another type than u64"},
      {"alpha_min_is_f32", "alpha_min of / has another type than f64"},
      {"alpha_min_is_nan", "alpha_min is nan"},
      {"alpha_min_is_0", "alpha_min is 0"},
      {"no_format", "attribute format of / is missing"},
      {"no_format_version", "attribute format_version of / is missing"},
      {"no_brdf", "attribute brdf of / is missing"},
      {"no_storage", "attribute storage of / is missing"},
      {"no_alpha_min", "attribute alpha_min of / is missing"},
      {"no_seed", "attribute seed of / is missing"},
      {"no_generator", "attribute generator of / is missing"},
      {"no_config", "attribute config of / is missing"},
      {"no_created", "attribute created of / is missing"},
      {"no_dataset_matrix", "dataset matrix is missing"},
      {"no_dataset_amplitude", "dataset amplitude is missing"},
      {"no_dataset_fresnel", "dataset fresnel is missing"},
      {"no_dataset_sw_loss", "dataset sw_loss is missing"},
      {"no_dataset_status", "dataset status is missing"},
      {"no_dataset_iterations", "dataset iterations is missing"},
      {"no_axis", "dataset axis/alpha is missing"},
      {"no_axis_lambda", "dataset axis/lambda is missing"},
      {"axis_is_f32", "axis/alpha has another type than f64"},
      {"axis_has_nan", "axis alpha: node 1 is nan"},
      {"axis_decreases", "axis alpha: node 1 is"},
      {"axis_repeats", "axis theta: node 2 is 0 after"},
      {"axis_off_warp", "axis theta: node 2 is 0.7; warp complement-sqrt puts it at"},
      {"axis_in_degrees", "axis phi: node 1 is 29.99999"},
      {"axis_negative", "axis alpha: node 0 is -0.1"},
      {"axis_empty", "axis/phi must be a list of 1 to 64 nodes"},
      {"axis_is_scalar", "axis/phi must be a list of 1 to 64 nodes"},
      {"axis_is_square", "axis/phi must be a list of 1 to 64 nodes"},
      {"axis_of_65", "axis/phi must be a list of 1 to 64 nodes"},
      {"axis_huge", "axis/phi must be a list of 1 to 64 nodes"},
      {"axis_shorter", "matrix has shape (3, 2, 5, 4, 3, 3); expected: (3, 2, 5, 2, 3, 3)"},
      {"matrix_is_f64", "matrix has another type than f32"},
      {"matrix_is_text", "matrix has another type than f32"},
      {"matrix_transposed", "matrix has shape (4, 5, 2, 3, 3, 3)"},
      {"matrix_flat", "matrix has shape (3, 2, 5, 4, 9)"},
      {"matrix_huge", "matrix has shape (1073741824, 2, 5, 4, 3, 3)"},
      {"matrix_has_nan", "matrix of entry (1, 1, 2, 3) is not finite"},
      {"matrix_has_infinity", "matrix of entry (1, 1, 2, 3) is not finite"},
      {"amplitude_is_group", "dataset fresnel is missing"},
      {"status_is_i8", "status has another type than u8"},
      {"status_of_6", "status holds 6; allowed: 0 to 5"},
      {"iterations_are_u32", "iterations has another type than u16"},
  };
  std::set<std::string> expected = {"matrix_rows_for_columns", "format_is_bytes", "other_seed",
                                    "extra_dataset", "one_value_off"};  // tables still
  for (const auto& [name, fault] : faults) {
    expected.insert(name);
    const std::filesystem::path path = folder / (name + ".h5");
    const std::string message = refusal(path);
    EXPECT_NE(message.find(fault), std::string::npos) << name << ": \"" << message << '"';
    EXPECT_TRUE(message.starts_with(path.string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_EQ(written, expected);
}

TEST(Hdf5, ValuesThatTheFileDoesNotHoldItselfAreRefused) {
  const std::map<std::string, std::string> faults = {
      {"virtual_matrix", "matrix is stored in chunks or elsewhere"},
      {"chunked", "matrix is stored in chunks or elsewhere"},
      {"other_files_bytes", "amplitude lies in another file"},
      {"never_written", "matrix has 0 bytes in a file of"},
      {"axes_of_64_never_written", "matrix has 0 bytes in a file of"},
      {"link_to_itself", "fresnel is missing, or no plain link"},
      {"link_to_another_file", "fresnel is missing, or no plain link"},
  };
  for (const auto& [name, fault] : faults) {
    const std::filesystem::path path = LTCFIT_SOURCE_DIR "/tests/fuzz/seeds/hdf5/" + name + ".h5";
    const std::string message = refusal(path);
    EXPECT_NE(message.find(fault), std::string::npos) << name << ": \"" << message << '"';
  }
}

TEST(Hdf5, WhatIsNoHdf5FileIsRefusedAndNothingIsPrinted) {
  const TemporaryFolder folder;
  ::testing::internal::CaptureStderr();
  for (const std::string& bytes : {std::string(), std::string("no table"), std::string(5000, 'x'),
                                   std::string("\x89HDF\r\n\x1a\n", 8)}) {
    testing::write_bytes(folder / "t.h5", bytes);
    EXPECT_NE(refusal(folder / "t.h5").find("no HDF5 file, or a damaged one"), std::string::npos);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, TruncatedAnywhereIsRefused) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.h5");
  const std::string whole = bytes_of(folder / "t.h5");
  ASSERT_GT(whole.size(), 10000u);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    testing::write_bytes(folder / "cut.h5", whole.substr(0, size));
    EXPECT_NE(refusal(folder / "cut.h5"), "") << size << " bytes";
  }
  testing::write_bytes(folder / "cut.h5", whole.substr(0, whole.size() - 1));
  EXPECT_NE(refusal(folder / "cut.h5"), "");
}

// A flipped bit may leave a table, or one of other content; it must not crash or leak.
TEST(Hdf5, FlippedBitsAreRefusedOrHarmlessAndNoHandleStaysOpen) {
  const TemporaryFolder folder;
  write_table(testing::synthetic_table(Grid::paper(2), Storage::matrix), folder / "t.h5");
  const std::string whole = bytes_of(folder / "t.h5");
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); i += 29) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    testing::write_bytes(folder / "t.h5", flipped);
    refused += !refusal(folder / "t.h5").empty();
  }
  EXPECT_GT(refused, 50);
  EXPECT_EQ(H5Fget_obj_count(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_ALL), 0);
}

TEST(Hdf5, MissingAndUnreadableFilesAreIoErrorsThatNameThem) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.h5");
  for (const std::filesystem::path& path : {folder / "none.h5", folder / "folder.h5"}) {
    try {
      read_table(path);
      FAIL() << path;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  }
}

TEST(Hdf5, WritingWhereNothingCanBeWrittenIsAnIoErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_table(example(), folder / "none/t.h5"), IoError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Hdf5, AnInconsistentTableIsRefusedAndAnOlderFileStands) {
  const TemporaryFolder folder;
  write_table(example(), folder / "t.h5");
  const std::string before = bytes_of(folder / "t.h5");
  Table nan = example();
  nan.stored[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_table(nan, folder / "t.h5"), InputError);
  Table shorter = example();
  shorter.amplitude.pop_back();
  EXPECT_THROW(write_table(shorter, folder / "t.h5"), InputError);
  Table unordered = example();
  std::swap(unordered.grid.phi.nodes[0], unordered.grid.phi.nodes[1]);
  EXPECT_THROW(write_table(unordered, folder / "t.h5"), InputError);
  EXPECT_EQ(bytes_of(folder / "t.h5"), before);
}

}  // namespace
}  // namespace ltc
