// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The time that a table's files state.
#pragma once

#include <string>

namespace ltc::cli {

// UTC, ISO 8601: now or, for files that are to be the same bytes again, what SOURCE_DATE_EPOCH in
// the environment says in seconds since 1970 (reproducible-builds.org). Throws InputError where it
// holds anything else.
std::string creation_time();

}  // namespace ltc::cli
