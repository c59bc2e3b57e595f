// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The GLSL in the docs compiles for the versions that stand beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "export/files.h"
#include "export/table_code.h"

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

// What the compiler says of it after the shaders that it uses; empty if nothing.
std::string complaint(const TemporaryFolder& folder, const std::string& version,
                      const std::string& text) {
  const fs::path file = folder / "snippet.frag";
  std::string all = "#version " + version +
                    "\nprecision highp float;\nprecision highp int;\nprecision highp sampler3D;\n";
  for (const char* const name : {"lobe", "table", "polygon"})
    all += testing::bytes_of(LTCFIT_SOURCE_DIR "/shaders/glsl/ltc_" + std::string(name) + ".glsl");
  all += table_constant(Grid::paper(), Storage::matrix, CodeLanguage::glsl);
  testing::write_bytes(file, all + text + "void main() {}\n");
  const testing::Finished finished = testing::run("glslangValidator " + file.string());
  return finished.exit_code == 0 ? "" : version + ": " + finished.output;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found = {LTCFIT_SOURCE_DIR "/README.md",
                                 LTCFIT_SOURCE_DIR "/shaders/README.md"};
  for (const auto& entry : fs::directory_iterator(LTCFIT_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md")
      found.push_back(entry.path());
  return found;
}

TEST(GlslDocument, EverySnippetCompilesForItsVersions) {
  const TemporaryFolder folder;
  int compiled = 0;
  for (const fs::path& page : pages()) {
    SCOPED_TRACE(page);
    for (const Snippet& snippet : snippets_of(testing::bytes_of(page))) {
      EXPECT_FALSE(snippet.versions.empty()) << snippet.text;
      for (const std::string& version : snippet.versions) {
        EXPECT_EQ(complaint(folder, version, snippet.text), "");
        ++compiled;
      }
    }
  }
  EXPECT_GE(compiled, 2);  // one snippet, two versions
}

TEST(GlslDocument, BrokenSnippetsDoNotCompile) {
  const TemporaryFolder folder;
  const std::vector<Snippet> snippets =
      snippets_of(testing::bytes_of(LTCFIT_SOURCE_DIR "/docs/shading.md"));
  ASSERT_FALSE(snippets.empty());
  const std::string good = snippets[0].text;
  EXPECT_EQ(complaint(folder, "450", good), "");
  std::string bad = good;
  bad.erase(bad.find(';'), 1);
  EXPECT_NE(complaint(folder, "450", bad), "");
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
