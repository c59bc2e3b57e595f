// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Images on rectangular lights, filtered beforehand: sections 5.2 to 5.4 of Heitz et al. 2016,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
//
// The image covers the rectangle, its row 0 on top. Its coordinates are s from left to right and t
// from top to bottom, both 0 to 1 on it: at the point x half_u + y half_v from the rectangle's
// centre s = (1 + x)/2 and t = (1 - y)/2.
//
// The prefiltered texture is a square of N x N texels, N a power of two, whose level k has N/2^k
// texels a side down to one. In all levels the image is stretched over the inner [1/8, 7/8] in both
// directions: (s, t) is at (1/8 + 3/4 s, 1/8 + 3/4 t). A texel's value is the mean of the image
// under a Gaussian about its centre, cut off at the image's edges and normalised over what is left,
// of the standard deviation max(2^k/N, d/2) in units of the image's sides, where d is the distance
// of the centre from the image: 0 on it, and in the margin such that the Gaussian meets the image.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/run_context.h"
#include "export/image.h"
#include "render/light_image.h"

namespace ltc {

inline constexpr double light_texture_margin = 1.0 / 8;
inline constexpr std::size_t least_light_texture_side = 8, largest_light_texture_side = 4096;

// 512, or the next power of two that no side of the image is above.
std::size_t usual_light_texture_side(const LightImage& image);

// The levels, of four channels in half precision's range: values above 65504 are refused where they
// are stored. The same bits with any number of threads. Throws InputError for an image without
// pixels and a side that is no power of two in [8, 4096].
std::vector<Image> prefilter(const LightImage& image, std::size_t side, std::string_view stage,
                             const RunContext& run);

// Where a texture is fetched for the rectangle center + x half_u + y half_v, |x|, |y| <= 1, AFTER
// the transform by M^-1, which makes of it any parallelogram: at the origin's orthogonal projection
// to its plane, with the standard deviation sqrt(r^2/(2 A)) of its distance r and the area A. What
// has no area is fetched in the middle at the coarsest level.
struct TextureFetch {
  double s, t;                // of the image; any number
  double standard_deviation;  // in units of the image's sides
};
TextureFetch texture_fetch(const Eigen::Vector3d& center, const Eigen::Vector3d& half_u,
                           const Eigen::Vector3d& half_v);

// Trilinear at level of detail log2(N standard deviation), clamped to [0, log2 N], coordinates
// clamped to the texture's edge: what a GPU's sampler gives.
std::array<double, 4> fetched(const std::vector<Image>& levels, const TextureFetch& fetch);

// A rectangle's image for renderers of one channel: its luminance (Rec. 709).
class LightTexture {
 public:
  explicit LightTexture(LightImage image, const RunContext& run = {});

  // At a point of the light, in units of its half sides; points outside count as the
  // nearest on it.
  double emitted(const Eigen::Vector2d& place) const;
  // What is fetched for the light after M^-1.
  double fetched(const Eigen::Vector3d& center, const Eigen::Vector3d& half_u,
                 const Eigen::Vector3d& half_v) const;

 private:
  LightImage image_;
  std::vector<Image> levels_;
};

}  // namespace ltc
