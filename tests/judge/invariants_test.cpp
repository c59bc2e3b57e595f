// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Each invariant holds for a table that is sound, and finds the fault that it is there to find.
#include "judge/invariants.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "ltc/ltsd.h"
#include "pipeline/generate.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Config small_config(Storage storage) {
  Config config;
  config.grid = Grid::paper(4);
  config.storage = storage;
  config.refine.steps = 0;  // every node a lobe of its own
  return config;
}

// Fitted once for all tests.
const Table& good_table() {
  static const Table table = generate_table(small_config(Storage::matrix), {1});
  return table;
}

std::vector<InvariantResult> check(const Table& table, int threads = 1) {
  return check_invariants(table, InvariantLimits{}, {threads});
}

const InvariantResult& named(const std::vector<InvariantResult>& results, const std::string& name) {
  for (const InvariantResult& result : results)
    if (result.name == name)
      return result;
  throw std::runtime_error("no invariant " + name);
}

std::set<std::string> failed(const std::vector<InvariantResult>& results) {
  std::set<std::string> names;
  for (const InvariantResult& result : results)
    if (!result.passed)
      names.insert(result.name);
  return names;
}

void replace_matrix(Table& table, std::size_t flat,
                    const std::function<Eigen::Matrix3d(const Eigen::Matrix3d&)>& change) {
  table.set_stored(flat, change(table.stored_at(flat)));
}

Eigen::Matrix3d turn(double degrees) {
  return Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

TEST(Invariants, HoldForASoundTableOfAnyStorage) {
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    const Table table =
        storage == Storage::matrix ? good_table() : generate_table(small_config(storage), {1});
    const std::vector<InvariantResult> results = check(table);
    EXPECT_EQ(results.size(), 15u);
    for (const InvariantResult& result : results) {
      EXPECT_TRUE(result.passed) << name_of(storage) << ": " << result.message;
      EXPECT_TRUE(result.checked) << result.name;
      EXPECT_EQ(result.has_worst, result.name != "shapes and axes") << result.name;
      EXPECT_EQ(result.message, "");
      EXPECT_TRUE(result.entries.empty());
    }
    // And they have looked: these are never without any.
    for (const char* name :
         {"determinant", "condition number", "third column", "alignment", "half precision",
          "float inverse", "below horizon", "albedo quadrature", "stored loss", "neighbours"})
      EXPECT_GT(named(results, name).value, 0) << name;
  }
}

TEST(Invariants, FoldsAreJudgedToo) {
  Config config = small_config(Storage::folded);
  config.fit.lobe = LobeKind::folded;
  config.field.creases = config.fit.creases();
  config.field.queries = 2000;
  // So few queries leave lobes at the horizon open: from this start they jump no more than GGX
  // does.
  config.fit.gauss_newton.loss = config.refine.sampling.loss = LossKind::samples;
  const Table table = generate_table(config, {1});
  std::vector<InvariantResult> results = check(table);
  EXPECT_EQ(failed(results), std::set<std::string>{});
  EXPECT_GT(named(results, "fold one to one").value, 0);
  EXPECT_FALSE(named(results, "alignment").checked) << "creases turn with the matrix";
  EXPECT_GT(named(results, "neighbours").value, 0);
  // Each sees its fault.
  const std::size_t upward = table.grid.flat({2, 1, 0, 2}), along = table.grid.flat({2, 1, 2, 0}),
                    general = table.grid.flat({2, 1, 2, 2});
  const auto fails = [&](std::size_t flat, std::size_t number, float value) {
    Table broken = table;
    broken.fold[2 * flat + number] = value;
    return failed(check(broken));
  };
  EXPECT_TRUE(fails(along, 0, 0.1f).contains("zeros of equation 16"));
  EXPECT_TRUE(fails(upward, 1, 0.9f).contains("theta = 0 over phi"));
  EXPECT_TRUE(fails(general, 0, 5.0f).contains("stored loss"));
}

