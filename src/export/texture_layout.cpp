// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/texture_layout.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "core/angle.h"
#include "core/error.h"
#include "export/consistency.h"
#include "export/entry_channels.h"
#include "export/nearest.h"
#include "ltc/sphere_clip.h"

namespace ltc {
namespace {

using Floats = std::array<float, 4>;

bool is_isotropic_layout(TextureLayout layout) {
  return layout == TextureLayout::ltc || layout == TextureLayout::ltc_2017_07 ||
         layout == TextureLayout::eight;
}

// ---- Isotropic: column alpha, row theta ----

// S of the two texels of a node, and back. The layouts name S = [x 0 z; 0 1 0; y 0 w].
struct Terms {
  Eigen::Matrix3d stored;
  float amplitude, fresnel;
};

Terms terms_of(TextureLayout layout, const Floats& first, const Floats& second) {
  Terms terms{Eigen::Matrix3d::Zero(), second[0], second[1]};
  Eigen::Matrix3d& s = terms.stored;
  if (layout == TextureLayout::ltc_2017_07) {
    s << first[0], 0, first[3], 0, first[2], 0, first[1], 0, second[0];
    terms.amplitude = second[1];
    terms.fresnel = second[2];
  } else {
    s << first[0], 0, first[2], 0, 1, 0, first[1], 0, first[3];
  }
  return terms;
}

// The clipped sphere's factor of a texel: column (cos + 1)/2, row the form factor.
float sphere_factor(std::size_t column, std::size_t row, const Image& image) {
  const auto share = [](std::size_t i, std::size_t n) {
    return n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0.0;
  };
  return static_cast<float>(
      clipped_sphere_factor(2 * share(column, image.width) - 1, share(row, image.height)));
}

std::vector<Image> isotropic_images(const Table& table, TextureLayout layout) {
  const std::vector<std::size_t> source = nearest_fitted(table);
  const std::size_t alphas = table.grid.alpha.size(), thetas = table.grid.theta.size();
  Image first;
  first.name = "LTC_MAT_1";
  first.width = alphas;
  first.height = thetas;
  Image second = first;
  second.name = "LTC_MAT_2";
  for (std::size_t theta = 0; theta < thetas; ++theta)
    for (std::size_t alpha = 0; alpha < alphas; ++alpha) {
      const std::size_t entry = source[table.grid.flat({alpha, 0, theta, 0})];
      const float* const s = &table.stored[9 * entry];
      first.values.insert(first.values.end(), {s[0], s[6], s[2], s[8]});
      second.values.insert(second.values.end(), {table.amplitude[entry], table.fresnel[entry], 0.0f,
                                                 sphere_factor(alpha, theta, second)});
    }
  if (layout == TextureLayout::ltc)
    return {first, second};
  Image both;
  both.name = "LTC";
  both.width = alphas;
  both.height = thetas;
  both.channels = 8;
  for (std::size_t texel = 0; texel < first.texels(); ++texel)
    for (const Image* image : {&first, &second})
      both.values.insert(both.values.end(), &image->values[4 * texel],
                         &image->values[4 * texel] + 4);
  return {both};
}

Table isotropic_table(const std::vector<Image>& images, TextureLayout layout) {
  const Image& first = images.front();
  Table table = Table::empty(isotropic_grid(first.width, first.height), Storage::inverse);
  const auto texel = [](const Image& image, std::size_t index, std::size_t offset) {
    Floats values{NAN, NAN, NAN, NAN};
    for (std::size_t i = 0; i < std::min<std::size_t>(4, image.channels - offset); ++i)
      values[i] = image.values[index * image.channels + offset + i];
    return values;
  };
  for (std::size_t row = 0; row < first.height; ++row)
    for (std::size_t column = 0; column < first.width; ++column) {
      const std::size_t index = row * first.width + column;
      const std::size_t entry = table.grid.flat({column, 0, row, 0});
      Floats more{NAN, NAN, NAN, NAN};
      if (layout == TextureLayout::eight)
        more = texel(first, index, 4);
      else if (images.size() > 1)
        more = texel(images[1], index, 0);
      const Terms terms = terms_of(layout, texel(first, index, 0), more);
      table.set_stored(entry, terms.stored);
      table.amplitude[entry] = terms.amplitude;
      table.fresnel[entry] = terms.fresnel;
    }
  return table;
}

// Mean distance of the lobes' own directions, those of the cosine's normal, from the mirror's, of
// nodes of middling roughness: some degrees where the table is read aright.
double mean_distance_to_mirror(const Table& table) {
  double sum = 0;
  int count = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const Lobe lobe = table.grid.lobe(flat);
    if (lobe.alpha_x < 0.01 || lobe.alpha_x > 0.5)
      continue;
    const Eigen::Vector3d axis = table.matrix_at(flat).col(2).normalized();
    const double distance = std::acos(std::clamp(axis.dot(lobe.mirror()), -1.0, 1.0));
    sum += std::isfinite(distance) ? distance : std::numbers::pi;
    ++count;
  }
  return count ? sum / count : std::numbers::pi;
}

// ---- Anisotropic: the texels of the OpenEXR textures ----

constexpr std::size_t volumes = texels_per_entry, channels = channels_per_texel;

std::vector<Image> volume_images(const Table& table, TextureLayout layout) {
  const std::vector<std::size_t> source = nearest_fitted(table);
  const auto [alphas, lambdas, thetas, phis] = table.grid.shape();
  Image image;
  image.shape = ImageShape::volume;
  image.width = phis;
  image.height = thetas;
  image.layers = lambdas * alphas;
  // Slice lambda + N_lambda alpha, row theta, column phi: C order of the entries.
  std::vector<Image> images;
  for (std::size_t volume = 0; volume < volumes; ++volume) {
    Image& part = images.emplace_back(image);
    part.name = fmt::format("ltc{}", volume);
    for (const std::size_t entry : source)
      for (std::size_t channel = channels * volume; channel < channels * (volume + 1); ++channel)
        part.values.push_back(channel_value(table, entry, channel));
  }
  if (layout == TextureLayout::volumes)
    return images;
  image.name = "ltc";
  image.shape = layout == TextureLayout::array ? ImageShape::array : ImageShape::volume;
  image.layers *= volumes;
  for (const Image& part : images)
    image.values.insert(image.values.end(), part.values.begin(), part.values.end());
  return {image};
}

Table volume_table(const std::vector<Image>& images, const std::filesystem::path& file) {
  const Image& first = images.front();
  const std::size_t slices = images.size() == volumes ? first.layers : first.layers / volumes;
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(slices))));
  if (side * side != slices || slices == 0 || first.layers % slices != 0)
    throw InputError(
        fmt::format("{}: {} slices; expected {}the square of the number of nodes of "
                    "alpha, which are as many as of lambda",
                    file.string(), first.layers, images.size() == volumes ? "" : "three times "));
  const Grid grid = Grid::paper({side, side, first.height, first.width});
  require_consistent(grid, file);
  Table table = Table::empty(grid, Storage::matrix);
  for (std::size_t entry = 0; entry < grid.size(); ++entry)
    for (std::size_t channel = 0; channel <= fresnel_channel; ++channel) {
      const std::size_t volume = channel / channels, at = entry * channels + channel % channels;
      set_channel_value(table, entry, channel,
                        images.size() == volumes
                            ? images[volume].values[at]
                            : first.values[volume * grid.size() * channels + at]);
    }
  return table;
}

