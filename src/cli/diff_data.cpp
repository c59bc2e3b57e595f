// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The JSON and the CSV of diff.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "cli/diff_report.h"
#include "cli/fit_command.h"
#include "cli/lobe_words.h"
#include "core/angle.h"
#include "judge/quality_summary.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

// The name of a figure in JSON and CSV, and its value.
struct Field {
  const char* name;
  double value;
};

std::array<Field, 7> fields_of(const EntryComparison& entry) {
  return {{{"loss_a", entry.loss_a},
           {"loss_b", entry.loss_b},
           {"spread", entry.spread},
           {"distance", entry.distance},
           {"matrix_difference", entry.matrix_difference},
           {"amplitude_difference", entry.amplitude_difference},
           {"fresnel_difference", entry.fresnel_difference}}};
}

std::array<Field, 4> lobe_fields_of(const Lobe& lobe) {
  return {{{"alpha_x", lobe.alpha_x},
           {"alpha_y", lobe.alpha_y},
           {"theta_degrees", lobe.theta_radians / radians_per_degree},
           {"phi_degrees", lobe.phi_radians / radians_per_degree}}};
}

std::array<Field, 4> area_light_fields_of(const QueryComparison& query) {
  return {{{"area_light_error_a", query.area_light_a},
           {"area_light_error_b", query.area_light_b},
           {"area_light_error_with_amplitude_a", query.with_amplitude_a},
           {"area_light_error_with_amplitude_b", query.with_amplitude_b}}};
}

// A number that is none is null.
template <std::size_t count>
void add(Json& json, const std::array<Field, count>& fields) {
  for (const auto& [name, value] : fields)
    json[name] = value;
}

template <std::size_t count>
std::string csv_of(const std::array<Field, count>& fields) {
  std::string text;
  for (const Field& field : fields)
    text += fmt::format(",{}", field.value);
  return text;
}

Json json_of(const Statistics& statistics) {
  if (statistics.count == 0)
    return nullptr;
  return {{"mean", statistics.mean},
          {"p50", statistics.p50},
          {"p95", statistics.p95},
          {"p99", statistics.p99},
          {"largest", statistics.largest}};
}

Json json_of(const Grid& grid, const Statistics& statistics) {
  Json json = json_of(statistics);
  if (!json.is_null())
    json["largest_entry"] = entry_text(grid, statistics.largest_index);
  return json;
}

Json json_of(const Grid& grid, const ComparisonRow& row) {
  return {{"name", row.name},
          {"entries", row.entries},
          {"a_nearer", row.a_nearer},
          {"b_nearer", row.b_nearer},
          {"loss_a", json_of(grid, row.loss_a)},
          {"loss_b", json_of(grid, row.loss_b)},
          {"ratio", json_of(grid, row.ratio)},
          {"relative_distance", json_of(grid, row.relative_distance)},
          {"distance", json_of(grid, row.distance)},
          {"matrix_difference", json_of(grid, row.matrix_difference)},
          {"amplitude_difference", json_of(grid, row.amplitude_difference)},
          {"fresnel_difference", json_of(grid, row.fresnel_difference)}};
}

Json json_of_entry(const DiffReport& report, std::size_t flat) {
  Json json = {{"entry", entry_text(report.grid(), flat)}};
  add(json, fields_of(report.nodes->entries[flat]));
  return json;
}

Json json_of_worst(const DiffReport& report, const std::vector<std::size_t>& worst) {
  Json all = Json::array();
  for (const std::size_t flat : worst) {
    Json json = json_of_entry(report, flat);
    json["ratio"] = report.nodes->entries[flat].ratio();
    json["relative_distance"] = report.nodes->entries[flat].relative_distance();
    json["command_a"] = EntryCommands(report.a.file, report.a.table).best(flat);
    json["command_b"] = EntryCommands(report.b.file, report.b.table).best(flat);
    all.push_back(json);
  }
  return all;
}

Json json_of_tolerance(const DiffReport& report) {
  if (!report.tolerance)
    return nullptr;
  const char *count = "entries", *place = "largest_entry";
  if (!report.nodes) {
    count = "queries";
    place = "largest_query";
  }
  Json exceeded = Json::array();
  for (const Exceedance& exceedance : report.exceeded)
    exceeded.push_back(
        {{"figure", exceedance.figure},
         {count, exceedance.entries},
         {"largest", exceedance.largest},
         {place, report.nodes ? Json(entry_text(report.grid(), exceedance.largest_entry))
                              : Json(exceedance.largest_entry)}});
  return {{"value", *report.tolerance},
          {"passed", failure_text(report).empty()},
          {"exceeded", exceeded}};
}

Json nearer_json(const Verdict& verdict) {
  if (verdict.difference.count == 0)
    return nullptr;
  const int sign = verdict.sign();
  return sign < 0 ? "A" : sign > 0 ? "B" : "alike";
}

