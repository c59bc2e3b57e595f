// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/light_texture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"

namespace ltc {
namespace {

constexpr std::size_t channels = 4;
constexpr double inner = 1 - 2 * light_texture_margin;
constexpr double cells_a_deviation = 8;
constexpr double deviations_reached = 5;  // 6e-7 of a Gaussian is beyond

// The image in cells of 2^j pixels a side, the last ones smaller where it ends.
struct CoarseImage {
  std::size_t pixels_a_cell = 1;
  LightImage cells;
};

CoarseImage halved(const CoarseImage& fine, std::size_t width, std::size_t height) {
  const LightImage& from = fine.cells;
  const std::size_t cell = fine.pixels_a_cell;
  CoarseImage coarse{2 * cell, {(from.width + 1) / 2, (from.height + 1) / 2, {}}};
  coarse.cells.rgba.resize(channels * coarse.cells.width * coarse.cells.height);
  // Of a cell of the fine image: its share of the pixels.
  const auto pixels = [&](std::size_t index, std::size_t count) {
    return static_cast<double>(std::min((index + 1) * cell, count) - index * cell);
  };
  for (std::size_t row = 0; row < coarse.cells.height; ++row)
    for (std::size_t column = 0; column < coarse.cells.width; ++column) {
      std::array<double, channels> sum{};
      double total = 0;
      for (std::size_t y = 2 * row; y < std::min(2 * row + 2, from.height); ++y)
        for (std::size_t x = 2 * column; x < std::min(2 * column + 2, from.width); ++x) {
          const double weight = pixels(x, width) * pixels(y, height);
          total += weight;
          for (std::size_t channel = 0; channel < channels; ++channel)
            sum[channel] += weight * from.texel(y, x)[channel];
        }
      for (std::size_t channel = 0; channel < channels; ++channel)
        coarse.cells.rgba[channels * (row * coarse.cells.width + column) + channel] =
            static_cast<float>(sum[channel] / total);
    }
  return coarse;
}

// The Gaussian's mass in each of the cells that it reaches along one side.
struct Weights {
  std::size_t first = 0;
  std::vector<double> mass;
  double total = 0;

  void set(double at, double deviation, std::size_t pixels, std::size_t pixels_a_cell) {
    const double count = static_cast<double>(pixels), cell = static_cast<double>(pixels_a_cell);
    const std::size_t cells = (pixels + pixels_a_cell - 1) / pixels_a_cell;
    const double reach = deviations_reached * deviation;
    const auto cell_of = [&](double position) {
      const double index = std::floor(position * count / cell);
      return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(cells - 1)));
    };
    first = cell_of(at - reach);
    const std::size_t last = cell_of(at + reach);
    const auto below = [&](std::size_t edge) {
      const double position = std::min(static_cast<double>(edge) * cell, count) / count;
      return std::erf((position - at) / (std::numbers::sqrt2 * deviation)) / 2;
    };
    mass.clear();
    total = 0;
    double left = below(first);
    for (std::size_t i = first; i <= last; ++i) {
      const double right = below(i + 1);
      mass.push_back(right - left);
      total += right - left;
      left = right;
    }
  }
};

// Means of one image under Gaussians of any size.
class Filter {
 public:
  explicit Filter(const LightImage& image) : width_(image.width), height_(image.height) {
    coarse_.push_back({1, image});
    while (std::max(coarse_.back().cells.width, coarse_.back().cells.height) > 1)
      coarse_.push_back(halved(coarse_.back(), width_, height_));
  }

