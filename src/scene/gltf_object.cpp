// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/gltf_object.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace ltc {

using nlohmann::json;

void GltfObject::refuse(std::string_view key, const json& value, std::string_view expected) const {
  throw InputError(fmt::format("{}{} = {}: expected {}", label_, key, short_text(value), expected));
}

GltfObject GltfObject::object(std::string_view key) const {
  static const json empty = json::object();
  const json* const member = member_of(&value_, key);
  if (member && !member->is_object())
    refuse(key, *member, "an object");
  return {context_, fmt::format("{}{}.", label_, key), fmt::format("{}/{}", pointer_, key),
          member ? *member : empty};
}

Interval GltfObject::factor(std::string_view key, double otherwise) const {
  const json* const member = member_of(&value_, key);
  if (member &&
      (!member->is_number() || !(member->get<double>() >= 0 && member->get<double>() <= 1)))
    refuse(key, *member, "a number in [0, 1]");
  const double value = member ? member->get<double>() : otherwise;
  const auto moved =
      context_.animations.range_of(fmt::format("{}/{}", pointer_, key), context_.warnings);
  if (!moved)
    return {value, value};
  return {std::min(value, moved->low), std::max(value, moved->high)};
}

bool GltfObject::has_texture(std::string_view key) const {
  if (!has(key))
    return false;
  const GltfObject texture = object(key);
  const json* const index = member_of(&texture.value_, "index");
  if (!whole_number(index))
    texture.refuse("index", index ? *index : json(), "the number of a texture");
  return true;
}

Interval GltfObject::textured_factor(std::string_view key, double otherwise,
                                     std::string_view texture) const {
  const Interval range = factor(key, otherwise);
  return {has_texture(texture) ? 0 : range.low, range.high};
}

}  // namespace ltc
