// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which ltcfit this is: version and commit of the build.
#pragma once

#include <string>
#include <string_view>

namespace ltc {

// "0.1.0".
std::string_view version();

// The git commit of the source, "-dirty" appended if it had changes; "unknown" outside of git.
std::string_view commit();

// "ltcfit 0.1.0 (1a2b3c4d5e6f)": what --version prints and a table's `generator` holds.
std::string generator();

}  // namespace ltc
