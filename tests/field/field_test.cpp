// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a field keeps whatever its coefficients: symmetries, continuity, determinants.
#include "field/field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "field/synthetic_field.h"
#include "table/field_table.h"
#include "table/lookup.h"
#include "table/queries.h"

namespace ltc {
namespace {

using testing::synthetic_field;

constexpr double half_pi = std::numbers::pi / 2;

// The lobe of M is that of M with any rotation about z behind it: M diag(1, 1, 1) M^T is compared.
Eigen::Matrix3d gram(const Eigen::Matrix3d& matrix) {
  return matrix * matrix.transpose();
}

// Coefficients as wild as one likes.
Field random_field(std::uint64_t seed) {
  Field field = synthetic_field();
  Random random(seed);
  for (float& coefficient : field.coefficients)
    coefficient = static_cast<float>(6 * random.uniform() - 3);
  return field;
}

TEST(Field, IsotropicLobesAreOneLobeTurned) {
  const Field field = synthetic_field();
  const Eigen::Matrix3d at_zero = lobe_of(field, {0.3, 0.3, 1.1, 0}).matrix;
  for (const double phi : {0.2, 0.7, half_pi}) {
    const FieldLobe found = lobe_of(field, {0.3, 0.3, 1.1, phi});
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(phi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    // Rounding alone.
    EXPECT_LT((gram(found.matrix) - gram(turn * at_zero)).cwiseAbs().maxCoeff(), 1e-14) << phi;
    EXPECT_NEAR(found.amplitude, lobe_of(field, {0.3, 0.3, 1.1, 0}).amplitude, 1e-15);
  }
}

TEST(Field, DoesNotJumpWhereTheAxesAreExchanged) {
  Table table = table_of_field(synthetic_field(), Grid::paper(2), Storage::matrix);
  const double step = 1e-9;
  for (const double phi : {0.1, 1.0, 2.5, 4.0}) {
    const LookUp below = look_up(table, {0.4, 0.4 - step, 0.9, phi});
    const LookUp above = look_up(table, {0.4, 0.4 + step, 0.9, phi});
    // Slopes are of the order of 1.
    EXPECT_LT((gram(below.matrix) - gram(above.matrix)).cwiseAbs().maxCoeff(), 20 * step) << phi;
    EXPECT_NEAR(below.fresnel, above.fresnel, 20 * step);
  }
}

TEST(Field, HasTheZerosOfEquation16Exactly) {
  for (const double phi : {0.0, half_pi}) {
    const Eigen::Matrix3d m = lobe_of(synthetic_field(), {0.4, 0.1, 1.2, phi}).matrix;
    const int axis = phi == 0 ? 1 : 0;  // that the lobe is symmetric across
    for (int other = 0; other < 3; ++other)
      if (other != axis) {
        EXPECT_EQ(m(axis, other), 0) << phi;
        EXPECT_EQ(m(other, axis), 0) << phi;
      }
  }
}

TEST(Field, IsTheSameForEveryAzimuthAtNormalIncidence) {
  const FieldLobe first = lobe_of(synthetic_field(), {0.5, 0.2, 0, 0});
  for (const double phi : {0.3, 1.0, half_pi}) {
    const FieldLobe found = lobe_of(synthetic_field(), {0.5, 0.2, 0, phi});
    EXPECT_EQ(found.matrix, first.matrix) << phi;
    EXPECT_EQ(found.amplitude, first.amplitude) << phi;
  }
}

TEST(Field, DeterminantsArePositiveWhateverTheCoefficients) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Field field = random_field(seed);
    QueryRange everywhere;
    everywhere.roughness_first = 0.01;
    for (const Lobe& lobe : random_queries(everywhere, 200, seed, 1e-4)) {
      const FieldVariables at(lobe, field.alpha_min);
      const Eigen::Matrix3d p = field_frame_matrix(values_of(field, at).data(), at);
      const FieldDirections directions(at);
      // det P = det L det T s_y / alpha_y; relative rounding of determinants that cancel.
      const double least =
          field_least_determinant * directions.left.determinant() * at.width_y / at.lobe.alpha_y;
      EXPECT_GT(p.determinant(), (1 - 1e-6) * least) << seed;
    }
  }
}

TEST(Field, TheFloorOfTheDeterminantIsMetExactlyAndLeavesOthersAlone) {
  Eigen::Matrix3d bad = Eigen::Matrix3d::Identity();
  bad(1, 1) = -2;
  EXPECT_NEAR(with_least_determinant(bad).determinant(), field_least_determinant, 1e-15);
  Eigen::Matrix3d turned_over = Eigen::Vector3d(-1, -3, 1).asDiagonal();  // determinant 3
  EXPECT_EQ(with_least_determinant(turned_over), turned_over);
  bad << 0.1, 5, 2, -7, 0.1, 3, 0.5, 0.25, 0.5;
  bad(0, 1) = 7;
  bad(1, 0) = 7;
  EXPECT_NEAR(with_least_determinant(bad).determinant(), field_least_determinant, 1e-12);
}

TEST(Field, TermsThatSymmetryForbidsAreNotAllowed) {
  using P = FieldPart;
  EXPECT_TRUE(is_allowed({P::a, 3, 0, 2, 1, 0}));
  EXPECT_FALSE(is_allowed({P::a, 0, 1, 0, 0, 0}));    // isotropic parts know no lambda
  EXPECT_FALSE(is_allowed({P::b, 0, 0, 0, 0, 2}));    // nor an order of their own
  EXPECT_FALSE(is_allowed({P::m00, 0, 0, 0, 0, 0}));  // others vanish at lambda = 1
  EXPECT_FALSE(is_allowed({P::m00, 0, 1, 0, 0, 1}));  // parity
  EXPECT_FALSE(is_allowed({P::m01, 0, 1, 0, 0, 0}));  // no sine of order 0
  EXPECT_TRUE(is_allowed({P::m12, 0, 1, 0, 0, 3}));
  EXPECT_FALSE(is_allowed({P::m12, 0, 1, 0, 0, 2}));
  EXPECT_TRUE(is_allowed({P::amplitude, 1, 0, 1, 0, 0}));
  EXPECT_FALSE(is_allowed({P::amplitude, 1, 0, 1, 0, 2}));  // isotropic: no azimuth
  EXPECT_FALSE(is_allowed({P::a, 21, 0, 0, 0, 0}));
}

TEST(Field, ATableOfItHasItsValuesAndLookUpsAreTheFields) {
  const Table table = table_of_field(synthetic_field(), Grid::paper(3), Storage::mirror_frame);
  const std::size_t flat = table.grid.flat({2, 1, 1, 1});
  const Lobe lobe = table.grid.lobe(flat);
  const FieldLobe found = lobe_of(synthetic_field(), lobe);
  const Eigen::Matrix3d stored = table.matrix_at(flat);
  // Rounded to single precision.
  EXPECT_LT((stored / stored(0, 0) - found.matrix / found.matrix(0, 0)).cwiseAbs().maxCoeff(),
            1e-5);
  EXPECT_EQ(look_up(table, {0.37, 0.11, 0.4, 0.3}).matrix,
            lobe_of(synthetic_field(), {0.37, 0.11, 0.4, 0.3}).matrix);
  EXPECT_THROW(table_of_field(synthetic_field(), Grid::paper(3), Storage::inverse), InputError);
}

}  // namespace
}  // namespace ltc
