// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/texture_layout.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/error.h"
#include "export/files.h"
#include "export/mirror_table.h"
#include "export/same_tables.h"
#include "export/table_file.h"
#include "ltc/sphere_clip.h"
#include "support/reference.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

Table mirror_table(std::size_t alphas, std::size_t thetas) {
  return testing::mirror_table(testing::isotropic_grid(alphas, thetas), Storage::inverse);
}

TEST(TextureLayout, EveryFormatGivesBackTheTableThatItHolds) {
  const test::TemporaryDirectory folder;
  const Table isotropic = mirror_table(5, 4);
  Table paper = testing::synthetic_table(Grid::paper({3, 3, 5, 4}), Storage::matrix);
  paper.status.assign(paper.grid.size(), Status::fitted);
  const auto expect_back = [&](const Table& table, const char* name, TextureLayout layout) {
    const std::filesystem::path file = folder / name;
    WriteOptions options;
    options.layout = layout;
    write_table(table, file, options);
    const TableFiles files =
        set_of(file).format->files(set_of(file).prefix, table.grid, table.storage, layout);
    // Text knows no 3-D: the layers of an array are what was written.
    const Table back = read_table(files.front(), {{}, resolved(layout, table.grid, table.storage)});
    EXPECT_EQ(back.grid, table.grid) << name;
    EXPECT_EQ(back.storage, table.storage) << name;
    EXPECT_EQ(back.stored, table.stored) << name;  // zeros lose their sign
    testing::expect_same_bits(back.amplitude, table.amplitude, name);
    testing::expect_same_bits(back.fresnel, table.fresnel, name);
  };
  for (const char* name : {"i.dds", "i.ktx2", "i.bin", "i.json", "i.js", "i.h"})
    expect_back(isotropic, name, TextureLayout::automatic);
  expect_back(isotropic, "eight.bin", TextureLayout::eight);
  for (const char* name : {"v.dds", "v.ktx2", "v.bin", "v.json", "v.js", "v.h"})
    expect_back(paper, name, TextureLayout::automatic);
  for (const char* name : {"s.dds", "s.ktx2", "s.bin"})
    expect_back(paper, name, TextureLayout::stacked);
  for (const char* name : {"a.dds", "a.ktx2", "a.bin", "a.json", "a.js", "a.h"})
    expect_back(paper, name, TextureLayout::array);
}

TEST(TextureLayout, ChannelsAreThoseOfTheTablesThatEnginesShip) {
  const Table table = mirror_table(3, 3);
  const std::vector<Image> images = images_of(table, TextureLayout::ltc);
  ASSERT_EQ(images.size(), 2u);
  const std::size_t alpha = 1, theta = 2, texel = 4 * (theta * 3 + alpha);
  const Eigen::Matrix3d s = table.stored_at(table.grid.flat({alpha, 0, theta, 0}));
  const float expected[] = {float(s(0, 0)), float(s(2, 0)), float(s(0, 2)), float(s(2, 2))};
  for (std::size_t channel = 0; channel < 4; ++channel)
    EXPECT_EQ(images[0].values[texel + channel], expected[channel]) << channel;
  EXPECT_EQ(images[1].values[texel], table.amplitude[table.grid.flat({alpha, 0, theta, 0})]);
  EXPECT_EQ(images[1].values[texel + 2], 0.0f);
  // Column (cos + 1)/2 = 1/2, row 1: half of a hemisphere's light.
  EXPECT_EQ(images[1].values[texel + 3], static_cast<float>(clipped_sphere_factor(0, 1)));
}

TEST(TextureLayout, AreToldApartByWhereTheLobesLie) {
  const Table table = mirror_table(8, 8);
  const std::vector<Image> images = images_of(table, TextureLayout::ltc);
  const Table read = table_of(images, TextureLayout::automatic, "t");
  EXPECT_NE(read.read_as.find("layout ltc,"), std::string::npos) << read.read_as;
}

