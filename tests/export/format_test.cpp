// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The list of formats: one that the test adds is read, written and named like those shipped.
#include "export/format.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "core/write_file.h"
#include "export/same_tables.h"
#include "export/table_file.h"
#include "ltcfit/ltcfit.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

// What is interpolated as plain floats in one file, the number of nodes in another; cubes of
// matrices alone.
std::string limits_of_cubes(const Grid& grid, Storage, TextureLayout) {
  return grid == Grid::paper(grid.alpha.size()) ? "" : "holds cubes only";
}

void add_cube(platform::FileSet& set, const Table& table, const TableFiles& files,
              const WriteOptions&) {
  add_file(set, files[0], std::to_string(table.grid.alpha.size()));
  add_file(set, files[1],
           {reinterpret_cast<const char*>(table.stored.data()), 4 * table.stored.size()});
}

Table read_cube(const TableFiles& files, const ReadAs&) {
  std::size_t nodes = 0;
  std::ifstream(files[0]) >> nodes;
  Table table = Table::empty(Grid::paper(nodes), Storage::matrix);
  std::ifstream(files[1], std::ios::binary)
      .read(reinterpret_cast<char*>(table.stored.data()),
            static_cast<std::streamsize>(4 * table.stored.size()));
  table.status.assign(table.grid.size(), Status::fitted);
  return table;
}

Format cubes() {
  return {.name = "Cubes",
          .sets = {{".cube", ".floats"}},
          .contents = {.albedo = false, .loss = false},
          .limits = limits_of_cubes,
          .read = read_cube,
          .add = add_cube};
}

TEST(Format, AnAddedOneIsWrittenReadAndNamed) {
  const test::TemporaryDirectory folder;
  const Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  {
    const AddedFormat added(cubes());
    write_table(table, folder / "t.cube");
    for (const char* name : {"t.cube", "t.floats"})
      testing::expect_same_bits(read_table(folder / name).stored, table.stored, name);
    EXPECT_EQ(files_of_table("d/t.floats"), (TableFiles{"d/t.cube", "d/t.floats"}));
    EXPECT_FALSE(contents_of("t.cube", Table{}).albedo);
    EXPECT_FALSE(is_whole_table("t.cube"));
    EXPECT_EQ(
        endings_text(),
        "_field.json, .h5, .0.exr, .npy, .dds, .ktx2, .bin, .json, .js, .h, .cs, .mat, .inc, .inl, "
        ".glsl, .hlsl, .wgsl, .mjs or .cube");
    test::expect_one_line(test::message_of<InputError>([] { read_table("t.png"); }),
                          {"t.png", ".2.exr", ".cube, .floats"});
    test::expect_one_line(test::message_of<InputError>([&] {
                            write_table(
                                testing::synthetic_table(testing::uneven_grid(), Storage::matrix),
                                folder / "uneven.cube");
                          }),
                          {"uneven.cube", "Cubes", "holds cubes only"});
    // The public header goes by the same list.
    ltcfit::Table::read(folder / "t.cube").write(folder / "again.floats");
    testing::expect_same_bits(read_table(folder / "again.cube").stored, table.stored, "again");
  }
  EXPECT_THROW(read_table(folder / "t.cube"), InputError);
}

TEST(Format, ATableOverBothRoughnessesIsNotWrittenAsOneOverAlphaAndLambda) {
  const test::TemporaryDirectory folder;
  Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  table.grid.layout = Layout::alphax_alphay;
  for (const char* name : {"t.h5", "t.0.exr"}) {
    test::expect_one_line(test::message_of<InputError>([&] { write_table(table, folder / name); }),
                          {name, "alpha_x and alpha_y", "expected alpha and lambda"});
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
  EXPECT_THROW(write_table(table, folder / "t.npy"), InputError);
}

TEST(Format, ThoseShippedSayWhatTheyHold) {
  EXPECT_EQ(
      endings_text(),
      "_field.json, .h5, .0.exr, .npy, .dds, .ktx2, .bin, .json, .js, .h, .cs, .mat, .inc, .inl, "
      ".glsl, .hlsl, .wgsl or .mjs");
  EXPECT_EQ(endings_text(keeps_fits), ".h5");
  EXPECT_EQ(find_format("a.h5.txt"), nullptr);
  EXPECT_TRUE(find_format("a.1.exr")->half);
  EXPECT_EQ(find_format("a.3.exr")->name, "OpenEXR");
  EXPECT_EQ(find_format("a.4.exr"), nullptr);
  EXPECT_TRUE(find_format("a.npy")->without_axes);
  EXPECT_EQ(files_of_table("scene.toml"), TableFiles{"scene.toml"});
}

}  // namespace
}  // namespace ltc
