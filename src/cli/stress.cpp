// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit stress: fits at the extremes from every start, counted and held to bars.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "bench/setting.h"
#include "cli/command.h"
#include "cli/fit_command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "config/overrides.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/write_file.h"
#include "stress/report.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t full_random_lobes = 100, quick_random_lobes = 12;
constexpr std::size_t most_worst = 5;

struct Arguments {
  ConfigArguments config;
  std::string solver;               // empty: all, or what the config says
  std::optional<std::size_t> fits;  // of each solver
  bool quick = false;
  std::optional<std::uint64_t> seed;  // of lobes and fits; empty: the config's
  std::string json, csv, map;         // empty: none
  int threads = processor_count();
};

// A solver as this command runs it.
struct SolverChoice {
  const char* name;     // of --solver
  const char* setting;  // of bench_settings
  bool must_pass;
};
constexpr SolverChoice choices[] = {{"gauss-newton", "default", true},
                                    {"sgd", "sgd-practical", false},
                                    {"l3-nelder-mead", "l3-nelder-mead", false}};

struct Solver {
  std::string name;
  Config config;
  bool must_pass;
};

FitSettings built_in_fit(const SolverChoice& choice, std::uint64_t seed) {
  return select_settings(bench_settings(seed), choice.setting).front().fit;
}

// A config is run as it is; without one, the solvers' built-in settings.
std::vector<Solver> solvers_of(const Arguments& arguments) {
  Config config = arguments.config.load();
  if (arguments.seed)
    config.fit.seed = *arguments.seed;
  const bool has_config = !arguments.config.as_text().empty();
  std::vector<Solver> solvers;
  for (const SolverChoice& choice : choices) {
    const FitSettings built_in = built_in_fit(choice, config.fit.seed);
    const bool asked_for = has_config && arguments.solver.empty()
                               ? config.fit.solver == built_in.solver
                               : arguments.solver.empty() || arguments.solver == choice.name;
    if (!asked_for)
      continue;
    if (config.fit.lobe == LobeKind::folded && built_in.solver != SolverKind::gauss_newton)
      throw InputError(fmt::format(
          "--solver {} with fit.lobe = \"folded\"; expected gauss-newton, the only one that fits "
          "folds",
          choice.name));
    solvers.push_back({choice.name, config, choice.must_pass});
    if (has_config)
      solvers.back().config.fit.solver = built_in.solver;
    else
      solvers.back().config.fit = built_in;
  }
  return solvers;
}

// At most `count` of the lobes, evenly strided; more than there are: random ones beside them.
std::vector<StressLobe> limited(const std::vector<StressLobe>& lobes, std::size_t count,
                                std::uint64_t seed) {
  std::vector<StressLobe> chosen = lobes;
  if (count < lobes.size()) {
    chosen.clear();
    for (std::size_t i = 0; i < count; ++i)
      chosen.push_back(lobes[(2 * i + 1) * lobes.size() / (2 * count)]);
  } else {
    const std::vector<StressLobe> more = random_lobes(count - lobes.size(), ~seed);
    chosen.insert(chosen.end(), more.begin(), more.end());
  }
  return chosen;
}

