// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Each layout of isotropic tables by what shaders of its kind do with the channels, written down
// here once more.
#include "export/isotropic_layout.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "export/images.h"
#include "export/mirror_table.h"
#include "export/texture_layout.h"

namespace ltc {
namespace {

using Channels = std::vector<double>;

// Of M, the amplitude and the Fresnel term; those of the second image after a gap.
std::vector<Channels> texels(TextureLayout layout, const Eigen::Matrix3d& m, double amplitude,
                             double fresnel) {
  const Eigen::Matrix3d s = m.inverse();
  const Eigen::Matrix3d a = s / s(1, 1), b = s / s(0, 0), c = s / s(2, 2);
  switch (layout) {
    case TextureLayout::ltc:
      return {{a(0, 0), a(2, 0), a(0, 2), a(2, 2)}, {amplitude, fresnel, 0, 0.5}};
    case TextureLayout::eight:
      return {{a(0, 0), a(2, 0), a(0, 2), a(2, 2), amplitude, fresnel, 0, 0.5}};
    case TextureLayout::unity:
      return {{c(0, 0), c(2, 0), c(1, 1), c(0, 2)}};
    case TextureLayout::godot:
      return {{m(0, 0), m(2, 0), m(1, 1), m(0, 2)}, {m(2, 2), amplitude, fresnel, 0}};
    case TextureLayout::ltc_2017_07:
      return {{s(0, 0), s(2, 0), s(1, 1), s(0, 2)}, {s(2, 2), amplitude, fresnel, 0.5}};
    case TextureLayout::ltc_2017_06:
      return {{b(2, 2), b(2, 0), b(1, 1), b(0, 2)}, {amplitude, 1}};
    case TextureLayout::columns:
      return {Channels(m.data(), m.data() + 9), {amplitude}};
    case TextureLayout::inverse_columns:
      return {Channels(s.data(), s.data() + 9)};
    case TextureLayout::rows:
    case TextureLayout::rows_sqrt: {
      const Eigen::Matrix3d transposed = m.transpose();
      return {Channels(transposed.data(), transposed.data() + 9)};
    }
    default:
      return {};
  }
}

std::vector<Image> images_of_texels(TextureLayout layout, const Table& table) {
  std::vector<Image> images;
  for (std::size_t row = 0; row < table.grid.theta.size(); ++row)
    for (std::size_t column = 0; column < table.grid.alpha.size(); ++column) {
      const std::size_t entry = table.grid.flat({column, 0, row, 0});
      const auto parts =
          texels(layout, table.matrix_at(entry), table.amplitude[entry], table.fresnel[entry]);
      images.resize(parts.size());
      for (std::size_t i = 0; i < parts.size(); ++i) {
        images[i].width = table.grid.alpha.size();
        images[i].height = table.grid.theta.size();
        images[i].channels = parts[i].size();
        images[i].values.insert(images[i].values.end(), parts[i].begin(), parts[i].end());
      }
    }
  return images;
}

const TextureLayout layouts[] = {
    TextureLayout::ltc,       TextureLayout::eight,           TextureLayout::unity,
    TextureLayout::godot,     TextureLayout::ltc_2017_07,     TextureLayout::ltc_2017_06,
    TextureLayout::columns,   TextureLayout::inverse_columns, TextureLayout::rows,
    TextureLayout::rows_sqrt,
};

TEST(IsotropicLayout, EachIsToldFromTheOthersAndReadAsItsShadersDo) {
  for (const TextureLayout layout : layouts) {
    const std::string name(name_of(layout));
    const Grid grid = grid_of(isotropic_layout(layout)->axes, 9, 8);
    const Table table = testing::mirror_table(grid, isotropic_layout(layout)->storage);
    const std::vector<Image> images = images_of_texels(layout, table);
    const Table read = table_of(images, TextureLayout::automatic, "t");
    EXPECT_NE(read.read_as.find("read with layout " + name + ","), std::string::npos)
        << read.read_as;
    EXPECT_EQ(read.grid, grid) << name;
    const bool has_amplitude = layout != TextureLayout::unity &&
                               layout != TextureLayout::inverse_columns &&
                               layout != TextureLayout::rows && layout != TextureLayout::rows_sqrt;
    for (std::size_t flat = 0; flat < grid.size(); ++flat) {
      const Eigen::Matrix3d expected = table.matrix_at(flat).normalized();
      EXPECT_NEAR((read.matrix_at(flat).normalized() - expected).norm(), 0, 1e-5)  // floats
          << name << " " << flat;
      EXPECT_TRUE(!has_amplitude || read.amplitude[flat] == table.amplitude[flat]) << name;
    }
    EXPECT_EQ(read.without_albedo, std::isnan(read.fresnel.front())) << name;
    EXPECT_EQ(read.of_any_scale, layout != TextureLayout::ltc && layout != TextureLayout::eight)
        << name;
  }
}

TEST(IsotropicLayout, WhatIsWrittenIsWhatShadersRead) {
  for (const TextureLayout layout :
       {TextureLayout::ltc, TextureLayout::eight, TextureLayout::unity, TextureLayout::godot}) {
    const IsotropicLayout& about = *isotropic_layout(layout);
    const Table table = testing::mirror_table(grid_of(about.axes, 5, 4), about.storage);
    const std::vector<Image> written = images_of(table, layout);
    const std::vector<Image> expected = images_of_texels(layout, table);
    ASSERT_EQ(written.size(), expected.size());
    for (std::size_t i = 0; i < written.size(); ++i)
      for (std::size_t k = 0; k < expected[i].values.size(); ++k) {
        const bool sphere = about.sphere >= 0 && i + 1 == written.size() &&
                            k % written[i].channels == written[i].channels - 1;
        const float value = expected[i].values[k];
        if (!sphere) {
          EXPECT_NEAR(written[i].values[k], value, 1e-5 * (1 + std::abs(value)))  // floats
              << name_of(layout) << " " << i << " " << k;
        }
      }
  }
}

// Godot's shader: from (a, b, c, d) and e the matrix that takes (x, normal, z) to the cosine's
// frame, whose second axis is the cosine's, with z away from the view and x = normal x z.
TEST(IsotropicLayout, GodotsShaderInvertsToTheSameLobe) {
  const IsotropicLayout& about = *isotropic_layout(TextureLayout::godot);
  const Table table = testing::mirror_table(grid_of(about.axes, 4, 4), about.storage);
  const std::vector<Image> images = images_of(table, TextureLayout::godot);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 1; column < 4; ++column) {
      const float* const first = &images[0].values[4 * (4 * row + column)];
      const double a = first[0], b = first[1], c = first[2], d = first[3];
      const double e = images[1].values[4 * (4 * row + column)];
      const double scale = 1 / (a * e - b * d);
      Eigen::Matrix3d inverse;
      inverse << 0, -d * scale, -e * scale, 0, a * scale, b * scale, 1 / c, 0, 0;
      const Eigen::Vector3d omega = Eigen::Vector3d(-0.5, 0.2, 0.6).normalized();
      const Eigen::Vector3d theirs = inverse * Eigen::Vector3d(-omega.y(), omega.z(), -omega.x());
      const Eigen::Vector3d ours =
          table.matrix_at(table.grid.flat({column, 0, row, 0})).inverse() * omega;
      EXPECT_NEAR(theirs.y(), ours.z(), 1e-4 * ours.norm());  // floats, inverted
      EXPECT_NEAR(std::abs(theirs.x()), std::abs(ours.x()), 1e-4 * ours.norm());
      EXPECT_NEAR(std::abs(theirs.z()), std::abs(ours.y()), 1e-4 * ours.norm());
    }
}

TEST(IsotropicLayout, ProgramsOfSeveralTablesAreReadByTheirMatrices) {
  const Grid grid = grid_of(isotropic_layout(TextureLayout::columns)->axes, 8, 8);
  const Table table = testing::mirror_table(grid, Storage::matrix);
  std::vector<Image> images = images_of_texels(TextureLayout::columns, table);
  const std::vector<Image> inverses = images_of_texels(TextureLayout::inverse_columns, table);
  images.insert(images.begin() + 1, inverses.front());
  const Table read = table_of(images, TextureLayout::automatic, "ltc.inc");
  EXPECT_EQ(read.storage, Storage::matrix);
  EXPECT_EQ(read.amplitude, table.amplitude);
  const Table other = table_of(images, TextureLayout::inverse_columns, "ltc.inc");
  EXPECT_EQ(other.storage, Storage::inverse);
  EXPECT_NEAR((other.matrix_at(20).normalized() - table.matrix_at(20).normalized()).norm(), 0,
              1e-5);
}

TEST(IsotropicLayout, LobesThatAreNowhereNearAreRefused) {
  const Table table = testing::mirror_table(
      grid_of(isotropic_layout(TextureLayout::rows)->axes, 8, 8), Storage::matrix);
  std::vector<Image> images = images_of_texels(TextureLayout::rows, table);
  std::reverse(images[0].values.begin(), images[0].values.end());
  testing::expect_refusal([&] { table_of(images, TextureLayout::automatic, "t.h"); },
                          "t.h: images of no layout that is known");
  EXPECT_EQ(table_of(images, TextureLayout::rows, "t.h").grid, table.grid);  // as asked
}

TEST(IsotropicLayout, UnitysIsOfPositiveLastEntriesOnly) {
  const IsotropicLayout& about = *isotropic_layout(TextureLayout::unity);
  Table table = testing::mirror_table(grid_of(about.axes, 3, 3), about.storage);
  table.stored[9 * 4 + 8] = -1e-3f;
  testing::expect_refusal([&] { images_of(table, TextureLayout::unity); },
                          "entry 1,0,1,0: layout unity divides the inverse by its last entry");
  EXPECT_NE(why_not(TextureLayout::unity, testing::isotropic_grid(3, 3), Storage::inverse), "");
}

}  // namespace
}  // namespace ltc
