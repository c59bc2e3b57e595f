// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/gradient_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/lobes.h"
#include "fit/starting_points.h"

namespace ltc {
namespace {

// A lobe's loss on a small set: 64 cosine samples, 128 weighted target samples, 8 directions.
struct Problem {
  explicit Problem(const Lobe& lobe)
      : omega_o(test::in_double(make_cosine_set(64))), loss(make_loss(LobeFrame(lobe))) {
    // Not at a minimum: the moment start, moved.
    Eigen::Matrix3d p = LobeFrame(lobe).first_order;
    p(0, 0) *= 1.3;
    p(0, 1) += 0.2;
    p(1, 2) += 0.1 * lobe.alpha_y;
    p(2, 1) -= 0.15;
    matrix = p * Eigen::Vector3d(lobe.alpha_x, lobe.alpha_y, 1).asDiagonal();
  }

  std::vector<Eigen::Vector3d> omega_o;
  std::vector<Eigen::Vector3d> directions = fibonacci_directions(8);
  SlicedWassersteinLoss loss;
  Eigen::Matrix3d matrix;  // in the mirror's frame, where the target is

 private:
  SlicedWassersteinLoss make_loss(const LobeFrame& frame) const {
    TargetSamples target;
    sample_weighted_target(frame, make_target_lattice(128, 0.3), target);
    return SlicedWassersteinLoss(omega_o, test::in_double(target), fibonacci_directions(8));
  }
};

TEST(GradientCheck, PassesTheGradientByHand) {
  for (const Lobe& lobe : test::all_lobes()) {
    const Problem problem(lobe);
    const LossAndGradient value = problem.loss(problem.matrix);
    const GradientCheck check = check_gradient(problem.loss, problem.matrix, value.gradient);
    // Measured: 3e-9 on ordinary lobes, 1.6e-6 at alpha 1e-6, where the kinks leave room for steps
    // of 1e-10 only and the rounding of the loss, 1e-17, shows. Stated: 1e-6, the default, and
    // 1e-5 there.
    if (std::max(lobe.alpha_x, lobe.alpha_y) > 1e-5)
      EXPECT_TRUE(check.passed) << test::describe(lobe) << ": " << check.describe();
    else
      EXPECT_LT(check.largest_relative_error, 1e-5) << test::describe(lobe);
  }
}

TEST(GradientCheck, RejectsOneWrongSign) {
  for (const Lobe& lobe : test::all_lobes()) {
    const Problem problem(lobe);
    const Eigen::Matrix3d right = problem.loss(problem.matrix).gradient;
    for (int column = 0; column < 3; ++column) {
      // The column's largest entry: the others may be too small to matter, or zero.
      int row = 0;
      right.col(column).cwiseAbs().maxCoeff(&row);
      Eigen::Matrix3d wrong = right;
      wrong(row, column) = -wrong(row, column);
      const GradientCheck check = check_gradient(problem.loss, problem.matrix, wrong);
      EXPECT_FALSE(check.passed) << test::describe(lobe);
      EXPECT_NEAR(check.largest_relative_error, 2, 1e-4) << test::describe(lobe);
      EXPECT_EQ(check.worst_row, row);
      EXPECT_EQ(check.worst_column, column);
    }
  }
}

TEST(GradientCheck, RejectsAFactorOfOnePerCent) {
  for (const Lobe& lobe : test::all_lobes()) {
    const Problem problem(lobe);
    const Eigen::Matrix3d right = problem.loss(problem.matrix).gradient;
    const GradientCheck check = check_gradient(problem.loss, problem.matrix, 1.01 * right);
    EXPECT_FALSE(check.passed) << test::describe(lobe);
    EXPECT_NEAR(check.largest_relative_error, 0.01 / 1.01, 1e-4) << test::describe(lobe);
  }
}

// Equation (10)'s gradient for a target of as many equally weighted points, sample by sample and
// rank by rank; with or without the term -x f that the normalisation of M omega brings.
Eigen::Matrix3d gradient_by_rank(const Problem& problem, const PointSet& target,
                                 bool with_normalisation) {
  const std::size_t count = problem.omega_o.size();
  std::vector<Eigen::Vector3d> f;
  for (const Eigen::Vector3d& omega : problem.omega_o)
    f.push_back((problem.matrix * omega).normalized());
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : problem.directions) {
    std::vector<double> quantiles;
    for (const Eigen::Vector3d& point : target.points)
      quantiles.push_back(d.dot(point));
    std::sort(quantiles.begin(), quantiles.end());
    for (std::size_t i = 0; i < count; ++i) {
      const double x = d.dot(f[i]);
      const auto rank =
          std::count_if(f.begin(), f.end(), [&](const Eigen::Vector3d& o) { return d.dot(o) < x; });
      const double sign = x > quantiles[static_cast<std::size_t>(rank)] ? 1 : -1;
      const Eigen::Vector3d across = with_normalisation ? (d - x * f[i]).eval() : d;
      gradient += sign * across * problem.omega_o[i].transpose() /
                  (problem.matrix * problem.omega_o[i]).norm();
    }
  }
  return gradient / static_cast<double>(count * problem.directions.size());
}

TEST(GradientCheck, RejectsAMissingNormalisationTerm) {
  for (const Lobe& lobe : test::all_lobes()) {
    const Problem problem(lobe);
    // Nowhere near the lobe's own LTC, so that the term does not average out.
    PointSet target;
    for (const Eigen::Vector3d& omega : test::in_double(make_cosine_set(64, 0.4)))
      target.points.push_back(omega);
    const SlicedWassersteinLoss loss(problem.omega_o, target, problem.directions);
    const Eigen::Matrix3d right = gradient_by_rank(problem, target, true);
    // The same sum of 512 terms in another order; rows of M omega of 1e-6 cost no digits.
    EXPECT_LT((loss(problem.matrix).gradient - right).cwiseAbs().maxCoeff(), 1e-13)
        << test::describe(lobe);
    // The loss is of the order of one here, and rounds by 1e-16, however narrow the lobe.
    const GradientCheckOptions options{1e-6, 6, 1e-4};
    EXPECT_TRUE(check_gradient(loss, problem.matrix, right, options).passed)
        << test::describe(lobe);
    const GradientCheck check =
        check_gradient(loss, problem.matrix, gradient_by_rank(problem, target, false), options);
    EXPECT_FALSE(check.passed) << test::describe(lobe);
    EXPECT_GT(check.largest_relative_error, 0.05) << test::describe(lobe);
  }
}

TEST(GradientCheck, SaysWhereATieIs) {
  // The target is the transformed set itself: every sample meets its partner, and the loss has a
  // kink at M in every entry.
  const Problem problem({0.5, 0.3, 0.5, 0.5});
  PointSet target;
  for (const Eigen::Vector3d& omega : problem.omega_o)
    target.points.push_back((problem.matrix * omega).normalized());
  const SlicedWassersteinLoss loss(problem.omega_o, target, problem.directions);
  const GradientCheck check = check_gradient(loss, problem.matrix, loss(problem.matrix).gradient);
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.undecided_count(), 9);
  EXPECT_NE(check.describe().find("9 of 9 entries undecided"), std::string::npos);
}

