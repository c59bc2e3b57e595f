// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// docs/files.md: its Python example gives what our own look-up gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "export/files.h"
#include "export/table_file.h"
#include "table/lookup.h"
#include "table/synthetic.h"
#include "test_paths.h"

namespace ltc {
namespace {

using testing::TemporaryFolder;

// All quadrants and both roughness orders, beyond the axes too, and the seams themselves.
std::vector<Lobe> queries() {
  std::vector<Lobe> lobes = {{0, 0, 0.3, 0.2},         {0.5, 0, 0.3, 0},
                             {0.3, 0.3, 0, 0},         {1, 1, 1.5, M_PI / 2},
                             {0.2, 0.4, 1, M_PI},      {0.4, 0.2, 1, 3 * M_PI / 2},
                             {0.00005, 0.9, 0.5, 5.0}, {0.4, 0.00001, 0.5, 2.0}};
  for (int i = 0; i < 200; ++i) {
    const auto lattice = [i](double g) { return std::fmod(0.5 + i * g, 1.0); };
    lobes.push_back({1.1 * lattice(0.8566749), 1.1 * lattice(0.7338919), 1.56 * lattice(0.6287067),
                     20 * lattice(0.5385973) - 10});
  }
  return lobes;
}

// The largest difference between the document's look-up in `file` and ours in `table`.
double largest_difference(const TemporaryFolder& folder, const Table& table) {
  nlohmann::json asked;
  for (const Lobe& lobe : queries())
    asked.push_back({lobe.alpha_x, lobe.alpha_y, lobe.theta_radians, lobe.phi_radians});
  testing::write_bytes(folder / "queries.json", asked.dump());
  const testing::Finished finished = testing::run_python(
      "documented_look_up.py", LTCFIT_SOURCE_DIR "/docs/files.md " + (folder / "t.h5").string() +
                                   " " + (folder / "queries.json").string());
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  if (finished.exit_code != 0)
    return INFINITY;
  const nlohmann::json found = nlohmann::json::parse(finished.output);
  EXPECT_EQ(found.size(), queries().size());
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const LookUp ours = look_up(table, queries()[i]);
    for (int k = 0; k < 9; ++k)
      largest = std::max(largest, std::abs(found[i][static_cast<std::size_t>(k)].get<double>() -
                                           ours.matrix(k / 3, k % 3)));
    largest = std::max(largest, std::abs(found[i][9].get<double>() - ours.amplitude));
    largest = std::max(largest, std::abs(found[i][10].get<double>() - ours.fresnel));
    EXPECT_EQ(found[i].size(), is_folded(table) ? 13u : 11u);
    if (is_folded(table)) {
      largest = std::max(largest, std::abs(found[i][11].get<double>() - ours.fold.k));
      largest = std::max(largest, std::abs(found[i][12].get<double>() - ours.fold.g));
    }
  }
  return largest;
}

TEST(FilesDocument, PythonExampleAgreesWithOurLookUp) {
  const TemporaryFolder folder;
  // Both compute in double from the same floats; the snap to a node moves a weight by 1e-9.
  constexpr double rounding = 1e-8;
  for (const auto& [grid, storage] : {std::pair{Grid::paper(4), Storage::matrix},
                                      std::pair{testing::uneven_grid(), Storage::roughness_scaled},
                                      std::pair{testing::uneven_grid(), Storage::mirror_frame},
                                      std::pair{testing::uneven_grid(), Storage::folded}}) {
    const Table table = testing::synthetic_table(grid, storage);
    write_table(table, folder / "t.h5");
    EXPECT_LT(largest_difference(folder, table), rounding) << name_of(storage);
  }
}

TEST(FilesDocument, ComparisonSeesAnotherStorage) {
  const TemporaryFolder folder;
  Table table = testing::synthetic_table(testing::uneven_grid(), Storage::roughness_scaled);
  write_table(table, folder / "t.h5");
  table.storage = Storage::mirror_frame;
  EXPECT_GT(largest_difference(folder, table), 0.1);
}

}  // namespace
}  // namespace ltc
