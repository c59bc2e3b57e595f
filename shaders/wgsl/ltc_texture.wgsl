// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_texture.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Lights with a picture on them: section 5 of Heitz et al. 2016, "Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines". The share of ltc_quad is multiplied by what the lobe sees of the
// picture in the mean, one fetch of the levels that `ltcfit prefilter` makes. Needs ltc_lobe.

// The picture on corner + u edge_u + v edge_v, u and v on [0, 1]; `size`: texels of the widest level.
// Trilinear filter, clamp to edge.
fn ltc_picture(levels: texture_2d<f32>, levels_sampler: sampler, size: f32, lobe: LtcLobe,
    corner: vec3<f32>, edge_u: vec3<f32>, edge_v: vec3<f32>) -> vec3<f32> {
  var p: vec3<f32> = ltc_to_cosine(lobe, corner);
  var u: vec3<f32> = ltc_to_cosine(lobe, edge_u);
  var v: vec3<f32> = ltc_to_cosine(lobe, edge_v);
  var normal: vec3<f32> = cross(u, v);
  var area_squared: f32 = dot(normal, normal);
  var height: f32 = dot(normal, p);  // the distance of the plane times the area
  // The point of the plane nearest the origin, from the corner, in u and v.
  var foot: vec3<f32> = height / area_squared * normal - p;
  var place: vec2<f32> = vec2<f32>(dot(cross(foot, v), normal), dot(cross(u, foot),
      normal)) / area_squared;
  // sigma^2 = r^2/(2 A) in units of the picture's side, r the distance: height^2/(2 A^3).
  var sigma: f32 = abs(height) / sqrt(2.0 * area_squared * sqrt(area_squared));
  var level: f32 = clamp(log2(max(size * sigma, 1.0)), 0.0, log2(size));
  return textureSampleLevel(levels, levels_sampler, 0.75 * place + vec2<f32>(0.125, 0.125),
      level).xyz;
}
