// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/samples.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace ltc::picture::test {
namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

// A value for each pixel of the unit disc, NaN outside.
template <typename Value>
Field disc_field(std::size_t side, const Value& value) {
  Field field{side, side, std::vector<float>(side * side, no_value)};
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column) {
      const double x = (2 * static_cast<double>(column) + 1) / static_cast<double>(side) - 1;
      const double y = 1 - (2 * static_cast<double>(row) + 1) / static_cast<double>(side);
      if (x * x + y * y <= 1)
        field.values[row * side + column] = static_cast<float>(value(x, y));
    }
  return field;
}

double lobe(double x, double y, double center, double width_x, double width_y) {
  const double u = (x - center) / width_x, v = y / width_y;
  return 20 / std::pow(1 + u * u + v * v, 2);
}

Overlay ring(double theta_degrees) {
  Overlay overlay;
  const double radius = std::sin(theta_degrees * std::numbers::pi / 180) / 2;
  for (int i = 0; i <= 120; ++i) {
    const double angle = 2 * std::numbers::pi * (i / 120.0 - 0.125);
    overlay.points.push_back({0.5 + radius * std::cos(angle), 0.5 - radius * std::sin(angle)});
  }
  overlay.label = theta_degrees < 90 ? fmt::format("{:.0f}°", theta_degrees) : "";
  return overlay;
}

}  // namespace

Chart frontier_chart() {
  Chart chart;
  chart.words = {"Run time against error",
                 "Whole table of 8⁴ entries on two cores; held-out loss",
                 {"Lower left is better. SGD as published is extrapolated from 20 timed steps."}};
  chart.x = {"time for the table", ScaleKind::logarithmic, TickFormat::duration};
  chart.y = {"mean error over the best known", ScaleKind::logarithmic, TickFormat::percent};
  const std::vector<ChartPoint> gauss_newton{{0.35, 0.41, "128 × 8"},   {0.62, 0.163, "256 × 16"},
                                             {1.4, 0.068, "512 × 24"},  {1.9, 0.021, "default"},
                                             {3.2, 0.013, "1024 × 32"}, {8.7, 0.011, "2048 × 32"},
                                             {31, 0.0042, "reference"}, {3.5, 0.014, "two starts"}};
  const std::vector<ChartPoint> descent{
      {64, 0.12, "SGD 100"}, {420, 0.041, "SGD 1,000"}, {26000, 0.017, "SGD as published"}};
  const std::vector<ChartPoint> nelder_mead{{5400, 0.09, "Nelder–Mead, L3 (2016)"}};
  std::vector<ChartPoint> all = gauss_newton;
  all.insert(all.end(), descent.begin(), descent.end());
  all.insert(all.end(), nelder_mead.begin(), nelder_mead.end());
  chart.series = {
      {"frontier", pareto_front(all), Color::hex(0xb9bcc0), Marker::none, 6},
      {"Gauss–Newton", gauss_newton, series_color(0), Marker::disc},
      {"stochastic descent", descent, series_color(1), Marker::square},
      {"Nelder–Mead", nelder_mead, series_color(2), Marker::diamond},
  };
  chart.guides = {{Guide::Axis::y, 0.005, "goal: 0.5 %"}, {Guide::Axis::x, 3, "goal: 3 s"}};
  return chart;
}

Chart loss_chart() {
  Chart chart;
  chart.words = {"Loss against steps", "α = (0.04, 0.2), θ = 60°, φ = 30°", {}};
  chart.x = {"step"};
  chart.y = {"sliced-Wasserstein loss", ScaleKind::logarithmic};
  Series newton{"Gauss–Newton", {}, series_color(0), Marker::disc, 3};
  Series descent{"stochastic descent", {}, series_color(1), Marker::none, 3};
  for (int step = 0; step <= 60; ++step) {
    if (step <= 14)
      newton.points.push_back({1.0 * step, 0.004 + 0.3 * std::exp(-0.9 * step)});
    descent.points.push_back(
        {1.0 * step, 0.006 + 0.3 * std::exp(-0.08 * step) * (1 + 0.15 * std::sin(2.7 * step))});
  }
  newton.points.back().label = "0.004";
  chart.series = {descent, newton};
  return chart;
}

