// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/lobe_density.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "brdf/albedo.h"
#include "brdf/lobe_model.h"
#include "fit/lobe_frame.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

using picture::Field;

constexpr double pi = std::numbers::pi;
constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

// A lobe of which windows wider than this are not worth zooming in: 26 degrees.
constexpr double widest_zoom = 0.45;

// Samples that place a window, and those that find what is thinner than a pixel.
constexpr std::size_t window_samples = 8192;
constexpr std::size_t lobe_samples = std::size_t{1} << 20;
// Evaluations of a pixel, along each side.
constexpr int pixel_points = 2;

// Where points of a pixel differ from their mean by less than this share, averaged over the lobe,
// the mean of the four is good to a per cent or so.
constexpr double smooth_share = 0.15;

// The lobe's mass outside of a window is at most this on each of four sides: 10 % in all.
constexpr double cut_share = 0.02;
constexpr double window_margin = 1.15;

struct WeightedPoint {
  Eigen::Vector2d at;
  double weight;
};

// The interval that leaves `cut_share` of the weight out at either end.
std::pair<double, double> bulk(std::vector<WeightedPoint>& points, int coordinate) {
  std::sort(points.begin(), points.end(), [&](const WeightedPoint& a, const WeightedPoint& b) {
    return a.at[coordinate] < b.at[coordinate];
  });
  double total = 0, below = 0;
  for (const WeightedPoint& point : points)
    total += point.weight;
  double low = points.front().at[coordinate], high = low;
  for (const WeightedPoint& point : points) {
    if (below <= cut_share * total)
      low = point.at[coordinate];
    high = point.at[coordinate];
    below += point.weight;
    if (below >= (1 - cut_share) * total)
      break;
  }
  return {low, high};
}

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;

  void include_bulk(std::vector<WeightedPoint> points) {
    for (int coordinate = 0; coordinate < 2; ++coordinate) {
      const auto [first, last] = bulk(points, coordinate);
      low[coordinate] = std::min(low[coordinate], first);
      high[coordinate] = std::max(high[coordinate], last);
    }
  }
};

// A direction by its offset from the mirror direction, which keeps its digits in narrow lobes.
struct Direction {
  Eigen::Vector3d omega, offset;
};

// One lobe as a picture needs it.
struct PicturedLobe {
  std::function<double(const Direction&)> density;
  // Sample i of `count`, and the density that such samples have at a direction.
  std::function<Direction(std::size_t i, std::size_t count)> sample;
  std::function<double(const Direction&)> sample_density;
};

// The direction of a point of the projection's plane, within two of its origin.
Direction direction_at(const LobeWindow& window, const Eigen::Vector3d& mirror, double x,
                       double y) {
  // With r = 2 sin(a/2): sin a = r cos(a/2) and 1 - cos a = r^2/2.
  const double r_squared = x * x + y * y;
  const double half_cosine = std::sqrt(std::max(0.0, 1 - r_squared / 4));
  const Eigen::Vector3d from_axis =
      window.rotation * Eigen::Vector3d(x * half_cosine, y * half_cosine, -r_squared / 2);
  const Eigen::Vector3d axis = window.rotation.col(2);
  return {axis + from_axis, window.hemisphere ? (axis - mirror + from_axis).eval() : from_axis};
}

// The pixels of a window, as squares of its projection's plane.
struct Raster {
  const LobeWindow& window;
  std::size_t side;
  double step = 2 * window.half_width / static_cast<double>(side);

  double x(double column) const { return window.center_x - window.half_width + step * column; }
  double y(double row) const { return window.center_y + window.half_width - step * row; }
  std::size_t index(const Eigen::Vector2d& at) const {
    const auto whole = [&](double steps) {
      return std::min(static_cast<std::size_t>(std::max(0.0, steps)), side - 1);
    };
    return whole((window.center_y + window.half_width - at.y()) / step) * side +
           whole((at.x() - window.center_x + window.half_width) / step);
  }
  // Whether the projection reaches this point: the horizon, or what is directly behind.
  bool shows(double at_x, double at_y) const {
    return at_x * at_x + at_y * at_y < (window.hemisphere ? 2 : 4);
  }
};

