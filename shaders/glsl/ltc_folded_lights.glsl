// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The share of a folded lobe's light that comes from disks, spheres and lines. Needs ltc_lobe,
// ltc_polygon, ltc_folded, ltc_disk, ltc_line.

// The ellipse with these half axes as the polygon of 24 corners that has its area: a fold takes no
// ellipse to an ellipse.
float ltc_ellipse_folded(LtcFoldedLobe folded, vec3 center, vec3 half_a, vec3 half_b) {
  // Cosine and sine of 15 degrees, and what makes the areas equal.
  float c = 0.965925826;
  float s = 0.258819045;
  vec2 at = vec2(1.0057411, 0.0);
  LtcFoldedOutline outline = ltc_outline_begin_folded();
  for (int i = 0; i < 24; ++i) {
    outline = ltc_outline_add_folded(outline, folded, center + at.x * half_a + at.y * half_b);
    at = vec2(c * at.x - s * at.y, s * at.x + c * at.y);
  }
  return ltc_outline_share_folded(outline, folded);
}

// A sphere that does not contain the shaded point: the disk of the same cone of directions.
float ltc_sphere_folded(LtcFoldedLobe folded, vec3 center, float radius) {
  if (dot(center, center) <= radius * radius) {
    return 1.0;
  }
  LtcDisk disk = ltc_disk_of_sphere(center, radius);
  return ltc_ellipse_folded(folded, disk.center, disk.half_a, disk.half_b);
}

// The part of the lobe on one piece of the fold, which is a matrix there: x < 0, -1; between the
// creases, 0; x > 0, 1.
LtcLobe ltc_folded_piece(LtcFoldedLobe folded, float side) {
  LtcLobe lobe = folded.lobe;
  if (side == 0.0) {
    return lobe;
  }
  LtcLobe piece = lobe;
  vec3 along = vec3(side, 0.0, -folded.h);
  piece.m0 = lobe.m0 + (folded.k * lobe.m0.y + folded.g * lobe.m0.z) * along;
  piece.m1 = lobe.m1 + (folded.k * lobe.m1.y + folded.g * lobe.m1.z) * along;
  piece.m2 = lobe.m2 + (folded.k * lobe.m2.y + folded.g * lobe.m2.z) * along;
  vec3 u = ltc_unfolding(folded) * (side * lobe.w0 - folded.h * lobe.w2);
  piece.w1 = lobe.w1 - folded.k * u;
  piece.w2 = lobe.w2 - folded.g * u;
  return piece;
}

// As ltc_line, piece by piece.
float ltc_line_folded(LtcFoldedLobe folded, vec3 p, vec3 q, float radius) {
  vec3 a = ltc_to_cosine(folded.lobe, p);
  vec3 b = ltc_to_cosine(folded.lobe, q);
  float sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    float side = float(i) - 1.0;
    vec2 part = vec2(0.0, 1.0);
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
