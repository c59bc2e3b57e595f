// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "core/error.h"
#include "core/spread.h"
#include "fit/fit_table.h"
#include "fit/solver.h"
#include "refine/field_albedo.h"
#include "refine/field_solve.h"
#include "refine/field_system.h"
#include "refine/field_terms.h"
#include "table/precision.h"
#include "table/reduction.h"

namespace ltc {
namespace {

// The pool has at least so many times the terms that are asked for, and of small fields more.
constexpr double least_pool = 1.3, largest_pool = 3;
constexpr std::size_t small_pool = 800;

// Lobes that are fitted one by one, and the degree of the field that starts from them.
constexpr std::size_t start_lobes = 800, start_degree = 4;

// Steps over the pool, and after terms were taken away but the last time, where that is done in two
// rounds: of a pool of so many times the terms.
constexpr int pool_steps = 2, between_steps = 1;
constexpr std::size_t large_pool = 2;
// The pool's coefficients are found by one in so many of the lobes, but by at least so many a term:
// a step costs next to nothing but its normal equations, and those of the pool are the largest.
// Which terms to keep all lobes decide: a third of them choose so that the loss is 1.6 % higher.
constexpr std::size_t pool_stride = 2, pool_lobes_a_term = 2;

// Levenberg's damping as a share of the curvature's diagonal, what it falls by after a step that
// was taken and rises by after one that was not, and where it starts once terms were taken away.
constexpr double first_damping = 0.02, damping_fall = 1.0 / 3, damping_rise = 6,
                 least_damping = 1e-4, later_damping = 0.01;
constexpr double overshoot = 1.4;
// Ends when a step gains less than this share of the loss, or so many in a row are not taken.
constexpr double tolerance = 1e-3;
constexpr int most_failures = 3;

// Where a loss is asked for, fields are tried that are smaller by this.
constexpr double size_fall = 0.85;
constexpr int smaller_steps = 3;

// Of the lobes that are fitted to: amplitude and Fresnel term have no noise, and need
// fewer, but these over the whole domain.
constexpr std::size_t albedo_degree = 8;
constexpr std::size_t most_albedo_lobes = 4000, albedo_edge_lobes = 2500;

// Of one material: lobes fitted to, a third of them near the horizon, and held out; steps.
constexpr std::size_t material_lobes = 1200, material_held_out = 400;
constexpr int material_steps = 6;
constexpr double albedo_share = 0.45;

constexpr double fitted_shift = 0, held_out_shift = 0.4321, start_shift = 0.2;

// A lobe of the whole domain from four numbers in [0, 1]: perceptual roughness, the square roots of
// lambda, of the angle left to the horizon and of that left to phi = pi/2.
Lobe edge_lobe(const std::array<double, 4>& u, double alpha_min, const LobeModel& model) {
  const double least = std::sqrt(alpha_min);
  const double roughness = least + (1 - least) * u[0], alpha = roughness * roughness;
  return {alpha, std::max(u[1] * u[1] * alpha, alpha_min),
          steepest_theta * (1 - (1 - u[2]) * (1 - u[2])), (1 - u[3] * u[3]) * std::numbers::pi / 2,
          &model};
}

// Uniform in those numbers: dense where lobes change fast.
std::vector<Lobe> edge_lobes(std::size_t count, double alpha_min, const LobeModel& model) {
  constexpr std::size_t first_point = 1'000'000;
  std::vector<Lobe> lobes;
  for (const std::array<double, 4>& u : lattice_points(first_point, count))
    lobes.push_back(edge_lobe(u, alpha_min, model));
  return lobes;
}

// A grid over the whole domain, its ends included: what a fit by random lobes never sees.
std::vector<Lobe> lobes_of_domain(double alpha_min, const LobeModel& model) {
  constexpr std::array<int, 4> cells = {6, 5, 6, 6};
  std::vector<Lobe> lobes;
  const auto at = [&](int i, std::size_t axis) { return static_cast<double>(i) / cells[axis]; };
  for (int i = 0; i <= cells[0]; ++i)
    for (int j = 0; j <= cells[1]; ++j)
      for (int k = 0; k <= cells[2]; ++k)
        for (int l = 0; l <= cells[3]; ++l)
          lobes.push_back(edge_lobe({at(i, 0), at(j, 1), at(k, 2), at(l, 3)}, alpha_min, model));
  return lobes;
}

WeightedLobes lobes_to_fit(double alpha_min, const LobeModel& model,
                           const std::vector<QueryRange>& asked, const FieldSettings& settings) {
  const auto count = static_cast<std::size_t>(settings.queries);
  const auto edges =
      static_cast<std::size_t>(settings.edge_share * static_cast<double>(settings.queries));
  WeightedLobes lobes;
  lobes.lobes = edge_lobes(edges, alpha_min, model);
  const std::vector<Lobe> more = lobes_in_turn(
      asked, count - edges, [&](const QueryRange& range, std::size_t part, std::size_t) {
        return lattice_queries(range, 0, part, alpha_min, model);
      });
  lobes.lobes.insert(lobes.lobes.end(), more.begin(), more.end());
  lobes.weights.assign(count, 1 / static_cast<double>(count));
  return lobes;
}

// Those that the pool's coefficients are found by, spread evenly over all.
std::size_t lobes_of_pool_count(std::size_t all, std::size_t pool) {
  return std::min(all, std::max(all / pool_stride, pool_lobes_a_term * pool));
}
WeightedLobes lobes_of_pool(const WeightedLobes& lobes, std::size_t pool) {
  const std::size_t all = lobes.lobes.size(), count = lobes_of_pool_count(all, pool);
  WeightedLobes some;
  for (std::size_t i = 0; i < count; ++i)
    some.lobes.push_back(lobes.lobes[i * all / count]);
  some.weights.assign(count, 1 / static_cast<double>(count));
  return some;
}

// The coefficients of a field of low degree near a part of the lobes, fitted one by one.
struct Start {
  std::vector<FieldTerm> terms;
  Eigen::VectorXd coefficients;
};
Start start_of(const WeightedLobes& lobes, double alpha_min, const QuerySampling& sampling,
               const RunContext& run) {
  const std::size_t count = std::min(start_lobes, lobes.lobes.size());
  WeightedLobes some;
  for (std::size_t i = 0; i < count; ++i)
    some.lobes.push_back(fold(lobes.lobes[i * lobes.lobes.size() / count]).lobe);
  some.weights.assign(count, 1 / static_cast<double>(count));
  FitSettings fit;
  fit.gauss_newton.samples = 1024;
  fit.gauss_newton.directions = 16;
  fit.gauss_newton.target_samples = 2048;
  fit.gauss_newton.steps = 6;
  const std::unique_ptr<Solver> solver = make_solver(fit);
  std::vector<Eigen::Matrix3d> fitted(count);
  spread_for_each<FitWorkspacePointer>(
      "fit", Spreading::moving, count, run, make_fit_workspace,
      [&](std::size_t i, FitWorkspacePointer& workspace) {
        FitRequest request;
        request.lobe = some.lobes[i];
        request.seed = entry_seed(fit.seed, i);
        request.progress = run.progress;
        fitted[i] = solver->fit(request, *workspace, nullptr).matrix;
      },
      [&](std::size_t i, auto&& take) { take(bytes_of(fitted[i])); });
  FieldSystem system(some, alpha_min, {}, sampling, start_shift);
  Start start{matrix_pool(start_degree), {}};
  system.set_terms(start.terms, run);
  start.coefficients = system.nearest_to(fitted, run);
  return start;
}

// A fold to begin with: without one, neither sign is better than the other.
constexpr double first_kappa = -0.8;
void bend(Start& start) {
  start.terms.push_back({FieldPart::kappa, 0, 1, 0, 0, 1});
  start.coefficients.conservativeResize(start.coefficients.size() + 1);
  start.coefficients[start.coefficients.size() - 1] = first_kappa;
}

// Terms and coefficients under way, with the model of the loss at them.
class Descent {
 public:
  Descent(const WeightedLobes& fitted, const WeightedLobes& held_out, double alpha_min,
          const Creases& creases, const FieldSettings& settings, const QuerySampling& sampling,
          const RunContext& run)
      : settings_(settings),
        run_(run),
        system_(fitted, alpha_min, creases, sampling, fitted_shift),
        judge_(held_out, alpha_min, creases, sampling, held_out_shift) {}

