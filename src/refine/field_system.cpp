// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_system.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "core/spread.h"
#include "refine/field_kernels.h"
#include "table/reduction.h"

namespace ltc {
namespace {

// Of the start: what terms that hardly differ on the queries are held by; residuals below so many
// times the loss count as zero; and how often what is far off is weighed anew.
constexpr double start_damping = 1e-4, start_smoothing = 10;
constexpr int start_rounds = 4;

}  // namespace

FieldSystem::FieldSystem(const WeightedLobes& asked, double alpha_min, const Creases& creases,
                         const QuerySampling& sampling, double shift)
    : creases_(creases), meter_(sampling, shift, creases) {
  queries_.reserve(asked.lobes.size());
  for (std::size_t i = 0; i < asked.lobes.size(); ++i) {
    const FieldVariables at(fold(asked.lobes[i]).lobe, alpha_min);
    const FieldDirections directions(at);
    Query query{at, {}, flattened(directions.constant), asked.weights[i]};
    // M = Q T diag(alpha, s_y, 1) = Q P diag(alpha_x, alpha_y, 1).
    const Eigen::Vector3d scale(1, at.width_y / at.lobe.alpha_y, 1);
    for (std::size_t part = 0; part < matrix_parts; ++part)
      query.directions.col(static_cast<Eigen::Index>(part)) =
          flattened(directions.left * directions.direction[part] * scale.asDiagonal());
    queries_.push_back(query);
  }
  targets_.resize(size());
  models_.resize(size());
  evaluated_.resize(size());
}

void FieldSystem::set_terms(const std::vector<FieldTerm>& terms, const RunContext& run) {
  first_.fill(0);
  std::size_t most_degree = 0;
  for (const FieldTerm& term : terms) {
    ++first_[number_of(term.part) + 1];
    for (const std::uint8_t degree : {term.alpha, term.lambda, term.radius, term.angle, term.order})
      most_degree = std::max<std::size_t>(most_degree, degree);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  phi_.resize(first_[parts], static_cast<Eigen::Index>(size()));
  parallel_for(size(), run, [&](std::size_t q) {
    const FieldBasis basis(queries_[q].at, most_degree);
    float* of_query = phi_.col(static_cast<Eigen::Index>(q)).data();
    for (const FieldTerm& term : terms)
      *of_query++ = static_cast<float>(basis.value(term));
  });
}

// In the first values, those that there are directions of; the others do not count.
template <int numbers, int count>
void FieldSystem::set_model(Model& model, const Eigen::Matrix<double, numbers, count>& directions,
                            double share, const ModelValueOf<numbers>& value) {
  model.loss = share * value.loss;
  model.gradient.setZero();
  model.curvature.setZero();
  model.gradient.template head<count>() = share * (directions.transpose() * value.gradient);
  model.curvature.template topLeftCorner<count, count>() =
      share * (directions.transpose() * value.curvature * directions);
}

void FieldSystem::evaluate_folded(std::size_t q, const LobeFrame& frame, const PartVector& values,
                                  double share, double expected, const Eigen::Matrix3d& p,
                                  QueryMeter::Buffers& buffers) {
  const FieldVariables& at = queries_[q].at;
  const FieldDirections of(at);
  // L T = P diag(1, alpha_y/s_y, 1), with what keeps the determinant positive.
  const Eigen::Matrix3d lt = p * Eigen::Vector3d(1, at.lobe.alpha_y / at.width_y, 1).asDiagonal();
  const double alpha_2 = at.alpha * at.alpha;
  const Eigen::Vector3d bend(0, alpha_2 * values[matrix_parts],
                             std::min(values[matrix_parts + 1], most_fold(creases_)));
  Eigen::Matrix<double, 12, parts> directions;
  directions.setZero();
  const auto set = [&](std::size_t part, const Eigen::Vector3d& column) {
    for (int row = 0; row < 3; ++row)
      directions(4 * row + 3, static_cast<Eigen::Index>(part)) = column[row];
  };
  for (std::size_t part = 0; part < matrix_parts; ++part) {
    const auto column = static_cast<Eigen::Index>(part);
    for (int i = 0; i < 9; ++i)
      directions(4 * (i / 3) + i % 3, column) = queries_[q].directions(i, column);
    set(part, of.left * of.direction[part] * bend);
  }
  set(matrix_parts, alpha_2 * lt.col(1));
  set(matrix_parts + 1, lt.col(2));
  FoldedModelValue value;
  meter_.measure(frame, q, p, lt * bend, expected, buffers, value);
  set_model(evaluated_[q], directions, share, value);
}

void FieldSystem::evaluate_query(std::size_t q, const PartVector& values,
                                 QueryMeter::Buffers& buffers) {
  const Query& query = queries_[q];
  Model& model = evaluated_[q];
  model.loss = models_[q].loss;
  const LobeFrame frame(query.at.lobe);
  const double spread = meter_.see(frame, q, targets_[q], buffers), share = query.weight / spread;
  const Eigen::Matrix3d p = field_frame_matrix(values.data(), query.at);
  if (!p.allFinite()) {
    model.loss = std::numeric_limits<double>::infinity();
    return;
  }
  const double expected = model.loss > 0 ? model.loss / share : spread;
  if (!creases_.empty()) {
    evaluate_folded(q, frame, values, share, expected, p, buffers);
    return;
  }
  ModelValue value;
  meter_.measure(frame, q, p, expected, buffers, value);
  set_model(model, query.directions, share, value);
}

Eigen::MatrixXf FieldSystem::values_at(const Eigen::VectorXd& coefficients,
                                       const RunContext& run) const {
  Eigen::MatrixXf values(parts, static_cast<Eigen::Index>(size()));
  const Eigen::VectorXf single = coefficients.cast<float>();
  parallel_for(size(), run, [&](std::size_t q) {
    const auto query = static_cast<Eigen::Index>(q);
    for (std::size_t part = 0; part < parts; ++part)
      values(static_cast<Eigen::Index>(part), query) =
          phi_.col(query)
              .segment(first_[part], size_of(part))
              .dot(single.segment(first_[part], size_of(part)));
  });
  return values;
}

double FieldSystem::evaluate(const Eigen::VectorXd& coefficients, const RunContext& run) {
  const Eigen::MatrixXf values = values_at(coefficients, run);
  // The loss at the model in use tells each query's smoothing.
  spread_for<QueryMeter::Buffers>(
      Spreading::kept, size(), run, [] { return QueryMeter::Buffers(); },
      [&](std::size_t q, QueryMeter::Buffers& buffers) {
        evaluate_query(q, values.col(static_cast<Eigen::Index>(q)).cast<double>(), buffers);
        run.advance();
      },
      [&](std::size_t q, auto&& take) { take(bytes_of(evaluated_[q])); },
      [&](std::size_t) { run.advance(); });
  return std::accumulate(evaluated_.begin(), evaluated_.end(), 0.0,
                         [](double sum, const Model& model) { return sum + model.loss; });
}

FieldSystem::Equations FieldSystem::assemble(const std::vector<double>& weights,
                                             const RunContext& run) const {
  const auto count = static_cast<Eigen::Index>(size());
  const Eigen::Index n = first_[parts];
  Equations result{Eigen::MatrixXd(n, n), Eigen::VectorXd::Zero(n)};
  std::vector<std::pair<std::size_t, std::size_t>> blocks;
  for (std::size_t a = 0; a < parts; ++a)
    for (std::size_t b = a; b < parts; ++b)
      blocks.emplace_back(a, b);
  // Query by query once, for models lie far apart.
  Eigen::MatrixXf curvatures(count, static_cast<Eigen::Index>(blocks.size()));
  Eigen::MatrixXd gradients(count, static_cast<Eigen::Index>(parts));
  for (Eigen::Index q = 0; q < count; ++q) {
    const auto at = static_cast<std::size_t>(q);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      curvatures(q, static_cast<Eigen::Index>(i)) = static_cast<float>(
          weights[at] * models_[at].curvature(static_cast<Eigen::Index>(blocks[i].first),
                                              static_cast<Eigen::Index>(blocks[i].second)));
    gradients.row(q) = weights[at] * models_[at].gradient.transpose();
  }
  // One block is one thread's: sums have a fixed order.
  struct None {};
  spread_for<None>(
      Spreading::moving, blocks.size(), run, [] { return None(); },
      [&](std::size_t i, None&) {
        const auto [a, b] = blocks[i];
        const auto numbers_of = [&](std::size_t part) {
          return kernels::RowsOf<float>{phi_.data() + first_[part],
                                        static_cast<std::size_t>(size_of(part)), size(),
                                        static_cast<std::size_t>(n)};
        };
        result.curvature.block(first_[a], first_[b], size_of(a), size_of(b)).setZero();
        kernels::add_products(numbers_of(a), curvatures.col(static_cast<Eigen::Index>(i)).data(),
                              numbers_of(b), 1, result.curvature.col(first_[b]).data() + first_[a],
                              static_cast<std::size_t>(n),
                              a == b ? kernels::Products::upper : kernels::Products::all);
        if (a == b)
          for (Eigen::Index q = 0; q < count; ++q)
            result.gradient.segment(first_[a], size_of(a)) +=
                gradients(q, static_cast<Eigen::Index>(a)) *
                phi_.col(q).segment(first_[a], size_of(a)).cast<double>();
      },
      [&](std::size_t i, auto&& take) {
        const auto [a, b] = blocks[i];
        const auto rows = static_cast<std::size_t>(size_of(a));
        for (Eigen::Index column = first_[b]; column < first_[b + 1]; ++column)
          take(std::as_writable_bytes(
              std::span(result.curvature.col(column).data() + first_[a], rows)));
        if (a == b)
          take(std::as_writable_bytes(std::span(result.gradient.data() + first_[a], rows)));
      },
      [](std::size_t) {});
  result.curvature.triangularView<Eigen::StrictlyLower>() = result.curvature.transpose();
  return result;
}

FieldSystem::Equations FieldSystem::equations(const RunContext& run) const {
  return assemble(std::vector<double>(size(), 1.0), run);
}

Eigen::VectorXd FieldSystem::nearest_to(const std::vector<Eigen::Matrix3d>& fitted,
                                        const RunContext& run) {
  // The cost of values f beside the fit's is cost + gradient . f + f . curvature f / 2.
  std::vector<double> cost(size()), weights(size(), 1.0);
  spread_for<QueryMeter::Buffers>(
      Spreading::kept, size(), run, [] { return QueryMeter::Buffers(); },
      [&](std::size_t q, QueryMeter::Buffers& buffers) {
        const Query& query = queries_[q];
        const LobeFrame frame(query.at.lobe);
        const double spread = meter_.see(frame, q, targets_[q], buffers);
        const double share = query.weight / spread;
        Eigen::Matrix3d p = frame.from_matrix(fitted[q]);
        p *= query.constant[8] / p(2, 2);
        ModelValue value;
        meter_.measure(frame, q, p, start_smoothing * spread, buffers, value);
        meter_.measure(frame, q, p, start_smoothing * value.loss, buffers, value);
        const Vector9 wanted = flattened(p) - query.constant;
        const Vector9 bent = value.curvature * wanted;
        value.gradient = -bent;
        set_model(models_[q], query.directions, share, value);
        cost[q] = 0.5 * share * wanted.dot(bent);
      },
      [&](std::size_t q, auto&& take) {
        take(bytes_of(models_[q]));
        take(bytes_of(cost[q]));
      },
      [](std::size_t) {});
  Eigen::VectorXd coefficients;
  for (int round = 0; round < start_rounds; ++round) {
    Equations sums = assemble(weights, run);
    sums.curvature.diagonal().array() +=
        start_damping * (sums.curvature.diagonal().array() + sums.curvature.diagonal().mean());
    coefficients = -sums.curvature.llt().solve(sums.gradient);
    const Eigen::MatrixXf values = values_at(coefficients, run);
    for (std::size_t q = 0; q < size(); ++q) {
      const PartVector f = values.col(static_cast<Eigen::Index>(q)).cast<double>();
      const double excess =
          cost[q] + models_[q].gradient.dot(f) + 0.5 * f.dot(models_[q].curvature * f);
      weights[q] = 1 / std::sqrt(1 + 2 * std::max(0.0, excess) / models_[q].loss);
    }
  }
  return coefficients;
}

std::size_t FieldSystem::memory_bytes(const QuerySampling& sampling, std::size_t queries,
                                      std::size_t terms) {
  return queries * (sizeof(Query) + 2 * sizeof(Model) + QueryMeter::target_bytes(sampling) +
                    2 * terms * sizeof(float)) +
         3 * terms * terms * sizeof(double);
}

}  // namespace ltc
