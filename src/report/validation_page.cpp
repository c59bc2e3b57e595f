// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/validation_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "report/html.h"
#include "report/validation_pictures.h"
#include "table/entry_text.h"

namespace ltc {
namespace {

using html::escaped;

// A figure, or a dash where there is none.
std::string number(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

std::string short_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–";
}

std::string tile(const std::string& value, std::string_view what, std::string_view beside) {
  return fmt::format("<div class=\"tile\"><b>{}</b>{}<span>{}</span></div>\n", value, escaped(what),
                     escaped(beside));
}

html::Verdict verdict_of(const InvariantResult& result) {
  return !result.passed    ? html::Verdict::failed
         : !result.checked ? html::Verdict::not_checked
         : !result.judged  ? html::Verdict::not_judged
                           : html::Verdict::passed;
}

html::Verdict verdict_of(const ThresholdCheck& check) {
  return !check.passed         ? html::Verdict::failed
         : check.has_verdict() ? html::Verdict::passed
         : check.judged()      ? html::Verdict::not_checked
                               : html::Verdict::not_judged;
}

std::string sentence(const Validation& validation) {
  if (is_sound(validation))
    return "<div class=\"sentence passed\">✓ Sound: every invariant holds, and no quality figure "
           "is "
           "beyond its threshold.</div>\n";
  std::string list;
  for (const InvariantResult& result : validation.invariants)
    if (!result.passed)
      list += fmt::format("<li>{}</li>", escaped(result.message));
  for (const ThresholdCheck& check : validation.thresholds)
    if (!check.passed)
      list += fmt::format("<li>{}</li>", escaped(failure_line(check)));
  return "<div class=\"sentence failed\">✗ Not sound<ul>" + list + "</ul></div>\n";
}

std::string header(const Validation& validation) {
  const Table& table = validation.table;
  std::string made = table.generator.empty() ? "" : ", made by " + table.generator;
  if (!table.created.empty())
    made += ", " + table.created;
  return fmt::format(
             "<h1>{}</h1>\n<p class=\"faint\">{} entries over {}, θ, φ, "
             "storage {}{}</p>\n<p class=\"faint\">{}</p>\n",
             escaped(validation.file), shape_text(table.grid, " × "),
             table.grid.layout == Layout::alphax_alphay ? "αx, αy" : "α, λ", name_of(table.storage),
             escaped(made), escaped(kind_text(table))) +
         sentence(validation);
}

std::string tiles(const Validation& validation) {
  const QualityReport& quality = validation.quality.value();
  const auto passed = std::count_if(validation.invariants.begin(), validation.invariants.end(),
                                    [](const InvariantResult& result) {
                                      return result.checked && result.judged && result.passed;
                                    });
  const auto checked = std::count_if(validation.invariants.begin(), validation.invariants.end(),
                                     [](const InvariantResult& result) {
                                       return (result.checked && result.judged) || !result.passed;
                                     });
  return "<div class=\"tiles\">\n" +
         tile(number(quality.query_losses.mean, 3), "loss between nodes",
              fmt::format("± {}, floor {}", number(quality.query_losses.standard_error, 3),
                          number(quality.floor_losses.mean, 3))) +
         tile(number(quality.area_light.mean, 4), "error under area lights",
              fmt::format("± {}, floor {}", number(quality.area_light.standard_error, 4),
                          number(quality.floor_area_light.mean, 4))) +
         tile(number(quality.nodes.p50, 3), "median loss at nodes",
              fmt::format("95 % below {}", number(quality.nodes.p95, 3))) +
         tile(fmt::format("{} of {}", passed, checked), "invariants hold",
              fmt::format("{} entries without values", quality.nodes_without_values)) +
         "</div>\n<p class=\"faint\">Losses are shares of the lobe's spread: 0 is the lobe itself, "
         "1 as far off as a single direction. The floor is what an LTC fitted to the very lobe "
         "reaches: above it is what the table costs, the floor itself is what the family of LTCs "
         "costs. ± is the standard error of a mean over the queries.</p>\n";
}

std::string checks(const Validation& validation) {
  const Grid& grid = validation.table.grid;
  html::Table invariants{{"invariant", "worst", "allowed", "", "at entry"}, {}, 1, 3};
  for (const InvariantResult& result : validation.invariants) {
    const bool judged = result.checked && result.has_worst;
    // Where all entries have the least value there is, none is worst.
    const bool one_is_worst = judged && !(result.passed && result.value == 0);
    invariants.rows.push_back(
        {escaped(result.name), judged ? short_number(result.value) : "–",
         judged ? allowed_text(result) : "–", html::verdict(verdict_of(result)),
         !result.checked ? fmt::format("<span class=\"faint\">{}</span>", escaped(result.reason))
         : one_is_worst  ? fmt::format("<code>{}</code> <span class=\"faint\">{}</span>",
                                       entry_text(grid, result.worst), lobe_text(grid, result.worst))
                         : ""});
  }
  html::Table thresholds{{"threshold", "table", "allowed", "", "key"}, {}, 1, 3};
  for (const ThresholdCheck& check : validation.thresholds)
    thresholds.rows.push_back(
        {escaped(check.what), check.reason.empty() ? short_number(check.value) : "–",
         check.reason.empty() ? fmt::format("at most {:.4g}", check.limit) : "–",
         html::verdict(verdict_of(check)),
         fmt::format("<code>{}</code> <span class=\"faint\">{}</span>", escaped(check.key),
                     escaped(check.reason))});
  return "<h2>Checks</h2>\n" + html::table(invariants) + html::table(thresholds);
}

std::vector<std::string> figures_row(const char* what, const Statistics& figures, int decimals) {
  return {what,
          fmt::format("{}", figures.count),
          number(figures.mean, decimals),
          number(figures.standard_error, decimals),
          number(figures.p50, decimals),
          number(figures.p95, decimals),
          number(figures.p99, decimals),
          number(figures.largest, decimals)};
}

std::string left_out(const QualityReport& quality) {
  std::string text;
  if (quality.queries_missing > 0)
    text += fmt::format(" {} need an entry that the table does not have and are left out.",
                        quality.queries_missing);
  if (quality.queries_outside > 0)
    text +=
        fmt::format(" {} are beyond the table's axes and are left out.", quality.queries_outside);
  if (quality.queries_singular > 0)
    text += fmt::format(" {} get a matrix without an inverse, which no light can be shaded with.",
                        quality.queries_singular);
  return text;
}

std::string figures(const QualityReport& quality) {
  html::Table table{{"", "judged", "mean", "±", "median", "95 %", "99 %", "largest"}, {}, 1, 8};
  table.rows = {
      figures_row("loss at nodes", quality.nodes, 4),
      figures_row("loss between nodes", quality.query_losses, 4),
      figures_row("the same, floor", quality.floor_losses, 4),
      figures_row("error under area lights, shape alone", quality.area_light, 4),
      figures_row("the same, with the table's amplitude", quality.area_light_with_amplitude, 4),
      figures_row("the same, floor", quality.floor_area_light, 4),
      figures_row("share below the horizon at nodes", quality.nodes_below_horizon, 4),
      figures_row("share below the horizon between nodes", quality.below_horizon, 4),
      figures_row("the same, floor", quality.floor_below_horizon, 4)};
  return "<h2>Quality</h2>\n" + html::table(table) +
         fmt::format(
             "<p>{} random queries.{} Errors under area lights are shares of the light that "
             "the whole lobe reflects, over {} rectangles a query; the BRDF is sampled, with a "
             "standard error of {:.1e} a rectangle.</p>\n",
             quality.queries.size(), left_out(quality), quality.settings.quads,
             quality.area_light_noise);
}

std::string pictures_html(const std::vector<NamedPicture>& pictures) {
  std::string html;
  for (const NamedPicture& picture : pictures)
    html += html::figure(picture.canvas, picture.title, picture.caption);
  return html;
}

std::vector<NamedPicture> band_pictures(const QualityReport& quality) {
  constexpr int width = 1040, height = 600;
  std::vector<NamedPicture> pictures;
  for (const picture::Chart& chart : band_charts(quality))
    pictures.push_back({chart.words.title, "", picture::render(chart, width, height)});
  return pictures;
}

// Two beside each other where there is room.
std::string in_pairs(const std::vector<NamedPicture>& pictures) {
  return "<div class=\"pair\">\n" + pictures_html(pictures) + "</div>\n";
}

std::string worst_queries(const Validation& validation) {
  const QualityReport& quality = validation.quality.value();
  html::Table table{{"query", "loss", "floor", "area lights", "floor", "look into it"}, {}, 0, 5};
  for (const std::size_t i : quality.worst_queries)
    table.rows.push_back({fmt::format("{}", i), number(quality.queries[i].relative_loss, 3),
                          number(quality.floors[i].relative_loss, 3),
                          number(quality.queries[i].area_light.mean_absolute, 4),
                          number(quality.floors[i].area_light.mean_absolute, 4),
                          fmt::format("<code>{}</code>",
                                      escaped(validation.query_command(quality.floors[i].lobe)))});
  return "<h2>Furthest above the floor</h2>\n" + html::table(table);
}

// Line by line: a line break is no character that a text may hold.
std::string preformatted(std::string_view text) {
  std::string html = "<pre>";
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    html += escaped(text.substr(0, end)) + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return html + "</pre>\n";
}

std::string how(const Validation& validation) {
  const QualitySettings& settings = validation.quality.value().settings;
  std::string html = fmt::format(
      "<h2>How this was measured</h2>\n<p>Held-out sliced-Wasserstein losses, exact by sorting: "
      "{} samples and {} directions of its own for each of at most {} nodes, {} and {} for each of "
      "{} queries. Queries have perceptual roughness uniform on [{:.4g}, {:.4g}], and λ, cos θ and "
      "φ uniform. Area lights by {} weighted samples of the lobe. Seed {}.</p>\n",
      settings.node_samples, settings.node_directions, settings.most_nodes, settings.query_samples,
      settings.query_directions, settings.queries, settings.range.roughness_first,
      settings.range.roughness_last, settings.quad_samples, settings.seed);
  if (!validation.table.config.empty())
    html += "<details><summary>The table's config</summary>" +
            preformatted(validation.table.config) + "</details>\n";
  return html;
}

}  // namespace

std::string kind_text(const Table& table) {
  const std::string bits = table.precision == Precision::half ? "16-bit values, " : "";
  if (!table.refined)
    return bits +
           "refined: unknown, the file does not say; judged by limits that hold for both kinds";
  return bits + (*table.refined ? "refined for what lies between the nodes" : "not refined");
}

bool is_sound(const Validation& validation) {
  return std::all_of(validation.invariants.begin(), validation.invariants.end(),
                     [](const InvariantResult& result) { return result.passed; }) &&
         std::all_of(validation.thresholds.begin(), validation.thresholds.end(),
                     [](const ThresholdCheck& check) { return check.passed; });
}

std::string validation_page(const Validation& validation, const PageSettings& settings,
                            const RunContext& run) {
  const QualityReport& quality = validation.quality.value();
  std::string body = header(validation) + tiles(validation) + checks(validation) +
                     figures(quality) + in_pairs(band_pictures(quality)) +
                     worst_queries(validation);
  body += pictures_html(lobe_pictures(validation, settings.lobes, run));
  body += "<h2>The whole table</h2>\n" + in_pairs(table_pictures(validation));
  if (settings.sphere_size > 0) {
    const NamedPicture spheres = sphere_picture(validation, settings, run);
    body += "<h2>Rendered</h2>\n" + html::figure(spheres.canvas, spheres.title, spheres.caption);
  }
  body += how(validation);
  return html::page("Validation of " + validation.file, body);
}

}  // namespace ltc
