// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a shader's inverse costs, and the snippet of docs/files.md, transcribed.
#include "judge/shader_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fit/lobe_frame.h"
#include "fit/lobes.h"
#include "ltc/ltsd.h"
#include "table/lookup.h"

namespace ltc {
namespace {

constexpr InverseOrder all_orders[] = {InverseOrder::divided, InverseOrder::adjugate,
                                       InverseOrder::factored};
constexpr Storage all_storages[] = {Storage::matrix, Storage::roughness_scaled,
                                    Storage::mirror_frame};

// A lobe as a table has it: P0 of the fits, a little away from it.
Eigen::Matrix3d matrix_of(const LobeFrame& frame) {
  Eigen::Matrix3d p = frame.first_order;
  p(0, 1) += 0.2;
  p(1, 0) -= 0.1;
  p(0, 2) += 0.3 * frame.lobe.alpha_x;
  return frame.to_matrix(p);
}

TEST(ShaderInverse, SinglePrecisionKeepsOrdinaryLobesInEveryOrder) {
  InversionMeter meter(512, 8);
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d m = matrix_of(frame);
    for (const Storage storage : all_storages)
      for (const InverseOrder order : all_orders) {
        const Eigen::Matrix3d seen =
            seen_by_shader(storage, stored_from_matrix(storage, m, lobe), frame, order,
                           Precision::single, Precision::single);
        // Some ten roundings of 6e-8, times what a narrow lobe and a slanted view make of them.
        EXPECT_LT(meter.error(frame, m, seen), 2e-5) << test::describe(lobe);
        // It does round.
        EXPECT_GT((seen / seen.norm() - m / m.norm()).norm(), 1e-9);
      }
  }
}

TEST(ShaderInverse, HalfPrecisionMovesThem) {
  InversionMeter meter(512, 8);
  for (const Lobe& lobe : test::ordinary_lobes()) {
    const LobeFrame frame(lobe);
    const Eigen::Matrix3d m = matrix_of(frame);
    const double in_memory =
        meter.error(frame, m,
                    seen_by_shader(Storage::matrix, m, frame, InverseOrder::adjugate,
                                   Precision::half, Precision::single));
    // Entries of 1 are rounded by up to 2^-12; these lobes are a tenth wide and more.
    EXPECT_LT(in_memory, 0.02) << test::describe(lobe);
    EXPECT_GT(in_memory, 1e-5) << test::describe(lobe);
    EXPECT_GT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, InverseOrder::adjugate,
                                         Precision::half, Precision::half)),
              in_memory / 2)
        << test::describe(lobe);
  }
}

TEST(ShaderInverse, FactoringOutTheRoughnessKeepsNarrowLobesInHalfPrecision) {
  // alpha_x alpha_y is below what half precision can hold.
  const Lobe lobe{1e-4, 1e-4, 0.6, 0.4};
  const LobeFrame frame(lobe);
  const Eigen::Matrix3d m = matrix_of(frame),
                        stored = stored_from_matrix(Storage::mirror_frame, m, lobe);
  InversionMeter meter(512, 8);
  const auto error = [&](InverseOrder order) {
    return meter.error(frame, m,
                       seen_by_shader(Storage::mirror_frame, stored, frame, order, Precision::half,
                                      Precision::half));
  };
  EXPECT_EQ(error(InverseOrder::adjugate), std::numeric_limits<double>::infinity());
  // Eleven bits, of a matrix of the order of one.
  EXPECT_LT(error(InverseOrder::factored), 0.01);
}

TEST(ShaderInverse, AMirroredMatrixIsAsGoodAsAny) {
  const LobeFrame frame({0.5, 0.3, 0.9, 0.4});
  const Eigen::Matrix3d m = Eigen::Vector3d(-1, 1, 1).asDiagonal() * matrix_of(frame);
  ASSERT_LT(m.determinant(), 0);
  InversionMeter meter(512, 8);
  for (const InverseOrder order : all_orders)
    EXPECT_LT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, order, Precision::single,
                                         Precision::single)),
              2e-5);
}

// A needle in a direction that all three columns nearly have.
TEST(ShaderInverse, WhatRoundingMakesSingularIsLost) {
  const LobeFrame frame({0.5, 0.3, 0.9, 0.4});
  Eigen::Matrix3d m = matrix_of(frame);
  m.leftCols<2>() = 1e-8 * m.leftCols<2>() + 0.02 * m.col(2).rowwise().replicate<2>();
  InversionMeter meter(512, 8);
  for (const InverseOrder order : all_orders)
    EXPECT_GT(meter.error(frame, m,
                          seen_by_shader(Storage::matrix, m, frame, order, Precision::single,
                                         Precision::single)),
              0.01);
}

// --- The snippets of docs/files.md, line by line -------------------------------------------------

using vec3 = Eigen::Vector3f;
using mat3 = Eigen::Matrix3f;

struct Folded {
  vec3 v;
  float alpha_x, alpha_y;
  Eigen::Vector2f signs;
  bool swapped;
};

