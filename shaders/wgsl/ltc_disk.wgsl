// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_disk.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a lobe's light that comes from a disk, an ellipse or a sphere: Heitz and Hill 2017,
// "Real-Time Line- and Disk-Light Shading with Linearly Transformed Cosines". Needs ltc_lobe,
// ltc_polygon.

// The form factor, a vector, of the ellipse c + a cos t + b sin t seen from the origin; not cut.
//
// The cone of its directions is x^T N^-1 x = 0 with N = a a^T + b b^T - c c^T, whose one negative
// eigenvalue belongs to the cone's axis e. With the eigenvalues mu_0 < 0 < mu_1, mu_2 the squared
// tangents of the cone's half angles are -mu_i/mu_0, and an ellipse upright on its axis has the form
// factor tan tan/sqrt((1 + tan^2)(1 + tan^2)) = |det(a b c)|/sqrt(-mu_0 p'(mu_0)), p being the
// characteristic polynomial. So one eigenvalue is all that is wanted, by Laguerre's iteration, which
// climbs from below all roots to the least. Two bounds from below: -|c|^2, near where the ellipse is
// small, and where it is large the root of p without its cube.
fn ltc_ellipse_form(c: vec3<f32>, a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
  var ab: vec3<f32> = cross(a, b);
  var bc: vec3<f32> = cross(b, c);
  var ca: vec3<f32> = cross(c, a);
  var determinant: f32 = dot(ab, c);
  var trace: f32 = dot(a, a) + dot(b, b) - dot(c, c);
  var minors: f32 = dot(ab, ab) - dot(bc, bc) - dot(ca, ca);
  // p(mu) = mu^3 - trace mu^2 + minors mu + determinant^2
  var mu: f32 = -dot(c, c);
  if (trace > 0.0) {
    var root: f32 = sqrt(minors * minors + 4.0 * trace * determinant * determinant);
    var bound: f32 = (minors - root) / (2.0 * trace);
    if (minors > 0.0) {
      bound = -2.0 * determinant * determinant / (minors + root);
    }
    mu = max(mu, bound);
  }
  for (var i: i32 = 0; i < 4; i++) {
    var value: f32 = ((mu - trace) * mu + minors) * mu + determinant * determinant;
    var slope: f32 = (3.0 * mu - 2.0 * trace) * mu + minors;
    var bend: f32 = 6.0 * mu - 2.0 * trace;
    var root: f32 = sqrt(max(4.0 * slope * slope - 6.0 * value * bend, 0.0));
    mu = mu - 3.0 * value / max(slope + root, 1e-30);
  }
  mu = min(mu, -1e-30);
  var slope: f32 = max((3.0 * mu - 2.0 * trace) * mu + minors, 1e-30);
  // adj(N - mu) c = p'(mu) (e.c) e: of the columns' adjugate, e's direction.
  var n0: vec3<f32> = a.x * a + b.x * b - c.x * c - vec3<f32>(mu, 0.0, 0.0);
  var n1: vec3<f32> = a.y * a + b.y * b - c.y * c - vec3<f32>(0.0, mu, 0.0);
  var n2: vec3<f32> = a.z * a + b.z * b - c.z * c - vec3<f32>(0.0, 0.0, mu);
  var axis: vec3<f32> = c.x * cross(n1, n2) + c.y * cross(n2, n0) + c.z * cross(n0, n1);
  var form: f32 = abs(determinant) / sqrt(-mu * slope);
  return min(form, 1.0) * normalize(axis);
}

// ---- Cut by a horizon ----

// An ellipse's centre and half axes.
struct LtcEllipse {
  c: vec3<f32>,
  a: vec3<f32>,
  b: vec3<f32>,
}

