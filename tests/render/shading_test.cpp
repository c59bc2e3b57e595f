// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "brdf/albedo.h"
#include "core/error.h"
#include "core/random.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "render/light_texture.h"
#include "table/lookup.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

const Lobe kLobes[] = {
    {0.5, 0.2, 0.8, 0.6}, {0.05, 0.25, 0.4, 2.0}, {1, 0.3, 1.3, 4.0}, {0.3, 0.3, 0, 0}};

// A light that the mirror direction leads past, and one that stands across the horizon.
Light beside_mirror(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  return light_facing_origin({-v.x() - 0.2, -v.y() - 0.1, v.z() + 0.1}, 0.5, 0.3);
}
Light across_horizon(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  return light_facing_origin({-v.x() - 0.3, -v.y(), 0.2}, 0.6, 0.6);
}

// Of every shape, also across the horizon and, flat ones, from behind.
std::vector<Light> lights_beside_mirror(const Lobe& lobe) {
  const Eigen::Vector3d v = lobe.omega_v();
  const Eigen::Vector3d beside(-v.x() - 0.2, -v.y() - 0.1, v.z() + 0.1),
      low(-v.x() - 0.3, -v.y(), 0.1);
  std::vector<Light> lights;
  for (const LightShape shape :
       {LightShape::star, LightShape::disk, LightShape::sphere, LightShape::line})
    for (const Eigen::Vector3d& center : {beside, low}) {
      lights.push_back(standard_light(shape, center, 0.5));
      if (shape == LightShape::line)
        lights.back().half_v *= 4;
    }
  lights[0].half_u *= -1;
  lights[0].two_sided = true;
  lights[3].half_v *= 0.5;
  return lights;
}

// Covers the upper hemisphere but for 1e-6 of its height.
const Light kSky{{0, 0, 1}, {0, 1e6, 0}, {1e6, 0, 0}};

