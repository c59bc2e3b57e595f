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
  LtcLobe lobe;
  float k;
  float g;
  float h;
};

// fold: k, g, h.
LtcFoldedLobe ltc_folded_lobe_of(LtcLobe lobe, float3 fold) {
  LtcFoldedLobe folded;
  folded.lobe = lobe;
  folded.k = fold.x;
  folded.g = fold.y;
  folded.h = fold.z;
  return folded;
}

// By how much the fold is undone beyond a crease.
float ltc_unfolding(LtcFoldedLobe folded) { return 1.0 / (1.0 - folded.g * folded.h); }

float3 ltc_unfolded(LtcFoldedLobe folded, float3 p) {
  float u = max(abs(p.x) - folded.h * p.z, 0.0) * ltc_unfolding(folded);
  return float3(p.x, p.y - folded.k * u, p.z - folded.g * u);
}

// A direction to the space of the cosine, and from there to that of the lobe.
float3 ltc_to_cosine_folded(LtcFoldedLobe folded, float3 omega) {
  return ltc_unfolded(folded, ltc_to_cosine(folded.lobe, omega));
}
float3 ltc_from_cosine_folded(LtcFoldedLobe folded, float3 p) {
  float u = max(abs(p.x) - folded.h * p.z, 0.0);
  return ltc_from_cosine(folded.lobe, float3(p.x, p.y + folded.k * u, p.z + folded.g * u));
}

// As ltc_density and ltc_direction.
float ltc_density_folded(LtcFoldedLobe folded, float3 omega) {
  float3 p = ltc_to_cosine(folded.lobe, omega);
  float3 cosine = ltc_unfolded(folded, p);
  float squared = dot(cosine, cosine);
  float determinant = dot(folded.lobe.w0, cross(folded.lobe.w1, folded.lobe.w2));
  if (abs(p.x) > folded.h * p.z) {
    determinant = determinant * ltc_unfolding(folded);
  }
  return max(cosine.z, 0.0) * determinant / (LTC_PI * squared * squared);
}
float3 ltc_direction_folded(LtcFoldedLobe folded, float u1, float u2) {
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
  float3 p;
  float height;
  float surface;
};

LtcFoldedPoint ltc_folded_point(LtcFoldedLobe folded, float3 p, float surface) {
  LtcFoldedPoint result;
  result.p = p;
  result.height = p.z - folded.g * abs(p.x);
  result.surface = surface;
  return result;
}
LtcFoldedPoint ltc_folded_vertex(LtcFoldedLobe folded, float3 vertex) {
  float3 p = ltc_to_cosine(folded.lobe, vertex);
  float scale = rsqrt(max(dot(p, p), 1e-36));
  return ltc_folded_point(folded, scale * p, scale * vertex.z);
}

// Of what is linear along an edge and of other signs at its ends: where it is 0.
float3 ltc_between(float3 a, float3 b, float at_a, float at_b) {
  return a + abs(at_a) / (abs(at_a) + abs(at_b)) * (b - a);
}

