// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/key.h"

namespace ltc::config {

Key file_name_key(std::string name, std::string* (*member)(Draft&), std::string summary) {
  constexpr std::size_t longest = 100;
  return {
      std::move(name),
      "a file name of at most 100 letters, digits, '.', '_' and '-', not starting with '.' or '-'",
      std::move(summary),
      [=](Draft& draft, const Value& value) {
        constexpr std::string_view letters =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
        const auto* text = std::get_if<std::string>(&value);
        if (!text || text->empty() || text->size() > longest || text->front() == '.' ||
            text->front() == '-' || text->find_first_not_of(letters) != std::string::npos)
          return false;
        *member(draft) = *text;
        return true;
      },
      [=](const Draft& draft) -> Value { return get_member<std::string>(member, draft); }};
}

}  // namespace ltc::config