Json json_of(const Verdict& verdict) {
  if (verdict.difference.count == 0)
    return nullptr;
  return {
      {"a", json_of(verdict.a)},
      {"b", json_of(verdict.b)},
      {"a_nearer", verdict.a_nearer},
      {"b_nearer", verdict.b_nearer},
      {"difference",
       {{"mean", verdict.difference.mean}, {"standard_error", verdict.difference.standard_error}}}};
}

Json json_of_use(const DiffReport& report) {
  const QuerySummary& use = report.use;
  const QualitySettings& settings = report.settings.use;
  return {{"queries", report.queries.size()},
          {"range", report.queries.empty() ? Json(nullptr) : range_json(settings.range)},
          {"samples", settings.query_samples},
          {"directions", settings.query_directions},
          {"area_lights", settings.quads},
          {"compared", use.judged},
          {"missing_a", use.missing_a},
          {"missing_b", use.missing_b},
          {"outside", use.outside},
          {"singular_a", use.singular_a},
          {"singular_b", use.singular_b},
          {"loss", json_of(use.look_ups)},
          {"area_light_error", json_of(use.area_lights)},
          {"area_light_error_with_amplitude", json_of(use.area_lights_with_amplitude)},
          {"relative_distance", json_of(use.relative_distance)},
          {"amplitude_difference", json_of(use.amplitude_difference)},
          {"fresnel_difference", json_of(use.fresnel_difference)},
          {"worst", worst_queries(report)}};
}

Json json_of_query(const DiffReport& report, const QueryComparison& query) {
  Json json = Json::object();
  add(json, lobe_fields_of(query.lobe));
  add(json, fields_of(query.lobes));
  add(json, area_light_fields_of(query));
  json["command_a"] = query_command(report.a.file, query.lobe);
  json["command_b"] = query_command(report.b.file, query.lobe);
  return json;
}

// What only tables of one grid have.
void add_nodes(Json& json, const DiffReport& report) {
  json["shape"] = report.grid().shape();
  json["compared"] = report.nodes->rows[0].entries;
  json["only_a"] = report.nodes->coverage.only_a;
  json["only_b"] = report.nodes->coverage.only_b;
  json["unjudged"] = report.nodes->coverage.unjudged;
  json["rows"] = Json::array();
  for (const ComparisonRow& row : report.nodes->rows)
    json["rows"].push_back(json_of(report.grid(), row));
  for (const WorstList& list : worst_lists(report))
    json["worst"][list.name] = json_of_worst(report, list.entries);
  json["entries"] = Json::array();
  for (std::size_t flat = 0; flat < report.nodes->entries.size(); ++flat)
    json["entries"].push_back(json_of_entry(report, flat));
}

}  // namespace

std::string report_json(const DiffReport& report) {
  Json json;
  json["a"] = report.a.file;
  json["b"] = report.b.file;
  const auto refined = [](const Table& table) {
    return table.refined ? Json(*table.refined) : Json(nullptr);
  };
  json["refined"] = {{"a", refined(report.a.table)}, {"b", refined(report.b.table)}};
  json["samples"] = report.settings.nodes.samples;
  json["directions"] = report.settings.nodes.directions;
  json["seed"] = report.settings.nodes.seed;
  json["nearer"] = {{"in_use", nearer_json(report.use.look_ups)},
                    {"under_area_lights", nearer_json(report.use.area_lights)},
                    {"at_nodes", report.nodes ? nearer_json(report.nodes->losses) : Json(nullptr)}};
  json["tolerance"] = json_of_tolerance(report);
  json["same_grid"] = report.nodes.has_value();
  if (report.nodes)
    add_nodes(json, report);
  json["use"] = json_of_use(report);
  json["queries"] = Json::array();
  for (const QueryComparison& query : report.queries)
    json["queries"].push_back(json_of_query(report, query));
  // File names are bytes of any kind; JSON is UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_csv(const DiffReport& report) {
  // Of the node; the lobe's own alpha_x and alpha_y follow.
  std::string text = report.grid().layout == Layout::alphax_alphay
                         ? "alpha_x_node,alpha_y_node,theta,phi"
                         : "alpha,lambda,theta,phi";
  const auto add_names = [&](const auto& fields) {
    for (const Field& field : fields)
      text += fmt::format(",{}", field.name);
  };
  add_names(fields_of({}));
  add_names(lobe_fields_of({}));
  add_names(area_light_fields_of({}));
  const auto add_row = [&](const std::string& place, const QueryComparison& judged) {
    text += '\n' + place + csv_of(fields_of(judged.lobes)) + csv_of(lobe_fields_of(judged.lobe)) +
            csv_of(area_light_fields_of(judged));
  };
  for (std::size_t flat = 0; report.nodes && flat < report.nodes->entries.size(); ++flat) {
    QueryComparison node;
    node.lobe = report.grid().lobe(flat);
    node.lobes = report.nodes->entries[flat];
    add_row(entry_text(report.grid(), flat), node);
  }
  for (const QueryComparison& query : report.queries)
    add_row("nan,nan,nan,nan", query);
  return text + '\n';
}

}  // namespace ltc::cli
