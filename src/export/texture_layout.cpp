// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/texture_layout.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "export/consistency.h"
#include "export/entry_channels.h"
#include "export/isotropic_layout.h"
#include "export/nearest.h"

namespace ltc {
namespace {

// Right readings of published tables are at 0.05 to 0.12, wrong ones at 0.5 and more.
constexpr double farthest_mean = 0.3;

// Mean distance of the lobes from what they should about be, at nodes of middling roughness that
// are not grazing: of their own directions, those of the cosine's normal, from the mirror's, and of
// the logarithms of their widths, the square root of what det M is of a unit third column, from
// those of first order. Some tenths where the table is read aright.
double mean_distance(const Table& table) {
  if (!table.grid.model->about_mirror())
    return farthest_mean;  // nothing to judge by: the first layout that is listed
  double sum = 0;
  int count = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const Lobe lobe = table.grid.lobe(flat);
    if (lobe.alpha_x < 0.01 || lobe.alpha_x > 0.5 || lobe.theta_radians > 1.2)
      continue;
    Eigen::Matrix3d matrix = table.matrix_at(flat);
    matrix /= matrix.col(2).norm();
    const double angle = std::acos(std::clamp(matrix.col(2).dot(lobe.mirror()), -1.0, 1.0));
    const double expected =
        lobe.alpha_x * lobe.alpha_y * lobe.model->first_order(lobe).determinant();
    const double width = std::log(std::abs(matrix.determinant() / expected)) / 2;
    const double distance = std::hypot(angle, width);
    sum += std::isfinite(distance) ? distance : std::numbers::pi;
    ++count;
  }
  return count ? sum / count : 0;  // nothing to judge by
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

// Which of them a layout is about: of others' programs, which have several tables in one file, the
// matrices and their amplitudes or, last, their inverses.
std::vector<Image> images_for(const std::vector<Image>& images, TextureLayout layout) {
  const IsotropicLayout* const isotropic = isotropic_layout(layout);
  if (!isotropic || isotropic->first_channels != most_channels)
    return images;
  std::vector<Image> chosen;
  for (const Image& image : images)
    if (image.channels == most_channels) {
      if (chosen.empty() || isotropic->storage == Storage::inverse)
        chosen = {image};
    } else if (chosen.size() == 1 && image.channels == isotropic->second_channels) {
      chosen.push_back(image);
    }
  return chosen.empty() ? images : chosen;
}

// Of the same size, and finite.
void require_alike(const Image& image, const Image& first, const std::filesystem::path& file) {
  if (image.width != first.width || image.height != first.height || image.layers != first.layers)
    throw InputError(fmt::format(
        "{}: images of {} x {} x {} and {} x {} x {} texels; expected one size", file.string(),
        first.width, first.height, first.layers, image.width, image.height, image.layers));
  const auto bad = std::ranges::find_if_not(image.values, [](float v) { return std::isfinite(v); });
  if (bad != image.values.end()) {
    const auto at = static_cast<std::size_t>(bad - image.values.begin()) / image.channels;
    throw InputError(fmt::format("{}: a value of texel ({}, {}) is {}; expected finite numbers",
                                 file.string(), at % image.width, at / image.width, *bad));
  }
}

// Why images are not those of a layout, after "expected"; empty where they may be.
std::string fault(const std::vector<Image>& images, TextureLayout layout) {
  const Image& first = images.front();
  if (const IsotropicLayout* const isotropic = isotropic_layout(layout))
    return fault_of(images, *isotropic);
  const auto are = [&](std::size_t count, ImageShape shape, std::size_t layers) {
    return images.size() == count && first.channels == channels && first.shape == shape &&
           first.layers % layers == 0;
  };
  // Text does not tell slices from layers.
  if (layout == TextureLayout::volumes)
    return are(volumes, ImageShape::volume, 1) || are(volumes, ImageShape::array, 1)
               ? ""
               : "three 3-D images of four channels";
  if (layout == TextureLayout::stacked)
    return are(1, ImageShape::volume, volumes)
               ? ""
               : "one 3-D image of four channels, three times as deep";
  return are(1, ImageShape::array, volumes)
             ? ""
             : "one array of four channels, three times as many layers";
}

Table read_as(const std::vector<Image>& images, TextureLayout layout,
              const std::filesystem::path& file) {
  const IsotropicLayout* const isotropic = isotropic_layout(layout);
  Table table = isotropic ? isotropic_table(images, *isotropic, file) : volume_table(images, file);
  table.status.assign(table.grid.size(), Status::fitted);
  for (const Image& image : images)
    if (image.precision == Precision::half)
      table.precision = Precision::half;
  require_consistent(table, file);
  return table;
}

}  // namespace

std::size_t image_count(TextureLayout layout) {
  if (const IsotropicLayout* const isotropic = isotropic_layout(layout))
    return isotropic->image_count();
  return layout == TextureLayout::volumes ? volumes : 1;
}

std::string why_not(TextureLayout layout, const Grid& grid, Storage storage) {
  if (const IsotropicLayout* const isotropic = isotropic_layout(layout))
    return why_not(*isotropic, grid, storage);
  const Grid expected = Grid::paper(grid.shape());
  if (storage == Storage::matrix && grid.alpha.size() == grid.lambda.size() && grid == expected)
    return "";
  return "holds the paper's grid only, storage matrix, with as many nodes of alpha as of lambda";
}

TextureLayout resolved(TextureLayout layout, const Grid& grid, Storage storage) {
  if (layout != TextureLayout::automatic)
    return layout;
  for (const TextureLayout candidate :
       {TextureLayout::ltc, TextureLayout::unity, TextureLayout::godot})
    if (why_not(candidate, grid, storage).empty())
      return candidate;
  return storage == Storage::inverse ? TextureLayout::ltc : TextureLayout::volumes;
}

std::vector<Image> images_of(const Table& table, TextureLayout layout) {
  const IsotropicLayout* const isotropic = isotropic_layout(layout);
  return isotropic ? isotropic_images(table, *isotropic) : volume_images(table, layout);
}

Table table_of(const std::vector<Image>& images, TextureLayout layout,
               const std::filesystem::path& file, const LobeModel* model) {
  if (images.empty())
    throw InputError(fmt::format("{}: no images; expected those of a table", file.string()));
  for (const Image& image : images)
    require_alike(image, images.front(), file);
  std::string expected, judged;
  std::optional<Table> best;
  double least = 0;
  for (const auto& [candidate, name] : enum_names(TextureLayout{}).pairs) {
    if (candidate == TextureLayout::automatic ||
        (layout != TextureLayout::automatic && candidate != layout))
      continue;
    const std::vector<Image> theirs = images_for(images, candidate);
    if (const std::string what = fault(theirs, candidate); !what.empty()) {
      expected += fmt::format("{}{} ({})", expected.empty() ? "" : ", or ", what, name);
      continue;
    }
    Table table = read_as(theirs, candidate, file);
    if (model) {
      table.grid.model = model;
      table.grid.alpha_min = std::max(table.grid.alpha_min, model->least_alpha());
    }
    const double distance = mean_distance(table);
    judged += fmt::format("{}{} {:.3g}", judged.empty() ? "" : ", ", name, distance);
    if (best && distance > 0.99 * least)  // the same table twice: the first that is listed
      continue;
    least = distance;
    best = std::move(table);
    best->read_as = std::string(name);
  }
  if (!best)
    throw InputError(fmt::format("{}: images of no table; expected {}", file.string(), expected));
  // A table of other axes or of another frame than any that is known.
  if (layout == TextureLayout::automatic && least > farthest_mean && is_isotropic(best->grid))
    throw InputError(
        fmt::format("{}: images of no layout that is known, by how far its lobes are, in the mean, "
                    "from the mirror's direction and from their due width: {}; expected up to {} "
                    "of one",
                    file.string(), judged, farthest_mean));
  best->read_as = fmt::format(
      "read with layout {}, by the shape of its images and by how far its lobes are, in the mean, "
      "from the mirror's direction and from their due width: {}",
      best->read_as, judged);
  return *std::move(best);
}

}  // namespace ltc
