// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/isotropic_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/error.h"
#include "export/consistency.h"
#include "export/nearest.h"
#include "ltc/sphere_clip.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

constexpr int zero = IsotropicLayout::zero, one = IsotropicLayout::one,
              none = IsotropicLayout::none;
constexpr int middle = 4, last = 8;  // entries of S
constexpr double right_angle = std::numbers::pi / 2;
constexpr IsotropicAxes engine_axes = {Warp::sqrt, Warp::half_sine, right_angle};
// Which channels S has: four with the middle entry 1; five; nine, as engines' row vectors have them
// and as the paper's columns do.
constexpr std::array<int, 9> middle_one = {0, zero, 2, zero, one, zero, 1, zero, 3};
constexpr std::array<int, 9> of_five = {0, zero, 3, zero, 2, zero, 1, zero, 4};
constexpr std::array<int, 9> by_columns = {0, 3, 6, 1, 4, 7, 2, 5, 8};
constexpr std::array<int, 9> by_rows = {0, 1, 2, 3, 4, 5, 6, 7, 8};
constexpr std::string_view nine = "one flat image of nine channels";

// Of the paper's authors, over theta and either axis of roughness.
constexpr IsotropicLayout by_rows_over(TextureLayout layout, Warp alpha) {
  return {.layout = layout,
          .images = nine,
          .first_channels = 9,
          .axes = {alpha, Warp::linear, steepest_theta},
          .storage = Storage::matrix,
          .stored = by_rows,
          .read_only = true};
}

constexpr IsotropicLayout layouts[] = {
    {.layout = TextureLayout::ltc,
     .images = "one or two flat images of four channels",
     .second_channels = 4,
     .second_may_miss = true,
     .axes = engine_axes,
     .stored = middle_one,
     .amplitude = 4,
     .fresnel = 5,
     .sphere = 7,
     .unit_entry = middle,
     .config = "isotropic",
     .names = {"LTC_MAT_1", "LTC_MAT_2"}},
    {.layout = TextureLayout::ltc_2017_07,
     .images = "two flat images of four channels",
     .second_channels = 4,
     .axes = engine_axes,
     .stored = of_five,
     .amplitude = 5,
     .fresnel = 6,
     .read_only = true},
    {.layout = TextureLayout::ltc_2017_06,
     .images = "one flat image of four channels and one of two",
     .second_channels = 2,
     .second_may_miss = true,
     .axes = {Warp::sqrt, Warp::linear, 1.57079},
     .stored = {one, zero, 3, zero, 2, zero, 1, zero, 0},
     .amplitude = 4,
     .unit_entry = 0,
     .read_only = true},
    {.layout = TextureLayout::eight,
     .images = "one flat image of eight channels",
     .first_channels = 8,
     .axes = engine_axes,
     .stored = middle_one,
     .amplitude = 4,
     .fresnel = 5,
     .sphere = 7,
     .unit_entry = middle,
     .config = "isotropic",
     .names = {"LTC"}},
    {.layout = TextureLayout::unity,
     .images = "one flat image of four channels",
     .axes = {Warp::sqrt, Warp::half_sine, right_angle, 1e-3},
     .stored = {0, zero, 3, zero, 2, zero, 1, zero, one},
     .unit_entry = last,
     .config = "unity",
     .names = {"s_LtcMatrixData_BRDF_GGX"}},
    {.layout = TextureLayout::godot,
     .images = "two flat images of four channels",
     .second_channels = 4,
     .axes = {Warp::sqrt, Warp::linear, right_angle},
     .storage = Storage::matrix,
     .stored = of_five,
     .amplitude = 5,
     .fresnel = 6,
     .config = "godot",
     .names = {"ltc_lut1", "ltc_lut2"}},
    {.layout = TextureLayout::columns,
     .images = nine,
     .first_channels = 9,
     .second_channels = 1,
     .second_may_miss = true,
     .axes = engine_axes,
     .storage = Storage::matrix,
     .stored = by_columns,
     .amplitude = 9,
     .read_only = true},
    {.layout = TextureLayout::inverse_columns,
     .images = nine,
     .first_channels = 9,
     .axes = engine_axes,
     .stored = by_columns,
     .read_only = true},
    by_rows_over(TextureLayout::rows, Warp::linear),
    by_rows_over(TextureLayout::rows_sqrt, Warp::sqrt),
};

// The clipped sphere's factor of a texel: column (cos + 1)/2, row the form factor.
float sphere_factor(std::size_t column, std::size_t row, const Image& image) {
  const auto share = [](std::size_t i, std::size_t n) {
    return n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.0;
  };
  return static_cast<float>(
      clipped_sphere_factor(2 * share(column, image.width) - 1, share(row, image.height)));
}

// The channels of all images of a node, one after the other.
using Channels = std::vector<float>;

