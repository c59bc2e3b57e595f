// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/quantile_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/random.h"
#include "judge/quantile_kernels.h"

namespace ltc {
namespace {

struct Example {
  std::string name;
  std::vector<float> values, weights;  // of the weighted set
  AlignedFloats sorted;                // the other
};

// int |F^-1 - G^-1| du value by value in double, by merging both sets' steps.
double merged_distance(const Example& example) {
  std::vector<std::size_t> order(example.values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return example.values[a] < example.values[b]; });
  const double total = std::accumulate(example.weights.begin(), example.weights.end(), 0.0);
  const auto count = static_cast<double>(example.sorted.size());
  double distance = 0, u = 0, mass = 0;
  std::size_t i = 0;
  for (const std::size_t j : order) {
    mass += example.weights[j] / total;
    while (u < mass && i < example.sorted.size()) {
      const double step = static_cast<double>(i + 1) / count, next = std::min(step, mass);
      distance += (next - u) * std::abs(double{example.sorted[i]} - double{example.values[j]});
      u = next;
      i += step <= mass;
    }
  }
  return distance;
}

double merged_spread(Example example) {
  double best = std::numeric_limits<double>::infinity();
  const std::vector<float> values = example.values;
  for (const float value : values) {
    std::fill(example.sorted.begin(), example.sorted.end(), value);
    best = std::min(best, merged_distance(example));
  }
  return best;
}

QuantileCells cells_of(const Example& example) {
  AlignedVector<std::uint64_t> keys;
  for (std::size_t i = 0; i < example.values.size(); ++i)
    keys.push_back(QuantileCells::key(example.values[i], example.weights[i]));
  std::sort(keys.begin(), keys.end());
  QuantileCells cells;
  cells.build(keys, std::accumulate(example.weights.begin(), example.weights.end(), 0.0),
              *std::max_element(example.weights.begin(), example.weights.end()));
  return cells;
}

// Sets far apart, close together (where many values fall inside cells), with ties, with weights
// from nothing to many cells' worth.
std::vector<Example> examples() {
  constexpr std::size_t count = 1024;
  Random random(20220712);
  const auto draw = [&](auto&& make) {
    std::vector<float> values(count);
    for (float& value : values)
      value = static_cast<float>(make());
    return values;
  };
  const auto uniform = [&] { return random.uniform() - 0.5; };
  const auto ties = [&] { return std::floor(8 * random.uniform()) / 8 - 0.5; };
  const auto weight = [&] { return random.uniform(); };
  const auto often_none = [&] { return random.uniform() < 0.7 ? 0 : random.uniform(); };
  const auto unequal = [&] { return std::pow(random.uniform(), 30); };
  const auto sorted = [](std::vector<float> values, float scale, float shift) {
    std::sort(values.begin(), values.end());
    AlignedFloats result(values.begin(), values.end());
    for (float& value : result)
      value = scale * value + shift;
    return result;
  };
  std::vector<Example> all;
  for (auto& [name, values] :
       {std::pair{std::string("uniform"), draw(uniform)}, {"ties", draw(ties)}})
    for (auto& [kind, weights] : {std::pair{std::string("equal"), std::vector<float>(count, 0.25f)},
                                  {"uniform", draw(weight)},
                                  {"often none", draw(often_none)},
                                  {"unequal", draw(unequal)}})
      for (auto& [where, scale, shift] :
           {std::tuple{"far", 1.0f, 3.0f}, {"wider", 1.3f, 0.0f}, {"close", 1.0f, 1e-4f}})
        all.push_back({name + " values, " + kind + " weights, " + where, values, weights,
                       sorted(values, scale, shift)});
  return all;
}

TEST(QuantileCells, DistanceIsThatOfMergedSteps) {
  for (const Example& example : examples())
    // Means in single precision, each off by at most 2^-24 of values below 4.
    EXPECT_NEAR(cells_of(example).distance(example.sorted.data(), example.sorted.size()),
                merged_distance(example), 2e-7)
        << example.name;
}

TEST(QuantileCells, SoIsThatOfAnyNumberOfValues) {
  for (Example example : examples()) {
    for (const std::size_t kept : {1000, 512, 37, 1}) {
      // Differences in single precision, each off by at most 2^-24 of values below 4.
      example.sorted.resize(kept);
      EXPECT_NEAR(cells_of(example).distance(example.sorted.data(), kept), merged_distance(example),
                  2e-7)
          << example.name << ", " << kept;
    }
  }
}

TEST(QuantileCells, SortedSetsOfAnyNumbersHaveADistance) {
  // All of y is one value: the mean distance from it.
  AlignedFloats x{0, 1, 2, 3}, y{5, 5, 5, 5, 5, 5};
  EXPECT_NEAR(sorted_distance(x.data(), 4, y.data(), 6), 3.5, 1e-15);
  y = {0, 0, 1, 2, 3, 3};
  // Masses of 12: 3 of each x, 2 of each y; off by 1 in (3, 4) and (8, 9).
  EXPECT_NEAR(sorted_distance(x.data(), 4, y.data(), 6), 2.0 / 12, 1e-15);
  EXPECT_EQ(sorted_distance(x.data(), 4, x.data(), 4), 0);
}

TEST(QuantileCells, SpreadIsTheLeastDistanceToOneValue) {
  for (const Example& example : examples())
    // The least is at a value of the set. Both in double.
    EXPECT_NEAR(cells_of(example).spread(), merged_spread(example), 1e-12) << example.name;
}

TEST(QuantileCells, ASetHasNoDistanceToItself) {
  Example example = examples().front();
  ASSERT_EQ(example.name, "uniform values, equal weights, far");
  example.sorted.assign(example.values.begin(), example.values.end());
  std::sort(example.sorted.begin(), example.sorted.end());
  // Means in single precision of values in [-0.5, 0.5].
  EXPECT_LT(cells_of(example).distance(example.sorted.data(), example.sorted.size()), 1e-8);
}

TEST(QuantileCells, AMoveByMoreThanTheSetsWidthIsTheDistance) {
  for (const Example& example : examples()) {
    if (!example.name.ends_with("equal weights, far") ||
        example.name.find("unequal") != std::string::npos)
      continue;
    EXPECT_NEAR(cells_of(example).distance(example.sorted.data(), example.sorted.size()), 3, 2e-7)
        << example.name;
  }
}

TEST(QuantileKernels, SumTheDifferencesOfSortedSets) {
  AlignedFloats x(1040), y(1040);
  double expected = 0;
  Random random(7);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<float>(random.uniform());
    y[i] = static_cast<float>(random.uniform());
    expected += std::abs(double{x[i]} - double{y[i]});
  }
  // 1040 differences below 1, added in lanes of at most 128 in single precision.
  EXPECT_NEAR(kernels::sum_differences(x.data(), y.data(), x.size()) / expected, 1, 1e-6);
}

}  // namespace
}  // namespace ltc