  std::size_t size() const { return terms_.size(); }
  int steps() const { return steps_; }

  void start(const Start& start, const std::vector<FieldTerm>& pool) {
    Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(pool.size()));
    for (std::size_t i = 0; i < start.terms.size(); ++i) {
      const auto at = std::lower_bound(pool.begin(), pool.end(), start.terms[i]);
      if (at != pool.end() && *at == start.terms[i])
        coefficients[at - pool.begin()] = start.coefficients[static_cast<Eigen::Index>(i)];
    }
    move_to(pool, coefficients);
  }

  // With its terms and coefficients, other lobes.
  void start(const Descent& from) {
    damping_ = from.damping_;
    steps_ = from.steps_;
    move_to(from.terms_, from.coefficients_);
  }

  // Up to `count` steps that are taken; false once one gains next to nothing.
  bool step(int count) {
    for (int taken = 0, failed = 0; taken < count;) {
      const Eigen::VectorXd trial = coefficients_ + overshoot * downhill();
      const double next = system_.evaluate(stored(trial), run_);
      ++steps_;
      if (!(next < objective_)) {
        damping_ *= damping_rise;
        if (++failed == most_failures)
          return false;
        continue;
      }
      const double gain = objective_ - next;
      accept(trial, next);
      ++taken;
      failed = 0;
      damping_ = std::max(damping_ * damping_fall, least_damping);
      if (gain < tolerance * objective_)
        return false;
    }
    return true;
  }

