// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The GLSL in the docs compiles for the versions that stand beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "export/files.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

struct Snippet {
  std::vector<std::string> versions;  // as #version has them
  std::string text;
};

std::vector<std::string> split_at_commas(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream >> std::ws, part, ',');)
    parts.push_back(part);
  return parts;
}

// All of a page, in their order.
std::vector<Snippet> snippets_of(const std::string& page) {
  const std::string fence = "```", opening = fence + "glsl";
  std::vector<Snippet> snippets;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);)
    if (inside && line != fence)
      snippets.back().text += line + "\n";
    else if ((inside = !inside && line.starts_with(opening)))
      snippets.push_back({split_at_commas(line.substr(opening.size())), ""});
  return snippets;
}

// With the lines of code in comments, which readers may take: three spaces after the slashes.
std::string with_commented_code(std::string text) {
  const std::string mark = "  //   ";
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
    text.replace(at, mark.size(), "  ");
  return text;
}

// What the compiler says of it; empty if nothing.
std::string complaint(const TemporaryFolder& folder, const std::string& version,
                      const std::string& text) {
  const fs::path file = folder / "snippet.frag";
  testing::write_bytes(file, "#version " + version + "\n" + text + "void main() {}\n");
  const testing::Finished finished = testing::run("glslangValidator " + file.string());
  return finished.exit_code == 0 ? "" : version + ": " + finished.output;
}

// A snippet may use those before it on its page.
TEST(GlslDocument, EverySnippetCompilesForItsVersions) {
  const TemporaryFolder folder;
  int compiled = 0;
  for (const auto& entry : fs::directory_iterator(LTCFIT_SOURCE_DIR "/docs")) {
    if (entry.path().extension() != ".md")
      continue;
    SCOPED_TRACE(entry.path());
    std::string before;
    for (const Snippet& snippet : snippets_of(testing::bytes_of(entry.path()))) {
      EXPECT_FALSE(snippet.versions.empty()) << snippet.text;
      before += snippet.text;
      for (const std::string& version : snippet.versions) {
        EXPECT_EQ(complaint(folder, version, before), "");
        EXPECT_EQ(complaint(folder, version, with_commented_code(before)), "");
        ++compiled;
      }
    }
  }
  EXPECT_GE(compiled, 8);  // two snippets, four versions
}

TEST(GlslDocument, BrokenSnippetsDoNotCompile) {
  const TemporaryFolder folder;
  const std::vector<Snippet> snippets =
      snippets_of(testing::bytes_of(LTCFIT_SOURCE_DIR "/docs/files.md"));
  ASSERT_FALSE(snippets.empty());
  const std::string good = snippets[0].text;
  EXPECT_EQ(complaint(folder, "330", good), "");
  std::string bad = good;
  bad.erase(bad.find(';'), 1);
  EXPECT_NE(complaint(folder, "330", bad), "");
  // Code in comments, too.
  EXPECT_EQ(complaint(folder, "330", good + "  //   nonsense\n"), "");
  EXPECT_NE(complaint(folder, "330", with_commented_code(good + "  //   nonsense\n")), "");
  // And what some versions allow and others do not: samplers picked by an index.
  const std::string by_index =
      "precision highp float;\nprecision highp sampler3D;\nuniform sampler3D ltc[3];\n"
      "vec4 f(int k) { return texture(ltc[k], vec3(0.0)); }\n";
  EXPECT_EQ(complaint(folder, "450", by_index), "");
  for (const char* version : {"330", "300 es"})
    EXPECT_NE(complaint(folder, version, by_index), "") << version;
}

TEST(GlslDocument, SnippetsAreFoundWithTheirVersions) {
  const std::vector<Snippet> snippets = snippets_of(
      "```sh\nls\n```\n```glsl 330, 300 es\nfloat a;\nfloat b;\n```\ntext\n```glsl\n```\n");
  ASSERT_EQ(snippets.size(), 2u);
  EXPECT_EQ(snippets[0].versions, (std::vector<std::string>{"330", "300 es"}));
  EXPECT_EQ(snippets[0].text, "float a;\nfloat b;\n");
  EXPECT_EQ(snippets[1].versions, std::vector<std::string>{});
}

}  // namespace
}  // namespace ltc
