// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/quantile_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "brdf/lobe_model.h"
#include "core/random.h"

namespace ltc {
namespace {

// Where bins and starts lie is decided by a subset of the target's samples.
constexpr std::size_t subset_stride = 8;

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

namespace {

// Sample i as the kernels take it.
void set(TargetSamples& samples, std::size_t i, const Eigen::Vector3d& offset, double weight) {
  samples.gx[i] = static_cast<float>(offset.x());
  samples.gy[i] = static_cast<float>(offset.y());
  samples.gz[i] = static_cast<float>(offset.z());
  samples.weight[i] = static_cast<float>(weight);
}

void begin(const LobeFrame& frame, std::size_t count, TargetSamples& samples) {
  samples.reserve(count);
  samples.heavy_tails = frame.lobe.model->heavy_tails();
}

}  // namespace

void sample_rejection_target(const LobeFrame& frame, std::size_t count, std::uint64_t seed,
                             TargetSamples& samples) {
  begin(frame, lattice_size(count), samples);
  const std::unique_ptr<LobeSampler> sampler = frame.lobe.model->sampler(frame.lobe);
  Random random(seed);
  const auto uniform = [&] { return random.uniform(); };
  const Eigen::Matrix3d to_frame = frame.rotation.transpose();
  for (std::size_t i = 0; i < samples.size; ++i)
    if (i < count)
      set(samples, i, to_frame * sampler->sample_rejection(uniform).offset, 1);
    else
      set(samples, i, Eigen::Vector3d::Zero(), 0);
}

void sample_weighted_target(const LobeFrame& frame, const TargetLattice& lattice,
                            TargetSamples& samples) {
  begin(frame, lattice.size(), samples);
  frame.lobe.model->sample_target(frame.lobe, frame.rotation, lattice, samples);
}

void sample_graded_target(const LobeFrame& frame, const GradedLattice& lattice,
                          TargetSamples& samples) {
  begin(frame, lattice.size(), samples);
  const std::unique_ptr<LobeSampler> sampler = frame.lobe.model->sampler(frame.lobe);
  const Eigen::Matrix3d to_frame = frame.rotation.transpose();
  // Their masses add up to one; the weights of other targets to about their number.
  const auto scale = static_cast<double>(lattice.size());
  for (std::size_t i = 0; i < samples.size; ++i) {
    const LobeSample sample =
        sampler->sample(lattice.cos_azimuth[i], lattice.sin_azimuth[i], 1 - lattice.depth[i]);
    set(samples, i, to_frame * sample.offset, scale * lattice.mass[i] * sample.weight);
  }
}

void TargetQuantiles::reserve(std::size_t directions, std::size_t bin_count, BinSpacing spacing) {
  if (bin_count_ != bin_count || spacing_ != spacing) {
    bin_count_ = bin_count;
    spacing_ = spacing;
    unit_edges_.resize(bin_count + 1);
    for (std::size_t j = 0; j <= bin_count; ++j) {
      double t = 2.0 * static_cast<double>(j) / static_cast<double>(bin_count) - 1;
      if (spacing == BinSpacing::graded)
        t = std::copysign(1 - (1 - std::abs(t)) * (1 - std::abs(t)), t);
      unit_edges_[j] = t / std::sqrt((1 - t) * (1 + t));
    }
  }
  maps_.resize(directions);
  first_tail_.resize(directions);
  last_tail_.resize(directions);
  mass_.resize(directions * (bin_count + 1));
  for (AlignedFloats* array : {&moment_, &inverse_width_, &c1_, &c2_, &c3_})
    array->resize(directions * bin_count);
  first_cell_.resize(directions * bin_count);
  sums_.resize(directions * 2 * bin_count);
}

void TargetQuantiles::build(const TargetSamples& samples,
                            const std::vector<Eigen::Vector3f>& directions, std::size_t bin_count,
                            AlignedFloats& xi, AlignedVector<std::int32_t>& bins,
                            BinSpacing spacing) {
  reserve(directions.size(), bin_count, spacing);
  if (pairs_.size() < 2 * samples.size)
    pairs_.resize(2 * samples.size);
  if (xi.size() < samples.size)
    xi.resize(samples.size);
  if (bins.size() < samples.size)
    bins.resize(samples.size);
  const Eigen::Vector3d mean = target_moments(samples).mean;
  heavy_tails_ = samples.heavy_tails;
  spread_ = 0;
  std::fill(sums_.begin(), sums_.end(), 0.0f);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Eigen::Vector3d d = directions[k].cast<double>();
    const double centre = d.dot(mean);
    const double scale = std::max(target_deviation(samples, d, centre), 1e-30);
    maps_[k] = {directions[k].x(),
                directions[k].y(),
                directions[k].z(),
                static_cast<float>(centre),
                static_cast<float>(1 / scale),
                spacing};
    kernels::project_and_bin(
        maps_[k], {samples.gx.data(), samples.gy.data(), samples.gz.data(), samples.size},
        bin_count, xi.data(), bins.data());
    kernels::accumulate_weights(xi.data(), bins.data(), samples.weight.data(), samples.size,
                                pairs_.data(), sums_.data() + k * 2 * bin_count);
    cut_into_cells(k);
    spread_ += scale;
  }
  spread_ /= static_cast<double>(directions.size());
}

void TargetQuantiles::keep(BinnedTarget& binned) const {
  binned.spread = spread_;
  binned.heavy_tails = heavy_tails_;
  binned.values.clear();
  binned.values.reserve(maps_.size() * (2 + 2 * bin_count_));
  for (std::size_t k = 0; k < maps_.size(); ++k) {
    binned.values.push_back(maps_[k].centre);
    binned.values.push_back(maps_[k].inverse_scale);
    const float* sums = sums_.data() + k * 2 * bin_count_;
    binned.values.insert(binned.values.end(), sums, sums + 2 * bin_count_);
  }
}

void TargetQuantiles::rebuild(const BinnedTarget& binned,
                              const std::vector<Eigen::Vector3f>& directions,
                              std::size_t bin_count) {
  reserve(directions.size(), bin_count, BinSpacing::even);
  spread_ = binned.spread;
  heavy_tails_ = binned.heavy_tails;
  const float* values = binned.values.data();
  for (std::size_t k = 0; k < directions.size(); ++k, values += 2 + 2 * bin_count) {
    maps_[k] = {directions[k].x(), directions[k].y(), directions[k].z(), values[0], values[1]};
    std::copy_n(values + 2, 2 * bin_count, sums_.data() + k * 2 * bin_count);
    cut_into_cells(k);
  }
}

// Mass and moment of every bin to the cells of kernels::TargetCells. Inside, the integral of the
// quantile function is the cubic with the cell's mass and moment whose slopes at the ends are the
// bin's edges. In the first and last cell, where an edge is infinite, the quantiles are those of a
// tail that falls like the GGX lobe's, a + b tau^(-1/2) for the mass tau beyond, with the finite
// edge as the least of them and the cell's moment: integrated, a linear part and a root. Where the
// lobe has no such tails, they are all the cell's mean.
void TargetQuantiles::cut_into_cells(std::size_t direction) {
  const kernels::ProjectionMap& map = maps_[direction];
  const float* sums = sums_.data() + direction * 2 * bin_count_;
  double total = 0;
  for (std::size_t b = 0; b < bin_count_; ++b)
    total += sums[2 * b];
  float* mass = mass_.data() + direction * (bin_count_ + 1);
  const std::size_t first = direction * bin_count_;
  double below = 0, moment = 0;
  mass[0] = 0;
  for (std::size_t b = 0; b < bin_count_; ++b) {
    const double width = sums[2 * b] / total, rise = sums[2 * b + 1] / total;
    below += width;
    mass[b + 1] = static_cast<float>(below);
    moment_[first + b] = static_cast<float>(moment);
    inverse_width_[first + b] = width > 0 ? static_cast<float>(1 / width) : 0.0f;
    const bool is_first = b == 0, is_last = b + 1 == bin_count_;
    const bool open = is_first || is_last;
    const double lower = width * (map.centre + unit_edges_[b] / map.inverse_scale);
    const double upper = width * (map.centre + unit_edges_[b + 1] / map.inverse_scale);
    const double tail =
        open && heavy_tails_ && width > 0 ? 2 * (rise - (is_first ? upper : lower)) : 0;
    if (is_first)
      first_tail_[direction] = static_cast<float>(tail);
    if (is_last)
      last_tail_[direction] = static_cast<float>(tail);
    c1_[first + b] = static_cast<float>(open ? rise - tail : lower);
    c2_[first + b] = open ? 0.0f : static_cast<float>(3 * rise - 2 * lower - upper);
    c3_[first + b] = open ? 0.0f : static_cast<float>(lower + upper - 2 * rise);
    moment += rise;
  }
  mass[bin_count_] = 1;
  std::int32_t cell = 0;
  for (std::size_t i = 0; i < bin_count_; ++i) {
    const float u = static_cast<float>(i) / static_cast<float>(bin_count_);
    while (static_cast<std::size_t>(cell) + 1 < bin_count_ && mass[cell + 1] < u)
      ++cell;
    first_cell_[first + i] = cell;
  }
}

kernels::TargetCells TargetQuantiles::cells(std::size_t direction) const {
  const std::size_t first = direction * bin_count_;
  return {mass_.data() + direction * (bin_count_ + 1),
          first_cell_.data() + first,
          moment_.data() + first,
          inverse_width_.data() + first,
          c1_.data() + first,
          c2_.data() + first,
          c3_.data() + first,
          first_tail_[direction],
          last_tail_[direction]};
}

namespace {

using kernels::directions_at_once;

using Counts = AlignedVector<std::int32_t>;

// How often each transformed sample counts; empty where all do once. Where none is above the
// horizon, all count.
const Counts& counts_of(const ModelPoint& point, ModelWorkspace& workspace) {
  const CosineSet& cosines = point.cosines;
  if (cosines.horizon == HorizonMode::clipped)
    return cosines.multiplicity;
  const Eigen::RowVector3f up = point.frame.rotation.row(2).cast<float>();
  Counts& counts = workspace.counts;
  counts.resize(cosines.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const float height =
        up.x() * workspace.gx[i] + up.y() * workspace.gy[i] + up.z() * workspace.gz[i] + up.z();
    counts[i] = height <= 0 ? 0 : cosines.multiplicity.empty() ? 1 : cosines.multiplicity[i];
  }
  return total_of(counts, 0) > 0 ? counts : cosines.multiplicity;
}

// Each sample's row as often as it counts.
void multiply_rows(const Counts& counts, std::size_t width, AlignedFloats& rows) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto factor = static_cast<float>(counts[i]);
    float* row = rows.data() + i * width;
    for (std::size_t entry = 0; entry < width; ++entry)
      row[entry] *= factor;
  }
}

