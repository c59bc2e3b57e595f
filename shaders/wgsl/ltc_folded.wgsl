// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_folded.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Folded lobes (docs/folded.md): a clamped cosine that is folded along the two creases |x| = h z
// before the matrix,
//   fold(x, y, z) = (x, y + k u, z + g u),   u = max(0, |x| - h z),
// and the share of its light that comes from a quad or any polygon, exact. Needs ltc_lobe, ltc_polygon.

// M takes what is folded to the directions of the lobe, W is its inverse; g h < 1. An x that is
// mirrored alike before and after the fold is not felt: their determinants are positive.
struct LtcFoldedLobe {
  lobe: LtcLobe,
  k: f32,
  g: f32,
  h: f32,
}

// fold: k, g, h.
fn ltc_folded_lobe_of(lobe: LtcLobe, fold: vec3<f32>) -> LtcFoldedLobe {
  var folded: LtcFoldedLobe;
  folded.lobe = lobe;
  folded.k = fold.x;
  folded.g = fold.y;
  folded.h = fold.z;
  return folded;
}

// By how much the fold is undone beyond a crease.
fn ltc_unfolding(folded: LtcFoldedLobe) -> f32 { return 1.0 / (1.0 - folded.g * folded.h); }

fn ltc_unfolded(folded: LtcFoldedLobe, p: vec3<f32>) -> vec3<f32> {
  var u: f32 = max(abs(p.x) - folded.h * p.z, 0.0) * ltc_unfolding(folded);
  return vec3<f32>(p.x, p.y - folded.k * u, p.z - folded.g * u);
}

// A direction to the space of the cosine, and from there to that of the lobe.
fn ltc_to_cosine_folded(folded: LtcFoldedLobe, omega: vec3<f32>) -> vec3<f32> {
  return ltc_unfolded(folded, ltc_to_cosine(folded.lobe, omega));
}
fn ltc_from_cosine_folded(folded: LtcFoldedLobe, p: vec3<f32>) -> vec3<f32> {
  var u: f32 = max(abs(p.x) - folded.h * p.z, 0.0);
  return ltc_from_cosine(folded.lobe, vec3<f32>(p.x, p.y + folded.k * u, p.z + folded.g * u));
}

// As ltc_density and ltc_direction.
fn ltc_density_folded(folded: LtcFoldedLobe, omega: vec3<f32>) -> f32 {
  var p: vec3<f32> = ltc_to_cosine(folded.lobe, omega);
  var cosine: vec3<f32> = ltc_unfolded(folded, p);
  var squared: f32 = dot(cosine, cosine);
  var determinant: f32 = dot(folded.lobe.w0, cross(folded.lobe.w1, folded.lobe.w2));
  if (abs(p.x) > folded.h * p.z) {
    determinant = determinant * ltc_unfolding(folded);
  }
  return max(cosine.z, 0.0) * determinant / (LTC_PI * squared * squared);
}
fn ltc_direction_folded(folded: LtcFoldedLobe, u1: f32, u2: f32) -> vec3<f32> {
  return normalize(ltc_from_cosine_folded(folded, ltc_cosine_direction(u1, u2)));
}

// ---- Edges ----

// In the space of W, where the cosine is still folded: its half-planes of the horizon z = g |x| and
// of the creases all meet in the y-axis. An edge is cut at x = 0 and there; each of its pieces is
// unfolded and integrated as that of any polygon. Between them run arcs: along creases they cancel;
// along the horizon, on one side of x = 0, from where the outline goes below to where it comes up
// again, by the azimuth of each; and the outline of what is on one side goes along x = 0, through
// the end of the y-axis that the surface sees if through any. So all is a sum over edges.

// A vertex: its direction, and its heights above the horizons of the folded cosine and the surface.
struct LtcFoldedPoint {
  p: vec3<f32>,
  height: f32,
  surface: f32,
}

