// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The hot loops of the fit, in single precision, for whatever vector unit the CPU has.
//
// All of them work on offsets from the mirror direction, g = Q^T omega - e_z (see lobe_frame.h), so
// that a projection xi = d . g keeps its relative precision for lobes of any width.
//
// Sorting is replaced by binning. The projections of lobes follow, to first order, a Student
// distribution with two degrees of freedom (the projection of GGX slopes), whose distribution
// function is (1 + z / sqrt(1 + z^2)) / 2 with z = (xi - centre) / scale. Binning in
// t = z / sqrt(1 + z^2) therefore puts about as many samples into every bin, tails included, and
// each bin is a block of neighbouring quantiles, which is all that the Gauss-Newton step needs.
//
// Seen along the mirror direction, slopes count by their squares, and the tails are heavier still:
// a thousandth of a sharp lobe makes up a third of its mean there. Graded bins are even in
// 1 - sqrt(1 - |t|), as the samples of graded sets are (sample_sets.h): with 64 of them the last
// one holds a two-thousandth of the lobe, not a sixty-fourth.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/aligned.h"
#include "core/points.h"

namespace ltc::kernels {

// Sums over the samples of one bin, a cache line wide. With a = A omega_o / |P A omega_o|,
// x = d . omega = xi + d_z:
//   0..8   x g_r a_c (row-major r, c)     9..11  xi a_c     12..14  a_c     15  xi
//
// Folded samples (ltc/folded.h) have a fourth coordinate, a_3 = u / |...|, and P a fourth column: A
// fold(omega_o) = A omega_o + (0, alpha_y k, g) u, so that P A fold(omega_o) = P A omega_o + q u
// with q = P (0, alpha_y k, g). Their rows have C = 4 columns in place of 3, in two cache lines:
//   0..3C-1  x g_r a_c     3C..4C-1  xi a_c     4C..5C-1  a_c     5C  xi
constexpr std::size_t row_width_of(std::size_t columns) {
  return columns == 3 ? 16 : 32;
}
inline constexpr std::size_t row_width = row_width_of(3);

enum class BinSpacing { even, graded };

// How a direction bins its projections.
struct ProjectionMap {
  float direction_x, direction_y, direction_z;
  float centre, inverse_scale;  // z = (xi - centre) * inverse_scale
  BinSpacing spacing = BinSpacing::even;
};

// dx/dP summed over the samples of a bin (three rows of so many columns), from the bin's row sums.
template <int columns = 3>
void jacobian_of_sums(const ProjectionMap& map, const float* sums, float* jacobian) {
  for (int c = 0; c < columns; ++c) {
    jacobian[c] = map.direction_x * sums[4 * columns + c] - sums[c];
    jacobian[columns + c] = map.direction_y * sums[4 * columns + c] - sums[columns + c];
    // (d_z - x f_z) a with f_z = 1 + g_z and x = xi + d_z: the two d_z cancel on paper, not in
    // floating point.
    jacobian[2 * columns + c] = -sums[3 * columns + c] - sums[2 * columns + c];
  }
}

// P, row-major, of a lobe of these roughnesses; the column q and the u of each sample, of folded
// lobes, else null.
struct FrameMatrix {
  const float* p;
  float alpha_x, alpha_y;
  const float* q = nullptr;
  const float* u = nullptr;
};

// Offsets of samples, and a row each: the factors above without x and xi.
struct SampleRows {
  float* gx;
  float* gy;
  float* gz;
  float* rows;
};

// Fills the offsets and rows of cosine samples.
void transform_samples(const FrameMatrix& matrix, const Points& cosine, const SampleRows& result);

// xi and bin of samples of offsets g; bins in [0, bin_count).
void project_and_bin(const ProjectionMap& map, const Points& g, std::size_t bin_count, float* xi,
                     std::int32_t* bins);

// Along how many directions rows are summed at once: a row is read once for all of them, and the
// sums of one direction do not wait for those of another.
inline constexpr std::size_t directions_at_once = 4;

// What project_and_bin gives, of one direction after the other.
struct BinnedSamples {
  const float* xi;
  const std::int32_t* bins;
  std::size_t count, bin_count;  // of one direction
};

// bin_count rows and counters of one direction after the other.
struct BinSums {
  float* sums;
  std::int32_t* populations;
};

// Adds each sample's row, times its factors, to the sums of its bin, along `group` <=
// directions_at_once directions whose z are `direction_z`. The caller zeroes the result. Rows of 3
// or, folded, 4 `columns`.
void accumulate_rows(const BinnedSamples& samples, const float* rows, const float* direction_z,
                     std::size_t group, const BinSums& result, std::size_t columns = 3);

// Adds weight w and w xi of each sample to its bin; `sums` holds bin_count pairs (w, w xi).
// `scratch` holds 2 count floats.
void accumulate_weights(const float* xi, const std::int32_t* bins, const float* weights,
                        std::size_t count, float* scratch, float* sums);

// The target along one direction, cut into cells at the bins' edges. Over cell j the integral of
// its quantile function is moment + s (c1 + s (c2 + s c3)), s = (u - mass) inverse_width in [0, 1];
// the first cell adds first_tail sqrt(s) to it, the last one last_tail (1 - sqrt(1 - s)).
struct TargetCells {
  const float* mass;  // bin_count + 1 values, the last one 1
  // Where to look for u: the cell of i / bin_count, the lower bound of floor(u bin_count)'s.
  const std::int32_t* first_cell;
  const float* moment;
  const float* inverse_width;
  const float* c1;
  const float* c2;
  const float* c3;
  float first_tail, last_tail;
};

// The rows of all samples, summed into the bins of one direction.
struct DirectionBins {
  const ProjectionMap& map;
  const float* sums;
  const std::int32_t* populations;
  std::size_t bin_count;  // a multiple of 16
  std::size_t count;      // of all samples
  std::size_t columns = 3;
};

// What one direction adds to the model (quantile_model.h): `gradient` row_width_of(columns) floats,
// those after the first 3 columns unused; `hessian` 3 columns rows of as many, likewise. All are
// added to.
struct DirectionSums {
  float* gradient;
  float* hessian;
  double loss;
};

// Compares the binned LTC with the target's quantiles and accumulates loss, gradient and curvature.
// `scratch` holds (4 + row_width_of(columns)) bin_count floats.
void reduce_direction(const DirectionBins& of, const TargetCells& target, float smoothing,
                      float* scratch, DirectionSums& result);

}  // namespace ltc::kernels
