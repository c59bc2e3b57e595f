// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What someone who wrote an unknown key probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ltc::config {

// Ready to append to a message: "; did you mean fit.seed?" with the nearest of `known` (not empty),
// or "; " and `otherwise` if none is near. Names may be dotted; the right last word counts as near.
std::string suggestion(std::string_view unknown, std::span<const std::string> known,
                       std::string_view otherwise);

}  // namespace ltc::config
