// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Breaking text into lines.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ltc::cli {

// The words of `text` in lines of at most `columns` characters, as far as single words allow; the
// first begins at column `first`, the others are indented to `indent`. No break at the end.
std::string wrapped(std::string_view text, std::size_t columns, std::size_t first,
                    std::size_t indent);

}  // namespace ltc::cli