// The populations anew.
void count_with_multiplicity(const Counts& counts, std::size_t group, std::size_t bins,
                             ModelWorkspace& workspace) {
  const std::size_t count = counts.size();
  std::fill_n(workspace.populations.data(), group * bins, 0);
  for (std::size_t member = 0; member < group; ++member) {
    const std::int32_t* of_sample = workspace.bins.data() + member * count;
    std::int32_t* populations = workspace.populations.data() + member * bins;
    for (std::size_t i = 0; i < count; ++i)
      populations[of_sample[i]] += counts[i];
  }
}

// The rows of all samples, summed into the bins of each of `maps`.
template <std::size_t columns>
void sum_into_bins(std::span<const kernels::ProjectionMap* const> maps, std::size_t count,
                   const Counts& counts, std::size_t bins, ModelWorkspace& workspace) {
  std::array<float, directions_at_once> direction_z;
  for (std::size_t member = 0; member < maps.size(); ++member) {
    direction_z[member] = maps[member]->direction_z;
    kernels::project_and_bin(
        *maps[member], {workspace.gx.data(), workspace.gy.data(), workspace.gz.data(), count}, bins,
        workspace.xi.data() + member * count, workspace.bins.data() + member * count);
  }
  std::fill_n(workspace.sums.data(), maps.size() * bins * kernels::row_width_of(columns), 0.0f);
  std::fill_n(workspace.populations.data(), maps.size() * bins, 0);
  kernels::accumulate_rows({workspace.xi.data(), workspace.bins.data(), count, bins},
                           workspace.rows.data(), direction_z.data(), maps.size(),
                           {workspace.sums.data(), workspace.populations.data()}, columns);
  if (!counts.empty())
    count_with_multiplicity(counts, maps.size(), bins, workspace);
}

