// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/light_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/options.h"
#include "render/light_texture.h"

namespace ltc::cli {
namespace {

constexpr double farthest = 1000;

bool is_shape(const std::string& kind) {
  const std::vector<std::string> shapes = all_names<LightShape>();
  return std::find(shapes.begin(), shapes.end(), kind) != shapes.end();
}

bool is_image(const std::string& kind) {
  const std::string ending = std::filesystem::path(kind).extension().string();
  return ending == ".png" || ending == ".exr";
}

// "1,-2.5,3": away from the origin, which lights face.
std::optional<Eigen::Vector3d> position_of(const std::string& text) {
  Eigen::Vector3d position;
  const char *at = text.data(), *const end = text.data() + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [stop, error] = std::from_chars(at, end, position[i]);
    const bool closed = i < 2 ? stop != end && *stop == ',' : stop == end;
    if (error != std::errc() || !closed || !(std::abs(position[i]) <= farthest))
      return std::nullopt;
    at = stop + 1;
  }
  return position.norm() > 0 ? std::optional(position) : std::nullopt;
}

}  // namespace

bool LightArguments::has_image() const {
  return !is_shape(kind);
}

Eigen::Vector3d LightArguments::center(ObjectShape shape) const {
  return position.empty() ? usual_light_position(shape) : *position_of(position);
}

std::string LightArguments::text() const {
  if (has_image())
    return "the image " + std::filesystem::path(kind).filename().string();
  return kind == "rectangle" ? "a rectangular light" : "a light: " + kind;
}

void add_light_options(CLI::App& app, LightArguments& arguments, const char* group) {
  const std::vector<std::string> shapes = all_names<LightShape>();
  allow(app.add_option("--light", arguments.kind,
                       fmt::format("{}, or the image of a rectangle, .png or .exr [rectangle]",
                                   fmt::join(shapes, ", "))),
        {fmt::format("{}, or an image that ends in .png or .exr", fmt::join(shapes, ", ")),
         [](std::string& text) { return is_shape(text) || is_image(text); }})
      ->type_name(fmt::format("{{{}}}", fmt::join(shapes, ",")))
      ->option_text("KIND")
      ->group(group);
  allow(app.add_option(
            "--light-position", arguments.position,
            "its centre, y up, the object about the origin [1,1.5,2.1; over plane and sheet "
            "0,1.5,-2]"),
        {fmt::format("three numbers X,Y,Z in [-{0}, {0}], not all of them 0", farthest),
         [](std::string& text) { return position_of(text).has_value(); }})
      ->option_text("X,Y,Z")
      ->group(group);
  allow(app.add_option("--light-size", arguments.size,
                       "its width and height over the usual ones, those of figure 14 [1]"),
        number({0.001, 2}))
      ->option_text("S")
      ->group(group);
  app.add_flag("--two-sided", arguments.two_sided, "flat lights emit from both sides")
      ->group(group);
}

Light light_of(const LightArguments& arguments, ObjectShape shape, const RunContext& run) {
  const LightShape kind =
      arguments.has_image() ? LightShape::rectangle : value_named<LightShape>(arguments.kind);
  Light light = standard_light(kind, arguments.center(shape), arguments.size);
  light.two_sided = arguments.two_sided;
  if (arguments.has_image())
    light.texture = std::make_shared<const LightTexture>(read_light_image(arguments.kind), run);
  return light;
}

}  // namespace ltc::cli