fn ltc_folded_point(folded: LtcFoldedLobe, p: vec3<f32>, surface: f32) -> LtcFoldedPoint {
  var result: LtcFoldedPoint;
  result.p = p;
  result.height = p.z - folded.g * abs(p.x);
  result.surface = surface;
  return result;
}
fn ltc_folded_vertex(folded: LtcFoldedLobe, vertex: vec3<f32>) -> LtcFoldedPoint {
  var p: vec3<f32> = ltc_to_cosine(folded.lobe, vertex);
  var scale: f32 = inverseSqrt(max(dot(p, p), 1e-36));
  return ltc_folded_point(folded, scale * p, scale * vertex.z);
}

// Of what is linear along an edge and of other signs at its ends: where it is 0.
fn ltc_between(a: vec3<f32>, b: vec3<f32>, at_a: f32, at_b: f32) -> vec3<f32> {
  return a + abs(at_a) / (abs(at_a) + abs(at_b)) * (b - a);
}

// What an edge on one side of x = 0 has beyond the crease, and the azimuth where it meets the
// horizon.
fn ltc_folded_side(folded: LtcFoldedLobe, a: vec3<f32>, height_a: f32, b: vec3<f32>, height_b: f32,
    side: f32) -> f32 {
  if (height_a < 0.0 && height_b < 0.0) {
    return 0.0;
  }
  // Unfolded as if all of it were beyond; x is made positive, which mirrors what is summed.
  var unfolding: f32 = ltc_unfolding(folded);
  var slide: f32 = folded.k * unfolding;
  var p: vec3<f32> = vec3<f32>(side * a.x, a.y - slide * (side * a.x - folded.h * a.z),
      unfolding * height_a);
  var q: vec3<f32> = vec3<f32>(side * b.x, b.y - slide * (side * b.x - folded.h * b.z),
      unfolding * height_b);
  var sum: f32 = 0.0;
  if (height_a < 0.0 || height_b < 0.0) {
    var horizon: vec3<f32> = ltc_between(p, q, height_a, height_b);
    horizon.z = 0.0;
    var azimuth: f32 = 0.5 / LTC_PI * ltc_angle(abs(horizon.y), horizon.x);
    if (horizon.y < 0.0) {
      azimuth = -azimuth;
    }
    if (height_a < 0.0) {
      p = horizon;
      sum = azimuth;
    } else {
      q = horizon;
      sum = -azimuth;
    }
  }
  var beyond_p: f32 = p.x - folded.h * p.z;
  var beyond_q: f32 = q.x - folded.h * q.z;
  if (beyond_p > 0.0 || beyond_q > 0.0) {
    if (beyond_p < 0.0) {
      p = ltc_between(p, q, beyond_p, beyond_q);
    }
    if (beyond_q < 0.0) {
      q = ltc_between(p, q, beyond_p, beyond_q);
    }
    sum += ltc_edge(p, q);
  }
  return side * sum;
}

// The part of [0, 1] along which what is linear and has these values at the ends is not negative, cut
// out of `part`.
fn ltc_part_above(part: vec2<f32>, at_start: f32, at_end: f32) -> vec2<f32> {
  var result: vec2<f32> = part;
  if (at_start < 0.0) {
    result.x = max(part.x, at_start / (at_start - max(at_end, 0.0)));
  }
  if (at_end < 0.0) {
    result.y = min(part.y, max(at_start, 0.0) / (max(at_start, 0.0) - at_end));
  }
  return result;
}

fn ltc_part_between_creases(folded: LtcFoldedLobe, a: vec3<f32>, b: vec3<f32>) -> vec2<f32> {
  var part: vec2<f32> = vec2<f32>(0.0, 1.0);
  part = ltc_part_above(part, folded.h * a.z - a.x, folded.h * b.z - b.x);
  return ltc_part_above(part, folded.h * a.z + a.x, folded.h * b.z + b.x);
}

