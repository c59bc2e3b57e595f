// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/invariants.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "brdf/albedo.h"
#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/parallel.h"
#include "export/consistency.h"
#include "judge/half_precision.h"
#include "judge/lobe_invariants.h"
#include "judge/matrix_invariants.h"
#include "judge/shader_inverse.h"
#include "ltc/folded.h"
#include "table/entry_text.h"
#include "table/field_table.h"
#include "table/symmetry.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// One value an entry, and how far it may go. NaN fails, but for entries that are not judged.
struct Measurement {
  std::string name;
  double limit = 0;
  bool at_most = true;
  double largest = no_limit;  // a limit so large excludes nothing
  std::vector<double> values;
  std::vector<bool> judged;

  Measurement(std::string name_, double limit_, bool at_most_, const std::vector<bool>& judged_)
      : name(std::move(name_)),
        limit(limit_),
        at_most(at_most_),
        values(judged_.size(), nan),
        judged(judged_) {}

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
  result.judged = measurement.limit < measurement.largest;
  if (!result.judged)
    result.reason = "no limit is set";
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
    result.message = fmt::format("{} of entry {} ({}) is {:.4g}, allowed {}", result.name,
                                 entry_text(grid, result.worst), lobe_text(grid, result.worst),
                                 result.value, result.judged ? allowed_text(result) : "any finite");
  return result;
}

InvariantResult not_checked(std::string name, double limit, std::string_view reason) {
  InvariantResult result;
  result.name = std::move(name);
  result.limit = limit;
  result.checked = false;
  result.reason = reason;
  return result;
}

constexpr std::string_view not_in_file = "not in the file";
constexpr std::string_view more_than_matrix = "a folded lobe is more than its matrix";

// Of the whole table, not of entries.
InvariantResult check_shapes(const Table& table) {
  InvariantResult result;
  result.name = "shapes and axes";
  try {
    require_shapes(table, "table");
  } catch (const InputError& error) {
    result.passed = false;
    result.message = error.what();
  }
  return result;
}