TEST(Invariants, AreTheSameWithAnyNumberOfThreads) {
  const std::vector<InvariantResult> one = check(good_table(), 1), three = check(good_table(), 3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].value, three[i].value) << one[i].name;
    EXPECT_EQ(one[i].worst, three[i].worst) << one[i].name;
  }
}

// Damages to one entry, and the check that must name it and no other entry.
TEST(Invariants, EachFindsItsFaultAndNamesTheEntry) {
  const Grid& grid = good_table().grid;
  const std::size_t general = grid.flat({2, 2, 1, 1}), at_phi_0 = grid.flat({2, 2, 1, 0});
  const std::size_t at_phi_90 = grid.flat({2, 1, 2, 3}), upward = grid.flat({2, 1, 0, 2});
  struct Damage {
    const char* invariant;
    std::size_t entry;
    std::function<void(Table&, std::size_t)> damage;
  };
  const auto matrix = [](auto change) {
    return [change](Table& table, std::size_t flat) { replace_matrix(table, flat, change); };
  };
  using M = Eigen::Matrix3d;
  const std::vector<Damage> damages = {
      {"finite", general, matrix([](M m) {
         m(1, 1) = nan;
         return m;
       })},
      {"finite", general, [](Table& t, std::size_t i) { t.amplitude[i] = std::nanf(""); }},
      {"finite", general, [](Table& t, std::size_t i) { t.fresnel[i] = INFINITY; }},
      {"finite", general, [](Table& t, std::size_t i) { t.sw_loss[i] = std::nanf(""); }},
      {"finite", general,
       [](Table& t, std::size_t i) {
         t.status[i] = Status::failed;
         t.set_stored(i, Eigen::Matrix3d::Constant(nan));
       }},
      {"determinant", general, matrix([](const M& m) -> M { return -m; })},
      {"determinant", general, matrix([](M m) {
         m.col(1) = -m.col(1);
         return m;
       })},
      {"determinant", general, matrix([](M m) {
         m.col(1) = m.col(0);
         return m;
       })},
      {"condition number", general, matrix([](M m) {
         m.col(1) = m.col(0);
         return m;
       })},
      {"condition number", general, matrix([](M m) {
         m.col(1) *= 1e-8;
         return m;
       })},
      {"zeros of equation 16", at_phi_0, matrix([](M m) {
         m(0, 1) = 1e-6;
         return m;
       })},
      {"zeros of equation 16", at_phi_90, matrix([](M m) {
         m(0, 2) = -1e-6;
         return m;
       })},
      {"zeros of equation 16", upward, matrix([](M m) {
         m(2, 0) = 1e-6;
         return m;
       })},
      {"theta = 0 over phi", upward, matrix([](M m) {
         m(0, 0) += 1e-6;
         return m;
       })},
      {"theta = 0 over phi", upward, [](Table& t, std::size_t i) { t.fresnel[i] += 1e-6f; }},
      {"third column", general, matrix([](const M& m) -> M { return 1.5 * m; })},
      {"third column", general, matrix([](M m) {
         m.col(2) *= 1.00001;
         return m;
       })},
      {"alignment", general, matrix([](const M& m) -> M { return m * turn(1); })},
      {"alignment", general, matrix([](const M& m) -> M { return turn(30) * m; })},
      {"half precision", general, matrix([](M m) {
         m.col(1) *= 1e-8;
         return m;
       })},
      {"half precision", general, matrix([](M m) {
         m.col(1) *= 1e6;
         return m;
       })},
      // A needle in a direction that all three columns nearly have.
      {"float inverse", general, matrix([](M m) {
         m.leftCols<2>() = 1e-8 * m.leftCols<2>() + 0.02 * m.col(2).rowwise().replicate<2>();
         return m;
       })},
      {"albedo range", general, [](Table& t, std::size_t i) { t.amplitude[i] = 1.0001f; }},
      {"albedo range", general, [](Table& t, std::size_t i) { t.fresnel[i] = -1e-6f; }},
      {"albedo range", general,
       [](Table& t, std::size_t i) { t.fresnel[i] = t.amplitude[i] + 1e-6f; }},
      {"albedo quadrature", general, [](Table& t, std::size_t i) { t.amplitude[i] -= 4e-4f; }},
      {"albedo quadrature", general, [](Table& t, std::size_t i) { t.fresnel[i] += 4e-4f; }},
      {"stored loss", general, [](Table& t, std::size_t i) { t.sw_loss[i] /= 4; }},
      {"stored loss", general, matrix([](const M& m) -> M { return turn(30) * m; })},
      {"stored loss", general, matrix([](M m) {
         m.col(0) *= 1.2;
         return m;
       })},
      {"neighbours", general, matrix([](const M& m) -> M { return turn(30) * m; })},
      {"neighbours", general, matrix([](M m) {
         m.col(0) *= 1.7;
         return m;
       })},
  };
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const Damage& damage = damages[i];
    SCOPED_TRACE(std::string(damage.invariant) + ", damage " + std::to_string(i));
    Table table = good_table();
    damage.damage(table, damage.entry);
    const std::vector<InvariantResult> results = check(table);
    const InvariantResult& result = named(results, damage.invariant);
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.entries, std::vector<std::size_t>{damage.entry});
    EXPECT_EQ(result.worst, damage.entry);
    const NodeIndex node = grid.node(damage.entry);
    const std::string entry = "entry " + std::to_string(node.alpha) + "," +
                              std::to_string(node.lambda) + "," + std::to_string(node.theta) + "," +
                              std::to_string(node.phi) + " (alpha 0.667, lambda ";
    EXPECT_NE(result.message.find(entry), std::string::npos) << result.message;
    EXPECT_EQ(result.message.find('\n'), std::string::npos);
  }
}