// The ellipse of the same cone whose centre and half axes are upright on each other, by turns: of the
// half axes, which leave the ellipse, and hyperbolic ones of an axis and the centre, which make the
// rays c + a and c - a of equal length and leave a a^T - c c^T. One-sided Jacobi turns keep small
// axes' digits beside large ones.
fn ltc_ellipse_upright_on_center(ellipse: LtcEllipse) -> LtcEllipse {
  var turned: LtcEllipse = ellipse;
  var sum: vec3<f32> = ellipse.c + ellipse.a;
  var difference: vec3<f32> = ellipse.c - ellipse.a;
  var factor: f32 = sqrt(length(difference) / max(length(sum), 1e-30));
  turned.c = 0.5 * (factor * sum + difference / factor);
  turned.a = 0.5 * (factor * sum - difference / factor);
  return turned;
}
fn ltc_ellipse_principal(ellipse: LtcEllipse) -> LtcEllipse {
  var turned: LtcEllipse = ellipse;
  for (var i: i32 = 0; i < 6; i++) {
    var mixed: f32 = dot(turned.a, turned.b);
    if (mixed != 0.0) {
      var zeta: f32 = (dot(turned.b, turned.b) - dot(turned.a, turned.a)) / (2.0 * mixed);
      var tangent: f32 = 1.0 / (abs(zeta) + sqrt(1.0 + zeta * zeta));
      if (zeta < 0.0) {
        tangent = -tangent;
      }
      var cosine: f32 = inverseSqrt(1.0 + tangent * tangent);
      var a: vec3<f32> = turned.a;
      turned.a = cosine * (a - tangent * turned.b);
      turned.b = cosine * (tangent * a + turned.b);
    }
    turned = ltc_ellipse_upright_on_center(turned);
    var other: LtcEllipse;
    other.c = turned.c;
    other.a = turned.b;
    other.b = turned.a;
    other = ltc_ellipse_upright_on_center(other);
    turned.c = other.c;
    turned.b = other.a;
  }
  return turned;
}

// On (-pi, pi].
fn ltc_signed_angle(y: f32, x: f32) -> f32 {
  var angle: f32 = ltc_angle(abs(y), x);
  if (y < 0.0) {
    return -angle;
  }
  return angle;
}

fn ltc_atanh(x: f32) -> f32 {
  var s: f32 = x * x;
  if (s < 0.04) {
    return x * (1.0 + s * (0.33333333 + s * (0.2 + s * (0.14285714 + s * 0.11111111))));
  }
  return 0.5 * log((1.0 + x) / (1.0 - x));
}

// The integral of du/(constant + factor u^2), whose denominator is positive.
fn ltc_integral_over(start: f32, end: f32, constant: f32, factor: f32) -> f32 {
  var ratio: f32 = sqrt(abs(factor) / constant);
  var product: f32 = start * end * ratio * ratio;
  var way: f32 = (end - start) * ratio;
  if (ratio < 1e-4) {
    return (end - start) / constant;
  }
  if (factor > 0.0) {
    return ltc_signed_angle(way, 1.0 + product) / (ratio * constant);
  }
  return ltc_atanh(clamp(way / (1.0 - product), -0.9999999, 0.9999999)) / (ratio * constant);
}

// Of (p x dp)_z/|p|^2 along the rim, from one angle to another up to a turn on; |p|^2 = C + U cos^2 +
// V sin^2 has no mixed terms.
fn ltc_arc(e: LtcEllipse, start: f32, end: f32) -> f32 {
  var p: vec2<f32> = vec2<f32>(cos(start), sin(start));
  var q: vec2<f32> = vec2<f32>(cos(end), sin(end));
  var u: f32 = dot(e.a, e.a);
  var v: f32 = dot(e.b, e.b);
  var at_u: f32 = dot(e.c, e.c) + u;
  var at_v: f32 = dot(e.c, e.c) + v;
  var of_sine: f32 = -ltc_integral_over(p.x, q.x, at_v, u - v);
  var of_cosine: f32 = ltc_integral_over(p.y, q.y, at_u, v - u);
  var root_u: f32 = sqrt(at_u);
  var root_v: f32 = sqrt(at_v);
  var before: f32 = ltc_signed_angle(p.x * p.y * (root_v - root_u), root_u * p.x * p.x +
      root_v * p.y * p.y);
  var after: f32 = ltc_signed_angle(q.x * q.y * (root_v - root_u), root_u * q.x * q.x +
      root_v * q.y * q.y);
  // As the ends of half axes are (root_u, 0) and (0, root_v) here, the angle stretches so.
  var of_one: f32 = (end - start + after - before) / (root_u * root_v);
  return cross(e.a, e.b).z * of_one + cross(e.c, e.b).z * of_cosine - cross(e.c, e.a).z * of_sine;
}

