// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/html.h"

#include <gtest/gtest.h>

#include <limits>

namespace ltc::html {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++found;
  return found;
}

TEST(Html, TextIsEscaped) {
  EXPECT_EQ(escaped("a<b & \"c\">'d' α"), "a&lt;b &amp; &quot;c&quot;&gt;&#39;d&#39; α");
  EXPECT_EQ(escaped("\xff\x01"), "\uFFFD\uFFFD");
}

TEST(Html, APictureIsWithinThePage) {
  const picture::Canvas canvas(3, 2);
  const std::string html = figure(canvas, "<dot>", "below & beside");
  // The first bytes of every PNG file in base64.
  EXPECT_NE(html.find("width=\"3\" height=\"2\" src=\"data:image/png;base64,iVBORw0KGgo"),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("alt=\"&lt;dot&gt;\""), std::string::npos);
  EXPECT_NE(html.find("<figcaption>below &amp; beside</figcaption>"), std::string::npos);
}

TEST(Html, NumbersOfATableStandToTheRight) {
  const std::string html = table({{"what", "value", "note"}, {{"a", "1", "x"}}, 1, 2});
  EXPECT_NE(html.find("<td data-head=\"what\">a</td><td class=\"number\" data-head=\"value\">1</td>"
                      "<td data-head=\"note\">x</td>"),
            std::string::npos);
  EXPECT_NE(html.find("<th class=\"number\">value</th>"), std::string::npos);
}

TEST(Html, BarsAreInProportionAndNothingIsNoBar) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string svg =
      bar_chart({"losses", {"a", "b"}, {{"table", {0.2, 0.1}}, {"floor", {0.05, nan}}}, 2});
  // The plot is 156 units high: the largest bar fills it.
  EXPECT_EQ(count(svg, " height=\"156.0\""), 1u) << svg;
  EXPECT_EQ(count(svg, " height=\"78.0\""), 1u);
  EXPECT_EQ(count(svg, " height=\"39.0\""), 1u);
  EXPECT_EQ(count(svg, "class=\"value\""), 3u);
  EXPECT_NE(svg.find(">0.05</text>"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Html, APageStandsByItself) {
  const std::string html = page("a & b", "<p>body</p>");
  EXPECT_NE(html.find("<title>a &amp; b</title>"), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
}

}  // namespace
}  // namespace ltc::html
