// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The steps that the matrices of a whole table may take together.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "fit/quantile_model.h"
#include "table/grid.h"
#include "table/storage.h"

namespace ltc {

// What a node has: S, or of a folded table (Storage::folded) S by rows, kappa and gamma.
using FoldedNode = Eigen::Matrix<double, 11, 1>;

// The numbers of it, and of a step, S row-major first.
template <typename Node>
inline constexpr int numbers_of = Node::SizeAtCompileTime;
template <typename Node>
inline constexpr bool is_folded_node = std::is_same_v<Node, FoldedNode>;
template <typename Node>
using NodeVector = Eigen::Matrix<double, numbers_of<Node>, 1>;
template <typename Node>
using NodeMatrix = Eigen::Matrix<double, numbers_of<Node>, numbers_of<Node>>;
template <typename Node>
using NodeVectorsOf = std::vector<NodeVector<Node>>;
using NodeVectors = NodeVectorsOf<Eigen::Matrix3d>;

inline const Eigen::Matrix3d& matrix_of(const Eigen::Matrix3d& node) {
  return node;
}
inline Eigen::Matrix3d matrix_of(const FoldedNode& node) {
  return unflattened(node.head<9>());
}
inline const FoldedNode& flattened(const FoldedNode& node) {
  return node;
}
template <typename Node>
Node node_of(const NodeVector<Node>& numbers) {
  if constexpr (is_folded_node<Node>)
    return numbers;
  else
    return unflattened(numbers);
}

// What a step must leave as it is:
//   - the zeros of equation (16) of Aakash et al. 2022;
//   - theta = 0: every phi has the same matrix;
//   - lambda = 1: the matrix at phi is that at pi/2 - phi with x and y swapped, so that a look-up
//     does not jump where alpha_y overtakes alpha_x and equation (14) folds it; for the same reason
//     there is no fold (x and y swapped, creases would lie across);
//   - kappa = 0 at phi = 0 and theta = 0, where the lobe is symmetric in y;
//   - the scale of the storage (scale_of): the middle entry, or the length of the third column to
//     first order;
//   - every matrix that is not `movable`.
// All of them are subspaces, and the projection onto their intersection is orthogonal: their
// projections commute, since symmetry maps zeros to zeros and lengths to lengths.
class NodeSpace {
 public:
  NodeSpace(const Grid& grid, Storage storage, const std::vector<bool>& movable);

  // The nearest step from `stored` that keeps all that. `stored` itself keeps it.
  template <typename Node>
  void project(const std::vector<Node>& stored, NodeVectorsOf<Node>& step) const;

  // Gives matrices the symmetries above, by averaging those that are tied.
  template <typename Node>
  void symmetrise(std::vector<Node>& stored) const;

 private:
  // A node's matrix, as it is or with x and y swapped.
  struct Image {
    std::size_t node;
    bool swapped;
  };
  template <typename Values>
  void average_orbits(Values& values) const;
  void project_fold(NodeVectorsOf<FoldedNode>& step) const;

  Storage storage_;
  std::vector<std::vector<Image>> orbits_;      // of more than one image
  std::vector<FreeEntries> free_;               // none of a node that is not movable
  std::vector<std::array<bool, 2>> free_fold_;  // kappa and gamma
};

// How near a matrix may come to a singular one.
struct SingularityBound {
  double determinant;  // at least this
  double solid_angle;  // that of the columns' directions, in [-1, 1], at least this
  double condition;    // of the matrix with columns scaled by `scale`, at most this
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  double gamma = 0;  // of a folded node, at most this
};

// |a b c| of the matrix's columns, each made a unit vector: what is left of the determinant's
// digits when a shader rounds its entries. 1 for orthogonal columns, 0 for a singular matrix.
double solid_angle_of_columns(const Eigen::Matrix3d& matrix);

// |M| |M^-1| in the Frobenius norm: one to three times the condition number, without its
// singular values. 3 for a rotation, not finite for a singular matrix.
double frobenius_condition(const Eigen::Matrix3d& matrix);

// stored + step, of scale 1 again. Where that would pass its bound, the
// node takes half the step, and half again; tied nodes of equal bounds stay tied.
template <typename Node>
std::vector<Node> stepped(Storage storage, const std::vector<Node>& stored,
                          const NodeVectorsOf<Node>& step,
                          const std::vector<SingularityBound>& bounds);

}  // namespace ltc
