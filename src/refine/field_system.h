// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The loss of many look-ups as a function of a field's coefficients, to second order.
//
// Of a folded field the model is one of twelve numbers, (P q) (fit/quantile_model.h): q = L T (0,
// alpha^2 kappa, gamma)^T is linear in the fold's values and in the matrix's, so that V changes
// from step to step.
//
// A query's matrix is linear in the values of the field's twelve functions there, P = P_1 + sum_a
// f_a V_a (field/field.h; but for what keeps determinants positive), and each function is linear in
// its own coefficients, f_a = phi_a . c_a. With the query's quantile model (gradient g and
// curvature H in P, fit/quantile_model.h), the normal equations consist of blocks
//     G_ab = sum_p (V_a^T H V_b)_p phi_a,p phi_b,p^T,   g_a = sum_p (V_a . g)_p phi_a,p,
// dense products of matrices over the queries.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/run_context.h"
#include "field/field.h"
#include "refine/query_meter.h"
#include "refine/refine_queries.h"

namespace ltc {

class FieldSystem {
 public:
  // Lobes are folded; systems of different `shift` in [0, 1) share no samples.
  FieldSystem(const WeightedLobes& asked, double alpha_min, const Creases& creases,
              const QuerySampling& sampling, double shift);

  std::size_t size() const { return queries_.size(); }

  // The terms that coefficients are of: sorted, none of the albedo.
  void set_terms(const std::vector<FieldTerm>& terms, const RunContext& run);

  // F = sum c_p loss_p / spread_p at the coefficients; also makes the model there, which adopt()
  // takes into use. Infinite where a matrix is not finite. Throws Interrupted.
  double evaluate(const Eigen::VectorXd& coefficients, const RunContext& run);
  void adopt() { models_.swap(evaluated_); }

  // Of the model in use. Sums have a fixed order: the same bits for any number of threads.
  struct Equations {
    Eigen::MatrixXd curvature;
    Eigen::VectorXd gradient;
  };
  Equations equations(const RunContext& run) const;

  // Coefficients to start from: those whose matrices cost least beside fitted ones (M, one a query,
  // of any scale), by each query's model at its own fit. What is far off counts by its root, as the
  // loss does.
  Eigen::VectorXd nearest_to(const std::vector<Eigen::Matrix3d>& fitted, const RunContext& run);

  static std::size_t memory_bytes(const QuerySampling& sampling, std::size_t queries,
                                  std::size_t terms);

 private:
  // Of the matrix and the fold, without those of the albedo, which stand between in a field.
  static constexpr std::size_t matrix_parts = field_matrix_part_count,
                               parts = matrix_parts + field_fold_part_count;
  static std::size_t number_of(FieldPart part) {
    return static_cast<std::size_t>(part) - (is_of_fold(part) ? 2 : 0);
  }
  using PartVector = Eigen::Matrix<double, parts, 1>;
  using PartMatrix = Eigen::Matrix<double, parts, parts>;
  struct Query {
    FieldVariables at;
    Eigen::Matrix<double, 9, matrix_parts> directions;  // V
    Vector9 constant;                                   // P_1
    double weight;                                      // c_p
  };
  // In the functions' values, times c_p / spread.
  struct Model {
    double loss = 0;
    PartVector gradient;
    PartMatrix curvature;
  };
  void evaluate_query(std::size_t q, const PartVector& values, QueryMeter::Buffers& buffers);
  void evaluate_folded(std::size_t q, const LobeFrame& frame, const PartVector& values,
                       double share, double expected, const Eigen::Matrix3d& p,
                       QueryMeter::Buffers& buffers);
  template <int numbers, int count>
  static void set_model(Model& model, const Eigen::Matrix<double, numbers, count>& directions,
                        double share, const ModelValueOf<numbers>& value);
  // G and g with every query's model times a weight.
  Equations assemble(const std::vector<double>& weights, const RunContext& run) const;
  Eigen::Index size_of(std::size_t part) const { return first_[part + 1] - first_[part]; }
  // The functions' values at every query.
  Eigen::MatrixXf values_at(const Eigen::VectorXd& coefficients, const RunContext& run) const;

  Creases creases_;
  QueryMeter meter_;
  std::vector<Query> queries_;
  std::vector<QueryTarget> targets_;
  std::vector<Model> models_, evaluated_;
  Eigen::MatrixXf phi_;                          // a column a query, part after part
  std::array<Eigen::Index, parts + 1> first_{};  // of each part's coefficients
};

}  // namespace ltc
