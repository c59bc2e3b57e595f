// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/validation_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "brdf/lobe_model.h"
#include "core/parallel.h"
#include "judge/matrix_invariants.h"
#include "render/missing_albedo.h"
#include "render/sphere_picture.h"
#include "report/lobe_picture.h"
#include "report/table_map.h"
#include "table/entry_text.h"
#include "table/lookup.h"

namespace ltc {
namespace {

using picture::ScaleKind;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t lobe_side = 200;  // pixels that a lobe's density is computed for
constexpr int lobe_width = 1400;        // of its picture

std::vector<double> of_entries(const Table& table, auto&& value) {
  std::vector<double> values(table.grid.size(), nan);
  for (std::size_t flat = 0; flat < values.size(); ++flat)
    if (has_values(table.status[flat]))
      values[flat] = value(flat);
  return values;
}

bool any_number(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// A map with a scale about the values; the largest one ringed if `mark`.
NamedPicture map_of(const Validation& validation, const std::vector<double>& values,
                    const std::string& title, const std::string& unit, ScaleKind kind, bool mark) {
  const Grid& grid = validation.table.grid;
  const Statistics figures = statistics_of(values);
  picture::ColorScale colors{.scale = picture::Scale::around(values, kind, 0), .title = unit};
  picture::TiledMap map = table_map(grid, values, colors);
  map.words.title = title;
  const std::string caption =
      fmt::format("Mean {:.4g}, 95th percentile {:.4g}, largest {:.4g} at {}", figures.mean,
                  figures.p95, figures.largest, entry_text(grid, figures.largest_index));
  if (mark)
    map.marks = {mark_of(grid, figures.largest_index)};
  return {title, caption + " (" + lobe_text(grid, figures.largest_index) + ").",
          picture::render(map)};
}

struct LobeToDraw {
  Lobe lobe;
  LtcLobe ltc;
  std::string title, words;
  std::string command;  // that looks into it
};

std::vector<LobeToDraw> worst_lobes(const Validation& validation, std::size_t most) {
  const QualityReport& quality = validation.quality.value();
  std::vector<LobeToDraw> lobes;
  for (const std::size_t i : quality.worst_queries) {
    if (lobes.size() == most)
      break;
    const QueryFloor& floor = quality.floors[i];
    lobes.push_back(
        {floor.lobe, look_up(validation.table, floor.lobe).ltc(),
         fmt::format("Query {}: {:.3f} of the lobe's spread, floor {:.3f}", i,
                     quality.queries[i].relative_loss, floor.relative_loss),
         fmt::format("LTC as the table's look-up gives it; error under area lights {:.4f}, floor "
                     "{:.4f}",
                     quality.queries[i].area_light.mean_absolute, floor.area_light.mean_absolute),
         validation.query_command(floor.lobe)});
  }
  return lobes;
}

std::vector<LobeToDraw> failing_entries(const Validation& validation, std::size_t most) {
  const Table& table = validation.table;
  std::vector<std::size_t> drawn;
  std::vector<LobeToDraw> lobes;
  for (const InvariantResult& result : validation.invariants) {
    if (result.passed || result.entries.empty() || lobes.size() == most)
      continue;
    const std::size_t flat = result.entries.front();
    if (std::find(drawn.begin(), drawn.end(), flat) != drawn.end())
      continue;
    drawn.push_back(flat);
    lobes.push_back({table.grid.lobe(flat), table.ltc_at(flat),
                     fmt::format("Entry {} fails: {}", entry_text(table.grid, flat), result.name),
                     result.message, validation.entry_command(flat)});
  }
  return lobes;
}

// A mean over each band, as a level line across it.
picture::Series levels(const char* name, const Bands& bands, double Band::*mean,
                       picture::Color color, std::vector<double> dashes = {}) {
  picture::Series series{name, {}, color, picture::Marker::none, 4, std::move(dashes)};
  const double end = bands.unit.empty() ? 1 : 90;  // of a share, of an angle
  for (const Band& band : bands.bands) {
    const double last = std::min(band.last, std::max(end, band.first));
    series.points.push_back({band.first, band.*mean});
    series.points.push_back({last, band.*mean});
  }
  return series;
}

// The means in words: beside the lines, where table and floor are near each other, none could tell
// which number is whose.
std::string levels_text(const char* name, const Bands& bands, double Band::*mean, int decimals) {
  std::string text = name;
  for (const Band& band : bands.bands)
    text += std::isfinite(band.*mean) ? fmt::format("  {:.{}f}", band.*mean, decimals) : "  –";
  return text;
}

picture::Chart band_chart(const char* what, const Bands& bands, double Band::*table,
                          double Band::*floor, int decimals) {
  picture::Chart chart;
  chart.words.title = fmt::format("{} by {}", what, bands.parameter);
  chart.x.title = bands.parameter + (bands.unit.empty() ? "" : fmt::format(" ({})", bands.unit));
  chart.series = {levels("floor", bands, floor, picture::faint_ink, {12, 8}),
                  levels("table", bands, table, picture::series_color(0))};
  chart.words.lines_below = {levels_text("table", bands, table, decimals),
                             levels_text("floor", bands, floor, decimals)};
  double largest = 0;
  for (const picture::Series& series : chart.series)
    for (const picture::ChartPoint& point : series.points)
      if (std::isfinite(point.y))
        largest = std::max(largest, point.y);
  chart.y.scale = picture::Scale::linear(0, largest > 0 ? 1.15 * largest : 1);
  return chart;
}

}  // namespace

std::vector<picture::Chart> band_charts(const QualityReport& quality) {
  std::vector<picture::Chart> charts;
  for (const Bands& bands : quality.bands)
    if (!bands.bands.empty()) {
      charts.push_back(
          band_chart("Loss between nodes", bands, &Band::relative_loss, &Band::floor_loss, 3));
      charts.push_back(band_chart("Error under area lights", bands, &Band::area_light_error,
                                  &Band::floor_area_light_error, 4));
    }
  return charts;
}

std::vector<NamedPicture> table_pictures(const Validation& validation) {
  const Table& table = validation.table;
  std::vector<NamedPicture> pictures;
  const auto add = [&](const std::vector<double>& values, const char* title, const char* unit,
                       ScaleKind kind, bool mark) {
    if (any_number(values))
      pictures.push_back(map_of(validation, values, title, unit, kind, mark));
  };
  add(validation.quality.value().node_losses, "Loss at the nodes",
      "held-out loss / spread of the lobe", ScaleKind::logarithmic, true);
  add(of_entries(table, [&](std::size_t flat) { return condition_number(table.matrix_at(flat)); }),
      "Condition number of M", "largest / smallest singular value", ScaleKind::logarithmic, true);
  add(of_entries(table, [&](std::size_t flat) { return table.amplitude[flat]; }), "Amplitude",
      "light reflected with F = 1", ScaleKind::linear, false);
  add(of_entries(table, [&](std::size_t flat) { return table.fresnel[flat]; }), "Fresnel term",
      "light reflected, weighted by (1 − v·h)⁵", ScaleKind::linear, false);
  return pictures;
}

std::vector<NamedPicture> lobe_pictures(const Validation& validation, std::size_t lobes,
                                        const RunContext& run) {
  std::vector<LobeToDraw> to_draw = failing_entries(validation, lobes);
  for (const LobeToDraw& lobe : worst_lobes(validation, lobes))
    to_draw.push_back(lobe);
  std::vector<std::optional<picture::Canvas>> canvases(to_draw.size());
  parallel_for_each("draw lobes", to_draw.size(), run, [&](std::size_t i) {
    const LobeToDraw& lobe = to_draw[i];
    picture::Words words{lobe.title, lobe_caption(lobe.lobe), {lobe.words}};
    canvases[i] = render_lobe(
        lobe_panels(lobe.lobe, {{lobe.ltc.creases.empty() ? "LTC" : "folded LTC", lobe.ltc}}, words,
                    lobe_side),
        picture::Chart{}, lobe_width);
  });
  std::vector<NamedPicture> pictures;
  for (std::size_t i = 0; i < to_draw.size(); ++i)
    pictures.push_back({to_draw[i].title, to_draw[i].command, std::move(*canvases[i])});
  return pictures;
}

NamedPicture sphere_picture(const Validation& validation, const PageSettings& settings,
                            const RunContext& run) {
  Table table = validation.table;
  fill_missing_albedo(table);
  const Table* const pointer = &table;
  SphereSettings sphere;
  sphere.size = settings.sphere_size;
  sphere.samples = settings.sphere_samples;
  SpherePicture content;
  content.title = "Spheres under a rectangular light";
  content.tables = {"LTC"};
  content.caption = {
      fmt::format("{} by multiple importance sampling, {} samples a pixel; errors "
                  "are in units of the light's radiance.",
                  table.grid.model->label(), sphere.samples)};
  content.reference = table.grid.model->label();
  for (const SphereMaterial& material : usual_materials(*table.grid.model))
    content.rows.push_back(
        {material,
         render_sphere({&pointer, 1}, material, sphere,
                       fmt::format("render {}, {}", material.alpha_x, material.alpha_y), run)});
  return {content.title, "The materials of figure 14 of Aakash et al. 2022.", draw(content)};
}

}  // namespace ltc
