// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/field_solve.h"

namespace ltc {
namespace {

// The matrix has little use for more of the angle's.
constexpr std::size_t most_matrix_angle = 2;

// Of the updates of an inverse.
constexpr Eigen::Index most_pending = 64;

// The order in phi of the factor that a part has already.
std::size_t own_order(FieldPart part) {
  return part == FieldPart::b ? 2 : part == FieldPart::c || part == FieldPart::d ? 1 : 0;
}

std::vector<FieldTerm> pool(FieldPart first, FieldPart last, std::size_t degree,
                            std::size_t most_angle) {
  std::vector<FieldTerm> terms;
  const auto byte = [](std::size_t value) { return static_cast<std::uint8_t>(value); };
  for (auto part = static_cast<std::size_t>(first); part <= static_cast<std::size_t>(last); ++part)
    for (std::size_t i = 0; i <= degree; ++i)
      for (std::size_t j = 0; i + j <= degree; ++j)
        for (std::size_t k = 0; i + j + k <= degree; ++k)
          for (std::size_t l = 0; l <= most_angle && i + j + k + l <= degree; ++l)
            for (std::size_t m = 0; i + j + k + l + m <= degree; ++m) {
              const FieldTerm term{
                  static_cast<FieldPart>(part), byte(i), byte(j), byte(k), byte(l), byte(m)};
              if (is_allowed(term) && i + j + k + l + m + own_order(term.part) <= degree)
                terms.push_back(term);
            }
  return terms;
}

}  // namespace

std::vector<FieldTerm> matrix_pool(std::size_t degree, bool is_folded) {
  std::vector<FieldTerm> terms = pool(FieldPart::a, FieldPart::m21, degree, most_matrix_angle);
  if (is_folded)
    for (const FieldTerm& term :
         pool(FieldPart::kappa, FieldPart::gamma, degree, most_matrix_angle))
      terms.push_back(term);
  return terms;
}

std::vector<FieldTerm> albedo_pool(std::size_t degree) {
  return pool(FieldPart::amplitude, FieldPart::view_cosine, degree, degree);
}

std::vector<FieldTerm> matrix_pool_of_size(std::size_t count, bool is_folded) {
  std::vector<FieldTerm> terms;
  for (std::size_t degree = 2; terms.size() < count && degree <= field_most_degree; ++degree)
    terms = matrix_pool(degree, is_folded);
  return terms;
}

std::vector<bool> terms_to_keep(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& right,
                                std::size_t count) {
  const Eigen::Index n = right.size();
  Eigen::MatrixXd inverse = CholeskyFactor(curvature).inverse();
  Eigen::VectorXd x = inverse * right, diagonal = inverse.diagonal();
  std::vector<bool> kept(static_cast<std::size_t>(n), true);
  // What taking terms away subtracts from the inverse, a vector's product with itself each. Of the
  // inverse only the diagonal and the columns asked for are brought up to date, and all of it once
  // there are many: it is far larger than any cache.
  Eigen::MatrixXd taken(n, most_pending);
  Eigen::Index pending = 0;
  for (Eigen::Index left = n; left > static_cast<Eigen::Index>(count); --left) {
    Eigen::Index least = 0;
    double least_cost = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!kept[static_cast<std::size_t>(i)])
        continue;
      if (const double cost = x[i] * x[i] / diagonal[i]; cost < least_cost) {
        least = i;
        least_cost = cost;
      }
    }
    kept[static_cast<std::size_t>(least)] = false;
    Eigen::VectorXd column = inverse.col(least);
    column.noalias() -= taken.leftCols(pending) * taken.row(least).head(pending).transpose();
    const double pivot = column[least];
    x -= column * (x[least] / pivot);
    column /= std::sqrt(pivot);
    diagonal -= column.cwiseAbs2();
    taken.col(pending) = column;
    if (++pending < most_pending)
      continue;
    subtract_squared(taken, inverse);
    pending = 0;
  }
  return kept;
}

}  // namespace ltc
