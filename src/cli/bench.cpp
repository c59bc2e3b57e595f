// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit bench: run time against error of many settings, in one run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "bench/report.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/write_file.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

// Keeps the whole run within two or three minutes, and lets a 99th percentile mean something.
constexpr std::size_t default_entries = 200;

struct Arguments {
  ConfigArguments config;
  std::string settings;  // empty: all
  std::size_t entries = default_entries;
  bool all = false;
  std::string published, reference;  // empty: none
  std::optional<ReadAs> layout;      // of both
  std::size_t whole_fits = 0;
  CompareSettings judge;
  std::string json, csv, picture;  // empty: none
};

// The built-in settings, and what the user's own config says where there is one.
std::vector<BenchSetting> available_settings(const Arguments& arguments, const Config& config) {
  std::vector<BenchSetting> settings = bench_settings(config.fit.seed);
  if (!arguments.config.as_text().empty())
    settings.push_back(
        {"config", "your config", "as" + arguments.config.as_text() + " says", config.fit});
  return settings;
}

// A ratio, or a dash where nothing was judged.
std::string ratio_text(double ratio, const Statistics& of) {
  return of.count > 0 ? fmt::format("{:.4f}", ratio) : "-";
}

std::string error_text(const SettingSummary& summary) {
  const Statistics &ratios = summary.ratios, &rough = summary.rough_ratios;
  return fmt::format("{:>9} {:>9} {:>9} {:>9} {:>9} {:>9}", ratio_text(ratios.mean, ratios),
                     ratio_text(rough.mean, rough), ratio_text(ratios.p50, ratios),
                     ratio_text(ratios.p99, ratios), ratio_text(ratios.largest, ratios),
                     summary.judged > 0 ? fmt::to_string(summary.failures) : "-");
}

std::string row_text(const BenchSetting& setting, const SettingSummary& summary) {
  return fmt::format("{:<18} {:>11.3f} {:>11.3f} {:>13} {}\n", setting.name,
                     1e3 * summary.seconds.p50, 1e3 * summary.seconds.mean,
                     (summary.extrapolated ? "~" : "") + duration_text(summary.table_seconds),
                     error_text(summary));
}

// How the first few steps became hours, and whose error stands beside them.
std::string extrapolation_text(const BenchSetting& setting, const SettingSummary& summary) {
  std::string text = fmt::format("~ {}: time extrapolated from {} timed steps of {}; ",
                                 setting.name, setting.timed_steps, setting.fit.sgd.steps);
  if (summary.error_source == ErrorSource::none)
    return text + "no error without --published or --full-sgd\n";
  return text + fmt::format("error of {}, {} {}\n", name_of(summary.error_source), summary.judged,
                            summary.judged == 1 ? "entry" : "entries");
}

// "default takes 1/6100 of the time of sgd-published", where both were run.
std::string comparison_text(const FrontierReport& report) {
  const auto find = [&](std::string_view name) -> const SettingSummary* {
    for (std::size_t i = 0; i < report.task.settings.size(); ++i)
      if (report.task.settings[i].name == name)
        return &report.summaries[i];
    return nullptr;
  };
  const SettingSummary* fast = find("default");
  const SettingSummary* slow = find("sgd-published");
  if (!fast || !slow)
    return "";
  return fmt::format("default is {:.0f} times faster per entry than sgd-published\n",
                     slow->seconds.mean / fast->seconds.mean);
}

std::string report_text(const FrontierReport& report) {
  const FrontierTask& task = report.task;
  std::string text = fmt::format(
      "{} of the {} fitted entries of a {} table, evenly strided. Each is fitted by all\n"
      "settings in turn; times are processor time of one core. Error: held-out loss ({} samples,\n"
      "{} directions) over that of {}.\n\n",
      task.entries.size(), fitted_entries(task.grid).size(), shape_text(task.grid),
      task.judge.samples, task.judge.directions,
      report.reference_file.empty() ? "the best setting at each entry" : report.reference_file);
  text += fmt::format("{:<18} {:>23} {:>13} {:>9} {:>9}\n", "", "milliseconds an entry", "table,",
                      "error", "mean for");
  text += fmt::format("{:<18} {:>11} {:>11} {:>13} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                      "setting", "median", "mean", "one core", "mean",
                      fmt::format("a>{:.0e}", task.grid.alpha_min), "median", "p99", "worst",
                      "failures");
  std::string notes;
  for (std::size_t i = 0; i < task.settings.size(); ++i) {
    text += row_text(task.settings[i], report.summaries[i]);
    if (report.summaries[i].extrapolated)
      notes += extrapolation_text(task.settings[i], report.summaries[i]);
  }
  notes += comparison_text(report);
  return text + (notes.empty() ? "" : "\n" + notes);
}

