// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The layouts of isotropic tables (docs/files.md): flat images, a texel a node, column alpha, row
// theta. Each is one line of a list, which says what the channels are and where the nodes lie.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "config/output_settings.h"
#include "export/image.h"
#include "table/axis.h"
#include "table/table.h"

namespace ltc {

struct IsotropicAxes {
  Warp alpha, theta;
  double theta_last_radians;
  double alpha_min = 1e-4;
};

struct IsotropicLayout {
  // Sources of an entry of S that no channel holds; and for a term that none holds.
  static constexpr int zero = -1, one = -2, none = -1;

  TextureLayout layout;
  std::string_view images;  // what they are, after "expected"
  // Of the first image and of the second, which may be left out or, of 0 channels, never is there.
  std::size_t first_channels = 4, second_channels = 0;
  bool second_may_miss = false;
  IsotropicAxes axes;
  Storage storage = Storage::inverse;
  // Channel of each entry of S, row-major, those of the second image counted on from the first's.
  std::array<int, 9> stored;
  int amplitude = none, fresnel = none;
  int sphere = none;      // the clipped sphere's factor (ltc/sphere_clip.h)
  int unit_entry = none;  // the entry of S that is 1; none where S is of any scale
  bool read_only = false;
  std::string_view config = "";                // whose tables it holds
  std::array<std::string_view, 2> names = {};  // of the images

  std::size_t image_count() const { return second_channels > 0 ? 2 : 1; }  // in whole tables
};

// Null for other layouts.
const IsotropicLayout* isotropic_layout(TextureLayout layout);

// The nodes of isotropic tables of this size on such axes.
Grid grid_of(const IsotropicAxes& axes, std::size_t alphas, std::size_t thetas);

// Why it cannot hold tables of this grid and storage, after "it"; empty where it can.
std::string why_not(const IsotropicLayout& layout, const Grid& grid, Storage storage);

// As images_of and table_of of texture_layout.h; the images are those of the layout.
std::vector<Image> isotropic_images(const Table& table, const IsotropicLayout& layout);
Table isotropic_table(const std::vector<Image>& images, const IsotropicLayout& layout,
                      const std::filesystem::path& file);

// Why images are not those of the layout, after "expected"; empty where they may be.
std::string fault_of(const std::vector<Image>& images, const IsotropicLayout& layout);

}  // namespace ltc