struct Estimate {
  double mean, standard_error;
};
Estimate estimate(Technique technique, const Lobe& lobe, double f0, const Light& light) {
  constexpr int replicates = 64;
  const ReferenceIntegrator integrator(64, technique);
  Random random(3);
  double sum = 0, squares = 0;
  for (int i = 0; i < replicates; ++i) {
    ReferenceIntegrator::Shifts shifts;
    for (double& shift : shifts)
      shift = random.uniform();
    const double value = integrator.radiance(lobe, f0, light, shifts);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / replicates;
  return {mean, std::sqrt((squares / replicates - mean * mean) / (replicates - 1))};
}

// At most 5 standard errors apart: over the 16 comparisons below a right estimator fails with
// probability 1e-5.
bool agree(const Estimate& a, const Estimate& b) {
  return std::abs(a.mean - b.mean) <= 5 * std::hypot(a.standard_error, b.standard_error);
}

TEST(Reference, AllTechniquesHaveOneMean) {
  for (const Lobe& lobe : kLobes)
    for (const Light& light : {beside_mirror(lobe), across_horizon(lobe)}) {
      const Estimate both = estimate(Technique::both, lobe, 0.2, light);
      const Estimate area = estimate(Technique::light, lobe, 0.2, light);
      const Estimate normals = estimate(Technique::lobe, lobe, 0.2, light);
      EXPECT_GT(both.mean, 0);
      EXPECT_TRUE(agree(both, area)) << both.mean << ' ' << area.mean;
      EXPECT_TRUE(agree(both, normals)) << both.mean << ' ' << normals.mean;
      // Both together avoid the worse of the two. Not so the better one: over a smooth integrand a
      // lattice on the light alone has hardly any noise.
      EXPECT_LT(both.standard_error, std::max(area.standard_error, normals.standard_error));
    }
  // The comparison tells a reflectance that is 10 % off.
  EXPECT_FALSE(agree(estimate(Technique::both, kLobes[0], 1, beside_mirror(kLobes[0])),
                     estimate(Technique::light, kLobes[0], 0.9, beside_mirror(kLobes[0]))));
}

// 64 comparisons at 5 standard errors: 4e-5 for a right estimator.
TEST(Reference, AllTechniquesHaveOneMeanForLightsOfEveryShape) {
  for (const Lobe& lobe : kLobes)
    for (const Light& light : lights_beside_mirror(lobe)) {
      const Estimate both = estimate(Technique::both, lobe, 0.2, light);
      EXPECT_GT(both.mean, 0);
      for (const Technique technique : {Technique::light, Technique::lobe}) {
        const Estimate other = estimate(technique, lobe, 0.2, light);
        EXPECT_TRUE(agree(both, other))
            << name_of(light.shape) << ' ' << both.mean << " +- " << both.standard_error << ' '
            << other.mean << " +- " << other.standard_error;
      }
    }
}

// Left half black, right half bright.
std::shared_ptr<const LightTexture> half_lit() {
  LightImage image{2, 1, {0, 0, 0, 1, 2, 2, 2, 1}};
  return std::make_shared<const LightTexture>(std::move(image));
}

// 16 comparisons, as above.
TEST(Reference, AllTechniquesHaveOneMeanForImages) {
  for (const Lobe& lobe : kLobes)
    for (Light light : {beside_mirror(lobe), across_horizon(lobe)}) {
      const double plain = estimate(Technique::both, lobe, 0.2, light).mean;
      light.texture = half_lit();
      const Estimate both = estimate(Technique::both, lobe, 0.2, light);
      EXPECT_TRUE(agree(both, estimate(Technique::light, lobe, 0.2, light)));
      EXPECT_TRUE(agree(both, estimate(Technique::lobe, lobe, 0.2, light)));
      EXPECT_GT(std::abs(both.mean - plain), 1e-3 * plain) << "the image counts";
      EXPECT_LE(both.mean, 2 * plain);
    }
}

TEST(Reference, LightFromEverywhereGivesTheAlbedo) {
  const AlbedoRule rule;
  for (const Lobe& lobe : kLobes) {
    const Albedo albedo = integrate_albedo(lobe, rule);
    for (const double f0 : {1.0, 0.0}) {
      const Estimate sky = estimate(Technique::both, lobe, f0, kSky);
      const double expected = f0 == 1 ? albedo.amplitude : albedo.fresnel;
      // 1e-4 is the bound of the quadrature.
      EXPECT_NEAR(sky.mean, expected, 5 * sky.standard_error + 1e-4);
      EXPECT_LT(sky.standard_error, 2e-3);
    }
  }
}

TEST(Reference, SeesNoLightFromBelowOrBehind) {
  const ReferenceIntegrator integrator(16);
  const ReferenceIntegrator::Shifts shifts{};
  const Light below = light_facing_origin({0, 0.2, -1}, 0.2, 0.2);
  const Light lit = beside_mirror(kLobes[0]);
  Light averted = lit;
  averted.half_u *= -1;
  const Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  for (const Light& light : {below, averted}) {
    EXPECT_EQ(integrator.radiance(kLobes[0], 1, light, shifts), 0);
    EXPECT_EQ(ltc_radiance(table, kLobes[0], 1, light), 0);
  }
  EXPECT_GT(integrator.radiance(kLobes[0], 1, lit, shifts), 0);
}

TEST(LtcRadiance, IsTheShareOfTheLobesSamplesOnTheLight) {
  const Table table = testing::synthetic_table(Grid::paper(4), Storage::mirror_frame);
  // Each quadrant of phi and both orders of the roughnesses, so that the look-up mirrors.
  for (int i = 0; i < 8; ++i) {
    const double phi = 0.5 + 1.5707963267948966 * (i % 4);
    const Lobe lobe{i < 4 ? 0.5 : 0.3, i < 4 ? 0.3 : 0.5, 0.7, phi};
    const Eigen::Vector3d v = lobe.omega_v();
    const Light light = light_facing_origin({-v.x(), -v.y(), 0.7 * v.z()}, 0.4, 0.6);
    const LookUp found = look_up(table, lobe);
    const LinearlyTransformed cosine(found.matrix);
    Random random(11);
    constexpr int samples = 20000;
    int hits = 0;
    for (int k = 0; k < samples; ++k) {
      const double u = random.uniform();
      const Eigen::Vector3d omega = cosine.sample(u, random.uniform());
      const double towards = omega.dot(light.normal());
      if (omega.z() < 0 || towards >= 0)
        continue;
      const Eigen::Vector3d hit =
          omega * (light.center.dot(light.normal()) / towards) - light.center;
      hits += std::abs(hit.dot(light.half_u)) < light.half_u.squaredNorm() &&
              std::abs(hit.dot(light.half_v)) < light.half_v.squaredNorm();
    }
    const double share = hits / static_cast<double>(samples);
    ASSERT_GT(share, 0.1);
    const double f0 = 0.3, albedo = f0 * found.amplitude + (1 - f0) * found.fresnel;
    // 4.5 standard deviations of a binomial: probability 5e-5 over the eight.
    EXPECT_NEAR(ltc_radiance(table, lobe, f0, light) / albedo, share,
                4.5 * std::sqrt(share * (1 - share) / samples));
  }
}

// Whether a ray from the origin meets a light, by other means than the renderer's.
bool meets_sphere(const Light& light, const Eigen::Vector3d& omega) {
  return omega.dot(light.center) > 0 && omega.cross(light.center).norm() < light.half_u.norm();
}
bool meets_tube(const Light& light, const Eigen::Vector3d& omega) {
  const Eigen::Vector3d along = light.half_u.normalized();
  const Eigen::Vector3d flat = omega - omega.dot(along) * along,
                        center = light.center - light.center.dot(along) * along;
  // Nearest to the axis, where the end's outline is a point's width off at most.
  const double distance = center.dot(flat) / flat.squaredNorm();
  return distance > 0 && (distance * flat - center).norm() < light.half_v.norm() &&
         std::abs((distance * omega - light.center).dot(along)) < light.half_u.norm();
}
bool meets_flat(const Light& light, const Eigen::Vector3d& omega) {
  const double distance = light.center.dot(light.normal()) / omega.dot(light.normal());
  const Eigen::Vector3d place = distance * omega - light.center;
  const double x = place.dot(light.half_u) / light.half_u.squaredNorm(),
               y = place.dot(light.half_v) / light.half_v.squaredNorm();
  if (!(distance > 0))
    return false;
  if (light.shape == LightShape::disk)
    return x * x + y * y < 1;
  // A star: folded into the half of a point that goes from its tip clockwise, where the edge from
  // (0, 1) to the inner corner bounds it.
  const double fifth = 2 * std::numbers::pi / 5;
  const double angle = std::abs(std::remainder(std::atan2(x, y), fifth)), radius = std::hypot(x, y);
  const double inner = 0.45 / 1.1;
  const Eigen::Vector2d corner(inner * std::sin(fifth / 2), inner * std::cos(fifth / 2));
  const Eigen::Vector2d edge = corner - Eigen::Vector2d(0, 1);
  const Eigen::Vector2d point(radius * std::sin(angle), radius * std::cos(angle) - 1);
  return edge.x() * point.y() - edge.y() * point.x() < 0;
}

TEST(LtcShare, OfEveryShapeIsTheShareOfTheLobesSamplesOnIt) {
  const Table table = testing::synthetic_table(Grid::paper(4), Storage::mirror_frame);
  const Lobe lobe{0.5, 0.3, 0.9, 0.5};
  const Eigen::Matrix3d matrix = look_up(table, lobe).matrix;
  const LinearlyTransformed cosine(matrix);
  int index = 0;
  for (const Light& light : lights_beside_mirror(lobe)) {
    Random random(13);
    constexpr int samples = 100000;
    int hits = 0;
    for (int k = 0; k < samples; ++k) {
      const double u = random.uniform();
      const Eigen::Vector3d omega = cosine.sample(u, random.uniform());
      if (omega.z() < 0)
        continue;
      hits += light.shape == LightShape::sphere ? meets_sphere(light, omega)
              : light.shape == LightShape::line ? meets_tube(light, omega)
                                                : meets_flat(light, omega);
    }
    const double share = hits / static_cast<double>(samples);
    EXPECT_GT(share, 0.01) << index;
    // 4.5 standard deviations of a binomial: probability 5e-5 over the eight; and of a thin line
    // (0.06 wide at a distance near 1) what its formula leaves out.
    const double thin = light.shape == LightShape::line ? 0.02 * share : 0;
    EXPECT_NEAR(ltc_share(matrix, light), share,
                4.5 * std::sqrt(share * (1 - share) / samples) + thin)
        << index << name_of(light.shape);
    ++index;
  }
}

TEST(LtcShare, OfAStarIsThatOfItsTriangles) {
  const Lobe lobe{0.5, 0.3, 0.9, 0.5};
  const Table table = testing::synthetic_table(Grid::paper(4), Storage::mirror_frame);
  const Eigen::Matrix3d matrix = look_up(table, lobe).matrix;
  const LinearlyTransformed cosine(matrix);
  int across = 0;
  for (double height = -0.4; height < 1; height += 0.1) {
    const Light star = standard_light(LightShape::star, {-1, -0.3, height}, 0.7);
    const std::vector<Eigen::Vector3d> corners = star.corners();
    double sum = 0;
    int below = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::vector<Eigen::Vector3d> triangle{star.center, corners[i],
                                                  corners[(i + 1) % corners.size()]};
      sum += cosine.integrate_polygon(clip_to_upper_hemisphere(triangle));
      below += corners[i].z() < 0;
    }
    across += below > 0 && below < 10;
    // Rounding of ten triangles.
    EXPECT_NEAR(ltc_share(matrix, star), sum, 1e-14) << height;
    EXPECT_GT(sum, 0);
  }
  EXPECT_GT(across, 4);
}

