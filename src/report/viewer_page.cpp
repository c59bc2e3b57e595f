// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/viewer_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/version.h"
#include "export/entry_channels.h"
#include "export/field_code.h"
#include "export/image_bytes.h"
#include "export/nearest.h"
#include "export/texture_layout.h"
#include "picture/color.h"
#include "report/html.h"
#include "report/viewer_files.h"

namespace ltc {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view scripts[] = {"maths.js",    "state.js",    "data.js",
                                        "lights.js",   "graphics.js", "stage.js",
                                        "controls.js", "probe.js",    "main.js"};
constexpr std::string_view shaders[] = {
    "ltc_lobe.glsl",         "ltc_polygon.glsl", "ltc_disk.glsl",   "ltc_line.glsl",
    "ltc_table.glsl",        "ltc_texture.glsl", "ltc_folded.glsl", "ltc_folded_lights.glsl",
    "ltc_folded_table.glsl", "scene.glsl",       "table.glsl",      "ggx.glsl",
    "table_main.glsl",       "ggx_main.glsl",    "present.glsl",    "probe_main.glsl",
    "lobe_main.glsl"};

// FNV-1a of 32 bits: tells a page that was cut or altered on its way.
std::uint32_t checksum(std::string_view text) {
  std::uint32_t hash = 2166136261u;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

std::string replaced(std::string text, std::string_view mark, std::string_view by) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    throw InputError(fmt::format("the viewer's page has no {}", mark));
  return text.replace(at, mark.size(), by);
}
std::string everywhere(std::string text, std::string_view mark, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += by.size())
    text.replace(at, mark.size(), by);
  return text;
}

