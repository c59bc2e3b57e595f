// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Where tests find the published files that they compare with.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "test_paths.h"

namespace ltc::test {

// In the folder LTCFIT_REFERENCE_DIR, else in ../shared/reference beside the sources; it may be
// missing, which is a reason to skip a test, with a message.
inline std::filesystem::path reference_file(std::string_view name) {
  const char* const folder = std::getenv("LTCFIT_REFERENCE_DIR");
  return std::filesystem::path(folder ? folder : LTCFIT_SOURCE_DIR "/../shared/reference") / name;
}

}  // namespace ltc::test
