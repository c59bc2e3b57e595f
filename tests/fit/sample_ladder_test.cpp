// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Graded sample sets, the ladders made of them, and which lobes climb which.
#include "fit/sample_ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "fit/lobe_class.h"

namespace ltc {
namespace {

TEST(GradedSets, IntegrateTheClampedCosine) {
  const CosineSet set = make_graded_cosine_set(4096);
  ASSERT_EQ(set.total(), std::size_t{4096} * 4096);
  double z = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double share = set.multiplicity[i] / static_cast<double>(set.total());
    z += share * set.z[i];
    xx += share * set.x[i] * set.x[i];
    yy += share * set.y[i] * set.y[i];
  }
  // Means over the clamped cosine. Midpoints of 4096 strata: the error of z, an integral of t^2, is
  // 1/(12 n^2); azimuths of a golden-ratio lattice leave 1e-4 and less.
  EXPECT_NEAR(z, 2.0 / 3, 1e-6);
  EXPECT_NEAR(xx, 0.25, 1e-4);
  EXPECT_NEAR(yy, 0.25, 1e-4);
}

TEST(GradedSets, ReachIntoTheTailsWithLittleWeight) {
  constexpr std::size_t count = 1024;
  const GradedLattice graded = make_graded_lattice(count);
  EXPECT_NEAR(std::accumulate(graded.mass.begin(), graded.mass.end(), 0.0), 1, 1e-12);
  // 1 - u = t^2, t = 1/(2n) first; an even set ends at about 0.3/n.
  EXPECT_NEAR(graded.depth.front(), 0.25 / (count * count), 1e-12);
  EXPECT_NEAR(graded.mass.front(), 1.0 / (count * count), 1e-12);
  // A hundredth of the mass, the outermost, has a tenth of the points.
  std::size_t outer = 0;
  while (graded.depth[outer] < 0.01)
    ++outer;
  EXPECT_NEAR(static_cast<double>(outer) / count, 0.1, 1.0 / count);
}

TEST(SampleLadder, GrowsToWhatTheSettingsSay) {
  const GaussNewtonSettings settings;
  const SampleLadder usual = make_ladder(settings);
  ASSERT_EQ(usual.levels.size(), 3u);
  EXPECT_EQ(usual.coarse.cosines.size(), 256u);
  EXPECT_EQ(usual.levels[0].cosines.size(), 1024u);
  EXPECT_EQ(usual.levels[2].cosines.size(), 4096u);
  EXPECT_EQ(usual.lattice.size(), 8192u);
  EXPECT_EQ(usual.spacing, BinSpacing::even);
  // A loss of r of the spread wants 30/r samples.
  EXPECT_EQ(level_for(usual, 0.03), 0u);
  EXPECT_EQ(level_for(usual, 0.02), 1u);
  EXPECT_EQ(level_for(usual, 0.01), 2u);
  EXPECT_EQ(level_for(usual, 1e-9), 2u);

  GaussNewtonSettings steady = settings;
  steady.adaptive = false;
  EXPECT_EQ(make_ladder(steady).levels.size(), 1u);
}

TEST(SampleLadder, GradedOnesHaveGradedBins) {
  const SampleLadder graded = make_graded_ladder(GaussNewtonSettings());
  EXPECT_EQ(graded.spacing, BinSpacing::graded);
  EXPECT_EQ(graded.coarse.cosines.size(), 512u);
  ASSERT_EQ(graded.levels.size(), 1u);
  EXPECT_EQ(graded.levels[0].cosines.size(), 4096u);
  EXPECT_EQ(graded.graded_lattice.size(), 4096u);
  EXPECT_LT(graded.levels[0].options.prior_weight, DescentOptions().prior_weight);
  EXPECT_EQ(graded.coarse.options.prior_weight, graded.levels[0].options.prior_weight);
}

TEST(SampleLadder, BinsAreWholeVectors) {
  EXPECT_EQ(bins_for(64), 32u);
  EXPECT_EQ(bins_for(4096), 64u);
  EXPECT_EQ(bins_for(5000), 64u);
  EXPECT_EQ(bins_for(8192), 128u);
  EXPECT_EQ(bins_for(1 << 20), 256u);
}

TEST(LobeClass, TellsSharpAndExtremeLobes) {
  const auto frame = [](double alpha_x, double alpha_y, double theta_degrees) {
    return LobeFrame(Lobe{alpha_x, alpha_y, theta_degrees * std::numbers::pi / 180, 0.3});
  };
  EXPECT_TRUE(is_sharp(frame(0.119, 0.01, 30)));
  EXPECT_FALSE(is_sharp(frame(0.121, 0.01, 30)));
  // What the published table asks for is no extreme.
  EXPECT_FALSE(is_extreme(frame(1e-4, 1e-4, 89.991)));
  EXPECT_TRUE(is_extreme(frame(0.5, 0.99e-4, 30)));
  EXPECT_TRUE(is_extreme(frame(0.5, 0.5, 89.993)));
  // alpha over cos^2 theta, up to 2.1e-3.
  EXPECT_TRUE(first_order_is_exact(frame(2e-3, 1e-3, 0)));
  EXPECT_FALSE(first_order_is_exact(frame(2.2e-3, 1e-3, 0)));
  EXPECT_FALSE(first_order_is_exact(frame(2e-3, 1e-3, 30)));
}

}  // namespace
}  // namespace ltc