// The lobes and the judge for one solver. Only Gauss-Newton is fast enough for the whole grid.
StressReport prepared(const Arguments& arguments, const Solver& solver) {
  const FitSettings& fit = solver.config.fit;
  const bool fast = fit.solver == SolverKind::gauss_newton;
  StressReport report;
  report.name = solver.name;
  report.must_pass = solver.must_pass;
  report.axes = stress_axes(arguments.quick ? StressDensity::quick
                            : fast          ? StressDensity::full
                                            : StressDensity::coarse);
  StressTask& task = report.task;
  task.fit = fit;
  task.reference.seed = fit.seed;
  task.judge.samples = arguments.quick ? 4096 : 8192;
  task.judge.directions = 32;
  task.lobes = grid_lobes(report.axes);
  if (fast) {
    const std::vector<StressLobe> random =
        random_lobes(arguments.quick ? quick_random_lobes : full_random_lobes, fit.seed);
    task.lobes.insert(task.lobes.end(), random.begin(), random.end());
  }
  const LobeModel& model = *solver.config.grid.model;
  task.lobes = lobes_of_model(task.lobes, model);
  if (task.lobes.empty())
    throw InputError(
        fmt::format("BRDF \"{}\" has none of the lobes of a stress run", model.name()));
  std::erase_if(report.axes.lambda, [&](double lambda) {
    return std::ranges::find(task.lobes, lambda, &StressLobe::lambda) == task.lobes.end();
  });
  std::erase_if(report.axes.alpha, [&](double alpha) {
    return std::ranges::find(task.lobes, alpha, &StressLobe::alpha) == task.lobes.end();
  });
  const std::size_t starts = stress_starts().size();
  if (arguments.fits)
    task.lobes = limited(task.lobes, (*arguments.fits + starts - 1) / starts, fit.seed);
  return report;
}

std::vector<std::string> worst_commands(const StressReport& report, const Solver& solver) {
  const std::vector<std::string> overrides = overrides_of(to_toml(solver.config));
  std::vector<std::string> commands;
  for (const std::size_t index : report.verdict.worst) {
    const StressFit& fit = report.run.fits[index];
    const StressLobe& lobe = report.task.lobes[fit.lobe];
    const StressStartKind& kind = stress_starts()[fit.start];
    const NamedLobe named{lobe.alpha, lobe.lambda * lobe.alpha, lobe.theta_degrees,
                          lobe.phi_degrees};
    std::string start;
    if (const auto matrix = start_matrix(kind.start, lobe.lobe(), stress_seed(report.task.fit)))
      start = matrix_text(*matrix);
    commands.push_back(fit_command({"", overrides}, named, start));
  }
  return commands;
}

StressReport run_solver(const Arguments& arguments, const Solver& solver, Progress& progress) {
  StressReport report = prepared(arguments, solver);
  report.run = run_stress(report.task, {arguments.threads, &progress});
  report.verdict = judge_stress(report.run.fits, most_worst);
  report.commands = worst_commands(report, solver);
  return report;
}

std::string row_text(std::string_view name, const StressCounts& counts) {
  return fmt::format(
      "  {:<18} {:>6} {:>7} {:>7} {:>7} {:>9.3f} {:>10.4g} {:>9} {:>7.1f} {:>8.3f}\n", name,
      counts.fits, counts.non_finite, counts.determinants_not_positive, counts.missed,
      100 * counts.success_rate(), counts.largest_ratio, counts.abandoned, counts.mean_steps,
      1e3 * counts.mean_seconds);
}

std::string worst_text(const StressReport& report) {
  std::string text;
  for (std::size_t place = 0; place < report.verdict.worst.size(); ++place) {
    const StressFit& fit = report.run.fits[report.verdict.worst[place]];
    text += fmt::format("  {:.4g} from {}: {}\n", fit.ratio, stress_starts()[fit.start].name,
                        report.commands[place]);
  }
  return text;
}

std::string report_text(const StressReport& report) {
  const StressVerdict& verdict = report.verdict;
  std::string text =
      fmt::format("{}: {} lobes, {} fits in {}\n", report.name, report.task.lobes.size(),
                  report.run.fits.size(), duration_text(report.run.seconds));
  text += fmt::format("  {:<18} {:>6} {:>7} {:>7} {:>7} {:>9} {:>10} {:>9} {:>7} {:>8}\n", "start",
                      "fits", "not fin", "det<=0", ">1.05", "% good", "worst", "abandoned", "steps",
                      "ms");
  for (std::size_t start = 0; start < verdict.by_start.size(); ++start)
    text += row_text(stress_starts()[start].name, verdict.by_start[start]);
  text += row_text("own starts", verdict.own) + row_text("bad starts", verdict.bad);
  text += "  worst, loss over the least at the lobe:\n" + worst_text(report);
  if (!report.must_pass)
    return text + "  no bar: shown to compare\n";
  for (const std::string& bar : verdict.missed_bars)
    text += "  MISSED: " + bar + "\n";
  return text + (verdict.missed_bars.empty() ? "  all bars reached\n" : "");
}

