// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/quantile_model.h"

#include <algorithm>
#include <cmath>

#include "brdf/ggx.h"
#include "core/random.h"

namespace ltc {
namespace {

constexpr std::size_t row_width = kernels::row_width;

// Where bins and starts lie is decided by a subset of the target's samples.
constexpr std::size_t subset_stride = 8;

// Integral of the target's quantile function from 0 to u, for u inside cell j of the edges: the
// cubic that has the cell's mass and moment and the edges as its slopes; at the two open ends,
// where an edge is infinite, linear.
double integrated_quantile(const TargetQuantiles& target, std::size_t direction, std::size_t j,
                           double u) {
  const double* mass = target.mass(direction);
  const double* moment = target.moment(direction);
  const double width = mass[j + 1] - mass[j];
  if (width <= 0)
    return moment[j];
  const double s = std::clamp((u - mass[j]) / width, 0.0, 1.0);
  if (j == 0 || j + 1 == target.bin_count())
    return moment[j] + s * (moment[j + 1] - moment[j]);
  const double lower = width * target.edge(direction, j);
  const double upper = width * target.edge(direction, j + 1);
  const double rise = moment[j + 1] - moment[j];
  // Hermite form of the cubic.
  return moment[j] +
         s * (lower + s * ((3 * rise - 2 * lower - upper) + s * (lower + upper - 2 * rise)));
}

// Mean of the target's quantile function over each bin of the LTC, `populations` samples of
// `count`.
void match_quantiles(const TargetQuantiles& target, std::size_t direction,
                     const std::int32_t* populations, std::size_t count, double* means) {
  const double* mass = target.mass(direction);
  const std::size_t bins = target.bin_count();
  std::size_t cell = 0;
  std::size_t below = 0;
  double previous = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    if (populations[b] == 0)
      continue;
    below += static_cast<std::size_t>(populations[b]);
    const double u = static_cast<double>(below) / static_cast<double>(count);
    while (cell + 1 < bins && mass[cell + 1] < u)
      ++cell;
    const double integral = integrated_quantile(target, direction, cell, u);
    means[b] = (integral - previous) * static_cast<double>(count) / populations[b];
    previous = integral;
  }
}

void reserve(TargetSamples& samples, std::size_t count) {
  samples.size = count;
  for (AlignedFloats* array : {&samples.gx, &samples.gy, &samples.gz, &samples.weight})
    if (array->size() < count)
      array->resize(count);
}

}  // namespace

TargetMoments target_moments(const TargetSamples& samples) {
  double total = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < samples.size; i += subset_stride) {
    const Eigen::Vector3d g(samples.gx[i], samples.gy[i], samples.gz[i]);
    const double w = samples.weight[i];
    total += w;
    first += w * g;
    second += w * g * g.transpose();
  }
  const Eigen::Vector3d mean = first / total;
  return {mean, second / total - mean * mean.transpose()};
}

double target_deviation(const TargetSamples& samples, const Eigen::Vector3d& direction,
                        double centre) {
  double total = 0, deviation = 0;
  for (std::size_t i = 0; i < samples.size; i += subset_stride) {
    const double xi = direction.x() * samples.gx[i] + direction.y() * samples.gy[i] +
                      direction.z() * samples.gz[i];
    total += samples.weight[i];
    deviation += samples.weight[i] * std::abs(xi - centre);
  }
  return deviation / total;
}

void sample_rejection_target(const LobeFrame& frame, std::size_t count, std::uint64_t seed,
                             TargetSamples& samples) {
  reserve(samples, (count + 15) / 16 * 16);
  const GgxSampler sampler(frame.lobe);
  Random random(seed);
  const auto uniform = [&] { return random.uniform(); };
  const Eigen::Matrix3d to_frame = frame.rotation.transpose();
  for (std::size_t i = 0; i < samples.size; ++i) {
    const Eigen::Vector3d offset =
        i < count ? (to_frame * sampler.sample_rejection(uniform).offset).eval()
                  : Eigen::Vector3d::Zero();
    samples.gx[i] = static_cast<float>(offset.x());
    samples.gy[i] = static_cast<float>(offset.y());
    samples.gz[i] = static_cast<float>(offset.z());
    samples.weight[i] = i < count ? 1.0f : 0.0f;
  }
}

void sample_weighted_target(const LobeFrame& frame, const TargetLattice& lattice,
                            TargetSamples& samples) {
  reserve(samples, lattice.size());
  kernels::TargetParameters parameters{
      static_cast<float>(frame.lobe.alpha_x), static_cast<float>(frame.lobe.alpha_y),
      static_cast<float>(frame.omega_v.x()),  static_cast<float>(frame.omega_v.y()),
      static_cast<float>(frame.omega_v.z()),  {}};
  for (int i = 0; i < 9; ++i)
    parameters.rotation[i] = static_cast<float>(frame.rotation(i / 3, i % 3));
  kernels::sample_target(parameters, lattice.cos_azimuth.data(), lattice.sin_azimuth.data(),
                         lattice.height.data(), lattice.size(), samples.gx.data(),
                         samples.gy.data(), samples.gz.data(), samples.weight.data());
}

