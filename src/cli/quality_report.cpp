// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/quality_report.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/lobe_words.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string row_text(const std::string& what, const Statistics& d) {
  if (d.count == 0)
    return fmt::format("{:<36} {:>6}\n", what, 0);
  const std::string error = d.count > 1 ? fmt::format("{:.4f}", d.standard_error) : "";
  return fmt::format("{:<36} {:>6} {:>8.4f} {:>8} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f}\n", what,
                     d.count, d.mean, error, d.p50, d.p95, d.p99, d.largest);
}

std::string noise_text(double noise) {
  return std::isnan(noise)
             ? ""
             : fmt::format("  noise of the samples that they are judged by: {:.1e} a light\n",
                           noise);
}

std::string figures_text(const QualityReport& quality) {
  const std::string floor = quality.settings.floor_fit.lobe == LobeKind::folded
                                ? "  floor: each query fitted, folded"
                                : "  floor: each query fitted";
  return fmt::format("\n{:<36} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "quality", "judged",
                     "mean", "+-", "median", "95 %", "99 %", "largest") +
         row_text("loss / spread at nodes", quality.nodes) +
         (quality.node_fit_ratios.empty()
              ? ""
              : row_text("  over that of their own fits", quality.node_fits)) +
         row_text("loss / spread between nodes", quality.query_losses) +
         row_text(floor, quality.floor_losses) +
         row_text("area lights, shape alone", quality.area_light) +
         row_text("  with the table's amplitude", quality.area_light_with_amplitude) +
         row_text(floor, quality.floor_area_light) +
         row_text("below the horizon, at nodes", quality.nodes_below_horizon) +
         row_text("below the horizon, between nodes", quality.below_horizon) +
         row_text(floor, quality.floor_below_horizon) + noise_text(quality.area_light_noise) +
         fmt::format("queries: {}\n", range_words(quality.settings.range)) +
         (quality.settings.horizon == HorizonMode::scaled
              ? "what is above the horizon is scaled up for what is below\n"
              : "");
}

std::string left_out_text(const QualityReport& quality) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0)
      text += fmt::format("{} of {} queries {}\n", count, quality.queries.size(), what);
  };
  add(quality.queries_missing, "need an entry that the table has not, and are left out");
  add(quality.queries_outside, "are beyond the table's axes, and are left out");
  add(quality.queries_singular, "get a matrix without an inverse; area lights leave them out");
  return text;
}

std::string bands_text(const QualityReport& quality) {
  std::string text;
  for (const Bands& bands : quality.bands) {
    if (bands.bands.empty())
      continue;
    text += fmt::format("\n{:<24} {:>8} {:>8} {:>8} {:>12} {:>8}\n", "by " + bands.parameter,
                        "queries", "loss", "floor", "area lights", "floor");
    for (const Band& band : bands.bands)
      text += fmt::format("  {:<22} {:>8} {:>8.3f} {:>8.3f} {:>12.4f} {:>8.4f}\n",
                          band_text(bands, band), band.queries, band.relative_loss, band.floor_loss,
                          band.area_light_error, band.floor_area_light_error);
  }
  return text;
}

std::string worst_text(const std::string& file, const QualityReport& quality) {
  if (quality.worst_queries.empty())
    return "";
  std::string text = "\nqueries furthest above the floor\n";
  for (const std::size_t i : quality.worst_queries)
    text += fmt::format("  loss {:.3f}, floor {:.3f}; area lights {:.4f}, floor {:.4f}\n    {}\n",
                        quality.queries[i].relative_loss, quality.floors[i].relative_loss,
                        quality.queries[i].area_light.mean_absolute,
                        quality.floors[i].area_light.mean_absolute,
                        query_command(file, quality.floors[i].lobe));
  return text;
}

std::string thresholds_text(const std::vector<ThresholdCheck>& thresholds) {
  std::string text = fmt::format("\n{:<36} {:>8}  {}\n", "threshold", "mean", "allowed");
  for (const ThresholdCheck& check : thresholds)
    text += !check.reason.empty()
                ? fmt::format("{:<36} {:>8}  not checked: {}\n", check.what, "", check.reason)
                : fmt::format("{:<36} {:>8}  at most {:<8.4g} {}{}\n", check.what,
                              check.judged() ? fmt::format("{:.4f}", check.value) : "", check.limit,
                              verdict_text(check), check.passed ? "" : " " + check.key);
  return text;
}

