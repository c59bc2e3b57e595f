// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A lobe model that the library does not have: GGX with light and view masked independently. It
// stands in the list of models in all these tests.
#pragma once

#include "brdf/lobe_model.h"

namespace ltc::test {

const LobeModel& separable_ggx();

}  // namespace ltc::test
