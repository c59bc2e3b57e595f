// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/canvas.h"

#include <cairo.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/write_file.h"
#include "picture/text.h"

namespace ltc::picture {
namespace {

constexpr int largest_side = 16384;
constexpr const char* font_family = "DejaVu Sans";

struct Releaser {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};
template <typename T>
using Owned = std::unique_ptr<T, Releaser>;

// Puts transformation and clip back as they were, whatever happens.
class SavedState {
 public:
  explicit SavedState(cairo_t* context) : context_(context) { cairo_save(context); }
  ~SavedState() { cairo_restore(context_); }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;

 private:
  cairo_t* context_;
};

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw IoError(fmt::format("cannot draw: {}", cairo_status_to_string(status)));
}

Owned<cairo_surface_t> make_surface(int width, int height) {
  Owned<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  require(cairo_surface_status(surface.get()));
  return surface;
}

// Glyphs that depend on neither the screen nor the user's font settings.
void use_portable_glyphs(cairo_t* context) {
  const Owned<cairo_font_options_t> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options.get());
}

void use_color(cairo_t* context, const Color& color) {
  cairo_set_source_rgb(context, color.red, color.green, color.blue);
}

void use_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, font_family, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
}

void trace(cairo_t* context, std::span<const Point> points) {
  cairo_new_path(context);
  for (const Point& point : points)
    cairo_line_to(context, point.x, point.y);
}

