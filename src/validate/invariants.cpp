// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "validate/invariants.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "brdf/albedo.h"
#include "core/parallel.h"
#include "export/consistency.h"
#include "table/entry_text.h"
#include "table/symmetry.h"
#include "validate/matrix_invariants.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct NoState {};

// One value an entry, and how far it may go. NaN fails, but for entries that are not judged.
struct Measurement {
  std::string name;
  double limit = 0;
  bool at_most = true;
  std::vector<double> values;
  std::vector<bool> judged;

  Measurement(std::string name_, double limit_, const std::vector<bool>& judged_)
      : name(std::move(name_)), limit(limit_), values(judged_.size(), nan), judged(judged_) {}

  bool fails(std::size_t flat) const {
    return judged[flat] && !(at_most ? values[flat] <= limit : values[flat] > limit);
  }
  // Whether entry a is worse than b; NaN is worst.
  bool worse(std::size_t a, std::size_t b) const {
    const double value_a = values[a], value_b = values[b];
    if (std::isnan(value_a) || std::isnan(value_b))
      return std::isnan(value_a) && !std::isnan(value_b);
    return at_most ? value_a > value_b : value_a < value_b;
  }
};

InvariantResult judge(const Grid& grid, const Measurement& measurement) {
  InvariantResult result;
  result.name = measurement.name;
  result.limit = measurement.limit;
  result.at_most = measurement.at_most;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    if (!measurement.judged[flat])
      continue;
    if (!result.has_worst || measurement.worse(flat, result.worst))
      result.worst = flat;
    result.has_worst = true;
    if (measurement.fails(flat))
      result.entries.push_back(flat);
  }
  if (result.has_worst)
    result.value = measurement.values[result.worst];
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [&](std::size_t a, std::size_t b) { return measurement.worse(a, b); });
  result.passed = result.entries.empty();
  if (!result.passed)
    result.message = fmt::format("{} of entry {} ({}) is {:.4g}, allowed {} {:.4g}", result.name,
                                 entry_text(grid, result.worst), lobe_text(grid, result.worst),
                                 result.value, result.at_most ? "at most" : "above", result.limit);
  return result;
}

InvariantResult not_in_file(std::string name, double limit) {
  InvariantResult result;
  result.name = std::move(name);
  result.limit = limit;
  result.checked = false;
  return result;
}

