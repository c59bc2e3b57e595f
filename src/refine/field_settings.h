// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the config's [field] section says.
#pragma once

#include "ltc/folded.h"

namespace ltc {

struct FieldSettings {
  Creases creases = {};   // of a fold (ltc/folded.h); none: without one
  int size = 0;           // numbers of the matrix, [0, 8192]; 0: no field but a table of fits
  int albedo_size = 600;  // numbers of amplitude and Fresnel term together, [2, 2000]
  double loss = 0;   // the smallest field with at most this held-out loss is sought, [0, 1]; 0: no
  bool half = true;  // coefficients are rounded to 16 bits
  int queries = 10000;      // lobes that are fitted to, [100, 1000000]
  double edge_share = 0.1;  // of them spread over the whole domain, edges too, [0, 1]
  int steps = 12;           // most steps once the terms are chosen, [1, 1000]
};

}  // namespace ltc
