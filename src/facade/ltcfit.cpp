// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "ltcfit/ltcfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/config.h"
#include "core/platform.h"
#include "core/version.h"
#include "export/table_file.h"
#include "facade/watched_run.h"
#include "judge/validate_settings.h"
#include "pipeline/fit_one.h"
#include "pipeline/run.h"
#include "table/entry_text.h"
#include "table/lookup.h"

namespace ltcfit {
namespace {

std::optional<std::filesystem::path> file_of(const Config& config) {
  return config.file.empty() ? std::nullopt : std::optional(config.file);
}

ltc::Config load(const Config& config) {
  return config.file.empty()
             ? ltc::load_config(std::nullopt, config.overrides)
             : ltc::parse_config(ltc::config_text(config.file), config.file, config.overrides);
}

double require_in(const char* name, double value, bool good, const char* allowed) {
  if (!good)
    throw InputError(fmt::format("{} is {}; allowed: {}", name, value, allowed));
  return value;
}

ltc::Lobe checked(const Lobe& lobe, const ltc::LobeModel* model) {
  const auto roughness = [](const char* name, double alpha) {
    return require_in(name, alpha, alpha >= 1e-12 && alpha <= 1, "a number in [1e-12, 1]");
  };
  return {roughness("alpha_x", lobe.alpha_x), roughness("alpha_y", lobe.alpha_y),
          require_in("theta_radians", lobe.theta_radians,
                     lobe.theta_radians >= 0 && lobe.theta_radians < std::numbers::pi / 2,
                     "a number in [0, pi/2)"),
          require_in("phi_radians", lobe.phi_radians, std::isfinite(lobe.phi_radians),
                     "a finite number"),
          model};
}

}  // namespace

struct Table::Data {
  ltc::Table table;
  ltc::TableContents contents;
};

std::string_view version() {
  return ltc::version();
}

FittedLobe fit(const Lobe& lobe, const Config& config) {
  const ltc::Config settings = load(config);
  const ltc::LobeFit fit =
      ltc::fit_lobe(settings, checked(lobe, settings.grid.model), settings.fit.seed, std::nullopt);
  if (!has_values(fit.fitted.status))
    throw CheckFailure("the lobe has no finite fit; other settings of the solver may do");
  return {{fit.matrix, fit.albedo.amplitude, fit.albedo.fresnel}, fit.held_out_loss, fit.spread};
}

Table::Table(ltc::Table table, bool has_albedo, bool has_loss)
    : data_(std::make_shared<Data>(Data{std::move(table), {has_albedo, has_loss}})) {}

Table Table::read(const std::filesystem::path& file) {
  ltc::Table table = ltc::read_table(file);
  const ltc::TableContents contents = ltc::contents_of(file, table);
  return Table(std::move(table), contents.albedo, contents.loss);
}

void Table::write(const std::filesystem::path& file, bool half) const {
  ltc::write_table(data_->table, file, {half});
}

std::array<std::size_t, 4> Table::shape() const {
  return data_->table.grid.shape();
}

const std::vector<double>& Table::axis(std::size_t index) const {
  if (index >= ltc::Grid::axis_count)
    throw InputError(fmt::format("axis {} is not there; allowed: 0 to 3", index));
  return data_->table.grid.axis(index).nodes;
}

std::string_view Table::storage() const {
  return ltc::name_of(data_->table.storage);
}

const std::string& Table::config() const {
  return data_->table.config;
}

std::span<const float> Table::stored() const {
  return data_->table.stored;
}

std::span<const float> Table::amplitude() const {
  return data_->table.amplitude;
}

std::span<const float> Table::fresnel() const {
  return data_->table.fresnel;
}

std::span<const float> Table::loss() const {
  return data_->table.sw_loss;
}

Eigen::Matrix3d Table::matrix(const std::array<std::size_t, 4>& node) const {
  const ltc::Grid& grid = data_->table.grid;
  if (!std::ranges::equal(node, grid.shape(), std::ranges::less()))
    throw InputError(fmt::format("node {} is not there; the table has {}", fmt::join(node, ","),
                                 ltc::shape_text(grid, "×")));
  return data_->table.matrix_at(grid.flat({node[0], node[1], node[2], node[3]}));
}

Shading Table::look_up(const Lobe& lobe) const {
  const ltc::LookUp result = ltc::look_up(
      data_->table, {lobe.alpha_x, lobe.alpha_y, lobe.theta_radians, lobe.phi_radians});
  return {result.matrix, result.amplitude, result.fresnel};
}

Table generate(const Config& config, const Run& run, const Part& part) {
  ltc::RunRequest request;
  request.config = load(config);
  request.scene = part.scene;
  request.extend = part.extend;
  request.created = ltc::platform::utc_now_iso8601();
  request.warn = run.warn;
  ltc::RunReport report;
  do_watched(run, [&](const ltc::RunContext& context) { report = make_table(request, context); });
  return Table(std::move(report.table), true, true);
}

bool Validation::passed() const {
  return std::ranges::all_of(checks, &Check::passed);
}

Validation validate(const Table& table, const Config& limits, bool quality, const Run& run) {
  const auto& [judged, contents] = *table.data_;
  const ltc::ValidateSettings settings =
      ltc::load_validate_settings(file_of(limits), limits.overrides, ltc::settings_for(judged));
  Validation result;
  do_watched(run, [&](const ltc::RunContext& context) {
    for (const ltc::InvariantResult& check :
         check_invariants(judged, settings.invariants, context, contents))
      result.checks.push_back(
          {check.name, check.checked, check.passed, check.value, check.limit, check.message});
    if (!quality)
      return;
    const ltc::QualityReport report = measure_quality(judged, settings.quality, context);
    for (const ltc::ThresholdCheck& check :
         check_thresholds(report, settings.thresholds, settings.said))
      result.checks.push_back({check.what, check.has_verdict(), check.passed, check.value,
                               check.limit, check.passed ? "" : failure_line(check)});
    result.quality = {report.nodes.mean, report.query_losses.mean, report.floor_losses.mean,
                      report.area_light.mean, report.floor_area_light.mean};
  });
  return result;
}

}  // namespace ltcfit