TiledMap ratio_map(const std::array<std::size_t, 4>& sizes) {
  TiledMap map{.colors = ratio_colors(1.5, "loss of A over loss of B")};
  map.words = {"A against B, lobe against lobe",
               "Ratio of the losses to GGX; blue: A is nearer, red: B is nearer",
               {"mean 0.981 · 95th percentile 1.02 · worst 1.93 at 5,2,6,3"}};
  map.tile_rows = {sizes[0], "α"};
  map.tile_columns = {sizes[1], "λ"};
  map.rows = {sizes[2], "θ"};
  map.columns = {sizes[3], "φ"};
  const auto label = [](MapAxis& axis, double last, const char* unit) {
    for (std::size_t i = 0; i < axis.size; ++i)
      axis.labels.push_back(fmt::format(
          "{:.3g}{}", last * static_cast<double>(i) / static_cast<double>(axis.size - 1), unit));
  };
  label(map.tile_rows, 1, "");
  label(map.tile_columns, 1, "");
  label(map.rows, 90, "°");
  label(map.columns, 90, "°");
  for (std::size_t a = 0; a < sizes[0]; ++a)
    for (std::size_t l = 0; l < sizes[1]; ++l)
      for (std::size_t t = 0; t < sizes[2]; ++t)
        for (std::size_t p = 0; p < sizes[3]; ++p)
          map.values.push_back(static_cast<float>(
              std::exp(0.25 * std::sin(0.7 * static_cast<double>(a + p)) *
                       std::cos(0.5 * static_cast<double>(l) - 0.4 * static_cast<double>(t)))));
  const auto at = [&](const std::array<std::size_t, 4>& i) -> float& {
    return map.values[((i[0] * sizes[1] + i[1]) * sizes[2] + i[2]) * sizes[3] + i[3]];
  };
  const std::array<std::size_t, 4> worst{sizes[0] - 1, 1, sizes[2] - 1, 1};
  at(worst) = 1.93f;
  at({0, 0, 0, 0}) = no_value;
  map.marks = {{worst, "worst"}, {{0, sizes[1] - 1, 1, sizes[3] - 1}, "2"}};
  return map;
}

PanelRow lobe_row() {
  constexpr std::size_t side = 200;
  const auto ggx = [](double x, double y) { return lobe(x, y, -0.6, 0.12, 0.3); };
  const auto ltc = [](double x, double y) { return lobe(x, y, -0.58, 0.13, 0.28); };
  PanelRow row;
  row.words = {"Entry 3,5,4,2",
               "alpha_x 0.04, alpha_y 0.20, θ 60.0°, φ 30.0°",
               {"loss 0.00412 (2.1 % of the lobe's spread 0.196), held out 0.00431",
                "amplitude 0.873, Fresnel 0.041, determinant 0.021, condition number 48"}};
  row.panels = {{"GGX", disc_field(side, ggx), 0},
                {"LTC", disc_field(side, ltc), 0},
                {"LTC − GGX",
                 disc_field(side, [&](double x, double y) { return ltc(x, y) - ggx(x, y); }), 1}};
  row.scales = {
      {.scale = Scale::logarithmic(0.01, 20), .title = "density, 1/sr"},
      {Scale::symmetric_logarithmic(5, 0.05), &ColorMap::diverging(), "difference, 1/sr"}};
  for (ColorScale& colors : row.scales) {
    colors.title += " (logarithmic)";
    colors.no_value = white;
  }
  for (const double theta_degrees : {30.0, 60.0, 90.0})
    row.overlays.push_back(ring(theta_degrees));
  return row;
}

}  // namespace ltc::picture::test