// What an edge has between the creases.
fn ltc_folded_middle(folded: LtcFoldedLobe, a: vec3<f32>, b: vec3<f32>) -> f32 {
  var part: vec2<f32> = ltc_part_between_creases(folded, a, b);
  if (part.x >= part.y) {
    return 0.0;
  }
  return ltc_edge(a + part.x * (b - a), a + part.y * (b - a));
}

fn ltc_folded_edge(folded: LtcFoldedLobe, a: LtcFoldedPoint, b: LtcFoldedPoint) -> f32 {
  var side: f32 = 1.0;
  if (a.p.x < 0.0) {
    side = -1.0;
  }
  var sum: f32 = ltc_folded_middle(folded, a.p, b.p);
  if ((a.p.x < 0.0) == (b.p.x < 0.0)) {
    return sum + ltc_folded_side(folded, a.p, a.height, b.p, b.height, side);
  }
  var c: vec3<f32> = ltc_between(a.p, b.p, a.p.x, b.p.x);
  c.x = 0.0;
  sum += ltc_folded_side(folded, a.p, a.height, c, c.z, side);
  sum += ltc_folded_side(folded, c, c.z, b.p, b.height, -side);
  // The ways along x = 0 lead from one such place to the next, by turns on either side: a quarter of
  // a turn each for those that pass the y-axis, as the sum of what lies below, or above, says. Taken
  // is which of the two knows by its own y what end of the y-axis that is.
  var below: bool = c.z < 0.0;
  if (below == (folded.lobe.m2.z > 0.0)) {
    if (below == (c.y > 0.0)) {
      sum += 0.5 * side;
    } else {
      sum -= 0.5 * side;
    }
  }
  return sum;
}

// The share of the lobe below the horizon, exact: 1 less what the surface's horizon goes around.
fn ltc_below_horizon_folded(folded: LtcFoldedLobe) -> f32 {
  var normal: vec3<f32> = normalize(folded.lobe.m2);
  var axis: vec3<f32> = vec3<f32>(1.0, 0.0, 0.0);
  if (abs(normal.x) > 0.6) {
    axis = vec3<f32>(0.0, 1.0, 0.0);
  }
  var along: vec3<f32> = normalize(cross(normal, axis));
  var across: vec3<f32> = cross(normal, along);
  var a: LtcFoldedPoint = ltc_folded_point(folded, along, 0.0);
  var b: LtcFoldedPoint = ltc_folded_point(folded, across, 0.0);
  var c: LtcFoldedPoint = ltc_folded_point(folded, -along, 0.0);
  var d: LtcFoldedPoint = ltc_folded_point(folded, -across, 0.0);
  var above: f32 = ltc_folded_edge(folded, a, b) + ltc_folded_edge(folded, b, c) +
                ltc_folded_edge(folded, c, d) + ltc_folded_edge(folded, d, a);
  return clamp(1.0 - above, 0.0, 1.0);
}

// As ltc_horizon_factor.
fn ltc_horizon_factor_folded(folded: LtcFoldedLobe) -> f32 {
  return 1.0 / max(1.0 - ltc_below_horizon_folded(folded), 0.0625);
}

// ---- Polygons ----

// A polygon in the making, as LtcOutline: ltc_outline_begin_folded, ltc_outline_add_folded for each
// vertex in order, ltc_outline_share_folded. "left": where it went below the surface's horizon last;
// "entered": where it came up from there, if it began below.
struct LtcFoldedOutline {
  first: LtcFoldedPoint,
  last: LtcFoldedPoint,
  count: i32,
  left: LtcFoldedPoint,
  left_count: i32,
  entered: LtcFoldedPoint,
  entered_count: i32,
  sum: f32,
}

