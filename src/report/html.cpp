// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "picture/text.h"
#include "report/page_style.h"

namespace ltc::html {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    const std::size_t used = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= used ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return picture::clean_utf8(result);
}

std::string figure(const picture::Canvas& picture, std::string_view text,
                   std::string_view caption) {
  std::string html =
      fmt::format("<figure><img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,",
                  escaped(text), picture.width(), picture.height());
  html += base64(picture.png_bytes()) + "\"/>";
  if (!caption.empty())
    html += fmt::format("<figcaption>{}</figcaption>", escaped(caption));
  return html + "</figure>\n";
}

std::string verdict(Verdict verdict) {
  constexpr std::pair<const char*, const char*> words[] = {{"passed", "✓ passed"},
                                                           {"failed", "✗ failed"},
                                                           {"unchecked", "– not judged"},
                                                           {"unchecked", "– not checked"}};
  const auto [style, word] = words[static_cast<std::size_t>(verdict)];
  return fmt::format("<span class=\"verdict {}\">{}</span>", style, word);
}

std::string table(const Table& table) {
  const auto row = [&](const std::vector<std::string>& cells, const char* tag, bool named) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool number = i >= table.first_number && i < table.end_number;
      // What the head says, for screens too narrow for a head.
      const std::string head =
          named && !table.head[i].empty() ? fmt::format(" data-head=\"{}\"", table.head[i]) : "";
      html += fmt::format("<{}{}{}>{}</{}>", tag, number ? " class=\"number\"" : "", head, cells[i],
                          tag);
    }
    return html + "</tr>\n";
  };
  std::string html =
      "<div class=\"wide\"><table>\n<thead>" + row(table.head, "th", false) + "</thead>\n<tbody>\n";
  for (const std::vector<std::string>& cells : table.rows)
    html += row(cells, "td", true);
  return html + "</tbody></table></div>\n";
}

std::string page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n"
      "</html>\n",
      escaped(title), page_style, body);
}

}  // namespace ltc::html
