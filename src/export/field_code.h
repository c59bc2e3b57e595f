// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A field as a function in C, JavaScript, GLSL, HLSL and WGSL: one description, five spellings.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/enum_names.h"
#include "field/field.h"

namespace ltc {

enum class CodeLanguage { c, javascript, glsl, hlsl, wgsl };
constexpr EnumNames<CodeLanguage, 5> enum_names(CodeLanguage) {
  return {"language",
          {{{CodeLanguage::c, "C"},
            {CodeLanguage::javascript, "JavaScript"},
            {CodeLanguage::glsl, "GLSL"},
            {CodeLanguage::hlsl, "HLSL"},
            {CodeLanguage::wgsl, "WGSL"}}}};
}

// A float as these languages write it: with a point, and `suffix` behind.
std::string float_literal(float value, std::string_view suffix);

// The statements that make, of `alpha_x`, `alpha_y` and the view (`vx`, `vy`, `vz`), floats that
// are there already and in any quadrant and order, the matrix m00 ... m22 (clamped cosine to lobe,
// positive determinant), `amplitude` and `fresnel`; of a folded field, with one pair of creases,
// also `fold_k`, `fold_g` and `fold_h`. Sums are nested: each power is multiplied once.
std::string field_statements(const Field& field, CodeLanguage language);

// How many multiplications that takes, square roots, quotients and the power aside.
std::size_t field_multiplications(const Field& field);

// A file with a function of the roughnesses and the view (unit length, tangent frame): of GLSL,
// HLSL, WGSL and JavaScript, whose comment says how it is called: ltcLookUp, or ltcLookUpFolded.
// Throws InputError for C, whose header is another format's. A folded field has one pair of
// creases.
std::string field_function(const Field& field, CodeLanguage language);

}  // namespace ltc
