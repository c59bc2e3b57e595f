// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit fit: one lobe through the pipeline, every step shown; or what a table holds for it.
#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <memory>

#include "cli/command.h"
#include "cli/fit_report.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/roughness_options.h"
#include "cli/stored_report.h"
#include "cli/table_input.h"
#include "core/angle.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/platform.h"
#include "core/progress.h"
#include "core/write_file.h"
#include "export/table_file.h"
#include "fit/symmetry_plan.h"
#include "report/lobe_picture.h"
#include "scene/coverage.h"
#include "table/lookup.h"

namespace ltc::cli {
namespace {

struct Arguments {
  ConfigArguments config;
  std::string as_in;  // a table to show the lobe of; empty: none, the lobe is fitted
  std::string scene;  // empty: the whole table
  std::string entry;  // empty: the lobe is named by its parameters
  RoughnessArguments roughness;
  std::optional<double> theta_degrees, phi_degrees;
  std::string solver, seed, samples;  // empty: the config's
  std::string start;                  // empty: the solver's own
  std::string trace, plot, json;      // empty: none
  std::optional<ReadAs> layout;       // of the table of as_in or start
  bool check_gradient = false;
  int threads = processor_count();
};

// --solver, --seed and --samples are keys of the config by a shorter name.
Config load(const Arguments& arguments) {
  ConfigArguments all = arguments.config;
  if (!arguments.solver.empty())
    all.overrides.push_back("fit.solver=" + arguments.solver);
  if (!arguments.seed.empty())
    all.overrides.push_back("fit.seed=" + arguments.seed);
  if (!arguments.samples.empty()) {
    const SolverKind solver = all.load().fit.solver;
    all.overrides.push_back((solver == SolverKind::sgd              ? "fit.sgd.samples="
                             : solver == SolverKind::l3_nelder_mead ? "fit.l3.samples="
                                                                    : "fit.gauss_newton.samples=") +
                            arguments.samples);
  }
  return all.load();
}

std::size_t parse_entry(const std::string& text, const Grid& grid) {
  const auto shape = grid.shape();
  std::array<std::size_t, 4> indices{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  bool good = true;
  for (std::size_t axis = 0; axis < 4 && good; ++axis) {
    const auto [stop, error] = std::from_chars(at, end, indices[axis]);
    good = error == std::errc() && indices[axis] < shape[axis] &&
           (axis < 3 ? stop != end && *stop == ',' : stop == end);
    at = stop + (axis < 3 && good);
  }
  if (!good)
    throw InputError(
        fmt::format("--entry {}: expected ALPHA,LAMBDA,THETA,PHI, indices from 0 to {},{},{},{}",
                    shell_quoted(text), shape[0] - 1, shape[1] - 1, shape[2] - 1, shape[3] - 1));
  return grid.flat({indices[0], indices[1], indices[2], indices[3]});
}

bool names_parameters(const Arguments& arguments) {
  return arguments.roughness.any() || arguments.theta_degrees || arguments.phi_degrees;
}

// What the stress runs go down to.
constexpr double least_alpha = 1e-12;

Lobe parse_lobe(const Arguments& arguments, const LobeModel& model) {
  const std::array<std::pair<const char*, bool>, 3> parameters = {
      {{"--alpha-x and --alpha-y, or --roughness,", arguments.roughness.any()},
       {"--theta", arguments.theta_degrees.has_value()},
       {"--phi", arguments.phi_degrees.has_value()}}};
  for (const auto& [option, given] : parameters)
    if (!given)
      throw InputError(
          fmt::format("{} is missing; a lobe is named by its roughness, --theta and --phi "
                      "together, or by --entry",
                      option));
  const LobeRoughness roughness = roughness_of(arguments.roughness, least_alpha);
  return {roughness.alpha_x, roughness.alpha_y, radians_of_degrees(*arguments.theta_degrees),
          radians_of_degrees(*arguments.phi_degrees), &model};
}

// The nine numbers of --start matrix=…, M by rows. Any numbers: solvers have to cope.
Eigen::Matrix3d parse_matrix(const std::string& text, std::string_view numbers) {
  Eigen::Matrix3d matrix;
  const char* at = numbers.data();
  const char* const end = at + numbers.size();
  for (int entry = 0; entry < 9; ++entry) {
    const auto [stop, error] = std::from_chars(at, end, matrix(entry / 3, entry % 3));
    if (error != std::errc() || (entry < 8 ? stop == end || *stop != ',' : stop != end))
      throw InputError(fmt::format("--start {}: expected matrix= and nine numbers between commas",
                                   shell_quoted(text)));
    at = stop + 1;
  }
  return matrix;
}

// --start from=TABLE
constexpr std::string_view start_from = "from=";
std::string start_table(const std::string& start) {
  return start.substr(start_from.size());
}

// M of --start; `entry` is that of the config's grid, where the lobe is one.
Eigen::Matrix3d parse_start(const std::string& text, const Config& config, const Lobe& lobe,
                            std::optional<std::size_t> entry, std::uint64_t seed,
                            std::optional<ReadAs> layout) {
  constexpr std::string_view given = "matrix=";
  if (text.starts_with(given))
    return parse_matrix(text, std::string_view(text).substr(given.size()));
  if (text.starts_with(start_from)) {
    const Table table = read_input(start_table(text), layout, FoldedLobes::refused);
    Eigen::Matrix3d matrix =
        entry && table.grid == config.grid ? table.matrix_at(*entry) : look_up(table, lobe).matrix;
    if (!matrix.allFinite())
      throw InputError(fmt::format("--start {}: the table has no values at this lobe", text));
    if (matrix.determinant() < 0)
      matrix.col(1) = -matrix.col(1);
    return matrix;
  }
  for (const auto& [kind, name] : enum_names(StartKind()).pairs)
    if (text == name)
      return starting_matrix(kind, lobe, seed);
  throw InputError(fmt::format("--start {}: expected {}, from=TABLE or matrix=NINE,NUMBERS",
                               shell_quoted(text), fmt::join(all_names<StartKind>(), ", ")));
}

// Which entries are made with the one that is asked for: those of the scene, or those of the table
// whose config is taken.
std::vector<bool> needed_with(const Arguments& arguments, const Config& config) {
  if (!arguments.scene.empty()) {
    const Scene scene = load_scene(arguments.scene);
    std::ranges::for_each(scene.warnings, warn);
    return needed_entries(scene, config.grid);
  }
  std::vector<bool> needed(config.grid.size(), true);
  const std::optional<std::filesystem::path> file = arguments.config.path();
  if (!file || !is_whole_table(*file))
    return needed;
  const Table table = read_table(*file);
  for (std::size_t flat = 0; table.grid == config.grid && flat < needed.size(); ++flat)
    needed[flat] = table.status[flat] != Status::skipped;
  return needed;
}

// The entry as its table has it, or the lobe by itself.
FitReport run_fit(const Arguments& arguments, const Config& config, const RunContext& run) {
  FitReport report;
  report.settings = config.fit;
  report.storage = config.storage;
  report.grid = config.grid;
  report.refined = config.refine.steps > 0;
  report.start = arguments.start;
  Lobe lobe;
  std::size_t seed_index = 0;
  if (arguments.entry.empty()) {
    lobe = parse_lobe(arguments, *config.grid.model);
  } else {
    report.entry = parse_entry(arguments.entry, config.grid);
    lobe = config.grid.lobe(*report.entry);
    seed_index = plan_by_symmetry(config.grid)[*report.entry].representative;
  }
  const std::uint64_t seed = entry_seed(config.fit.seed, seed_index);
  if (!arguments.start.empty()) {
    report.fit = fit_lobe(
        config, lobe, seed,
        parse_start(arguments.start, config, lobe, report.entry, seed, arguments.layout), run);
  } else if (report.entry) {
    const std::vector<bool> needed = needed_with(arguments, config);
    if (!needed[*report.entry])
      throw InputError(arguments.scene.empty()
                           ? fmt::format("--entry {}: {} has none there; its scene did not need it",
                                         arguments.entry, arguments.config.file)
                           : fmt::format("--entry {}: the scene {} does not need it",
                                         arguments.entry, arguments.scene));
    const std::size_t representative =
        plan_by_symmetry(config.grid, needed)[*report.entry].representative;
    if (representative != *report.entry)
      report.representative = representative;
    report.fit = fit_table_entry(config, needed, *report.entry, run);
  } else {
    report.fit = fit_lobe(config, lobe, seed, std::nullopt, run);
  }
  return report;
}

void require_one_name(const Arguments& arguments) {
  const bool by_entry = !arguments.entry.empty(), by_parameters = names_parameters(arguments);
  if (by_entry && by_parameters)
    throw InputError(
        "a lobe is named by --entry or by its roughness, --theta and --phi, not by both");
  if (!by_entry && !by_parameters)
    throw InputError(
        "no lobe named; expected --entry, or --alpha-x and --alpha-y or --roughness, --theta and "
        "--phi");
  if (!arguments.scene.empty() && (!by_entry || !arguments.start.empty()))
    throw InputError("--scene tells which table an --entry is of; it goes with no other start");
}

// What the table holds for the lobe; nothing is fitted but the floor.
void show_as_in(const Arguments& arguments, const RunContext& run) {
  Table table = read_input(arguments.as_in, arguments.layout);
  const TableContents contents = contents_of(arguments.as_in, table);
  StoredReport report{arguments.as_in, contents, std::move(table), {}};
  const auto named = [&](auto&& action) {
    try {
      return action();
    } catch (const InputError& error) {
      throw InputError(fmt::format("--as-in {}: {}", arguments.as_in, error.what()));
    }
  };
  if (arguments.entry.empty()) {
    const Lobe lobe = parse_lobe(arguments, *report.table.grid.model);
    report.lobe = named([&] { return stored_query(report.table, lobe, run); });
  } else {
    const std::size_t entry = parse_entry(arguments.entry, report.table.grid);
    report.lobe = named([&] { return stored_entry(report.table, entry, run); });
  }
  if (!arguments.plot.empty())
    render_lobe(lobe_panels(report.lobe.lobe,
                            {{is_folded(report.table) ? "folded LTC" : "LTC", report.lobe.ltc()}},
                            picture_words(report)),
                {})
        .write_png(arguments.plot);
  print_results(
      arguments.json, [&] { return report_text(report); }, [&] { return report_json(report); });
}

// The lobe's fit, every step of it.
void show_fit(const Arguments& arguments, const RunContext& run) {
  const Config config = load(arguments);
  FitReport report = run_fit(arguments, config, run);
  if (arguments.check_gradient)
    report.gradient = check_lobe_gradient(report.fit.lobe, report.fit.matrix,
                                          report.fit.fitted.fold, report.fit.creases);
  if (!arguments.trace.empty())
    write_file(arguments.trace, trace_csv(report));
  if (!arguments.plot.empty())
    render_lobe(lobe_panels(report.fit.lobe, pictured_lobes(report), picture_words(report)),
                loss_chart(report))
        .write_png(arguments.plot);
  print_results(
      arguments.json, [&] { return report_text(report); }, [&] { return report_json(report); });
  if (report.gradient && !report.gradient->passed)
    throw CheckFailure("gradient check failed: " + report.gradient->describe());
}

void fit(const Arguments& arguments, Files& files) {
  StopOnly progress;  // one lobe is done before a bar would be read
  const StopOnInterrupt stop_on_interrupt(progress);
  const RunContext run{arguments.threads, &progress};
  require_one_name(arguments);
  if (arguments.layout && arguments.as_in.empty() && !arguments.start.starts_with(start_from))
    throw InputError("--layout needs a table: --as-in TABLE or --start from=TABLE");
  if (arguments.start == start_from)
    throw InputError("--start from=: expected from= and a table's file");
  if (arguments.start.starts_with(start_from))
    files.read("--start", start_table(arguments.start));
  if (arguments.as_in.empty())
    show_fit(arguments, run);
  else
    show_as_in(arguments, run);
}

void add_lobe_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "Which lobe";
  app.add_option("-e,--entry", arguments.entry,
                 "entry of the config's table, fitted bit for bit as generate does; with --as-in, "
                 "of that table: 3,0,7,4")
      ->option_text("A,L,T,P")
      ->group(group);
  add_input_option(
      app, "--as-in", arguments.as_in,
      fmt::format("fit no entry: show what this table ({}) holds for the entry or gives for the "
                  "lobe, and what a fit of that very lobe would [none]",
                  endings_text(is_read)))
      ->group(group);
  add_input_option(app, "--scene", arguments.scene, "the scene that the table was made for [none]")
      ->group(group);
  add_roughness_options(
      app, arguments.roughness,
      {"roughness along x, in [1e-12, 1]", "roughness along y, in [1e-12, 1]", group});
  allow(app.add_option("--theta", arguments.theta_degrees,
                       "angle between view and normal, degrees in [0, 90)"),
        number(below(0, 90)))
      ->option_text("DEGREES")
      ->group(group);
  allow(app.add_option("--phi", arguments.phi_degrees, "azimuth of the view, degrees"),
        number({-360, 360}))
      ->option_text("DEGREES")
      ->group(group);
}

void add_fit_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "How to fit";
  allow_names(app.add_option("--solver", arguments.solver,
                             "gauss-newton, sgd or l3-nelder-mead [fit.solver]"),
              all_names<SolverKind>())
      ->option_text("NAME")
      ->group(group);
  allow(app.add_option("--seed", arguments.seed, "seed of everything random [fit.seed]"),
        seed_number())
      ->option_text("N")
      ->group(group);
  allow(app.add_option("--samples", arguments.samples, "cosine samples [fit.SOLVER.samples]"),
        whole_number(1, 1 << 20))
      ->option_text("N")
      ->group(group);
  app.add_option("--start", arguments.start,
                 "first-order, moments, identity, random, from=TABLE, or matrix=M00,M01,... of "
                 "nine numbers [the solver's own]")
      ->option_text("START")
      ->group(group);
  app.add_flag("--check-gradient", arguments.check_gradient,
               "compare the loss's gradient with finite differences; exit 1 where it is wrong")
      ->group(group);
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to write";
  add_json_option(app, arguments.json)->group(group);
  add_output_option(app, "--trace", arguments.trace, "write every step to this file, as CSV")
      ->group(group);
  add_png_option(app, "--plot", arguments.plot, "draw GGX, LTC and their difference into this file")
      ->group(group);
}

}  // namespace

Action declare_fit(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_lobe_options(app, *arguments);
  add_layout_option(app, arguments->layout);
  add_config_options(app, arguments->config);
  add_fit_options(app, *arguments);
  add_output_options(app, *arguments);
  add_threads_option(app, arguments->threads);
  for (const char* of_fits : {"--config", "--set", "--scene", "--solver", "--seed", "--samples",
                              "--start", "--trace", "--check-gradient"})
    app.get_option("--as-in")->excludes(app.get_option(of_fits));
  return [arguments](Files& files) { fit(*arguments, files); };
}

}  // namespace ltc::cli