// Calls use(pixel, direction) for each of the points at which a pixel is evaluated.
template <typename Use>
void for_each_pixel_point(const Raster& raster, const Eigen::Vector3d& mirror, const Use& use) {
  for (std::size_t row = 0; row < raster.side; ++row)
    for (std::size_t column = 0; column < raster.side; ++column)
      for (int point = 0; point < pixel_points * pixel_points; ++point) {
        const double x =
            raster.x(static_cast<double>(column) + (point % pixel_points + 0.5) / pixel_points);
        const double y =
            raster.y(static_cast<double>(row) + (point / pixel_points + 0.5) / pixel_points);
        if (raster.shows(x, y))
          use(row * raster.side + column, direction_at(raster.window, mirror, x, y));
      }
}

// Pixel means by the points of the pixels alone; none where those of a pixel differ too much to
// stand for it.
std::optional<std::vector<double>> evaluated_means(const PicturedLobe& lobe, const Raster& raster,
                                                   const Eigen::Vector3d& mirror) {
  constexpr int points = pixel_points * pixel_points;
  std::vector<double> values, means(raster.side * raster.side, 0.0);
  std::vector<std::size_t> pixels;
  for_each_pixel_point(raster, mirror, [&](std::size_t pixel, const Direction& direction) {
    values.push_back(lobe.density(direction));
    pixels.push_back(pixel);
    means[pixel] += values.back() / points;
  });
  double deviation = 0, sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    deviation += std::abs(values[i] - means[pixels[i]]);
    sum += values[i];
  }
  if (deviation > smooth_share * sum || sum == 0)
    return std::nullopt;
  return means;
}

// The same for lobes with ridges thinner than a pixel. Neither points of the pixels nor samples of
// the lobe alone would do: the first miss ridges, the second leave the tails empty. Both together,
// each point weighted by the density of finding it in either way (Veach and Guibas 1995, the
// balance heuristic), have about the error of the better one everywhere.
std::vector<double> sampled_means(const PicturedLobe& lobe, const Raster& raster,
                                  const Eigen::Vector3d& mirror) {
  std::vector<double> means(raster.side * raster.side, 0.0);
  const double solid_angle = raster.step * raster.step;
  const double points_per_steradian = pixel_points * pixel_points / solid_angle;
  const auto add = [&](std::size_t pixel, const Direction& direction) {
    const double found =
        points_per_steradian + static_cast<double>(lobe_samples) * lobe.sample_density(direction);
    means[pixel] += lobe.density(direction) / (found * solid_angle);
  };
  for_each_pixel_point(raster, mirror, add);
  for (std::size_t i = 0; i < lobe_samples; ++i) {
    const Direction direction = lobe.sample(i, lobe_samples);
    if (raster.window.contains(direction.omega))
      add(raster.index(raster.window.project(direction.omega)), direction);
  }
  return means;
}

Field mean_density(const PicturedLobe& lobe, const LobeWindow& window,
                   const Eigen::Vector3d& mirror, std::size_t side) {
  const Raster raster{window, side};
  std::optional<std::vector<double>> means = evaluated_means(lobe, raster, mirror);
  if (!means)
    means = sampled_means(lobe, raster, mirror);
  Field field{side, side, {}};
  for (std::size_t pixel = 0; pixel < means->size(); ++pixel) {
    const bool shown = raster.shows(raster.x(static_cast<double>(pixel % side) + 0.5),
                                    raster.y(static_cast<double>(pixel / side) + 0.5));
    field.values.push_back(shown ? static_cast<float>((*means)[pixel]) : no_value);
  }
  return field;
}

std::vector<WeightedPoint> lobe_points(const LobeSampler& sampler, const LobeWindow& window) {
  std::vector<WeightedPoint> points;
  for (std::size_t i = 0; i < window_samples; ++i) {
    const LobeSample sample = sampler.sample(lattice_point(i, window_samples));
    if (sample.weight > 0)
      points.push_back({window.project(sample.omega_l), sample.weight});
  }
  return points;
}

