// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as one NumPy array of matrices, the layout of the published table: M of every node,
// whatever the storage, as f32 (Nalpha, Nlambda, Ntheta, Nphi, 3, 3) in C order.

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/file.h"
#include "core/quantile.h"
#include "core/write_file.h"
#include "export/consistency.h"
#include "export/format.h"
#include "export/isotropic_layout.h"
#include "export/npy_header.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "values are copied as they lie in memory");

constexpr std::size_t max_header_bytes = 4096;  // NumPy's own takes 128

// Exactly `count` bytes, or InputError.
std::string take(std::ifstream& file, std::size_t count, const fs::path& path) {
  std::string bytes(count, '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(count)))
    refuse_file(path, "cut short in the header of the array");
  return bytes;
}

// The header's dictionary, as text.
std::string read_dictionary(std::ifstream& file, const fs::path& path) {
  const std::string start = take(file, npy_magic.size() + 2, path);
  if (!start.starts_with(npy_magic))
    refuse_file(path, "no NumPy array: it does not start with \\x93NUMPY");
  const int major = start[npy_magic.size()];
  if (major < 1 || major > 3)
    refuse_file(path, fmt::format("NumPy format version is {}; allowed: 1 to 3", major));
  std::size_t length = 0;
  const std::string digits = take(file, major == 1 ? 2 : 4, path);
  for (std::size_t i = 0; i < digits.size(); ++i)
    length |= std::size_t{static_cast<unsigned char>(digits[i])} << (8 * i);
  if (length > max_header_bytes)
    refuse_file(path, fmt::format("header of {} bytes; allowed: {}", length, max_header_bytes));
  return take(file, length, path);
}

// What follows 'key': in the dictionary, up to one of `ends`.
std::string_view entry_of(std::string_view dictionary, std::string_view key, std::string_view ends,
                          const fs::path& path) {
  const std::string quoted = fmt::format("'{}':", key);
  const std::size_t found = dictionary.find(quoted);
  if (found == std::string_view::npos)
    refuse_file(path, fmt::format("the array's header has no {}", key));
  std::string_view rest = dictionary.substr(found + quoted.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const std::size_t end = rest.find_first_of(ends);
  if (end == std::string_view::npos)
    refuse_file(path, fmt::format("the array's header is malformed at {}", key));
  return rest.substr(0, end);
}

// The numbers of "(8, 8, 3".
std::vector<std::size_t> parse_shape(std::string_view text, const fs::path& path) {
  std::vector<std::size_t> shape;
  if (!text.starts_with('('))
    refuse_file(path, "the shape of the array is no tuple");
  text.remove_prefix(1);
  while (!text.empty()) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc())
      refuse_file(path, "the shape of the array is no tuple of whole numbers");
    shape.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
  }
  return shape;
}

// Of the isotropic table that Aakash et al. publish beside theirs.
constexpr IsotropicAxes isotropic_axes = {Warp::linear, Warp::linear, 0.99 * std::numbers::pi / 2,
                                          0.01};

Grid read_grid(std::string_view dictionary, const fs::path& path) {
  if (const auto type = entry_of(dictionary, "descr", ",}", path); type != "'<f4'")
    refuse_file(path, fmt::format("type of the array is {}; allowed: '<f4'", type));
  if (const auto order = entry_of(dictionary, "fortran_order", ",}", path); order != "False")
    refuse_file(path, fmt::format("fortran_order of the array is {}; allowed: False", order));
  const auto shape = parse_shape(entry_of(dictionary, "shape", ")", path), path);
  const bool nodes_allowed = std::all_of(
      shape.begin(), shape.end(), [](std::size_t n) { return n >= 1 && n <= max_nodes_per_axis; });
  const bool matrices =
      shape.size() >= 2 && shape[shape.size() - 1] == 3 && shape[shape.size() - 2] == 3;
  if ((shape.size() != 6 && shape.size() != 4) || !nodes_allowed || !matrices)
    refuse_file(path,
                fmt::format("shape of the array is ({}); allowed: (Nalpha, Nlambda, Ntheta, Nphi, "
                            "3, 3) or (Nalpha, Ntheta, 3, 3) with 1 to {} nodes each",
                            fmt::join(shape, ", "), max_nodes_per_axis));
  return shape.size() == 6 ? Grid::paper({shape[0], shape[1], shape[2], shape[3]})
                           : grid_of(isotropic_axes, shape[0], shape[1]);
}

// Reads what follows the header; takes memory only once the file is known to have it.
Table read_matrices(std::ifstream& file, std::uintmax_t file_bytes, const Grid& grid,
                    const fs::path& path) {
  const std::uintmax_t header_bytes = static_cast<std::uintmax_t>(file.tellg());
  const std::uintmax_t value_bytes = 9 * grid.size() * sizeof(float);
  if (file_bytes != header_bytes + value_bytes)
    refuse_file(path, fmt::format("{} bytes long; its shape asks for {}", file_bytes,
                                  header_bytes + value_bytes));
  Table table = Table::empty(grid, Storage::matrix);
  if (!file.read(reinterpret_cast<char*>(table.stored.data()),
                 static_cast<std::streamsize>(value_bytes)))
    throw IoError(fmt::format("cannot read {}: it ended early", path.string()));
  return table;
}