// Adds what one direction's bins say.
template <int numbers>
void add_direction(const kernels::DirectionBins& of, const kernels::TargetCells& cells,
                   double smoothing, AlignedFloats& scratch, ModelValueOf<numbers>& value) {
  constexpr std::size_t row_width = kernels::row_width_of(numbers / 3);
  alignas(vector_alignment) float gradient[row_width] = {};
  alignas(vector_alignment) float hessian[numbers * row_width] = {};
  kernels::DirectionSums result{gradient, hessian, 0};
  kernels::reduce_direction(of, cells, static_cast<float>(smoothing), scratch.data(), result);
  // In double from direction to direction: the scale of P is a direction of zero curvature, and
  // only rounding may say otherwise.
  value.loss += result.loss;
  for (int row = 0; row < numbers; ++row) {
    value.gradient[row] += gradient[row];
    for (int column = 0; column < numbers; ++column)
      value.curvature(row, column) += hessian[row * row_width + column];
  }
}

template <int numbers>
void evaluate(const ModelPoint& point, const FoldedColumn* fold, ModelWorkspace& workspace,
              ModelValueOf<numbers>& value) {
  constexpr std::size_t columns = numbers / 3, width = kernels::row_width_of(columns);
  const CosineSet& cosines = point.cosines;
  const TargetQuantiles& target = point.target;
  const std::size_t count = cosines.size(), bins = target.bin_count();
  workspace.reserve(count, bins, columns);
  float p[9];
  for (int i = 0; i < 9; ++i)
    p[i] = static_cast<float>(point.frame_matrix(i / 3, i % 3));
  const Eigen::Vector3f q = fold ? fold->q.cast<float>().eval() : Eigen::Vector3f::Zero();
  kernels::transform_samples(
      {p, static_cast<float>(point.frame.widths.x()), static_cast<float>(point.frame.widths.y()),
       fold ? q.data() : nullptr, fold ? fold->u.data() : nullptr},
      {cosines.x.data(), cosines.y.data(), cosines.z.data(), count},
      {workspace.gx.data(), workspace.gy.data(), workspace.gz.data(), workspace.rows.data()});
  const Counts& counts = counts_of(point, workspace);
  const std::size_t total = total_of(counts, count);
  multiply_rows(counts, width, workspace.rows);
  value.gradient.setZero();
  value.curvature.setZero();
  value.loss = 0;
  std::array<const kernels::ProjectionMap*, directions_at_once> maps;
  std::size_t directions = 0;
  for (std::size_t k = 0; k < target.direction_count();) {
    const std::size_t first = k;
    std::size_t group = 0;
    for (; group < directions_at_once && k < target.direction_count(); k += point.direction_stride)
      maps[group++] = &target.map(k);
    sum_into_bins<columns>({maps.data(), group}, count, counts, bins, workspace);
    for (std::size_t member = 0; member < group; ++member)
      add_direction<numbers>({*maps[member], workspace.sums.data() + member * bins * width,
                              workspace.populations.data() + member * bins, bins, total, columns},
                             target.cells(first + member * point.direction_stride), point.smoothing,
                             workspace.scratch, value);
    directions += group;
  }
  const double share = 1 / (static_cast<double>(total) * static_cast<double>(directions));
  value.loss *= share;
  value.gradient *= share;
  value.curvature *= share;
}

}  // namespace

