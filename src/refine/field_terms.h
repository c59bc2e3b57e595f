// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Which terms a field consists of: a pool of all low degrees, of which those are kept that buy
// most.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "field/field.h"

namespace ltc {

// All allowed terms of the matrix, with those of a fold if asked, or of amplitude and Fresnel term,
// of at most a total degree (the orders of the isotropic parts' own factors counted too), in order.
std::vector<FieldTerm> matrix_pool(std::size_t degree, bool is_folded = false);
std::vector<FieldTerm> albedo_pool(std::size_t degree);

// The pool of the least degree with at least `count` terms, or the largest there is.
std::vector<FieldTerm> matrix_pool_of_size(std::size_t count, bool is_folded = false);

// Which of n coefficients to keep, `count` of them: of the quadratic
//     x^T curvature x / 2 - right^T x
// the terms are taken away one by one, always the one without which the minimum over the others
// rises least, x_i^2 / (2 (curvature^-1)_ii) (Hassibi and Stork 1993, "Second Order Derivatives for
// Network Pruning: Optimal Brain Surgeon"). The curvature is positive definite.
std::vector<bool> terms_to_keep(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& right,
                                std::size_t count);

}  // namespace ltc
