// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The layers of CONTRIBUTING.md hold: no file includes one of a layer below its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "test_paths.h"

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

// The folders of the table "Layers", top first, those of one row in its order.
std::vector<std::string> layers() {
  const std::string text = text_of(fs::path(LTCFIT_SOURCE_DIR) / "CONTRIBUTING.md");
  const std::size_t begin = text.find("\n## Layers\n"), end = text.find("\n\nAll but", begin);
  std::vector<std::string> folders;
  for (const std::string& row : matches(text.substr(begin, end - begin), "\n\\|([^|]*)\\|"))
    for (const std::string& folder : matches(row, "`src/([a-z]+)`"))
      folders.push_back(folder);
  return folders;
}

// What a file of layer `own` includes from a layer below it, or from none of the table.
std::vector<std::string> climbing(const std::vector<std::string>& layers, const std::string& own,
                                  const std::string& text) {
  std::vector<std::string> found;
  const auto place = [&](const std::string& folder) {
    return std::find(layers.begin(), layers.end(), folder);
  };
  for (const std::string& included : matches(text, "#include \"([a-z]+/[^\"]+)\"")) {
    const std::string folder = included.substr(0, included.find('/'));
    const bool is_public = folder == "ltcfit";  // include/ltcfit, which every layer may use
    if (!is_public && (place(folder) == layers.end() || place(folder) > place(own)))
      found.push_back(included);
  }
  return found;
}

TEST(Layers, NoIncludeClimbs) {
  const std::vector<std::string> folders = layers();
  const fs::path source = fs::path(LTCFIT_SOURCE_DIR) / "src";
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    if (!entry.is_regular_file())
      continue;
    ++files;
    const std::string own = *fs::relative(entry.path(), source).begin();
    ASSERT_NE(std::find(folders.begin(), folders.end(), own), folders.end())
        << "src/" << own << " is not in the table of CONTRIBUTING.md";
    for (const std::string& included : climbing(folders, own, text_of(entry.path())))
      ADD_FAILURE() << entry.path() << " includes " << included << ", which is of a layer below";
  }
  EXPECT_GT(files, 100u);  // the folder was found
}

TEST(Layers, EveryLayerOfTheTableIsThere) {
  for (const std::string& folder : layers())
    EXPECT_TRUE(fs::is_directory(fs::path(LTCFIT_SOURCE_DIR) / "src" / folder)) << folder;
}

TEST(Layers, AClimbIsFound) {
  const std::vector<std::string> folders = layers();
  EXPECT_EQ(climbing(folders, "table", "#include <vector>\n#include \"pipeline/generate.h\"\n"),
            std::vector<std::string>{"pipeline/generate.h"});
  EXPECT_EQ(climbing(folders, "table", "#include \"nosuch/file.h\"\n"),
            std::vector<std::string>{"nosuch/file.h"});
  EXPECT_TRUE(climbing(folders, "pipeline", "#include \"table/table.h\"\n").empty());
}

// What belongs into one place of the house and is found elsewhere.
std::vector<std::string> strangers(const std::string& pattern, const std::string& home) {
  const fs::path source = fs::path(LTCFIT_SOURCE_DIR) / "src";
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source))
    if (entry.is_regular_file() && fs::relative(entry.path(), source) != home &&
        !matches(text_of(entry.path()), pattern).empty())
      found.push_back(fs::relative(entry.path(), source));
  return found;
}

TEST(Layers, PlatformHeadersAreOfOneFile) {
  EXPECT_EQ(strangers("#include <((sys|linux)/[^>]*|unistd.h|fcntl.h|windows.h)>", ""),
            std::vector<std::string>{"core/platform.cpp"});
}

TEST(Layers, OpenMPIsOfOneFile) {
  EXPECT_EQ(strangers("(#pragma omp|omp_get_|#include <omp.h>)", ""),
            std::vector<std::string>{"core/parallel.h"});
}

// Options of the program in texts of the library, which others than the program show.
std::vector<std::string> options_named(const std::string& text) {
  return matches(text,
                 "\"[^\"\n]*(--[a-z][a-z-]*|ltcfit (generate|fit|diff|validate|render))[^\"\n]*\"");
}

TEST(Layers, NoTextOfTheLibraryNamesAnOption) {
  const fs::path source = fs::path(LTCFIT_SOURCE_DIR) / "src";
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source))
    if (entry.is_regular_file() && *fs::relative(entry.path(), source).begin() != "cli") {
      EXPECT_EQ(options_named(text_of(entry.path())), std::vector<std::string>{}) << entry.path();
    }
}

TEST(Layers, AnOptionIsFound) {
  EXPECT_EQ(options_named("refuse(\"go on with its --scene\");"),
            std::vector<std::string>{"--scene"});
  EXPECT_EQ(options_named("\"ltcfit fit {}\""), std::vector<std::string>{"ltcfit fit"});
  EXPECT_TRUE(options_named("\"a -- b\"; --count;").empty());
}

}  // namespace
