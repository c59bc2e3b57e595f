// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/area_light.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/random.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"

namespace ltc {
namespace {

constexpr double largest_size_factor = 2;  // and the smallest is its inverse

AreaLightSettings checked(const AreaLightSettings& settings) {
  if (settings.quads < 1)
    throw InputError("area-light error over 0 quads; expected at least 1");
  if (settings.samples < 64)
    throw InputError(
        fmt::format("area-light error by {} samples; expected at least 64", settings.samples));
  return settings;
}

SampleLattice random_lattice(const AreaLightSettings& settings, std::uint64_t index) {
  Random random(settings.seed + index);
  const double azimuth_shift = random.uniform();
  return SampleLattice(checked(settings).samples / 2, azimuth_shift, random.uniform());
}

// Weighted mean of the light directions, relative to the axis.
Eigen::Vector3d mean_offset(const WeightedSamples& samples) {
  return (samples.offset.colwise() * samples.weight).colwise().sum().matrix().transpose() /
         samples.weight.sum();
}

// Weighted mean distance of the light directions from their mean.
double mean_distance(const WeightedSamples& samples, const Eigen::Vector3d& mean) {
  const Eigen::ArrayX3d from_mean = samples.offset.rowwise() - mean.transpose().array();
  return (from_mean.square().rowwise().sum().sqrt() * samples.weight).sum() / samples.weight.sum();
}

// Points of the unit cube in six dimensions: the additive recurrence of Roberts' generalised golden
// ratio, shifted by the seed.
class QuadSequence {
 public:
  QuadSequence(std::uint64_t seed, std::uint64_t first) : index_(first) {
    Random random(seed);
    for (double& shift : shifts_)
      shift = random.uniform();
  }

  using Point = std::array<double, 6>;
  Point next() {
    constexpr double ratio = 1.1127756842787055;  // the real root of x^7 = x + 1
    ++index_;
    Point point;
    double step = 1;
    for (std::size_t i = 0; i < point.size(); ++i) {
      step /= ratio;
      const double position = shifts_[i] + static_cast<double>(index_) * step;
      point[i] = position - std::floor(position);
    }
    return point;
  }

 private:
  Point shifts_{};
  std::uint64_t index_;
};

// From the inverse of the largest factor up to it.
double size_factor(double uniform) {
  return std::pow(largest_size_factor, 2 * uniform - 1);
}

// Normals of the planes through the origin and each side, inwards.
std::array<Eigen::Vector3d, 4> side_planes(const AreaLightJudge::Quad& quad) {
  std::array<Eigen::Vector3d, 4> normals;
  for (std::size_t i = 0; i < 4; ++i)
    normals[i] = quad[i].cross(quad[(i + 1) % 4]);
  return normals;
}

// The weight of the samples that a quad covers. A sample's distance from a side is taken from its
// offset, which keeps its digits in sharp lobes.
double weight_inside(const WeightedSamples& samples, const AreaLightJudge::Quad& quad) {
  std::array<Eigen::Vector3d, 4> normals = side_planes(quad);
  std::array<double, 4> bounds;
  for (std::size_t side = 0; side < 4; ++side)
    bounds[side] = -normals[side].dot(samples.axis);
  const Eigen::Index count = samples.weight.size();
  const double* const x = samples.offset.data();
  const double* const y = x + count;
  const double* const z = y + count;
  double inside = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    bool covered = true;
    for (std::size_t side = 0; side < 4; ++side) {
      const Eigen::Vector3d& n = normals[side];
      covered &= n.x() * x[i] + n.y() * y[i] + n.z() * z[i] > bounds[side];
    }
    inside += covered ? samples.weight[i] : 0.0;
  }
  return inside;
}

}  // namespace

AreaLightJudge::AreaLightJudge(const AreaLightSettings& settings)
    : settings_(checked(settings)),
      lattices_{random_lattice(settings, 0), random_lattice(settings, 1)} {}

void AreaLightJudge::set_lobe(const Lobe& lobe, std::uint64_t draw) {
  const std::unique_ptr<LobeSampler> sampler = lobe.model->sampler(lobe);
  for (std::size_t half = 0; half < 2; ++half)
    sampler->sample_all(lattices_[half], samples_[half]);
  draw_quads(*sampler, draw);

  const std::array<double, 2> totals{samples_[0].weight.sum(), samples_[1].weight.sum()};
  amplitude_ = (samples_[0].weight.mean() + samples_[1].weight.mean()) / 2;
  fractions_.clear();
  double squared_errors = 0;
  for (const Quad& quad : quads_) {
    const double first = weight_inside(samples_[0], quad) / totals[0];
    const double second = weight_inside(samples_[1], quad) / totals[1];
    fractions_.push_back((first + second) / 2);
    // Half the difference of two independent estimates has the variance of their mean.
    squared_errors += (first - second) * (first - second) / 4;
  }
  standard_error_ = std::sqrt(squared_errors / static_cast<double>(quads_.size()));
}

void AreaLightJudge::draw_quads(const LobeSampler& sampler, std::uint64_t draw) {
  constexpr double full_turn = 2 * std::numbers::pi;
  const double scale = mean_distance(samples_[0], mean_offset(samples_[0]));
  QuadSequence sequence(settings_.seed + 2, draw * settings_.quads);
  quads_.clear();
  while (quads_.size() < settings_.quads) {
    const auto [azimuth, height, acceptance, turn, size_u, size_v] = sequence.next();
    const LobeSample sample = sampler.sample(azimuth, height);
    if (acceptance * sampler.most_weight() >= sample.weight)
      continue;
    const Eigen::Vector3d center = (sampler.axis() + sample.offset).normalized();
    const Eigen::Vector3d across = center.unitOrthogonal();
    const Eigen::Vector3d u =
        std::cos(full_turn * turn) * across + std::sin(full_turn * turn) * center.cross(across);
    const Eigen::Vector3d half_u = scale * size_factor(size_u) * u;
    const Eigen::Vector3d half_v = scale * size_factor(size_v) * center.cross(u);
    quads_.push_back({center - half_u - half_v, center + half_u - half_v, center + half_u + half_v,
                      center - half_u + half_v});
  }
}

AreaLightError AreaLightJudge::error(const LtcLobe& ltc, std::optional<double> amplitude) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  AreaLightError error{nan, nan, standard_error_};
  const double relative_amplitude = amplitude ? *amplitude / amplitude_ : 1.0;
  if (!is_invertible(ltc.matrix) || !std::isfinite(relative_amplitude))
    return error;
  const FoldedCosine cosine(ltc);
  const double factor = relative_amplitude * horizon_factor(ltc, settings_.horizon);
  error.mean_absolute = error.largest = 0;
  for (std::size_t i = 0; i < quads_.size(); ++i) {
    const double fraction = cosine.integrate_polygon(clip_to_upper_hemisphere(quads_[i]));
    const double difference = std::abs(factor * fraction - fractions_[i]);
    error.mean_absolute += difference / static_cast<double>(quads_.size());
    error.largest = std::max(error.largest, difference);
  }
  return error;
}

}  // namespace ltc
