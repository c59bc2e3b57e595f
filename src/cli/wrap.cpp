// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/wrap.h"

#include <algorithm>
#include <sstream>

namespace ltc::cli {
namespace {

// Of UTF-8: bytes that continue a character have none of their own.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns, std::size_t first,
                    std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result, word;
  std::size_t at = first;
  bool begins_line = true;
  while (words >> word) {
    if (!begins_line && at + 1 + width(word) > columns) {
      result += '\n';
      result.append(indent, ' ');
      at = indent;
      begins_line = true;
    }
    if (!begins_line) {
      result += ' ';
      ++at;
    }
    result += word;
    at += width(word);
    begins_line = false;
  }
  return result;
}

}  // namespace ltc::cli
