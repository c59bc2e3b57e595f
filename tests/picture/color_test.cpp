// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Colour maps: the published colours, lightness that tells the order, NaN and ends.
#include "picture/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace ltc::picture {
namespace {

TEST(ColorMap, ViridisIsThePublishedOne) {
  struct Published {
    int index;  // of 0 to 255
    Color color;
  };
  // Between the control points, which are the multiples of 15, and at the ends.
  constexpr Published published[] = {
      {0, {0.26700401, 0.00487433, 0.32941519}},   {23, {0.283072, 0.13089477, 0.44924127}},
      {40, {0.27059473, 0.21406899, 0.50705243}},  {64, {0.22973926, 0.32236127, 0.54570633}},
      {100, {0.1666171, 0.46370813, 0.55811913}},  {128, {0.12756771, 0.56694891, 0.55055551}},
      {191, {0.36074053, 0.78596419, 0.38781353}}, {200, {0.44013691, 0.81113836, 0.3409673}},
      {230, {0.74138803, 0.87344918, 0.14956101}}, {8, {0.2770184, 0.05034437, 0.37571452}},
      {157, {0.1466164, 0.67304968, 0.50893644}},  {247, {0.91624212, 0.89609127, 0.1007168}},
      {250, {0.94563626, 0.899815, 0.11283773}},   {255, {0.99324789, 0.90615657, 0.1439362}}};
  for (const auto& [index, color] : published) {
    const Color ours = ColorMap::viridis().at(index / 255.0);
    // The deviation that color.h states.
    EXPECT_NEAR(ours.red, color.red, 0.003) << index;
    EXPECT_NEAR(ours.green, color.green, 0.003) << index;
    EXPECT_NEAR(ours.blue, color.blue, 0.003) << index;
  }
}

TEST(ColorMap, ViridisGetsEverLighter) {
  for (int i = 0; i < 255; ++i)
    EXPECT_LT(lightness(ColorMap::viridis().at(i / 255.0)),
              lightness(ColorMap::viridis().at((i + 1) / 255.0)))
        << i;
}

TEST(ColorMap, DivergingIsLightestInTheMiddleAndEquallyDarkOnBothSides) {
  const ColorMap& map = ColorMap::diverging();
  for (int i = 0; i < 100; ++i) {
    const Color left = map.at(0.5 - i / 200.0), right = map.at(0.5 + i / 200.0);
    // Control points rounded to 8 bits are off by up to 0.0017.
    EXPECT_NEAR(lightness(left), lightness(right), 0.003) << i;
    EXPECT_GT(lightness(left), lightness(map.at(0.5 - (i + 1) / 200.0))) << i;
    if (i >= 10) {
      EXPECT_GT(left.blue, left.red) << i;
      EXPECT_GT(right.red, right.blue) << i;
    }
  }
  EXPECT_GT(lightness(map.at(0.5)), 0.95);
}

TEST(ColorMap, ClampsPositionsAndShowsNan) {
  const ColorMap& map = ColorMap::viridis();
  EXPECT_EQ(map.at(-1), map.at(0));
  EXPECT_EQ(map.at(7), map.at(1));
  EXPECT_EQ(map.at(-std::numeric_limits<double>::infinity()), map.at(0));
  EXPECT_EQ(map.at(std::numeric_limits<double>::infinity()), map.at(1));
  EXPECT_EQ(map.at(std::nan("")), missing);
}

TEST(ColorMap, RefusesTooFewControlPoints) {
  constexpr std::uint32_t two[] = {0x000000, 0xffffff};
  EXPECT_THROW(ColorMap{two}, InputError);
}

TEST(Lightness, OfBlackAndWhite) {
  // Oklab's published coefficients have ten digits.
  EXPECT_NEAR(lightness(Color::hex(0x000000)), 0, 1e-6);
  EXPECT_NEAR(lightness(white), 1, 1e-6);
}

}  // namespace
}  // namespace ltc::picture
