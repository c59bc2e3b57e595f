// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/fit_report.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "brdf/lobe_model.h"
#include "cli/json_text.h"
#include "cli/lobe_words.h"
#include "judge/matrix_invariants.h"
#include "report/lobe_picture.h"
#include "table/entry_text.h"

namespace ltc::cli {
namespace {

using Json = nlohmann::ordered_json;

// A step with the name of the phase that it belongs to and its number there, from 1.
struct NamedStep {
  std::string phase;
  std::size_t number;
  FitStep step;
};

// In the order of starting_points.h, as Gauss-Newton tries them.
std::string own_start_name(int start) {
  constexpr std::array<const char*, 3> names = {"moments", "first-order", "identity"};
  return start < 3 ? names[static_cast<std::size_t>(start)] : fmt::format("random {}", start - 2);
}

// --start as the name of a phase.
std::string given_start_name(const std::string& start) {
  if (start.starts_with("from="))
    return "from table";
  return start.starts_with("matrix=") ? "given matrix" : start;
}

std::string phase_name(const FitReport& report, const WatchedFit& fit, const FitStep& step) {
  if (report.settings.solver == SolverKind::sgd)
    return "descent";
  if (report.settings.solver == SolverKind::l3_nelder_mead)
    return "simplex";
  if (step.phase.kind == FitPhase::Kind::fine_fold)
    return fmt::format("fine fold {}", step.phase.index + 1);
  if (step.phase.kind == FitPhase::Kind::fold)
    return fmt::format("coarse fold {}", step.phase.index + 1);
  const std::string sweep = fit.sweep > 0 ? fmt::format("sweep {} ", fit.sweep) : "";
  if (step.phase.kind == FitPhase::Kind::fine)
    return sweep + fmt::format("fine {}", step.phase.index + 1);
  if (fit.sweep > 0)
    return sweep + "coarse";
  if (step.phase.kind == FitPhase::Kind::own_start)
    return "coarse " + own_start_name(step.phase.index);
  return "coarse " + given_start_name(report.start);
}

std::vector<NamedStep> named_steps(const FitReport& report) {
  std::vector<NamedStep> steps;
  for (const WatchedFit& fit : report.fit.fits)
    for (const FitStep& step : fit.steps) {
      const std::string phase = phase_name(report, fit, step);
      const bool same = !steps.empty() && steps.back().phase == phase;
      steps.push_back({phase, same ? steps.back().number + 1 : 1, step});
    }
  return steps;
}

std::string status_text(const FitReport& report) {
  std::string text(name_of(report.fit.fitted.status));
  if (report.representative)
    text += fmt::format(" by symmetry from {}, whose fit this is",
                        entry_text(report.grid, *report.representative));
  else if (report.fit.fitted.status == Status::analytic)
    text += ": the closed form is exact to more digits than samples could tell";
  return text;
}

std::string start_text(const FitReport& report) {
  if (!report.start.empty())
    return report.start +
           (report.fit.start_abandoned ? ": abandoned, the solver's own led further" : "");
  if (report.settings.solver == SolverKind::sgd)
    return std::string(name_of(report.settings.sgd.start));
  if (report.settings.solver == SolverKind::l3_nelder_mead)
    return std::string(name_of(report.settings.l3.start));
  std::string text;
  for (int start = 0; start < report.settings.gauss_newton.starts; ++start)
    text += (text.empty() ? "" : ", ") + own_start_name(start);
  for (const WatchedFit& fit : report.fit.fits)
    if (fit.sweep > 0)
      text += fmt::format("; sweep {}: {} neighbours, {}", fit.sweep, fit.neighbours,
                          fit.improved ? "one was better" : "none was better");
  return text;
}

// At most so many steps are printed; the trace has them all.
constexpr std::size_t most_printed = 60;

std::string steps_text(const FitReport& report) {
  const std::vector<NamedStep> steps = named_steps(report);
  if (steps.empty())
    return "steps    none\n";
  std::string text = fmt::format(
      "steps    {:<18} {:>6} {:>12} {:>12} {:>10} {:>10}\n", "phase", "step", "loss", "gradient",
      report.settings.solver == SolverKind::sgd ? "step size" : "damping", "time/ms");
  const std::size_t every = (steps.size() + most_printed - 1) / most_printed;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto& [phase, number, step] = steps[i];
    if (i % every == 0 || i + 1 == steps.size())
      text += fmt::format("         {:<18} {:>6} {:>12.5e} {:>12.4e} {:>10.2e} {:>10.3f}{}\n",
                          phase, number, step.loss, step.gradient_norm, step.damping,
                          1e3 * step.seconds, step.accepted ? "" : "  not taken");
  }
  if (every > 1)
    text += fmt::format("         one of {} steps; --trace writes all {}\n", every, steps.size());
  return text;
}

Json json_of(const FitReport& report, const std::vector<NamedStep>& steps) {
  Json all = Json::array();
  for (const auto& [phase, number, step] : steps)
    all.push_back(
        {{"phase", phase},
         {"step", number},
         {"loss", step.loss},
         {"gradient_norm", step.gradient_norm},
         {report.settings.solver == SolverKind::sgd ? "step_size" : "damping", step.damping},
         {"seconds", step.seconds},
         {"accepted", step.accepted}});
  return all;
}

Json losses_json(double fit, double held_out, double spread) {
  return {
      {"fit", fit}, {"held_out", held_out}, {"spread", spread}, {"relative", held_out / spread}};
}

// The fold, and the LTC that is fitted beside it.
std::string fold_text(const LobeFit& fit) {
  return fmt::format("fold     k {:.6f}, g {:.6f}; kappa {:.4f}, gamma {:.4f}; creases {}\n",
                     fit.fitted.fold.k, fit.fitted.fold.g, fit.kappa, fit.fitted.fold.g,
                     fmt::join(fit.creases, ", ")) +
         fmt::format("single   {:.4e} in {} steps; {}\n", fit.ltc->loss, fit.ltc->steps,
                     loss_words(fit.ltc_held_out_loss, fit.spread));
}

Json fold_json(const LobeFit& fit) {
  return {{"k", fit.fitted.fold.k},
          {"g", fit.fitted.fold.g},
          {"kappa", fit.kappa},
          {"gamma", fit.fitted.fold.g},
          {"creases", fit.creases},
          {"single",
           {{"matrix", matrix_json(fit.ltc->matrix)},
            {"iterations", fit.ltc->steps},
            {"loss", losses_json(fit.ltc->loss, fit.ltc_held_out_loss, fit.spread)}}}};
}

}  // namespace

