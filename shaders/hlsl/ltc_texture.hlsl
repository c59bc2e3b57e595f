// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_texture.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Lights with a picture on them: section 5 of Heitz et al. 2016, "Real-Time Polygonal-Light Shading
// with Linearly Transformed Cosines". The share of ltc_quad is multiplied by what the lobe sees of the
// picture in the mean, one fetch of the levels that `ltcfit prefilter` makes. Needs ltc_lobe.

// The picture on corner + u edge_u + v edge_v, u and v on [0, 1]; `size`: texels of the widest level.
// Trilinear filter, clamp to edge.
float3 ltc_picture(Texture2D<float4> levels, SamplerState levels_sampler, float size, LtcLobe lobe,
    float3 corner, float3 edge_u, float3 edge_v) {
  float3 p = ltc_to_cosine(lobe, corner);
  float3 u = ltc_to_cosine(lobe, edge_u);
  float3 v = ltc_to_cosine(lobe, edge_v);
  float3 normal = cross(u, v);
  float area_squared = dot(normal, normal);
  float height = dot(normal, p);  // the distance of the plane times the area
  // The point of the plane nearest the origin, from the corner, in u and v.
  float3 foot = height / area_squared * normal - p;
  float2 place = float2(dot(cross(foot, v), normal), dot(cross(u, foot), normal)) / area_squared;
  // sigma^2 = r^2/(2 A) in units of the picture's side, r the distance: height^2/(2 A^3).
  float sigma = abs(height) / sqrt(2.0 * area_squared * sqrt(area_squared));
  float level = clamp(log2(max(size * sigma, 1.0)), 0.0, log2(size));
  return levels.SampleLevel(levels_sampler, 0.75 * place + float2(0.125, 0.125), level).xyz;
}