Json json_of(const Statistics& d) {
  return {{"count", d.count},
          {"mean", d.mean},
          {"standard_error", d.standard_error},
          {"p50", d.p50},
          {"p95", d.p95},
          {"p99", d.p99},
          {"largest", d.largest},
          {"largest_index", d.largest_index}};
}

Json json_of(const Bands& bands) {
  Json json;
  json["parameter"] = bands.parameter;
  json["bands"] = Json::array();
  for (const Band& band : bands.bands)
    json["bands"].push_back({{"first", band.first},
                             {"last", band.last},
                             {"queries", band.queries},
                             {"loss", band.relative_loss},
                             {"floor_loss", band.floor_loss},
                             {"area_light_error", band.area_light_error},
                             {"floor_area_light_error", band.floor_area_light_error}});
  return json;
}

Json query_json(const std::string& file, const QueryFloor& floor, const QueryQuality& query) {
  Json json = lobe_json(floor.lobe);
  json["state"] = name_of(query.state);
  json["loss"] = query.relative_loss;
  json["floor_loss"] = floor.relative_loss;
  json["area_light_error"] = query.area_light.mean_absolute;
  json["area_light_error_with_amplitude"] = query.area_light_with_amplitude.mean_absolute;
  json["floor_area_light_error"] = floor.area_light.mean_absolute;
  json["below_horizon"] = query.below_horizon;
  json["area_light_noise"] = floor.area_light.standard_error;
  json["command"] = query_command(file, floor.lobe);
  return json;
}

}  // namespace

std::string quality_text(const std::string& file, const QualityReport& quality,
                         const std::vector<ThresholdCheck>& thresholds) {
  return figures_text(quality) + left_out_text(quality) + bands_text(quality) +
         worst_text(file, quality) + thresholds_text(thresholds);
}

Json quality_json(const std::string& file, const QualityReport& quality,
                  const std::vector<ThresholdCheck>& thresholds) {
  Json json;
  for (const ThresholdCheck& check : thresholds)
    json["thresholds"].push_back(
        {{"key", check.key},
         {"what", check.what},
         {"value", check.value},
         {"at_most", check.limit},
         {"passed", check.has_verdict() ? Json(check.passed) : Json(nullptr)},
         {"reason", check.reason}});
  json["query_range"] = range_json(quality.settings.range);
  json["horizon"] = name_of(quality.settings.horizon);
  json["node_loss"] = json_of(quality.nodes);
  json["node_loss_over_fits"] = json_of(quality.node_fits);
  json["nodes_without_values"] = quality.nodes_without_values;
  json["query_loss"] = json_of(quality.query_losses);
  json["floor"] = name_of(quality.settings.floor_fit.lobe);
  json["floor_loss"] = json_of(quality.floor_losses);
  json["area_light_error"] = json_of(quality.area_light);
  json["area_light_error_with_amplitude"] = json_of(quality.area_light_with_amplitude);
  json["floor_area_light_error"] = json_of(quality.floor_area_light);
  json["area_light_noise"] = quality.area_light_noise;
  json["nodes_below_horizon"] = json_of(quality.nodes_below_horizon);
  json["below_horizon"] = json_of(quality.below_horizon);
  json["floor_below_horizon"] = json_of(quality.floor_below_horizon);
  json["queries_missing"] = quality.queries_missing;
  json["queries_outside"] = quality.queries_outside;
  json["queries_singular"] = quality.queries_singular;
  for (const Bands& bands : quality.bands)
    json["by"].push_back(json_of(bands));
  json["worst_queries"] = quality.worst_queries;
  json["queries"] = Json::array();
  for (std::size_t i = 0; i < quality.queries.size(); ++i)
    json["queries"].push_back(query_json(file, quality.floors[i], quality.queries[i]));
  json["node_losses"] = quality.node_losses;
  return json;
}

}  // namespace ltc::cli
