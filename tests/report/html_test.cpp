// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/html.h"

#include <gtest/gtest.h>

namespace ltc::html {
namespace {

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
