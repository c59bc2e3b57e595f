// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Folded lobes: the map, its inverse, density, sampler and integrals against each other and against
// the linear pieces that they are made of.
#include "ltc/folded.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "ltc/ltsd.h"
#include "ltc/sphere_chi_squared.h"

namespace ltc {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

Eigen::Matrix3d some_matrix() {
  Eigen::Matrix3d matrix;
  matrix << 0.6, 0.1, 0.5, -0.2, 0.3, 0.1, 0.1, 0, 0.8;
  return matrix;
}

// Of either sign, weak and near the bound of g; all kinds of creases.
struct Shape {
  Fold fold;
  Creases creases;
};
const std::vector<Shape> shapes = {
    {{-1.2, 0.4}, {0.4}},       {{0.7, -2}, {0.4}}, {{0.3, 2.2}, {0.4}}, {{-0.8, 0.5}, {0.3, 1}},
    {{1.5, -0.7}, {0, 0.5, 2}}, {{-0.5, 0.3}, {0}}, {{0.2, 0}, {0.4}}};

std::vector<Vector3d> polygon_around(Random& random, double size) {
  const Vector3d middle = random.direction();
  const Vector3d a = size * middle.unitOrthogonal(), b = middle.cross(a);
  std::vector<Vector3d> vertices;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * kPi * (i + 0.5 * random.uniform()) / 5;
    vertices.push_back(2 * (middle + std::cos(angle) * a + std::sin(angle) * b));
  }
  return vertices;
}

// Sutherland and Hodgman: the part of a convex polygon where normal.p >= 0.
std::vector<Vector3d> part(const std::vector<Vector3d>& vertices, const Vector3d& normal) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3d& a = vertices[i];
    const Vector3d& b = vertices[(i + 1) % vertices.size()];
    const double from = normal.dot(a), to = normal.dot(b);
    if (from >= 0)
      kept.push_back(a);
    if (from * to < 0)
      kept.push_back(a + from / (from - to) * (b - a));
  }
  return kept;
}

// The linear pieces of a fold with x of one sign, where z >= 0: each an LTC of its own on a wedge.
double by_pieces(const Eigen::Matrix3d& matrix, const Shape& shape,
                 const std::vector<Vector3d>& vertices) {
  double sum = 0;
  for (const double side : {1.0, -1.0}) {
    double behind = 0, h_sum = 0;
    for (std::size_t m = 0; m <= shape.creases.size(); ++m) {
      Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
      for (int row : {1, 2}) {
        const double weight = row == 1 ? shape.fold.k : shape.fold.g;
        linear(row, 0) += weight * behind * side;
        linear(row, 2) -= weight * h_sum;
      }
      const Eigen::Matrix3d whole = matrix * linear;
      // The wedge before the fold: |x| between two creases.
      std::vector<Vector3d> kept = vertices;
      const Eigen::Matrix3d back = whole.inverse();
      const auto keep = [&](const Vector3d& normal) {
        if (!kept.empty())
          kept = part(kept, back.transpose() * normal);
      };
      keep({side, 0, 0});
      keep({0, 0, 1});
      if (m > 0)
        keep({side, 0, -shape.creases[m - 1]});
      if (m < shape.creases.size())
        keep({-side, 0, shape.creases[m]});
      if (kept.size() > 2)
        sum += LinearlyTransformed(whole).integrate_polygon(kept);
      if (m < shape.creases.size()) {
        ++behind;
        h_sum += shape.creases[m];
      }
    }
  }
  return sum;
}

TEST(Folded, UnfoldsWhatItFolds) {
  Random random(1);
  for (const Shape& shape : shapes)
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = random.direction();
      const Vector3d q = folded(p, shape.fold, shape.creases);
      EXPECT_LT((unfolded(q, shape.fold, shape.creases) - p).norm(), 1e-13);
    }
  // The creases themselves stay: those of the first pair.
  const Vector3d crease(0.4, 0.3, 1);
  EXPECT_EQ(folded(crease, {0.7, -2}, {0.4}), crease);
}

TEST(Folded, DensityIntegratesToOne) {
  const int heights = 600, azimuths = 1200;
  for (const Shape& shape : shapes) {
    const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
    double mass = 0;
    for (int i = 0; i < heights; ++i)
      for (int j = 0; j < azimuths; ++j) {
        const double z = 1 - 2 * (i + 0.5) / heights, turn = 2 * kPi * (j + 0.5) / azimuths;
        const double sine = std::sqrt(1 - z * z);
        mass += 4 * kPi / (heights * azimuths) *
                lobe.density({sine * std::cos(turn), sine * std::sin(turn), z});
      }
    // The rule's step over the jumps of the density at the creases.
    EXPECT_NEAR(mass, 1, 2e-3) << shape.fold.k << " " << shape.fold.g;
  }
}

TEST(Folded, PolygonsAreExact) {
  Random random(2);
  for (const Shape& shape : shapes)
    for (int i = 0; i < 300; ++i) {
      const auto vertices = polygon_around(random, 0.1 + 1.5 * random.uniform());
      const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
      EXPECT_NEAR(lobe.integrate_polygon(vertices), by_pieces(some_matrix(), shape, vertices),
                  1e-13)
          << shape.fold.k << " " << shape.fold.g << " " << i;
    }
}

