// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Scenes as people write them: [[material]] tables in TOML.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <optional>

#include "config/suggestion.h"
#include "config/toml_file.h"
#include "core/angle.h"
#include "core/error.h"
#include "scene/readers.h"

namespace ltc {
namespace {

const std::array<std::string, 6> material_keys = {"name",      "alpha_x",    "alpha_y",
                                                  "roughness", "anisotropy", "view_angle_degrees"};

std::optional<double> number_of(const toml::node& node) {
  if (const auto* integer = node.as_integer())
    return static_cast<double>(integer->get());
  if (const auto* real = node.as_floating_point())
    return real->get();
  return std::nullopt;
}

// A value as messages show it: a list of two by its elements.
std::string text_of(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != 2)
    return config::toml_of(config::value_of(node));
  return fmt::format("[{}, {}]", config::toml_of(config::value_of((*list)[0])),
                     config::toml_of(config::value_of((*list)[1])));
}

// One value, or two of which the first is not the greater.
std::optional<Interval> interval_of(const toml::node& node) {
  if (const auto value = number_of(node))
    return Interval{*value, *value};
  const toml::array* list = node.as_array();
  if (!list || list->size() != 2)
    return std::nullopt;
  const auto low = number_of((*list)[0]), high = number_of((*list)[1]);
  if (!low || !high || !(*low <= *high))
    return std::nullopt;
  return Interval{*low, *high};
}

class MaterialReader {
 public:
  // `number` counts from 1, as people do.
  MaterialReader(const std::filesystem::path& file, const toml::table& table, std::size_t number)
      : file_(file), table_(table), label_(fmt::format("material {}", number)) {}

  Material read() {
    Material material;
    material.name = read_name();
    label_ = fmt::format("{} {}", label_, config::quoted(material.name));
    for (const auto& [key, node] : table_)
      if (std::find(material_keys.begin(), material_keys.end(), key.str()) == material_keys.end())
        refuse(node, fmt::format("unknown key {} = {}{}", config::quoted(key.str()), text_of(node),
                                 config::suggestion(key.str(), material_keys,
                                                    "docs/scenes.md lists the keys there are")));
    material.roughness = read_roughness();
    if (const auto degrees = read_interval("view_angle_degrees", 90))
      material.theta_radians = {radians_of_degrees(degrees->low),
                                radians_of_degrees(degrees->high)};
    return material;
  }

 private:
  [[noreturn]] void refuse(const toml::node& where, const std::string& what) const {
    throw InputError(
        fmt::format("{}: {}: {}", config::place_of(file_, where.source()), label_, what));
  }

  std::string read_name() const {
    const toml::node* node = table_.get("name");
    if (!node)
      refuse(table_, "has no name; expected name = \"...\"");
    const auto* name = node->as_string();
    if (!name || name->get().empty())
      refuse(*node, fmt::format("name = {}: expected a string that is not empty", text_of(*node)));
    return name->get();
  }

  // Within [0, most]; nothing if the key is not there.
  std::optional<Interval> read_interval(std::string_view key, double most) const {
    const toml::node* node = table_.get(key);
    if (!node)
      return std::nullopt;
    const auto interval = interval_of(*node);
    if (!interval || !(interval->low >= 0) || !(interval->high <= most))
      refuse(*node,
             fmt::format("{0} = {1}: expected a number in [0, {2}], or two, [low, high] with "
                         "low <= high",
                         key, text_of(*node), most));
    return interval;
  }

  std::variant<RoughnessBox, PerceptualRoughness> read_roughness() const {
    const auto alpha_x = read_interval("alpha_x", 1), alpha_y = read_interval("alpha_y", 1);
    const auto roughness = read_interval("roughness", 1),
               anisotropy = read_interval("anisotropy", 1);
    if (alpha_x && alpha_y && !roughness && !anisotropy)
      return RoughnessBox{*alpha_x, *alpha_y};
    if (roughness && !alpha_x && !alpha_y)
      return PerceptualRoughness{*roughness, anisotropy.value_or(Interval{0, 0})};
    std::string said;
    for (const std::string_view key : {"alpha_x", "alpha_y", "roughness", "anisotropy"})
      if (table_.contains(key))
        said += fmt::format("{}{}", said.empty() ? "" : ", ", key);
    refuse(table_, fmt::format("has {}; expected alpha_x and alpha_y, or roughness and, if it is "
                               "not isotropic, anisotropy",
                               said.empty() ? "no roughness" : said));
  }

  const std::filesystem::path& file_;
  const toml::table& table_;
  std::string label_;
};

}  // namespace

Scene load_toml_scene(const std::filesystem::path& file) {
  const toml::table root = config::read_toml(file, "scene");
  for (const auto& [key, node] : root)
    if (key.str() != "material")
      throw InputError(fmt::format("{}: unknown key {} = {}; expected [[material]] tables only",
                                   config::place_of(file, node.source()), config::quoted(key.str()),
                                   text_of(node)));
  const toml::node* list = root.get("material");
  if (!list)
    throw InputError(fmt::format("{}: has no material; expected at least one [[material]] table",
                                 file.string()));
  // [material] in single brackets, and material = [1, 2].
  const toml::array* materials = list->as_array();
  if (!materials || materials->empty() || !materials->is_homogeneous(toml::node_type::table))
    throw InputError(fmt::format("{}: material = {}: expected [[material]] tables, at least one",
                                 config::place_of(file, list->source()), text_of(*list)));
  Scene scene;
  for (const toml::node& node : *materials)
    scene.materials.push_back(
        MaterialReader(file, *node.as_table(), scene.materials.size() + 1).read());
  return scene;
}

}  // namespace ltc