void TargetQuantiles::build(const TargetSamples& samples,
                            const std::vector<Eigen::Vector3f>& directions, std::size_t bin_count,
                            AlignedFloats& xi, AlignedVector<std::int32_t>& bins) {
  if (bin_count_ != bin_count) {
    bin_count_ = bin_count;
    unit_edges_.resize(bin_count + 1);
    for (std::size_t j = 0; j <= bin_count; ++j) {
      const double t = 2.0 * static_cast<double>(j) / static_cast<double>(bin_count) - 1;
      unit_edges_[j] = t / std::sqrt(1 - t * t);
    }
  }
  maps_.resize(directions.size());
  mass_.resize(directions.size() * (bin_count + 1));
  moment_.resize(mass_.size());
  sums_.resize(2 * bin_count);
  if (xi.size() < samples.size) {
    xi.resize(samples.size);
    bins.resize(samples.size);
  }
  const Eigen::Vector3d mean = target_moments(samples).mean;
  spread_ = 0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Eigen::Vector3d d = directions[k].cast<double>();
    const double centre = d.dot(mean);
    const double scale = std::max(target_deviation(samples, d, centre), 1e-30);
    maps_[k] = {directions[k].x(), directions[k].y(), directions[k].z(), static_cast<float>(centre),
                static_cast<float>(1 / scale)};
    kernels::project_and_bin(maps_[k], samples.gx.data(), samples.gy.data(), samples.gz.data(),
                             samples.size, bin_count, xi.data(), bins.data());
    std::fill(sums_.begin(), sums_.end(), 0.0f);
    kernels::accumulate_weights(xi.data(), bins.data(), samples.weight.data(), samples.size,
                                sums_.data());
    double* mass = mass_.data() + k * (bin_count + 1);
    double* moment = moment_.data() + k * (bin_count + 1);
    mass[0] = moment[0] = 0;
    for (std::size_t b = 0; b < bin_count; ++b) {
      mass[b + 1] = mass[b] + sums_[2 * b];
      moment[b + 1] = moment[b] + sums_[2 * b + 1];
    }
    const double total = mass[bin_count];
    for (std::size_t j = 1; j <= bin_count; ++j) {
      mass[j] /= total;
      moment[j] /= total;
    }
    spread_ += scale;
  }
  spread_ /= static_cast<double>(directions.size());
}

void evaluate_model(const LobeFrame& frame, const Eigen::Matrix3d& frame_matrix,
                    const CosineSet& cosines, const TargetQuantiles& target, double smoothing,
                    ModelWorkspace& workspace, ModelValue& value) {
  const std::size_t count = cosines.size(), bins = target.bin_count();
  if (workspace.gx.size() < count) {
    for (AlignedFloats* array : {&workspace.gx, &workspace.gy, &workspace.gz, &workspace.xi})
      array->resize(count);
    workspace.rows.resize(count * row_width);
    workspace.bins.resize(count);
  }
  if (workspace.populations.size() < bins) {
    workspace.sums.resize(bins * row_width);
    workspace.vectors.resize(bins * row_width);
    workspace.factors.resize(bins);
    workspace.populations.resize(bins);
    workspace.target_means.resize(bins);
  }
  float p[9];
  for (int i = 0; i < 9; ++i)
    p[i] = static_cast<float>(frame_matrix(i / 3, i % 3));
  kernels::transform_samples(p, static_cast<float>(frame.lobe.alpha_x),
                             static_cast<float>(frame.lobe.alpha_y), cosines.x.data(),
                             cosines.y.data(), cosines.z.data(), count, workspace.gx.data(),
                             workspace.gy.data(), workspace.gz.data(), workspace.rows.data());
  value.loss = 0;
  value.gradient.setZero();
  value.curvature.setZero();
  alignas(vector_alignment) float hessian[9 * row_width];
  const double inverse_count = 1.0 / static_cast<double>(count);
  const double inverse_directions = 1.0 / static_cast<double>(target.direction_count());
  for (std::size_t k = 0; k < target.direction_count(); ++k) {
    const kernels::ProjectionMap& map = target.map(k);
    kernels::project_and_bin(map, workspace.gx.data(), workspace.gy.data(), workspace.gz.data(),
                             count, bins, workspace.xi.data(), workspace.bins.data());
    std::fill_n(workspace.sums.data(), bins * row_width, 0.0f);
    std::fill_n(workspace.populations.data(), bins, 0);
    kernels::accumulate_rows(workspace.xi.data(), workspace.bins.data(), workspace.rows.data(),
                             count, map.direction_z, workspace.sums.data(),
                             workspace.populations.data());
    match_quantiles(target, k, workspace.populations.data(), count, workspace.target_means.data());
    std::size_t blocks = 0;
    double loss = 0;
    float gradient[9] = {};
    for (std::size_t b = 0; b < bins; ++b) {
      const std::int32_t population = workspace.populations[b];
      if (population == 0)
        continue;
      const float* sum = workspace.sums.data() + b * row_width;
      float* j = workspace.vectors.data() + blocks * row_width;
      jacobian_of_sums(map, sum, j);
      for (std::size_t c = 9; c < row_width; ++c)
        j[c] = 0;
      const double residual = sum[15] / static_cast<double>(population) - workspace.target_means[b];
      loss += std::abs(residual) * population;
      const double weight = 1 / (std::abs(residual) + smoothing);
      const float pull = static_cast<float>(residual * weight);
      for (int i = 0; i < 9; ++i)
        gradient[i] += pull * j[i];
      workspace.factors[blocks++] = static_cast<float>(weight / population);
    }
    std::fill_n(hessian, 9 * row_width, 0.0f);
    kernels::accumulate_outer_products(workspace.vectors.data(), workspace.factors.data(), blocks,
                                       hessian);
    value.loss += loss;
    for (int row = 0; row < 9; ++row) {
      value.gradient[row] += gradient[row];
      for (int column = 0; column < 9; ++column)
        value.curvature(row, column) += hessian[row * row_width + column];
    }
  }
  value.loss *= inverse_count * inverse_directions;
  value.gradient *= inverse_count * inverse_directions;
  value.curvature *= inverse_count * inverse_directions;
}

}  // namespace ltc
