// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The counts and bars of a stress run, on made-up results: each can fail.
#include "stress/verdict.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Good fits from every start, at each of so many lobes.
std::vector<StressFit> good_fits(std::size_t lobes) {
  std::vector<StressFit> fits;
  for (std::size_t lobe = 0; lobe < lobes; ++lobe)
    for (std::size_t start = 0; start < stress_starts().size(); ++start) {
      StressFit fit;
      fit.lobe = lobe;
      fit.start = start;
      fit.matrix = Eigen::Matrix3d::Identity();
      fit.loss = 0.02;
      fit.ratio = 1;
      fit.steps = 10;
      fit.seconds = 0.5;
      fits.push_back(fit);
    }
  return fits;
}

constexpr std::size_t own_start = 0;
std::size_t bad_start() {
  return stress_starts().size() - 1;
}

bool misses(const StressVerdict& verdict, const std::string& part) {
  return std::any_of(verdict.missed_bars.begin(), verdict.missed_bars.end(),
                     [&](const std::string& bar) { return bar.find(part) != std::string::npos; });
}

TEST(StressVerdict, GoodFitsMissNothing) {
  const StressVerdict verdict = judge_stress(good_fits(3), 5);
  EXPECT_TRUE(verdict.missed_bars.empty());
  EXPECT_EQ(verdict.own.failures() + verdict.bad.failures(), 0u);
  EXPECT_EQ(verdict.own.fits + verdict.bad.fits, 3 * stress_starts().size());
  EXPECT_EQ(verdict.own.success_rate(), 1);
  EXPECT_EQ(verdict.own.mean_steps, 10);
  EXPECT_EQ(verdict.bad.mean_seconds, 0.5);
}

TEST(StressVerdict, EveryCounterCanFail) {
  for (const bool own : {true, false}) {
    const std::size_t start = own ? own_start : bad_start();
    const std::string starts = own ? "own" : "bad";
    const auto with = [&](auto&& spoil) {
      std::vector<StressFit> fits = good_fits(3);
      spoil(fits.at(stress_starts().size() + start));
      return judge_stress(fits, 5);
    };
    const auto counts = [&](const StressVerdict& v) { return own ? v.own : v.bad; };

    for (const StressVerdict& verdict :
         {with([](StressFit& fit) { fit.matrix(1, 2) = nan; }),
          with([](StressFit& fit) { fit.loss = nan; }),
          with([](StressFit& fit) { fit.outcome = FitOutcome::non_finite; })}) {
      EXPECT_EQ(counts(verdict).non_finite, 1u);
      EXPECT_EQ(counts(verdict).failures(), 1u);
      EXPECT_TRUE(misses(verdict, "from " + starts + " starts are not finite"));
      EXPECT_EQ(verdict.by_start[start].non_finite, 1u);
      EXPECT_EQ(verdict.worst.front(), stress_starts().size() + start);
    }

    for (const double determinant : {-1.0, 0.0}) {
      const StressVerdict verdict = with([&](StressFit& fit) { fit.matrix(0, 0) = determinant; });
      EXPECT_EQ(counts(verdict).determinants_not_positive, 1u);
      EXPECT_EQ(counts(verdict).non_finite, 0u);
      EXPECT_TRUE(misses(verdict, "from " + starts + " starts have a determinant <= 0"));
      EXPECT_EQ(verdict.worst.front(), stress_starts().size() + start);
    }

    EXPECT_EQ(
        counts(with([](StressFit& fit) { fit.one_to_one = false; })).determinants_not_positive, 1u);

    const StressVerdict verdict = with([](StressFit& fit) { fit.ratio = 1.06; });
    EXPECT_EQ(counts(verdict).missed, 1u);
    EXPECT_EQ(counts(verdict).largest_ratio, 1.06);
    EXPECT_EQ(misses(verdict, "from own starts are above 1.05 times the best"), own);
    EXPECT_EQ(misses(verdict, "from bad starts succeed"), !own) << "1 of 42 is above 0.1 %";
    EXPECT_EQ(counts(with([](StressFit& fit) { fit.ratio = 1.05; })).missed, 0u);
  }
}

TEST(StressVerdict, OneBadStartInAThousandMayMiss) {
  std::vector<StressFit> fits = good_fits(100);  // 1400 from bad starts
  fits[bad_start()].ratio = 2;
  EXPECT_TRUE(judge_stress(fits, 5).missed_bars.empty());
  fits[2 * stress_starts().size() - 1].ratio = 2;
  EXPECT_TRUE(misses(judge_stress(fits, 5), "from bad starts succeed"));
}

TEST(StressVerdict, NoFitsIsNoSuccess) {
  EXPECT_TRUE(misses(judge_stress({}, 5), "no fits"));
}

TEST(StressVerdict, NamesTheWorstOfEachLobeFirst) {
  std::vector<StressFit> fits = good_fits(3);
  const std::size_t starts = stress_starts().size();
  fits[1].ratio = 3;
  fits[2].ratio = 2;  // of the same lobe
  fits[starts].ratio = 4;
  fits[2 * starts].matrix.setConstant(nan);
  const std::vector<std::size_t> expected = {2 * starts, starts};
  EXPECT_EQ(judge_stress(fits, 2).worst, expected);
  EXPECT_EQ(judge_stress(fits, 9).worst.size(), 3u);
}

// ---- What the best is ----

TEST(StressRatios, AreOverTheLeastOfGoodMatrices) {
  std::vector<StressFit> fits = good_fits(1);
  fits[0].loss = 0.03;
  fits[1].loss = 0.001;
  fits[1].matrix(0, 0) = -1;  // a determinant below zero sets no mark
  fits[2].loss = nan;
  EXPECT_EQ(set_ratios(fits, nan, 0), 0.02);
  EXPECT_DOUBLE_EQ(fits[0].ratio, 1.5);
  EXPECT_TRUE(std::isnan(fits[2].ratio));
  EXPECT_DOUBLE_EQ(fits[3].ratio, 1);
  EXPECT_EQ(set_ratios(fits, 0.01, 0), 0.01) << "the reference's";
  EXPECT_DOUBLE_EQ(fits[3].ratio, 2);
}

// Folds are measured against the LTC, not against each other.
TEST(StressRatios, TheReferenceAloneCanBeTheMeasure) {
  std::vector<StressFit> fits = good_fits(1);
  fits[0].loss = 0.005;
  EXPECT_EQ(set_ratios(fits, 0.01, 0, true), 0.01);
  EXPECT_DOUBLE_EQ(fits[0].ratio, 0.5);
  EXPECT_DOUBLE_EQ(fits[1].ratio, 2);
}

TEST(StressRatios, NoiseCountsAsEqual) {
  std::vector<StressFit> fits = good_fits(1);
  fits[0].loss = 0.03;
  set_ratios(fits, 0.01, 0.025);
  EXPECT_DOUBLE_EQ(fits[0].ratio, 0.03 / 0.025);
  EXPECT_DOUBLE_EQ(fits[1].ratio, 1);
}

}  // namespace
}  // namespace ltc
