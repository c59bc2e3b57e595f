// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the TOML parser is known to be weak at, asked of the library that we link.
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <string>

namespace ltc {
namespace {

// Two or three bytes: all that a char16_t holds but surrogates.
std::string utf8(char32_t character) {
  const auto byte = [](char32_t value) { return static_cast<char>(value); };
  if (character < 0x800)
    return {byte(0xc0 | character >> 6), byte(0x80 | (character & 0x3f))};
  return {byte(0xe0 | character >> 12), byte(0x80 | (character >> 6 & 0x3f)),
          byte(0x80 | (character & 0x3f))};
}

bool is_toml(const std::string& text) {
  try {
    return !toml::parse(text).empty();
  } catch (const toml::parse_error&) {
    return false;
  }
}

// The parser marks a place as unreachable that letters such as U+01E3 reach (found by fuzzing):
// what a compiler makes of that is for the compiled library to show.
TEST(TomlFile, EveryLetterOutsideQuotesIsRefusedAndWithinThemRead) {
  for (char32_t letter = 0xa0; letter <= 0xffff; ++letter) {
    if (letter >= 0xd800 && letter <= 0xdfff)
      continue;
    ASSERT_FALSE(is_toml("a = 1 " + utf8(letter) + "\n")) << static_cast<unsigned>(letter);
    ASSERT_FALSE(is_toml("[a" + utf8(letter) + "b]\n")) << static_cast<unsigned>(letter);
  }
  EXPECT_TRUE(is_toml("a = \"" + utf8(0x1e3) + "\"\n"));
}

TEST(TomlFile, ThreeBracketsAreRefused) {
  EXPECT_FALSE(is_toml("[[[a]]]\n"));
}

}  // namespace
}  // namespace ltc