// The lobe is the same, so only alignment may tell.
TEST(Invariants, ATurnAboutTheCosinesAxisIsAMatterOfAlignmentAlone) {
  Table table = good_table();
  const std::size_t general = table.grid.flat({2, 2, 1, 1});
  replace_matrix(table, general,
                 [](const Eigen::Matrix3d& m) -> Eigen::Matrix3d { return m * turn(30); });
  EXPECT_EQ(failed(check(table)), std::set<std::string>{"alignment"});
}

TEST(Invariants, SwappedNeighboursAreBothNamed) {
  for (const auto& [a, b] : {std::pair{NodeIndex{1, 1, 1, 1}, NodeIndex{1, 1, 2, 1}},
                             {NodeIndex{1, 1, 1, 1}, NodeIndex{2, 1, 1, 1}},
                             {NodeIndex{2, 1, 2, 1}, NodeIndex{2, 2, 2, 1}},
                             {NodeIndex{1, 1, 2, 1}, NodeIndex{1, 1, 2, 2}}}) {
    Table table = good_table();
    const std::size_t first = table.grid.flat(a), second = table.grid.flat(b);
    const Eigen::Matrix3d matrix = table.stored_at(first);
    table.set_stored(first, table.stored_at(second));
    table.set_stored(second, matrix);
    const std::vector<InvariantResult> results = check(table);
    const std::vector<std::size_t>& entries = named(results, "stored loss").entries;
    EXPECT_EQ(std::set<std::size_t>(entries.begin(), entries.end()),
              (std::set<std::size_t>{first, second}));
    // Without the stored loss, as in an .npy: at least one, and none but these.
    const InvariantResult& neighbours = named(results, "neighbours");
    EXPECT_FALSE(neighbours.passed);
    for (const std::size_t entry : neighbours.entries)
      EXPECT_TRUE(entry == first || entry == second) << entry;
  }
}

