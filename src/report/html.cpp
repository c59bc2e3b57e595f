// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "picture/scale.h"
#include "picture/text.h"
#include "report/page_style.h"

namespace ltc::html {
namespace {

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

// Where a bar chart's things stand, in its own units.
struct BarLayout {
  double width = 520, height = 260;
  double left = 8, right = 512, top = 68, bottom = 224;
  double largest = 1;
  std::size_t groups = 1, series = 1;

  double group_width() const { return (right - left) / static_cast<double>(groups); }
  double bar_width() const {
    return std::min(70.0, 0.84 * group_width() / static_cast<double>(series));
  }
  double bar_left(std::size_t group, std::size_t bar) const {
    const double middle = left + (static_cast<double>(group) + 0.5) * group_width();
    return middle + (static_cast<double>(bar) - 0.5 * static_cast<double>(series)) * bar_width();
  }
  double bar_height(double value) const { return (bottom - top) * value / largest; }
};

BarLayout layout_of(const BarChart& chart) {
  BarLayout layout;
  layout.groups = std::max<std::size_t>(1, chart.groups.size());
  layout.series = std::max<std::size_t>(1, chart.series.size());
  layout.largest = 0;
  for (const BarChart::Series& series : chart.series)
    for (const double value : series.values)
      if (std::isfinite(value))
        layout.largest = std::max(layout.largest, value);
  if (layout.largest == 0)
    layout.largest = 1;
  return layout;
}

std::string legend(const BarChart& chart) {
  std::string svg;
  double x = 8;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    svg += fmt::format(
        "<rect class=\"series{}\" x=\"{:.1f}\" y=\"29\" width=\"11\" height=\"11\" rx=\"2\"/>"
        "<text class=\"faint\" x=\"{:.1f}\" y=\"39\">{}</text>\n",
        i, x, x + 17, escaped(chart.series[i].name));
    x += 36 + 7.2 * static_cast<double>(chart.series[i].name.size());
  }
  return svg;
}

std::string bar(const BarLayout& layout, std::size_t group, std::size_t series, double value,
                int decimals) {
  const double height = layout.bar_height(value), left = layout.bar_left(group, series);
  const double width = layout.bar_width();
  return fmt::format(
      "<rect class=\"series{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>"
      "<text class=\"value\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:.{}f}</text>\n",
      series, left + 1, layout.bottom - height, width - 2, height, left + width / 2,
      layout.bottom - height - 5, value, decimals);
}

}  // namespace

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
  switch (verdict) {
    case Verdict::passed:
      return "<span class=\"verdict passed\">✓ passed</span>";
    case Verdict::failed:
      return "<span class=\"verdict failed\">✗ failed</span>";
    case Verdict::not_checked:
      return "<span class=\"verdict unchecked\">– not checked</span>";
  }
  return "";
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

std::string bar_chart(const BarChart& chart) {
  const BarLayout layout = layout_of(chart);
  std::string svg = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "xmlns=\"http://www.w3.org/2000/svg\"><title>{}</title>\n"
      "<text class=\"title\" x=\"8\" y=\"17\">{}</text>\n",
      layout.width, layout.height, escaped(chart.title), escaped(chart.title));
  svg += legend(chart);
  for (std::size_t series = 0; series < chart.series.size(); ++series)
    for (std::size_t group = 0; group < chart.groups.size(); ++group)
      if (const double value = chart.series[series].values.at(group); std::isfinite(value))
        svg += bar(layout, group, series, value, chart.decimals);
  for (std::size_t group = 0; group < chart.groups.size(); ++group)
    svg += fmt::format(
        "<text class=\"label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        layout.left + (static_cast<double>(group) + 0.5) * layout.group_width(), layout.bottom + 20,
        escaped(chart.groups[group]));
  svg += fmt::format(
      "<line class=\"axis\" x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\"/>\n",
      layout.left, layout.right, layout.bottom);
  return svg + "</svg>\n";
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