std::string report_text(const FitReport& report) {
  const LobeFit& fit = report.fit;
  std::string text = fmt::format("lobe     {} (degrees)\n", lobe_line(fit.lobe));
  if (report.entry)
    text += fmt::format("entry    {}: {}\n", entry_text(report.grid, *report.entry),
                        lobe_text(report.grid, *report.entry));
  if (report.entry && report.refined)
    text +=
        "refined  not here: this is the entry before refine.steps; --as-in TABLE shows a table's\n";
  text +=
      fmt::format("solver   {}, seed {}\n", name_of(report.settings.solver), report.settings.seed);
  text += fmt::format("status   {}\n", status_text(report));
  text += fmt::format("start    {}\n", start_text(report));
  text += steps_text(report);
  text += matrix_text("fitted", fit.fitted.matrix);
  text += matrix_text("aligned", fit.aligned);
  text += matrix_text("final", fit.matrix);
  if (report.storage != Storage::matrix)
    text += matrix_text("stored", fit.finished.stored);
  text += fmt::format("symmetry largest value zeroed {:.1e}\n", fit.finished.zeroed);
  text += fmt::format("loss     {:.4e} in {} steps; {}\n", fit.fitted.loss, fit.fitted.steps,
                      loss_words(fit.held_out_loss, fit.spread));
  if (fit.ltc)
    text += fold_text(fit);
  text += fmt::format("albedo   amplitude {:.6f}, Fresnel {:.6f}\n", fit.albedo.amplitude,
                      fit.albedo.fresnel);
  if (report.gradient)
    text += fmt::format("check    {}\n", report.gradient->describe());
  return text;
}