// As look_up begins.
Folded fold_in_shader(vec3 v, float alpha_x, float alpha_y) {
  const Eigen::Vector2f signs(v.x() < 0.0f ? -1.0f : 1.0f, v.y() < 0.0f ? -1.0f : 1.0f);
  v.head<2>() = v.head<2>().cwiseAbs().eval();
  const bool swapped = alpha_y > alpha_x;
  if (swapped) {
    std::swap(v.x(), v.y());
    std::swap(alpha_x, alpha_y);
  }
  return {v, alpha_x, alpha_y, signs, swapped};
}

mat3 to_cosine(Storage storage, std::array<vec3, 3> row, const vec3& v, float alpha_x,
               float alpha_y) {
  constexpr float alpha_min = 1e-4f;
  const vec3 scale(std::max(alpha_x, alpha_min), std::max(alpha_y, alpha_min), 1.0f);
  const float s = 1.0f / (1.0f + v.z());
  const vec3 q[3] = {
      {v.z() + v.y() * v.y() * s, -v.x() * v.y() * s, v.x()},
      {-v.x() * v.y() * s, v.z() + v.x() * v.x() * s, v.y()},
      {-v.x(), -v.y(), v.z()},
  };
  if (storage == Storage::matrix)
    for (vec3& r : row)
      r = r.cwiseQuotient(scale).eval();
  if (storage != Storage::mirror_frame) {
    const std::array<vec3, 3> r = row;
    for (int i = 0; i < 3; ++i)
      row[i] = q[i].x() * r[0] + q[i].y() * r[1] + q[i].z() * r[2];
  }
  mat3 inverse, transposed_q;
  inverse << row[1].cross(row[2]), row[2].cross(row[0]), row[0].cross(row[1]);
  for (int i = 0; i < 3; ++i)
    inverse.col(i) = inverse.col(i).cwiseQuotient(scale).eval();
  transposed_q << q[0].transpose(), q[1].transpose(), q[2].transpose();
  return inverse * transposed_q;
}

vec3 vertex_to_cosine(const mat3& inverse, vec3 p, const Eigen::Vector2f& signs, bool swapped) {
  p.head<2>() = p.head<2>().cwiseProduct(signs).eval();
  if (swapped)
    std::swap(p.x(), p.y());
  return inverse * p;
}

// Integral of the cosine over what the snippets make of a light, in all digits, and over the light
// itself by the inverse in double.
struct Lit {
  double by_snippet, exact;
};
Lit light(Storage storage, const Lobe& lobe, double size) {
  const FoldedLobe folded = fold(lobe);
  const Eigen::Matrix3d m_folded = matrix_of(LobeFrame(folded.lobe));
  const Eigen::Matrix3f s = stored_from_matrix(storage, m_folded, folded.lobe).cast<float>();
  const Eigen::Matrix3d m = folded.unfold * m_folded;
  const Folded shader =
      fold_in_shader(lobe.omega_v().cast<float>(), static_cast<float>(lobe.alpha_x),
                     static_cast<float>(lobe.alpha_y));
  const mat3 inverse =
      to_cosine(storage, {s.row(0).transpose(), s.row(1).transpose(), s.row(2).transpose()},
                shader.v, shader.alpha_x, shader.alpha_y);
  std::vector<Eigen::Vector3d> vertices, seen;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    vertices.push_back(m * Eigen::Vector3d(0.2 + x * size / 2, 0.1 + y * size / 2, 1));
    seen.push_back(
        vertex_to_cosine(inverse, vertices.back().cast<float>(), shader.signs, shader.swapped)
            .cast<double>());
  }
  return {std::abs(LinearlyTransformed(Eigen::Matrix3d::Identity()).integrate_polygon(seen)),
          std::abs(LinearlyTransformed(m).integrate_polygon(vertices))};
}

constexpr double kPi = std::numbers::pi;

// All quadrants, both ways of anisotropy, mirrored and not.
std::vector<Lobe> lobes_to_fold() {
  std::vector<Lobe> lobes;
  for (const double phi : {0.4, kPi - 0.4, kPi + 1.1, 2 * kPi - 0.9})
    for (const auto& [alpha_x, alpha_y] : {std::pair{0.6, 0.2}, {0.2, 0.6}, {0.05, 0.04}})
      lobes.push_back({alpha_x, alpha_y, 1.1, phi});
  return lobes;
}

TEST(ShaderInverse, TheDocumentedSnippetsTakeLightsToTheCosine) {
  for (const Lobe& lobe : lobes_to_fold())
    for (const Storage storage : all_storages)
      for (const double size : {2.0, 0.1}) {
        const Lit lit = light(storage, lobe, size);
        // A vertex is rounded by 6e-8 of its direction, which is up to 2e-6 of these lobes' width:
        // over the light's size, both ways.
        EXPECT_NEAR(lit.by_snippet / lit.exact, 1, 1e-5 / size)
            << test::describe(lobe) << " " << name_of(storage);
      }
}

TEST(ShaderInverse, TheDocumentedSnippetsKeepNarrowLobes) {
  for (const Storage storage : all_storages) {
    const Lit lit = light(storage, {1e-4, 1e-4, 0.8, 0.4}, 1);
    // 6e-8 over 1e-4, some times over: the vertices' rounding, of which the inverse can say
    // nothing.
    EXPECT_NEAR(lit.by_snippet / lit.exact, 1, 5e-3) << name_of(storage);
    EXPECT_GT(std::abs(lit.by_snippet / lit.exact - 1), 1e-7);
  }
}

}  // namespace
}  // namespace ltc
