// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Arguments in commands that reports print.
#pragma once

#include <string>
#include <string_view>

namespace ltc {

// An argument as a shell reads it back to the same text.
std::string shell_quoted(std::string_view argument);

}  // namespace ltc