// ---- Either ----

// Why images are not those of a layout, after "expected"; empty where they may be.
std::string fault(const std::vector<Image>& images, TextureLayout layout) {
  const Image& first = images.front();
  for (const Image& image : images)
    if (image.width != first.width || image.height != first.height || image.layers != first.layers)
      return "images of one size";
  const bool flat = first.layers == 1 && first.shape == ImageShape::flat;
  const auto has = [&](std::size_t least, std::size_t most, std::size_t count, bool shape) {
    return images.size() >= least && images.size() <= most && first.channels == count && shape;
  };
  switch (layout) {
    case TextureLayout::automatic:
      break;
    case TextureLayout::ltc:
      return has(1, 2, 4, flat) ? "" : "one or two flat images of four channels";
    case TextureLayout::ltc_2017_07:
      return has(2, 2, 4, flat) && images[1].channels == 4 ? ""
                                                           : "two flat images of four channels";
    case TextureLayout::eight:
      return has(1, 1, 8, flat) ? "" : "one flat image of eight channels";
    case TextureLayout::volumes:
      return has(volumes, volumes, channels, first.shape == ImageShape::volume)
                 ? ""
                 : "three 3-D images of four channels";
    case TextureLayout::stacked:
      return has(1, 1, channels, first.shape == ImageShape::volume && first.layers % volumes == 0)
                 ? ""
                 : "one 3-D image of four channels, three times as deep";
    case TextureLayout::array:
      return has(1, 1, channels, first.shape == ImageShape::array && first.layers % volumes == 0)
                 ? ""
                 : "one array of four channels, three times as many layers";
  }
  return "";
}