// JSON within a page: no tag can begin in it.
std::string json_for_page(const Json& json) {
  std::string text;
  // File names are bytes of any kind; JSON is UTF-8.
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

Json axes_json(const Grid& grid) {
  Json axes = {{"size", Json::array()},
               {"first", Json::array()},
               {"last", Json::array()},
               {"warp", Json::array()}};
  for (std::size_t i = 0; i < Grid::axis_count; ++i) {
    const Axis& axis = grid.axis(i);
    axes["size"].push_back(axis.size());
    axes["first"].push_back(axis.first());
    axes["last"].push_back(axis.last());
    axes["warp"].push_back(static_cast<int>(axis.warp));
  }
  return axes;
}

// The values as one texture, of folded lobes their kappa and gamma behind them; in 16 bits where
// that is what the file had and nothing is lost.
Image texture_of(const Table& table) {
  Image image = images_of(table, TextureLayout::stacked).front();
  if (is_folded(table)) {
    for (const std::size_t entry : nearest_fitted(table))
      image.values.insert(image.values.end(),
                          {table.fold[2 * entry], table.fold[2 * entry + 1], 0, 0});
    image.layers += image.layers / texels_per_entry;
  }
  const bool halves =
      table.precision == Precision::half && std::ranges::all_of(image.values, [](float value) {
        return rounded(value, Precision::half) == value;
      });
  image.precision = halves ? Precision::half : Precision::single;
  return image;
}

Json description(const ViewedTable& viewed) {
  const Table& table = *viewed.table;
  Json json = axes_json(table.grid);
  json["name"] = viewed.name;
  json["generator"] = table.generator;
  json["storage"] = static_cast<int>(table.storage);
  json["storage_name"] = name_of(table.storage);
  json["alpha_min"] = table.grid.alpha_min;
  json["both_alphas"] = table.grid.layout == Layout::alphax_alphay;
  json["missing"] = std::ranges::count_if(table.status, [](Status s) { return !has_values(s); });
  json["folded"] = is_folded(table);
  json["crease"] = is_folded(table) ? table.creases.front() : 0;
  if (!table.field)
    return json;
  json["field"] = field_function(*table.field, CodeLanguage::glsl);
  json["numbers"] = table.field->terms.size();
  if (table.field->material)
    json["material"] = *table.field->material;
  return json;
}

// The values of a table of nodes, in a script element that holds no script; its sum in `json`.
std::string payload(const Table& table, std::size_t number, Json& json) {
  if (table.field)
    return "";
  const Image image = texture_of(table);
  const std::string text = html::base64(value_bytes(image));
  json["half"] = image.precision == Precision::half;
  json["checksum"] = checksum(text);
  json["length"] = text.size();
  return fmt::format("<script type=\"text/plain\" id=\"values-{}\">{}</script>\n", number, text);
}

// Of sRGB bytes along [0, 1].
Json colors_json(const picture::ColorMap& map) {
  constexpr int steps = 64;
  Json json = Json::array();
  for (int i = 0; i <= steps; ++i) {
    const picture::Color color = map.at(static_cast<double>(i) / steps);
    for (const double channel : {color.red, color.green, color.blue})
      json.push_back(static_cast<int>(std::lround(255 * channel)));
  }
  return json;
}

// Those that ggx.glsl knows, in the order of its numbers.
constexpr std::array<std::string_view, 4> brdfs = {"ggx", "beckmann", "charlie",
                                                   "charlie-ashikhmin"};

Json shaders_json(const LobeModel& model) {
  Json json = Json::object();
  for (const std::string_view name : shaders)
    json[std::string(name.substr(0, name.find('.')))] = viewer_file(name);
  const auto number = std::ranges::find(brdfs, model.name()) - brdfs.begin();
  json["ggx"] =
      replaced(json["ggx"], "const int BRDF = GGX;", fmt::format("const int BRDF = {};", number));
  return json;
}

void require_viewable(std::span<const ViewedTable> tables) {
  if (tables.empty() || tables.size() > 2)
    throw InputError(fmt::format("{} tables to view; expected 1 or 2", tables.size()));
  for (const ViewedTable& viewed : tables) {
    const LobeModel* const model = viewed.table->grid.model;
    if (std::ranges::find(brdfs, model->name()) == brdfs.end())
      throw InputError(
          fmt::format("{}: a table of the BRDF {}; expected one of {}, which the page "
                      "samples beside it",
                      viewed.name, model->name(), fmt::join(brdfs, ", ")));
    if (model != tables.front().table->grid.model)
      throw InputError(fmt::format("{}: a table of the BRDF {} beside one of {}; expected the same",
                                   viewed.name, model->name(),
                                   tables.front().table->grid.model->name()));
  }
  for (const ViewedTable& viewed : tables)
    if (is_folded(*viewed.table) && viewed.table->creases.size() > 1)
      throw InputError(fmt::format("{}: folded lobes with {} pairs of creases; expected one pair",
                                   viewed.name, viewed.table->creases.size()));
}

std::string script() {
  std::string text = "(() => {\n'use strict';\n";
  for (const std::string_view name : scripts)
    text += viewer_file(name);
  return text + "})();\n";
}

}  // namespace

std::string viewer_page(std::span<const ViewedTable> tables) {
  require_viewable(tables);
  Json data = {{"version", generator()}, {"tables", Json::array()}};
  std::string payloads;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    Json json = description(tables[i]);
    payloads += payload(*tables[i].table, i, json);
    data["tables"].push_back(std::move(json));
  }
  data["diverging"] = colors_json(picture::ColorMap::diverging());
  data["viridis"] = colors_json(picture::ColorMap::viridis());
  data["shaders"] = shaders_json(*tables.front().table->grid.model);
  std::string page(viewer_file("page.html"));
  page = replaced(std::move(page), "@TITLE@", html::escaped(tables.front().name));
  page = replaced(std::move(page), "/*STYLE*/", viewer_file("style.css"));
  page = replaced(std::move(page), "<!--VALUES-->", payloads);
  page = replaced(std::move(page), "@DATA@", json_for_page(data));
  page = replaced(std::move(page), "/*SCRIPT*/", script());
  return everywhere(std::move(page), "@BRDF@", tables.front().table->grid.model->label());
}

}  // namespace ltc
