// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "support/table_faults.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <cstring>

#include "table/symmetry.h"

namespace ltc::test {
namespace {

bool same_values(const Table& table, std::size_t a, std::size_t b) {
  return std::memcmp(&table.stored[9 * a], &table.stored[9 * b], 9 * sizeof(float)) == 0 &&
         table.amplitude[a] == table.amplitude[b] && table.fresnel[a] == table.fresnel[b];
}

}  // namespace

std::vector<std::string> faults_of(const Table& table) {
  std::vector<std::string> faults;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    const auto fault = [&](std::string_view what, double value) {
      faults.push_back(fmt::format("entry {}: {} {}", flat, what, value));
    };
    const Lobe lobe = table.grid.lobe(flat);
    const Eigen::Matrix3d stored = table.stored_at(flat), matrix = table.matrix_at(flat);
    if (!has_values(table.status[flat]))
      fault("status", static_cast<double>(table.status[flat]));
    if (!stored.allFinite() || !matrix.allFinite())
      fault("matrix is not finite", stored.sum());
    if (!(stored.determinant() > 0) || !(matrix.determinant() > 0))
      fault("determinant", stored.determinant());
    const auto zeros = symmetry_zeros(lobe.theta_radians, lobe.phi_radians);
    const double largest_zero = zeros.select(stored.cwiseAbs(), 0.0).maxCoeff();
    if (largest_zero != 0)
      fault("equation (16) is broken by", largest_zero);
    // Three floats of a unit vector, each rounded by up to 6e-8.
    if (!(std::abs(stored.col(2).norm() - 1) < 1e-6))
      fault("length of the third column", stored.col(2).norm());
    const float amplitude = table.amplitude[flat], fresnel = table.fresnel[flat];
    if (!(amplitude > 0 && amplitude <= 1))
      fault("amplitude", amplitude);
    if (!(fresnel > 0 && fresnel <= amplitude))
      fault("fresnel", fresnel);
    if (!(table.sw_loss[flat] > 0 && std::isfinite(table.sw_loss[flat])))
      fault("loss", table.sw_loss[flat]);
    NodeIndex first = table.grid.node(flat);
    first.phi = 0;
    if (lobe.theta_radians == 0 && !same_values(table, flat, table.grid.flat(first)))
      fault("differs from phi = 0 at theta", 0);
  }
  return faults;
}

}  // namespace ltc::test