// The whole table under the checks, and which entries they judge.
class Checks {
 public:
  Checks(const Table& table, const InvariantLimits& limits, const RunContext& run,
         const TableContents& contents)
      : table_(table),
        limits_(limits),
        run_(run),
        contents_(contents),
        present_(table.grid.size()),
        finite_(table.grid.size()),
        invertible_(table.grid.size()) {
    for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
      present_[flat] = table.status[flat] != Status::skipped;
      finite_[flat] = present_[flat] && table.stored_at(flat).allFinite();
      invertible_[flat] = finite_[flat] && std::isfinite(condition_number(table.matrix_at(flat)));
    }
  }

  InvariantResult finite() const {
    return judged("finite", 0, present_, [&](std::size_t flat) {
      const auto count = [](float value) { return std::isfinite(value) ? 0.0 : 1.0; };
      double not_finite = 0;
      for (std::size_t i = 9 * flat; i < 9 * flat + 9; ++i)
        not_finite += count(table_.stored[i]);
      if (is_folded(table_))
        not_finite += count(table_.fold[2 * flat]) + count(table_.fold[2 * flat + 1]);
      if (contents_.albedo)
        not_finite += count(table_.amplitude[flat]) + count(table_.fresnel[flat]);
      if (contents_.loss)
        not_finite += count(table_.sw_loss[flat]);
      return not_finite;
    });
  }

  InvariantResult determinant() const {
    constexpr bool at_most = false;
    return judged(
        "determinant", 0, finite_,
        [&](std::size_t flat) { return table_.stored_at(flat).determinant(); }, at_most);
  }

  InvariantResult condition() const {
    return judged("condition number", limits_.condition_number, finite_,
                  [&](std::size_t flat) { return condition_number(table_.matrix_at(flat)); });
  }

  InvariantResult zeros() const {
    return judged("zeros of equation 16", limits_.zero, finite_, [&](std::size_t flat) {
      const Lobe lobe = lobe_at(flat);
      const double largest = symmetry_zeros(lobe.theta_radians, lobe.phi_radians)
                                 .select(table_.stored_at(flat).cwiseAbs(), 0.0)
                                 .maxCoeff();
      // Symmetric in y, it bends to neither side.
      return is_folded(table_) && looks_along_x(lobe.theta_radians, lobe.phi_radians)
                 ? std::max(largest, std::abs(static_cast<double>(table_.fold[2 * flat])))
                 : largest;
    });
  }

  InvariantResult upward() const {
    std::vector<bool> upward = finite_;
    for (std::size_t flat = 0; flat < upward.size(); ++flat)
      upward[flat] = upward[flat] && looks_upward(lobe_at(flat).theta_radians);
    return judged("theta = 0 over phi", limits_.upward_difference, upward,
                  [&](std::size_t flat) { return difference_to_first_phi(upward, flat); });
  }

  InvariantResult unit_scale() const {
    const char* const name = table_.storage == Storage::inverse ? "middle entry" : "third column";
    if (table_.of_any_scale)
      return not_checked(name, limits_.unit_length, "such files have matrices of any scale");
    return judged(name, limits_.unit_length, finite_, [&](std::size_t flat) {
      return std::abs(scale_of(table_.storage, table_.stored_at(flat)) - 1);
    });
  }

  InvariantResult alignment() const {
    constexpr const char* name = "alignment";
    constexpr double any_angle = 180;
    if (is_folded(table_))
      return not_checked(name, limits_.alignment_degrees, more_than_matrix);
    if (limits_.alignment_degrees >= any_angle)
      return not_checked(name, limits_.alignment_degrees, why_not_limited(table_));
    return judged(name, limits_.alignment_degrees, invertible_,
                  [&](std::size_t flat) { return misalignment_degrees(table_.matrix_at(flat)); });
  }

  InvariantResult half_precision() const {
    constexpr const char* name = "half precision";
    if (table_.precision == Precision::half)
      return not_checked(name, limits_.half_error, "its values have 16 bits already");
    if (table_.field)
      return not_checked(name, limits_.half_error, "a field's matrices are not stored");
    return judged(name, limits_.half_error, invertible_,
                  half_precision_errors(table_, invertible_, run_));
  }

  InvariantResult inverse() const {
    const auto seen = [&](std::size_t flat, const LobeFrame& frame) -> LtcLobe {
      return {seen_by_shader(table_.storage, table_.stored_at(flat), frame, InverseOrder::factored,
                             Precision::single, Precision::single),
              table_.fold_at(flat), table_.creases};
    };
    return judged("float inverse", limits_.inverse_error, invertible_,
                  inversion_errors(table_, invertible_, "inverses", run_, seen));
  }

  // Of folded lobes alone.
  InvariantResult one_to_one() const {
    constexpr bool at_most = false;
    const double sum = sum_of(table_.creases);
    return judged(
        "fold one to one", 0, finite_,
        [&](std::size_t flat) { return 1 - sum * table_.fold_at(flat).g; }, at_most);
  }

  InvariantResult below_horizon() const {
    constexpr double whole_lobe = 1;
    Measurement measurement("below horizon", limits_.below_horizon, true, invertible_);
    measurement.largest = whole_lobe;
    for (std::size_t flat = 0; flat < invertible_.size(); ++flat)
      if (invertible_[flat])
        measurement.values[flat] = share_below_horizon(table_.ltc_at(flat));
    return judge(table_.grid, measurement);
  }

  InvariantResult albedo_range() const {
    const std::string name = "albedo range";
    if (!contents_.albedo)
      return not_checked(name, 0, not_in_file);
    const bool at_most_one = table_.grid.model->conserves_energy();
    return judged(name, 0, present_, [&, at_most_one](std::size_t flat) {
      const double amplitude = table_.amplitude[flat], fresnel = table_.fresnel[flat];
      return std::max({0.0, -fresnel, fresnel - amplitude, at_most_one ? amplitude - 1 : 0.0});
    });
  }

  InvariantResult albedo_quadrature() const {
    const std::string name = "albedo quadrature";
    if (!contents_.albedo)
      return not_checked(name, limits_.albedo_error, not_in_file);
    const AlbedoRule rule(static_cast<std::size_t>(limits_.albedo_points));
    std::vector<double> errors(table_.grid.size(), nan);
    parallel_for_each("albedo", errors.size(), run_, [&](std::size_t flat) {
      if (!present_[flat])
        return;
      const Albedo albedo = integrate_albedo(lobe_at(flat), rule);
      errors[flat] = std::max(std::abs(table_.amplitude[flat] - albedo.amplitude),
                              std::abs(table_.fresnel[flat] - albedo.fresnel));
    });
    return judged(name, limits_.albedo_error, present_, std::move(errors));
  }

  InvariantResult loss() {
    const std::string name = "stored loss";
    if (!contents_.loss)
      return not_checked(name, limits_.loss_excess, not_in_file);
    return judged(name, limits_.loss_excess, invertible_,
                  [&](std::size_t flat) { return lobes().loss_excess[flat]; });
  }

  InvariantResult neighbours() {
    std::vector<bool> with_neighbour = invertible_;
    for (std::size_t flat = 0; flat < with_neighbour.size(); ++flat)
      if (std::isnan(lobes().neighbour_excess[flat]))
        with_neighbour[flat] = false;
    return judged("neighbours", limits_.neighbour_excess, with_neighbour,
                  [&](std::size_t flat) { return lobes().neighbour_excess[flat]; });
  }

 private:
  Lobe lobe_at(std::size_t flat) const { return table_.grid.lobe(flat); }

  // Measured once, when first asked for.
  const LobeMeasures& lobes() {
    if (!lobes_)
      lobes_ = measure_lobes(
          table_, invertible_,
          {static_cast<std::size_t>(limits_.samples), static_cast<std::size_t>(limits_.directions),
           limits_.neighbour_excess, limits_.neighbour_slack},
          run_);
    return *lobes_;
  }

  // The entry of the same alpha and lambda at theta = 0 that comes first.
  double difference_to_first_phi(const std::vector<bool>& upward, std::size_t flat) const {
    NodeIndex node = table_.grid.node(flat);
    for (node.phi = 0; !upward[table_.grid.flat(node)];)
      ++node.phi;
    const std::size_t first = table_.grid.flat(node);
    double difference = (table_.stored_at(flat) - table_.stored_at(first)).cwiseAbs().maxCoeff();
    if (is_folded(table_))
      difference = std::max(difference, std::abs(static_cast<double>(table_.fold[2 * flat + 1]) -
                                                 table_.fold[2 * first + 1]));
    if (contents_.albedo)
      for (const std::vector<float>* values : {&table_.amplitude, &table_.fresnel})
        difference =
            std::max(difference, std::abs(static_cast<double>((*values)[flat]) - (*values)[first]));
    return difference;
  }

  // Values of a measure that is over in no time.
  template <typename Measure>
  InvariantResult judged(std::string name, double limit, const std::vector<bool>& entries,
                         Measure measure, bool at_most = true) const {
    Measurement measurement(std::move(name), limit, at_most, entries);
    for (std::size_t flat = 0; flat < entries.size(); ++flat)
      if (entries[flat])
        measurement.values[flat] = measure(flat);
    return judge(table_.grid, measurement);
  }

  // Values that were measured before.
  InvariantResult judged(std::string name, double limit, const std::vector<bool>& entries,
                         std::vector<double> values) const {
    Measurement measurement(std::move(name), limit, true, entries);
    measurement.values = std::move(values);
    return judge(table_.grid, measurement);
  }

  const Table& table_;
  const InvariantLimits& limits_;
  const RunContext run_;
  const TableContents contents_;
  std::vector<bool> present_;     // all but skipped entries; failed ones should have values
  std::vector<bool> finite_;      // of these, those whose matrix is finite
  std::vector<bool> invertible_;  // of these, those whose matrix has an inverse
  std::optional<LobeMeasures> lobes_;
};

}  // namespace

