// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Linearly transformed spherical distributions: Heitz et al. 2016, "Real-Time Polygonal-Light
// Shading with Linearly Transformed Cosines", and its supplemental "Properties and MATLAB
// validation of Linearly Transformed Spherical Distributions".
#pragma once

#include <Eigen/Core>
#include <span>

namespace ltc {

// The distribution that is transformed: omega_o = (x, y, z).
enum class Original {
  uniform_sphere,          // 1/(4 pi)
  uniform_hemisphere,      // 1/(2 pi) where z >= 0
  clamped_cosine,          // z/pi where z >= 0: the LTC
  squared_clamped_cosine,  // 3 z^2/(2 pi) where z >= 0
};

// Density per steradian at a unit direction.
double original_density(Original original, const Eigen::Vector3d& omega_o);

// A unit direction from two uniforms on [0, 1).
Eigen::Vector3d sample_original(Original original, double u_height, double u_azimuth);

// Whether a matrix is finite and has a finite inverse: what a distribution can be made of.
bool is_invertible(const Eigen::Matrix3d& matrix);

// The distribution of M omega_o/|M omega_o|. M is known up to a factor; a negative determinant is a
// mirrored transformation and as good as any.
class LinearlyTransformed {
 public:
  // Throws InputError for a matrix that is not finite or has no inverse.
  explicit LinearlyTransformed(const Eigen::Matrix3d& matrix,
                               Original original = Original::clamped_cosine);

  // Density per steradian at a unit direction: equation (7) of Aakash et al. 2022.
  double density(const Eigen::Vector3d& omega) const;

  // A unit direction from two uniforms on [0, 1): algorithm 2 of Aakash et al. 2022.
  Eigen::Vector3d sample(double u_height, double u_azimuth) const;

  // The integral of the density over the polygon that the vertices (any length, at least three)
  // span as seen from the origin, exact for all four originals. Positive where they turn
  // counter-clockwise seen from outside the sphere, negative otherwise, whatever the sign of M's
  // determinant. Throws InputError as polygon.h does.
  double integrate_polygon(std::span<const Eigen::Vector3d> vertices) const;

 private:
  Eigen::Matrix3d matrix_, inverse_;
  double inverse_determinant_;
  Original original_;
};

// The share of a clamped cosine's transform by M that lies below the horizon z = 0, exact: the
// directions that M takes above it are a half-space about its third row, and over the part of a
// hemisphere within gamma of its pole's half-space the cosine integrates to (1 + cos(gamma))/2. M
// as above; NaN where its third row is zero.
double share_below_horizon(const Eigen::Matrix3d& matrix);

}  // namespace ltc