Channels channels_of(const Table& table, std::size_t entry, const IsotropicLayout& layout) {
  Channels channels(layout.first_channels + layout.second_channels);
  const auto set = [&](int channel, float value) {
    if (channel >= 0)
      channels[static_cast<std::size_t>(channel)] = value;
  };
  const float* const s = &table.stored[9 * entry];
  const float unit = layout.unit_entry == none ? 1 : s[layout.unit_entry];
  if (!(unit > 0))
    throw InputError(fmt::format(
        "entry {}: layout {} divides the inverse by its last entry, which is {} here; allowed: "
        "above 0, as tables are that are not refined",
        entry_text(table.grid, entry), name_of(layout.layout), unit));
  for (std::size_t i = 0; i < 9; ++i)
    set(layout.stored[i], s[i] / unit);
  set(layout.amplitude, table.amplitude[entry]);
  set(layout.fresnel, table.fresnel[entry]);
  return channels;
}

void set_entry(Table& table, std::size_t entry, const Channels& channels,
               const IsotropicLayout& layout) {
  const auto value = [&](int channel) {
    return channel == zero  ? 0.0f
           : channel == one ? 1.0f
                            : channels[static_cast<std::size_t>(channel)];
  };
  for (std::size_t i = 0; i < 9; ++i)
    table.stored[9 * entry + i] = value(layout.stored[i]);
  table.amplitude[entry] = layout.amplitude == none ? NAN : value(layout.amplitude);
  table.fresnel[entry] = layout.fresnel == none ? NAN : value(layout.fresnel);
}

}  // namespace

const IsotropicLayout* isotropic_layout(TextureLayout layout) {
  const auto found = std::ranges::find(layouts, layout, &IsotropicLayout::layout);
  return found == std::end(layouts) ? nullptr : found;
}

Grid grid_of(const IsotropicAxes& axes, std::size_t alphas, std::size_t thetas) {
  Grid grid;
  grid.alpha = Axis::make(0, 1, alphas, axes.alpha);
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  grid.theta = Axis::make(0, axes.theta_last_radians, thetas, axes.theta);
  grid.phi = Axis::make(0, 0, 1, Warp::linear);
  grid.alpha_min = axes.alpha_min;
  return grid;
}

std::string why_not(const IsotropicLayout& layout, const Grid& grid, Storage storage) {
  if (layout.read_only)
    return fmt::format("takes layout {} for reading only", name_of(layout.layout));
  Grid expected = grid_of(layout.axes, std::max<std::size_t>(grid.alpha.size(), 2),
                          std::max<std::size_t>(grid.theta.size(), 2));
  if (grid.model != expected.model) {  // which engines' tables know nothing of
    expected.model = grid.model;
    expected.alpha_min = grid.alpha_min;
  }
  if (storage == layout.storage && grid == expected)
    return "";
  return fmt::format("holds isotropic tables of storage {} only, on the axes of config/{}.toml",
                     name_of(layout.storage), layout.config);
}

std::string fault_of(const std::vector<Image>& images, const IsotropicLayout& layout) {
  const auto has = [](const Image& image, std::size_t channels) {
    return image.channels == channels && image.layers == 1 && image.shape == ImageShape::flat;
  };
  const bool first = has(images.front(), layout.first_channels);
  const bool second = images.size() == 1
                          ? layout.second_may_miss || layout.second_channels == 0
                          : images.size() == 2 && has(images[1], layout.second_channels);
  return first && second ? "" : std::string(layout.images);
}

std::vector<Image> isotropic_images(const Table& table, const IsotropicLayout& layout) {
  const std::vector<std::size_t> source = nearest_fitted(table);
  const std::size_t channels[] = {layout.first_channels, layout.second_channels};
  std::vector<Image> images(layout.image_count());
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i].name = layout.names[i];
    images[i].width = table.grid.alpha.size();
    images[i].height = table.grid.theta.size();
    images[i].channels = channels[i];
  }
  for (std::size_t row = 0; row < images[0].height; ++row)
    for (std::size_t column = 0; column < images[0].width; ++column) {
      Channels values = channels_of(table, source[table.grid.flat({column, 0, row, 0})], layout);
      if (layout.sphere != none)
        values[static_cast<std::size_t>(layout.sphere)] = sphere_factor(column, row, images[0]);
      auto next = values.begin();
      for (Image& image : images)
        for (std::size_t i = 0; i < image.channels; ++i)
          image.values.push_back(*next++);
    }
  return images;
}

Table isotropic_table(const std::vector<Image>& images, const IsotropicLayout& layout,
                      const std::filesystem::path& file) {
  const Image& first = images.front();
  for (const std::size_t side : {first.width, first.height})
    if (side < 2 || side > max_nodes_per_axis)
      throw InputError(fmt::format("{}: {} x {} texels; expected 2 to {} each", file.string(),
                                   first.width, first.height, max_nodes_per_axis));
  Table table = Table::empty(grid_of(layout.axes, first.width, first.height), layout.storage);
  table.of_any_scale = layout.unit_entry != middle;
  table.without_albedo = layout.amplitude == none || layout.fresnel == none ||
                         (layout.second_channels && images.size() == 1);
  for (std::size_t row = 0; row < first.height; ++row)
    for (std::size_t column = 0; column < first.width; ++column) {
      const std::size_t texel = row * first.width + column;
      Channels channels;
      for (const Image& image : images)
        channels.insert(channels.end(), &image.values[texel * image.channels],
                        &image.values[texel * image.channels] + image.channels);
      channels.resize(layout.first_channels + layout.second_channels, NAN);
      set_entry(table, table.grid.flat({column, 0, row, 0}), channels, layout);
    }
  return table;
}

}  // namespace ltc
