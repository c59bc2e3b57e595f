// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/lobe_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "brdf/lobe_model.h"
#include "core/angle.h"
#include "report/lobe_window_marks.h"

namespace ltc {
namespace {

using picture::Field;

double largest_value(const Field& field) {
  double largest = 0;
  for (const float value : field.values)
    if (value > largest)
      largest = value;
  return largest;
}

double mean_value(const Field& field) {
  double sum = 0;
  std::size_t count = 0;
  for (const float value : field.values)
    if (!std::isnan(value)) {
      sum += value;
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// The density above which all but a hundredth of what the field shows of a lobe lies.
double bulk_density(const Field& field) {
  std::vector<float> rising;
  for (const float value : field.values)
    if (value > 0)
      rising.push_back(value);
  std::sort(rising.begin(), rising.end());
  double total = 0, below = 0;
  for (const float value : rising)
    total += value;
  for (const float value : rising)
    if ((below += value) > 0.01 * total)
      return value;
  return std::numeric_limits<double>::infinity();
}

Field difference_of(const Field& ltc, const Field& ggx) {
  Field difference = ltc;
  for (std::size_t i = 0; i < difference.values.size(); ++i)
    difference.values[i] -= ggx.values[i];
  return difference;
}

// Differences are seen against the peak: those of a perfect fit, which are rounding and the noise
// of the samples, must not fill the scale.
picture::Scale difference_scale(const Field& difference, const picture::Scale& densities) {
  constexpr double least_share = 0.05;
  double largest = 0;
  for (const float value : difference.values)
    if (std::abs(value) > largest)
      largest = std::abs(value);
  const double bound = std::max(largest, least_share * densities.last());
  if (densities.kind() == picture::ScaleKind::linear)
    return picture::Scale::linear(-bound, bound);
  return picture::Scale::symmetric_logarithmic(bound, bound / 50);
}

}  // namespace

picture::Scale density_scale(const Field& ggx, std::span<const Field> beside) {
  double peak = largest_value(ggx);
  for (const Field& field : beside)
    peak = std::max(peak, largest_value(field));
  if (!(peak > 0))
    return picture::Scale::linear(0, 1);
  if (peak < sharp_peak * mean_value(ggx))
    return picture::Scale::linear(0, peak);
  double bulk = bulk_density(ggx);
  for (const Field& field : beside)
    bulk = std::min(bulk, bulk_density(field));
  return picture::Scale::logarithmic(std::clamp(bulk, 1e-5 * peak, 0.03 * peak), peak);
}

std::string lobe_caption(const Lobe& lobe) {
  return fmt::format("alpha_x {:.4g}, alpha_y {:.4g}, θ {:.4g}°, φ {:.4g}°", lobe.alpha_x,
                     lobe.alpha_y, lobe.theta_radians / radians_per_degree,
                     lobe.phi_radians / radians_per_degree);
}

picture::PanelRow lobe_panels(const Lobe& lobe, const Eigen::Matrix3d& matrix, picture::Words words,
                              std::size_t side) {
  return lobe_panels(lobe, {{"LTC", {matrix}}}, std::move(words), side);
}

picture::PanelRow lobe_panels(const Lobe& lobe, const std::vector<NamedLobe>& beside,
                              picture::Words words, std::size_t side) {
  std::vector<LtcLobe> shown;
  for (const NamedLobe& named : beside)
    shown.push_back(named.lobe);
  const LobeWindow window = choose_window(lobe, shown);
  const Field ggx = lobe_density(lobe, window, side);
  std::vector<Field> fields;
  for (const LtcLobe& one : shown)
    fields.push_back(ltc_density(one, lobe, window, side));
  const Field difference = difference_of(fields.back(), ggx);
  const picture::Scale scale = density_scale(ggx, fields);
  const bool logarithmic = scale.kind() == picture::ScaleKind::logarithmic;
  picture::PanelRow row;
  row.words = std::move(words);
  row.words.lines_below.push_back(window_words(window));
  const std::string model(lobe.model->label());
  row.panels = {{model, ggx, 0}};
  for (std::size_t i = 0; i < fields.size(); ++i)
    row.panels.push_back({beside[i].name, fields[i], 0});
  row.panels.push_back({beside.back().name + " − " + model, difference, 1});
  row.scales = {{.scale = scale, .title = "density, 1/sr"},
                {.scale = difference_scale(difference, scale),
                 .map = &picture::ColorMap::diverging(),
                 .title = "difference, 1/sr"}};
  for (picture::ColorScale& colors : row.scales) {
    if (logarithmic)
      colors.title += " (logarithmic)";
    colors.no_value = picture::white;
  }
  row.overlays = window_marks(window, lobe);
  return row;
}

picture::Canvas render_lobe(const picture::PanelRow& panels, const picture::Chart& chart,
                            int width) {
  if (chart.series.empty())
    return picture::render(panels, width);
  const double edge = panels.font_size;
  const double chart_height = 22 * chart.font_size;
  const double row_height = picture::height_for_width(panels, width - 2 * edge);
  picture::Canvas canvas(width, static_cast<int>(std::ceil(row_height + chart_height + 3 * edge)));
  picture::Box box = canvas.area().inset(edge);
  picture::draw(canvas, box.take_top(row_height), panels);
  box.take_top(edge);
  picture::draw(canvas, box, chart);
  return canvas;
}

}  // namespace ltc