TEST(GradientCheck, FindsAKinkInsideALongStep) {
  // A step of half a column sees many samples pass their partners.
  const Problem problem({0.5, 0.3, 0.5, 0.5});
  const Eigen::Matrix3d gradient = problem.loss(problem.matrix).gradient;
  const GradientCheck coarse =
      check_gradient(problem.loss, problem.matrix, gradient, {0.5, 0, 1e-6});
  EXPECT_FALSE(coarse.passed);
  EXPECT_EQ(coarse.undecided_count(), 9);
  const GradientCheck retried =
      check_gradient(problem.loss, problem.matrix, gradient, {0.5, 7, 1e-6});
  EXPECT_TRUE(retried.passed) << retried.describe();
}

TEST(GradientCheck, DoesNotPassWhatIsNotFinite) {
  const Problem problem({0.5, 0.3, 0.5, 0.5});
  Eigen::Matrix3d gradient = problem.loss(problem.matrix).gradient;
  gradient(1, 1) = std::numeric_limits<double>::quiet_NaN();
  const GradientCheck check = check_gradient(problem.loss, problem.matrix, gradient);
  EXPECT_FALSE(check.passed);
  EXPECT_TRUE(std::isnan(check.largest_relative_error));
}

}  // namespace
}  // namespace ltc