  // Takes away what buys least, and moves to where the model has its minimum over the others.
  void prune(std::size_t count) {
    if (count >= size())
      return;
    Eigen::MatrixXd curvature = damped(least_damping);
    const Eigen::VectorXd right = curvature * coefficients_ - equations().gradient;
    const std::vector<bool> keep = terms_to_keep(curvature, right, count);
    std::vector<FieldTerm> terms;
    std::vector<Eigen::Index> kept;
    for (std::size_t i = 0; i < keep.size(); ++i)
      if (keep[i]) {
        terms.push_back(terms_[i]);
        kept.push_back(static_cast<Eigen::Index>(i));
      }
    const Eigen::MatrixXd of_kept = curvature(kept, kept);
    move_to(terms, CholeskyFactor(of_kept).solve(right(kept)));
    damping_ = std::max(damping_, later_damping);
  }

  // The mean relative loss of the look-ups that are not fitted to.
  double held_out_loss() { return judge_.evaluate(stored(coefficients_), run_); }

  void store(Field& field) const {
    const Eigen::VectorXd rounded = stored(coefficients_);
    field.terms = terms_;
    field.coefficients.clear();
    for (const double value : rounded)
      field.coefficients.push_back(static_cast<float>(value));
  }

 private:
  // As the field will have them.
  Eigen::VectorXd stored(const Eigen::VectorXd& coefficients) const {
    const Precision precision = settings_.half ? Precision::half : Precision::single;
    return coefficients.unaryExpr(
        [=](double value) -> double { return rounded(static_cast<float>(value), precision); });
  }
  // Where a descent ends they are not asked for, and they are most of what a step costs.
  const FieldSystem::Equations& equations() {
    if (!equations_)
      equations_ = system_.equations(run_);
    return *equations_;
  }
  Eigen::MatrixXd damped(double damping) {
    Eigen::MatrixXd curvature = equations().curvature;
    const double mean = curvature.diagonal().mean();
    curvature.diagonal().array() += damping * (curvature.diagonal().array() + 1e-4 * mean);
    return curvature;
  }
  Eigen::VectorXd downhill() {
    run_.throw_if_stopped();
    return -CholeskyFactor(damped(damping_)).solve(equations().gradient);
  }
  void accept(const Eigen::VectorXd& coefficients, double objective) {
    coefficients_ = coefficients;
    objective_ = objective;
    system_.adopt();
    equations_.reset();
  }
  void move_to(const std::vector<FieldTerm>& terms, const Eigen::VectorXd& coefficients) {
    terms_ = terms;
    system_.set_terms(terms_, run_);
    judge_.set_terms(terms_, run_);
    accept(coefficients, system_.evaluate(stored(coefficients), run_));
  }

