// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Scales there and back, ticks at the values a reader expects, and their words.
#include "picture/scale.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace ltc::picture {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks)
    if (!tick.label.empty())
      labels.push_back(tick.label);
  return labels;
}

using Labels = std::vector<std::string>;

TEST(Scale, MapsItsEndsToZeroAndOneAndBack) {
  for (const Scale& scale : {Scale::linear(-3, 5), Scale::logarithmic(1e-4, 20),
                             Scale::symmetric_logarithmic(10, 0.01)}) {
    EXPECT_DOUBLE_EQ(scale.position(scale.first()), 0);
    EXPECT_DOUBLE_EQ(scale.position(scale.last()), 1);
    for (double u = 0; u <= 1; u += 1.0 / 16)
      // exp and sinh lose at most a few units in the last place of numbers below ten.
      EXPECT_NEAR(scale.position(scale.value(u)), u, 1e-13);
  }
  EXPECT_DOUBLE_EQ(Scale::logarithmic(1, 100).position(10), 0.5);
  EXPECT_DOUBLE_EQ(Scale::symmetric_logarithmic(10, 0.01).position(0), 0.5);
}

TEST(Scale, NanStaysNanAndWhatALogarithmCannotShowIsBelow) {
  EXPECT_TRUE(std::isnan(Scale::linear(0, 1).position(std::nan(""))));
  EXPECT_TRUE(std::isnan(Scale::logarithmic(1, 2).position(std::nan(""))));
  EXPECT_EQ(Scale::logarithmic(1, 2).position(0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(Scale::logarithmic(1, 2).position(-1), -std::numeric_limits<double>::infinity());
}

TEST(Scale, RefusesEndsThatAreNone) {
  EXPECT_THROW(Scale::linear(1, 1), InputError);
  EXPECT_THROW(Scale::linear(2, 1), InputError);
  EXPECT_THROW(Scale::linear(0, std::nan("")), InputError);
  EXPECT_THROW(Scale::linear(0, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(Scale::logarithmic(0, 1), InputError);
  EXPECT_THROW(Scale::symmetric_logarithmic(1, 0), InputError);
  EXPECT_THROW(Scale::symmetric_logarithmic(-1, 1), InputError);
}

TEST(Scale, AroundHoldsWhatCanBeShown) {
  constexpr std::array values = {4.0, std::numeric_limits<double>::quiet_NaN(), -2.0, 0.5,
                                 std::numeric_limits<double>::infinity()};
  const Scale linear = Scale::around(values, ScaleKind::linear, 0.5);
  EXPECT_DOUBLE_EQ(linear.first(), -5);
  EXPECT_DOUBLE_EQ(linear.last(), 7);
  const Scale logarithmic = Scale::around(values, ScaleKind::logarithmic, 1);
  EXPECT_DOUBLE_EQ(logarithmic.first(), 0.5 / 8);
  EXPECT_DOUBLE_EQ(logarithmic.last(), 32);
}

TEST(Scale, AroundNothingOrOneValueIsAScaleStill) {
  EXPECT_EQ(Scale::around({}, ScaleKind::linear).last(), 1);
  EXPECT_EQ(Scale::around({}, ScaleKind::logarithmic).last(), 10);
  for (const double value : {0.0, -5.0, 3.0}) {
    const Scale scale = Scale::around(std::array{value}, ScaleKind::linear);
    EXPECT_LT(scale.first(), value);
    EXPECT_GT(scale.last(), value);
  }
  EXPECT_DOUBLE_EQ(Scale::around(std::array{3.0}, ScaleKind::logarithmic).position(3), 0.5);
}

TEST(Ticks, LinearOnesStepByOneTwoOrFive) {
  const auto ticks = [](double first, double last, std::size_t at_most) {
    return labels(Scale::linear(first, last).ticks(TickFormat::number, at_most));
  };
  EXPECT_EQ(ticks(0, 1, 6), (Labels{"0", "0.2", "0.4", "0.6", "0.8", "1"}));
  EXPECT_EQ(ticks(-0.3, 0.3, 4), (Labels{"−0.2", "0", "0.2"}));
  EXPECT_EQ(ticks(-3, 62, 7), (Labels{"0", "10", "20", "30", "40", "50", "60"}));
  EXPECT_EQ(ticks(0, 260000, 3), (Labels{"0", "10⁵", "2·10⁵"}));
  EXPECT_EQ(ticks(0, 0.0005, 5), (Labels{"0", "2·10⁻⁴", "4·10⁻⁴"}));
}

TEST(Ticks, LogarithmicOnesAreDecadesWithAsMuchBetweenAsThereIsRoom) {
  const auto ticks = [](double first, double last, std::size_t at_most) {
    return labels(Scale::logarithmic(first, last).ticks(TickFormat::number, at_most));
  };
  EXPECT_EQ(ticks(0.01, 1, 8), (Labels{"0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"}));
  EXPECT_EQ(ticks(0.01, 1, 6), (Labels{"0.01", "0.03", "0.1", "0.3", "1"}));
  EXPECT_EQ(ticks(0.01, 1, 4), (Labels{"0.01", "0.1", "1"}));
  EXPECT_EQ(ticks(1e-8, 1, 5), (Labels{"10⁻⁸", "10⁻⁶", "10⁻⁴", "0.01", "1"}));
  // Too narrow for decades: as if linear.
  EXPECT_EQ(ticks(1 / 1.5, 1.5, 5), (Labels{"0.8", "1", "1.2", "1.4"}));
}

TEST(Ticks, MinorOnesFillTheDecades) {
  const auto ticks = Scale::logarithmic(0.1, 10).ticks(TickFormat::number, 4);
  ASSERT_EQ(ticks.size(), 19u);
  for (std::size_t i = 1; i < ticks.size(); ++i)
    EXPECT_LT(ticks[i - 1].value, ticks[i].value);
  EXPECT_EQ(labels(ticks), (Labels{"0.1", "1", "10"}));
  EXPECT_NEAR(ticks[1].value, 0.2, 1e-15);
}

TEST(Ticks, DurationsAreRoundInTheirOwnUnits) {
  const auto ticks = [](double first, double last, std::size_t at_most) {
    return labels(Scale::logarithmic(first, last).ticks(TickFormat::duration, at_most));
  };
  EXPECT_EQ(ticks(0.5, 40000, 8), (Labels{"1 s", "10 s", "1 min", "10 min", "1 h", "10 h"}));
  EXPECT_EQ(ticks(0.5, 40000, 4), (Labels{"1 s", "1 min", "1 h"}));
  EXPECT_EQ(ticks(0.004, 2, 8), (Labels{"10 ms", "100 ms", "1 s"}));
  EXPECT_EQ(ticks(80000, 2e7, 9), (Labels{"1 day", "2 days", "5 days", "10 days", "100 days"}));
  EXPECT_EQ(ticks(2e-5, 2e-3, 3), (Labels{"100 µs", "1 ms"}));
}

TEST(Ticks, SymmetricOnesHaveZeroInTheMiddle) {
  const Scale scale = Scale::symmetric_logarithmic(20, 0.01);
  EXPECT_EQ(labels(scale.ticks(TickFormat::number, 9)),
            (Labels{"−10", "−1", "−0.1", "−0.01", "0", "0.01", "0.1", "1", "10"}));
  EXPECT_EQ(labels(scale.ticks(TickFormat::number, 5)), (Labels{"−10", "−0.1", "0", "0.1", "10"}));
}

TEST(Ticks, StayInRangeAndWithinTheNumberAskedFor) {
  for (const double ratio : {1.001, 1.3, 3.0, 40.0, 1e4, 1e9, 1e30})
    for (const std::size_t at_most : {2, 3, 5, 10})
      for (const TickFormat format :
           {TickFormat::number, TickFormat::percent, TickFormat::duration})
        for (const Scale& scale :
             {Scale::logarithmic(0.7, 0.7 * ratio), Scale::linear(0.7, 0.7 * ratio),
              Scale::symmetric_logarithmic(ratio, 1)}) {
          const auto ticks = scale.ticks(format, at_most);
          // The smallest useful symmetric set is three: both ends and the middle.
          EXPECT_LE(labels(ticks).size(), std::max<std::size_t>(at_most, 3)) << ratio;
          for (const Tick& tick : ticks) {
            EXPECT_GT(scale.position(tick.value), -1e-6) << ratio;
            EXPECT_LT(scale.position(tick.value), 1 + 1e-6) << ratio;
          }
        }
}

TEST(FormatValue, WritesPowersPercentAndDurations) {
  EXPECT_EQ(format_value(0), "0");
  EXPECT_EQ(format_value(-0.0), "0");
  EXPECT_EQ(format_value(-1.5), "−1.5");
  EXPECT_EQ(format_value(0.001), "0.001");
  EXPECT_EQ(format_value(2.5e-7), "2.5·10⁻⁷");
  EXPECT_EQ(format_value(-1e12), "−10¹²");
  EXPECT_EQ(format_value(0.005, TickFormat::percent), "0.5 %");
  EXPECT_EQ(format_value(90, TickFormat::duration), "1.5 min");
  EXPECT_EQ(format_value(172800, TickFormat::duration), "2 days");
}

TEST(ColorScale, NanHasItsOwnColour) {
  ColorScale colors{Scale::linear(0, 2), &ColorMap::viridis(), ""};
  EXPECT_EQ(colors.at(1), ColorMap::viridis().at(0.5));
  EXPECT_EQ(colors.at(5), ColorMap::viridis().at(1));
  EXPECT_EQ(colors.at(std::nan("")), missing);
  colors.no_value = white;
  EXPECT_EQ(colors.at(std::nan("")), white);
}

}  // namespace
}  // namespace ltc::picture