fn ltc_outline_begin_folded() -> LtcFoldedOutline {
  var none: LtcFoldedPoint;
  none.p = vec3<f32>(0.0, 0.0, 0.0);
  none.height = 0.0;
  none.surface = 0.0;
  var outline: LtcFoldedOutline;
  outline.first = none;
  outline.last = none;
  outline.count = 0;
  outline.left = none;
  outline.left_count = 0;
  outline.entered = none;
  outline.entered_count = 0;
  outline.sum = 0.0;
  return outline;
}

// Where an edge meets the surface's horizon.
fn ltc_folded_at_surface(folded: LtcFoldedLobe, a: LtcFoldedPoint,
    b: LtcFoldedPoint) -> LtcFoldedPoint {
  return ltc_folded_point(folded, ltc_between(a.p, b.p, a.surface, b.surface), 0.0);
}

// The edge from `last`, without what is below the surface's horizon, and what closes it there.
fn ltc_outline_edge_folded(before: LtcFoldedOutline, folded: LtcFoldedLobe,
    to: LtcFoldedPoint) -> LtcFoldedOutline {
  var outline: LtcFoldedOutline = before;
  var a: LtcFoldedPoint = before.last;
  var b: LtcFoldedPoint = to;
  if (a.surface < 0.0 && b.surface < 0.0) {
    return outline;
  }
  if (b.surface < 0.0) {
    b = ltc_folded_at_surface(folded, a, b);
    outline.left = b;
    outline.left_count = 1;
  }
  if (a.surface < 0.0) {
    a = ltc_folded_at_surface(folded, a, b);
    if (outline.left_count > 0) {
      outline.sum += ltc_folded_edge(folded, outline.left, a);
    } else {
      outline.entered = a;
      outline.entered_count = 1;
    }
  }
  outline.sum += ltc_folded_edge(folded, a, b);
  return outline;
}

// A vertex, of any length but 0.
fn ltc_outline_add_folded(before: LtcFoldedOutline, folded: LtcFoldedLobe,
    vertex: vec3<f32>) -> LtcFoldedOutline {
  var outline: LtcFoldedOutline = before;
  var next: LtcFoldedPoint = ltc_folded_vertex(folded, vertex);
  if (outline.count > 0) {
    outline = ltc_outline_edge_folded(outline, folded, next);
  } else {
    outline.first = next;
  }
  outline.last = next;
  outline.count += 1;
  return outline;
}

// On [0, 1], whatever the winding.
fn ltc_outline_share_folded(before: LtcFoldedOutline, folded: LtcFoldedLobe) -> f32 {
  var outline: LtcFoldedOutline = before;
  if (outline.count > 0) {
    outline = ltc_outline_edge_folded(outline, folded, outline.first);
  }
  if (outline.entered_count > 0) {
    outline.sum += ltc_folded_edge(folded, outline.left, outline.entered);
  }
  return min(abs(outline.sum), 1.0);
}

// What is seen of an edge, `at` being where it meets the surface's horizon if it does.
fn ltc_folded_seen_edge(folded: LtcFoldedLobe, a: LtcFoldedPoint, at: LtcFoldedPoint,
    b: LtcFoldedPoint) -> f32 {
  if (a.surface < 0.0 && b.surface < 0.0) {
    return 0.0;
  }
  var start: LtcFoldedPoint = a;
  var end: LtcFoldedPoint = b;
  if (a.surface < 0.0) {
    start = at;
  }
  if (b.surface < 0.0) {
    end = at;
  }
  return ltc_folded_edge(folded, start, end);
}

