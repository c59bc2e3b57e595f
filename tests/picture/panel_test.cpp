// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Rows of panels and colour bars: squares, shared colours, legends that match the pictures.
#include "picture/panel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "picture/color_bar.h"
#include "picture/samples.h"

namespace ltc::picture {
namespace {

constexpr int width = 1200;

PanelLayout layout_of(const PanelRow& row) {
  const double inner = width - 2 * row.font_size;
  return lay_out(row, {row.font_size, row.font_size, inner, height_for_width(row, inner)});
}

Color pixel(const Canvas& canvas, double x, double y) {
  return canvas.pixel(static_cast<int>(x), static_cast<int>(y));
}

void expect_near(const Color& a, const Color& b, double tolerance) {
  EXPECT_NEAR(a.red, b.red, tolerance);
  EXPECT_NEAR(a.green, b.green, tolerance);
  EXPECT_NEAR(a.blue, b.blue, tolerance);
}

TEST(PanelRow, PanelsAreEqualSquaresSideBySide) {
  const PanelLayout layout = layout_of(test::lobe_row());
  ASSERT_EQ(layout.panels.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(layout.panels[i].width, layout.panels[i].height);
    EXPECT_EQ(layout.panels[i].width, layout.panels[0].width);
    EXPECT_EQ(layout.panels[i].top, layout.panels[0].top);
    if (i > 0) {
      EXPECT_GT(layout.panels[i].left, layout.panels[i - 1].right());
    }
  }
  EXPECT_LE(layout.panels[2].right(), width - 20);
}

TEST(PanelRow, BarsSpanThePanelsThatShareTheirScale) {
  const PanelLayout layout = layout_of(test::lobe_row());
  ASSERT_EQ(layout.bars.size(), 2u);
  EXPECT_EQ(layout.bars[0].left, layout.panels[0].left);
  EXPECT_EQ(layout.bars[0].right(), layout.panels[1].right());
  EXPECT_EQ(layout.bars[1].left, layout.panels[2].left);
  EXPECT_GT(layout.bars[0].top, layout.panels[0].bottom());
}

TEST(PanelRow, PixelsHaveTheColoursOfTheirScale) {
  PanelRow row = test::lobe_row();
  row.overlays.clear();
  row.panels[0].field = {1, 1, {3}};
  row.panels[1].field = {2, 1, {0.1f, std::nanf("")}};
  row.panels[2].field = {1, 1, {-0.2f}};
  row.scales[0].no_value = Color::hex(0x123456);
  const PanelLayout layout = layout_of(row);
  const Canvas canvas = render(row, width);
  const auto at = [&](std::size_t panel, double u) {
    const Box& box = layout.panels[panel];
    return pixel(canvas, box.left + u * box.width, box.top + 0.4 * box.height);
  };
  // Rounding to 8 bits.
  expect_near(at(0, 0.5), row.scales[0].at(3), 0.002);
  expect_near(at(1, 0.1), row.scales[0].at(0.1), 0.002);
  expect_near(at(1, 0.9), Color::hex(0x123456), 0.002);
  expect_near(at(2, 0.5), row.scales[1].at(-0.2), 0.002);
}

TEST(PanelRow, OverlaysAreInFractionsOfThePanel) {
  PanelRow row = test::lobe_row();
  const Color red{1, 0, 0};
  row.overlays = {{{{0.25, 0.1}, {0.25, 0.9}}, {red, 5}}};
  const PanelLayout layout = layout_of(row);
  const Canvas canvas = render(row, width);
  for (const Box& box : layout.panels)
    EXPECT_EQ(pixel(canvas, box.left + 0.25 * box.width, box.center().y), red);
}

TEST(PanelRow, ShrinksIntoALowBox) {
  const PanelRow row = test::lobe_row();
  const double needed = height_for_width(row, 1000);
  const PanelLayout layout = lay_out(row, {0, 0, 1000, needed - 100});
  EXPECT_NEAR(layout.panels[0].height, lay_out(row, {0, 0, 1000, needed}).panels[0].height - 100,
              1);
}

TEST(PanelRow, RefusesNoPanelsAndScalesThatAreNot) {
  PanelRow row = test::lobe_row();
  row.panels[1].scale = 2;
  EXPECT_THROW(render(row), InputError);
  row.panels.clear();
  EXPECT_THROW(render(row), InputError);
}

TEST(PanelRow, EqualRowsGiveEqualBytes) {
  EXPECT_EQ(render(test::lobe_row(), 600).png_bytes(), render(test::lobe_row(), 600).png_bytes());
}

TEST(Beyond, SeesValuesOutsideAndNotThoseOnTheEnds) {
  const Scale scale = Scale::logarithmic(1, 10);
  const auto of = [&](float value) { return beyond(scale, std::array{5.0f, value}); };
  EXPECT_FALSE(of(1).below || of(1).above || of(10).below || of(10).above);
  EXPECT_TRUE(of(0.5f).below && !of(0.5f).above);
  EXPECT_TRUE(of(0).below);
  EXPECT_TRUE(of(11).above && !of(11).below);
  EXPECT_FALSE(of(std::nanf("")).below || of(std::nanf("")).above);
}

TEST(ColorBar, ShowsTheScaleFromEndToEnd) {
  const double f = 20;
  const ColorScale colors{Scale::linear(0, 1), &ColorMap::viridis(), "unit"};
  Canvas canvas(600, 600);
  draw_upright_bar(canvas, {20, 20, 120, 500}, colors, f);
  draw_lying_bar(canvas, {180, 20, 400, lying_bar_height(f)}, colors, f);
  // Bars start 0.9 font sizes within their box; a pixel of the ramp is 1/460 of it.
  for (const double position : {0.02, 0.3, 0.5, 0.98}) {
    expect_near(pixel(canvas, 32, 502 - position * 464), colors.at(position), 0.01);
    expect_near(pixel(canvas, 198 + position * 364, 60), colors.at(position), 0.01);
  }
  EXPECT_GE(140, 20 + upright_bar_width(canvas, colors, 500, f));
}

TEST(ColorBar, IsPointedWhereDataLieBeyond) {
  const ColorScale colors{Scale::linear(0, 1), &ColorMap::viridis(), ""};
  Canvas with(600, 100), without(600, 100);
  draw_lying_bar(with, {10, 10, 500, 80}, colors, 20, {.below = false, .above = true});
  draw_lying_bar(without, {10, 10, 500, 80}, colors, 20);
  const Point tip{10 + 500 - 12, 10 + 29 + 12};
  expect_near(pixel(with, tip.x, tip.y), colors.at(1), 0.01);
  EXPECT_EQ(pixel(without, tip.x, tip.y), white);
  EXPECT_EQ(pixel(with, 15, tip.y), white);
}

}  // namespace
}  // namespace ltc::picture
