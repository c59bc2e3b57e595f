// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/version.h"

#include <fmt/format.h>

#include "revision.h"

namespace ltc {

std::string_view version() {
  return LTCFIT_VERSION;
}
std::string_view commit() {
  return LTCFIT_COMMIT;
}
std::string generator() {
  return fmt::format("ltcfit {} ({})", version(), commit());
}

}  // namespace ltc