// What a half-space through the origin is on the ellipse's plane: h.x + h.y x + h.z y >= 0.
fn ltc_half_plane(e: LtcEllipse, normal: vec3<f32>) -> vec3<f32> {
  return vec3<f32>(dot(normal, e.c), dot(normal, e.a), dot(normal, e.b));
}

// Along the edge of one half-plane, within the disk and the other half-plane.
fn ltc_chord(e: LtcEllipse, h: vec3<f32>, other: vec3<f32>) -> f32 {
  var far: f32 = length(vec2<f32>(h.y, h.z));
  if (abs(h.x) >= far) {
    return 0.0;
  }
  var inward: vec2<f32> = vec2<f32>(h.y, h.z) / far;
  var along: vec2<f32> = vec2<f32>(inward.y, -inward.x);
  var middle: vec2<f32> = -h.x / far * inward;
  var reach: f32 = sqrt(max(1.0 - h.x * h.x / (far * far), 0.0));
  var start: f32 = -reach;
  var end: f32 = reach;
  var at: f32 = other.x + other.y * middle.x + other.z * middle.y;
  var slope: f32 = other.y * along.x + other.z * along.y;
  if (slope > 0.0) {
    start = max(start, -at / slope);
  }
  if (slope < 0.0) {
    end = min(end, -at / slope);
  }
  if (start >= end || (slope == 0.0 && at < 0.0)) {
    return 0.0;
  }
  var p: vec2<f32> = middle + start * along;
  var q: vec2<f32> = middle + end * along;
  return 2.0 * LTC_PI * ltc_edge(normalize(e.c + p.x * e.a + p.y * e.b),
                                 normalize(e.c + q.x * e.a + q.y * e.b));
}

// Where the rim meets a half-plane's edge; 0 and pi where it does not.
fn ltc_crossings(h: vec3<f32>) -> vec2<f32> {
  var far: f32 = length(vec2<f32>(h.y, h.z));
  if (abs(h.x) >= far) {
    return vec2<f32>(0.0, LTC_PI);
  }
  var middle: f32 = ltc_signed_angle(h.z, h.y);
  var reach: f32 = ltc_angle(sqrt(max(1.0 - h.x * h.x / (far * far), 0.0)), -h.x / far);
  var ends: vec2<f32> = vec2<f32>(middle - reach, middle + reach);
  return ends - 2.0 * LTC_PI * floor(ends / (2.0 * LTC_PI));
}

fn ltc_arc_within(e: LtcEllipse, g: vec3<f32>, h: vec3<f32>, start: f32, end: f32) -> f32 {
  var middle: f32 = 0.5 * (start + end);
  var at: vec3<f32> = vec3<f32>(1.0, cos(middle), sin(middle));
  if (start >= end || dot(g, at) < 0.0 || dot(h, at) < 0.0) {
    return 0.0;
  }
  return ltc_arc(e, start, end);
}

