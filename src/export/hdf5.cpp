// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as HDF5: all that is known of every entry. docs/files.md says what lies where.
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/hdf5_file.h"
#include "core/hdf5_guard.h"
#include "core/write_file.h"
#include "export/consistency.h"
#include "export/field_file.h"
#include "export/format.h"
#include "export/hdf5.h"

namespace ltc {

Format hdf5_format();

namespace {

namespace fs = std::filesystem;

const std::string root = "/";

// The attributes `format` and `format_version`.
constexpr const char* table_format = "ltc-table";
constexpr int table_format_version = 1;
// That of a table that a field stands for.
const std::string field_attribute = "field_basis";

std::string axis_dataset(std::string_view axis) {
  return fmt::format("axis/{}", axis);
}

void write_attributes(Hdf5Output& file, const Table& table) {
  file.text(root, "format", table_format);
  file.number(root, "format_version", std::int32_t{table_format_version});
  file.text(root, "brdf", std::string(table.grid.model->name()));
  file.text(root, "storage", std::string(name_of(table.storage)));
  file.number(root, "alpha_min", table.grid.alpha_min);
  file.number(root, "seed", table.seed);
  file.text(root, "generator", table.generator);
  file.text(root, "config", table.config);
  file.text(root, "created", table.created);
  if (table.refined)
    file.number(root, "refined", std::int32_t{*table.refined});
}

void write_axes(Hdf5Output& file, const Grid& grid) {
  file.group("axis");
  for (std::size_t i = 0; i < Grid::axis_count; ++i) {
    const Axis& axis = grid.axis(i);
    const std::string name = axis_dataset(grid.axis_names()[i]);
    file.values<double>(name, {axis.size()}, axis.nodes);
    file.text(name, "warp", std::string(name_of(axis.warp)));
  }
}

// With the shape of one entry's values, none of a single one.
std::vector<std::size_t> entry_shape(const Grid& grid, std::vector<std::size_t> of_entry = {}) {
  const auto shape = grid.shape();
  of_entry.insert(of_entry.begin(), shape.begin(), shape.end());
  return of_entry;
}

void write_entries(Hdf5Output& file, const Table& table) {
  const std::vector<std::size_t> shape = entry_shape(table.grid);
  file.values<float>("matrix", entry_shape(table.grid, {3, 3}), table.stored);
  file.values<float>("amplitude", shape, table.amplitude);
  file.values<float>("fresnel", shape, table.fresnel);
  file.values<float>("sw_loss", shape, table.sw_loss);
  static_assert(sizeof(Status) == 1);
  const std::span<const Status> status(table.status);
  file.values<std::uint8_t>("status", shape,
                            {reinterpret_cast<const std::uint8_t*>(status.data()), status.size()});
  file.values<std::uint16_t>("iterations", shape, table.iterations);
  if (!is_folded(table))
    return;
  file.values<float>("fold", entry_shape(table.grid, {2}), table.fold);
  file.values<double>("creases", {table.creases.size()}, table.creases);
}

// A row a term: its part, then its numbers.
constexpr std::size_t term_bytes = 1 + std::tuple_size_v<decltype(numbers_of({}))>;

void write_field(Hdf5Output& file, const Field& field) {
  file.text(root, field_attribute, std::string(basis_name(!field.creases.empty())));
  file.group("field");
  std::vector<std::uint8_t> rows;
  for (const FieldTerm& term : field.terms) {
    rows.push_back(static_cast<std::uint8_t>(term.part));
    std::ranges::copy(numbers_of(term), std::back_inserter(rows));
  }
  file.values<std::uint8_t>("field/terms", {field.terms.size(), term_bytes}, rows);
  file.values<float>("field/coefficients", {field.terms.size()}, field.coefficients);
}

void require_format(const Hdf5Input& file, const fs::path& path) {
  if (const std::string format = file.text(root, "format"); format != table_format)
    throw InputError(fmt::format("{}: attribute format is \"{}\"; allowed: \"{}\"", path.string(),
                                 format, table_format));
  if (const std::int64_t version = file.integer(root, "format_version");
      version != table_format_version)
    throw InputError(fmt::format("{}: attribute format_version is {}; allowed: {}", path.string(),
                                 version, table_format_version));
}

// Names the file when a name in it is not known.
template <typename FromName>
auto named(const Hdf5Input& file, const fs::path& path, const std::string& object,
           const std::string& attribute, FromName from_name) {
  const std::string name = file.text(object, attribute);
  try {
    return from_name(name);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: attribute {} of {}: {}", path.string(), attribute, object, error.what()));
  }
}

Axis read_axis(const Hdf5Input& file, const fs::path& path, const std::string& name) {
  const std::vector<std::size_t> shape = file.shape(name);
  if (shape.size() != 1 || shape[0] < 1 || shape[0] > max_nodes_per_axis)
    throw InputError(fmt::format("{}: dataset {} must be a list of 1 to {} nodes", path.string(),
                                 name, max_nodes_per_axis));
  Axis axis;
  axis.nodes = file.values<double>(name, shape);
  axis.warp = named(file, path, name, "warp", value_named<Warp>);
  return axis;
}

Grid read_grid(const Hdf5Input& file, const fs::path& path) {
  Grid grid;
  for (std::size_t i = 0; i < Grid::axis_count; ++i)
    grid.axis(i) = read_axis(file, path, axis_dataset(grid.axis_names()[i]));
  grid.alpha_min = file.real(root, "alpha_min");
  grid.model =
      named(file, path, root, "brdf", [](std::string_view name) { return &lobe_model(name); });
  require_consistent(grid, path);
  return grid;
}

// Nothing where the file does not say.
std::optional<bool> read_refined(const Hdf5Input& file, const fs::path& path) {
  if (!file.has_attribute(root, "refined"))
    return std::nullopt;
  const std::int64_t refined = file.integer(root, "refined");
  if (refined != 0 && refined != 1)
    throw InputError(
        fmt::format("{}: attribute refined is {}; allowed: 0 and 1", path.string(), refined));
  return refined == 1;
}

void read_attributes(const Hdf5Input& file, const fs::path& path, Table& table) {
  table.storage = named(file, path, root, "storage", value_named<Storage>);
  table.seed = file.natural(root, "seed");
  table.generator = file.text(root, "generator");
  table.config = file.text(root, "config");
  table.created = file.text(root, "created");
  table.refined = read_refined(file, path);
}

std::vector<Status> read_status(const Hdf5Input& file, const fs::path& path,
                                const std::vector<std::size_t>& shape) {
  const std::vector<std::uint8_t> raw = file.values<std::uint8_t>("status", shape);
  std::vector<Status> status(raw.size());
  std::transform(raw.begin(), raw.end(), status.begin(), [&path](std::uint8_t value) {
    if (value > static_cast<std::uint8_t>(Status::interpolated))
      throw InputError(
          fmt::format("{}: dataset status holds {}; allowed: 0 to 5", path.string(), value));
    return static_cast<Status>(value);
  });
  return status;
}

void read_entries(const Hdf5Input& file, const fs::path& path, Table& table) {
  const std::vector<std::size_t> shape = entry_shape(table.grid);
  table.stored = file.values<float>("matrix", entry_shape(table.grid, {3, 3}));
  table.amplitude = file.values<float>("amplitude", shape);
  table.fresnel = file.values<float>("fresnel", shape);
  table.sw_loss = file.values<float>("sw_loss", shape);
  table.status = read_status(file, path, shape);
  table.iterations = file.values<std::uint16_t>("iterations", shape);
  if (!is_folded(table))
    return;
  table.fold = file.values<float>("fold", entry_shape(table.grid, {2}));
  const std::vector<std::size_t> creases = file.shape("creases");
  if (creases.size() != 1 || creases[0] < 1 || creases[0] > most_creases)
    throw InputError(fmt::format("{}: dataset creases must be a list of 1 to {} numbers",
                                 path.string(), most_creases));
  table.creases = file.values<double>("creases", creases);
}

std::optional<Field> read_field(const Hdf5Input& file, const fs::path& path, const Table& table) {
  if (!file.has_attribute(root, field_attribute))
    return std::nullopt;
  const std::string basis = file.text(root, field_attribute);
  if (const std::string_view allowed = basis_name(is_folded(table)); basis != allowed)
    throw InputError(fmt::format("{}: attribute {} is \"{}\"; allowed: \"{}\"", path.string(),
                                 field_attribute, basis, allowed));
  const std::vector<std::size_t> shape = file.shape("field/coefficients");
  const std::size_t count = shape.size() == 1 ? shape[0] : 0;
  const auto rows = file.values<std::uint8_t>("field/terms", {count, term_bytes});
  Field field{table.grid.alpha_min,
              table.grid.model,
              {},
              table.creases,
              {},
              file.values<float>("field/coefficients", {count})};
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const row = rows.data() + i * term_bytes;
    if (row[0] >= field_part_count)
      throw InputError(fmt::format("{}: dataset field/terms names part {}; allowed: 0 to {}",
                                   path.string(), row[0], field_part_count - 1));
    field.terms.push_back({static_cast<FieldPart>(row[0]), row[1], row[2], row[3], row[4], row[5]});
  }
  require_consistent(field, path);
  return field;
}

Table read_hdf5(const fs::path& path) {
  require_harmless(path, [&path] { read_hdf5_unguarded(path); });
  return read_hdf5_unguarded(path);
}

void add_hdf5(platform::FileSet& set, const Table& table, const fs::path& path) {
  if (table.field && table.field->material)
    throw InputError(fmt::format("{}: HDF5 holds fields of all materials, and this is one of one",
                                 path.string()));
  // Beside the entries some pages: attributes, axes, what the library keeps.
  constexpr std::size_t all_else = std::size_t{4} << 20;
  Hdf5Output file(path.string(), table.grid.size() * hdf5_format().entry_bytes + all_else);
  write_attributes(file, table);
  write_axes(file, table.grid);
  write_entries(file, table);
  if (table.field)
    write_field(file, *table.field);
  add_file(set, path, file.finish());
}

}  // namespace

Table read_hdf5_unguarded(const fs::path& path) {
  const Hdf5Input file(path);
  require_format(file, path);
  Table table;
  table.grid = read_grid(file, path);
  read_attributes(file, path, table);
  read_entries(file, path, table);
  table.field = read_field(file, path, table);
  require_consistent(table, path);
  return table;
}

Format hdf5_format() {
  return {.name = "HDF5",
          .sets = {{".h5"}},
          .asked = &OutputSettings::hdf5,
          .entry_bytes = 12 * 4 + 3,  // matrix, albedos, loss; status, steps
          .of_folded = true,
          .read = [](const TableFiles& files, const ReadAs&) { return read_hdf5(files.front()); },
          .add = [](platform::FileSet& set, const Table& table, const TableFiles& files,
                    const WriteOptions&) { add_hdf5(set, table, files.front()); }};
}

}  // namespace ltc