Table read_as(const std::vector<Image>& images, TextureLayout layout,
              const std::filesystem::path& file) {
  const Image& first = images.front();
  if (is_isotropic_layout(layout) &&
      (first.width > max_nodes_per_axis || first.height > max_nodes_per_axis || first.width < 2 ||
       first.height < 2))
    throw InputError(fmt::format("{}: {} x {} texels; expected 2 to {} each", file.string(),
                                 first.width, first.height, max_nodes_per_axis));
  Table table =
      is_isotropic_layout(layout) ? isotropic_table(images, layout) : volume_table(images, file);
  table.status.assign(table.grid.size(), Status::fitted);
  for (const Image& image : images)
    if (image.precision == Precision::half)
      table.precision = Precision::half;
  require_consistent(table, file);
  return table;
}

}  // namespace

Grid isotropic_grid(std::size_t alphas, std::size_t thetas) {
  Grid grid;
  grid.alpha = Axis::make(0, 1, alphas, Warp::sqrt);
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  grid.theta = Axis::make(0, std::numbers::pi / 2, thetas, Warp::half_sine);
  grid.phi = Axis::make(0, 0, 1, Warp::linear);
  return grid;
}

TextureLayout resolved(TextureLayout layout, Storage storage) {
  if (layout != TextureLayout::automatic)
    return layout;
  return storage == Storage::inverse ? TextureLayout::ltc : TextureLayout::volumes;
}

std::size_t image_count(TextureLayout layout) {
  return layout == TextureLayout::volumes                                       ? volumes
         : layout == TextureLayout::ltc || layout == TextureLayout::ltc_2017_07 ? 2
                                                                                : 1;
}

std::string why_not(TextureLayout layout, const Grid& grid, Storage storage) {
  if (layout == TextureLayout::ltc_2017_07)
    return "is read only";
  const auto same_axes = [&](const Grid& expected) {
    for (std::size_t i = 0; i < Grid::axis_count; ++i)
      if (grid.axis(i).nodes != expected.axis(i).nodes ||
          (grid.axis(i).size() > 1 && grid.axis(i).warp != expected.axis(i).warp))
        return false;
    return grid.layout == Layout::alpha_lambda;
  };
  if (is_isotropic_layout(layout)) {
    if (storage == Storage::inverse && grid.alpha.size() > 1 && grid.theta.size() > 1 &&
        same_axes(isotropic_grid(grid.alpha.size(), grid.theta.size())))
      return "";
    return "holds isotropic tables of storage inverse only, on the axes of config/isotropic.toml";
  }
  if (storage == Storage::matrix && grid.alpha.size() == grid.lambda.size() &&
      same_axes(Grid::paper(grid.shape())))
    return "";
  return "holds the paper's grid only, storage matrix, with as many nodes of alpha as of lambda";
}

std::vector<Image> images_of(const Table& table, TextureLayout layout) {
  return is_isotropic_layout(layout) ? isotropic_images(table, layout)
                                     : volume_images(table, layout);
}

Table table_of(const std::vector<Image>& images, TextureLayout layout,
               const std::filesystem::path& file) {
  if (images.empty())
    throw InputError(fmt::format("{}: no images; expected those of a table", file.string()));
  std::string expected, judged;
  std::optional<Table> best;
  double least = 0;
  for (const auto& [candidate, name] : enum_names(TextureLayout{}).pairs) {
    if (candidate == TextureLayout::automatic ||
        (layout != TextureLayout::automatic && candidate != layout))
      continue;
    if (const std::string what = fault(images, candidate); !what.empty()) {
      expected += fmt::format("{}{} ({})", expected.empty() ? "" : ", or ", what, name);
      continue;
    }
    Table table = read_as(images, candidate, file);
    const double distance = mean_distance_to_mirror(table);
    judged +=
        fmt::format("{}{} {:.3g}", judged.empty() ? "" : ", ", name, distance / radians_per_degree);
    if (best && least <= distance)
      continue;
    least = distance;
    best = std::move(table);
    best->read_as = std::string(name);
  }
  if (!best)
    throw InputError(fmt::format("{}: images of no table; expected {}", file.string(), expected));
  best->read_as = fmt::format(
      "read with layout {}, by the shape of its images and by where the lobes lie, in degrees from "
      "the mirror's in the mean: {}",
      best->read_as, judged);
  return *std::move(best);
}

}  // namespace ltc