std::optional<Table> table_of(const std::string& file, std::optional<ReadAs> layout) {
  return file.empty() ? std::nullopt
                      : std::optional<Table>(read_input(file, layout, FoldedLobes::refused));
}

void require_grid(const Grid& grid, const std::optional<Table>& table,
                  const std::string& file) try {
  if (table)
    require_same_grid(table->grid, grid);
} catch (const InputError& error) {
  throw InputError(fmt::format("{} against the config: {}", file, error.what()));
}

std::vector<BenchSetting> chosen_settings(const Arguments& arguments, const Config& config) try {
  return select_settings(available_settings(arguments, config), arguments.settings);
} catch (const InputError& error) {
  throw InputError(fmt::format("--settings: {}", error.what()));
}

void bench(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const Config config = arguments.config.load();
  const std::optional<Table> published = table_of(arguments.published, arguments.layout);
  const std::optional<Table> reference = table_of(arguments.reference, arguments.layout);
  require_grid(config.grid, published, arguments.published);
  require_grid(config.grid, reference, arguments.reference);

  if (reference && reference->refined == true)
    warn(
        fmt::format("{} is refined: its nodes serve what lies between them, and fits come nearer "
                    "to their own lobes; a reference is made with refine.steps=0",
                    arguments.reference));

  FrontierReport report;
  report.published_file = arguments.published;
  report.reference_file = arguments.reference;
  FrontierTask& task = report.task;
  task.grid = config.grid;
  task.settings = chosen_settings(arguments, config);
  task.entries = fitted_entries(config.grid);
  if (!arguments.all)
    task.entries = strided(task.entries, arguments.entries);
  task.judge = arguments.judge;
  task.published = published ? &*published : nullptr;
  task.reference = reference ? &*reference : nullptr;
  task.whole_fits = arguments.whole_fits;
  report.run = measure_frontier(task, {1, &progress});
  report.summaries = summarize(task, report.run);

  progress.throw_if_stopped();
  if (!arguments.csv.empty())
    write_file(arguments.csv, frontier_csv(report));
  if (!arguments.picture.empty())
    picture::render(frontier_chart(report), 1600, 1100).write_png(arguments.picture);
  print_results(
      arguments.json, [&] { return report_text(report); }, [&] { return frontier_json(report); });
}

void add_what_options(CLI::App& app, Arguments& arguments) {
  add_config_options(app, arguments.config);
  constexpr const char* group = "What to measure";
  app.add_option("--settings", arguments.settings,
                 "only these of the built-in settings; \"config\" is what --config and --set say")
      ->option_text("A,B,...")
      ->group(group);
  CLI::Option* entries =
      allow(app.add_option("--entries", arguments.entries, "how many of the fitted entries [200]"),
            whole_number(1, 1 << 24))
          ->option_text("N")
          ->group(group);
  app.add_flag("--all", arguments.all, "all fitted entries")->excludes(entries)->group(group);
}

void add_error_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What errors are relative to";
  const auto add_count = [&](const char* name, std::size_t& count, const char* what, double least,
                             double most) {
    return allow(app.add_option(name, count, fmt::format("{} [{}]", what, count)),
                 whole_number(least, most))
        ->option_text("N")
        ->group(group);
  };
  add_input_option(app, "--reference", arguments.reference,
                   "table whose losses are 1 [the best setting at each entry]")
      ->group(group);
  CLI::Option* published =
      add_input_option(app, "--published", arguments.published,
                       "table whose error stands in for that of sgd-published [none]")
          ->group(group);
  add_count("--full-sgd", arguments.whole_fits,
            "make sgd-published's whole fit at so many entries, half a minute each", 0, 1 << 24)
      ->excludes(published);
  add_count("--samples", arguments.judge.samples, "held-out samples an entry", 64, 1 << 20);
  add_count("--directions", arguments.judge.directions, "held-out directions an entry", 1, 4096);
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to write";
  add_json_option(app, arguments.json)->group(group);
  add_output_option(app, "--csv", arguments.csv, "every fit as a line")->group(group);
  add_png_option(app, "--picture", arguments.picture, "time against error")->group(group);
}

}  // namespace

Action declare_bench(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_what_options(app, *arguments);
  add_error_options(app, *arguments);
  add_layout_option(app, arguments->layout);
  add_output_options(app, *arguments);
  return [arguments](Files&) { bench(*arguments); };
}

}  // namespace ltc::cli
