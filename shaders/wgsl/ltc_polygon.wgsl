// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_polygon.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a lobe's light that comes from a polygon: equation (11) of Heitz et al. 2016,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines". Exact: the polygon is cut at
// the surface's horizon, below which nothing is seen, and, transformed, at the cosine's. Flat or
// bent, convex or not (a star), of either winding. Needs ltc_lobe.

// What an edge between two unit vectors adds: half of its angle, times the z of its normal, over pi.
fn ltc_edge(a: vec3<f32>, b: vec3<f32>) -> f32 {
  var normal: vec3<f32> = cross(a, b);
  var sine: f32 = length(normal);
  if (sine <= 0.0) {
    return 0.0;
  }
  return 0.5 / LTC_PI * normal.z * (ltc_angle(sine, dot(a, b)) / sine);
}

// A polygon in the making, vertex by vertex: ltc_outline_begin, ltc_outline_add for each in order,
// ltc_outline_share. "v": the vertices; "w": what stands above the surface's horizon, in the space
// of the cosine; "x": what of that stands above the cosine's.
struct LtcOutline {
  v_first: vec3<f32>,
  v_last: vec3<f32>,
  v_count: i32,
  w_first: vec3<f32>,
  w_last: vec3<f32>,
  w_count: i32,
  x_first: vec3<f32>,
  x_last: vec3<f32>,
  x_count: i32,
  sum: f32,
}

fn ltc_outline_begin() -> LtcOutline {
  var none: vec3<f32> = vec3<f32>(0.0, 0.0, 0.0);
  var outline: LtcOutline;
  outline.v_first = none;
  outline.v_last = none;
  outline.v_count = 0;
  outline.w_first = none;
  outline.w_last = none;
  outline.w_count = 0;
  outline.x_first = none;
  outline.x_last = none;
  outline.x_count = 0;
  outline.sum = 0.0;
  return outline;
}

fn ltc_outline_x(before: LtcOutline, x: vec3<f32>) -> LtcOutline {
  var outline: LtcOutline = before;
  if (outline.x_count > 0) {
    outline.sum += ltc_edge(outline.x_last, x);
  } else {
    outline.x_first = x;
  }
  outline.x_last = x;
  outline.x_count += 1;
  return outline;
}

// Where an edge meets the horizon.
fn ltc_at_horizon(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
  var between: vec3<f32> = abs(b.z) * a + abs(a.z) * b;
  return normalize(vec3<f32>(between.x, between.y, 0.0));
}

// The edge from w_last.
fn ltc_outline_w_edge(before: LtcOutline, w: vec3<f32>) -> LtcOutline {
  var outline: LtcOutline = before;
  var a: vec3<f32> = outline.w_last;
  if (a.z >= 0.0) {
    outline = ltc_outline_x(outline, a);
  }
  if (a.z * w.z < 0.0) {
    outline = ltc_outline_x(outline, ltc_at_horizon(a, w));
  }
  return outline;
}

fn ltc_outline_w(before: LtcOutline, w: vec3<f32>) -> LtcOutline {
  var outline: LtcOutline = before;
  if (outline.w_count > 0) {
    outline = ltc_outline_w_edge(outline, w);
  } else {
    outline.w_first = w;
  }
  outline.w_last = w;
  outline.w_count += 1;
  return outline;
}

fn ltc_outline_v_edge(before: LtcOutline, lobe: LtcLobe, v: vec3<f32>) -> LtcOutline {
  var outline: LtcOutline = before;
  var a: vec3<f32> = outline.v_last;
  if (a.z >= 0.0) {
    outline = ltc_outline_w(outline, normalize(ltc_to_cosine(lobe, a)));
  }
  if (a.z * v.z < 0.0) {
    outline = ltc_outline_w(outline, normalize(ltc_to_cosine(lobe, ltc_at_horizon(a, v))));
  }
  return outline;
}

// A vertex, of any length but 0.
fn ltc_outline_add(before: LtcOutline, lobe: LtcLobe, vertex: vec3<f32>) -> LtcOutline {
  var outline: LtcOutline = before;
  var v: vec3<f32> = normalize(vertex);
  if (outline.v_count > 0) {
    outline = ltc_outline_v_edge(outline, lobe, v);
  } else {
    outline.v_first = v;
  }
  outline.v_last = v;
  outline.v_count += 1;
  return outline;
}