// The whole table under the checks, and which entries they judge.
class Checks {
 public:
  Checks(const Table& table, const InvariantLimits& limits, int threads, Progress* progress)
      : table_(table),
        limits_(limits),
        threads_(threads),
        progress_(progress),
        has_values_(table.grid.size()),
        finite_(table.grid.size()) {
    for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
      has_values_[flat] = table.status[flat] != Status::skipped;
      finite_[flat] = has_values_[flat] && table.stored_at(flat).allFinite();
    }
  }

  InvariantResult finite(const TableContents& contents) const {
    return judged("finite", 0, has_values_, [&](std::size_t flat) {
      const auto count = [](float value) { return std::isfinite(value) ? 0.0 : 1.0; };
      double not_finite = 0;
      for (std::size_t i = 9 * flat; i < 9 * flat + 9; ++i)
        not_finite += count(table_.stored[i]);
      if (contents.albedo)
        not_finite += count(table_.amplitude[flat]) + count(table_.fresnel[flat]);
      if (contents.loss)
        not_finite += count(table_.sw_loss[flat]);
      return not_finite;
    });
  }

  InvariantResult determinant() const {
    Measurement measurement("determinant", 0, finite_);
    measurement.at_most = false;
    return measured(std::move(measurement),
                    [&](std::size_t flat) { return table_.stored_at(flat).determinant(); });
  }

  InvariantResult condition() const {
    return judged("condition number", limits_.condition_number, finite_,
                  [&](std::size_t flat) { return condition_number(table_.matrix_at(flat)); });
  }

  InvariantResult zeros() const {
    return judged("zeros of equation 16", limits_.zero, finite_, [&](std::size_t flat) {
      const GgxLobe lobe = lobe_at(flat);
      return symmetry_zeros(lobe.theta_radians, lobe.phi_radians)
          .select(table_.stored_at(flat).cwiseAbs(), 0.0)
          .maxCoeff();
    });
  }

  InvariantResult upward() const {
    std::vector<bool> upward = finite_;
    for (std::size_t flat = 0; flat < upward.size(); ++flat)
      upward[flat] = upward[flat] && looks_upward(lobe_at(flat).theta_radians);
    return judged("theta = 0 over phi", limits_.upward_difference, upward,
                  [&](std::size_t flat) { return difference_to_first_phi(upward, flat); });
  }

  InvariantResult third_column() const {
    return judged("third column", limits_.unit_length, finite_, [&](std::size_t flat) {
      return std::abs(table_.stored_at(flat).col(2).norm() - 1);
    });
  }

  InvariantResult alignment() const {
    return judged("alignment", limits_.alignment_degrees, finite_,
                  [&](std::size_t flat) { return misalignment_degrees(table_.matrix_at(flat)); });
  }

  InvariantResult half_precision() const {
    return judged("half precision", limits_.half_determinant, finite_, [&](std::size_t flat) {
      return half_determinant_change(table_.stored_at(flat));
    });
  }

  InvariantResult albedo_range(const TableContents& contents) const {
    const std::string name = "albedo range";
    if (!contents.albedo)
      return not_in_file(name, 0);
    return judged(name, 0, has_values_, [&](std::size_t flat) {
      const double amplitude = table_.amplitude[flat], fresnel = table_.fresnel[flat];
      return std::max({0.0, -fresnel, fresnel - amplitude, amplitude - 1});
    });
  }

  InvariantResult albedo(const TableContents& contents) const {
    const std::string name = "albedo";
    if (!contents.albedo)
      return not_in_file(name, limits_.albedo_error);
    const AlbedoRule rule(static_cast<std::size_t>(limits_.albedo_points));
    return judged(name, limits_.albedo_error, has_values_, [&](std::size_t flat) {
      const Albedo albedo = integrate_albedo(lobe_at(flat), rule);
      return std::max(std::abs(table_.amplitude[flat] - albedo.amplitude),
                      std::abs(table_.fresnel[flat] - albedo.fresnel));
    });
  }

 private:
  GgxLobe lobe_at(std::size_t flat) const { return table_.grid.lobe(table_.grid.node(flat)); }

  double difference_to_first_phi(const std::vector<bool>& upward, std::size_t flat) const {
    NodeIndex node = table_.grid.node(flat);
    for (node.phi = 0; !upward[table_.grid.flat(node)];)
      ++node.phi;
    const std::size_t first = table_.grid.flat(node);
    return (table_.stored_at(flat) - table_.stored_at(first)).cwiseAbs().maxCoeff();
  }

  template <typename Measure>
  InvariantResult measured(Measurement measurement, Measure measure) const {
    parallel_for_each<NoState>(
        measurement.name, measurement.values.size(), threads_, progress_, [] { return NoState{}; },
        [&](std::size_t flat, NoState&) {
          if (measurement.judged[flat])
            measurement.values[flat] = measure(flat);
        });
    return judge(table_.grid, measurement);
  }

  template <typename Measure>
  InvariantResult judged(std::string name, double limit, const std::vector<bool>& entries,
                         Measure measure) const {
    return measured(Measurement(std::move(name), limit, entries), measure);
  }

  const Table& table_;
  const InvariantLimits& limits_;
  const int threads_;
  Progress* const progress_;
  std::vector<bool> has_values_;  // or failed: those that the table should have
  std::vector<bool> finite_;      // of these, those whose matrix is finite
};

}  // namespace

std::vector<InvariantResult> check_invariants(const Table& table, const InvariantLimits& limits,
                                              int threads, Progress* progress,
                                              const TableContents& contents) {
  const Checks checks(table, limits, threads, progress);
  return {checks.finite(contents), checks.determinant(),    checks.condition(),
          checks.zeros(),          checks.upward(),         checks.third_column(),
          checks.alignment(),      checks.half_precision(), checks.albedo_range(contents),
          checks.albedo(contents)};
}

}  // namespace ltc
