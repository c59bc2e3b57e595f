// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/render_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

// A figure of which more than this share is noise says little.
constexpr double largest_share_of_noise = 0.2;

bool is_noisy(const SphereError& error) {
  return error.relative_noise > largest_share_of_noise * error.relative_rmse;
}

std::string row_text(const RenderReport& report, std::size_t row, std::size_t table) {
  const auto& [material, images, clamped] = report.rows[row];
  const SphereError error = sphere_error(images, table);
  std::string text = fmt::format("{:>8.4g} {:>8.4g}  {:<7} ", material.alpha_x, material.alpha_y,
                                 report.names[table]);
  if (error.pixels == 0)
    return text + "no entries for this material\n";
  text += fmt::format("{:>12.5f} {:>11.2f} % {:>10.2f} %{} {:>8.2f}\n", error.mean_absolute,
                      100 * error.relative_rmse, 100 * error.relative_noise,
                      is_noisy(error) ? "!" : " ", report.seconds[row]);
  if (error.without > 0)
    text += fmt::format("{:19}{} of {} pixels without an entry\n", "", error.without,
                        error.without + error.pixels);
  return text;
}

bool any_noisy(const RenderReport& report) {
  for (const SphereRow& row : report.rows)
    for (std::size_t table = 0; table < report.names.size(); ++table)
      if (is_noisy(sphere_error(row.images, table)))
        return true;
  return false;
}

Json json_of(const RenderReport& report, std::size_t row, std::size_t table) {
  const SphereError error = sphere_error(report.rows[row].images, table);
  Json json = {{"table", report.files[table]},
               {"pixels", error.pixels},
               {"pixels_without_entry", error.without},
               {"clamped", Json::array()}};
  for (const auto& [axis, asked, taken] : report.rows[row].clamped[table])
    json["clamped"].push_back({{"axis", axis}, {"asked", asked}, {"taken", taken}});
  // Null where the table has nothing.
  json["reference_mean"] = error.reference_mean;
  json["mean_absolute_error"] = error.mean_absolute;
  json["rmse_over_mean"] = error.relative_rmse;
  json["noise_over_mean"] = error.relative_noise;
  return json;
}

}  // namespace

std::string tables_text(const RenderReport& report) {
  if (report.files.size() == 1)
    return "Table: " + report.files[0];
  return fmt::format("A: {}, B: {}", report.files[0], report.files[1]);
}

std::string clamping_warnings(const RenderReport& report) {
  std::string text;
  for (const SphereRow& row : report.rows)
    for (std::size_t table = 0; table < row.clamped.size(); ++table)
      if (!row.clamped[table].empty())
        text += fmt::format("{:.4g}, {:.4g} is beyond the axes of {}, clamped: {}\n",
                            row.material.alpha_x, row.material.alpha_y, report.files[table],
                            clamping_text(row.clamped[table]));
  return text;
}

std::string report_text(const RenderReport& report) {
  std::string text = fmt::format(
      "{}\nmean |error| in units of the light's radiance; RMSE, and the noise of {} in it, over "
      "its mean\n\n{:>8} {:>8}  {:<7} {:>12} {:>13} {:>12}  {:>8}\n",
      tables_text(report), report.reference, "alpha_x", "alpha_y", "table", "mean |error|", "RMSE",
      "noise", "seconds");
  for (std::size_t row = 0; row < report.rows.size(); ++row)
    for (std::size_t table = 0; table < report.names.size(); ++table)
      text += row_text(report, row, table);
  if (any_noisy(report))
    text += "! more than a fifth of the RMSE: raise --samples\n";
  text += clamping_warnings(report) + "\nwrote ";
  for (const std::filesystem::path& image : report.images)
    text += image.string() + "\n      ";
  return text + report.picture.string() + "\n";
}

std::string report_json(const RenderReport& report) {
  Json json = {{"shape", report.shape},
               {"light", report.light},
               {"light_position",
                {report.light_position.x(), report.light_position.y(), report.light_position.z()}},
               {"light_size", report.light_size},
               {"two_sided", report.two_sided},
               {"samples", report.samples},
               {"horizon", report.horizon},
               {"size", report.size},
               {"picture", report.picture.string()},
               {"materials", Json::array()}};
  for (std::size_t row = 0; row < report.rows.size(); ++row) {
    const SphereMaterial& material = report.rows[row].material;
    Json tables = Json::array();
    for (std::size_t table = 0; table < report.files.size(); ++table)
      tables.push_back(json_of(report, row, table));
    json["materials"].push_back({{"alpha_x", material.alpha_x},
                                 {"alpha_y", material.alpha_y},
                                 {"f0", material.f0},
                                 {"seconds", report.seconds[row]},
                                 {"image", report.images[row].string()},
                                 {"tables", tables}});
  }
  // File names are bytes of any kind; JSON is UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ltc::cli
