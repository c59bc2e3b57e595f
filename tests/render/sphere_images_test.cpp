// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/sphere_images.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "support/refusal.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

const SphereMaterial kMaterial{0.5, 0.25, 1};

Table small_table() {
  return testing::synthetic_table(Grid::paper(4), Storage::mirror_frame);
}

SphereImages render(const Table& table, const SphereSettings& settings, int threads = 2) {
  const Table* const tables[] = {&table};
  return render_sphere(tables, kMaterial, settings, "render", {threads});
}

SphereSettings small_settings() {
  SphereSettings settings;
  settings.size = 32;
  settings.samples = 64;
  return settings;
}

TEST(SphereScene, PointsLieOnTheSphereInTheirFrames) {
  const SphereScene scene;
  int hits = 0;
  for (double y = -0.9; y < 1; y += 0.15)
    for (double x = -0.9; x < 1; x += 0.15) {
      const auto point = shading_point(scene, x, y);
      ASSERT_EQ(point.has_value(), std::hypot(x, y) < scene.sphere_share);
      if (!point)
        continue;
      ++hits;
      const Eigen::Vector3d to_camera =
          (Eigen::Vector3d(0, 0, scene.camera_distance) - point->position).normalized();
      // Rounding of a few operations on numbers up to 6.
      EXPECT_NEAR(point->position.norm(), 1, 1e-14);
      EXPECT_LT((point->to_tangent * to_camera - point->omega_v).norm(), 1e-13);
      EXPECT_LT((point->to_tangent * point->position - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
      EXPECT_LT(
          (point->to_tangent * point->to_tangent.transpose() - Eigen::Matrix3d::Identity()).norm(),
          1e-14);
      EXPECT_NEAR(point->to_tangent.determinant(), 1, 1e-14);
      EXPECT_GT(point->omega_v.z(), 0);
      EXPECT_EQ(point->to_tangent(0, 1), 0) << "east is level";
      EXPECT_LT((point->lobe(0.1, 0.2, ggx()).omega_v() - point->omega_v).norm(), 1e-14);
    }
  EXPECT_GT(hits, 50);
}

// Rays of every point lead back to the camera, and the normals are those of the surfaces.
TEST(SphereScene, PointsLieOnPlaneAndSheet) {
  const Eigen::Vector3d camera(0, 3, 6 * std::sqrt(0.75));
  for (const ObjectShape shape : {ObjectShape::plane, ObjectShape::sheet}) {
    SphereScene scene;
    scene.shape = shape;
    int hits = 0, misses = 0;
    for (double y = -0.95; y < 1; y += 0.1)
      for (double x = -0.95; x < 1; x += 0.1) {
        const auto point = shading_point(scene, x, y);
        if (!point) {
          ++misses;
          continue;
        }
        ++hits;
        const Eigen::Vector3d& p = point->position;
        const Eigen::Vector3d normal = point->to_tangent.row(2);
        if (shape == ObjectShape::plane) {
          EXPECT_EQ(p.y(), 0);
          EXPECT_EQ(normal, Eigen::Vector3d::UnitY());
          EXPECT_LE(std::abs(p.z()), 1.6);
        } else {
          // From the axis outwards.
          EXPECT_LT((Eigen::Vector3d(0, p.y() + 1, p.z()) - 1.5 * normal).norm(), 1e-13);
          EXPECT_GE(normal.y(), 0.5 - 1e-13);
        }
        EXPECT_LE(std::abs(p.x()), 1.6);
        EXPECT_EQ(point->to_tangent.row(0), Eigen::RowVector3d::UnitX());
        EXPECT_LT(point->to_tangent(1, 2), 0) << "y leads away from the camera";
        EXPECT_NEAR(point->to_tangent.determinant(), 1, 1e-14);
        EXPECT_LT((point->to_tangent * point->to_tangent.transpose() - Eigen::Matrix3d::Identity())
                      .norm(),
                  1e-14);
        EXPECT_LT((point->to_tangent * (camera - p).normalized() - point->omega_v).norm(), 1e-13);
        EXPECT_GT(point->omega_v.z(), 0);
        // The picture's point: right and up of the camera, at the sphere's angle of view.
        const Eigen::Vector3d ray = p - camera, ahead = -camera / 6, up(0, std::sqrt(0.75), -0.5);
        const double scale = 1 / (std::sqrt(35.0) * scene.sphere_share);
        EXPECT_NEAR(ray.x() / ray.dot(ahead), x * scale, 1e-13);
        EXPECT_NEAR(ray.dot(up) / ray.dot(ahead), y * scale, 1e-13);
      }
    EXPECT_GT(hits, 200);
    EXPECT_GT(misses, 0);
  }
}

TEST(SphereImages, OfPlaneAndSheetShowTheirLight) {
  const Table table = small_table();
  for (const ObjectShape shape : {ObjectShape::plane, ObjectShape::sheet}) {
    SphereSettings settings = small_settings();
    settings.scene.shape = shape;
    settings.scene.light = standard_light(LightShape::disk, usual_light_position(shape), 1);
    const SphereImages images = render(table, settings);
    const SphereError error = sphere_error(images, 0);
    EXPECT_GT(error.pixels, 500u);
    EXPECT_EQ(error.without, 0u);
    EXPECT_GT(error.reference_mean, 0.02);
  }
}

TEST(SphereImages, AreMirroredWhereTheSceneIs) {
  SphereSettings settings = small_settings();
  settings.scene.light = light_facing_origin({0, 1.8, 2.4}, 1, 0.6);
  const SphereImages images = render(small_table(), settings);
  const std::size_t size = settings.size;
  double squares = 0, variance = 0, asymmetry_of_rows = 0;
  for (std::size_t row = 0; row < size; ++row)
    for (std::size_t column = 0; column < size / 2; ++column) {
      const std::size_t mirrored = size - 1 - column;
      EXPECT_EQ(images.coverage.at(row, column), images.coverage.at(row, mirrored));
      // Single precision, and look-ups at phi and pi - phi.
      EXPECT_NEAR(images.ltc[0].at(row, column), images.ltc[0].at(row, mirrored), 2e-6);
      const double d = images.reference.at(row, column) - images.reference.at(row, mirrored);
      squares += d * d;
      for (const std::size_t c : {column, mirrored}) {
        const double noise = images.standard_error.at(row, c);
        variance += noise * noise;
      }
      asymmetry_of_rows +=
          std::abs(images.ltc[0].at(row, column) - images.ltc[0].at(size - 1 - row, column));
    }
  // A difference of two independent pixels has the sum of their variances; some 350 pixels tell it
  // to within a few per cent of what heavy tails make it.
  EXPECT_GT(variance, 0);
  EXPECT_LT(squares, 2 * variance);
  EXPECT_GT(asymmetry_of_rows, 1) << "the light comes from above";
}

TEST(SphereImages, HaveTheSameBitsWithAnyNumberOfThreads) {
  const Table table = small_table();
  const SphereImages one = render(table, small_settings(), 1),
                     three = render(table, small_settings(), 3);
  EXPECT_EQ(one.reference.values, three.reference.values);
  EXPECT_EQ(one.standard_error.values, three.standard_error.values);
  EXPECT_EQ(one.coverage.values, three.coverage.values);
  EXPECT_EQ(one.ltc[0].values, three.ltc[0].values);
  EXPECT_GT(*std::max_element(one.reference.values.begin(), one.reference.values.end()), 0.1);
}

TEST(SphereImages, StateTheNoiseOfTheReference) {
  SphereSettings many = small_settings();
  many.samples = 16384;
  const Table table = small_table();
  const SphereImages coarse = render(table, small_settings()), fine = render(table, many);
  double squares = 0, variance = 0;
  for (std::size_t i = 0; i < coarse.reference.values.size(); ++i) {
    const double d = coarse.reference.values[i] - fine.reference.values[i];
    const double noise = coarse.standard_error.values[i];
    squares += d * d;
    variance += noise * noise;
  }
  // Some 700 pixels with one degree of freedom each: 5 % for normal noise, more with its tails.
  EXPECT_NEAR(std::sqrt(squares / variance), 1, 0.3);
}

TEST(SphereImages, ErrorsAreThoseOfPixelsWithValues) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  SphereImages images;
  images.coverage = {2, 2, {1, 1, 0.5f, 0}};
  images.reference = {2, 2, {1, 3, 5, 100}};
  images.standard_error = {2, 2, {3, 4, 100, 100}};
  images.ltc = {{2, 2, {1.5f, 2, nan, 200}}};
  const SphereError error = sphere_error(images, 0);
  EXPECT_EQ(error.pixels, 2u);
  EXPECT_EQ(error.without, 1u);
  // All but the roots are exact.
  EXPECT_EQ(error.reference_mean, 2);
  EXPECT_EQ(error.mean_absolute, 0.75);
  EXPECT_DOUBLE_EQ(error.relative_rmse, std::sqrt(0.625) / 2);
  EXPECT_DOUBLE_EQ(error.standard_error, std::sqrt(12.5));
  EXPECT_EQ(difference(images, 0).values[1], -1);
}

TEST(SphereImages, RefuseWhatCannotBeRendered) {
  const Table table = small_table();
  const auto message = [&](const SphereMaterial& material, const SphereSettings& settings) {
    const Table* const tables[] = {&table};
    return test::message_of<InputError>(
        [&] { render_sphere(tables, material, settings, "render", {1}); });
  };
  test::expect_one_line(message({0, 0.5, 1}, small_settings()), {"alpha_x 0", "[0.0001, 1]"});
  test::expect_one_line(message({0.5, 1.5, 1}, small_settings()), {"alpha_y 1.5", "[0.0001, 1]"});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  test::expect_one_line(message({0.5, 0.5, nan}, small_settings()), {"F0 nan", "[0, 1]"});
  SphereSettings nothing = small_settings();
  nothing.size = 0;
  test::expect_one_line(message(kMaterial, nothing), {"without pixels", "at least 1"});
}

}  // namespace
}  // namespace ltc
