// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// JSON as the commands write it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace ltc::cli {

// With a line break at its end. File names are bytes of any kind and JSON is UTF-8: what is not is
// replaced.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace ltc::cli