TEST(Lights, FlatFromBehindEmitOnlyWhereTheyHaveTwoSides) {
  const Eigen::Matrix3d matrix = Eigen::Vector3d(0.5, 0.5, 1).asDiagonal();
  for (const LightShape shape : {LightShape::rectangle, LightShape::star, LightShape::disk}) {
    Light light = standard_light(shape, {0.2, 0.1, 1}, 0.3);
    const double before = ltc_share(matrix, light);
    EXPECT_GT(before, 0.01);
    light.half_u *= -1;
    EXPECT_EQ(ltc_share(matrix, light), 0);
    light.two_sided = true;
    EXPECT_NEAR(ltc_share(matrix, light), before, 1e-15);
  }
}

TEST(Lights, MustNotReachThePoint) {
  const Light sphere = standard_light(LightShape::sphere, {0, 0, 0.5}, 1);
  EXPECT_THROW(ltc_share(Eigen::Matrix3d::Identity(), sphere), InputError);
  const Light line = standard_light(LightShape::line, {0, 0, 0.02}, 1);
  EXPECT_THROW(ltc_share(Eigen::Matrix3d::Identity(), line), InputError);
  // Seen along its axis a tube without ends shows nothing.
  Light away = line;
  away.center = {2, 0, 0.01};
  away.half_u = {1, 0, 0};
  EXPECT_EQ(ltc_share(Eigen::Matrix3d::Identity(), away), 0);
  EXPECT_EQ(ReferenceIntegrator(16).radiance(kLobes[0], 1, away, {}), 0);
}