void set_status(Table& table) {
  for (std::size_t i = 0; i < table.grid.size(); ++i)
    table.status[i] = table.stored_at(i).array().isNaN().all() ? Status::skipped : Status::fitted;
}

// An array says nothing of axes: readers take those of Grid::paper, with its own node counts.
std::string limits_of_npy(const Grid& grid, Storage, TextureLayout) {
  Grid expected = Grid::paper(grid.shape());
  expected.model = grid.model;  // of which an array says nothing either
  return grid == expected ? "" : "holds the paper's grid only";
}

std::vector<float> matrices_of(const Table& table) {
  std::vector<float> matrices(9 * table.grid.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (has_values(table.status[flat])) {
      const Eigen::Matrix3f matrix = table.matrix_at(flat).cast<float>();
      for (std::size_t i = 0; i < 9; ++i)
        matrices[9 * flat + i] = matrix(static_cast<int>(i / 3), static_cast<int>(i % 3));
    }
  return matrices;
}

// NaN where an entry is skipped or failed.
void add_npy(platform::FileSet& set, const Table& table, const fs::path& path) {
  const auto [alphas, lambdas, thetas, phis] = table.grid.shape();
  const std::string header =
      npy_header(std::array<std::size_t, 6>{alphas, lambdas, thetas, phis, 3, 3});
  std::vector<float> made;
  const bool as_stored =
      table.storage == Storage::matrix && std::ranges::all_of(table.status, has_values);
  if (!as_stored)
    made = matrices_of(table);
  const std::vector<float>& matrices = as_stored ? table.stored : made;
  const std::string_view values(reinterpret_cast<const char*>(matrices.data()),
                                matrices.size() * sizeof(float));
  const std::array parts = {std::string_view(header), values};
  add_file(set, path, parts);
}

// What the first two axes of such an array hold, by the symmetry that only alpha_x and alpha_y
// give it: exchanging them with x and y and phi with 90 degrees - phi gives the same matrix. Of the
// published tables, one differs from its image by 0.2 % of a matrix in the median, the other by
// half of it. Tables that can have no such symmetry (node counts that differ, one node along phi or
// alpha) are alpha_lambda.
Layout layout_of(const Table& table) {
  const auto [alphas, lambdas, thetas, phis] = table.grid.shape();
  if (alphas != lambdas || alphas == 1 || phis == 1)
    return Layout::alpha_lambda;
  std::vector<double> differences;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const NodeIndex node = table.grid.node(flat);
    const std::size_t image =
        table.grid.flat({node.lambda, node.alpha, node.theta, phis - 1 - node.phi});
    if (node.alpha == node.lambda || !has_values(table.status[flat]) ||
        !has_values(table.status[image]))
      continue;
    const Eigen::Matrix3d matrix = table.stored_at(flat), other = table.stored_at(image);
    const Eigen::PermutationMatrix<3> exchange(Eigen::Vector3i(1, 0, 2));
    if (const double size = matrix.norm(); size > 0)
      differences.push_back((matrix - exchange * other * exchange).norm() / size);
  }
  constexpr double alike = 0.1;
  std::sort(differences.begin(), differences.end());
  return !differences.empty() && quantile(differences, 0.5) < alike ? Layout::alphax_alphay
                                                                    : Layout::alpha_lambda;
}

// The paper's axes, storage `matrix`. Amplitude, Fresnel term and loss are NaN, steps 0; an entry
// of nine NaNs counts as skipped, every other as fitted.
Table read_npy(const fs::path& path, std::optional<Layout> layout) {
  const std::uintmax_t file_bytes = require_readable(path);
  std::ifstream file(path, std::ios::binary);
  const Grid grid = read_grid(read_dictionary(file, path), path);
  Table table = read_matrices(file, file_bytes, grid, path);
  set_status(table);
  require_consistent(table, path);
  if (is_isotropic(grid)) {
    table.read_as =
        "read as an isotropic table over alpha and theta, both linear, up to 89.1 degrees, as "
        "that of Aakash et al. is";
    return table;
  }
  table.grid.layout = layout.value_or(layout_of(table));
  if (table.grid.layout == Layout::alphax_alphay)
    table.read_as =
        "read with axes alpha_x, alpha_y, theta, phi, since exchanging the first two is its "
        "symmetry; layout alpha-lambda reads it otherwise";
  return table;
}

}  // namespace

Format npy_format() {
  return {.name = "NPY",
          .sets = {{".npy"}},
          .asked = &OutputSettings::npy,
          .contents = {.albedo = false, .loss = false},
          .entry_bytes = 9 * 4,
          .without_axes = true,
          .limits = limits_of_npy,
          .read = [](const TableFiles& files,
                     const ReadAs& as) { return read_npy(files.front(), as.axes); },
          .add = [](platform::FileSet& set, const Table& table, const TableFiles& files,
                    const WriteOptions&) { add_npy(set, table, files.front()); }};
}

}  // namespace ltc
