// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What generate tells at its end, as JSON (docs/json.md).
#include <nlohmann/json.hpp>

#include "cli/json_text.h"
#include "cli/summary.h"
#include "pipeline/summary.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json entries_json(const TableSummary& summary) {
  Json json;
  for (const Status status : {Status::fitted, Status::copied, Status::analytic,
                              Status::interpolated, Status::skipped, Status::failed})
    json[std::string(name_of(status))] =
        summary.entries_by_status[static_cast<std::size_t>(status)];
  return json;
}

Json loss_json(const TableSummary& summary) {
  if (summary.losses.count == 0)
    return nullptr;
  return {{"mean", summary.losses.mean},
          {"p95", summary.losses.p95},
          {"largest", summary.losses.largest}};
}

Json refine_json(const GenerateReport& made) {
  if (!made.refine)
    return nullptr;
  return {{"kept", made.refine->kept},
          {"steps", made.refine->steps},
          {"queries", made.refine->queries},
          {"loss_before", made.refine->loss_before},
          {"loss_after", made.refine->loss_after}};
}

}  // namespace

std::string summary_json(const RunReport& report) {
  const Table& table = report.table;
  const TableSummary summary = summarize(table, worst_count);
  const GenerateReport& made = report.generate;
  Json json;
  json["files"] = Json::array();
  for (const std::filesystem::path& file : report.files)
    json["files"].push_back(file.string());
  json["shape"] = table.grid.shape();
  json["entries"] = entries_json(summary);
  json["needed"] = report.needed;
  json["added"] = report.added;
  json["resumed"] = report.resumed;
  json["loss"] = loss_json(summary);
  json["refined"] = refine_json(made);
  json["largest_zeroed"] = {{"value", made.largest_zeroed},
                            {"entry", entry_text(table.grid, made.largest_zeroed_entry)}};
  json["worst"] = Json::array();
  for (const std::size_t flat : summary.worst)
    json["worst"].push_back(
        {{"entry", entry_text(table.grid, flat)}, {"loss", table.sw_loss[flat]}});
  json["seconds"] = report.seconds;
  json["stage_seconds"] = Json::object();
  for (const auto& [stage, seconds] : made.stage_seconds)
    json["stage_seconds"][stage] = seconds;
  json["peak_memory_bytes"] = report.peak_memory_bytes;
  return json_text(json);
}

}  // namespace ltc::cli
