// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/creation_time.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "cli/output.h"
#include "core/error.h"
#include "core/platform.h"

namespace ltc::cli {

std::string creation_time() {
  const char* const value = std::getenv("SOURCE_DATE_EPOCH");
  if (!value)
    return platform::utc_now_iso8601();
  constexpr std::int64_t last = 253402300799;  // of the year 9999
  const std::string_view text(value);
  std::int64_t seconds = -1;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || stop != text.data() + text.size() || seconds < 0 || seconds > last)
    throw InputError(fmt::format("SOURCE_DATE_EPOCH={}: expected whole seconds in [0, {}]",
                                 shell_quoted(std::string(text)), last));
  return platform::utc_iso8601(seconds);
}

}  // namespace ltc::cli
