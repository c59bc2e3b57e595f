// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_line.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a lobe's light that comes from a line, a cylinder much thinner than it is far: Heitz
// and Hill 2017, "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines". Needs
// ltc_lobe.

// The integral of z/|p| d/|p|^3 along the line at the distance d, from its nearest point on, doubled:
// of the nearest point's z, and of the line's own.
fn ltc_line_across(d: f32, l: f32) -> f32 {
  var squared: f32 = d * d + l * l;
  var angle: f32 = ltc_angle(abs(l), d);
  if (l < 0.0) {
    angle = -angle;
  }
  return l / (d * squared) + angle / (d * d);
}
fn ltc_line_along(d: f32, l: f32) -> f32 { return l * l / (d * (d * d + l * l)); }

// From p to q, radius much smaller than the distance. Cut at both horizons. `w` is its width's
// transform: a plane's normal goes with the transpose of M, so widths with 1/|M^T normal|.
fn ltc_line(lobe: LtcLobe, p: vec3<f32>, q: vec3<f32>, radius: f32) -> f32 {
  var a: vec3<f32> = ltc_to_cosine(lobe, p);
  var b: vec3<f32> = ltc_to_cosine(lobe, q);
  // The part of [0, 1] above both.
  var start: f32 = 0.0;
  var end: f32 = 1.0;
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
  var normal: vec3<f32> = cross(p, q);
  var upright: f32 = length(normal);
  if (start >= end || upright <= 0.0) {
    return 0.0;
  }
  normal = normal / upright;
  var columns: vec3<f32> = normal.x * lobe.m0 + normal.y * lobe.m1 + normal.z * lobe.m2;
  var from_point: vec3<f32> = mix(a, b, start);
  var to_point: vec3<f32> = mix(a, b, end);
  var along: vec3<f32> = normalize(b - a);
  var l0: f32 = dot(from_point, along);
  var l1: f32 = dot(to_point, along);
  var nearest: vec3<f32> = from_point - l0 * along;
  var d: f32 = length(cross(a, b)) / length(b - a);
  var sum: f32 = (ltc_line_across(d, l1) - ltc_line_across(d, l0)) * nearest.z +
              (ltc_line_along(d, l1) - ltc_line_along(d, l0)) * along.z;
  return clamp(radius / LTC_PI * sum / length(columns), 0.0, 1.0);
}
