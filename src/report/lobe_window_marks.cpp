// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/lobe_window_marks.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace ltc {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;
const picture::Stroke mark_stroke{picture::Color::hex(0x9a9a9a), 1.5};

// A point of the projection's plane as a fraction of a panel's side.
picture::Point in_panel(const LobeWindow& window, double x, double y) {
  return {0.5 + (x - window.center_x) / (2 * window.half_width),
          0.5 - (y - window.center_y) / (2 * window.half_width)};
}

double plane_distance(double angle_radians) {
  return 2 * std::sin(angle_radians / 2);
}

picture::Overlay ring(const LobeWindow& window, double theta_degrees) {
  picture::Overlay overlay{{}, mark_stroke};
  const double radius = plane_distance(theta_degrees / degrees_per_radian);
  constexpr int corners = 180;
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) / corners - 0.125);
    overlay.points.push_back(in_panel(window, radius * std::cos(angle), radius * std::sin(angle)));
  }
  if (theta_degrees < 90)
    overlay.label = fmt::format("{:.0f}°", theta_degrees);
  return overlay;
}

// A cross with an open middle, light on dark so that it shows on every colour.
void add_cross(const LobeWindow& window, const Eigen::Vector3d& omega,
               std::vector<picture::Overlay>& marks) {
  const Eigen::Vector2d at = window.project(omega);
  const picture::Point center = in_panel(window, at.x(), at.y());
  constexpr double inner = 0.015, outer = 0.045;
  const std::array<picture::Point, 4> arms = {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
  for (const picture::Stroke& stroke :
       {picture::Stroke{picture::ink, 4}, picture::Stroke{picture::white, 2}})
    for (const picture::Point& arm : arms)
      marks.push_back({{{center.x + inner * arm.x, center.y + inner * arm.y},
                        {center.x + outer * arm.x, center.y + outer * arm.y}},
                       stroke});
}

// The horizon, where it comes near enough to a zoomed window to be seen.
void add_horizon(const LobeWindow& window, const Eigen::Vector3d& mirror,
                 std::vector<picture::Overlay>& marks) {
  picture::Overlay horizon{{}, mark_stroke};
  bool seen = false;
  const double azimuth = std::atan2(mirror.y(), mirror.x());
  for (int i = -900; i <= 900; ++i) {
    const double angle = azimuth + i / 10.0 / degrees_per_radian;
    const Eigen::Vector3d omega(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector2d at = window.project(omega);
    horizon.points.push_back(in_panel(window, at.x(), at.y()));
    seen |= window.contains(omega);
  }
  if (seen)
    marks.push_back(horizon);
}

// Degrees from the mirror direction along the lower and the left edge.
void add_edge_ticks(const LobeWindow& window, std::vector<picture::Overlay>& marks) {
  constexpr double length = 0.02;
  constexpr std::size_t most_ticks = 6;
  const auto ticks_about = [&](double center) {
    return picture::Scale::linear((center - window.half_width) * degrees_per_radian,
                                  (center + window.half_width) * degrees_per_radian)
        .ticks(picture::TickFormat::number, most_ticks);
  };
  constexpr double near_edge = 0.08;  // where a label would be cut off, or meet the other axis
  for (const picture::Tick& tick : ticks_about(window.center_x)) {
    const double x =
        in_panel(window, plane_distance(tick.value / degrees_per_radian), window.center_y).x;
    if (!tick.label.empty() && x > near_edge && x < 1 - near_edge)
      marks.push_back({{{x, 1}, {x, 1 - length}}, mark_stroke, tick.label + "°"});
  }
  for (const picture::Tick& tick : ticks_about(window.center_y)) {
    const double y =
        in_panel(window, window.center_x, plane_distance(tick.value / degrees_per_radian)).y;
    if (!tick.label.empty() && y > near_edge && y < 1 - near_edge)
      marks.push_back({{{0, y}, {length, y}}, mark_stroke, tick.label + "°"});
  }
}

}  // namespace

std::vector<picture::Overlay> window_marks(const LobeWindow& window, const Lobe& lobe) {
  std::vector<picture::Overlay> marks;
  if (window.hemisphere) {
    for (const double theta_degrees : {30.0, 60.0, 90.0})
      marks.push_back(ring(window, theta_degrees));

  } else {
    add_edge_ticks(window, marks);
    add_horizon(window, lobe.mirror(), marks);
  }
  add_cross(window, lobe.mirror(), marks);
  return marks;
}

std::string window_words(const LobeWindow& window) {
  if (window.hemisphere)
    return "Hemisphere from above, x to the right, y up, rings at angles from the normal, cross at "
           "the mirror direction; Lambert's equal-area projection";
  return fmt::format(
      "Zoomed to a window of {:.3g}°, degrees from the mirror direction (cross) along x and y; "
      "Lambert's equal-area projection",
      2 * window.half_width * degrees_per_radian);
}

}  // namespace ltc
