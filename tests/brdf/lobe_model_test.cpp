// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Models behind one interface: chosen by name, fitted, judged and stored as GGX is.
#include "brdf/lobe_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "brdf/ggx.h"
#include "brdf/separable_ggx.h"
#include "config/config.h"
#include "core/error.h"
#include "export/table_file.h"
#include "fit/lobe_frame.h"
#include "judge/held_out.h"
#include "pipeline/generate.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"
#include "table/lookup.h"

namespace ltc {
namespace {

const std::vector<Lobe> lobes = {
    {0.9, 0.3, 1.3, 0.4}, {0.5, 0.5, 0.2, 0.0}, {0.2, 0.05, 1.5, 1.2}, {0.02, 0.02, 0.8, 0.3}};

Lobe separable(Lobe lobe) {
  lobe.model = &test::separable_ggx();
  return lobe;
}

// All that the interface asks for, and all else left to it.
class GgxBySampler final : public LobeModel {
 public:
  std::string_view name() const override { return "ggx by its sampler"; }
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    return std::make_unique<GgxSampler>(lobe);
  }
};

TEST(LobeModel, IsFoundByItsName) {
  EXPECT_EQ(&lobe_model("ggx"), &ggx());
  EXPECT_EQ(&lobe_model("separable-ggx"), &test::separable_ggx());
  const std::string message = test::message_of<InputError>([] { lobe_model("phong"); });
  test::expect_one_line(message, {"\"phong\"", "ggx", "separable-ggx"});
}

TEST(LobeModel, WhatItDoesNotGiveFollowsFromItsSampler) {
  const GgxBySampler slow;
  const TargetLattice lattice = make_target_lattice(256);
  const AlbedoRule rule;
  for (const Lobe& lobe : lobes) {
    TargetSamples fast_samples, slow_samples;
    const LobeFrame frame(lobe);
    fast_samples.reserve(lattice.size());
    slow_samples.reserve(lattice.size());
    ggx().sample_target(lobe, frame.rotation, lattice, fast_samples);
    slow.sample_target(lobe, frame.rotation, lattice, slow_samples);
    // Single against double precision: a few roundings, of offsets up to 2 and of weights up to 1.
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      EXPECT_NEAR(fast_samples.gx[i], slow_samples.gx[i], 2e-6);
      EXPECT_NEAR(fast_samples.gy[i], slow_samples.gy[i], 2e-6);
      EXPECT_NEAR(fast_samples.gz[i], slow_samples.gz[i], 2e-6);
      EXPECT_NEAR(fast_samples.weight[i], slow_samples.weight[i], 2e-5);
    }
    const Albedo fast = ggx().albedo(lobe, rule), by_sampler = slow.albedo(lobe, rule);
    EXPECT_NEAR(fast.amplitude, by_sampler.amplitude, 1e-5);
    EXPECT_NEAR(fast.fresnel, by_sampler.fresnel, 1e-5);
  }
}

TEST(LobeModel, ASamplersWeightsAreItsDensities) {
  for (const Lobe& lobe : lobes) {
    const auto sampler = test::separable_ggx().sampler(lobe);
    WeightedSamples all;
    const SampleLattice lattice(64, 0.3, 0.7);
    sampler->sample_all(lattice, all);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      const LobeSample sample =
          sampler->sample(lattice.cos_azimuth[i], lattice.sin_azimuth[i], lattice.height[i]);
      const LobeDensities densities = sampler->densities(sample.omega_l);
      EXPECT_NEAR(densities.brdf_cosine, sample.weight * densities.sampling,
                  1e-12 * densities.sampling);
      EXPECT_EQ(all.weight[static_cast<Eigen::Index>(i)], sample.weight);
    }
  }
}

TEST(LobeModel, ItsTablesAreFittedRefinedJudgedAndStored) {
  const Config config = parse_config(
      "table.brdf = \"separable-ggx\"\n"
      "table.alpha = {first = 0.3, last = 1, nodes = 3}\n"
      "table.lambda = {first = 0.5, last = 1, nodes = 2}\n"
      "table.theta = {nodes = 4}\ntable.phi = {nodes = 2}\n"
      "refine = {steps = 2, held_out_queries = 100}\n",
      "test.toml", {});
  const Table table = generate_table(config, {2});
  Config of_ggx = config;
  of_ggx.grid.model = &ggx();
  const Table other = generate_table(of_ggx, {2});

  EXPECT_TRUE(std::all_of(table.status.begin(), table.status.end(), has_values));
  double own = 0, foreign = 0;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const Lobe lobe = table.grid.lobe(table.grid.node(flat));
    ASSERT_EQ(lobe.model, &test::separable_ggx());
    HeldOutJudge judge(4096, 32);
    judge.set_lobe(lobe);
    own += judge.loss(table.matrix_at(flat)) / judge.spread();
    foreign += judge.loss(other.matrix_at(flat)) / judge.spread();
    // G1(v) G1(l) <= G2(v, l): less light than GGX, at the horizon most.
    EXPECT_LE(table.amplitude[flat], other.amplitude[flat] + 1e-6f);
  }
  EXPECT_LT(own, 0.9 * foreign);  // the lobes differ, and each table is nearer to its own

  const test::TemporaryDirectory folder;
  write_table(table, folder / "t.h5");
  EXPECT_EQ(read_table(folder / "t.h5").grid.model, &test::separable_ggx());
}

TEST(LobeModel, AQueryKeepsTheModel) {
  Grid grid = Grid::paper(4);
  grid.model = &test::separable_ggx();
  for (const Lobe& lobe : lobes)
    EXPECT_EQ(Reduction(grid).fold(separable(lobe)).lobe.model, &test::separable_ggx());
}

}  // namespace
}  // namespace ltc
