// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// NPY: read back by NumPy, by our reader, the published table, and everything that must be refused.
#include "export/table_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/error.h"
#include "export/files.h"
#include "export/npy_header.h"
#include "export/same_tables.h"
#include "support/reference.h"
#include "support/temporary_directory.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

using testing::bytes_of;
using testing::Finished;
using testing::TemporaryFolder;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// The paper's ranges with node counts that cannot be mistaken for one another; one entry skipped.
Table example(Storage storage) {
  Table table = testing::synthetic_table(Grid::paper({3, 2, 5, 4}), storage);
  table.set_stored(17, Eigen::Matrix3d::Constant(nan));
  table.status[17] = Status::skipped;
  return table;
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_table(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

nlohmann::json expectation(const Table& table) {
  nlohmann::json expected;
  expected["shape"] = {3, 2, 5, 4, 3, 3};
  for (std::size_t i = 0; i < table.grid.size(); ++i)
    for (int k = 0; k < 9; ++k) {
      const auto value = static_cast<float>(table.matrix_at(i)(k / 3, k % 3));
      expected["values"].push_back(std::isnan(value) ? nlohmann::json() : nlohmann::json(value));
    }
  return expected;
}

TEST(Npy, NumpyFindsTheMatrixOfEveryNodeWhateverTheStorage) {
  const TemporaryFolder folder;
  const std::string arguments = (folder / "t.npy").string() + " " + (folder / "t.json").string();
  for (const Storage storage : {Storage::matrix, Storage::mirror_frame}) {
    const Table table = example(storage);
    testing::write_bytes(folder / "t.json", expectation(table).dump());
    write_table(table, folder / "t.npy");
    const Finished check = testing::run_python("check_npy.py", arguments);
    EXPECT_EQ(check.exit_code, 0) << check.output;
  }
  // And the check can fail: S itself is not M.
  Table stored = example(Storage::mirror_frame);
  stored.storage = Storage::matrix;
  write_table(stored, folder / "t.npy");
  const Finished check = testing::run_python("check_npy.py", arguments);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_EQ(check.output, "check_npy: other values\n");
}

TEST(Npy, OurReaderGivesTheMatricesBack) {
  const TemporaryFolder folder;
  const Table table = example(Storage::matrix);
  write_table(table, folder / "t.npy");
  const Table found = read_table(folder / "t.npy");
  EXPECT_EQ(found.grid, table.grid);
  EXPECT_EQ(found.storage, Storage::matrix);
  testing::expect_same_bits(found.stored, table.stored, "stored");
  for (std::size_t i = 0; i < table.grid.size(); ++i) {
    EXPECT_EQ(found.status[i], i == 17 ? Status::skipped : Status::fitted);
    EXPECT_TRUE(std::isnan(found.amplitude[i]) && std::isnan(found.fresnel[i]));
  }
}

TEST(Npy, TheSameTableGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_table(example(Storage::matrix), folder / "a.npy");
  write_table(example(Storage::matrix), folder / "b.npy");
  EXPECT_EQ(bytes_of(folder / "a.npy"), bytes_of(folder / "b.npy"));
}

TEST(Npy, OtherAxesThanThePapersAreRefused) {
  const TemporaryFolder folder;
  const Format& npy = *find_format("t.npy");
  EXPECT_EQ(npy.why_not(Grid::paper({3, 1, 5, 4}), Storage::matrix, TextureLayout::automatic), "");
  EXPECT_NE(npy.why_not(testing::uneven_grid(), Storage::matrix, TextureLayout::automatic), "");
  Grid other = Grid::paper();
  other.alpha_min = 1e-3;
  EXPECT_NE(npy.why_not(other, Storage::matrix, TextureLayout::automatic), "");
  EXPECT_THROW(write_table(testing::synthetic_table(testing::uneven_grid(), Storage::matrix),
                           folder / "t.npy"),
               InputError);
  EXPECT_THROW(write_table(example(Storage::matrix), folder / "none/t.npy"), IoError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// A file with this dictionary and as many zero bytes of values as one entry takes.
std::string array_of(std::string dictionary) {
  dictionary += '\n';
  const auto length = static_cast<char>(dictionary.size());
  return std::string("\x93NUMPY\x01\x00", 8) + length + '\0' + dictionary + std::string(36, '\0');
}

TEST(Npy, OtherFilesAreRefusedByNameAndFault) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "t.npy";
  write_table(example(Storage::matrix), path);
  const std::string whole = bytes_of(path);
  std::string partly_nan = whole;
  std::memcpy(partly_nan.data() + whole.size() - 4, &nan, 4);
  const std::pair<std::string, std::string> cases[] = {
      {"", "cut short in the header"},
      {"PK\x03\x04 a zip file", "no NumPy array"},
      {whole.substr(0, 9), "cut short in the header"},
      {whole.substr(0, 60), "cut short in the header"},
      {whole.substr(0, whole.size() - 1), "bytes long; its shape asks for"},
      {whole + '\0', "bytes long; its shape asks for"},
      {partly_nan, "matrix of entry (2, 1, 4, 3) is not finite"},
      {std::string("\x93NUMPY\x09\x00", 8) + whole.substr(8), "format version is 9"},
      {std::string("\x93NUMPY\x01\x00\xff\xff", 10) + whole.substr(10), "header of 65535 bytes"},
      {std::string("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12), "header of 4294967295 bytes"},
      {array_of("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1, 1, 3, 3), }"),
       "type of the array is '<f8'; allowed: '<f4'"},
      {array_of("{'descr': '>f4', 'fortran_order': False, 'shape': (1, 1, 1, 1, 3, 3), }"),
       "type of the array is '>f4'"},
      {array_of("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 1, 1, 1, 3, 3), }"),
       "fortran_order of the array is True"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 1, 9), }"),
       "shape of the array is (1, 1, 1, 9)"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3, 1, 1, 1, 1), }"),
       "shape of the array is (3, 3, 1, 1, 1, 1)"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (65, 1, 1, 1, 3, 3), }"),
       "shape of the array is (65, 1, 1, 1, 3, 3)"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (0, 1, 1, 1, 3, 3), }"),
       "shape of the array is (0, 1, 1, 1, 3, 3)"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (64, 64, 64, 64, 3, 3), }"),
       "bytes long; its shape asks for"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 99999999999999999999, 1)}"),
       "no tuple of whole numbers"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1, -1, 1, 1, 3, 3)}"),
       "no tuple of whole numbers"},
      {array_of("{'descr': '<f4', 'fortran_order': False, 'shape': 9)}"), "is no tuple"},
      {array_of("{'descr': '<f4', 'fortran_order': False, }"), "header has no shape"},
      {array_of("{'fortran_order': False, 'shape': (1, 1, 1, 1, 3, 3), }"), "header has no descr"},
      {array_of("{'descr': '<f4'"), "malformed at descr"},
  };
  for (const auto& [bytes, fault] : cases) {
    testing::write_bytes(path, bytes);
    const std::string message = refusal(path);
    EXPECT_NE(message.find(fault), std::string::npos) << fault << ": \"" << message << '"';
    EXPECT_TRUE(message.starts_with(path.string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  testing::write_bytes(
      path, array_of("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 1, 1, 3, 3), }"));
  EXPECT_EQ(refusal(path), "") << "the frame of the cases above is good";
}

std::filesystem::path published_table() {
  return test::reference_file("upstream_alpha_lambda_theta_phi.npy");
}

TEST(Npy, ThePublishedTableReadsAsThePapersGrid) {
  if (!std::filesystem::exists(published_table()))
    GTEST_SKIP() << "no reference table at " << published_table()
                 << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  const Table table = read_table(published_table());
  EXPECT_EQ(table.grid, Grid::paper());
  // Seen from above, an isotropic lobe of roughness 1 is the same in x and y, to within the fit.
  const Eigen::Matrix3d rough = table.matrix_at(table.grid.flat({7, 7, 0, 0}));
  EXPECT_NEAR(rough(0, 0), rough(1, 1), 0.05);
  EXPECT_NEAR(rough(2, 2), 1, 1e-5);  // third column of unit length, zeros elsewhere in it
}

// What their program says of it: fit_alpha_theta.py.
TEST(Npy, AnArrayOverAlphaAndThetaIsTheIsotropicOneOfThePaper) {
  const test::TemporaryDirectory folder;
  std::vector<float> values;
  for (int node = 0; node < 2 * 3; ++node)
    values.insert(values.end(), {1, 0, 0, 0, 1, 0, 0, 0, static_cast<float>(node + 1)});
  folder.write("alpha_theta.npy",
               npy_header(std::array<std::size_t, 4>{2, 3, 3, 3})
                   .append(reinterpret_cast<const char*>(values.data()), 4 * values.size()));
  const Table table = read_table(folder / "alpha_theta.npy");
  EXPECT_EQ(table.grid.shape(), (std::array<std::size_t, 4>{2, 1, 3, 1}));
  EXPECT_EQ(table.grid.lobe({0, 0, 0, 0}).alpha_x, 0.01);
  EXPECT_NEAR(table.grid.lobe({0, 0, 2, 0}).theta_radians, 0.99 * std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(table.matrix_at(table.grid.flat({1, 0, 0, 0}))(2, 2), 4);
  EXPECT_NE(table.read_as.find("isotropic table"), std::string::npos);
  folder.write("t.npy", npy_header(std::array<std::size_t, 4>{2, 3, 3, 2}));
  EXPECT_NE(refusal(folder / "t.npy").find("or (Nalpha, Ntheta, 3, 3)"), std::string::npos);
}

TEST(ReadTable, GoesBySuffix) {
  const TemporaryFolder folder;
  Table table = testing::synthetic_table(Grid::paper(2), Storage::matrix);
  write_table(table, folder / "t.h5");
  write_table(table, folder / "t.0.exr");
  write_table(table, folder / "t.npy");
  for (const char* name : {"t.h5", "t.npy", "t.0.exr", "t.1.exr", "t.2.exr"})
    testing::expect_same_bits(read_table(folder / name).stored, table.stored, name);
  for (const char* name : {"t.exr", "t.3.exr", "t.txt", "t"})
    EXPECT_THROW(read_table(folder / name), InputError) << name;
  EXPECT_THROW(read_table(folder / "none.npy"), IoError);
  EXPECT_THROW(read_table(folder / "none.0.exr"), IoError);
  EXPECT_THROW(read_table(folder / "none.h5"), IoError);
}

// The other published layout, by its closed form: both roughnesses up to 1.
Table of_both_roughnesses() {
  Grid grid = Grid::paper(4);
  grid.layout = Layout::alphax_alphay;
  return testing::synthetic_table(grid, Storage::matrix);
}

void write_as_npy(Table table, const std::filesystem::path& path) {
  table.grid.layout = Layout::alpha_lambda;  // the array says nothing of it
  write_table(table, path);
}

TEST(Npy, TheLayoutIsToldBySymmetryOrByTheReader) {
  const TemporaryFolder folder;
  const Table both = of_both_roughnesses();
  write_as_npy(both, folder / "both.npy");
  write_table(testing::synthetic_table(Grid::paper(4), Storage::matrix), folder / "ratio.npy");
  EXPECT_EQ(read_table(folder / "both.npy").grid, both.grid);
  EXPECT_EQ(read_table(folder / "ratio.npy").grid, Grid::paper(4));
  EXPECT_EQ(read_table(folder / "both.npy", {Layout::alpha_lambda}).grid, Grid::paper(4));
  EXPECT_EQ(read_table(folder / "ratio.npy", {Layout::alphax_alphay}).grid, both.grid);
  // No exchange of axes that differ.
  write_table(testing::synthetic_table(Grid::paper({3, 2, 2, 2}), Storage::matrix),
              folder / "uneven.npy");
  EXPECT_EQ(read_table(folder / "uneven.npy").grid.layout, Layout::alpha_lambda);
  EXPECT_THROW(write_table(both, folder / "t.npy"), InputError);
}

TEST(Npy, ThePublishedTablesAreToldApart) {
  const auto other = test::reference_file("alphax_alphay_theta_phi.npy");
  const auto published = test::reference_file("upstream_alpha_lambda_theta_phi.npy");
  if (!std::filesystem::exists(other) || !std::filesystem::exists(published))
    GTEST_SKIP() << "no " << other << " or " << published
                 << "; set LTCFIT_REFERENCE_DIR to the folder that has them";
  EXPECT_EQ(read_table(other).grid.layout, Layout::alphax_alphay);
  EXPECT_EQ(read_table(published).grid.layout, Layout::alpha_lambda);
}

}  // namespace
}  // namespace ltc