// Two adjacent entries, broken in different ways, inside the table and along its edges: without the
// stored losses, as in an .npy, both are named and no other.
TEST(Invariants, AdjacentBrokenEntriesAreBothNamedByTheirJumps) {
  using M = Eigen::Matrix3d;
  const auto turned = [](const M& m) -> M { return turn(30) * m; };
  const auto negated = [](const M& m) -> M { return -m; };
  const auto wider = [](M m) {
    m.col(0) *= 2.5;
    return m;
  };
  const auto tilted = [](const M& m) -> M {
    return Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix() * m;
  };
  using Fault = std::function<M(const M&)>;
  struct Pair {
    NodeIndex a;
    Fault of_a;
    NodeIndex b;
    Fault of_b;
  };
  const std::vector<Pair> pairs = {
      {{1, 1, 1, 1}, turned, {2, 1, 1, 1}, negated}, {{2, 1, 2, 1}, wider, {2, 2, 2, 1}, tilted},
      {{1, 2, 2, 2}, negated, {1, 2, 1, 2}, wider},  {{2, 2, 2, 1}, tilted, {2, 2, 2, 2}, negated},
      {{3, 1, 2, 0}, wider, {3, 1, 2, 1}, negated},  {{1, 0, 2, 3}, turned, {2, 0, 2, 3}, tilted},
      {{2, 3, 2, 1}, tilted, {1, 3, 2, 1}, negated}, {{1, 1, 3, 3}, negated, {1, 1, 2, 3}, wider},
  };
  const TableContents matrices_only{.albedo = false, .loss = false};
  for (const Pair& pair : pairs) {
    Table table = good_table();
    const std::size_t a = table.grid.flat(pair.a), b = table.grid.flat(pair.b);
    SCOPED_TRACE(a);
    replace_matrix(table, a, pair.of_a);
    replace_matrix(table, b, pair.of_b);
    const std::vector<InvariantResult> results =
        check_invariants(table, InvariantLimits{}, {1}, matrices_only);
    const std::vector<std::size_t>& entries = named(results, "neighbours").entries;
    EXPECT_EQ(std::set<std::size_t>(entries.begin(), entries.end()), (std::set<std::size_t>{a, b}));
  }
}

TEST(Invariants, OnlyEntriesThatAreNotSkippedAreJudged) {
  Table table = good_table();
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const NodeIndex node = table.grid.node(flat);
    if (node.alpha != 2 || node.phi == 0) {
      table.status[flat] = Status::skipped;
      table.set_stored(flat, Eigen::Matrix3d::Constant(nan));
      table.amplitude[flat] = table.fresnel[flat] = table.sw_loss[flat] = std::nanf("");
    }
  }
  const std::vector<InvariantResult> results = check(table);
  EXPECT_EQ(failed(results), std::set<std::string>{});
  EXPECT_TRUE(named(results, "theta = 0 over phi").has_worst);
  EXPECT_TRUE(named(results, "neighbours").has_worst);
  // With no entry left there is nothing to judge, which is no fault either.
  table.status.assign(table.grid.size(), Status::skipped);
  for (const InvariantResult& result : check(table)) {
    EXPECT_TRUE(result.passed) << result.name;
    EXPECT_FALSE(result.has_worst) << result.name;
  }
}

TEST(Invariants, WhatIsNotInTheFileIsNotPassedSilently) {
  Table table = good_table();
  table.amplitude.assign(table.grid.size(), std::nanf(""));
  table.fresnel = table.sw_loss = table.amplitude;
  const TableContents none{.albedo = false, .loss = false};
  const std::vector<InvariantResult> results =
      check_invariants(table, InvariantLimits{}, {1}, none);
  EXPECT_EQ(failed(results), std::set<std::string>{});
  std::set<std::string> unchecked;
  for (const InvariantResult& result : results)
    if (!result.checked)
      unchecked.insert(result.name);
  EXPECT_EQ(unchecked, (std::set<std::string>{"albedo range", "albedo quadrature", "stored loss"}));
  // In a file that has them, the same values are a fault.
  EXPECT_TRUE(failed(check(table)).contains("finite"));
}

