// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/query_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/parallel.h"
#include "table/query_range.h"

namespace ltc {
namespace {

bool is_range(const QueryRange& range) {
  return range.roughness_first <= range.roughness_last && range.lambda_first <= range.lambda_last &&
         range.cos_theta_first <= range.cos_theta_last && range.phi_first <= range.phi_last;
}

QueryComparison compare_query(const Table& a, const Table& b, const Lobe& lobe, std::size_t query,
                              const QualitySettings& settings, AreaLightJudge& area_light) {
  const Answer from_a = ask(a, lobe), from_b = ask(b, lobe);
  QueryComparison result;
  result.lobe = lobe;
  result.state_a = from_a.state;
  result.state_b = from_b.state;
  if (!result.judged()) {
    result.lobes = {not_compared, not_compared, not_compared};
    return result;
  }
  HeldOutJudge judge = query_judge(settings, query);
  result.lobes = compare_lobes(lobe, from_a.found.ltc(), from_b.found.ltc(), judge);
  result.lobes.amplitude_difference = std::abs(from_a.found.amplitude - from_b.found.amplitude);
  result.lobes.fresnel_difference = std::abs(from_a.found.fresnel - from_b.found.fresnel);
  area_light.set_lobe(lobe, query);
  const auto error = [&](const LookUp& found, std::optional<double> amplitude) {
    return area_light.error(found.ltc(), amplitude).mean_absolute;
  };
  result.area_light_a = error(from_a.found, std::nullopt);
  result.area_light_b = error(from_b.found, std::nullopt);
  result.with_amplitude_a = error(from_a.found, from_a.found.amplitude);
  result.with_amplitude_b = error(from_b.found, from_b.found.amplitude);
  return result;
}

}  // namespace

std::optional<QueryRange> common_range(const Grid& a, const Grid& b) {
  const QueryRange of_a = query_range_of(a, {}), of_b = query_range_of(b, {});
  const QueryRange common{std::max(of_a.roughness_first, of_b.roughness_first),
                          std::min(of_a.roughness_last, of_b.roughness_last),
                          std::max(of_a.lambda_first, of_b.lambda_first),
                          std::min(of_a.lambda_last, of_b.lambda_last),
                          std::max(of_a.cos_theta_first, of_b.cos_theta_first),
                          std::min(of_a.cos_theta_last, of_b.cos_theta_last),
                          std::max(of_a.phi_first, of_b.phi_first),
                          std::min(of_a.phi_last, of_b.phi_last)};
  return is_range(common) ? std::optional(common) : std::nullopt;
}

std::vector<QueryComparison> compare_queries(const Table& a, const Table& b,
                                             const QualitySettings& settings,
                                             const RunContext& run) {
  if (a.grid.model != b.grid.model)
    throw InputError(fmt::format("the tables are of different BRDFs: \"{}\" and \"{}\"",
                                 a.grid.model->name(), b.grid.model->name()));
  const std::vector<Lobe> lobes =
      random_queries(settings.range, settings.queries, settings.seed,
                     std::max(a.grid.alpha_min, b.grid.alpha_min), *a.grid.model);
  std::vector<QueryComparison> queries(lobes.size());
  const AreaLightJudge prototype = area_light_judge(settings);
  parallel_for_each<AreaLightJudge>(
      "compare between nodes", queries.size(), run, [&] { return prototype; },
      [&](std::size_t i, AreaLightJudge& area_light) {
        queries[i] = compare_query(a, b, lobes[i], i, settings, area_light);
      });
  return queries;
}

int Verdict::sign() const {
  // Equal tables differ by exactly nothing; one pair alone has no standard error.
  if (difference.count == 0 || difference.mean == 0)
    return 0;
  if (std::abs(difference.mean) <= 2 * difference.standard_error)
    return 0;
  return difference.mean < 0 ? -1 : 1;
}

Verdict verdict_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences(a.size());
  std::vector<bool> both(a.size());
  Verdict verdict;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both[i] = !std::isnan(a[i]) && !std::isnan(b[i]);
    differences[i] = a[i] - b[i];
    verdict.a_nearer += both[i] && a[i] < b[i];
    verdict.b_nearer += both[i] && b[i] < a[i];
  }
  verdict.a = statistics_of(a, both);
  verdict.b = statistics_of(b, both);
  verdict.difference = statistics_of(differences);
  return verdict;
}

QuerySummary summarize_queries(const std::vector<QueryComparison>& queries) {
  QuerySummary summary;
  for (const QueryComparison& query : queries) {
    summary.judged += query.judged();
    summary.missing_a += query.state_a == QueryState::missing;
    summary.missing_b += query.state_b == QueryState::missing;
    summary.singular_a += query.judged() && std::isnan(query.area_light_a);
    summary.singular_b += query.judged() && std::isnan(query.area_light_b);
    summary.outside += query.state_a == QueryState::outside || query.state_b == QueryState::outside;
  }
  const auto values = [&](auto&& figure) {
    std::vector<double> all;
    all.reserve(queries.size());
    for (const QueryComparison& query : queries)
      all.push_back(figure(query));
    return all;
  };
  using Query = const QueryComparison&;
  summary.look_ups = verdict_of(values([](Query q) { return q.lobes.loss_a / q.lobes.spread; }),
                                values([](Query q) { return q.lobes.loss_b / q.lobes.spread; }));
  summary.area_lights = verdict_of(values([](Query q) { return q.area_light_a; }),
                                   values([](Query q) { return q.area_light_b; }));
  summary.area_lights_with_amplitude =
      verdict_of(values([](Query q) { return q.with_amplitude_a; }),
                 values([](Query q) { return q.with_amplitude_b; }));
  summary.relative_distance =
      statistics_of(values([](Query q) { return q.lobes.relative_distance(); }));
  summary.amplitude_difference =
      statistics_of(values([](Query q) { return q.lobes.amplitude_difference; }));
  summary.fresnel_difference =
      statistics_of(values([](Query q) { return q.lobes.fresnel_difference; }));
  return summary;
}

}  // namespace ltc
