// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "refine/refine_step.h"

#include <Eigen/Cholesky>

#include "core/parallel.h"

namespace ltc {
namespace {

// What an entry that no query feels is damped with, as a share of the mean node's curvature.
constexpr double least_curvature = 1e-4;

// Conjugate gradients end when the residual's norm has fallen by this, or after so many iterations:
// the model is not worth more. By arcs, twelve follow the queries' noise least; folded tables, on
// samples, want more.
constexpr double residual_share = 1e-2;
template <typename Node>
constexpr int most_iterations = is_folded_node<Node> ? 60 : 12;

template <typename Vector>
double dot(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double sum = 0;
  for (std::size_t node = 0; node < a.size(); ++node)
    sum += a[node].dot(b[node]);
  return sum;
}

template <typename Node>
class StepSystem {
  using Vector = NodeVector<Node>;
  using Matrix = NodeMatrix<Node>;
  using Vectors = NodeVectorsOf<Node>;

 public:
  StepSystem(const QuerySystemOf<Node>& queries, const NodeSpace& space,
             const std::vector<Node>& stored, double damping, const RunContext& run)
      : queries_(queries), space_(space), stored_(stored), run_(run) {
    std::vector<Matrix> blocks;
    queries.diagonal_blocks(blocks, run);
    Vector mean = Vector::Zero();
    for (const Matrix& block : blocks)
      mean += block.diagonal() / static_cast<double>(blocks.size());
    damped_diagonal_.resize(blocks.size());
    inverse_blocks_.resize(blocks.size());
    parallel_for(blocks.size(), run, [&](std::size_t node) {
      damped_diagonal_[node] = damping * (blocks[node].diagonal() + least_curvature * mean);
      Matrix block = blocks[node];
      block.diagonal() += damped_diagonal_[node];
      inverse_blocks_[node] = block.ldlt().solve(Matrix::Identity());
      if (!inverse_blocks_[node].allFinite())
        inverse_blocks_[node].setZero();
    });
  }

  Vectors solve(const Vectors& right) const {
    Vectors residual = right, product, solution(right.size(), Vector::Zero());
    space_.project(stored_, residual);
    Vectors direction = conditioned(residual);
    double energy = dot(residual, direction);
    const double goal = residual_share * residual_share * energy;
    for (int i = 0; i < most_iterations<Node> && energy > goal; ++i) {
      multiply(direction, product);
      const double curvature = dot(direction, product);
      if (!(curvature > 0))
        break;
      const double length = energy / curvature;
      for (std::size_t node = 0; node < solution.size(); ++node) {
        solution[node] += length * direction[node];
        residual[node] -= length * product[node];
      }
      const Vectors next = conditioned(residual);
      const double next_energy = dot(residual, next);
      for (std::size_t node = 0; node < solution.size(); ++node)
        direction[node] = next[node] + (next_energy / energy) * direction[node];
      energy = next_energy;
    }
    return solution;
  }

 private:
  void multiply(const Vectors& step, Vectors& product) const {
    queries_.multiply(step, product, run_);
    for (std::size_t node = 0; node < step.size(); ++node)
      product[node] += damped_diagonal_[node].cwiseProduct(step[node]);
    space_.project(stored_, product);
  }
  Vectors conditioned(const Vectors& residual) const {
    Vectors result(residual.size());
    for (std::size_t node = 0; node < residual.size(); ++node)
      result[node].noalias() = inverse_blocks_[node] * residual[node];
    space_.project(stored_, result);
    return result;
  }

  const QuerySystemOf<Node>& queries_;
  const NodeSpace& space_;
  const std::vector<Node>& stored_;
  const RunContext run_;
  Vectors damped_diagonal_;
  std::vector<Matrix> inverse_blocks_;
};

}  // namespace

template <typename Node>
NodeVectorsOf<Node> refinement_step(const QuerySystemOf<Node>& queries, const NodeSpace& space,
                                    const std::vector<Node>& stored, double damping,
                                    double overshoot, const RunContext& run) {
  NodeVectorsOf<Node> downhill;
  queries.gradient(downhill, run);
  for (NodeVector<Node>& value : downhill)
    value = -value;
  NodeVectorsOf<Node> step = StepSystem<Node>(queries, space, stored, damping, run).solve(downhill);
  for (NodeVector<Node>& value : step)
    value *= overshoot;
  return step;
}

template NodeVectors refinement_step(const QuerySystem&, const NodeSpace&,
                                     const std::vector<Eigen::Matrix3d>&, double, double,
                                     const RunContext&);
template NodeVectorsOf<FoldedNode> refinement_step(const FoldedQuerySystem&, const NodeSpace&,
                                                   const std::vector<FoldedNode>&, double, double,
                                                   const RunContext&);

}  // namespace ltc
