// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/quantile.h"
#include "picture/color_bar.h"
#include "picture/text.h"

namespace ltc {
namespace {

using namespace picture;

constexpr double background = 0.02;  // behind the sphere, linear sRGB: the sphere is black there
constexpr double brightest = 0.9;    // what the brightest of GGX becomes, likewise
constexpr double least_side = 160;   // pixels of an image in the picture

// Sizes in units of the font size.
constexpr double margin = 1.2;
constexpr double gap = 0.7;
constexpr double table_gap = 1.4;  // before each table's columns
constexpr double label_width = 9.2;
constexpr double head_height = 1.9;

// Positions 0 to 1 as sRGB greys.
const ColorMap& greys() {
  static const ColorMap map = [] {
    std::vector<std::uint32_t> points;
    for (std::uint32_t grey = 0; grey < 256; ++grey)
      points.push_back(grey * 0x010101);
    return ColorMap(points);
  }();
  return map;
}

double encode_srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

// Radiance times the exposure before the background, as greys.
picture::Field as_seen(const picture::Field& radiance, const picture::Field& coverage,
                       double exposure) {
  picture::Field seen = radiance;
  for (std::size_t i = 0; i < seen.values.size(); ++i) {
    const double behind = (1 - static_cast<double>(coverage.values[i])) * background;
    if (!std::isnan(radiance.values[i]))
      seen.values[i] = static_cast<float>(encode_srgb(exposure * radiance.values[i] + behind));
  }
  return seen;
}

// The magnitude that all but the largest 0.2 % of the values keep below: a few pixels at a sharp
// edge shall not pale all the others. Zero if there are none.
double nearly_largest(std::vector<double> magnitudes) {
  std::sort(magnitudes.begin(), magnitudes.end());
  return magnitudes.empty() ? 0 : quantile(magnitudes, 0.998);
}

// The magnitudes of the pixels on the sphere that have a value.
void add_magnitudes(const picture::Field& field, const picture::Field& coverage,
                    std::vector<double>& magnitudes) {
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (coverage.values[i] > 0 && std::isfinite(field.values[i]))
      magnitudes.push_back(std::abs(field.values[i]));
}

// The next round number up: 1, 2 or 5 times a power of ten.
double rounded_up(double value) {
  constexpr double slack = 1e-6;  // of single precision
  constexpr double least = 1e-6;
  if (!(value > least))
    return least;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * decade * (1 + slack))
      return step * decade;
  return 10 * decade;
}

double exposure_of(const SphereImages& images) {
  std::vector<double> magnitudes;
  add_magnitudes(images.reference, images.coverage, magnitudes);
  const double largest = nearly_largest(std::move(magnitudes));
  return largest > 0 ? brightest / largest : 1;
}

ColorScale difference_colors(const SphereImages& images, const std::string& reference) {
  std::vector<double> magnitudes;
  for (std::size_t table = 0; table < images.ltc.size(); ++table)
    add_magnitudes(difference(images, table), images.coverage, magnitudes);
  const double bound = rounded_up(nearly_largest(std::move(magnitudes)));
  return {Scale::linear(-bound, bound), &ColorMap::diverging(), "LTC − " + reference};
}

class Painter {
 public:
  explicit Painter(const SpherePicture& content)
      : content_(content),
        side_(std::max(least_side, static_cast<double>(content.rows[0].images.reference.width))),
        font_(std::max(12.0, std::round(side_ / 17))),
        row_height_(std::max(side_, tallest_label())),
        canvas_(static_cast<int>(width()), static_cast<int>(height())) {}

  Canvas paint() {
    Box box = canvas_.area().inset(margin * font_);
    box = draw_words(canvas_, box, words(), font_);
    const Box heads = box.take_top(head_height * font_);
    draw_heads(heads.bottom() - 0.5 * font_);
    for (std::size_t row = 0; row < content_.rows.size(); ++row)
      draw_row(row, std::round(box.top + static_cast<double>(row) * (row_height_ + gap * font_)));
    return std::move(canvas_);
  }

 private:
  Words words() const { return {content_.title, "", content_.caption}; }
  double rows_height() const {
    const auto rows = static_cast<double>(content_.rows.size());
    return rows * row_height_ + (rows - 1) * gap * font_;
  }
  double left_of_reference() const { return std::round((margin + label_width) * font_); }
  double left_of_table(std::size_t table) const {
    const double pair = 2 * side_ + (gap + table_gap) * font_;
    return std::round(left_of_reference() + side_ + table_gap * font_ +
                      static_cast<double>(table) * pair);
  }
  double bar_left() const {
    return left_of_table(content_.tables.size()) - (table_gap - 1) * font_;
  }
  double bar_width() const { return 6.5 * font_; }
  double width() const { return std::ceil(bar_left() + bar_width() + margin * font_); }
  double height() const {
    const double around = -inside_words({0, 0, 0, 0}, words(), font_).height;
    return std::ceil(around + (head_height + 2 * margin) * font_ + rows_height());
  }

