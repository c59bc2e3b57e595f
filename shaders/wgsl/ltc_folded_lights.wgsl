// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_folded_lights.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a folded lobe's light that comes from disks, spheres and lines. Needs ltc_lobe,
// ltc_polygon, ltc_folded, ltc_disk, ltc_line.

// The ellipse with these half axes as the polygon of 24 corners that has its area: a fold takes no
// ellipse to an ellipse.
fn ltc_ellipse_folded(folded: LtcFoldedLobe, center: vec3<f32>, half_a: vec3<f32>,
    half_b: vec3<f32>) -> f32 {
  // Cosine and sine of 15 degrees, and what makes the areas equal.
  var c: f32 = 0.965925826;
  var s: f32 = 0.258819045;
  var at: vec2<f32> = vec2<f32>(1.0057411, 0.0);
  var outline: LtcFoldedOutline = ltc_outline_begin_folded();
  for (var i: i32 = 0; i < 24; i++) {
    outline = ltc_outline_add_folded(outline, folded, center + at.x * half_a + at.y * half_b);
    at = vec2<f32>(c * at.x - s * at.y, s * at.x + c * at.y);
  }
  return ltc_outline_share_folded(outline, folded);
}

// A sphere that does not contain the shaded point: the disk of the same cone of directions.
fn ltc_sphere_folded(folded: LtcFoldedLobe, center: vec3<f32>, radius: f32) -> f32 {
  if (dot(center, center) <= radius * radius) {
    return 1.0;
  }
  var disk: LtcDisk = ltc_disk_of_sphere(center, radius);
  return ltc_ellipse_folded(folded, disk.center, disk.half_a, disk.half_b);
}

// The part of the lobe on one piece of the fold, which is a matrix there: x < 0, -1; between the
// creases, 0; x > 0, 1.
fn ltc_folded_piece(folded: LtcFoldedLobe, side: f32) -> LtcLobe {
  var lobe: LtcLobe = folded.lobe;
  if (side == 0.0) {
    return lobe;
  }
  var piece: LtcLobe = lobe;
  var along: vec3<f32> = vec3<f32>(side, 0.0, -folded.h);
  piece.m0 = lobe.m0 + (folded.k * lobe.m0.y + folded.g * lobe.m0.z) * along;
  piece.m1 = lobe.m1 + (folded.k * lobe.m1.y + folded.g * lobe.m1.z) * along;
  piece.m2 = lobe.m2 + (folded.k * lobe.m2.y + folded.g * lobe.m2.z) * along;
  var u: vec3<f32> = ltc_unfolding(folded) * (side * lobe.w0 - folded.h * lobe.w2);
  piece.w1 = lobe.w1 - folded.k * u;
  piece.w2 = lobe.w2 - folded.g * u;
  return piece;
}

// As ltc_line, piece by piece.
fn ltc_line_folded(folded: LtcFoldedLobe, p: vec3<f32>, q: vec3<f32>, radius: f32) -> f32 {
  var a: vec3<f32> = ltc_to_cosine(folded.lobe, p);
  var b: vec3<f32> = ltc_to_cosine(folded.lobe, q);
  var sum: f32 = 0.0;
  for (var i: i32 = 0; i < 3; i++) {
    var side: f32 = f32(i) - 1.0;
    var part: vec2<f32> = vec2<f32>(0.0, 1.0);
    if (i == 1) {
      part = ltc_part_between_creases(folded, a, b);
    } else {
      part = ltc_part_above(part, side * a.x - folded.h * a.z, side * b.x - folded.h * b.z);
    }
    if (part.x < part.y) {
      sum += ltc_line(ltc_folded_piece(folded, side), p + part.x * (q - p), p + part.y * (q - p),
                      radius);
    }
  }
  return min(sum, 1.0);
}
