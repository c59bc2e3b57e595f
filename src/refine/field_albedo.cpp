// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_albedo.h"

#include <algorithm>
#include <cmath>

#include "brdf/albedo.h"
#include "core/parallel.h"
#include "core/spread.h"
#include "refine/field_solve.h"
#include "refine/field_terms.h"
#include "table/precision.h"

namespace ltc {
namespace {

// The view's cosine is much smoother than the amplitude: its share of the numbers.
constexpr double cosine_share = 0.22;
// Of so few numbers, half of them: the amplitude of one material is a simple function too.
constexpr std::size_t few_numbers = 100;
constexpr double cosine_share_of_few = 0.5;
// What terms that hardly differ on the lobes are held by.
constexpr double damping = 1e-9;
// How often lobes are weighed anew by their errors: from the least mean square towards a small
// largest error. An error of so many times the mean counts twice.
constexpr int rounds = 4;
constexpr double outlier = 4;

// A function to be met: values wanted, and what an error of each counts.
struct Wanted {
  Eigen::VectorXd value, weight;
};

// A column a lobe.
Eigen::MatrixXd values_of(const std::vector<FieldVariables>& at,
                          const std::vector<FieldTerm>& terms, const RunContext& run) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(terms.size()),
                         static_cast<Eigen::Index>(at.size()));
  parallel_for(at.size(), run, [&](std::size_t q) {
    const FieldBasis basis(at[q]);
    for (std::size_t i = 0; i < terms.size(); ++i)
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(q)) = basis.value(terms[i]);
  });
  return values;
}

struct Equations {
  Eigen::MatrixXd curvature;
  Eigen::VectorXd right;
};
Equations equations_of(const Eigen::MatrixXd& values, const Wanted& wanted) {
  const Eigen::MatrixXd weighted = values * wanted.weight.cwiseSqrt().asDiagonal();
  Equations result{squared(weighted), values * wanted.weight.cwiseProduct(wanted.value)};
  result.curvature.diagonal().array() +=
      damping * (result.curvature.diagonal().array() + result.curvature.diagonal().mean());
  return result;
}

// Least squares whose weights rise with the error, and the terms of the pool that they need.
void fit_part(const std::vector<FieldVariables>& at, const std::vector<FieldTerm>& pool,
              const Wanted& wanted, std::size_t count, bool half, const RunContext& run,
              Field& field) {
  Equations equations = equations_of(values_of(at, pool, run), wanted);
  run.throw_if_stopped();
  const std::vector<bool> kept = terms_to_keep(equations.curvature, equations.right, count);
  std::vector<FieldTerm> terms;
  for (std::size_t i = 0; i < pool.size(); ++i)
    if (kept[i])
      terms.push_back(pool[i]);
  const Eigen::MatrixXd values = values_of(at, terms, run);
  Wanted weighed = wanted;
  Eigen::VectorXd coefficients;
  for (int round = 0; round < rounds; ++round) {
    run.throw_if_stopped();
    equations = equations_of(values, weighed);
    coefficients = CholeskyFactor(equations.curvature).solve(equations.right);
    const Eigen::ArrayXd error = (values.transpose() * coefficients - wanted.value).array().abs() *
                                 wanted.weight.array().sqrt();
    weighed.weight.array() *= 1 + (error / (outlier * error.mean())).square().min(3.0);
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto value = static_cast<float>(coefficients[static_cast<Eigen::Index>(i)]);
    field.terms.push_back(terms[i]);
    field.coefficients.push_back(half ? rounded(value, Precision::half) : value);
  }
}

std::vector<Albedo> integrate(const std::vector<Lobe>& lobes, double alpha_min,
                              const RunContext& run) {
  const AlbedoRule rule;
  std::vector<Albedo> albedos(lobes.size());
  spread_for_each<int>(
      "albedo", Spreading::moving, lobes.size(), run, [] { return 0; },
      [&](std::size_t i, int) {
        albedos[i] = integrate_albedo(FieldVariables(lobes[i], alpha_min).lobe, rule);
      },
      [&](std::size_t i, auto&& take) { take(bytes_of(albedos[i])); });
  return albedos;
}

}  // namespace

void fit_albedo(const std::vector<Lobe>& lobes, const std::vector<FieldTerm>& pool,
                std::size_t count, bool half, const RunContext& run, Field& field) {
  std::vector<FieldVariables> at;
  for (const Lobe& lobe : lobes)
    at.emplace_back(lobe, field.alpha_min);
  const std::vector<Albedo> albedos = integrate(lobes, field.alpha_min, run);
  const auto size = static_cast<Eigen::Index>(lobes.size());
  Wanted amplitude{Eigen::VectorXd(size), Eigen::VectorXd::Ones(size)};
  Wanted cosine{Eigen::VectorXd(size), Eigen::VectorXd(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const Albedo& albedo = albedos[static_cast<std::size_t>(i)];
    amplitude.value[i] = albedo.amplitude;
    // fresnel = e (1 - x)^5; an error of x counts with its slope.
    const double root = std::pow(std::max(albedo.fresnel / albedo.amplitude, 0.0), 0.2);
    cosine.value[i] = 1 - root;
    cosine.weight[i] = std::pow(5 * albedo.amplitude * std::pow(root, 4), 2);
  }
  std::vector<FieldTerm> amplitude_pool, cosine_pool;
  for (const FieldTerm& term : pool)
    (term.part == FieldPart::amplitude ? amplitude_pool : cosine_pool).push_back(term);
  const auto of_cosine = std::max<std::size_t>(
      1, static_cast<std::size_t>((count < few_numbers ? cosine_share_of_few : cosine_share) *
                                  static_cast<double>(count)));
  // One a thread, of which each part is the whole work.
  Field parts[2];
  const RunContext alone{1, run.progress};
  parallel_for<int>(
      2, run, [] { return 0; },
      [&](std::size_t i, int) {
        if (i == 0)
          fit_part(at, amplitude_pool, amplitude, count - of_cosine, half, alone, parts[0]);
        else
          fit_part(at, cosine_pool, cosine, of_cosine, half, alone, parts[1]);
      });
  for (const Field& part : parts) {
    // Before those of a fold, which come last.
    const auto place =
        std::ranges::find_if(field.terms,
                             [](const FieldTerm& term) { return is_of_fold(term.part); }) -
        field.terms.begin();
    field.terms.insert(field.terms.begin() + place, part.terms.begin(), part.terms.end());
    field.coefficients.insert(field.coefficients.begin() + place, part.coefficients.begin(),
                              part.coefficients.end());
  }
}

void note_albedo_errors(const std::vector<Lobe>& lobes, const Field& field, const RunContext& run,
                        FieldReport& report) {
  const std::vector<Albedo> albedos = integrate(lobes, field.alpha_min, run);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const FieldLobe found = lobe_of(field, lobes[i]);
    const double amplitude = std::abs(found.amplitude - albedos[i].amplitude);
    const double fresnel = std::abs(found.fresnel - albedos[i].fresnel);
    report.amplitude_error += amplitude / static_cast<double>(lobes.size());
    report.fresnel_error += fresnel / static_cast<double>(lobes.size());
    report.amplitude_error_most = std::max(report.amplitude_error_most, amplitude);
    report.fresnel_error_most = std::max(report.fresnel_error_most, fresnel);
  }
}

}  // namespace ltc
