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

// ---- Cut by a horizon ----

// An ellipse's centre and half axes.
struct LtcEllipse {
  float3 c;
  float3 a;
  float3 b;
};

// The ellipse of the same cone whose centre and half axes are upright on each other, by turns: of the
// half axes, which leave the ellipse, and hyperbolic ones of an axis and the centre, which make the
// rays c + a and c - a of equal length and leave a a^T - c c^T. One-sided Jacobi turns keep small
// axes' digits beside large ones.
LtcEllipse ltc_ellipse_upright_on_center(LtcEllipse ellipse) {
  LtcEllipse turned = ellipse;
  float3 sum = ellipse.c + ellipse.a;
  float3 difference = ellipse.c - ellipse.a;
  float factor = sqrt(length(difference) / max(length(sum), 1e-30));
  turned.c = 0.5 * (factor * sum + difference / factor);
  turned.a = 0.5 * (factor * sum - difference / factor);
  return turned;
}
LtcEllipse ltc_ellipse_principal(LtcEllipse ellipse) {
  LtcEllipse turned = ellipse;
  for (int i = 0; i < 6; ++i) {
    float mixed = dot(turned.a, turned.b);
    if (mixed != 0.0) {
      float zeta = (dot(turned.b, turned.b) - dot(turned.a, turned.a)) / (2.0 * mixed);
      float tangent = 1.0 / (abs(zeta) + sqrt(1.0 + zeta * zeta));
      if (zeta < 0.0) {
        tangent = -tangent;
      }
      float cosine = rsqrt(1.0 + tangent * tangent);
      float3 a = turned.a;
      turned.a = cosine * (a - tangent * turned.b);
      turned.b = cosine * (tangent * a + turned.b);
    }
    turned = ltc_ellipse_upright_on_center(turned);
    LtcEllipse other;
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
float ltc_signed_angle(float y, float x) {
  float angle = ltc_angle(abs(y), x);
  if (y < 0.0) {
    return -angle;
  }
  return angle;
}

float ltc_atanh(float x) {
  float s = x * x;
  if (s < 0.04) {
    return x * (1.0 + s * (0.33333333 + s * (0.2 + s * (0.14285714 + s * 0.11111111))));
  }
  return 0.5 * log((1.0 + x) / (1.0 - x));
}

// The integral of du/(constant + factor u^2), whose denominator is positive.
float ltc_integral_over(float start, float end, float constant, float factor) {
  float ratio = sqrt(abs(factor) / constant);
  float product = start * end * ratio * ratio;
  float way = (end - start) * ratio;
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
float ltc_arc(LtcEllipse e, float start, float end) {
  float2 p = float2(cos(start), sin(start));
  float2 q = float2(cos(end), sin(end));
  float u = dot(e.a, e.a);
  float v = dot(e.b, e.b);
  float at_u = dot(e.c, e.c) + u;
  float at_v = dot(e.c, e.c) + v;
  float of_sine = -ltc_integral_over(p.x, q.x, at_v, u - v);
  float of_cosine = ltc_integral_over(p.y, q.y, at_u, v - u);
  float root_u = sqrt(at_u);
  float root_v = sqrt(at_v);
  float before = ltc_signed_angle(p.x * p.y * (root_v - root_u), root_u * p.x * p.x +
      root_v * p.y * p.y);
  float after = ltc_signed_angle(q.x * q.y * (root_v - root_u), root_u * q.x * q.x +
      root_v * q.y * q.y);
  // As the ends of half axes are (root_u, 0) and (0, root_v) here, the angle stretches so.
  float of_one = (end - start + after - before) / (root_u * root_v);
  return cross(e.a, e.b).z * of_one + cross(e.c, e.b).z * of_cosine - cross(e.c, e.a).z * of_sine;
}

// What a half-space through the origin is on the ellipse's plane: h.x + h.y x + h.z y >= 0.
float3 ltc_half_plane(LtcEllipse e, float3 normal) {
  return float3(dot(normal, e.c), dot(normal, e.a), dot(normal, e.b));
}

// Along the edge of one half-plane, within the disk and the other half-plane.
float ltc_chord(LtcEllipse e, float3 h, float3 other) {
  float far = length(float2(h.y, h.z));
  if (abs(h.x) >= far) {
    return 0.0;
  }
  float2 inward = float2(h.y, h.z) / far;
  float2 along = float2(inward.y, -inward.x);
  float2 middle = -h.x / far * inward;
  float reach = sqrt(max(1.0 - h.x * h.x / (far * far), 0.0));
  float start = -reach;
  float end = reach;
  float at = other.x + other.y * middle.x + other.z * middle.y;
  float slope = other.y * along.x + other.z * along.y;
  if (slope > 0.0) {
    start = max(start, -at / slope);
  }
  if (slope < 0.0) {
    end = min(end, -at / slope);
  }
  if (start >= end || (slope == 0.0 && at < 0.0)) {
    return 0.0;
  }
  float2 p = middle + start * along;
  float2 q = middle + end * along;
  return 2.0 * LTC_PI * ltc_edge(normalize(e.c + p.x * e.a + p.y * e.b),
                                 normalize(e.c + q.x * e.a + q.y * e.b));
}

// Where the rim meets a half-plane's edge; 0 and pi where it does not.
float2 ltc_crossings(float3 h) {
  float far = length(float2(h.y, h.z));
  if (abs(h.x) >= far) {
    return float2(0.0, LTC_PI);
  }
  float middle = ltc_signed_angle(h.z, h.y);
  float reach = ltc_angle(sqrt(max(1.0 - h.x * h.x / (far * far), 0.0)), -h.x / far);
  float2 ends = float2(middle - reach, middle + reach);
  return ends - 2.0 * LTC_PI * floor(ends / (2.0 * LTC_PI));
}

float ltc_arc_within(LtcEllipse e, float3 g, float3 h, float start, float end) {
  float middle = 0.5 * (start + end);
  float3 at = float3(1.0, cos(middle), sin(middle));
  if (start >= end || dot(g, at) < 0.0 || dot(h, at) < 0.0) {
    return 0.0;
  }
  return ltc_arc(e, start, end);
}

// The share of an ellipse in the cosine's space, cut at z = 0 and at the plane of a normal: arcs of
// its rim and chords, each in closed form.
float ltc_cut_ellipse(LtcEllipse ellipse, float3 normal) {
  LtcEllipse e = ltc_ellipse_principal(ellipse);
  float3 everywhere = float3(1.0, 0.0, 0.0);
  float3 g = ltc_half_plane(e, float3(0.0, 0.0, 1.0));
  float3 h = ltc_half_plane(e, normal);
  // Where the two are nearly one plane, where they meet is lost in rounding, and what lies between
  // them is next to nothing, 1e-6.
  if (length(normal.xy) < 1e-3 * normal.z) {
    h = everywhere;
  }
  float2 p = ltc_crossings(g);
  float2 q = ltc_crossings(h);
  // The four in order.
  float2 low = float2(min(p.x, p.y), min(q.x, q.y));
  float2 high = float2(max(p.x, p.y), max(q.x, q.y));
  float first = min(low.x, low.y);
  float last = max(high.x, high.y);
  float second = min(max(low.x, low.y), min(high.x, high.y));
  float third = max(max(low.x, low.y), min(high.x, high.y));
  float sum = ltc_arc_within(e, g, h, first, second) + ltc_arc_within(e, g, h, second, third) +
              ltc_arc_within(e, g, h, third, last) +
              ltc_arc_within(e, g, h, last, first + 2.0 * LTC_PI);
  sum += ltc_chord(e, g, h) + ltc_chord(e, h, g);
  return clamp(abs(sum) / (2.0 * LTC_PI), 0.0, 1.0);
}

// ---- Lights ----

// The ellipse center + a cos t + b sin t; a disk where a and b are of one length and upright on each
// other. Exact, cut at the surface's horizon and at the cosine's.
float ltc_ellipse(LtcLobe lobe, float3 center, float3 a, float3 b) {
  float3 c = ltc_to_cosine(lobe, center);
  float3 u = ltc_to_cosine(lobe, a);
  float3 v = ltc_to_cosine(lobe, b);
  float reach = sqrt(a.z * a.z + b.z * b.z);
  float reach_cosine = sqrt(u.z * u.z + v.z * v.z);
  if (center.z <= -reach || c.z <= -reach_cosine) {
    return 0.0;
  }
  // A common scale, so that no power of it is beyond floats.
  float scale = rsqrt(dot(c, c) + dot(u, u) + dot(v, v));
  if (center.z >= reach && c.z >= reach_cosine) {
    return clamp(ltc_ellipse_form(scale * c, scale * u, scale * v).z, 0.0, 1.0);
  }
  LtcEllipse ellipse;
  ellipse.c = scale * c;
  ellipse.a = scale * u;
  ellipse.b = scale * v;
  // p_z = (M p')_z: the surface's horizon is a plane here too.
  return ltc_cut_ellipse(ellipse, lobe.m2);
}

// Of a sphere that does not contain the shaded point: the disk of the same cone of directions.
struct LtcDisk {
  float3 center;
  float3 half_a;
  float3 half_b;
};
LtcDisk ltc_disk_of_sphere(float3 center, float radius) {
  float squared = dot(center, center);
  float share = 1.0 - radius * radius / squared;
  // Two directions upright on the centre's: Duff et al. 2017, "Building an Orthonormal Basis,
  // Revisited".
  float3 n = center / sqrt(squared);
  float side = 1.0;
  if (n.z < 0.0) {
    side = -1.0;
  }
  float p = -1.0 / (side + n.z);
  float q = n.x * n.y * p;
  float around = radius * sqrt(share);
  LtcDisk disk;
  disk.center = share * center;
  disk.half_a = around * float3(1.0 + side * n.x * n.x * p, side * q, -side * n.x);
  disk.half_b = around * float3(q, side + n.y * n.y * p, -n.y);
  return disk;
}

// A sphere that does not contain the shaded point.
float ltc_sphere(LtcLobe lobe, float3 center, float radius) {
  if (dot(center, center) <= radius * radius) {
    return 1.0;
  }
  LtcDisk disk = ltc_disk_of_sphere(center, radius);
  return ltc_ellipse(lobe, disk.center, disk.half_a, disk.half_b);
}