  // Reuses the memory of `along_s` and `along_t`.
  std::array<double, channels> mean(double s, double t, double deviation, Weights& along_s,
                                    Weights& along_t) const {
    const CoarseImage& image = cells_for(deviation);
    along_s.set(s, without_cell(deviation, image, width_), width_, image.pixels_a_cell);
    along_t.set(t, without_cell(deviation, image, height_), height_, image.pixels_a_cell);
    std::array<double, channels> sum{};
    for (std::size_t row = 0; row < along_t.mass.size(); ++row) {
      std::array<double, channels> row_sum{};
      const float* texel = image.cells.texel(along_t.first + row, along_s.first);
      for (const double mass : along_s.mass)
        for (double& channel : row_sum)
          channel += mass * *texel++;
      for (std::size_t channel = 0; channel < channels; ++channel)
        sum[channel] += along_t.mass[row] * row_sum[channel];
    }
    for (double& channel : sum)
      channel /= along_s.total * along_t.total;
    return sum;
  }

 private:
  // The coarsest with eight cells a deviation along both sides.
  const CoarseImage& cells_for(double deviation) const {
    const double pixels = deviation * static_cast<double>(std::min(width_, height_));
    std::size_t level = 0;
    while (level + 1 < coarse_.size() &&
           static_cast<double>(coarse_[level + 1].pixels_a_cell) * cells_a_deviation <= pixels)
      ++level;
    return coarse_[level];
  }

  // The means over cells of several pixels have widened the image already.
  static double without_cell(double deviation, const CoarseImage& image, std::size_t pixels) {
    if (image.pixels_a_cell == 1)
      return deviation;
    const double cell = static_cast<double>(image.pixels_a_cell) / static_cast<double>(pixels);
    return std::sqrt(deviation * deviation - cell * cell / 12);
  }

  std::size_t width_, height_;
  std::vector<CoarseImage> coarse_;
};

double distance_outside(double coordinate) {
  return std::max({0.0, -coordinate, coordinate - 1});
}

// Fills the rows of a level.
class LevelRow {
 public:
  LevelRow(const Filter& filter, double deviation, Image& level)
      : filter_(filter), deviation_(deviation), level_(level) {}

  void fill(std::size_t row) {
    const double t = coordinate(row);
    for (std::size_t column = 0; column < level_.width; ++column) {
      const double s = coordinate(column);
      const double distance = std::hypot(distance_outside(s), distance_outside(t));
      const auto mean = filter_.mean(s, t, std::max(deviation_, distance / 2), along_s_, along_t_);
      float* const texel = &level_.values[channels * (row * level_.width + column)];
      std::transform(mean.begin(), mean.end(), texel,
                     [](double value) { return static_cast<float>(value); });
    }
  }

 private:
  double coordinate(std::size_t texel) const {
    const double place = (static_cast<double>(texel) + 0.5) / static_cast<double>(level_.width);
    return (place - light_texture_margin) / inner;
  }

  const Filter& filter_;
  double deviation_;
  Image& level_;
  Weights along_s_, along_t_;
};

Image blank_level(std::size_t side) {
  Image level;
  level.width = level.height = side;
  level.precision = Precision::half;
  level.values.resize(channels * side * side);
  return level;
}

// Rec. 709.
template <class Number>
double luminance(const Number* rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Between the texels' centres of one level.
std::array<double, channels> bilinear(const Image& level, double x, double y) {
  struct Between {
    std::size_t first, second;
    double weight;
  };
  const auto between = [](double coordinate, std::size_t count) -> Between {
    const double last = static_cast<double>(count - 1);
    const double at = std::clamp(coordinate * static_cast<double>(count) - 0.5, 0.0, last);
    const auto first = static_cast<std::size_t>(at);
    return {first, std::min(first + 1, count - 1), at - static_cast<double>(first)};
  };
  const Between column = between(x, level.width), row = between(y, level.height);
  std::array<double, channels> result;
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const auto value = [&](std::size_t r, std::size_t c) {
      return static_cast<double>(level.values[channels * (r * level.width + c) + channel]);
    };
    result[channel] = std::lerp(
        std::lerp(value(row.first, column.first), value(row.first, column.second), column.weight),
        std::lerp(value(row.second, column.first), value(row.second, column.second), column.weight),
        row.weight);
  }
  return result;
}

}  // namespace

std::size_t usual_light_texture_side(const LightImage& image) {
  constexpr std::size_t usual = 512;
  return std::max(usual, std::bit_ceil(std::max(image.width, image.height)));
}

