// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// References for tests of rounding: numbers of twice the digits of long double, and the worst error
// of many.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace ltc::test {

// The relative error of one rounding to nearest, in double and in single precision.
inline constexpr double kDoubleRounding = 0x1p-53, kFloatRounding = 0x1p-24;

// The unevaluated sum of two long doubles (Dekker 1971): some 38 digits, enough to evaluate
// formulas as they are printed where all digits of a double cancel.
class Wide {
 public:
  Wide(long double value = 0) : high_(value) {}

  explicit operator double() const { return static_cast<double>(high_ + low_); }
  explicit operator long double() const { return high_ + low_; }

  friend Wide operator+(const Wide& a, const Wide& b) {
    const long double sum = a.high_ + b.high_, virtual_b = sum - a.high_;
    const long double rest = (a.high_ - (sum - virtual_b)) + (b.high_ - virtual_b);
    return normalised(sum, rest + a.low_ + b.low_);
  }
  friend Wide operator-(const Wide& a) {
    Wide result;
    result.high_ = -a.high_;
    result.low_ = -a.low_;
    return result;
  }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  friend Wide operator*(const Wide& a, const Wide& b) {
    const long double product = a.high_ * b.high_;
    const long double rest = std::fma(a.high_, b.high_, -product);
    return normalised(product, rest + (a.high_ * b.low_ + a.low_ * b.high_));
  }
  // One step of Newton's on the quotient of long doubles.
  friend Wide operator/(const Wide& a, const Wide& b) {
    const Wide quotient(a.high_ / b.high_);
    return quotient + Wide((a - quotient * b).high_ / b.high_);
  }
  friend Wide sqrt(const Wide& a) {
    if (!(a.high_ > 0))
      return Wide(0);
    const Wide root(std::sqrt(a.high_));
    return root + Wide((a - root * root).high_ / (2 * root.high_));
  }

 private:
  static Wide normalised(long double high, long double low) {
    Wide result;
    result.high_ = high + low;
    result.low_ = low - (result.high_ - high);
    return result;
  }

  long double high_, low_ = 0;
};

// The largest of many errors; NaN is larger than any. What was measured goes into the test's XML
// report, for docs/stability.md.
class WorstError {
 public:
  void add(double error) {
    if (!std::isnan(worst_) && !(std::abs(error) <= worst_))
      worst_ = std::abs(error);
  }
  // `value` against `reference`, as a share of it.
  void add_relative(double value, const Wide& reference) {
    const double difference = static_cast<double>(Wide(value) - reference);
    if (difference != 0)
      add(difference / static_cast<double>(reference));
  }
  double worst() const { return worst_; }

 private:
  double worst_ = 0;
};

// The formula that is used stays within the bound, and the naive one does not: so the bound says
// something.
inline void expect_only_the_careful_one_within(double bound, const WorstError& careful,
                                               const WorstError& naive) {
  EXPECT_LE(careful.worst(), bound);
  EXPECT_FALSE(naive.worst() <= bound) << naive.worst();
  ::testing::Test::RecordProperty("careful", fmt::format("{:.2g}", careful.worst()));
  ::testing::Test::RecordProperty("naive", fmt::format("{:.2g}", naive.worst()));
  ::testing::Test::RecordProperty("bound", fmt::format("{:.2g}", bound));
}

// `count` numbers from `first` to `last`, both included, at equal ratios.
inline std::vector<double> logarithmic(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(first * std::pow(last / first, static_cast<double>(i) / (count - 1)));
  return values;
}

}  // namespace ltc::test