std::string allowed_text(const InvariantResult& result) {
  return result.judged
             ? fmt::format("{} {:.4g}", result.at_most ? "at most" : "above", result.limit)
             : "any";
}

std::string_view why_not_limited(const Table& table) {
  if (!table.refined)
    return "whether the table is refined is not known";
  return *table.refined ? "nodes of a refined table serve the cells about them" : "no limit is set";
}

std::vector<InvariantResult> check_invariants(const Table& table, const InvariantLimits& limits,
                                              const RunContext& run,
                                              const TableContents& contents) {
  const InvariantResult shapes = check_shapes(table);
  if (!shapes.passed)
    return {shapes};
  Checks checks(table, limits, run, contents);
  std::vector<InvariantResult> results = {shapes,
                                          checks.finite(),
                                          checks.determinant(),
                                          checks.condition(),
                                          checks.zeros(),
                                          checks.upward(),
                                          checks.unit_scale(),
                                          checks.alignment(),
                                          checks.half_precision(),
                                          checks.inverse(),
                                          checks.below_horizon(),
                                          checks.albedo_range(),
                                          checks.albedo_quadrature(),
                                          checks.loss(),
                                          checks.neighbours()};
  if (is_folded(table))
    results.push_back(checks.one_to_one());
  return results;
}

}  // namespace ltc
