// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

using Json = nlohmann::ordered_json;

Json file_or_null(const std::string& file) {
  return file.empty() ? Json() : Json(file);
}

Json json_of(const Grid& grid, const BenchSetting& setting, const SettingSummary& summary) {
  const Statistics& ratios = summary.ratios;
  const bool any = ratios.count > 0;
  const auto value = [&](double ratio) { return any ? Json(ratio) : Json(); };
  return {{"name", setting.name},
          {"summary", setting.summary},
          {"milliseconds_median", 1e3 * summary.seconds.p50},
          {"milliseconds_mean", 1e3 * summary.seconds.mean},
          {"table_seconds_one_core", summary.table_seconds},
          {"time_extrapolated", summary.extrapolated},
          {"error_of", name_of(summary.error_source)},
          {"judged", summary.judged},
          {"failures", summary.failures},
          {"ratio_mean", value(ratios.mean)},
          {"ratio_mean_above_alpha_min",
           summary.rough_ratios.count > 0 ? Json(summary.rough_ratios.mean) : Json()},
          {"ratio_median", value(ratios.p50)},
          {"ratio_p99", value(ratios.p99)},
          {"ratio_worst", value(ratios.largest)},
          {"worst_entry", any ? Json(entry_text(grid, ratios.largest_index)) : Json()}};
}

// The kinds of settings that a picture tells apart.
enum class Family { gauss_newton, variants, descent, l3 };

Family family_of(const BenchSetting& setting) {
  switch (setting.fit.solver) {
    case SolverKind::sgd:
      return Family::descent;
    case SolverKind::l3_nelder_mead:
      return Family::l3;
    case SolverKind::gauss_newton:
      break;
  }
  return setting.name.starts_with("default-") ? Family::variants : Family::gauss_newton;
}

// What the picture shows of a setting: mirrors left out where there are others. NaN where nothing
// was judged.
double error_of(const SettingSummary& summary) {
  return (summary.rough_ratios.count > 0 ? summary.rough_ratios : summary.ratios).mean - 1;
}

// Where a logarithmic axis shows what is as good as the best known, or better: below all others.
double place_of_none(const std::vector<SettingSummary>& summaries) {
  double least = 1;
  for (const SettingSummary& summary : summaries)
    if (error_of(summary) > 0)
      least = std::min(least, error_of(summary));
  return least / 3;
}

std::vector<std::string> notes(const FrontierReport& report) {
  const FrontierTask& task = report.task;
  const std::size_t fitted = fitted_entries(task.grid).size();
  std::vector<std::string> lines = {
      fmt::format(
          "Time: mean of {} of the {} fitted entries, each by all settings in turn; times {}",
          task.entries.size(), fitted, fitted),
      fmt::format(
          "Error: mean held-out loss over that of {}, less 1; α > {:g}",
          report.reference_file.empty() ? "the best setting at each entry" : report.reference_file,
          task.grid.alpha_min)};
  for (std::size_t i = 0; i < task.settings.size(); ++i)
    if (report.summaries[i].extrapolated && report.summaries[i].judged > 0)
      lines.push_back(fmt::format("{}: time from {} timed steps of {}, error of {}",
                                  task.settings[i].label, task.settings[i].timed_steps,
                                  task.settings[i].fit.sgd.steps,
                                  name_of(report.summaries[i].error_source)));
  std::string unknown;
  for (std::size_t i = 0; i < task.settings.size(); ++i)
    if (std::isnan(error_of(report.summaries[i])))
      unknown += (unknown.empty() ? "" : "; ") + task.settings[i].label;
  if (!unknown.empty())
    lines.push_back("Not shown, as nothing is known of its error: " + unknown);
  return lines;
}

}  // namespace

std::string frontier_json(const FrontierReport& report) {
  const FrontierTask& task = report.task;
  Json settings = Json::array();
  for (std::size_t i = 0; i < task.settings.size(); ++i)
    settings.push_back(json_of(task.grid, task.settings[i], report.summaries[i]));
  const Json all = {{"generator", generator()},
                    {"grid", task.grid.shape()},
                    {"fitted_entries", fitted_entries(task.grid).size()},
                    {"entries", task.entries.size()},
                    {"threads", 1},
                    {"held_out",
                     {{"samples", task.judge.samples},
                      {"directions", task.judge.directions},
                      {"seed", task.judge.seed}}},
                    {"reference_file", file_or_null(report.reference_file)},
                    {"published_file", file_or_null(report.published_file)},
                    {"settings", settings}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string frontier_csv(const FrontierReport& report) {
  const FrontierTask& task = report.task;
  std::string text = "setting,alpha,lambda,theta,phi,milliseconds,steps,loss,reference_loss\n";
  for (std::size_t i = 0; i < task.settings.size(); ++i)
    for (std::size_t place = 0; place < task.entries.size(); ++place) {
      const EntryMeasurement& measurement = report.run.measurements[i][place];
      text += fmt::format("{},{},{},{},{},{}\n", task.settings[i].name,
                          entry_text(task.grid, task.entries[place]), 1e3 * measurement.seconds,
                          measurement.steps, measurement.loss, report.run.reference_loss[place]);
    }
  return text;
}

picture::Chart frontier_chart(const FrontierReport& report) {
  using namespace picture;
  const FrontierTask& task = report.task;
  Series families[] = {{"Gauss–Newton", {}, series_color(0), Marker::disc},
                       {"variants of the default", {}, series_color(4), Marker::open_triangle},
                       {"stochastic descent", {}, series_color(1), Marker::square},
                       {"L3 error, simplex", {}, series_color(2), Marker::diamond}};
  const double none = place_of_none(report.summaries);
  bool any_without = false;
  std::vector<ChartPoint> all;
  for (std::size_t i = 0; i < task.settings.size(); ++i) {
    const SettingSummary& summary = report.summaries[i];
    const double error = error_of(summary);
    if (std::isnan(error))
      continue;
    any_without |= error <= 0;
    all.push_back({summary.table_seconds, error > 0 ? error : none, task.settings[i].label});
    families[static_cast<std::size_t>(family_of(task.settings[i]))].points.push_back(all.back());
  }
  Chart chart;
  chart.words = {"Run time against error",
                 fmt::format("Table of {} entries on one core; lower left is better",
                             shape_text(task.grid, " × ")),
                 notes(report)};
  chart.x = {"time for the table", ScaleKind::logarithmic, TickFormat::duration};
  chart.y = {"mean error over the best known", ScaleKind::logarithmic, TickFormat::percent};
  chart.series = {{"frontier", pareto_front(all), Color::hex(0xb9bcc0), Marker::none, 6}};
  for (const Series& family : families)
    if (!family.points.empty())
      chart.series.push_back(family);
  if (any_without)
    chart.guides = {{Guide::Axis::y, none, "no error over the best known"}};
  return chart;
}

}  // namespace ltc
