// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Charts: points, ticks and labels where they belong; degenerate charts; equal bytes.
#include "picture/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "picture/png.h"
#include "picture/samples.h"

namespace ltc::picture {
namespace {

constexpr int width = 1600, height = 1000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

ChartLayout layout_of(const Chart& chart) {
  const Canvas canvas(width, height);
  return lay_out(chart, canvas, canvas.area().inset(chart.font_size));
}

Color at(const Canvas& canvas, Point point) {
  return canvas.pixel(static_cast<int>(point.x), static_cast<int>(point.y));
}

TEST(ParetoFront, KeepsWhatNothingBeats) {
  const auto front = pareto_front(std::vector<ChartPoint>{
      {3, 1}, {1, 3, "a"}, {2, 2}, {2, 4}, {4, 1}, {nan, 0}, {2.5, 2}, {1, 5}});
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].x, 1);
  EXPECT_EQ(front[0].y, 3);
  EXPECT_TRUE(front[0].label.empty());
  EXPECT_EQ(front[1].x, 2);
  EXPECT_EQ(front[1].y, 2);
  EXPECT_EQ(front[2].x, 3);
  EXPECT_EQ(front[2].y, 1);
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Chart, MarkersHaveTheirColourAtTheirPoint) {
  const Chart chart = test::frontier_chart();
  const ChartLayout layout = layout_of(chart);
  const Canvas canvas = render(chart, width, height);
  for (const std::size_t series : {2u, 3u})
    for (const ChartPoint& point : chart.series[series].points)
      EXPECT_EQ(at(canvas, layout.at(point.x, point.y)), series_color(series - 1));
}

TEST(Chart, PointsStandWhereTheLogarithmSays) {
  Chart chart;
  chart.x = {"x", ScaleKind::logarithmic, TickFormat::number, Scale::logarithmic(1, 100)};
  chart.y = {"y", ScaleKind::linear, TickFormat::number, Scale::linear(0, 4)};
  const ChartLayout layout = layout_of(chart);
  EXPECT_DOUBLE_EQ(layout.at(10, 1).x, layout.plot.center().x);
  EXPECT_DOUBLE_EQ(layout.at(10, 1).y, layout.plot.bottom() - layout.plot.height / 4);
  EXPECT_FALSE(std::isfinite(layout.at(-1, 1).x));
}

TEST(Chart, FrontierHasTimesOnItsAxisAndEveryLabel) {
  const ChartLayout layout = layout_of(test::frontier_chart());
  std::vector<std::string> times;
  for (const Tick& tick : layout.x_ticks)
    times.push_back(tick.label);
  EXPECT_EQ(times, (std::vector<std::string>{"1 s", "10 s", "1 min", "10 min", "1 h", "10 h"}));
  EXPECT_EQ(layout.labels.size(), 12u);
  EXPECT_EQ(layout.labels_without_room, 0u);
  for (std::size_t i = 0; i < layout.labels.size(); ++i) {
    const Box& box = layout.labels[i].place.box;
    EXPECT_TRUE(layout.plot.contains(box)) << layout.labels[i].text;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(box.overlaps(layout.labels[j].place.box)) << layout.labels[i].text;
  }
}

TEST(Chart, TickLabelsDoNotTouch) {
  const Canvas ruler(1, 1);
  for (const Chart& chart : {test::frontier_chart(), test::loss_chart()}) {
    const ChartLayout layout = layout_of(chart);
    double previous = 0;
    for (const Tick& tick : layout.x_ticks) {
      if (tick.label.empty())
        continue;
      const double half = ruler.text_width(tick.label, {.size = chart.font_size}) / 2;
      const double x = layout.plot.left + layout.x.position(tick.value) * layout.plot.width;
      EXPECT_GT(x - half, previous) << tick.label;
      previous = x + half;
    }
    EXPECT_LT(previous, width);
  }
}

TEST(Chart, NothingIsDrawnOnTheEdgeOfThePicture) {
  const Canvas canvas = render(test::frontier_chart(), width, height);
  for (int x = 0; x < width; ++x) {
    EXPECT_EQ(canvas.pixel(x, 2), white);
    EXPECT_EQ(canvas.pixel(x, height - 3), white);
  }
  for (int y = 0; y < height; ++y) {
    EXPECT_EQ(canvas.pixel(2, y), white);
    EXPECT_EQ(canvas.pixel(width - 3, y), white);
  }
}

TEST(Chart, LinesStopWhereAPointIsMissing) {
  Chart chart;
  chart.x = {"x", ScaleKind::linear, TickFormat::number, Scale::linear(0, 4)};
  chart.y = {"y", ScaleKind::linear, TickFormat::number, Scale::linear(0, 4)};
  const Color blue = series_color(0);
  chart.series = {{"", {{0, 1.3}, {1, 1.3}, {2, nan}, {3, 1.3}, {4, 1.3}}, blue, Marker::none, 6}};
  const ChartLayout layout = layout_of(chart);
  const Canvas canvas = render(chart, width, height);
  EXPECT_EQ(at(canvas, layout.at(0.6, 1.3)), blue);
  EXPECT_EQ(at(canvas, layout.at(1.6, 1.3)), white);
  EXPECT_EQ(at(canvas, layout.at(3.6, 1.3)), blue);
}

TEST(Chart, LinesAreCutAtTheFrameAndMarkersOutsideLeftOut) {
  Chart chart;
  chart.x = {"x", ScaleKind::linear, TickFormat::number, Scale::linear(0, 1)};
  chart.y = {"y", ScaleKind::linear, TickFormat::number, Scale::linear(0, 1)};
  chart.series = {{"", {{0.5, 0.5}, {0.5, 1.04, "outside"}}, series_color(0), Marker::disc, 6}};
  const ChartLayout layout = layout_of(chart);
  EXPECT_TRUE(layout.labels.empty());
  const Canvas canvas = render(chart, width, height);
  EXPECT_EQ(at(canvas, layout.at(0.5, 0.95)), series_color(0));
  EXPECT_EQ(at(canvas, layout.at(0.5, 1.01)), white);
}

TEST(Chart, CountsTheLabelsItCouldNotPlace) {
  Chart chart;
  chart.series = {{"", {{0.5, 0.5, std::string(400, 'w')}}}};
  const ChartLayout layout = layout_of(chart);
  EXPECT_TRUE(layout.labels.empty());
  EXPECT_EQ(layout.labels_without_room, 1u);
}

TEST(Chart, DrawsWithoutPointsAndWithHopelessOnes) {
  Chart chart;
  chart.x.kind = ScaleKind::logarithmic;
  EXPECT_NO_THROW(render(chart));
  chart.series = {{"none", {{0, nan, "a"}, {-1, 2, "b"}, {INFINITY, 1, "c"}}}, {"one", {{5, 5}}}};
  chart.guides = {{Guide::Axis::x, -1, "nowhere"}};
  EXPECT_NO_THROW(render(chart));
  EXPECT_TRUE(layout_of(chart).labels.empty());
}

TEST(Chart, EqualChartsGiveEqualPngsOfTheStatedSize) {
  const std::string bytes = render(test::frontier_chart(), 800, 500).png_bytes();
  EXPECT_EQ(bytes, render(test::frontier_chart(), 800, 500).png_bytes());
  EXPECT_NE(bytes, render(test::loss_chart(), 800, 500).png_bytes());
  EXPECT_EQ(test::decode_png(bytes).width, 800);
  EXPECT_EQ(test::decode_png(bytes).height, 500);
}

}  // namespace
}  // namespace ltc::picture