// On [0, 1], by the polygon's winding positive or negative.
fn ltc_outline_signed_share(before: LtcOutline, lobe: LtcLobe) -> f32 {
  var outline: LtcOutline = before;
  if (outline.v_count > 0) {
    outline = ltc_outline_v_edge(outline, lobe, outline.v_first);
  }
  if (outline.w_count > 0) {
    outline = ltc_outline_w_edge(outline, outline.w_first);
  }
  if (outline.x_count > 0) {
    outline.sum += ltc_edge(outline.x_last, outline.x_first);
  }
  return clamp(outline.sum, -1.0, 1.0);
}
fn ltc_outline_share(outline: LtcOutline, lobe: LtcLobe) -> f32 {
  return abs(ltc_outline_signed_share(outline, lobe));
}

// Four vertices in order; nothing is cut where all of it is above both horizons.
fn ltc_quad(lobe: LtcLobe, p0: vec3<f32>, p1: vec3<f32>, p2: vec3<f32>, p3: vec3<f32>) -> f32 {
  var a: vec3<f32> = ltc_to_cosine(lobe, p0);
  var b: vec3<f32> = ltc_to_cosine(lobe, p1);
  var c: vec3<f32> = ltc_to_cosine(lobe, p2);
  var d: vec3<f32> = ltc_to_cosine(lobe, p3);
  var lowest: f32 = min(min(min(p0.z, p1.z), min(p2.z, p3.z)), min(min(a.z, b.z), min(c.z, d.z)));
  if (lowest >= 0.0) {
    var e: vec3<f32> = normalize(a);
    var f: vec3<f32> = normalize(b);
    var g: vec3<f32> = normalize(c);
    var h: vec3<f32> = normalize(d);
    var sum: f32 = ltc_edge(e, f) + ltc_edge(f, g) + ltc_edge(g, h) + ltc_edge(h, e);
    return min(abs(sum), 1.0);
  }
  if (max(max(p0.z, p1.z), max(p2.z, p3.z)) <= 0.0 ||
      max(max(a.z, b.z), max(c.z, d.z)) <= 0.0) {
    return 0.0;
  }
  var outline: LtcOutline = ltc_outline_begin();
  outline = ltc_outline_add(outline, lobe, p0);
  outline = ltc_outline_add(outline, lobe, p1);
  outline = ltc_outline_add(outline, lobe, p2);
  outline = ltc_outline_add(outline, lobe, p3);
  return ltc_outline_share(outline, lobe);
}

// ---- The common approximation ----

// The share of a cosine's light that comes from a sphere of which an unclipped form factor is known,
// `form`: its length is the squared sine of the sphere's radius. Exact for spheres (Snyder 1996,
// "Area Light Sources for Real-Time Graphics").
fn ltc_clipped_sphere(form: vec3<f32>) -> f32 {
  var squared: f32 = min(length(form), 1.0);
  if (squared <= 0.0) {
    return 0.0;
  }
  var c: f32 = form.z / squared;
  var s: f32 = sqrt(max(1.0 - c * c, 0.0));
  if (c * c >= squared || s <= 0.0) {
    return squared * max(c, 0.0);
  }
  var x: f32 = sqrt(max(1.0 / squared - 1.0, 0.0));
  var y: f32 = clamp(-x * c / s, -1.0, 1.0);
  var root: f32 = s * sqrt(max(1.0 - y * y, 0.0));
  var arc: f32 = ltc_angle(sqrt(max(1.0 - y * y, 0.0)), y);
  return clamp(((c * arc - x * root) * squared + ltc_angle(root, x)) / LTC_PI, 0.0, 1.0);
}

fn ltc_edge_vector(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
  var normal: vec3<f32> = cross(a, b);
  var sine: f32 = length(normal);
  if (sine <= 0.0) {
    return vec3<f32>(0.0, 0.0, 0.0);
  }
  return 0.5 / LTC_PI * (ltc_angle(sine, dot(a, b)) / sine) * normal;
}

// A quad, as if it were the sphere of the same form factor: not cut, no branch by horizon. Off by up
// to 0.1 of the light where the horizon cuts it (docs/shading.md), exact where it does not.
fn ltc_quad_as_sphere(lobe: LtcLobe, p0: vec3<f32>, p1: vec3<f32>, p2: vec3<f32>,
    p3: vec3<f32>) -> f32 {
  var a: vec3<f32> = normalize(ltc_to_cosine(lobe, p0));
  var b: vec3<f32> = normalize(ltc_to_cosine(lobe, p1));
  var c: vec3<f32> = normalize(ltc_to_cosine(lobe, p2));
  var d: vec3<f32> = normalize(ltc_to_cosine(lobe, p3));
  var form: vec3<f32> = ltc_edge_vector(a, b) + ltc_edge_vector(b, c) + ltc_edge_vector(c, d) +
              ltc_edge_vector(d, a);
  // Away from the light's back, whatever the winding.
  if (dot(form, a + b + c + d) < 0.0) {
    form = -form;
  }
  return ltc_clipped_sphere(form);
}