// What an edge on one side of x = 0 has beyond the crease, and the azimuth where it meets the
// horizon.
float ltc_folded_side(LtcFoldedLobe folded, float3 a, float height_a, float3 b, float height_b,
    float side) {
  if (height_a < 0.0 && height_b < 0.0) {
    return 0.0;
  }
  // Unfolded as if all of it were beyond; x is made positive, which mirrors what is summed.
  float unfolding = ltc_unfolding(folded);
  float slide = folded.k * unfolding;
  float3 p = float3(side * a.x, a.y - slide * (side * a.x - folded.h * a.z), unfolding * height_a);
  float3 q = float3(side * b.x, b.y - slide * (side * b.x - folded.h * b.z), unfolding * height_b);
  float sum = 0.0;
  if (height_a < 0.0 || height_b < 0.0) {
    float3 horizon = ltc_between(p, q, height_a, height_b);
    horizon.z = 0.0;
    float azimuth = 0.5 / LTC_PI * ltc_angle(abs(horizon.y), horizon.x);
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
  float beyond_p = p.x - folded.h * p.z;
  float beyond_q = q.x - folded.h * q.z;
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
float2 ltc_part_above(float2 part, float at_start, float at_end) {
  float2 result = part;
  if (at_start < 0.0) {
    result.x = max(part.x, at_start / (at_start - max(at_end, 0.0)));
  }
  if (at_end < 0.0) {
    result.y = min(part.y, max(at_start, 0.0) / (max(at_start, 0.0) - at_end));
  }
  return result;
}

float2 ltc_part_between_creases(LtcFoldedLobe folded, float3 a, float3 b) {
  float2 part = float2(0.0, 1.0);
  part = ltc_part_above(part, folded.h * a.z - a.x, folded.h * b.z - b.x);
  return ltc_part_above(part, folded.h * a.z + a.x, folded.h * b.z + b.x);
}

// What an edge has between the creases.
float ltc_folded_middle(LtcFoldedLobe folded, float3 a, float3 b) {
  float2 part = ltc_part_between_creases(folded, a, b);
  if (part.x >= part.y) {
    return 0.0;
  }
  return ltc_edge(a + part.x * (b - a), a + part.y * (b - a));
}

float ltc_folded_edge(LtcFoldedLobe folded, LtcFoldedPoint a, LtcFoldedPoint b) {
  float side = 1.0;
  if (a.p.x < 0.0) {
    side = -1.0;
  }
  float sum = ltc_folded_middle(folded, a.p, b.p);
  if ((a.p.x < 0.0) == (b.p.x < 0.0)) {
    return sum + ltc_folded_side(folded, a.p, a.height, b.p, b.height, side);
  }
  float3 c = ltc_between(a.p, b.p, a.p.x, b.p.x);
  c.x = 0.0;
  sum += ltc_folded_side(folded, a.p, a.height, c, c.z, side);
  sum += ltc_folded_side(folded, c, c.z, b.p, b.height, -side);
  // The ways along x = 0 lead from one such place to the next, by turns on either side: a quarter of
  // a turn each for those that pass the y-axis, as the sum of what lies below, or above, says. Taken
  // is which of the two knows by its own y what end of the y-axis that is.
  bool below = c.z < 0.0;
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
float ltc_below_horizon_folded(LtcFoldedLobe folded) {
  float3 normal = normalize(folded.lobe.m2);
  float3 axis = float3(1.0, 0.0, 0.0);
  if (abs(normal.x) > 0.6) {
    axis = float3(0.0, 1.0, 0.0);
  }
  float3 along = normalize(cross(normal, axis));
  float3 across = cross(normal, along);
  LtcFoldedPoint a = ltc_folded_point(folded, along, 0.0);
  LtcFoldedPoint b = ltc_folded_point(folded, across, 0.0);
  LtcFoldedPoint c = ltc_folded_point(folded, -along, 0.0);
  LtcFoldedPoint d = ltc_folded_point(folded, -across, 0.0);
  float above = ltc_folded_edge(folded, a, b) + ltc_folded_edge(folded, b, c) +
                ltc_folded_edge(folded, c, d) + ltc_folded_edge(folded, d, a);
  return clamp(1.0 - above, 0.0, 1.0);
}

// As ltc_horizon_factor.
float ltc_horizon_factor_folded(LtcFoldedLobe folded) {
  return 1.0 / max(1.0 - ltc_below_horizon_folded(folded), 0.0625);
}

// ---- Polygons ----

// A polygon in the making, as LtcOutline: ltc_outline_begin_folded, ltc_outline_add_folded for each
// vertex in order, ltc_outline_share_folded. "left": where it went below the surface's horizon last;
// "entered": where it came up from there, if it began below.
struct LtcFoldedOutline {
  LtcFoldedPoint first;
  LtcFoldedPoint last;
  int count;
  LtcFoldedPoint left;
  int left_count;
  LtcFoldedPoint entered;
  int entered_count;
  float sum;
};

LtcFoldedOutline ltc_outline_begin_folded() {
  LtcFoldedPoint none;
  none.p = float3(0.0, 0.0, 0.0);
  none.height = 0.0;
  none.surface = 0.0;
  LtcFoldedOutline outline;
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
LtcFoldedPoint ltc_folded_at_surface(LtcFoldedLobe folded, LtcFoldedPoint a, LtcFoldedPoint b) {
  return ltc_folded_point(folded, ltc_between(a.p, b.p, a.surface, b.surface), 0.0);
}

// The edge from `last`, without what is below the surface's horizon, and what closes it there.
LtcFoldedOutline ltc_outline_edge_folded(LtcFoldedOutline before, LtcFoldedLobe folded,
    LtcFoldedPoint to) {
  LtcFoldedOutline outline = before;
  LtcFoldedPoint a = before.last;
  LtcFoldedPoint b = to;
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
LtcFoldedOutline ltc_outline_add_folded(LtcFoldedOutline before, LtcFoldedLobe folded,
    float3 vertex) {
  LtcFoldedOutline outline = before;
  LtcFoldedPoint next = ltc_folded_vertex(folded, vertex);
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
float ltc_outline_share_folded(LtcFoldedOutline before, LtcFoldedLobe folded) {
  LtcFoldedOutline outline = before;
  if (outline.count > 0) {
    outline = ltc_outline_edge_folded(outline, folded, outline.first);
  }
  if (outline.entered_count > 0) {
    outline.sum += ltc_folded_edge(folded, outline.left, outline.entered);
  }
  return min(abs(outline.sum), 1.0);
}

// What is seen of an edge, `at` being where it meets the surface's horizon if it does.
float ltc_folded_seen_edge(LtcFoldedLobe folded, LtcFoldedPoint a, LtcFoldedPoint at,
    LtcFoldedPoint b) {
  if (a.surface < 0.0 && b.surface < 0.0) {
    return 0.0;
  }
  LtcFoldedPoint start = a;
  LtcFoldedPoint end = b;
  if (a.surface < 0.0) {
    start = at;
  }
  if (b.surface < 0.0) {
    end = at;
  }
  return ltc_folded_edge(folded, start, end);
}

// A quad whatever cuts it.
float ltc_folded_cut_quad(LtcFoldedLobe folded, LtcFoldedPoint a, LtcFoldedPoint b,
    LtcFoldedPoint c, LtcFoldedPoint d) {
  LtcFoldedPoint ab = ltc_folded_at_surface(folded, a, b);
  LtcFoldedPoint bc = ltc_folded_at_surface(folded, b, c);
  LtcFoldedPoint cd = ltc_folded_at_surface(folded, c, d);
  LtcFoldedPoint da = ltc_folded_at_surface(folded, d, a);
  float sum = ltc_folded_seen_edge(folded, a, ab, b) + ltc_folded_seen_edge(folded, b, bc, c) +
              ltc_folded_seen_edge(folded, c, cd, d) + ltc_folded_seen_edge(folded, d, da, a);
  bool above_a = a.surface >= 0.0;
  bool above_b = b.surface >= 0.0;
  bool above_c = c.surface >= 0.0;
  bool above_d = d.surface >= 0.0;
  // What closes it along the surface's horizon: from where it goes below to where it comes up.
  LtcFoldedPoint left = da;
  LtcFoldedPoint entered = ab;
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
  int count = 1;
  if (above_a == above_c && above_b == above_d) {
    count = 2;
    if (above_a == above_b) {
      count = 0;
    }
  }
  for (int i = 0; i < count; ++i) {
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

float ltc_least(float4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

// Four vertices in order; nothing is cut where all of it is above both horizons and on one piece of
// the fold.
float ltc_quad_folded(LtcFoldedLobe folded, float3 p0, float3 p1, float3 p2, float3 p3) {
  LtcFoldedPoint a = ltc_folded_vertex(folded, p0);
  LtcFoldedPoint b = ltc_folded_vertex(folded, p1);
  LtcFoldedPoint c = ltc_folded_vertex(folded, p2);
  LtcFoldedPoint d = ltc_folded_vertex(folded, p3);
  float4 x = float4(a.p.x, b.p.x, c.p.x, d.p.x);
  float4 z = float4(a.p.z, b.p.z, c.p.z, d.p.z);
  float4 surface = float4(p0.z, p1.z, p2.z, p3.z);
  float4 height = float4(a.height, b.height, c.height, d.height);
  float4 right = x - folded.h * z;
  float4 left = -x - folded.h * z;
  bool one_piece = max(ltc_least(right), ltc_least(left)) >= 0.0 || ltc_least(-max(right,
      left)) >= 0.0;
  if (one_piece && ltc_least(min(height, surface)) >= 0.0) {
    float3 e = ltc_unfolded(folded, a.p);
    float3 f = ltc_unfolded(folded, b.p);
    float3 g = ltc_unfolded(folded, c.p);
    float3 h = ltc_unfolded(folded, d.p);
    float sum = ltc_edge(e, f) + ltc_edge(f, g) + ltc_edge(g, h) + ltc_edge(h, e);
    return min(abs(sum), 1.0);
  }
  // What the cosine reaches is in z >= min(g, 0) |x|.
  if (ltc_least(-surface) >= 0.0 || ltc_least(min(folded.g, 0.0) * abs(x) - z) >= 0.0) {
    return 0.0;
  }
  return min(abs(ltc_folded_cut_quad(folded, a, b, c, d)), 1.0);
}
