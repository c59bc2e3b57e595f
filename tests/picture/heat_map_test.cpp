// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tiled maps: every cell in its colour and place, whatever the sizes.
#include "picture/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "picture/png.h"
#include "picture/samples.h"

namespace ltc::picture {
namespace {

// Pixels have 8 bits a channel.
void expect_color(const Color& pixel, const Color& color) {
  EXPECT_NEAR(pixel.red, color.red, 0.5 / 255 + 1e-9);
  EXPECT_NEAR(pixel.green, color.green, 0.5 / 255 + 1e-9);
  EXPECT_NEAR(pixel.blue, color.blue, 0.5 / 255 + 1e-9);
}

Color center_of(const Canvas& canvas, const Box& box) {
  return canvas.pixel(static_cast<int>(box.center().x), static_cast<int>(box.center().y));
}

TEST(TiledMap, EveryCellHasTheColourOfItsValue) {
  for (const std::array<std::size_t, 4>& sizes :
       {std::array<std::size_t, 4>{8, 8, 8, 8}, {2, 3, 5, 4}, {2, 2, 2, 2}}) {
    TiledMap map = test::ratio_map(sizes);
    map.marks.clear();
    const TiledMapLayout layout = lay_out(map);
    const Canvas canvas = render(map);
    std::size_t next = 0;
    for (std::size_t a = 0; a < sizes[0]; ++a)
      for (std::size_t l = 0; l < sizes[1]; ++l)
        for (std::size_t t = 0; t < sizes[2]; ++t)
          for (std::size_t p = 0; p < sizes[3]; ++p) {
            const float value = map.values[next++];
            if (!std::isnan(value))
              expect_color(center_of(canvas, layout.cell_box({a, l, t, p})), map.colors.at(value));
          }
  }
}

TEST(TiledMap, CellsWithoutAValueAreGreyAndHatched) {
  TiledMap map = test::ratio_map();
  map.marks.clear();
  ASSERT_TRUE(std::isnan(map.values[0]));
  const Box cell = lay_out(map).cell_box({0, 0, 0, 0});
  const Canvas canvas = render(map);
  double darkest = 1, lightest = 0;
  for (int y = static_cast<int>(cell.top) + 1; y < cell.bottom() - 1; ++y)
    for (int x = static_cast<int>(cell.left) + 1; x < cell.right() - 1; ++x) {
      const Color color = canvas.pixel(x, y);
      EXPECT_NEAR(color.red, color.blue, 0.06) << "grey";
      darkest = std::min(darkest, color.red);
      lightest = std::max(lightest, color.red);
    }
  EXPECT_NEAR(lightest, missing.red, 0.01);
  EXPECT_LT(darkest, missing.red - 0.1);
  // And the key says what it means: without such a cell, that line is white.
  const auto is_written = [](const TiledMap& drawn) {
    const Canvas picture = render(drawn);
    const Box key = lay_out(drawn).key;
    const double top = key.top + 3 * line_spacing * drawn.font_size;
    for (double y = top; y < key.bottom(); ++y)
      for (double x = key.left; x < key.right(); ++x)
        if (picture.pixel(static_cast<int>(x), static_cast<int>(y)).red < 0.5)
          return true;
    return false;
  };
  EXPECT_TRUE(is_written(map));
  std::replace_if(
      map.values.begin(), map.values.end(), [](float value) { return std::isnan(value); }, 1.0f);
  EXPECT_FALSE(is_written(map));
}

TEST(TiledMap, MarksRingTheirCellAndLeaveItVisible) {
  const TiledMap map = test::ratio_map();
  const TiledMapLayout layout = lay_out(map);
  const Canvas canvas = render(map);
  const CellMark& mark = map.marks[0];
  const Box cell = layout.cell_box(mark.index);
  expect_color(center_of(canvas, cell), map.colors.at(1.93));
  const Color ring = canvas.pixel(static_cast<int>(cell.center().x),
                                  static_cast<int>(cell.center().y - 0.75 * layout.cell));
  // The ring is 2.2 pixels wide and antialiased.
  EXPECT_LT(lightness(ring), lightness(ink) + 0.05);
}

TEST(TiledMap, TilesDoNotTouchAndTheLegendStandsBeside) {
  for (const std::array<std::size_t, 4>& sizes : {std::array<std::size_t, 4>{8, 8, 8, 8},
                                                  {2, 3, 5, 4},
                                                  {16, 16, 16, 16},
                                                  {1, 1, 8, 8},
                                                  {32, 2, 8, 8}}) {
    TiledMap map = test::ratio_map({2, 2, 2, 2});
    map.marks.clear();
    map.tile_rows = {sizes[0], "α"};
    map.tile_columns = {sizes[1], "λ"};
    map.rows = {sizes[2], "θ"};
    map.columns = {sizes[3], "φ"};
    map.values.assign(sizes[0] * sizes[1] * sizes[2] * sizes[3], 1);
    const TiledMapLayout layout = lay_out(map);
    const Box picture{0, 0, 1.0 * layout.width, 1.0 * layout.height};
    for (const Box& box : {layout.map, layout.bar, layout.key})
      EXPECT_TRUE(picture.contains(box));
    EXPECT_FALSE(layout.map.overlaps(layout.bar));
    EXPECT_FALSE(layout.map.overlaps(layout.key));
    EXPECT_FALSE(layout.bar.overlaps(layout.key));
    const Box last = layout.tile_box(sizes[0] - 1, sizes[1] - 1);
    EXPECT_DOUBLE_EQ(last.right(), layout.map.right());
    EXPECT_DOUBLE_EQ(last.bottom(), layout.map.bottom());
    if (sizes[1] > 1) {
      EXPECT_GE(layout.tile_box(0, 1).left - layout.tile_box(0, 0).right(), 3);
    }
    const test::DecodedPng png = test::decode_png(render(map).png_bytes());
    EXPECT_EQ(png.width, layout.width);
    EXPECT_EQ(png.height, layout.height);
  }
}

TEST(TiledMap, WritesNothingOnTheEdgeOfThePicture) {
  const Canvas canvas = render(test::ratio_map());
  for (int x = 0; x < canvas.width(); ++x) {
    EXPECT_EQ(canvas.pixel(x, 2), white);
    EXPECT_EQ(canvas.pixel(x, canvas.height() - 3), white);
  }
  for (int y = 0; y < canvas.height(); ++y) {
    EXPECT_EQ(canvas.pixel(2, y), white);
    EXPECT_EQ(canvas.pixel(canvas.width() - 3, y), white);
  }
}

TEST(TiledMap, RefusesWhatDoesNotFitTogether) {
  TiledMap map = test::ratio_map();
  map.values.pop_back();
  EXPECT_THROW(render(map), InputError);
  map = test::ratio_map();
  map.rows.labels.pop_back();
  EXPECT_THROW(render(map), InputError);
  map = test::ratio_map();
  map.marks[0].index[2] = 8;
  EXPECT_THROW(render(map), InputError);
  map = test::ratio_map();
  map.columns = {};
  map.values.clear();
  EXPECT_THROW(render(map), InputError);
}

TEST(RatioColors, AreWhiteAtOneAndMirrorRatios) {
  const ColorScale colors = ratio_colors(4, "");
  EXPECT_EQ(colors.at(1), ColorMap::diverging().at(0.5));
  EXPECT_NEAR(colors.scale.position(2), 1 - colors.scale.position(0.5), 1e-15);
  EXPECT_THROW(ratio_colors(1, ""), InputError);
  EXPECT_THROW(ratio_colors(std::nan(""), ""), InputError);
}

TEST(TiledMap, EqualMapsGiveEqualBytes) {
  EXPECT_EQ(render(test::ratio_map({2, 3, 4, 5})).png_bytes(),
            render(test::ratio_map({2, 3, 4, 5})).png_bytes());
}

}  // namespace
}  // namespace ltc::picture