// All of the sphere by the eight octants: each light's share adds up to 1.
TEST(Folded, SharesAddUpToOne) {
  for (const Shape& shape : shapes) {
    const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
    double sum = 0;
    for (const double x : {1.0, -1.0})
      for (const double y : {1.0, -1.0})
        for (const double z : {1.0, -1.0})
          sum += std::abs(
              lobe.integrate_polygon(std::vector<Vector3d>{{x, 0, 0}, {0, y, 0}, {0, 0, z}}));
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(Folded, TheShareBelowTheHorizonIsThatOfTheSamples) {
  for (const Shape& shape : shapes) {
    const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
    Random random(5);
    double below = 0;
    constexpr int count = 100'000;
    for (int i = 0; i < count; ++i) {
      const double u = random.uniform();
      below += lobe.sample(u, random.uniform()).z() < 0;
    }
    // Four standard errors.
    EXPECT_NEAR(below / count, share_below_horizon({some_matrix(), shape.fold, shape.creases}),
                4 * 0.5 / std::sqrt(count));
  }
  EXPECT_EQ(share_below_horizon(LtcLobe(some_matrix())), share_below_horizon(some_matrix()));
}

// A polygon so small that its density is one number, by the integral and by the density.
TEST(Folded, DensityIsTheIntegralsLimit) {
  Random random(3);
  for (const Shape& shape : shapes) {
    const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
    for (int i = 0; i < 100; ++i) {
      const Vector3d middle = random.direction();
      constexpr double side = 1e-4;
      const Vector3d a = side / 2 * middle.unitOrthogonal(), b = middle.cross(a);
      const std::vector<Vector3d> quad = {middle - a - b, middle + a - b, middle + a + b,
                                          middle - a + b};
      const double density = lobe.density(middle);
      // Second order in the side, first where a crease or the horizon runs through.
      EXPECT_NEAR(std::abs(lobe.integrate_polygon(quad)) / (side * side), density,
                  1e-5 * (1 + density) + side * 50);
    }
  }
}

TEST(Folded, WithoutFoldItIsTheLtcToTheBit) {
  Random random(4);
  const LinearlyTransformed plain(some_matrix());
  const FoldedCosine lobe(some_matrix(), {});
  for (int i = 0; i < 100; ++i) {
    const Vector3d omega = random.direction();
    const double u = random.uniform(), v = random.uniform();
    const auto vertices = polygon_around(random, 0.8);
    EXPECT_EQ(lobe.density(omega), plain.density(omega));
    EXPECT_EQ(lobe.sample(u, v), plain.sample(u, v));
    EXPECT_EQ(lobe.integrate_polygon(vertices), plain.integrate_polygon(vertices));
  }
}

TEST(Folded, TheSignIsThatOfTheWinding) {
  Eigen::Matrix3d mirrored = some_matrix();
  mirrored.row(0) *= -1;
  std::vector<Vector3d> vertices = {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}};
  for (const Eigen::Matrix3d& matrix : {some_matrix(), mirrored}) {
    const FoldedCosine lobe(matrix, {-1.2, 0.4});
    const double share = lobe.integrate_polygon(vertices);
    EXPECT_GT(share, 0.1);
    std::vector<Vector3d> other(vertices.rbegin(), vertices.rend());
    EXPECT_NEAR(lobe.integrate_polygon(other), -share, 1e-15);
  }
}

// Seven tests more of kChiSquaredDeviations' significance, and one of a wrong density.
TEST(FoldedChiSquared, SamplerFollowsTheDensity) {
  const test::SphereBins bins{24, 36, 30};
  for (const Shape& shape : shapes) {
    const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
    const test::ChiSquared right = test::sampler_against(lobe, lobe, bins);
    EXPECT_TRUE(right.accepted()) << right.deviations();
    EXPECT_GT(right.degrees_of_freedom, 50u);
  }
  const Shape& shape = shapes.front();
  const FoldedCosine lobe(some_matrix(), shape.fold, shape.creases);
  const FoldedCosine wrong(some_matrix(), {shape.fold.k * 1.1, shape.fold.g}, shape.creases);
  EXPECT_FALSE(test::sampler_against(lobe, wrong, bins).accepted());
}

TEST(Folded, RefusesWhatIsNotOneToOne) {
  const Eigen::Matrix3d m = some_matrix();
  EXPECT_NO_THROW(FoldedCosine(m, {0, 2.49}, {0.4}));
  EXPECT_THROW(FoldedCosine(m, {0, 2.5}, {0.4}), InputError);
  EXPECT_THROW(FoldedCosine(m, {0, 0.8}, {0.3, 1}), InputError);
  EXPECT_THROW(FoldedCosine(m, {std::nan(""), 0}), InputError);
  EXPECT_THROW(FoldedCosine(m, {0.1, 0}, {-0.4}), InputError);
  EXPECT_THROW(FoldedCosine(m, {0.1, 0}, {0.4, 0.4}), InputError);
  EXPECT_THROW(FoldedCosine(Eigen::Matrix3d::Zero(), {0.1, 0}), InputError);
}

}  // namespace
}  // namespace ltc
