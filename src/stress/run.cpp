// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/run.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/parallel.h"
#include "core/stopwatch.h"
#include "fit/fit_table.h"
#include "stress/graded_judge.h"

namespace ltc {
namespace {

// What a thread keeps.
struct Worker {
  FitWorkspacePointer workspace = make_fit_workspace();
  GradedJudge judge;

  explicit Worker(const CompareSettings& settings)
      : judge(settings.samples, settings.directions, settings.seed) {}
};

class Runner {
 public:
  Runner(const StressTask& task, const RunContext& context)
      : task_(task),
        progress_(context.progress),
        solver_(make_solver(task.fit)),
        reference_(make_solver(task.reference)),
        creases_(task.fit.creases()) {}

  // All fits of a lobe; fills the lobe's place of `run`.
  void fit(std::size_t index, Worker& worker, StressRun& run) const {
    const Lobe lobe = task_.lobes[index].lobe();
    worker.judge.set_lobe(lobe);
    run.spread[index] = worker.judge.spread();
    std::vector<StressFit> fits;
    for (std::size_t start = 0; start < stress_starts().size(); ++start) {
      fits.push_back(fit_from(start, lobe, worker));
      fits.back().lobe = index;
      judge_last(fits, worker.judge);
    }
    const FitResult reference =
        reference_->fit(request(lobe, task_.reference), *worker.workspace, nullptr);
    run.best_loss[index] = set_ratios(fits, worker.judge.loss(reference.matrix),
                                      worker.judge.noise(), task_.fit.lobe == LobeKind::folded);
    std::copy(fits.begin(), fits.end(),
              run.fits.begin() + static_cast<std::ptrdiff_t>(index * fits.size()));
  }

 private:
  FitRequest request(const Lobe& lobe, const FitSettings& settings) const {
    FitRequest request;
    request.lobe = lobe;
    request.seed = stress_seed(settings);
    request.progress = progress_;
    return request;
  }

  StressFit fit_from(std::size_t start, const Lobe& lobe, Worker& worker) const {
    FitRequest asked = request(lobe, task_.fit);
    const StressStart kind = stress_starts()[start].start;
    if (const auto matrix = start_matrix(kind, lobe, asked.seed))
      asked.starts.push_back(*matrix);
    const Clock::time_point begin = Clock::now();
    const FitResult result = solver_->fit(asked, *worker.workspace, nullptr);
    StressFit fit;
    fit.start = start;
    fit.seconds = seconds_since(begin);
    fit.matrix = result.matrix;
    fit.steps = result.steps;
    fit.outcome = result.outcome;
    fit.start_abandoned = result.start_abandoned;
    fit.fold = result.fold;
    fit.one_to_one = is_one_to_one(result.fold, creases_);
    return fit;
  }

  // Of the last one: fits that came to the same matrix are judged once.
  void judge_last(std::vector<StressFit>& fits, GradedJudge& judge) const {
    StressFit& last = fits.back();
    for (std::size_t i = 0; i + 1 < fits.size(); ++i)
      if (fits[i].matrix == last.matrix && fits[i].fold == last.fold) {
        last.loss = fits[i].loss;
        return;
      }
    last.loss = judge.loss(last.matrix, last.fold, creases_);
  }

  const StressTask& task_;
  const Progress* progress_;
  std::unique_ptr<Solver> solver_, reference_;
  Creases creases_;
};

}  // namespace

bool StressFit::finite() const {
  return outcome != FitOutcome::non_finite && matrix.allFinite() && std::isfinite(loss);
}

bool StressFit::determinant_positive() const {
  return matrix.determinant() > 0 && one_to_one;
}

std::uint64_t stress_seed(const FitSettings& fit) {
  return entry_seed(fit.seed, 0);
}

double set_ratios(std::vector<StressFit>& fits, double reference_loss, double noise,
                  bool reference_alone) {
  double best = reference_loss;
  for (const StressFit& fit : fits)
    if (!reference_alone && fit.finite() && fit.determinant_positive())
      best = std::fmin(best, fit.loss);  // takes the number of a number and a NaN
  for (StressFit& fit : fits)
    fit.ratio = fit.finite() ? std::max(fit.loss, noise) / std::max(best, noise)
                             : std::numeric_limits<double>::quiet_NaN();
  return best;
}

StressRun run_stress(const StressTask& task, const RunContext& context) {
  const Clock::time_point begin = Clock::now();
  const Runner runner(task, context);
  StressRun run;
  run.fits.resize(task.lobes.size() * stress_starts().size());
  run.best_loss.resize(task.lobes.size());
  run.spread.resize(task.lobes.size());
  parallel_for_each<Worker>(
      "stress", task.lobes.size(), context, [&] { return Worker(task.judge); },
      [&](std::size_t i, Worker& worker) { runner.fit(i, worker, run); });
  run.seconds = seconds_since(begin);
  return run;
}

}  // namespace ltc