// The pictures of success and of loss.
std::array<fs::path, 2> maps_of(const std::string& solver, const fs::path& folder) {
  return {folder / ("stress-" + solver + "-success.png"),
          folder / ("stress-" + solver + "-loss.png")};
}

void write_maps(const fs::path& folder, const std::vector<StressReport>& reports) {
  for (const StressReport& report : reports) {
    const auto [success, loss] = maps_of(report.name, folder);
    render(success_map(report)).write_png(success);
    render(ratio_map(report)).write_png(loss);
  }
}

void require_bars(const std::vector<StressReport>& reports) {
  std::string missed;
  for (const StressReport& report : reports)
    if (report.must_pass)
      for (const std::string& bar : report.verdict.missed_bars)
        missed += (missed.empty() ? "" : "; ") + report.name + ": " + bar;
  if (!missed.empty())
    throw CheckFailure(missed);
}

std::string report_text(const std::vector<StressReport>& reports) {
  const StressTask& task = reports.front().task;
  std::string text = fmt::format(
      "Losses are those of a judge in double precision, {} graded samples and {} directions, that\n"
      "shares nothing with the fits. A fit fails above 1.05 times {}\n"
      "its lobe; what is below the judge's noise counts as equal.\n",
      task.judge.samples, task.judge.directions,
      task.fit.lobe == LobeKind::folded
          ? "the loss of the LTC that the\ndefault fit, which does not fold, has at"
          : "the least loss that any start,\nor the default fit, reached at");
  for (const StressReport& report : reports)
    text += "\n" + report_text(report);
  return text;
}

void stress(const Arguments& arguments, Files& files) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const std::vector<Solver> solvers = solvers_of(arguments);
  if (!arguments.map.empty())
    for (const Solver& solver : solvers)
      for (const fs::path& file : maps_of(solver.name, files.make_folder(arguments.map)))
        files.write("--map", file);
  std::vector<StressReport> reports;
  for (const Solver& solver : solvers)
    reports.push_back(run_solver(arguments, solver, progress));
  if (!arguments.csv.empty())
    write_file(arguments.csv, stress_csv(reports));
  if (!arguments.map.empty())
    write_maps(arguments.map, reports);
  print_results(
      arguments.json, [&] { return report_text(reports); }, [&] { return stress_json(reports); });
  require_bars(reports);
}

void add_what_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to fit";
  add_config_options(app, arguments.config);
  std::vector<std::string> names;
  for (const SolverChoice& choice : choices)
    names.push_back(choice.name);
  allow_names(app.add_option("--solver", arguments.solver,
                             "only this one: gauss-newton, sgd or l3-nelder-mead [all, or the "
                             "config's]"),
              names)
      ->option_text("NAME")
      ->group(group);
  allow(app.add_option("--fits", arguments.fits,
                       "about so many fits with each solver [22,525; 1,360 with the slow ones]"),
        whole_number(1, 1 << 24))
      ->option_text("N")
      ->group(group);
  app.add_flag("--quick", arguments.quick, "a coarse grid: some seconds")->group(group);
  allow(app.add_option("--seed", arguments.seed, "seed of lobes and fits [fit.seed]"),
        seed_number())
      ->option_text("N")
      ->group(group);
}

void add_output_options(CLI::App& app, Arguments& arguments) {
  constexpr const char* group = "What to write";
  add_json_option(app, arguments.json)->group(group);
  add_output_option(app, "--csv", arguments.csv, "every fit as a line")->group(group);
  add_folder_option(app, "--map", arguments.map,
                    "folder for two pictures a solver: success, and loss, over the lobes")
      ->group(group);
}

}  // namespace

Action declare_stress(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_what_options(app, *arguments);
  add_threads_option(app, arguments->threads);
  add_output_options(app, *arguments);
  return [arguments](Files& files) { stress(*arguments, files); };
}

}  // namespace ltc::cli