std::vector<Image> prefilter(const LightImage& image, std::size_t side, std::string_view stage,
                             const RunContext& run) {
  if (!std::has_single_bit(side) || side < least_light_texture_side ||
      side > largest_light_texture_side)
    throw InputError(
        fmt::format("a texture of {} texels a side; expected a power of two in [{}, "
                    "{}]",
                    side, least_light_texture_side, largest_light_texture_side));
  if (image.width == 0 || image.height == 0 ||
      image.rgba.size() != channels * image.width * image.height)
    throw InputError(
        fmt::format("a light's image of {} x {} pixels with {} values; expected at "
                    "least one pixel, and four values each",
                    image.width, image.height, image.rgba.size()));
  const Filter filter(image);
  std::vector<Image> levels;
  for (std::size_t texels = side; texels > 0; texels /= 2)
    levels.push_back(blank_level(texels));
  const Stage counted(run, stage, 2 * side - 1);
  for (Image& level : levels) {
    // 2^k/N is one over the level's side.
    const double deviation = 1 / static_cast<double>(level.width);
    parallel_for<LevelRow>(
        level.height, run, [&] { return LevelRow(filter, deviation, level); },
        [&](std::size_t row, LevelRow& rows) {
          rows.fill(row);
          run.advance();
        });
  }
  return levels;
}

TextureFetch texture_fetch(const Eigen::Vector3d& center, const Eigen::Vector3d& half_u,
                           const Eigen::Vector3d& half_v) {
  const Eigen::Vector3d normal = half_u.cross(half_v);
  const double quarter = normal.norm();  // of the area
  if (!(quarter > 0))
    return {0.5, 0.5, 1};
  const double distance = center.dot(normal) / quarter;
  // From the centre to the projection, in units of the half sides.
  const Eigen::Vector3d to_foot = distance / quarter * normal - center;
  const double x = to_foot.cross(half_v).dot(normal) / (quarter * quarter),
               y = half_u.cross(to_foot).dot(normal) / (quarter * quarter);
  return {(1 + x) / 2, (1 - y) / 2, std::abs(distance) / std::sqrt(8 * quarter)};
}

std::array<double, 4> fetched(const std::vector<Image>& levels, const TextureFetch& fetch) {
  const double last = static_cast<double>(levels.size() - 1);
  const double side = static_cast<double>(levels.front().width);
  const double detail = std::clamp(std::log2(side * fetch.standard_deviation), 0.0, last);
  const auto first = static_cast<std::size_t>(detail);
  const double x = light_texture_margin + inner * fetch.s,
               y = light_texture_margin + inner * fetch.t;
  std::array<double, channels> result = bilinear(levels[first], x, y);
  if (first + 1 < levels.size()) {
    const auto coarser = bilinear(levels[first + 1], x, y);
    for (std::size_t channel = 0; channel < channels; ++channel)
      result[channel] =
          std::lerp(result[channel], coarser[channel], detail - static_cast<double>(first));
  }
  return result;
}

LightTexture::LightTexture(LightImage image, const RunContext& run)
    : image_(std::move(image)),
      levels_(prefilter(image_, usual_light_texture_side(image_), "prefilter the light", run)) {}

double LightTexture::emitted(const Eigen::Vector2d& place) const {
  const auto nearest = [](double coordinate, std::size_t count) {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::size_t>(
        std::clamp(std::floor(coordinate * static_cast<double>(count)), 0.0, last));
  };
  return luminance(image_.texel(nearest((1 - place.y()) / 2, image_.height),
                                nearest((1 + place.x()) / 2, image_.width)));
}

double LightTexture::fetched(const Eigen::Vector3d& center, const Eigen::Vector3d& half_u,
                             const Eigen::Vector3d& half_v) const {
  const auto color = ltc::fetched(levels_, texture_fetch(center, half_u, half_v));
  return luminance(color.data());
}

}  // namespace ltc
