// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/stored_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <cmath>

#include "cli/lobe_words.h"
#include "judge/matrix_invariants.h"
#include "report/lobe_picture.h"
#include "table/entry_text.h"
#include "table/lookup.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string entry_line(const StoredReport& report, bool refined) {
  const Table& table = report.table;
  const std::size_t flat = *report.lobe.entry;
  std::string text =
      fmt::format("entry    {}: {}", entry_text(table.grid, flat), lobe_text(table.grid, flat));
  if (report.contents.loss)
    text += fmt::format("\nfile     {}, {} steps{}, loss {:.4e}", name_of(table.status[flat]),
                        table.iterations[flat], refined ? ", then refined" : "",
                        report.lobe.stated_loss);
  return text + '\n';
}

std::string nodes_text(const StoredReport& report) {
  const StoredLobe& lobe = report.lobe;
  if (report.table.field)
    return fmt::format("look-up  of the field's {} numbers\n", report.table.field->terms.size());
  std::string text = fmt::format("look-up  of {} {}, each with its own lobe's loss over spread\n",
                                 lobe.nodes.size(), lobe.nodes.size() == 1 ? "entry" : "entries");
  if (!lobe.within_axes)
    text += "         the lobe is beyond the table's axes: clamped to them, as a shader does\n";
  if (Reduction(report.table.grid).fold(lobe.lobe).unfold.determinant() < 0)
    text += "         unfolded by a reflection: a negative determinant, the same lobe\n";
  for (const TakenNode& node : lobe.nodes)
    text += fmt::format("         {:>7.4f} of {:<11} ({}) {:.4f}\n", node.weight,
                        entry_text(report.table.grid, node.flat),
                        lobe_text(report.table.grid, node.flat), node.relative_loss);
  return text;
}

// Of folded lobes alone.
std::string fold_text(const StoredLobe& lobe) {
  return lobe.creases.empty()
             ? ""
             : fmt::format("fold     k {:.6f}, g {:.6f}; creases {}\n", lobe.fold.k, lobe.fold.g,
                           fmt::join(lobe.creases, ", "));
}

// What the table costs beside an LTC of the lobe's own.
std::string ratio_words(const StoredLobe& lobe) {
  return fmt::format("the table's loss is {:.4g} times that of an LTC fitted to this very lobe",
                     lobe.held_out_loss / lobe.floor.held_out_loss);
}

std::string term_text(double value) {
  return std::isnan(value) ? "not in the file" : fmt::format("{:.6f}", value);
}

}  // namespace

std::string report_text(const StoredReport& report) {
  const StoredLobe& lobe = report.lobe;
  const LobeFit& floor = lobe.floor;
  const bool refined = report.table.refined == true;
  std::string text =
      fmt::format("table    {}, storage {}{}\n", report.file, name_of(report.table.storage),
                  report.table.field ? ", a field"
                  : refined          ? ", refined after the fit"
                                     : "");
  text += fmt::format("lobe     {} (degrees)\n", lobe_line(lobe.lobe));
  text += lobe.entry ? entry_line(report, refined) : nodes_text(report);
  text += matrix_text("matrix", lobe.matrix);
  text += fold_text(lobe);
  if (lobe.entry && report.table.storage != Storage::matrix)
    text += matrix_text("stored", lobe.stored);
  text += fmt::format("loss     {}\n", loss_words(lobe.held_out_loss, floor.spread));
  text += fmt::format("albedo   amplitude {}, Fresnel {}; by quadrature {:.6f} and {:.6f}\n",
                      term_text(lobe.albedo.amplitude), term_text(lobe.albedo.fresnel),
                      floor.albedo.amplitude, floor.albedo.fresnel);
  text += matrix_text("floor", floor.matrix);
  text += fmt::format("         {}\n         {}\n", loss_words(floor.held_out_loss, floor.spread),
                      ratio_words(lobe));
  return text;
}

std::string report_json(const StoredReport& report) {
  const StoredLobe& lobe = report.lobe;
  const LobeFit& floor = lobe.floor;
  const Grid& grid = report.table.grid;
  const auto loss_json = [&](double loss) -> Json {
    return {{"held_out", loss}, {"spread", floor.spread}, {"relative", loss / floor.spread}};
  };
  Json json;
  json["table"] = report.file;
  json["storage"] = name_of(report.table.storage);
  json["refined"] = report.table.refined ? Json(*report.table.refined) : Json(nullptr);
  json["lobe"] = lobe_json(lobe.lobe);
  if (lobe.entry) {
    json["entry"] = entry_text(grid, *lobe.entry);
    if (report.contents.loss) {
      json["status"] = name_of(report.table.status[*lobe.entry]);
      json["iterations"] = report.table.iterations[*lobe.entry];
    }
  } else {
    json["within_axes"] = lobe.within_axes;
    for (const TakenNode& node : lobe.nodes)
      json["nodes"].push_back({{"entry", entry_text(grid, node.flat)},
                               {"weight", node.weight},
                               {"relative_loss", node.relative_loss}});
  }
  json["matrix"]["final"] = matrix_json(lobe.matrix);
  if (lobe.entry)
    json["matrix"]["stored"] = matrix_json(lobe.stored);
  if (!lobe.creases.empty())
    json["fold"] = {{"k", lobe.fold.k}, {"g", lobe.fold.g}, {"creases", lobe.creases}};
  json["determinant"] = lobe.matrix.determinant();
  json["condition_number"] = condition_number(lobe.matrix);
  json["loss"] = loss_json(lobe.held_out_loss);
  if (lobe.entry && report.contents.loss)
    json["loss"]["stated"] = lobe.stated_loss;
  json["amplitude"] = lobe.albedo.amplitude;
  json["fresnel"] = lobe.albedo.fresnel;
  json["floor"] = {{"matrix", matrix_json(floor.matrix)},
                   {"determinant", floor.matrix.determinant()},
                   {"condition_number", condition_number(floor.matrix)},
                   {"loss", loss_json(floor.held_out_loss)},
                   {"amplitude", floor.albedo.amplitude},
                   {"fresnel", floor.albedo.fresnel}};
  // File names are bytes of any kind; JSON is UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

picture::Words picture_words(const StoredReport& report) {
  const StoredLobe& lobe = report.lobe;
  picture::Words words;
  words.title = lobe.entry ? fmt::format("Entry {} of {}",
                                         entry_text(report.table.grid, *lobe.entry), report.file)
                           : fmt::format("Look-up in {}", report.file);
  words.subtitle = lobe_caption(lobe.lobe);
  words.lines_below = {
      fmt::format("Loss {}; {}", loss_words(lobe.held_out_loss, lobe.floor.spread),
                  ratio_words(lobe)),
      fmt::format("Determinant {:.3e}, condition number {:.3e}; amplitude {}, Fresnel {}",
                  lobe.matrix.determinant(), condition_number(lobe.matrix),
                  term_text(lobe.albedo.amplitude), term_text(lobe.albedo.fresnel))};
  return words;
}

}  // namespace ltc::cli