  const FieldSettings& settings_;
  const RunContext run_;
  FieldSystem system_, judge_;
  std::vector<FieldTerm> terms_;
  Eigen::VectorXd coefficients_;
  std::optional<FieldSystem::Equations> equations_;  // at the coefficients
  double objective_ = std::numeric_limits<double>::infinity();
  double damping_ = first_damping;
  int steps_ = 0;
};

std::size_t pool_size(std::size_t size) {
  const double wanted = static_cast<double>(size);
  return static_cast<std::size_t>(std::max(
      least_pool * wanted, std::min(largest_pool * wanted, static_cast<double>(small_pool))));
}

std::vector<Lobe> folded(const std::vector<Lobe>& from) {
  std::vector<Lobe> to;
  for (const Lobe& lobe : from)
    to.push_back(fold(lobe).lobe);
  return to;
}

// Steps until they gain no more, the best iterate kept.
double finish(Descent& descent, int most_steps, Field& field) {
  double best = descent.held_out_loss();
  descent.store(field);
  for (int i = 0; i < most_steps; ++i) {
    const bool more = descent.step(1);
    if (const double loss = descent.held_out_loss(); loss < best) {
      best = loss;
      descent.store(field);
    }
    if (!more)
      break;
  }
  return best;
}

// Views of one material, dense near the horizon.
WeightedLobes lobes_of_material(const Lobe& material, std::size_t count, std::size_t first) {
  WeightedLobes lobes;
  for (const std::array<double, 4>& u : lattice_points(first, count)) {
    Lobe lobe = material;
    const bool near_horizon = u[3] < 1.0 / 3;
    lobe.theta_radians =
        near_horizon ? steepest_theta * (1 - (1 - u[0]) * (1 - u[0])) : std::acos(1 - u[0]);
    lobe.phi_radians = u[1] * std::numbers::pi / 2;
    lobes.lobes.push_back(lobe);
  }
  lobes.weights.assign(count, 1 / static_cast<double>(count));
  return lobes;
}

// The terms that are left where roughnesses are numbers, with their coefficients; of amplitude and
// Fresnel term without.
struct Contracted {
  Start matrix;
  std::vector<FieldTerm> albedo;
};
Contracted contracted_terms(const Field& field, const Lobe& material) {
  const FieldBasis basis(FieldVariables(material, field.alpha_min));
  std::map<FieldTerm, double> sums;
  for (std::size_t i = 0; i < field.terms.size(); ++i) {
    const FieldTerm& term = field.terms[i];
    FieldTerm left = term;
    left.alpha = 0;
    const bool isotropic = is_of_albedo(term.part) && term.order == 0;
    left.lambda = term.lambda > 0 && !isotropic ? 1 : 0;
    // Both of the same view: what is left of the ratio is of the roughnesses. The factor of lambda
    // = 1 - lambda stays with the term, and may be zero.
    FieldTerm of_roughness = term, of_left = left;
    of_roughness.radius = of_roughness.angle = of_left.radius = of_left.angle = 0;
    of_roughness.part = of_left.part = FieldPart::a;
    of_roughness.order = of_left.order = 0;
    const double whole = basis.value(of_roughness), kept = basis.value(of_left);
    if (kept != 0)
      sums[left] += static_cast<double>(field.coefficients[i]) * whole / kept;
  }
  Contracted result;
  std::vector<double> coefficients;
  for (const auto& [term, sum] : sums) {
    if (is_of_albedo(term.part)) {
      result.albedo.push_back(term);
      continue;
    }
    result.matrix.terms.push_back(term);
    coefficients.push_back(sum);
  }
  result.matrix.coefficients = Eigen::Map<const Eigen::VectorXd>(
      coefficients.data(), static_cast<Eigen::Index>(coefficients.size()));
  return result;
}

// Ever smaller fields for as long as they are good enough.
double shrink(Descent& descent, double most_loss, double loss, Field& field) {
  while (descent.size() > 2) {
    descent.prune(static_cast<std::size_t>(size_fall * static_cast<double>(descent.size())));
    Field smaller = field;
    const double next = finish(descent, smaller_steps, smaller);
    if (!(next <= most_loss))
      break;
    field = smaller;
    loss = next;
  }
  return loss;
}

}  // namespace