  void head(double left, double baseline, const std::string& text) {
    fitted_text(canvas_, {left + side_ / 2, baseline}, text,
                {.size = font_, .horizontal = HorizontalAnchor::center, .bold = true}, side_);
  }
  void draw_heads(double baseline) {
    head(left_of_reference(), baseline, content_.reference + ", sampled");
    for (std::size_t table = 0; table < content_.tables.size(); ++table) {
      head(left_of_table(table), baseline, content_.tables[table]);
      head(left_of_table(table) + side_ + gap * font_, baseline, "difference");
    }
  }

  void draw_row(std::size_t index, double top) {
    const SphereRow& row = content_.rows[index];
    draw_label(label_of(row), top);
    const ColorScale grey{Scale::linear(0, 1), &greys()};
    const ColorScale colors = difference_colors(row.images, content_.reference);
    const double exposure = exposure_of(row.images);
    const auto radiance = [&](double left, const picture::Field& field) {
      canvas_.image(as_seen(field, row.images.coverage, exposure), grey, {left, top, side_, side_});
    };
    Beyond outside;
    radiance(left_of_reference(), row.images.reference);
    for (std::size_t table = 0; table < content_.tables.size(); ++table) {
      radiance(left_of_table(table), row.images.ltc[table]);
      const picture::Field field = difference(row.images, table);
      outside = outside | beyond(colors.scale, field.values);
      const Box box{left_of_table(table) + std::round(side_ + gap * font_), top, side_, side_};
      canvas_.image(field, colors, box);
      if (content_.shape == ObjectShape::sphere)
        canvas_.circle(box.center(), SphereScene{}.sphere_share * side_ / 2, {faint_ink, 1});
    }
    draw_upright_bar(canvas_, {bar_left(), top, bar_width(), side_}, colors, 0.8 * font_, outside);
  }

  struct LabelLine {
    std::string text;
    bool bold = false;
    double above = 0;  // room, in units of the font size as all here
    double size() const { return bold ? 1 : 0.8; }
  };

  std::vector<LabelLine> label_of(const SphereRow& row) const {
    std::vector<LabelLine> lines{
        {fmt::format("αx = {}", format_value(row.material.alpha_x)), true},
        {fmt::format("αy = {}", format_value(row.material.alpha_y)), true}};
    if (row.material.f0 != 1)
      lines.push_back({fmt::format("F0 = {}", format_value(row.material.f0)), true});
    lines.push_back({fmt::format("shown {:.2g} × as bright", exposure_of(row.images))});
    for (std::size_t table = 0; table < content_.tables.size(); ++table) {
      const std::size_t first = lines.size();
      const SphereError error = sphere_error(row.images, table);
      if (content_.tables.size() > 1)
        lines.push_back({content_.tables[table]});
      if (error.pixels > 0) {
        lines.push_back({fmt::format("mean |error| {:.2g}", error.mean_absolute)});
        lines.push_back({fmt::format("RMSE {:.1f} % of mean", 100 * error.relative_rmse)});
        lines.push_back({fmt::format("noise in it {:.1f} %", 100 * error.relative_noise)});
      }
      if (!row.clamped.empty() && !row.clamped[table].empty())
        lines.push_back({"clamped: " + clamping_text(row.clamped[table])});
      if (error.without > 0)
        lines.push_back({fmt::format("{} pixels without entry", error.without)});
      if (first < lines.size())
        lines[first].above = 0.6;
    }
    return lines;
  }

  // Two tables have more to say than a small sphere is high.
  double tallest_label() const {
    double tallest = 0;
    for (const SphereRow& row : content_.rows) {
      double height = 0;
      for (const LabelLine& line : label_of(row))
        height += (line.above + line_spacing * line.size()) * font_;
      tallest = std::max(tallest, height);
    }
    return std::ceil(tallest);
  }

  void draw_label(const std::vector<LabelLine>& lines, double top) {
    double baseline = top + 1.2 * font_;
    for (const LabelLine& line : lines) {
      baseline += line.above * font_;
      fitted_text(
          canvas_, {margin * font_, baseline}, line.text,
          {.size = line.size() * font_, .color = line.bold ? ink : faint_ink, .bold = line.bold},
          (label_width - 0.8) * font_);
      baseline += line_spacing * line.size() * font_;
    }
  }

  const SpherePicture& content_;
  double side_, font_, row_height_;
  Canvas canvas_;
};

}  // namespace

Canvas draw(const SpherePicture& content) {
  if (content.rows.empty() || content.tables.empty())
    throw InputError("a picture of spheres without a material or a table");
  return Painter(content).paint();
}

}  // namespace ltc