TEST(TextureLayout, RefusesWhatItCannotHold) {
  const test::TemporaryDirectory folder;
  const Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  WriteOptions options;
  options.layout = TextureLayout::ltc;
  test::expect_one_line(
      test::message_of<InputError>([&] { write_table(table, folder / "t.dds", options); }),
      {"t_1.dds", "isotropic tables of storage inverse only"});
  const Table isotropic = mirror_table(4, 4);
  options.layout = TextureLayout::eight;
  test::expect_one_line(
      test::message_of<InputError>([&] { write_table(isotropic, folder / "t.ktx2", options); }),
      {"KTX2 cannot hold this table", "four channels a texel"});
  Table bare = isotropic;
  bare.amplitude[5] = NAN;
  test::expect_one_line(
      test::message_of<InputError>([&] { write_table(bare, folder / "t.json"); }),
      {"t.json: the table has no amplitude or no Fresnel term at entry (1, 0, 1, 0)"});
  EXPECT_NE(why_not(TextureLayout::volumes, testing::uneven_grid(), Storage::matrix), "");
  EXPECT_NE(why_not(TextureLayout::volumes, Grid::paper(3), Storage::mirror_frame), "");
  EXPECT_NE(why_not(TextureLayout::ltc_2017_07, testing::isotropic_grid(4, 4), Storage::inverse),
            "");
  Image odd;
  odd.width = odd.height = 4;
  odd.channels = 3;
  odd.values.assign(48, 1);
  test::expect_one_line(
      test::message_of<InputError>([&] { table_of({odd}, TextureLayout::automatic, "odd.json"); }),
      {"odd.json", "images of no table", "four channels (ltc)"});
  odd.channels = 4;
  odd.values.assign(64, 1);
  odd.values[5] = NAN;
  EXPECT_THROW(table_of({odd}, TextureLayout::ltc, "nan.dds"), InputError);
}

// The published tables: 16 bits of values of about 1.
TEST(TextureLayout, TheClippedSphereIsThePublishedOne) {
  const auto file = test::reference_file("ltc_code_2.dds");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no reference file ltc_code_2.dds";
  const std::string bytes = testing::bytes_of(file);
  ASSERT_EQ(bytes.size(), 128u + 64 * 64 * 8);
  double largest = 0;
  for (std::size_t row = 1; row < 64; ++row)
    for (std::size_t column = 0; column < 64; ++column) {
      Eigen::half value;
      std::memcpy(&value, bytes.data() + 128 + 8 * (64 * row + column) + 6, 2);
      const double found = clipped_sphere_factor(2 * static_cast<double>(column) / 63 - 1,
                                                 static_cast<double>(row) / 63);
      largest = std::max(largest, std::abs(found - static_cast<double>(value)));
    }
  EXPECT_LT(largest, 1e-3);
}

TEST(SphereClip, IsTheCosineAboveTheHorizonAndNothingBelow) {
  EXPECT_DOUBLE_EQ(clipped_sphere_factor(0.9, 0.25), 0.9);
  EXPECT_DOUBLE_EQ(clipped_sphere_factor(-0.9, 0.25), 0.0);
  // The whole hemisphere about the normal, and a half of it.
  EXPECT_NEAR(clipped_sphere_factor(1, 1), 1, 1e-12);
  EXPECT_NEAR(clipped_sphere_factor(0, 1), 0.5, 1e-12);
  // Continuous where the horizon begins to cut.
  EXPECT_NEAR(clipped_sphere_factor(0.5 - 1e-9, 0.25), 0.5, 1e-6);
  EXPECT_NEAR(clipped_sphere_factor(-0.5 + 1e-9, 0.25), 0, 1e-6);
  // A small sphere on the horizon, by the integral of the half disc: 4/3 sigma^3 / 2 over pi
  // sigma^2.
  const double sigma = 1e-3;
  EXPECT_NEAR(clipped_sphere_factor(0, std::sin(sigma) * std::sin(sigma)),
              2 * sigma / (3 * std::numbers::pi), 1e-6);
}

}  // namespace
}  // namespace ltc
