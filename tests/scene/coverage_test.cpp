// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "scene/coverage.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/angle.h"
#include "fit/symmetry_plan.h"
#include "table/lookup.h"
#include "table/synthetic.h"

namespace ltc {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

double at(const Interval& interval, double u) {
  return u == 1 ? interval.high : interval.low + u * (interval.high - interval.low);
}

LobeRoughness at(const std::variant<RoughnessBox, PerceptualRoughness>& roughness, double u,
                 double v) {
  if (const auto* box = std::get_if<RoughnessBox>(&roughness))
    return {at(box->alpha_x, u), at(box->alpha_y, v)};
  const auto& range = std::get<PerceptualRoughness>(roughness);
  return lobe_roughness(at(range.roughness, u), at(range.anisotropy, v));
}

std::string text_of(const std::variant<RoughnessBox, PerceptualRoughness>& roughness) {
  const auto text = [](const char* kind, const Interval& a, const Interval& b) {
    return fmt::format("{} [{}, {}], [{}, {}]", kind, a.low, a.high, b.low, b.high);
  };
  if (const auto* box = std::get_if<RoughnessBox>(&roughness))
    return text("box", box->alpha_x, box->alpha_y);
  const auto& range = std::get<PerceptualRoughness>(roughness);
  return text("perceptual", range.roughness, range.anisotropy);
}

// Looks a lobe up: the nodes that get a weight.
template <typename Action>
void for_each_touched(const Grid& grid, const LobeRoughness& roughness, double theta_radians,
                      double phi_radians, Action action) {
  const Lobe lobe{roughness.alpha_x, roughness.alpha_y, theta_radians, phi_radians};
  const Interpolation corners = interpolation(grid, fold(lobe).lobe);
  for (std::size_t i = 0; i < corners.nodes.size(); ++i)
    if (corners.weights[i] != 0)
      action(corners.nodes[i]);
}

std::size_t count(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

std::size_t count_fits(const Grid& grid, const std::vector<bool>& needed) {
  std::size_t fits = 0;
  const auto plan = plan_by_symmetry(grid, needed);
  for (std::size_t flat = 0; flat < plan.size(); ++flat)
    fits += plan[flat].representative == flat;
  return fits;
}

Scene scene_of(const std::variant<RoughnessBox, PerceptualRoughness>& roughness,
               Interval theta_radians = {0, quarter_turn}) {
  return {{{"material", roughness, theta_radians}}};
}

Interval only(double value) {
  return {value, value};
}

// ---- Grids and materials ----

Grid warped_grid() {
  Grid grid = Grid::paper({6, 7, 5, 3});
  grid.alpha = Axis::make(0, 1, 6, Warp::sqrt);
  grid.lambda = Axis::make(0, 1, 7, Warp::sqrt);
  grid.theta = Axis::make(0, 1.55, 5, Warp::complement_sqrt);
  return grid;
}

std::vector<Grid> grids() {
  Grid dense_at_one = Grid::paper({5, 6, 2, 2});
  dense_at_one.alpha.warp = dense_at_one.lambda.warp = Warp::complement_sqrt;
  dense_at_one.alpha = Axis::make(0, 1, 5, Warp::complement_sqrt);
  dense_at_one.lambda = Axis::make(0, 1, 6, Warp::complement_sqrt);
  return {Grid::paper(8), Grid::paper({2, 2, 8, 8}), warped_grid(),
          dense_at_one,   testing::uneven_grid(),    Grid::paper({1, 1, 1, 1})};
}

// A range within [0, 1] that often ends at nodes, at 0 or at 1, and often has no extent.
Interval random_interval(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto value = [&] {
    switch (random() % 5) {
      case 0:
        return static_cast<double>(random() % 8) / 7;
      case 1:
        return random() % 2 ? 1.0 : 0.0;
      default:
        return uniform(random);
    }
  };
  const double a = value(), b = random() % 3 == 0 ? a : value();
  return {std::min(a, b), std::max(a, b)};
}

Material random_material(std::mt19937& random) {
  Material material;
  const Interval first = random_interval(random), second = random_interval(random);
  if (random() % 2)
    material.roughness = RoughnessBox{first, second};
  else
    material.roughness = PerceptualRoughness{first, second};
  const Interval theta = random_interval(random);
  material.theta_radians = {theta.low * quarter_turn, theta.high * quarter_turn};
  return material;
}

// ---- Enough: no look-up touches what is not needed ----

// How often random look-ups of the materials touch an entry that `needed` lacks.
std::size_t misses(const Scene& scene, const Grid& grid, const std::vector<bool>& needed,
                   int lookups, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t missed = 0;
  // The ends of ranges are where look-ups go astray.
  const auto parameter = [&] { return random() % 8 ? uniform(random) : double(random() % 2); };
  for (const Material& material : scene.materials)
    for (int i = 0; i < lookups; ++i) {
      const double u = parameter(), v = parameter();
      for_each_touched(grid, at(material.roughness, u, v), at(material.theta_radians, parameter()),
                       (4 * uniform(random) - 2) * std::numbers::pi,
                       [&](std::size_t flat) { missed += !needed[flat]; });
    }
  return missed;
}

TEST(Coverage, NoLookUpTouchesAnEntryThatIsNotNeeded) {
  std::mt19937 random(20260101);
  for (const Grid& grid : grids())
    for (int trial = 0; trial < 150; ++trial) {
      const Scene scene{{random_material(random), random_material(random)}};
      EXPECT_EQ(misses(scene, grid, needed_entries(scene, grid), 500, random), 0u) << trial;
    }
}

TEST(Coverage, TheCheckSeesAMissingEntry) {
  std::mt19937 random(20260102);
  const Grid grid = Grid::paper(8);
  const Scene scene = scene_of(PerceptualRoughness{{0.2, 0.6}, {0, 0.5}});
  std::vector<bool> needed = needed_entries(scene, grid);
  // One in the middle of the scene: at its edges a rounding decides who touches what.
  std::size_t some = needed.size();
  for_each_touched(grid, at(scene.materials[0].roughness, 0.5, 0.5), quarter_turn / 2, 0.5,
                   [&](std::size_t flat) { some = flat; });
  ASSERT_LT(some, needed.size());
  ASSERT_TRUE(needed[some]);
  needed[some] = false;
  EXPECT_GT(misses(scene, grid, needed, 20000, random), 0u);
}

// ---- No more than that: some look-up touches every needed entry ----

// What look-ups touch that go through the roughnesses of a material, and at each of them through
// theta and phi. The inside of the roughnesses is gone through coarsely but for small values,
// where all lambda lie close together; the border finely, and closely on both sides of where alpha
// meets a plane of nodes, since lambda is least and greatest there or in a corner.
std::vector<bool> touched_entries(const Material& material, const Grid& grid) {
  constexpr int inside_steps = 128, border_steps = 2048;
  const auto squared = [](double x) { return x * x; };
  std::vector<bool> touched(grid.size(), false);
  const auto look_up_at = [&](double u, double v) {
    const LobeRoughness roughness = at(material.roughness, u, v);
    const auto for_each = [&](double w, double x, const auto& action) {
      for_each_touched(grid, roughness, at(material.theta_radians, w), x * quarter_turn, action);
    };
    // The roughness's nodes are the same at every angle: one angle tells whether they are new.
    bool is_new = false;
    for_each(0, 0, [&](std::size_t flat) { is_new = is_new || !touched[flat]; });
    for (int i = 0; is_new && i <= 256; ++i)
      for (int j = 0; j <= 16; ++j)
        for_each(i / 256.0, j / 16.0, [&](std::size_t flat) { touched[flat] = true; });
  };
  for (int i = 0; i <= inside_steps; ++i)
    for (int j = 0; j <= inside_steps; ++j)
      look_up_at(squared(i / double(inside_steps)), squared(j / double(inside_steps)));
  // Along one side of the square, from corner to corner.
  struct Corner {
    double u, v;
  };
  const auto go_along = [&](const Corner& from, const Corner& to) {
    const auto point = [&](double x) {
      return Corner{std::lerp(from.u, to.u, x), std::lerp(from.v, to.v, x)};
    };
    const auto alpha_cell = [&](double x) {
      const LobeRoughness roughness = at(material.roughness, point(x).u, point(x).v);
      return std::floor(grid.alpha.position(std::max(roughness.alpha_x, roughness.alpha_y)));
    };
    for (int i = 0; i < border_steps; ++i) {
      double low = i / double(border_steps), high = (i + 1) / double(border_steps);
      const double low_cell = alpha_cell(low);
      // To 1e-8, not to within the snap of Axis::position, where both sides are the plane.
      for (int k = 0; k < 14 && low_cell != alpha_cell(high); ++k) {
        const double middle = (low + high) / 2;
        (alpha_cell(middle) == low_cell ? low : high) = middle;
      }
      look_up_at(point(low).u, point(low).v);
      look_up_at(point(high).u, point(high).v);
    }
  };
  go_along({0, 0}, {1, 0});
  go_along({0, 1}, {1, 1});
  go_along({0, 0}, {0, 1});
  go_along({1, 0}, {1, 1});
  return touched;
}

// Whether look-ups touch all that is needed, and nothing else; says where they do not.
void expect_tight(const Material& material, const Grid& grid) {
  const auto needed = needed_entries({{material}}, grid), touched = touched_entries(material, grid);
  std::string different;
  for (std::size_t flat = 0; flat < needed.size(); ++flat)
    if (const NodeIndex node = grid.node(flat); needed[flat] != touched[flat] && node.phi == 0)
      different += fmt::format(" {}/{}/{} {}", node.alpha, node.lambda, node.theta,
                               needed[flat] ? "is not touched," : "is not needed,");
  EXPECT_EQ(different, "") << text_of(material.roughness);
  EXPECT_EQ(needed, touched);
}

TEST(Coverage, SomeLookUpTouchesEveryNeededEntry) {
  std::mt19937 random(20260103);
  for (const Grid& grid : grids())
    for (int trial = 0; trial < 40; ++trial) {
      const Material material = random_material(random);
      expect_tight(material, grid);
    }
}

TEST(Coverage, TheCheckSeesAnEntryTooMany) {
  const Grid grid = Grid::paper(8);
  const Material material = scene_of(RoughnessBox{only(0.5), only(0.1)}).materials[0];
  const auto touched = touched_entries(material, grid);
  EXPECT_EQ(count(touched), 2u * 2 * 8 * 8);
  EXPECT_FALSE(touched[grid.flat({5, 1, 0, 0})]);
}

TEST(Coverage, RangesThatMeetZeroAndOneAreTight) {
  const std::vector<Interval> ends = {only(0), only(1), {0, 1}, {0, 0.37}, {0.37, 1}, only(0.37)};
  for (const Grid& grid : grids())
    for (const Interval& first : ends)
      for (const Interval& second : ends) {
        expect_tight(scene_of(RoughnessBox{first, second}).materials[0], grid);
        expect_tight(scene_of(PerceptualRoughness{first, second}).materials[0], grid);
      }
}

// ---- Counts that can be had by hand, on the paper's grid ----

TEST(Coverage, IsotropicScenesNeedOneSliceAndFit64) {
  const Grid grid = Grid::paper(8);
  for (const Grid& each : {grid, warped_grid()}) {
    const auto needed = needed_entries(scene_of(PerceptualRoughness{{0, 1}, only(0)}), each);
    for (std::size_t flat = 0; flat < needed.size(); ++flat)
      EXPECT_EQ(needed[flat], each.node(flat).lambda + 1 == each.lambda.size());
  }
  const auto needed = needed_entries(scene_of(PerceptualRoughness{{0, 1}, only(0)}), grid);
  EXPECT_EQ(count(needed), 8u * 8 * 8);
  EXPECT_EQ(count_fits(grid, needed), 64u);  // alpha and theta
}

TEST(Coverage, OneMaterialBetweenTheNodesNeedsOneCell) {
  const Grid grid = Grid::paper(8);
  // alpha = 0.5 and lambda = 0.2 lie between nodes 3 and 4, and 1 and 2, whichever is which axis.
  for (const RoughnessBox& box :
       {RoughnessBox{only(0.5), only(0.1)}, RoughnessBox{only(0.1), only(0.5)}}) {
    const auto needed = needed_entries(scene_of(box), grid);
    for (std::size_t flat = 0; flat < needed.size(); ++flat) {
      const NodeIndex node = grid.node(flat);
      EXPECT_EQ(needed[flat],
                (node.alpha == 3 || node.alpha == 4) && (node.lambda == 1 || node.lambda == 2));
    }
    // At theta = 0 all phi are one fit: 4 (1 + 7 * 8).
    EXPECT_EQ(count_fits(grid, needed), 228u);
  }
}

TEST(Coverage, AMaterialOnNodePlanesNeedsThemAlone) {
  for (const Grid& grid : {Grid::paper(8), warped_grid()}) {
    const double alpha = grid.alpha.nodes[3], lambda = grid.lambda.nodes[2];
    const double theta = grid.theta.nodes[2];
    const auto needed = needed_entries(
        scene_of(RoughnessBox{only(alpha), only(lambda * alpha)}, only(theta)), grid);
    for (std::size_t flat = 0; flat < needed.size(); ++flat) {
      const NodeIndex node = grid.node(flat);
      EXPECT_EQ(needed[flat], node.alpha == 3 && node.lambda == 2 && node.theta == 2);
    }
  }
}

TEST(Coverage, ViewAnglesLimitTheta) {
  const Grid grid = Grid::paper(8);  // theta every 12.86 degrees
  const Interval limits{radians_of_degrees(30), radians_of_degrees(40)};
  const auto needed = needed_entries(scene_of(PerceptualRoughness{only(0), only(0)}, limits), grid);
  for (std::size_t flat = 0; flat < needed.size(); ++flat) {
    const NodeIndex node = grid.node(flat);
    EXPECT_EQ(needed[flat],
              node.alpha == 0 && node.lambda == 7 && node.theta >= 2 && node.theta <= 4);
  }
}

TEST(Coverage, EverythingIsAllEntries) {
  for (const Grid& grid : {Grid::paper(8), warped_grid()})
    EXPECT_EQ(count(needed_entries(scene_of(RoughnessBox{{0, 1}, {0, 1}}), grid)), grid.size());
}

TEST(Coverage, ScenesNeedWhatTheirMaterialsNeed) {
  std::mt19937 random(20260104);
  const Grid grid = Grid::paper({8, 8, 4, 2});
  for (int trial = 0; trial < 20; ++trial) {
    const Material a = random_material(random), b = random_material(random);
    const auto needed_a = needed_entries({{a}}, grid), needed_b = needed_entries({{b}}, grid);
    auto either = needed_a;
    for (std::size_t i = 0; i < either.size(); ++i)
      either[i] = needed_a[i] || needed_b[i];
    EXPECT_EQ(needed_entries({{a, b}}, grid), either);
  }
}

}  // namespace
}  // namespace ltc
