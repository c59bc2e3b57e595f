// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reports, as tables of docs/stability.md, what inverting the matrices of table files costs a
// shader in several orders of operations: at the nodes, and at look-ups between them.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "export/table_file.h"
#include "judge/shader_inverse.h"
#include "table/lookup.h"
#include "table/queries.h"

namespace {

using namespace ltc;

constexpr std::size_t samples = 1024, directions = 16, query_count = 2000;

// What a shader is given: a lobe, and the stored matrix there in all digits and as it has it.
struct Case {
  Lobe lobe;
  Eigen::Matrix3d exact, stored;  // S
};

std::vector<Case> nodes(const Table& table) {
  std::vector<Case> cases;
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat)
    if (has_values(table.status[flat]))
      cases.push_back({table.grid.lobe(flat), table.stored_at(flat), table.stored_at(flat)});
  return cases;
}

// Texture units round the weights of their interpolation to 8 bits.
double hardware_weight(double weight) {
  return std::round(weight * 256) / 256;
}

// Interpolated in single precision from nodes kept in `memory`.
std::vector<Case> look_ups(const Table& table, Precision memory, bool hardware_weights) {
  std::vector<Case> cases;
  for (const Lobe& lobe : random_queries({}, query_count, 1, table.grid.alpha_min)) {
    const Interpolation corners = interpolation(table.grid, lobe);
    Case made{lobe, Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
    Eigen::Matrix3f stored = Eigen::Matrix3f::Zero();
    double total = 0;
    for (std::size_t corner = 0; corner < 16; ++corner) {
      const double weight = corners.weights[corner];
      if (weight == 0)
        continue;
      const Eigen::Matrix3d node = table.stored_at(corners.nodes[corner]);
      made.exact += weight * node;
      const double used = hardware_weights ? hardware_weight(weight) : weight;
      total += used;
      const Eigen::Matrix3f kept =
          memory == Precision::half
              ? Eigen::Matrix3f(node.cast<float>().cast<Eigen::half>().cast<float>())
              : Eigen::Matrix3f(node.cast<float>());
      stored += static_cast<float>(used) * kept;
    }
    made.stored = stored.cast<double>() / total;
    cases.push_back(made);
  }
  return cases;
}

struct Summary {
  double mean = 0, p99 = 0, largest = 0;
  std::size_t lost = 0;  // no inverse, or a lobe that is elsewhere
};

Summary summary_of(std::vector<double> errors) {
  Summary summary;
  std::sort(errors.begin(), errors.end());
  for (const double error : errors) {
    summary.mean += std::min(error, 1.0) / static_cast<double>(errors.size());
    summary.lost += !(error < 1);
  }
  summary.p99 = errors[errors.size() * 99 / 100];
  summary.largest = errors.back();
  return summary;
}

Summary measure(const Table& table, const std::vector<Case>& cases, InverseOrder order,
                Precision memory, Precision arithmetic) {
  std::vector<double> errors(cases.size());
  parallel_for_each<InversionMeter>(
      "inverses", cases.size(), {2}, [] { return InversionMeter(samples, directions); },
      [&](std::size_t i, InversionMeter& meter) {
        const LobeFrame frame(cases[i].lobe);
        const Eigen::Matrix3d exact =
            matrix_from_stored(table.storage, cases[i].exact, cases[i].lobe);
        errors[i] = meter.error(
            frame, exact,
            seen_by_shader(table.storage, cases[i].stored, frame, order, memory, arithmetic));
      });
  return summary_of(std::move(errors));
}

void print(const std::string& name, const Summary& nodes, const Summary& queries) {
  fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {} | {:.1e} | {:.1e} | {:.1e} | {} |\n", name,
             nodes.mean, nodes.p99, nodes.largest, nodes.lost, queries.mean, queries.p99,
             queries.largest, queries.lost);
}

// Distance to GGX of inverses interpolated, each scaled so that its last entry is one, and of
// matrices interpolated: in all digits.
void print_order_of_interpolation(const Table& table) {
  LobeQuantiles quantiles(samples, directions, 32);
  std::vector<float> ggx(quantiles.size()), ltc(quantiles.size());
  std::vector<double> before, after;
  for (const Lobe& lobe : random_queries({}, query_count, 1, table.grid.alpha_min)) {
    const LobeFrame frame(lobe);
    const Interpolation corners = interpolation(table.grid, lobe);
    Eigen::Matrix3d stored = Eigen::Matrix3d::Zero(), inverse = stored;
    for (std::size_t corner = 0; corner < 16; ++corner) {
      if (corners.weights[corner] == 0)
        continue;
      const Eigen::Matrix3d node = table.stored_at(corners.nodes[corner]);
      const Eigen::Matrix3d of_node = node.inverse();
      stored += corners.weights[corner] * node;
      inverse += corners.weights[corner] * of_node / of_node(2, 2);
    }
    quantiles.of_ggx(frame, ggx.data());
    const auto loss = [&](const Eigen::Matrix3d& s) {
      quantiles.of_ltc(frame, matrix_from_stored(table.storage, s, lobe), ltc.data());
      return quantiles.distance(ggx.data(), ltc.data()) / quantiles.spread(ggx.data());
    };
    after.push_back(loss(stored));
    const Eigen::Matrix3d back = inverse.inverse();
    before.push_back(back.allFinite() ? loss(back) : 1e9);
  }
  const Summary matrices = summary_of(after), inverses = summary_of(before);
  fmt::print(
      "interpolated, then inverted: distance to GGX mean {:.4f}, 99 % {:.3f}\n"
      "inverted, then interpolated: mean {:.4f}, 99 % {:.3f}, {} of {} lobes lost\n\n",
      matrices.mean, matrices.p99, inverses.mean, inverses.p99, inverses.lost, query_count);
}

void report(const std::string& path) {
  const Table table = read_table(path);
  fmt::print("{}: storage {}\n\n", path, name_of(table.storage));
  fmt::print(
      "| | nodes: mean | 99 % | largest | lost | look-ups: mean | 99 % | largest | lost |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  using enum InverseOrder;
  using enum Precision;
  const std::vector<Case> at_nodes = nodes(table);
  const auto row = [&](const std::string& name, InverseOrder order, Precision memory,
                       Precision arithmetic, bool hardware_weights = false) {
    print(name, measure(table, at_nodes, order, memory, arithmetic),
          // Rounded to half at the nodes, not after the interpolation.
          measure(table, look_ups(table, memory, hardware_weights), order, single, arithmetic));
  };
  for (const InverseOrder order : {divided, adjugate, factored})
    row(fmt::format("float, {}", name_of(order)), order, single, single);
  row("float, weights of 8 bits, adjugate", adjugate, single, single, true);
  for (const InverseOrder order : {adjugate, factored})
    row(fmt::format("half in memory, {} in float", name_of(order)), order, half, single);
  for (const InverseOrder order : {divided, adjugate, factored})
    row(fmt::format("all in half, {}", name_of(order)), order, half, half);
  fmt::print("\n");
  print_order_of_interpolation(table);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    for (int i = 1; i < count; ++i)
      report(arguments[i]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
