// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quantile_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "judge/quantile_kernels.h"

namespace ltc {
namespace {

std::size_t rounded_up(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return static_cast<std::size_t>(whole + (static_cast<double>(whole) < value));
}

float key_weight(std::uint64_t key) {
  return std::bit_cast<float>(key_index(key));
}

// W times `total`, the mass of either set; the masses of a set are those up to the end of each of
// its values, the last one `total`.
template <class MassesX, class MassesY>
double merged_distance(const float* x, MassesX&& masses_x, const float* y, MassesY&& masses_y,
                       double total) {
  double distance = 0, mass = 0;
  for (std::size_t i = 0, j = 0; mass < total;) {
    const double end_x = masses_x(i), end_y = masses_y(j), end = std::min(end_x, end_y);
    distance += (end - mass) * static_cast<double>(std::abs(x[i] - y[j]));
    mass = end;
    i += end_x <= end;
    j += end_y <= end;
  }
  return distance;
}

// Of equally weighted values; the last is `total` without rounding.
auto equal_masses(std::size_t count, double total) {
  return [n = static_cast<double>(count), total](std::size_t i) {
    return total * static_cast<double>(i + 1) / n;
  };
}

}  // namespace

void QuantileCells::build(const AlignedVector<std::uint64_t>& keys, double total, float largest) {
  const std::size_t count = keys.size();
  const double cells = static_cast<double>(count), scale = cells / total;
  // No value reaches over more cells than this; each is written as the first one of so many, and
  // its successor overwrites what was too much: no branch depends on the weights.
  const std::size_t reach = rounded_up(scale * static_cast<double>(largest)) + 1;
  values_.resize(count);
  masses_.resize(count + 1);
  moments_.resize(count + 1);
  first_.resize(count + 1 + reach);
  bounds_.resize(count + 1);
  means_.resize(count);
  to_walk_.resize(count + 16);
  double mass = 0, moment = 0;
  masses_[0] = moments_[0] = 0;
  for (std::size_t j = 0; j < count; ++j) {
    values_[j] = key_value(keys[j]);
    const double weight = scale * static_cast<double>(key_weight(keys[j]));
    moment += weight * static_cast<double>(values_[j]);
    mass += weight;
    moments_[j + 1] = moment;
    masses_[j + 1] = std::min(mass, cells);
  }
  for (std::size_t j = 0; j < count; ++j) {
    std::uint32_t* const cell = first_.data() + rounded_up(masses_[j]);
    for (std::size_t i = 0; i < reach; ++i)
      cell[i] = static_cast<std::uint32_t>(j);
  }
  masses_[count] = cells;  // whatever rounding left
  first_[count] = static_cast<std::uint32_t>(count - 1);

  const auto moment_before = [&](std::size_t cell) {
    const std::size_t j = first_[cell];
    return moments_[j] + (static_cast<double>(cell) - masses_[j]) * static_cast<double>(values_[j]);
  };
  double before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double after = moment_before(i + 1);
    bounds_[i] = values_[first_[i]];
    means_[i] = static_cast<float>(after - before);
    before = after;
  }
  bounds_[count] = values_[count - 1];
  // The halves below and above the median weigh the same: the median itself drops out.
  spread_ = (before - 2 * moment_before(count / 2)) / cells;
}

double QuantileCells::walk(std::size_t cell, float x) const {
  const double end = static_cast<double>(cell + 1);
  double distance = 0, mass = static_cast<double>(cell);
  for (std::size_t j = first_[cell]; mass < end; ++j) {
    const double next = std::min(masses_[j + 1], end);
    distance += (next - mass) * static_cast<double>(std::abs(x - values_[j]));
    mass = std::max(mass, next);
  }
  return distance;
}

double QuantileCells::distance(const float* sorted, std::size_t count) {
  if (const auto cells = static_cast<double>(values_.size()); count != values_.size())
    return merged_distance(
               sorted, equal_masses(count, cells), values_.data(),
               [&](std::size_t j) { return masses_[j + 1]; }, cells) /
           cells;
  std::size_t walks = 0;
  double distance =
      kernels::sum_outside(sorted, means_.data(), bounds_.data(), count, to_walk_.data(), walks);
  for (std::size_t i = 0; i < walks; ++i)
    distance += walk(to_walk_[i], sorted[to_walk_[i]]);
  return distance / static_cast<double>(count);
}

double sorted_distance(const float* x, std::size_t x_count, const float* y, std::size_t y_count) {
  if (x_count == y_count && x_count % 16 == 0)
    return kernels::sum_differences(x, y, x_count) / static_cast<double>(x_count);
  const auto total = static_cast<double>(x_count);
  return merged_distance(x, equal_masses(x_count, total), y, equal_masses(y_count, total), total) /
         total;
}

}  // namespace ltc
