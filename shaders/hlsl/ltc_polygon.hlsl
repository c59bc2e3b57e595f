// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_polygon.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// The share of a lobe's light that comes from a polygon: equation (11) of Heitz et al. 2016,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines". Exact: the polygon is cut at
// the surface's horizon, below which nothing is seen, and, transformed, at the cosine's. Flat or
// bent, convex or not (a star), of either winding. Needs ltc_lobe.

// What an edge between two unit vectors adds: half of its angle, times the z of its normal, over pi.
float ltc_edge(float3 a, float3 b) {
  float3 normal = cross(a, b);
  float sine = length(normal);
  if (sine <= 0.0) {
    return 0.0;
  }
  return 0.5 / LTC_PI * normal.z * (ltc_angle(sine, dot(a, b)) / sine);
}

// A polygon in the making, vertex by vertex: ltc_outline_begin, ltc_outline_add for each in order,
// ltc_outline_share. "v": the vertices; "w": what stands above the surface's horizon, in the space
// of the cosine; "x": what of that stands above the cosine's.
struct LtcOutline {
  float3 v_first;
  float3 v_last;
  int v_count;
  float3 w_first;
  float3 w_last;
  int w_count;
  float3 x_first;
  float3 x_last;
  int x_count;
  float sum;
};

LtcOutline ltc_outline_begin() {
  float3 none = float3(0.0, 0.0, 0.0);
  LtcOutline outline;
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

LtcOutline ltc_outline_x(LtcOutline before, float3 x) {
  LtcOutline outline = before;
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
float3 ltc_at_horizon(float3 a, float3 b) {
  float3 between = abs(b.z) * a + abs(a.z) * b;
  return normalize(float3(between.x, between.y, 0.0));
}

// The edge from w_last.
LtcOutline ltc_outline_w_edge(LtcOutline before, float3 w) {
  LtcOutline outline = before;
  float3 a = outline.w_last;
  if (a.z >= 0.0) {
    outline = ltc_outline_x(outline, a);
  }
  if (a.z * w.z < 0.0) {
    outline = ltc_outline_x(outline, ltc_at_horizon(a, w));
  }
  return outline;
}

LtcOutline ltc_outline_w(LtcOutline before, float3 w) {
  LtcOutline outline = before;
  if (outline.w_count > 0) {
    outline = ltc_outline_w_edge(outline, w);
  } else {
    outline.w_first = w;
  }
  outline.w_last = w;
  outline.w_count += 1;
  return outline;
}

LtcOutline ltc_outline_v_edge(LtcOutline before, LtcLobe lobe, float3 v) {
  LtcOutline outline = before;
  float3 a = outline.v_last;
  if (a.z >= 0.0) {
    outline = ltc_outline_w(outline, normalize(ltc_to_cosine(lobe, a)));
  }
  if (a.z * v.z < 0.0) {
    outline = ltc_outline_w(outline, normalize(ltc_to_cosine(lobe, ltc_at_horizon(a, v))));
  }
  return outline;
}

// A vertex, of any length but 0.
LtcOutline ltc_outline_add(LtcOutline before, LtcLobe lobe, float3 vertex) {
  LtcOutline outline = before;
  float3 v = normalize(vertex);
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
float ltc_outline_signed_share(LtcOutline before, LtcLobe lobe) {
  LtcOutline outline = before;
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
float ltc_outline_share(LtcOutline outline, LtcLobe lobe) {
  return abs(ltc_outline_signed_share(outline, lobe));
}

// Four vertices in order; nothing is cut where all of it is above both horizons.
float ltc_quad(LtcLobe lobe, float3 p0, float3 p1, float3 p2, float3 p3) {
  float3 a = ltc_to_cosine(lobe, p0);
  float3 b = ltc_to_cosine(lobe, p1);
  float3 c = ltc_to_cosine(lobe, p2);
  float3 d = ltc_to_cosine(lobe, p3);
  float lowest = min(min(min(p0.z, p1.z), min(p2.z, p3.z)), min(min(a.z, b.z), min(c.z, d.z)));
  if (lowest >= 0.0) {
    float3 e = normalize(a);
    float3 f = normalize(b);
    float3 g = normalize(c);
    float3 h = normalize(d);
    float sum = ltc_edge(e, f) + ltc_edge(f, g) + ltc_edge(g, h) + ltc_edge(h, e);
    return min(abs(sum), 1.0);
  }
  if (max(max(p0.z, p1.z), max(p2.z, p3.z)) <= 0.0 ||
      max(max(a.z, b.z), max(c.z, d.z)) <= 0.0) {
    return 0.0;
  }
  LtcOutline outline = ltc_outline_begin();
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
float ltc_clipped_sphere(float3 form) {
  float squared = min(length(form), 1.0);
  if (squared <= 0.0) {
    return 0.0;
  }
  float c = form.z / squared;
  float s = sqrt(max(1.0 - c * c, 0.0));
  if (c * c >= squared || s <= 0.0) {
    return squared * max(c, 0.0);
  }
  float x = sqrt(max(1.0 / squared - 1.0, 0.0));
  float y = clamp(-x * c / s, -1.0, 1.0);
  float root = s * sqrt(max(1.0 - y * y, 0.0));
  float arc = ltc_angle(sqrt(max(1.0 - y * y, 0.0)), y);
  return clamp(((c * arc - x * root) * squared + ltc_angle(root, x)) / LTC_PI, 0.0, 1.0);
}

float3 ltc_edge_vector(float3 a, float3 b) {
  float3 normal = cross(a, b);
  float sine = length(normal);
  if (sine <= 0.0) {
    return float3(0.0, 0.0, 0.0);
  }
  return 0.5 / LTC_PI * (ltc_angle(sine, dot(a, b)) / sine) * normal;
}

// A quad, as if it were the sphere of the same form factor: not cut, no branch by horizon. Off by up
// to 0.1 of the light where the horizon cuts it (docs/shading.md), exact where it does not.
float ltc_quad_as_sphere(LtcLobe lobe, float3 p0, float3 p1, float3 p2, float3 p3) {
  float3 a = normalize(ltc_to_cosine(lobe, p0));
  float3 b = normalize(ltc_to_cosine(lobe, p1));
  float3 c = normalize(ltc_to_cosine(lobe, p2));
  float3 d = normalize(ltc_to_cosine(lobe, p3));
  float3 form = ltc_edge_vector(a, b) + ltc_edge_vector(b, c) + ltc_edge_vector(c, d) +
              ltc_edge_vector(d, a);
  // Away from the light's back, whatever the winding.
  if (dot(form, a + b + c + d) < 0.0) {
    form = -form;
  }
  return ltc_clipped_sphere(form);
}
