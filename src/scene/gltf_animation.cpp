// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/gltf_animation.h"

#include <fmt/format.h>

#include <algorithm>

namespace ltc {
namespace {

using nlohmann::json;

const json empty_list = json::array();

// The elements of a member that is a list; none if it is not.
const json& list_of(const json* object, std::string_view key) {
  const json* const list = member_of(object, key);
  return list && list->is_array() ? *list : empty_list;
}

std::optional<Interval> range_of_sampler(const GltfFile& file, const json* sampler,
                                         std::uint64_t& bytes_left) {
  const json* const interpolation = member_of(sampler, "interpolation");
  if (interpolation && *interpolation == "CUBICSPLINE")
    return std::nullopt;
  return accessor_range(file, whole_number(member_of(sampler, "output")), bytes_left);
}

}  // namespace

GltfAnimations::GltfAnimations(const GltfFile& file) : file_(file) {
  for (const json& animation : list_of(&file.root, "animations"))
    for (const json& channel : list_of(&animation, "channels")) {
      const json* const target = member_of(&channel, "target");
      const json* const pointer =
          member_of(member_of(member_of(target, "extensions"), "KHR_animation_pointer"), "pointer");
      if (pointer && pointer->is_string())
        samplers_.emplace(pointer->get<std::string>(),
                          element_of(member_of(&animation, "samplers"),
                                     whole_number(member_of(&channel, "sampler"))));
    }
}

std::optional<Interval> GltfAnimations::range_of(const std::string& pointer,
                                                 std::vector<std::string>& warnings) const {
  const auto [begin, end] = samplers_.equal_range(pointer);
  if (begin == end)
    return std::nullopt;
  Interval all{1, 0};
  for (auto sampler = begin; sampler != end; ++sampler) {
    const auto range = range_of_sampler(file_, sampler->second, bytes_left_);
    if (!range) {
      warnings.push_back(
          fmt::format("{}: the file does not tell how far its animation of {} goes; taken as "
                      "anything in [0, 1]",
                      file_.path.string(), pointer));
      return Interval{0, 1};
    }
    // Renderers clamp what goes beyond.
    all = {std::min(all.low, std::clamp(range->low, 0.0, 1.0)),
           std::max(all.high, std::clamp(range->high, 0.0, 1.0))};
  }
  return all;
}

}  // namespace ltc