TEST(LtcRadiance, LightFromEverywhereGivesTheAlbedo) {
  const Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  // A view from above: the lobe lies in the upper hemisphere.
  const Lobe lobe{0.5, 0.25, 0, 0};
  const LookUp found = look_up(table, lobe);
  for (const double f0 : {0.0, 0.25, 1.0})
    // The strip that the light leaves free, 1e-6 high.
    EXPECT_NEAR(ltc_radiance(table, lobe, f0, kSky),
                f0 * found.amplitude + (1 - f0) * found.fresnel, 1e-5);
}

TEST(LtcRadiance, ScaledLightFromEverywhereGivesTheAlbedoOfEveryLobe) {
  const Table table = testing::synthetic_table(Grid::paper(3), Storage::matrix);
  const Lobe lobe{0.9, 0.5, 1.3, 0.4};
  const LookUp found = look_up(table, lobe);
  const double below = share_below_horizon(found.ltc());
  ASSERT_GT(below, 0.02);
  // The strip that the light leaves free, 1e-6 high.
  EXPECT_NEAR(ltc_radiance(table, lobe, 1, kSky, HorizonMode::scaled), found.amplitude, 1e-5);
  EXPECT_NEAR(ltc_radiance(table, lobe, 1, kSky), (1 - below) * found.amplitude, 1e-5);
}