void stroke_path(cairo_t* context, const Stroke& stroke) {
  use_color(context, stroke.color);
  cairo_set_line_width(context, stroke.width);
  cairo_set_dash(context, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
  cairo_stroke(context);
}

void fill_path(cairo_t* context, const Color& color) {
  use_color(context, color);
  cairo_fill(context);
}

// Where the text stands before it is rotated, with the anchor at the origin: the box around it and
// the height of its baseline.
struct TextLayout {
  Box box;
  double baseline = 0;
};

TextLayout lay_out(cairo_t* context, const std::string& line, const TextStyle& style) {
  use_font(context, style);
  cairo_text_extents_t extents;
  cairo_text_extents(context, line.c_str(), &extents);
  cairo_font_extents_t font;
  cairo_font_extents(context, &font);

  TextLayout layout{{0, 0, extents.x_advance, font.ascent + font.descent}, 0};
  if (style.horizontal == HorizontalAnchor::center)
    layout.box.left = -layout.box.width / 2;
  else if (style.horizontal == HorizontalAnchor::right)
    layout.box.left = -layout.box.width;
  if (style.vertical == VerticalAnchor::middle)
    layout.box.top = -layout.box.height / 2;
  else if (style.vertical == VerticalAnchor::baseline)
    layout.box.top = -font.ascent;
  else if (style.vertical == VerticalAnchor::bottom)
    layout.box.top = -layout.box.height;
  layout.baseline = layout.box.top + font.ascent;
  return layout;
}

// Screen y points down, so a counter-clockwise turn is a negative angle.
double screen_angle(const TextStyle& style) {
  return -style.rotation_degrees * std::numbers::pi / 180;
}

std::uint32_t packed(const Color& color) {
  const auto byte = [](double channel) {
    return static_cast<std::uint32_t>(std::lround(255 * channel));
  };
  return byte(color.red) << 16 | byte(color.green) << 8 | byte(color.blue);
}

// A position along one side of a field: the two cells it lies between and the weight of the second.
struct Between {
  std::size_t first = 0, second = 0;
  double weight = 0;
};

Between between_cells(double coordinate, std::size_t count, Sampling sampling) {
  const double last = static_cast<double>(count - 1);
  if (sampling == Sampling::nearest) {
    const auto cell = static_cast<std::size_t>(std::clamp(std::floor(coordinate), 0.0, last));
    return {cell, cell, 0};
  }
  const double along = std::clamp(coordinate - 0.5, 0.0, last);
  const auto first = static_cast<std::size_t>(along);
  return {first, std::min(first + 1, count - 1), along - static_cast<double>(first)};
}

// Bilinear over those of the four cells that have a value; NaN where the nearest has none.
double sample(const Field& field, const Between& row, const Between& column) {
  const std::size_t near_row = row.weight < 0.5 ? row.first : row.second;
  const std::size_t near_column = column.weight < 0.5 ? column.first : column.second;
  if (std::isnan(field.at(near_row, near_column)))
    return field.at(near_row, near_column);
  double sum = 0, total = 0;
  const auto add = [&](std::size_t r, std::size_t c, double weight) {
    const double value = field.at(r, c);
    if (weight > 0 && !std::isnan(value)) {
      sum += weight * value;
      total += weight;
    }
  };
  add(row.first, column.first, (1 - row.weight) * (1 - column.weight));
  add(row.first, column.second, (1 - row.weight) * column.weight);
  add(row.second, column.first, row.weight * (1 - column.weight));
  add(row.second, column.second, row.weight * column.weight);
  return sum / total;
}

cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Canvas::Cairo {
  Owned<cairo_surface_t> surface;
  Owned<cairo_t> context;
};

Canvas::Canvas(int width, int height, Color background) {
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    throw InputError(fmt::format("picture of {} x {} pixels: each side must be 1 to {}", width,
                                 height, largest_side));
  cairo_ = std::make_unique<Cairo>();
  cairo_->surface = make_surface(width, height);
  cairo_->context.reset(cairo_create(cairo_->surface.get()));
  require(cairo_status(cairo_->context.get()));
  cairo_set_line_join(cairo_->context.get(), CAIRO_LINE_JOIN_ROUND);
  use_portable_glyphs(cairo_->context.get());
  use_color(cairo_->context.get(), background);
  cairo_paint(cairo_->context.get());
}

Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

int Canvas::width() const {
  return cairo_image_surface_get_width(cairo_->surface.get());
}
int Canvas::height() const {
  return cairo_image_surface_get_height(cairo_->surface.get());
}
Box Canvas::area() const {
  return {0, 0, static_cast<double>(width()), static_cast<double>(height())};
}

void Canvas::line(Point from, Point to, const Stroke& stroke) {
  polyline(std::array{from, to}, stroke);
}

void Canvas::polyline(std::span<const Point> points, const Stroke& stroke) {
  trace(cairo_->context.get(), points);
  stroke_path(cairo_->context.get(), stroke);
}

void Canvas::polygon(std::span<const Point> corners, Color fill) {
  trace(cairo_->context.get(), corners);
  cairo_close_path(cairo_->context.get());
  fill_path(cairo_->context.get(), fill);
}

void Canvas::rectangle(const Box& box, Color fill) {
  cairo_new_path(cairo_->context.get());
  cairo_rectangle(cairo_->context.get(), box.left, box.top, box.width, box.height);
  fill_path(cairo_->context.get(), fill);
}

void Canvas::outline(const Box& box, const Stroke& stroke) {
  cairo_new_path(cairo_->context.get());
  cairo_rectangle(cairo_->context.get(), box.left, box.top, box.width, box.height);
  stroke_path(cairo_->context.get(), stroke);
}

void Canvas::disc(Point center, double radius, Color fill) {
  cairo_new_path(cairo_->context.get());
  cairo_arc(cairo_->context.get(), center.x, center.y, radius, 0, 2 * std::numbers::pi);
  fill_path(cairo_->context.get(), fill);
}

void Canvas::circle(Point center, double radius, const Stroke& stroke) {
  cairo_new_path(cairo_->context.get());
  cairo_arc(cairo_->context.get(), center.x, center.y, radius, 0, 2 * std::numbers::pi);
  stroke_path(cairo_->context.get(), stroke);
}

void Canvas::hatch(const Box& box, Color color, double spacing) {
  clipped(box, [&] {
    // Lines of equal x + y at multiples of the spacing, so that neighbouring boxes join.
    const double first = std::ceil((box.left + box.top) / spacing) * spacing;
    for (double sum = first; sum < box.right() + box.bottom(); sum += spacing)
      line({sum - box.top, box.top}, {sum - box.bottom(), box.bottom()}, {color, 1});
  });
}

void Canvas::image(const Field& field, const ColorScale& colors, const Box& box,
                   Sampling sampling) {
  if (field.width == 0 || field.height == 0 || field.values.size() != field.width * field.height)
    throw InputError(fmt::format("field of {} x {} cells with {} values", field.width, field.height,
                                 field.values.size()));
  const double left = std::round(box.left), top = std::round(box.top);
  const int columns = static_cast<int>(std::round(box.right()) - left);
  const int rows = static_cast<int>(std::round(box.bottom()) - top);
  if (columns < 1 || rows < 1)
    return;

  const Owned<cairo_surface_t> pixels = make_surface(columns, rows);
  unsigned char* const bytes = cairo_image_surface_get_data(pixels.get());
  const int stride = cairo_image_surface_get_stride(pixels.get());
  const auto cell = [&](int pixel, int count, std::size_t cells) {
    return between_cells((pixel + 0.5) * static_cast<double>(cells) / count, cells, sampling);
  };
  for (int y = 0; y < rows; ++y) {
    const Between row = cell(y, rows, field.height);
    for (int x = 0; x < columns; ++x) {
      const double value = sample(field, row, cell(x, columns, field.width));
      const std::uint32_t color = packed(colors.at(value));
      std::memcpy(bytes + y * stride + 4 * x, &color, sizeof color);
    }
  }
  cairo_surface_mark_dirty(pixels.get());
  cairo_set_source_surface(cairo_->context.get(), pixels.get(), left, top);
  cairo_paint(cairo_->context.get());
}

void Canvas::text(Point anchor, std::string_view line, const TextStyle& style) {
  const std::string clean = clean_utf8(line);
  cairo_t* const context = cairo_->context.get();
  const TextLayout layout = lay_out(context, clean, style);
  const SavedState state(context);
  cairo_translate(context, anchor.x, anchor.y);
  cairo_rotate(context, screen_angle(style));
  use_color(context, style.color);
  cairo_move_to(context, layout.box.left, layout.baseline);
  cairo_show_text(context, clean.c_str());
}

Box Canvas::text_box(Point anchor, std::string_view line, const TextStyle& style) const {
  const Box flat = lay_out(cairo_->context.get(), clean_utf8(line), style).box;
  const double cosine = std::cos(screen_angle(style)), sine = std::sin(screen_angle(style));
  const Point center{flat.center().x * cosine - flat.center().y * sine,
                     flat.center().x * sine + flat.center().y * cosine};
  const double width = flat.width * std::abs(cosine) + flat.height * std::abs(sine);
  const double height = flat.width * std::abs(sine) + flat.height * std::abs(cosine);
  return {anchor.x + center.x - width / 2, anchor.y + center.y - height / 2, width, height};
}

double Canvas::text_width(std::string_view line, const TextStyle& style) const {
  return lay_out(cairo_->context.get(), clean_utf8(line), style).box.width;
}

void Canvas::clipped(const Box& box, const std::function<void()>& draw) {
  const SavedState state(cairo_->context.get());
  cairo_new_path(cairo_->context.get());
  cairo_rectangle(cairo_->context.get(), box.left, box.top, box.width, box.height);
  cairo_clip(cairo_->context.get());
  draw();
}

Color Canvas::pixel(int x, int y) const {
  if (x < 0 || y < 0 || x >= width() || y >= height())
    throw InputError(
        fmt::format("pixel ({}, {}) of a picture of {} x {}", x, y, width(), height()));
  cairo_surface_flush(cairo_->surface.get());
  std::uint32_t color = 0;
  std::memcpy(&color,
              cairo_image_surface_get_data(cairo_->surface.get()) +
                  y * cairo_image_surface_get_stride(cairo_->surface.get()) + 4 * x,
              sizeof color);
  return Color::hex(color & 0xffffff);
}

std::string Canvas::png_bytes() const {
  require(cairo_status(cairo_->context.get()));
  std::string bytes;
  require(cairo_surface_write_to_png_stream(cairo_->surface.get(), append_bytes, &bytes));
  return bytes;
}

void Canvas::write_png(const std::filesystem::path& path) const {
  write_file(path, png_bytes());
}

}  // namespace ltc::picture
