// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/color.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace ltc::picture {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

Triple operator*(const Matrix& m, const Triple& v) {
  Triple product;
  for (std::size_t i = 0; i < 3; ++i)
    product[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return product;
}

double decode_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encode_srgb(double linear) {
  const double encoded =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return std::clamp(encoded, 0.0, 1.0);
}

// Linear sRGB to cone responses, their cube roots to Oklab, and back.
constexpr Matrix cones_from_rgb{{{0.4122214708, 0.5363325363, 0.0514459929},
                                 {0.2119034982, 0.6806995451, 0.1073969566},
                                 {0.0883024619, 0.2817188376, 0.6299787005}}};
constexpr Matrix oklab_from_roots{{{0.2104542553, 0.7936177850, -0.0040720468},
                                   {1.9779984951, -2.4285922050, 0.4505937099},
                                   {0.0259040371, 0.7827717662, -0.8086757660}}};
constexpr Matrix roots_from_oklab{{{1, 0.3963377774, 0.2158037573},
                                   {1, -0.1055613458, -0.0638541728},
                                   {1, -0.0894841775, -1.2914855480}}};
constexpr Matrix rgb_from_cones{{{4.0767416621, -3.3077115913, 0.2309699292},
                                 {-1.2684380046, 2.6097574011, -0.3413193965},
                                 {-0.0041960863, -0.7034186147, 1.7076147010}}};

Triple oklab(const Color& color) {
  Triple cones = cones_from_rgb *
                 Triple{decode_srgb(color.red), decode_srgb(color.green), decode_srgb(color.blue)};
  for (double& response : cones)
    response = std::cbrt(response);
  return oklab_from_roots * cones;
}

Color srgb(const Triple& lab) {
  Triple cones = roots_from_oklab * lab;
  for (double& root : cones)
    root = root * root * root;
  const Triple linear = rgb_from_cones * cones;
  return {encode_srgb(linear[0]), encode_srgb(linear[1]), encode_srgb(linear[2])};
}

// Continues three equally spaced points by the parabola through them.
Triple extrapolate(const Triple& nearest, const Triple& second, const Triple& third) {
  Triple next;
  for (std::size_t i = 0; i < 3; ++i)
    next[i] = 3 * nearest[i] - 3 * second[i] + third[i];
  return next;
}

double catmull_rom(double before, double from, double to, double after, double t) {
  return from + 0.5 * t *
                    (to - before +
                     t * (2 * before - 5 * from + 4 * to - after +
                          t * (3 * (from - to) + after - before)));
}

}  // namespace

Color series_color(std::size_t index) {
  constexpr std::uint32_t colors[] = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                      0xe69f00, 0x56b4e9, 0x3b3b3b};
  return Color::hex(colors[index % std::size(colors)]);
}

double lightness(const Color& color) {
  return oklab(color)[0];
}

ColorMap::ColorMap(std::span<const std::uint32_t> control_points) {
  const std::size_t count = control_points.size();
  if (count < 3)
    throw InputError("a colour map needs at least 3 control points, not " + std::to_string(count));
  points_.resize(count + 2);
  for (std::size_t i = 0; i < count; ++i)
    points_[i + 1] = oklab(Color::hex(control_points[i]));
  points_.front() = extrapolate(points_[1], points_[2], points_[3]);
  points_.back() = extrapolate(points_[count], points_[count - 1], points_[count - 2]);
}

const ColorMap& ColorMap::viridis() {
  // Every fifteenth entry of the published 256.
  constexpr std::uint32_t points[] = {0x440154, 0x481769, 0x472a7a, 0x433d84, 0x3d4e8a, 0x355e8d,
                                      0x2e6d8e, 0x297b8e, 0x23898e, 0x1f978b, 0x21a585, 0x2eb37c,
                                      0x46c06f, 0x65cb5e, 0x89d548, 0xb0dd2f, 0xd8e219, 0xfde725};
  static const ColorMap map(points);
  return map;
}

const ColorMap& ColorMap::diverging() {
  // Oklab lightness 0.30, 0.42, 0.55, 0.68, 0.81, 0.90 on both sides of 0.965; hues 258 to 240
  // degrees on the left, 25 to 45 degrees on the right.
  constexpr std::uint32_t points[] = {0x062b5f, 0x054a9a, 0x3072c1, 0x649dd7, 0xa1c6e6,
                                      0xcde1f0, 0xf3f3f3, 0xf2d8cc, 0xe9b39e, 0xdb795b,
                                      0xc23d1f, 0x8d1b14, 0x570e10};
  static const ColorMap map(points);
  return map;
}

Color ColorMap::at(double position) const {
  if (std::isnan(position))
    return missing;
  const std::size_t segments = points_.size() - 3;
  const double along = std::clamp(position, 0.0, 1.0) * static_cast<double>(segments);
  const std::size_t i = std::min(static_cast<std::size_t>(along), segments - 1);
  const double t = along - static_cast<double>(i);
  Oklab lab;
  for (std::size_t k = 0; k < 3; ++k)
    lab[k] = catmull_rom(points_[i][k], points_[i + 1][k], points_[i + 2][k], points_[i + 3][k], t);
  return srgb(lab);
}

}  // namespace ltc::picture