TEST(LtcRadiance, IsGgxWhereGgxIsAnLtc) {
  // A sharp lobe at the only node of a table: the closed form is GGX to first order in alpha.
  Grid grid;
  grid.alpha = Axis::make(0.01, 0.01, 1, Warp::linear);
  grid.lambda = Axis::make(0.5, 0.5, 1, Warp::linear);
  grid.theta = Axis::make(0.6, 0.6, 1, Warp::linear);
  grid.phi = Axis::make(0.4, 0.4, 1, Warp::linear);
  Table table = testing::synthetic_table(grid, Storage::matrix);
  const Lobe lobe{0.01, 0.005, 0.6, 0.4};
  table.amplitude[0] = static_cast<float>(integrate_albedo(lobe, AlbedoRule()).amplitude);
  // Its edge runs through the lobe.
  const Eigen::Vector3d v = lobe.omega_v();
  const Light light = light_facing_origin({-v.x() - 0.15, -v.y(), v.z()}, 0.14, 0.14);
  const Estimate ggx = estimate(Technique::both, lobe, 1, light);
  ASSERT_GT(ggx.mean, 0.1);
  ASSERT_LT(ggx.mean, 0.95);
  EXPECT_NEAR(ltc_radiance(table, lobe, 1, light), ggx.mean, 5 * ggx.standard_error + 0.01);
  // A lobe three times as wide is told apart.
  table.set_stored(0, table.stored_at(0) * Eigen::Vector3d(3, 3, 1).asDiagonal());
  EXPECT_GT(std::abs(ltc_radiance(table, lobe, 1, light) - ggx.mean),
            5 * ggx.standard_error + 0.01);
}

TEST(LtcRadiance, OfAnImageOfOneColorIsThatOfTheLight) {
  const Table table = testing::synthetic_table(Grid::paper(4), Storage::mirror_frame);
  for (const Lobe& lobe : kLobes) {
    Light light = beside_mirror(lobe);
    const double plain = ltc_radiance(table, lobe, 0.3, light);
    light.texture = std::make_shared<const LightTexture>(LightImage{1, 1, {0.5f, 0.5f, 0.5f, 1}});
    EXPECT_NEAR(ltc_radiance(table, lobe, 0.3, light), plain / 2, 1e-6 * plain);
  }
}

// A sharp lobe shows the pixel that it is mirrored from, by the table as by sampling.
TEST(LtcRadiance, OfASharpLobeIsThePixelThatItMeets) {
  Grid grid;
  grid.alpha = Axis::make(0.01, 0.01, 1, Warp::linear);
  grid.lambda = Axis::make(0.5, 0.5, 1, Warp::linear);
  grid.theta = Axis::make(0.6, 0.6, 1, Warp::linear);
  grid.phi = Axis::make(0.4, 0.4, 1, Warp::linear);
  const Table table = testing::synthetic_table(grid, Storage::matrix);
  const Lobe lobe{0.01, 0.005, 0.6, 0.4};
  const double albedo = look_up(table, lobe).amplitude;
  LightImage image{4, 4, std::vector<float>(64, 1)};
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.rgba[4 * i + channel] = static_cast<float>(i) / 16;
  Light light = light_facing_origin(lobe.mirror(), 0.8, 0.8);
  light.texture = std::make_shared<const LightTexture>(image);
  // The mirror direction meets the middle of a pixel each.
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      Light moved = light;
      moved.center -= (column - 1.5) / 2 * light.half_u - (row - 1.5) / 2 * light.half_v;
      const double expected =
          image.texel(static_cast<std::size_t>(row), static_cast<std::size_t>(column))[0];
      // A pixel is 0.4 wide, the lobe some 0.02: all but its tails, some 1 %, of at most 1.
      EXPECT_NEAR(ltc_radiance(table, lobe, 1, moved) / albedo, expected, 0.02);
      const Estimate ggx = estimate(Technique::both, lobe, 1, moved);
      EXPECT_NEAR(ggx.mean / integrate_albedo(lobe, AlbedoRule()).amplitude, expected, 0.02);
    }
}

TEST(LtcRadiance, IsNaNWhereTheTableHasNothing) {
  const Table table = Table::empty(Grid::paper(3), Storage::matrix);
  EXPECT_TRUE(std::isnan(ltc_radiance(table, kLobes[0], 1, beside_mirror(kLobes[0]))));
}

}  // namespace
}  // namespace ltc
