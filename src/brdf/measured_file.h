// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Files of measured BRDFs (docs/files.md).
#pragma once

#include <filesystem>

#include "brdf/measured.h"

namespace ltc {

// Throws IoError for a file that cannot be read, and InputError naming file and object for one that
// is no such file or not sound. Values weighted by the cosine are returned as the BRDF.
MeasuredBrdf read_brdf(const std::filesystem::path& path);

}  // namespace ltc
