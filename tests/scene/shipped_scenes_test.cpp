// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The scenes that come with the program, and what docs/scenes.md says of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "config/config.h"
#include "fit/symmetry_plan.h"
#include "scene/coverage.h"
#include "scene/scene.h"
#include "support/reference.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

struct Counts {
  std::size_t needed = 0, fitted = 0, copied = 0, skipped = 0;
};

Counts counts_of(const fs::path& scene) {
  const Grid grid = load_config(std::nullopt, {}).grid;
  const auto needed = needed_entries(load_scene(scene), grid);
  const auto plan = plan_by_symmetry(grid, needed);
  Counts counts;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const bool fitted = plan[flat].representative == flat;
    counts.needed += needed[flat];
    counts.fitted += fitted;
    counts.copied += needed[flat] && !fitted;
    counts.skipped += !needed[flat];
  }
  return counts;
}

const fs::path source_folder = LTCFIT_SOURCE_DIR;

TEST(ShippedScenes, TheDocumentSaysWhatEachNeeds) {
  const std::string document = test::read_file(source_folder / "docs/scenes.md");
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(source_folder / "config/scenes")) {
    const Counts counts = counts_of(entry.path());
    const std::string row =
        fmt::format("| config/scenes/{} | {} | {} | {} | {} |\n", entry.path().filename().string(),
                    counts.needed, counts.fitted, counts.copied, counts.skipped);
    EXPECT_NE(document.find(row), std::string::npos) << "not in docs/scenes.md: " << row;
    ++scenes;
  }
  EXPECT_GE(scenes, 3);
}

TEST(ShippedScenes, NeedWhatTheirNamesSay) {
  EXPECT_EQ(counts_of(source_folder / "config/scenes/brushed-metal.toml").needed, 2u * 2 * 8 * 8);
  EXPECT_EQ(counts_of(source_folder / "config/scenes/isotropic-game.toml").needed, 8u * 8 * 8);
  EXPECT_EQ(counts_of(source_folder / "config/scenes/isotropic-game.toml").fitted, 64u);
  EXPECT_EQ(counts_of(source_folder / "config/scenes/everything.toml").skipped, 0u);
}

// Roughness and strength from 0 to 1, each by a texture: all (alpha, lambda) there are.
TEST(ShippedScenes, TheBarnLampNeedsEverything) {
  const fs::path file = test::reference_file("gltf/AnisotropyBarnLamp.gltf");
  if (!fs::exists(file))
    GTEST_SKIP() << "no " << file << "; set LTCFIT_REFERENCE_DIR to the folder that has it";
  EXPECT_EQ(counts_of(file).skipped, 0u);
}

}  // namespace
}  // namespace ltc
