// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A field that no fit made: small, of every part, regular over most of the domain.
#pragma once

#include <algorithm>
#include <vector>

#include "field/field.h"

namespace ltc::testing {

using FieldTerms = std::vector<std::pair<FieldTerm, float>>;

inline Field field_of(FieldTerms terms) {
  std::sort(terms.begin(), terms.end());
  Field field;
  for (const auto& [term, coefficient] : terms) {
    field.terms.push_back(term);
    field.coefficients.push_back(coefficient);
  }
  return field;
}

inline FieldTerms synthetic_terms() {
  using P = FieldPart;
  return {
      {{P::a, 0, 0, 0, 0, 0}, 1.8f},           {{P::a, 1, 0, 2, 0, 0}, -0.05f},
      {{P::b, 0, 0, 1, 1, 0}, 0.1f},           {{P::c, 0, 0, 0, 0, 0}, 0.5f},
      {{P::d, 0, 0, 0, 1, 0}, -0.4f},          {{P::m00, 1, 1, 0, 0, 0}, 0.1f},
      {{P::m00, 0, 2, 3, 1, 4}, 0.05f},        {{P::m01, 0, 1, 0, 0, 2}, 0.2f},
      {{P::m02, 2, 1, 0, 0, 1}, 0.1f},         {{P::m02, 0, 1, 1, 0, 3}, 0.03f},
      {{P::m10, 0, 3, 0, 2, 2}, -0.1f},        {{P::m11, 0, 1, 0, 0, 0}, -0.2f},
      {{P::m12, 0, 1, 0, 1, 1}, 0.2f},         {{P::m20, 1, 1, 0, 0, 1}, 0.2f},
      {{P::m21, 0, 2, 0, 0, 5}, -0.1f},        {{P::amplitude, 0, 0, 0, 0, 0}, 0.8f},
      {{P::amplitude, 0, 1, 1, 2, 2}, 0.05f},  {{P::view_cosine, 0, 0, 1, 0, 0}, 0.3f},
      {{P::view_cosine, 0, 0, 0, 0, 0}, 0.4f},
  };
}

inline Field synthetic_field() {
  return field_of(synthetic_terms());
}

// The same folded: k of both signs and up to 10, g from -1.4 to beyond what it is bounded by.
inline Field synthetic_folded_field(const Creases& creases = usual_creases) {
  using P = FieldPart;
  FieldTerms terms = synthetic_terms();
  terms.insert(terms.end(), {{{P::kappa, 0, 1, 0, 0, 1}, -0.8f},
                             {{P::kappa, 1, 2, 0, 0, 3}, 0.3f},
                             {{P::gamma, 0, 1, 0, 0, 0}, 0.6f},
                             {{P::gamma, 0, 1, 1, 0, 0}, 2.0f},
                             {{P::gamma, 0, 1, 0, 1, 2}, 0.2f}});
  Field field = field_of(terms);
  field.creases = creases;
  return field;
}

}  // namespace ltc::testing
