// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_images.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace ltc {
namespace {

constexpr std::size_t points_a_side = 2;
constexpr std::size_t points_a_pixel = points_a_side * points_a_side;
constexpr std::size_t replicates = 2;  // independent estimates a point, which tell the noise
constexpr std::size_t techniques = 2;
constexpr std::size_t samples_quantum = points_a_pixel * replicates * techniques;

void check(const SphereMaterial& material, const SphereSettings& settings) {
  const auto require = [](const char* name, double value, double first, double last) {
    if (!(value >= first && value <= last))
      throw InputError(fmt::format("{} {} is not allowed; expected a number in [{}, {}]", name,
                                   value, first, last));
  };
  require("alpha_x", material.alpha_x, 1e-4, 1);
  require("alpha_y", material.alpha_y, 1e-4, 1);
  require("F0", material.f0, 0, 1);
  if (settings.size == 0 || settings.samples == 0)
    throw InputError("a picture without pixels or samples; expected at least 1 of each");
}

picture::Field blank(std::size_t size) {
  return {size, size, std::vector<float>(size * size, 0.0f)};
}

class PixelRow {
 public:
  PixelRow(std::span<const Table* const> tables, const SphereMaterial& material,
           const SphereSettings& settings, const ReferenceIntegrator& integrator,
           SphereImages& images)
      : tables_(tables),
        material_(material),
        settings_(settings),
        integrator_(integrator),
        images_(images),
        ltc_(tables.size()) {}

  void render(std::size_t row) {
    // A generator a row: the same numbers whichever thread renders it.
    Random random(row);
    for (std::size_t column = 0; column < settings_.size; ++column)
      render_pixel(row, column, random);
  }

 private:
  void render_pixel(std::size_t row, std::size_t column, Random& random) {
    covered_ = 0;
    reference_ = {};
    std::fill(ltc_.begin(), ltc_.end(), 0.0);
    for (std::size_t i = 0; i < points_a_pixel; ++i) {
      const double x = coordinate(column, i % points_a_side);
      const double y = -coordinate(row, i / points_a_side);
      if (const auto point = shading_point(settings_.scene, x, y))
        add(*point, random);
    }
    const std::size_t pixel = row * settings_.size + column;
    const auto store = [&](picture::Field& image, double sum) {
      image.values[pixel] = static_cast<float>(sum / points_a_pixel);
    };
    store(images_.coverage, covered_);
    store(images_.reference, (reference_[0] + reference_[1]) / 2);
    // Half the difference of two independent estimates has the variance of their mean.
    store(images_.standard_error, std::abs(reference_[0] - reference_[1]) / 2);
    for (std::size_t table = 0; table < ltc_.size(); ++table)
      store(images_.ltc[table], ltc_[table]);
  }

  double coordinate(std::size_t pixel, std::size_t point) const {
    const double position = static_cast<double>(pixel * points_a_side + point) + 0.5;
    return 2 * position / static_cast<double>(settings_.size * points_a_side) - 1;
  }

  void add(const ShadingPoint& point, Random& random) {
    const Lobe lobe =
        point.lobe(material_.alpha_x, material_.alpha_y, *tables_.front()->grid.model);
    const Light light = point.seen(settings_.scene.light);
    ++covered_;
    for (double& sum : reference_) {
      ReferenceIntegrator::Shifts shifts;
      for (double& shift : shifts)
        shift = random.uniform();
      sum += integrator_.radiance(lobe, material_.f0, light, shifts);
    }
    for (std::size_t table = 0; table < ltc_.size(); ++table)
      ltc_[table] += ltc_radiance(*tables_[table], lobe, material_.f0, light, settings_.horizon);
  }

  std::span<const Table* const> tables_;
  const SphereMaterial& material_;
  const SphereSettings& settings_;
  const ReferenceIntegrator& integrator_;
  SphereImages& images_;
  // Sums over the pixel's points.
  std::size_t covered_ = 0;
  std::array<double, replicates> reference_{};
  std::vector<double> ltc_;
};

}  // namespace

SphereImages render_sphere(std::span<const Table* const> tables, const SphereMaterial& material,
                           const SphereSettings& settings, std::string_view stage,
                           const RunContext& run) {
  check(material, settings);
  const picture::Field nothing = blank(settings.size);
  SphereImages images{nothing, nothing, nothing, {tables.size(), nothing}};
  const ReferenceIntegrator integrator((settings.samples + samples_quantum - 1) / samples_quantum);
  parallel_for_each<PixelRow>(
      stage, settings.size, run,
      [&] { return PixelRow(tables, material, settings, integrator, images); },
      [](std::size_t row, PixelRow& pixels) { pixels.render(row); });
  return images;
}

picture::Field difference(const SphereImages& images, std::size_t table) {
  picture::Field field = images.ltc[table];
  for (std::size_t i = 0; i < field.values.size(); ++i)
    field.values[i] -= images.reference.values[i];
  return field;
}

SphereError sphere_error(const SphereImages& images, std::size_t table) {
  const picture::Field differences = difference(images, table);
  SphereError error;
  double squares = 0, variance = 0;
  for (std::size_t i = 0; i < differences.values.size(); ++i) {
    if (images.coverage.values[i] == 0)
      continue;
    const double d = differences.values[i], noise = images.standard_error.values[i];
    if (std::isnan(d)) {
      ++error.without;
      continue;
    }
    ++error.pixels;
    error.reference_mean += images.reference.values[i];
    error.mean_absolute += std::abs(d);
    squares += d * d;
    variance += noise * noise;
  }
  const auto pixels = static_cast<double>(error.pixels);
  error.reference_mean /= pixels;
  error.mean_absolute /= pixels;
  error.relative_rmse = std::sqrt(squares / pixels) / error.reference_mean;
  error.standard_error = std::sqrt(variance / pixels);
  error.relative_noise = error.standard_error / error.reference_mean;
  return error;
}

}  // namespace ltc
