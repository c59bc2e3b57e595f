// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/field_terms.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace ltc {
namespace {

// The matrix has little use for more of the angle's.
constexpr std::size_t most_matrix_angle = 2;

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
  Eigen::MatrixXd inverse = curvature.llt().solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::VectorXd x = inverse * right;
  std::vector<bool> kept(static_cast<std::size_t>(n), true);
  // The rows that are left, compact: what is taken away costs no more.
  std::vector<Eigen::Index> left(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i)
    left[static_cast<std::size_t>(i)] = i;
  Eigen::Index size = n;
  while (size > static_cast<Eigen::Index>(count)) {
    Eigen::Index least = 0;
    double least_cost = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < size; ++i)
      if (const double cost = x[i] * x[i] / inverse(i, i); cost < least_cost) {
        least = i;
        least_cost = cost;
      }
    // The last one takes its place.
    const Eigen::Index last = size - 1;
    if (least != last) {
      inverse.col(least).head(size).swap(inverse.col(last).head(size));
      inverse.row(least).head(size).swap(inverse.row(last).head(size));
      std::swap(x[least], x[last]);
      std::swap(left[static_cast<std::size_t>(least)], left[static_cast<std::size_t>(last)]);
    }
    kept[static_cast<std::size_t>(left[static_cast<std::size_t>(last)])] = false;
    const Eigen::VectorXd column = inverse.col(last).head(last);
    const double pivot = inverse(last, last);
    x.head(last) -= column * (x[last] / pivot);
    inverse.topLeftCorner(last, last).noalias() -= (column / pivot) * column.transpose();
    size = last;
  }
  return kept;
}

}  // namespace ltc