// The share of an ellipse in the cosine's space, cut at z = 0 and at the plane of a normal: arcs of
// its rim and chords, each in closed form.
fn ltc_cut_ellipse(ellipse: LtcEllipse, normal: vec3<f32>) -> f32 {
  var e: LtcEllipse = ltc_ellipse_principal(ellipse);
  var everywhere: vec3<f32> = vec3<f32>(1.0, 0.0, 0.0);
  var g: vec3<f32> = ltc_half_plane(e, vec3<f32>(0.0, 0.0, 1.0));
  var h: vec3<f32> = ltc_half_plane(e, normal);
  // Where the two are nearly one plane, where they meet is lost in rounding, and what lies between
  // them is next to nothing, 1e-6.
  if (length(normal.xy) < 1e-3 * normal.z) {
    h = everywhere;
  }
  var p: vec2<f32> = ltc_crossings(g);
  var q: vec2<f32> = ltc_crossings(h);
  // The four in order.
  var low: vec2<f32> = vec2<f32>(min(p.x, p.y), min(q.x, q.y));
  var high: vec2<f32> = vec2<f32>(max(p.x, p.y), max(q.x, q.y));
  var first: f32 = min(low.x, low.y);
  var last: f32 = max(high.x, high.y);
  var second: f32 = min(max(low.x, low.y), min(high.x, high.y));
  var third: f32 = max(max(low.x, low.y), min(high.x, high.y));
  var sum: f32 = ltc_arc_within(e, g, h, first, second) + ltc_arc_within(e, g, h, second, third) +
              ltc_arc_within(e, g, h, third, last) +
              ltc_arc_within(e, g, h, last, first + 2.0 * LTC_PI);
  sum += ltc_chord(e, g, h) + ltc_chord(e, h, g);
  return clamp(abs(sum) / (2.0 * LTC_PI), 0.0, 1.0);
}

// ---- Lights ----

// The ellipse center + a cos t + b sin t; a disk where a and b are of one length and upright on each
// other. Exact, cut at the surface's horizon and at the cosine's.
fn ltc_ellipse(lobe: LtcLobe, center: vec3<f32>, a: vec3<f32>, b: vec3<f32>) -> f32 {
  var c: vec3<f32> = ltc_to_cosine(lobe, center);
  var u: vec3<f32> = ltc_to_cosine(lobe, a);
  var v: vec3<f32> = ltc_to_cosine(lobe, b);
  var reach: f32 = sqrt(a.z * a.z + b.z * b.z);
  var reach_cosine: f32 = sqrt(u.z * u.z + v.z * v.z);
  if (center.z <= -reach || c.z <= -reach_cosine) {
    return 0.0;
  }
  // A common scale, so that no power of it is beyond floats.
  var scale: f32 = inverseSqrt(dot(c, c) + dot(u, u) + dot(v, v));
  if (center.z >= reach && c.z >= reach_cosine) {
    return clamp(ltc_ellipse_form(scale * c, scale * u, scale * v).z, 0.0, 1.0);
  }
  var ellipse: LtcEllipse;
  ellipse.c = scale * c;
  ellipse.a = scale * u;
  ellipse.b = scale * v;
  // p_z = (M p')_z: the surface's horizon is a plane here too.
  return ltc_cut_ellipse(ellipse, lobe.m2);
}

// Of a sphere that does not contain the shaded point: the disk of the same cone of directions.
struct LtcDisk {
  center: vec3<f32>,
  half_a: vec3<f32>,
  half_b: vec3<f32>,
}
fn ltc_disk_of_sphere(center: vec3<f32>, radius: f32) -> LtcDisk {
  var squared: f32 = dot(center, center);
  var share: f32 = 1.0 - radius * radius / squared;
  // Two directions upright on the centre's: Duff et al. 2017, "Building an Orthonormal Basis,
  // Revisited".
  var n: vec3<f32> = center / sqrt(squared);
  var side: f32 = 1.0;
  if (n.z < 0.0) {
    side = -1.0;
  }
  var p: f32 = -1.0 / (side + n.z);
  var q: f32 = n.x * n.y * p;
  var around: f32 = radius * sqrt(share);
  var disk: LtcDisk;
  disk.center = share * center;
  disk.half_a = around * vec3<f32>(1.0 + side * n.x * n.x * p, side * q, -side * n.x);
  disk.half_b = around * vec3<f32>(q, side + n.y * n.y * p, -n.y);
  return disk;
}

// A sphere that does not contain the shaded point.
fn ltc_sphere(lobe: LtcLobe, center: vec3<f32>, radius: f32) -> f32 {
  if (dot(center, center) <= radius * radius) {
    return 1.0;
  }
  var disk: LtcDisk = ltc_disk_of_sphere(center, radius);
  return ltc_ellipse(lobe, disk.center, disk.half_a, disk.half_b);
}