void evaluate_model(const ModelPoint& point, ModelWorkspace& workspace, ModelValue& value) {
  evaluate<9>(point, nullptr, workspace, value);
}

void evaluate_model(const ModelPoint& point, const FoldedColumn& fold, ModelWorkspace& workspace,
                    FoldedModelValue& value) {
  evaluate<12>(point, &fold, workspace, value);
}

BentModelValue bent(const FoldedModelValue& of_columns, const Eigen::Matrix3d& frame_matrix,
                    const Bend& bend) {
  // How (P q) changes with P and the bend.
  Eigen::Matrix<double, 12, 11> change;
  change.setZero();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      change(4 * row + column, 3 * row + column) = 1;
    for (int i = 0; i < 2; ++i) {
      change(4 * row + 3, 3 * row + 1 + i) = bend[i];
      change(4 * row + 3, 9 + i) = frame_matrix(row, 1 + i);
    }
  }
  return {of_columns.loss, change.transpose() * of_columns.gradient,
          change.transpose() * of_columns.curvature * change};
}

void ModelWorkspace::reserve(std::size_t samples, std::size_t bin_count, std::size_t columns) {
  const std::size_t width = kernels::row_width_of(columns);
  if (gx.size() < samples)
    for (AlignedFloats* array : {&gx, &gy, &gz})
      array->resize(samples);
  if (rows.size() < samples * width)
    rows.resize(samples * width);
  if (xi.size() < directions_at_once * samples)
    xi.resize(directions_at_once * samples);
  if (bins.size() < directions_at_once * samples)
    bins.resize(directions_at_once * samples);
  if (sums.size() < directions_at_once * bin_count * width) {
    sums.resize(directions_at_once * bin_count * width);
    scratch.resize(bin_count * (4 + width));
    populations.resize(directions_at_once * bin_count);
  }
}

}  // namespace ltc
