// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_line.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a lobe's light that comes from a line, a cylinder much thinner than it is far: Heitz
// and Hill 2017, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines". Needs
// ltc_lobe.

// The integral of z/|p| d/|p|^3 along the line at the distance d, from its nearest point on, doubled:
// of the nearest point's z, and of the line's own.
float ltc_line_across(float d, float l) {
  float squared = d * d + l * l;
  float angle = ltc_angle(abs(l), d);
  if (l < 0.0) {
    angle = -angle;
  }
  return l / (d * squared) + angle / (d * d);
}
float ltc_line_along(float d, float l) { return l * l / (d * (d * d + l * l)); }

// From p to q, radius much smaller than the distance. Cut at both horizons. `w` is its width's
// transform: a plane's normal goes with the transpose of M, so widths with 1/|M^T normal|.
float ltc_line(LtcLobe lobe, float3 p, float3 q, float radius) {
  float3 a = ltc_to_cosine(lobe, p);
  float3 b = ltc_to_cosine(lobe, q);
  // The part of [0, 1] above both.
  float start = 0.0;
  float end = 1.0;
  if (p.z < 0.0) {
    start = max(start, p.z / (p.z - max(q.z, 0.0)));
  }
  if (q.z < 0.0) {
    end = min(end, max(p.z, 0.0) / (max(p.z, 0.0) - q.z));
  }
  if (a.z < 0.0) {
    start = max(start, a.z / (a.z - max(b.z, 0.0)));
  }
  if (b.z < 0.0) {
    end = min(end, max(a.z, 0.0) / (max(a.z, 0.0) - b.z));
  }
  float3 normal = cross(p, q);
  float upright = length(normal);
  if (start >= end || upright <= 0.0) {
    return 0.0;
  }
  normal = normal / upright;
  float3 columns = normal.x * lobe.m0 + normal.y * lobe.m1 + normal.z * lobe.m2;
  float3 from_point = lerp(a, b, start);
  float3 to_point = lerp(a, b, end);
  float3 along = normalize(b - a);
  float l0 = dot(from_point, along);
  float l1 = dot(to_point, along);
  float3 nearest = from_point - l0 * along;
  float d = length(cross(a, b)) / length(b - a);
  float sum = (ltc_line_across(d, l1) - ltc_line_across(d, l0)) * nearest.z +
              (ltc_line_along(d, l1) - ltc_line_along(d, l0)) * along.z;
  return clamp(radius / LTC_PI * sum / length(columns), 0.0, 1.0);
}
