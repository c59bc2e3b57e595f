// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/validate_settings.h"

#include <algorithm>

#include "config/key.h"
#include "config/reader.h"

namespace ltc {
namespace {

using config::key;
using config::Range;
using Key = config::KeyOf<ValidateSettings>;
using S = ValidateSettings;

// One line a key: its name, the member it sets, what is allowed, what it means. A new section is a
// function like this one, and a line in keys().
// clang-format off
std::vector<Key> invariant_keys() {
  return {
      key("invariants.condition_number", [](S& s) { return &s.invariants.condition_number; }, Range{1, no_limit}, "largest condition number of a matrix M"),
      key("invariants.zero", [](S& s) { return &s.invariants.zero; }, Range{0, no_limit}, "largest absolute value where symmetry wants a zero"),
      key("invariants.upward_difference", [](S& s) { return &s.invariants.upward_difference; }, Range{0, no_limit}, "largest difference between values at theta = 0 that differ in phi alone"),
      key("invariants.unit_length", [](S& s) { return &s.invariants.unit_length; }, Range{0, no_limit}, "largest deviation of a third column's length from 1"),
      key("invariants.alignment_degrees", [](S& s) { return &s.invariants.alignment_degrees; }, Range{0, 180}, "largest angle by which alignment would turn a matrix further"),
      key("invariants.half_error", [](S& s) { return &s.invariants.half_error; }, Range{0, no_limit}, "largest distance of a lobe to that of its matrix in half precision, over its spread"),
      key("invariants.inverse_error", [](S& s) { return &s.invariants.inverse_error; }, Range{0, no_limit}, "largest distance of a lobe to the one of a single-precision inverse, over its spread"),
      key("invariants.below_horizon", [](S& s) { return &s.invariants.below_horizon; }, Range{0, 1}, "largest share of a lobe below the horizon"),
      key("invariants.albedo_error", [](S& s) { return &s.invariants.albedo_error; }, Range{0, 1}, "largest error of amplitude and Fresnel against fresh quadrature"),
      key("invariants.loss_excess", [](S& s) { return &s.invariants.loss_excess; }, Range{0, no_limit}, "largest loss of a lobe over the stored one"),
      key("invariants.neighbour_excess", [](S& s) { return &s.invariants.neighbour_excess; }, Range{0, no_limit}, "largest jump between neighbours over that of GGX"),
      key("invariants.neighbour_slack", [](S& s) { return &s.invariants.neighbour_slack; }, Range{0, 2}, "distance between neighbours' lobes that is no jump"),
      key("invariants.albedo_points", [](S& s) { return &s.invariants.albedo_points; }, Range{64, 1 << 20}, "points of the fresh quadrature"),
      key("invariants.samples", [](S& s) { return &s.invariants.samples; }, Range{1024, 65536}, "samples of a lobe, for stored loss and neighbours; fewer are too noisy for their limits"),
      key("invariants.directions", [](S& s) { return &s.invariants.directions; }, Range{4, 4096}, "directions that they are projected on"),
  };
}

std::vector<Key> quality_keys() {
  return {
      key("quality.node_loss", [](S& s) { return &s.thresholds.node_loss; }, Range{0, no_limit}, "largest mean relative loss at nodes"),
      key("quality.query_loss", [](S& s) { return &s.thresholds.query_loss; }, Range{0, no_limit}, "largest mean relative loss between nodes"),
      key("quality.area_light_error", [](S& s) { return &s.thresholds.area_light_error; }, Range{0, no_limit}, "largest mean error under area lights"),
      key("quality.nodes", [](S& s) { return &s.quality.most_nodes; }, Range{0, 1 << 24}, "nodes judged, drawn at random where the table has more"),
      key("quality.node_samples", [](S& s) { return &s.quality.node_samples; }, Range{64, 1 << 20}, "samples of a node's lobe"),
      key("quality.node_directions", [](S& s) { return &s.quality.node_directions; }, Range{4, 4096}, "directions that they are projected on"),
      key("quality.fitted_nodes", [](S& s) { return &s.quality.fitted_nodes; }, Range{0, 1 << 20}, "nodes drawn at random and fitted by themselves, to compare with"),
      key("quality.queries", [](S& s) { return &s.quality.queries; }, Range{0, 1 << 20}, "random lobes that the table is asked for"),
      key("quality.roughness_first", [](S& s) { return &s.quality.range.roughness_first; }, Range{0, 1}, "least perceptual roughness of queries"),
      key("quality.roughness_last", [](S& s) { return &s.quality.range.roughness_last; }, Range{0, 1}, "largest perceptual roughness of queries"),
      key("quality.query_samples", [](S& s) { return &s.quality.query_samples; }, Range{64, 1 << 20}, "samples of a query's lobe"),
      key("quality.query_directions", [](S& s) { return &s.quality.query_directions; }, Range{4, 4096}, "directions that they are projected on"),
      key("quality.floor", [](S& s) { return &s.quality.floor_fit.lobe; }, "what is fitted to each query to compare with: an LTC, or one that is folded (docs/folded.md)"),
      key("quality.floor_crease", [](S& s) { return &s.quality.floor_fit.crease; }, Range{0, 10}, "where the folded ones have their creases"),
      key("quality.floor_second_crease", [](S& s) { return &s.quality.floor_fit.second_crease; }, Range{0, 10}, "a second pair of creases, above the first; 0: none"),
      key("quality.horizon", [](S& s) { return &s.quality.horizon; }, "what becomes of light below the horizon: \"clipped\", lost; \"scaled\", made up for by what is above (docs/accuracy.md)"),
      key("quality.quads", [](S& s) { return &s.quality.quads; }, Range{1, 4096}, "rectangular lights of a query"),
      key("quality.quad_samples", [](S& s) { return &s.quality.quad_samples; }, Range{64, 1 << 20}, "samples of GGX that their light is measured with"),
      key("quality.seed", [](S& s) { return &s.quality.seed; }, Range{0, 9007199254740992.0}, "of nodes, queries, samples, directions and lights"),
  };
}
// clang-format on

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys;
    for (const std::vector<Key>& section : {invariant_keys(), quality_keys()})
      keys.insert(keys.end(), section.begin(), section.end());
    return keys;
  }();
  return all;
}

