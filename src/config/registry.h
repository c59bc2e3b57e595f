// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The config's keys. One line a key in registry.cpp says its name, the member it sets, what is
// allowed and what it means; reading, checking, printing and listing follow from that line.
#pragma once

#include <vector>

#include "config/key.h"

namespace ltc::config {

// All keys, in the order of the file; the keys of one section stand together.
const std::vector<Key>& keys();

}  // namespace ltc::config
