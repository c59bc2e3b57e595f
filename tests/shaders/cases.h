// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The cases that drivers are asked, and what the library has for each.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "shaders/job.h"
#include "table/table.h"

namespace ltc::test::shaders {

// How a case looks up and which light it has, numbered as in cases.glsl.
enum class LookUpKind {
  exact,
  stacked_exact,
  filtered,
  stacked_filtered,
  isotropic,
  field,
  folded_field,
  folded_exact,
  folded_filtered
};
constexpr int look_up_kinds = 9;
constexpr bool is_folded(LookUpKind kind) {
  return kind >= LookUpKind::folded_field;
}
// The last four are no lights: a density, a sample, the share below the horizon, what makes up for
// it. Of folded lobes quad_as_sphere is a quad.
enum class LightKind {
  quad,
  star,
  ellipse,
  sphere,
  line,
  quad_as_sphere,
  density,
  direction,
  below_horizon,
  horizon_factor
};
constexpr int light_kinds = 10;

struct Case {
  Eigen::Vector3d view;
  double alpha_x, alpha_y;
  LookUpKind look_up;
  LightKind light;
  Eigen::Vector3d p, a, b;  // of single precision, as `view`
};

// What the tables are: of a field that no fit made, over a grid in a storage; and isotropic ones.
struct Tables {
  Table table, isotropic, field, folded_field, folded;
};
Tables make_tables(const Grid& grid, Storage storage, const Creases& creases = usual_creases);

// In all quadrants, and at the corners of the domain: roughnesses of 0 to 1 in both orders, views
// from the normal to the horizon, lights that either horizon cuts and that lie below.
std::vector<Case> make_cases(std::size_t count, std::uint64_t seed);

Job make_job(const Tables& tables, const std::vector<Case>& cases);

// By the library, in double precision: M as shaders unfold it, rows and columns alike; the terms;
// the share of the light; what the picture (whose texels hold place and level) shows, or k, g and
// h.
struct Expected {
  Eigen::Matrix3d matrix;
  double amplitude, fresnel, share;
  Eigen::Vector3d seen;
};
Expected expected(const Tables& tables, const Case& asked);

}  // namespace ltc::test::shaders
