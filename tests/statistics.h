// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Pearson's chi-squared test for samplers.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ltc::test {

// The suite as a whole rejects a right sampler with probability below 1e-3: each of at most 32
// tests has significance 3.1e-5, which is 4 standard deviations of a normal variable, one-sided.
// Seeds are fixed, so a test that passes once always does.
inline constexpr double kChiSquaredDeviations = 4.0;

struct ChiSquared {
  double statistic = 0;
  std::size_t degrees_of_freedom = 0;

  // Wilson and Hilferty 1931: the cube root of chi^2/k is nearly normal. Good to 1 % of a deviation
  // at the 50 and more degrees of freedom used here.
  double deviations() const {
    const double variance = 2.0 / (9.0 * static_cast<double>(degrees_of_freedom));
    return (std::cbrt(statistic / static_cast<double>(degrees_of_freedom)) - (1 - variance)) /
           std::sqrt(variance);
  }
  bool accepted() const { return deviations() < kChiSquaredDeviations; }
};

// Observed counts (or sums of weights that lie in [0, 1], whose variance is no larger) against
// expected ones of the same bins. Bins that expect fewer than 10 are pooled.
inline ChiSquared chi_squared(const std::vector<double>& observed,
                              const std::vector<double>& expected) {
  ChiSquared result;
  double pooled_observed = 0, pooled_expected = 0;
  auto add = [&](double seen, double wanted) {
    result.statistic += (seen - wanted) * (seen - wanted) / wanted;
    ++result.degrees_of_freedom;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 10) {
      pooled_observed += observed[i];
      pooled_expected += expected[i];
    } else {
      add(observed[i], expected[i]);
    }
  }
  if (pooled_expected > 0)
    add(pooled_observed, pooled_expected);
  --result.degrees_of_freedom;  // the total is given
  return result;
}

// A small generator of uniforms on [0, 1) whose bits are the same on every platform: SplitMix64.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace ltc::test
