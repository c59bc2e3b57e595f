// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/table_code.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"

namespace ltc {
namespace {

std::string number(double value) {
  return float_literal(static_cast<float>(value), "");
}

// One value of each axis.
template <typename Of>
std::string of_axes(const Grid& grid, std::string_view vector, Of of) {
  return fmt::format("{}({}, {}, {}, {})", vector, number(of(grid.alpha)), number(of(grid.lambda)),
                     number(of(grid.theta)), number(of(grid.phi)));
}

struct Spelling {
  std::string_view vector, open, close;
};

Spelling spelling_of(CodeLanguage language) {
  switch (language) {
    case CodeLanguage::glsl:
      return {"vec4", "const LtcTable LTC_TABLE = LtcTable(", ")"};
    case CodeLanguage::hlsl:
      return {"float4", "static const LtcTable LTC_TABLE = {", "}"};
    case CodeLanguage::wgsl:
      return {"vec4<f32>", "const LTC_TABLE: LtcTable = LtcTable(", ")"};
    default:
      throw InputError(
          fmt::format("a table's constant in {}; allowed: GLSL, HLSL or WGSL", name_of(language)));
  }
}

}  // namespace

std::string table_constant(const Grid& grid, Storage storage, CodeLanguage language,
                           const Creases& creases) {
  const Spelling spelling = spelling_of(language);
  const auto axes = [&](auto of) { return of_axes(grid, spelling.vector, of); };
  return fmt::format(
      "// What ltc_look_up is told of this table: nodes, first and last values and warps along "
      "alpha,\n// lambda, theta and phi; storage \"{}\"; alpha_min; a folded one's crease.\n{}\n   "
      " {},\n    {},\n    "
      "{},\n    {},\n    {}, {}, {}{};\n",
      name_of(storage), spelling.open,
      axes([](const Axis& axis) { return static_cast<double>(axis.size()); }),
      axes([](const Axis& axis) { return axis.first(); }),
      axes([](const Axis& axis) { return axis.last(); }),
      axes([](const Axis& axis) { return static_cast<double>(axis.warp); }),
      number(static_cast<double>(storage)), number(grid.alpha_min),
      number(creases.empty() ? 0 : creases.front()), spelling.close);
}

}  // namespace ltc