TEST(Invariants, WhatHasNoLimitIsToldAndNotJudged) {
  const std::vector<InvariantResult> results = check(good_table());
  for (const InvariantResult& result : results)
    EXPECT_EQ(result.judged, result.name != "half precision" && result.name != "below horizon")
        << result.name;
  EXPECT_EQ(allowed_text(named(results, "half precision")), "any");
  EXPECT_EQ(named(results, "half precision").reason, "no limit is set");
  InvariantLimits limits;
  limits.half_error = 0.01;
  limits.below_horizon = 0.01;
  const std::vector<InvariantResult> strict = check_invariants(good_table(), limits, {1});
  // 16 bits lose the smoothest lobes alone.
  const InvariantResult& half = named(strict, "half precision");
  EXPECT_TRUE(half.judged);
  EXPECT_FALSE(half.passed);
  for (const std::size_t entry : half.entries)
    EXPECT_EQ(good_table().grid.node(entry).alpha, 0u);
  EXPECT_FALSE(named(strict, "below horizon").passed);
}

TEST(Invariants, ALobeTurnedBelowTheHorizonIsFound) {
  Table table = good_table();
  const std::size_t general = table.grid.flat({2, 2, 1, 1});
  replace_matrix(table, general, [](const Eigen::Matrix3d& m) -> Eigen::Matrix3d {
    return Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix() * m;
  });
  InvariantLimits limits;
  limits.below_horizon = 0.5;
  const std::vector<InvariantResult> results = check_invariants(table, limits, {1});
  EXPECT_EQ(named(results, "below horizon").entries, std::vector<std::size_t>{general});
  EXPECT_EQ(named(results, "below horizon").value, share_below_horizon(table.matrix_at(general)));
}

// Nodes of a refined table are turned for their cells; of 16 bits there is nothing more to lose.
TEST(Invariants, WhatDoesNotApplyIsNotChecked) {
  Table table = good_table();
  table.refined = true;
  table.precision = Precision::half;
  InvariantLimits limits;
  limits.alignment_degrees = 180;
  const auto reason_of = [&](const char* name) {
    const std::vector<InvariantResult> results = check_invariants(table, limits, {1});
    const InvariantResult& result = named(results, name);
    EXPECT_FALSE(result.checked);
    EXPECT_TRUE(result.passed);
    return result.reason;
  };
  EXPECT_EQ(reason_of("half precision"), "its values have 16 bits already");
  EXPECT_EQ(reason_of("alignment"), "nodes of a refined table serve the cells about them");
  table.refined.reset();
  EXPECT_EQ(reason_of("alignment"), "whether the table is refined is not known");
}

TEST(Invariants, ATableOfTheWrongShapeIsNotLookedIntoFurther) {
  Table table = good_table();
  table.fresnel.pop_back();
  const std::vector<InvariantResult> results = check(table);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_FALSE(results[0].passed);
  EXPECT_EQ(results[0].message, "table: fresnel has 255 values; the axes ask for 256");
  table = good_table();
  std::swap(table.grid.theta.nodes[1], table.grid.theta.nodes[2]);
  EXPECT_EQ(failed(check(table)), std::set<std::string>{"shapes and axes"});
}

TEST(Invariants, FailedEntriesStandWorstFirst) {
  Table table = good_table();
  const Grid& grid = table.grid;
  const std::size_t worse = grid.flat({2, 2, 2, 2}), bad = grid.flat({1, 1, 1, 1});
  for (const auto& [entry, factor] : {std::pair{bad, 1.1}, {worse, 1.2}})
    replace_matrix(table, entry, [scale = factor](const Eigen::Matrix3d& m) -> Eigen::Matrix3d {
      return scale * m;
    });
  const std::vector<InvariantResult> results = check(table);
  const InvariantResult& result = named(results, "third column");
  EXPECT_EQ(result.entries, (std::vector<std::size_t>{worse, bad}));
  EXPECT_NEAR(result.value, 0.2, 1e-6);  // rounding
}

TEST(Invariants, AStopIsHeeded) {
  class Stopped final : public Progress {
    void begin_stage(std::string_view, std::size_t) override { request_stop(); }
    void end_stage() override {}
  } progress;
  EXPECT_THROW(check_invariants(good_table(), InvariantLimits{}, {1, &progress}), Interrupted);
}

}  // namespace
}  // namespace ltc