Field fit_field(double alpha_min, const LobeModel& model, const std::vector<QueryRange>& asked,
                const FieldSettings& settings, const RefineSettings& judging, const RunContext& run,
                FieldReport* report) {
  FieldReport unread;
  FieldReport& result = report ? *report : unread;
  const WeightedLobes lobes = lobes_to_fit(alpha_min, model, asked, settings);
  const WeightedLobes held_out =
      queries_held_out(alpha_min, model, asked, judging, lobes.lobes.size());
  const auto size = static_cast<std::size_t>(settings.size);
  const Creases& creases = settings.creases;
  const std::vector<FieldTerm> pool =
      matrix_pool_of_size(pool_size(size), !settings.creases.empty());
  result.queries = lobes.lobes.size();
  result.pool = pool.size();
  Field field{alpha_min, &model, {}, creases, {}, {}};
  Start start = start_of(lobes, alpha_min, judging.sampling, run);
  if (!settings.creases.empty())
    bend(start);
  {
    const std::size_t evaluations = static_cast<std::size_t>(settings.steps) + pool_steps + 4;
    const Stage stage(run, "field",
                      evaluations * lobes.lobes.size() +
                          static_cast<std::size_t>(settings.steps) * held_out.lobes.size());
    Descent descent(lobes, held_out, alpha_min, creases, settings, judging.sampling, run);
    {
      Descent of_pool(lobes_of_pool(lobes, pool.size()), {}, alpha_min, creases, settings,
                      judging.sampling, run);
      of_pool.start(start, pool);
      of_pool.step(pool_steps);
      descent.start(of_pool);
    }
    if (descent.size() > large_pool * size) {
      descent.prune(static_cast<std::size_t>(
          std::sqrt(static_cast<double>(size) * static_cast<double>(descent.size()))));
      descent.step(between_steps);
    }
    descent.prune(size);
    result.loss = finish(descent, settings.steps, field);
    if (settings.loss > 0) {
      if (!(result.loss <= settings.loss))
        throw CheckFailure(fmt::format(
            "a field of {} numbers has a mean relative loss of {:.4f} on look-ups held out, above "
            "field.loss = {}; nothing was written; a larger field.size may do",
            descent.size(), result.loss, settings.loss));
      result.loss = shrink(descent, settings.loss, result.loss, field);
    }
    result.steps = descent.steps();
  }
  std::vector<Lobe> of_albedo = lobes_of_domain(alpha_min, model);
  const std::vector<Lobe> edges = edge_lobes(albedo_edge_lobes, alpha_min, model);
  of_albedo.insert(of_albedo.end(), edges.begin(), edges.end());
  const std::size_t every = 1 + lobes.lobes.size() / most_albedo_lobes;
  for (std::size_t i = 0; i < lobes.lobes.size(); i += every)
    of_albedo.push_back(lobes.lobes[i]);
  fit_albedo(folded(of_albedo), albedo_pool(albedo_degree),
             static_cast<std::size_t>(settings.albedo_size), settings.half, run, field);
  note_albedo_errors(folded(held_out.lobes), field, run, result);
  return field;
}

Field contracted_field(const Field& field, double alpha_x, double alpha_y, std::size_t size,
                       const RunContext& run, FieldReport* report) {
  FieldReport unread;
  FieldReport& result = report ? *report : unread;
  const Lobe material{alpha_x, alpha_y, 0, 0, field.model};
  const WeightedLobes lobes = lobes_of_material(material, material_lobes, 0);
  const WeightedLobes held_out = lobes_of_material(material, material_held_out, material_lobes);
  const auto of_albedo =
      static_cast<std::size_t>(std::lround(albedo_share * static_cast<double>(size)));
  const Contracted contracted = contracted_terms(field, material);
  FieldSettings settings;
  Descent descent(lobes, held_out, field.alpha_min, field.creases, settings, QuerySampling{}, run);
  descent.start(contracted.matrix, contracted.matrix.terms);
  result.whole_loss = descent.held_out_loss();
  descent.prune(size - of_albedo);
  Field small{field.alpha_min, field.model, {}, field.creases, {}, {}};
  result.loss = finish(descent, material_steps, small);
  result.steps = descent.steps();
  result.queries = lobes.lobes.size();
  result.pool = contracted.matrix.terms.size();
  fit_albedo(folded(lobes.lobes), contracted.albedo, of_albedo, settings.half, run, small);
  note_albedo_errors(folded(held_out.lobes), small, run, result);
  small.material = {alpha_x, alpha_y};
  return small;
}

std::size_t field_fit_memory_bytes(const FieldSettings& settings, const QuerySampling& sampling) {
  const auto queries = static_cast<std::size_t>(settings.queries);
  const std::size_t pool =
      matrix_pool_of_size(pool_size(static_cast<std::size_t>(settings.size))).size();
  return FieldSystem::memory_bytes(sampling, queries, pool) +
         FieldSystem::memory_bytes(sampling, lobes_of_pool_count(queries, pool), pool) +
         queries * static_cast<std::size_t>(2 * settings.albedo_size) * sizeof(double);
}

}  // namespace ltc