// A quad whatever cuts it.
fn ltc_folded_cut_quad(folded: LtcFoldedLobe, a: LtcFoldedPoint, b: LtcFoldedPoint,
    c: LtcFoldedPoint, d: LtcFoldedPoint) -> f32 {
  var ab: LtcFoldedPoint = ltc_folded_at_surface(folded, a, b);
  var bc: LtcFoldedPoint = ltc_folded_at_surface(folded, b, c);
  var cd: LtcFoldedPoint = ltc_folded_at_surface(folded, c, d);
  var da: LtcFoldedPoint = ltc_folded_at_surface(folded, d, a);
  var sum: f32 = ltc_folded_seen_edge(folded, a, ab, b) + ltc_folded_seen_edge(folded, b, bc, c) +
              ltc_folded_seen_edge(folded, c, cd, d) + ltc_folded_seen_edge(folded, d, da, a);
  var above_a: bool = a.surface >= 0.0;
  var above_b: bool = b.surface >= 0.0;
  var above_c: bool = c.surface >= 0.0;
  var above_d: bool = d.surface >= 0.0;
  // What closes it along the surface's horizon: from where it goes below to where it comes up.
  var left: LtcFoldedPoint = da;
  var entered: LtcFoldedPoint = ab;
  if (above_c && !above_d) {
    left = cd;
  }
  if (above_b && !above_c) {
    left = bc;
  }
  if (above_a && !above_b) {
    left = ab;
  }
  if (!above_d && above_a) {
    entered = da;
  }
  if (!above_c && above_d) {
    entered = cd;
  }
  if (!above_b && above_c) {
    entered = bc;
  }
  // A bent one may do so twice.
  var count: i32 = 1;
  if (above_a == above_c && above_b == above_d) {
    count = 2;
    if (above_a == above_b) {
      count = 0;
    }
  }
  for (var i: i32 = 0; i < count; i++) {
    if (i == 1 && above_a) {
      left = cd;
      entered = da;
    } else if (i == 1) {
      left = da;
      entered = ab;
    }
    sum += ltc_folded_edge(folded, left, entered);
  }
  return sum;
}

fn ltc_least(v: vec4<f32>) -> f32 { return min(min(v.x, v.y), min(v.z, v.w)); }

// Four vertices in order; nothing is cut where all of it is above both horizons and on one piece of
// the fold.
fn ltc_quad_folded(folded: LtcFoldedLobe, p0: vec3<f32>, p1: vec3<f32>, p2: vec3<f32>,
    p3: vec3<f32>) -> f32 {
  var a: LtcFoldedPoint = ltc_folded_vertex(folded, p0);
  var b: LtcFoldedPoint = ltc_folded_vertex(folded, p1);
  var c: LtcFoldedPoint = ltc_folded_vertex(folded, p2);
  var d: LtcFoldedPoint = ltc_folded_vertex(folded, p3);
  var x: vec4<f32> = vec4<f32>(a.p.x, b.p.x, c.p.x, d.p.x);
  var z: vec4<f32> = vec4<f32>(a.p.z, b.p.z, c.p.z, d.p.z);
  var surface: vec4<f32> = vec4<f32>(p0.z, p1.z, p2.z, p3.z);
  var height: vec4<f32> = vec4<f32>(a.height, b.height, c.height, d.height);
  var right: vec4<f32> = x - folded.h * z;
  var left: vec4<f32> = -x - folded.h * z;
  var one_piece: bool = max(ltc_least(right), ltc_least(left)) >= 0.0 || ltc_least(-max(right,
      left)) >= 0.0;
  if (one_piece && ltc_least(min(height, surface)) >= 0.0) {
    var e: vec3<f32> = ltc_unfolded(folded, a.p);
    var f: vec3<f32> = ltc_unfolded(folded, b.p);
    var g: vec3<f32> = ltc_unfolded(folded, c.p);
    var h: vec3<f32> = ltc_unfolded(folded, d.p);
    var sum: f32 = ltc_edge(e, f) + ltc_edge(f, g) + ltc_edge(g, h) + ltc_edge(h, e);
    return min(abs(sum), 1.0);
  }
  // What the cosine reaches is in z >= min(g, 0) |x|.
  if (ltc_least(-surface) >= 0.0 || ltc_least(min(folded.g, 0.0) * abs(x) - z) >= 0.0) {
    return 0.0;
  }
  return min(abs(ltc_folded_cut_quad(folded, a, b, c, d)), 1.0);
}