constexpr double InvariantLimits::*invariant_limits[] = {
    &InvariantLimits::condition_number,  &InvariantLimits::zero,
    &InvariantLimits::upward_difference, &InvariantLimits::unit_length,
    &InvariantLimits::alignment_degrees, &InvariantLimits::half_error,
    &InvariantLimits::inverse_error,     &InvariantLimits::below_horizon,
    &InvariantLimits::albedo_error,      &InvariantLimits::loss_excess,
    &InvariantLimits::neighbour_excess,  &InvariantLimits::neighbour_slack};
constexpr double QualityThresholds::*thresholds[] = {&QualityThresholds::node_loss,
                                                     &QualityThresholds::query_loss,
                                                     &QualityThresholds::area_light_error};

// No limit below that of `least`.
void raise_to(ValidateSettings& settings, const ValidateSettings& least) {
  for (const auto limit : invariant_limits)
    settings.invariants.*limit = std::max(settings.invariants.*limit, least.invariants.*limit);
  for (const auto limit : thresholds)
    settings.thresholds.*limit = std::max(settings.thresholds.*limit, least.thresholds.*limit);
}

// What rounding alone does: 2^-11 of a value, a step of 1.4e-4 radians for a direction, which is
// more than the width of the smoothest lobes. 0 for what it leaves alone.
ValidateSettings rounding_to_half() {
  ValidateSettings settings;
  for (const auto limit : invariant_limits)
    settings.invariants.*limit = 0;
  settings.invariants.unit_length = 5e-4;
  settings.invariants.alignment_degrees = 1;
  settings.invariants.albedo_error = 5e-4;
  settings.invariants.neighbour_slack = 3e-4;
  settings.thresholds = {0.12, 0, 0};
  return settings;
}

// Of the widest cell, at least 1. A refined node serves the cells about it: the wider they are, the
// farther is its lobe from GGX's, at alpha = 0 above all.
double cell_width_over_default(const Axis& alpha) {
  double widest = 0;
  for (std::size_t i = 1; i < alpha.nodes.size(); ++i)
    widest = std::max(widest, alpha.nodes[i] - alpha.nodes[i - 1]);
  return std::max(7 * widest - 1e-9, 1.0);  // but for rounding
}

}  // namespace

ValidateSettings settings_for_refined_tables() {
  ValidateSettings settings;
  settings.invariants.alignment_degrees = 180;
  settings.invariants.inverse_error = 0.1;
  settings.invariants.neighbour_excess = 10;
  settings.invariants.neighbour_slack = 0.05;
  settings.thresholds = {no_limit, 0.1, 0.018};
  return settings;
}

ValidateSettings settings_for(const Table& table) {
  ValidateSettings settings =
      table.refined == false ? ValidateSettings{} : settings_for_refined_tables();
  settings.invariants.neighbour_slack *= cell_width_over_default(table.grid.alpha);
  if (!table.refined)
    raise_to(settings, ValidateSettings{});
  if (table.precision == Precision::half)
    raise_to(settings, rounding_to_half());
  // 75 at the horizon, at alpha = 0.02 and lambda = 0.
  if (is_folded(table))
    settings.invariants.neighbour_excess = 100;
  // Of 600 numbers 0.013, at alpha_y = 1e-4 seen from the horizon along y.
  if (table.field)
    settings.invariants.albedo_error = 0.02;
  return settings;
}

ValidateSettings load_validate_settings(const std::optional<std::filesystem::path>& file,
                                        std::span<const std::string> overrides,
                                        ValidateSettings settings,
                                        std::string_view overrides_from) {
  const config::Vocabulary vocabulary =
      config::vocabulary(keys(), settings, "config/validate.toml lists the keys there are");
  config::Sources sources;
  if (file)
    config::read_file(*file, vocabulary, sources);
  for (const std::string& override : overrides)
    config::read_override(override, std::string(overrides_from), vocabulary, sources);
  for (const config::KeySource& source : sources)
    settings.said.insert(source.key);
  return settings;
}

std::vector<ConfigKey> validate_keys() {
  const ValidateSettings defaults;
  std::vector<ConfigKey> result;
  for (const Key& key : keys())
    result.push_back({key.name, key.allowed, key.summary, config::toml_of(key.get(defaults))});
  return result;
}

}  // namespace ltc
