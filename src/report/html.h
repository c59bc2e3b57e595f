// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Parts of an HTML page that stands by itself: pictures within, no scripts, no network; readable in
// light and dark.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "picture/canvas.h"

namespace ltc::html {

// Text with &, <, >, " and ' as entities, and bytes that no page may hold replaced: XML reads it.
std::string escaped(std::string_view text);

// Bytes as a data URL has them.
std::string base64(std::string_view bytes);

// A picture with its words; `text` is what is read aloud instead of it. Both plain text.
std::string figure(const picture::Canvas& picture, std::string_view text,
                   std::string_view caption = {});

// Whether a check went well, as a word with a colour.
enum class Verdict { passed, failed, not_judged, not_checked };
std::string verdict(Verdict verdict);

// A table of cells that are HTML already, as is its head; on narrow screens its rows are lists.
// Columns from `first_number` to before `end_number` hold numbers and are set to the right.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::size_t first_number = 0, end_number = 0;
};
std::string table(const Table& table);

// The whole page; `body` is HTML.
std::string page(std::string_view title, std::string_view body);

}  // namespace ltc::html
