// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The fit of a field: the gradient of its system, the choice of terms, and a small field made.
#include "refine/field_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.h"
#include "field/synthetic_field.h"
#include "refine/field_system.h"
#include "refine/field_terms.h"
#include "table/queries.h"

namespace ltc {
namespace {

FieldSettings quick_settings() {
  FieldSettings settings;
  settings.size = 96;
  settings.albedo_size = 60;
  settings.queries = 1000;
  settings.steps = 3;
  return settings;
}

RefineSettings quick_judging() {
  RefineSettings judging;
  judging.held_out_queries = 300;
  return judging;
}

Field quick_field(const FieldSettings& settings, int threads, FieldReport* report = nullptr) {
  return fit_field(1e-4, ggx(), {QueryRange{}}, settings, quick_judging(), {threads}, report);
}

// x^T G x / 2 - r^T x where only some terms are kept, at its minimum.
double minimum_over(const Eigen::MatrixXd& g, const Eigen::VectorXd& r,
                    const std::vector<Eigen::Index>& kept) {
  const Eigen::MatrixXd part = g(kept, kept);
  const Eigen::VectorXd right = r(kept);
  return -0.5 * right.dot(Eigen::VectorXd(part.llt().solve(right)));
}

TEST(FieldTerms, ThePoolHasWhatIsAllowedInOrder) {
  const std::vector<FieldTerm> pool = matrix_pool(4);
  EXPECT_TRUE(std::is_sorted(pool.begin(), pool.end()));
  EXPECT_TRUE(std::all_of(pool.begin(), pool.end(), is_allowed));
  EXPECT_EQ(std::adjacent_find(pool.begin(), pool.end()), pool.end());
  EXPECT_GE(matrix_pool_of_size(500).size(), 500u);
}

TEST(FieldTerms, TakesAwayWhatCostsLeast) {
  // Nearly parallel first two: either can stand for both, the third for none.
  Eigen::MatrixXd g(3, 3);
  g << 1, 0.99, 0.1, 0.99, 1, 0.1, 0.1, 0.1, 1;
  const Eigen::VectorXd r = g * Eigen::Vector3d(1, 0.05, 2);
  const std::vector<bool> kept = terms_to_keep(g, r, 2);
  EXPECT_EQ(kept, (std::vector<bool>{true, false, true}));
  double best = 0;
  for (const auto& pair : {std::vector<Eigen::Index>{0, 1}, {0, 2}, {1, 2}})
    best = std::min(best, minimum_over(g, r, pair));
  EXPECT_DOUBLE_EQ(minimum_over(g, r, {0, 2}), best);
}

// Of the loss along the gradient, by differences.
double gradient_ratio(const Creases& creases) {
  WeightedLobes lobes;
  lobes.lobes = lattice_queries(QueryRange{}, 0, 40, 1e-4);
  lobes.weights.assign(40, 1.0 / 40);
  QuerySampling sampling;
  sampling.samples = 4096;
  FieldSystem system(lobes, 1e-4, creases, sampling, 0);
  std::vector<FieldTerm> terms = matrix_pool(2, !creases.empty());
  system.set_terms(terms, {});
  Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms.size()));
  at[0] = 1.7;
  // A bend, of both numbers.
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (is_of_fold(terms[i].part) && terms[i].lambda == 1)
      at[static_cast<Eigen::Index>(i)] = terms[i].part == FieldPart::kappa ? -0.8 : 0.3;
  system.evaluate(at, {});
  system.adopt();
  system.evaluate(at, {});  // smoothed by the loss itself
  system.adopt();
  const Eigen::VectorXd gradient = system.equations({}).gradient;
  const Eigen::VectorXd step = -1e-3 * gradient / gradient.norm();
  const double change = system.evaluate(at + step, {}) - system.evaluate(at - step, {});
  return change / (2 * gradient.dot(step));
}

TEST(FieldSystem, TheGradientIsThatOfTheLoss) {
  // The model's smoothing and the samples' noise leave a tenth.
  EXPECT_NEAR(gradient_ratio({}), 1, 0.1);
  EXPECT_NEAR(gradient_ratio(usual_creases), 1, 0.1);
  EXPECT_NEAR(gradient_ratio(two_pairs_of_creases), 1, 0.1);
}

TEST(FieldFit, ASmallFieldIsNearerThanThePublishedTable) {
  FieldReport report;
  const Field field = quick_field(quick_settings(), 2, &report);
  EXPECT_EQ(field.terms.size(), 96u + 60u);
  // 0.095 is found, the published table has 0.117, each with a standard error of 5 %.
  EXPECT_LT(report.loss, 0.105);
  // Of so few numbers, 0.021 and 0.011.
  EXPECT_LT(report.amplitude_error, 0.03);
  EXPECT_LT(report.fresnel_error, 0.016);
  for (const float coefficient : field.coefficients)
    EXPECT_EQ(coefficient, static_cast<float>(Eigen::half(coefficient)));
}

TEST(FieldFit, AFoldedFieldIsNearerThanOneWithoutAFold) {
  FieldSettings settings = quick_settings();
  FieldReport plain, folded;
  quick_field(settings, 2, &plain);
  settings.creases = {0.4};
  const Field field = quick_field(settings, 2, &folded);
  EXPECT_EQ(field.creases, usual_creases);
  // Found: a third less with 96 numbers.
  EXPECT_LT(folded.loss, 0.85 * plain.loss);
  for (const double lambda : {0.0, 0.3, 1.0}) {
    const FieldLobe found = lobe_of(field, {0.8, lambda * 0.8, 1.2, 0.7});
    EXPECT_TRUE(is_one_to_one(found.fold, field.creases));
    EXPECT_EQ(found.fold == Fold{}, lambda == 1);
  }
  settings.creases = two_pairs_of_creases;
  EXPECT_EQ(quick_field(settings, 2).creases, two_pairs_of_creases);
  // In the plane of alpha_x nothing bends to a side.
  EXPECT_EQ(lobe_of(field, {0.8, 0.2, 1.2, 0}).fold.k, 0);
}

TEST(FieldFit, GivesTheSameBitsForAnyNumberOfThreads) {
  EXPECT_EQ(quick_field(quick_settings(), 1), quick_field(quick_settings(), 3));
  FieldSettings folded = quick_settings();
  folded.creases = usual_creases;
  EXPECT_EQ(quick_field(folded, 1), quick_field(folded, 3));
}

TEST(FieldFit, FindsASmallerFieldWhereALossIsAskedFor) {
  FieldSettings settings = quick_settings();
  settings.loss = 0.15;
  FieldReport report;
  const Field field = quick_field(settings, 2, &report);
  EXPECT_LT(field.terms.size(), 96u + 60u);
  EXPECT_LE(report.loss, 0.15);
  settings.loss = 0.01;  // below what any LTC can do
  EXPECT_THROW(quick_field(settings, 2), CheckFailure);
}

TEST(FieldFit, StopsWhenAsked) {
  StopOnly progress;
  progress.request_stop();
  EXPECT_THROW(
      fit_field(1e-4, ggx(), {QueryRange{}}, quick_settings(), quick_judging(), {2, &progress}),
      Interrupted);
}

}  // namespace
}  // namespace ltc
