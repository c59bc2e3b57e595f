// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Points as vector units take them: an array a coordinate, aligned (core/aligned.h).
#pragma once

#include <cstddef>

namespace ltc::kernels {

struct Points {
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;  // a multiple of 16
};

}  // namespace ltc::kernels
