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
float3 ltc_ellipse_form(float3 c, float3 a, float3 b) {
  float3 ab = cross(a, b);
  float3 bc = cross(b, c);
  float3 ca = cross(c, a);
  float determinant = dot(ab, c);
  float trace = dot(a, a) + dot(b, b) - dot(c, c);
  float minors = dot(ab, ab) - dot(bc, bc) - dot(ca, ca);
  // p(mu) = mu^3 - trace mu^2 + minors mu + determinant^2
  float mu = -dot(c, c);
  if (trace > 0.0) {
    float root = sqrt(minors * minors + 4.0 * trace * determinant * determinant);
    float bound = (minors - root) / (2.0 * trace);
    if (minors > 0.0) {
      bound = -2.0 * determinant * determinant / (minors + root);
    }
    mu = max(mu, bound);
  }
  for (int i = 0; i < 4; ++i) {
    float value = ((mu - trace) * mu + minors) * mu + determinant * determinant;
    float slope = (3.0 * mu - 2.0 * trace) * mu + minors;
    float bend = 6.0 * mu - 2.0 * trace;
    float root = sqrt(max(4.0 * slope * slope - 6.0 * value * bend, 0.0));
    mu = mu - 3.0 * value / max(slope + root, 1e-30);
  }
  mu = min(mu, -1e-30);
  float slope = max((3.0 * mu - 2.0 * trace) * mu + minors, 1e-30);
  // adj(N - mu) c = p'(mu) (e.c) e: of the columns' adjugate, e's direction.
  float3 n0 = a.x * a + b.x * b - c.x * c - float3(mu, 0.0, 0.0);
  float3 n1 = a.y * a + b.y * b - c.y * c - float3(0.0, mu, 0.0);
  float3 n2 = a.z * a + b.z * b - c.z * c - float3(0.0, 0.0, mu);
  float3 axis = c.x * cross(n1, n2) + c.y * cross(n2, n0) + c.z * cross(n0, n1);
  float form = abs(determinant) / sqrt(-mu * slope);
  return min(form, 1.0) * normalize(axis);
}

// The ellipse center + a cos t + b sin t; a disk where a and b are of one length and upright on each
// other. Exact where it lies above both horizons. Where one cuts it, a polygon of 64 edges and the
// same area stands for it: within 2e-4 in 99 of 100 cases, and at worst 4e-3, where the disk all but
// touches the point.
float ltc_ellipse(LtcLobe lobe, float3 center, float3 a, float3 b) {
  float3 c = ltc_to_cosine(lobe, center);
  float3 u = ltc_to_cosine(lobe, a);
  float3 v = ltc_to_cosine(lobe, b);
  float reach = sqrt(a.z * a.z + b.z * b.z);
  float reach_cosine = sqrt(u.z * u.z + v.z * v.z);
  if (center.z <= -reach || c.z <= -reach_cosine) {
    return 0.0;
  }
  if (center.z >= reach && c.z >= reach_cosine) {
    // A common scale, so that no power of it is beyond floats.
    float scale = 1.0 / sqrt(dot(c, c) + dot(u, u) + dot(v, v));
    return clamp(ltc_ellipse_form(scale * c, scale * u, scale * v).z, 0.0, 1.0);
  }
  LtcOutline outline = ltc_outline_begin();
  float c_turn = 1.0;
  float s_turn = 0.0;
  for (int i = 0; i < 64; ++i) {
    // cos and sin of pi/32; 1.0008038 = sqrt((pi/32) / sin(pi/32)) brings the area to the disk's.
    outline = ltc_outline_add(outline, lobe,
                              center + 1.0008038 * (c_turn * a + s_turn * b));
    float next = 0.995184727 * c_turn - 0.098017140 * s_turn;
    s_turn = 0.098017140 * c_turn + 0.995184727 * s_turn;
    c_turn = next;
  }
  return ltc_outline_share(outline, lobe);
}

// A sphere that does not contain the shaded point: the disk of the same cone of directions.
float ltc_sphere(LtcLobe lobe, float3 center, float radius) {
  float squared = dot(center, center);
  float share = 1.0 - radius * radius / squared;
  if (share <= 0.0) {
    return 1.0;
  }
  // Two directions upright on the centre's: Duff et al. 2017, "Building an Orthonormal Basis,
  // Revisited".
  float3 n = center / sqrt(squared);
  float side = 1.0;
  if (n.z < 0.0) {
    side = -1.0;
  }
  float p = -1.0 / (side + n.z);
  float q = n.x * n.y * p;
  float disk = radius * sqrt(share);
  float3 a = disk * float3(1.0 + side * n.x * n.x * p, side * q, -side * n.x);
  float3 b = disk * float3(q, side + n.y * n.y * p, -n.y);
  return ltc_ellipse(lobe, share * center, a, b);
}