// `use` of the lobe, which has density() and sample().
template <typename Use>
auto with_lobe(const LtcLobe& shown, const Use& use) {
  if (shown.creases.empty())
    return use(LinearlyTransformed(shown.matrix));
  return use(FoldedCosine(shown.matrix, shown.fold, shown.creases));
}

template <typename Transformed>
Eigen::Vector3d sample_of(const Transformed& ltc, std::size_t i, std::size_t count) {
  return ltc.sample((static_cast<double>(i) + 0.5) / static_cast<double>(count), golden_turns(i));
}

std::vector<WeightedPoint> points_of(const LtcLobe& shown, const LobeWindow& window) {
  return with_lobe(shown, [&](const auto& ltc) {
    std::vector<WeightedPoint> points;
    for (std::size_t i = 0; i < window_samples; ++i)
      points.push_back({window.project(sample_of(ltc, i, window_samples)), 1});
    return points;
  });
}

}  // namespace

Eigen::Vector2d LobeWindow::project(const Eigen::Vector3d& omega) const {
  const Eigen::Vector3d local = rotation.transpose() * omega;
  // 2 sin(a/2)/sin a = sqrt(2/(1 + cos a)); directly behind the axis all azimuths are as good.
  return local.head<2>() * std::sqrt(2 / std::max(1 + local.z(), 1e-12));
}

bool LobeWindow::contains(const Eigen::Vector3d& omega) const {
  if (hemisphere)
    return omega.z() > 0;
  const Eigen::Vector2d at = project(omega);
  return std::abs(at.x() - center_x) < half_width && std::abs(at.y() - center_y) < half_width;
}

LobeWindow hemisphere_window() {
  return {Eigen::Matrix3d::Identity(), 0, 0, std::numbers::sqrt2, true};
}

LobeWindow choose_window(const Lobe& lobe, const Eigen::Matrix3d& matrix) {
  return choose_window(lobe, std::array{LtcLobe{matrix}});
}

LobeWindow choose_window(const Lobe& lobe, std::span<const LtcLobe> beside) {
  LobeWindow window{LobeFrame(lobe).rotation, 0, 0, 0, false};
  Bounds bounds;
  bounds.include_bulk(lobe_points(*lobe.model->sampler(lobe), window));
  for (const LtcLobe& shown : beside)
    if (is_invertible(shown.matrix))
      bounds.include_bulk(points_of(shown, window));
  const Eigen::Vector2d center = (bounds.low + bounds.high) / 2;
  window.center_x = center.x();
  window.center_y = center.y();
  window.half_width = window_margin * (bounds.high - bounds.low).maxCoeff() / 2;
  return window.half_width > widest_zoom ? hemisphere_window() : window;
}

Field lobe_density(const Lobe& lobe, const LobeWindow& window, std::size_t side) {
  const std::unique_ptr<LobeSampler> sampler = lobe.model->sampler(lobe);
  const double amplitude = integrate_albedo(lobe, AlbedoRule()).amplitude;
  return mean_density(
      {[&](const Direction& d) { return sampler->brdf_cosine_at_offset(d.offset) / amplitude; },
       [&](std::size_t i, std::size_t count) {
         const LobeSample sample = sampler->sample(lattice_point(i, count));
         return Direction{sample.omega_l, sample.offset};
       },
       [&](const Direction& d) { return sampler->densities_at_offset(d.offset).sampling; }},
      window, sampler->axis(), side);
}

Field ltc_density(const LtcLobe& shown, const Lobe& lobe, const LobeWindow& window,
                  std::size_t side) {
  if (!is_invertible(shown.matrix))
    return {side, side, std::vector<float>(side * side, no_value)};
  const Eigen::Vector3d axis = lobe.model->frame(lobe).col(2);
  return with_lobe(shown, [&](const auto& ltc) {
    const auto density = [&](const Direction& d) { return ltc.density(d.omega); };
    return mean_density({density,
                         [&](std::size_t i, std::size_t count) {
                           const Eigen::Vector3d omega = sample_of(ltc, i, count);
                           return Direction{omega, omega - axis};
                         },
                         density},
                        window, axis, side);
  });
}

}  // namespace ltc
