// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/shell_quoted.h"

namespace ltc {

std::string shell_quoted(std::string_view argument) {
  constexpr std::string_view plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789@%+=:,./_-";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string_view::npos)
    return std::string(argument);
  std::string quoted = "'";
  for (const char c : argument)
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  return quoted + '\'';
}

}  // namespace ltc