std::string report_json(const FitReport& report) {
  const LobeFit& fit = report.fit;
  Json json;
  json["lobe"] = lobe_json(fit.lobe);
  if (report.entry)
    json["entry"] = entry_text(report.grid, *report.entry);
  if (report.representative)
    json["copied_from"] = entry_text(report.grid, *report.representative);
  json["solver"] = name_of(report.settings.solver);
  json["seed"] = report.settings.seed;
  json["start"] = start_text(report);
  json["status"] = name_of(fit.fitted.status);
  json["steps"] = json_of(report, named_steps(report));
  json["iterations"] = fit.fitted.steps;
  json["matrix"] = {{"fitted", matrix_json(fit.fitted.matrix)},
                    {"aligned", matrix_json(fit.aligned)},
                    {"final", matrix_json(fit.matrix)},
                    {"stored", matrix_json(fit.finished.stored)}};
  json["storage"] = name_of(report.storage);
  json["determinant"] = fit.matrix.determinant();
  json["condition_number"] = condition_number(fit.matrix);
  json["largest_zeroed"] = fit.finished.zeroed;
  json["loss"] = losses_json(fit.fitted.loss, fit.held_out_loss, fit.spread);
  if (fit.ltc)
    json["fold"] = fold_json(fit);
  json["amplitude"] = fit.albedo.amplitude;
  json["fresnel"] = fit.albedo.fresnel;
  if (report.gradient)
    json["gradient_check"] = {{"passed", report.gradient->passed},
                              {"largest_relative_error", report.gradient->largest_relative_error},
                              {"undecided", report.gradient->undecided_count()}};
  return json_text(json);
}

std::string trace_csv(const FitReport& report) {
  std::string text = "phase,step,loss,gradient_norm,damping,seconds,accepted\n";
  for (const auto& [phase, number, step] : named_steps(report))
    text += fmt::format("{},{},{},{},{},{},{}\n", phase, number, step.loss, step.gradient_norm,
                        step.damping, step.seconds, step.accepted ? 1 : 0);
  return text;
}

picture::Words picture_words(const FitReport& report) {
  const LobeFit& fit = report.fit;
  picture::Words words;
  words.title =
      report.entry ? "Entry " + entry_text(report.grid, *report.entry)
                   : std::string(fit.lobe.model->label()) +
                         (fit.ltc ? " lobe, its LTC, and one that is folded" : " lobe and its LTC");
  words.subtitle = lobe_caption(fit.lobe);
  const std::size_t steps = named_steps(report).size();
  words.lines_below = {
      fmt::format("Loss {}; {:.4e} on the fit's own samples{}",
                  loss_words(fit.held_out_loss, fit.spread), fit.fitted.loss,
                  steps == 0 ? "; no steps were needed" : ""),
      fmt::format("{}, {}; determinant {:.3e}, condition number {:.3e}; amplitude {:.4f}, Fresnel "
                  "{:.4f}",
                  name_of(fit.fitted.status), name_of(report.settings.solver),
                  fit.matrix.determinant(), condition_number(fit.matrix), fit.albedo.amplitude,
                  fit.albedo.fresnel)};
  if (fit.ltc)
    words.lines_below.insert(
        words.lines_below.begin() + 1,
        fmt::format("Fold k {:.4f}, g {:.4f}, creases {}; without, loss {}", fit.fitted.fold.k,
                    fit.fitted.fold.g, fmt::join(fit.creases, ", "),
                    loss_words(fit.ltc_held_out_loss, fit.spread)));
  return words;
}

std::vector<NamedLobe> pictured_lobes(const FitReport& report) {
  const LobeFit& fit = report.fit;
  if (!fit.ltc)
    return {{"LTC", {fit.matrix}}};
  return {{"LTC", {fit.ltc->matrix}}, {"folded LTC", {fit.matrix, fit.fitted.fold, fit.creases}}};
}

picture::Chart loss_chart(const FitReport& report) {
  picture::Chart chart;
  chart.words.title = "Loss against steps";
  chart.words.subtitle = "Each phase on its own samples";
  chart.x = {"step"};
  chart.y = {
      report.settings.solver == SolverKind::l3_nelder_mead ? "L3 error" : "sliced-Wasserstein loss",
      picture::ScaleKind::logarithmic};
  chart.font_size = 20;
  const std::vector<NamedStep> steps = named_steps(report);
  constexpr std::size_t most_markers = 100;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i == 0 || steps[i].phase != steps[i - 1].phase)
      chart.series.push_back(
          {steps[i].phase,
           {},
           picture::series_color(chart.series.size()),
           steps.size() > most_markers ? picture::Marker::none : picture::Marker::disc,
           2});
    chart.series.back().points.push_back({static_cast<double>(i + 1), steps[i].step.loss});
  }
  // The simplex's error is another measure.
  if (!steps.empty() && std::isfinite(report.fit.held_out_loss) &&
      report.settings.solver != SolverKind::l3_nelder_mead) {
    const double loss = report.fit.held_out_loss;
    chart.series.push_back(
        {"result, held out",
         {{1, loss}, {static_cast<double>(std::max<std::size_t>(2, steps.size())), loss}},
         picture::ink,
         picture::Marker::none,
         2,
         {8, 6}});
  }
  return chart;
}

}  // namespace ltc::cli
