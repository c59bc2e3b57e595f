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
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/aligned.h"

namespace ltc::kernels {

// Sums over the samples of one bin, a cache line wide. With a = A omega_o / |P A omega_o|,
// x = d . omega = xi + d_z:
//   0..8   x g_r a_c (row-major r, c)     9..11  xi a_c     12..14  a_c     15  xi
inline constexpr std::size_t row_width = 16;

// How a direction bins its projections.
struct ProjectionMap {
  float direction_x, direction_y, direction_z;
  float centre, inverse_scale;  // z = (xi - centre) * inverse_scale
};

// Fills offset arrays gx, gy, gz and the rows (16 floats a sample: the factors above without x and
// xi) for `count` cosine samples (multiple of 16) and the row-major frame matrix P.
void transform_samples(const float* frame_matrix, float alpha_x, float alpha_y,
                       const float* cosine_x, const float* cosine_y, const float* cosine_z,
                       std::size_t count, float* gx, float* gy, float* gz, float* rows);

// xi and bin of `count` (multiple of 16) samples; bins in [0, bin_count).
void project_and_bin(const ProjectionMap& map, const float* gx, const float* gy, const float* gz,
                     std::size_t count, std::size_t bin_count, float* xi, std::int32_t* bins);

// Adds each sample's row, times its factors, to the sums of its bin; `sums` is bin_count rows,
// `populations` bin_count counters, both zeroed by the caller.
void accumulate_rows(const float* xi, const std::int32_t* bins, const float* rows,
                     std::size_t count, float direction_z, float* sums, std::int32_t* populations);

// Adds weight w and w xi of each sample to its bin; `sums` holds bin_count pairs (w, w xi).
void accumulate_weights(const float* xi, const std::int32_t* bins, const float* weights,
                        std::size_t count, float* sums);

// hessian (9 rows of 16 floats, the last 7 unused) += factor * j j^T for `blocks` vectors j (16
// floats each, the last 7 zero).
void accumulate_outer_products(const float* vectors, const float* factors, std::size_t blocks,
                               float* hessian);

// Offsets from the mirror direction (in the mirror's frame) and weights G2/G1 of the lattice's VNDF
// samples, equation (6) importance sampled (Dupuy and Benyoub 2023); zero weight below the horizon.
struct TargetParameters {
  float alpha_x, alpha_y;
  float view_x, view_y, view_z;  // omega_v
  float rotation[9];             // Q, row-major
};
void sample_target(const TargetParameters& parameters, const float* cos_azimuth,
                   const float* sin_azimuth, const float* height, std::size_t count, float* gx,
                   float* gy, float* gz, float* weights);

}  // namespace ltc::kernels
