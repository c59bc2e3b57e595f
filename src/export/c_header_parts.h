// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the C header of a table or field consists of beside its look-up: head, accessors, polygons
// of plain or of folded lobes, tail.
#pragma once

#include <string_view>

namespace ltc::c_header {

inline constexpr std::string_view head =
    R"(/* Linearly transformed cosines of {brdf}, by {generator}.
   {what}
   One header, C99 or C++, no dependency but the C library. Directions and points are of the tangent
   frame: z the surface normal, x the direction of alpha_x. Shading with a light's polygon is
     radiance * (F0 * ltc_amplitude(&lobe) + (1 - F0) * ltc_fresnel(&lobe)) * ltc_polygon(...). */
#ifndef LTC_LOOK_UP_H
#define LTC_LOOK_UP_H

#include <math.h>

/* What a look-up gives: M, row-major, clamped cosine to lobe, of positive determinant{fold}. */
typedef struct ltc_lobe {{
  float m[9];
  float amplitude, fresnel;{members}
}} ltc_lobe;

)";

inline constexpr std::string_view accessors = R"(
static inline void ltc_matrix(const ltc_lobe *lobe, float m[9]) {
  int i;
  for (i = 0; i < 9; ++i) m[i] = lobe->m[i];
}

/* The integral of BRDF times cosine with F = 1, and that of its part by Schlick's (1 - v.h)^5. */
static inline float ltc_amplitude(const ltc_lobe *lobe) { return lobe->amplitude; }
static inline float ltc_fresnel(const ltc_lobe *lobe) { return lobe->fresnel; }

/* Share of the lobe's light that comes from a flat or bent polygon of `count` vertices in order, in
   [0, 1]: any winding; what lies below the horizon is cut off, as the surface sees none of it.
   Equation 11 of Heitz et al. 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed
   Cosines". */
static inline float ltc_polygon(const ltc_lobe *lobe, const float (*vertices)[3], int count);

/* The adjugate, which is the inverse but for the determinant; and that. */
static inline double ltc_adjugate(const float m[9], double adjugate[9]) {
  int i, j;
  for (i = 0; i < 3; ++i)
    for (j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      adjugate[3 * i + j] =
          (double)m[3 * r + c] * m[3 * s + d] - (double)m[3 * r + d] * m[3 * s + c];
    }
  return m[0] * adjugate[0] + m[1] * adjugate[3] + m[2] * adjugate[6];
}
static inline void ltc_times(const double matrix[9], const double v[3], double out[3]) {
  int i;
  for (i = 0; i < 3; ++i)
    out[i] = matrix[3 * i] * v[0] + matrix[3 * i + 1] * v[1] + matrix[3 * i + 2] * v[2];
}

static inline void ltc_unit(double v[3]) {
  const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  int i;
  for (i = 0; i < 3; ++i) v[i] = length > 0 ? v[i] / length : 0;
}

/* Of Lambert's formula what an edge adds, half of theta times the z of its normal. */
static inline double ltc_edge(const double a[3], const double b[3]) {
  const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double n[3] = {a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2],
                       a[0] * d[1] - a[1] * d[0]};
  const double sine = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return sine > 0 ? 0.5 * n[2] * atan2(sine, cosine) / sine : 0;
}
)";

inline constexpr std::string_view plain_polygon =
    R"(/* The directions of count points, those below z = 0 cut off; of up to 2 count results how many. */
static inline int ltc_clip_edge(const double from[3], const double to[3], double (*out)[3]) {
  int made = 0, i;
  if (from[2] >= 0) {
    for (i = 0; i < 3; ++i) out[made][i] = from[i];
    ++made;
  }
  if ((from[2] > 0 && to[2] < 0) || (from[2] < 0 && to[2] > 0)) {
    const double a = fabs(to[2]), b = fabs(from[2]);
    for (i = 0; i < 2; ++i) out[made][i] = a * from[i] + b * to[i];
    out[made][2] = 0;
    ++made;
  }
  return made;
}

/* An edge of the clipped polygon into the space of the cosine, clipped there, and its integral;
   `first` and `last` are the ends of what stands above the horizon so far. */
typedef struct ltc_outline {
  double first[3], last[3], sum;
  int points;
} ltc_outline;
static inline void ltc_outline_add(ltc_outline *outline, const double point[3]) {
  int i;
  if (outline->points++ > 0)
    outline->sum += ltc_edge(outline->last, point);
  else
    for (i = 0; i < 3; ++i) outline->first[i] = point[i];
  for (i = 0; i < 3; ++i) outline->last[i] = point[i];
}

static inline float ltc_polygon(const ltc_lobe *lobe, const float (*vertices)[3], int count) {
  double inverse[9]; /* but for a factor, which no direction feels */
  double above[4][3], cosine[3], before[3] = {0, 0, 0}, first[3] = {0, 0, 0}, cut[2][3];
  ltc_outline outline = {{0, 0, 0}, {0, 0, 0}, 0, 0};
  int i, j, k, n, have = 0;
  float share;
  ltc_adjugate(lobe->m, inverse);
  for (i = 0; i < count; ++i) {
    double from[3], to[3];
    for (j = 0; j < 3; ++j) {
      from[j] = vertices[i][j];
      to[j] = vertices[(i + 1) % count][j];
    }
    ltc_unit(from);
    ltc_unit(to);
    n = ltc_clip_edge(from, to, above);
    for (k = 0; k < n; ++k) {
      ltc_times(inverse, above[k], cosine);
      ltc_unit(cosine);
      if (have) {
        const int made = ltc_clip_edge(before, cosine, cut);
        for (j = 0; j < made; ++j) {
          ltc_unit(cut[j]);
          ltc_outline_add(&outline, cut[j]);
        }
      } else {
        for (j = 0; j < 3; ++j) first[j] = cosine[j];
        have = 1;
      }
      for (j = 0; j < 3; ++j) before[j] = cosine[j];
    }
  }
  if (have) {
    const int made = ltc_clip_edge(before, first, cut);
    for (j = 0; j < made; ++j) {
      ltc_unit(cut[j]);
      ltc_outline_add(&outline, cut[j]);
    }
  }
  if (outline.points > 0) outline.sum += ltc_edge(outline.last, outline.first);
  share = (float)fabs(outline.sum / 3.14159265358979323846);
  return share < 1 ? share : 1;
}

/* No fold (docs/folded.md) is done or undone. */
static inline double ltc_unfold(const ltc_lobe *lobe, double p[3]) {
  (void)lobe, (void)p;
  return 1;
}
static inline void ltc_fold(const ltc_lobe *lobe, float p[3]) { (void)lobe, (void)p; }
)";

inline constexpr std::string_view folded_polygon = R"(/* What undoes the fold beyond a crease. */
static inline double ltc_unfolding(const ltc_lobe *lobe) {
  return 1 / (1 - (double)lobe->g * lobe->h);
}

/* Where what is linear along an edge, and of other signs at its ends, is 0. */
static inline void ltc_between(const double a[3], const double b[3], double at_a, double at_b,
                               double out[3]) {
  const double s = fabs(at_b) / (fabs(at_a) + fabs(at_b)), t = fabs(at_a) / (fabs(at_a) + fabs(at_b));
  int i;
  for (i = 0; i < 3; ++i) out[i] = s * a[i] + t * b[i];
}

/* Of an edge in the space of the folded cosine, on one side of x = 0: what is beyond its crease, and
   the azimuth where it meets the horizon; `height` is above that. */
static inline double ltc_edge_beyond(const ltc_lobe *lobe, const double a[3], double height_a,
                                     const double b[3], double height_b, double side) {
  const double unfolding = ltc_unfolding(lobe), slide = lobe->k * unfolding;
  double p[3], q[3], beyond_p, beyond_q, sum = 0;
  if (height_a < 0 && height_b < 0) return 0;
  p[0] = side * a[0], q[0] = side * b[0];
  p[1] = a[1] - slide * (p[0] - lobe->h * a[2]), q[1] = b[1] - slide * (q[0] - lobe->h * b[2]);
  p[2] = unfolding * height_a, q[2] = unfolding * height_b;
  if (height_a < 0 || height_b < 0) {
    double *const at = height_a < 0 ? p : q;
    double horizon[3];
    ltc_between(p, q, height_a, height_b, horizon);
    at[0] = horizon[0], at[1] = horizon[1], at[2] = 0;
    sum = (height_a < 0 ? 0.5 : -0.5) * atan2(at[1], at[0]);
  }
  beyond_p = p[0] - lobe->h * p[2], beyond_q = q[0] - lobe->h * q[2];
  if (beyond_p > 0 || beyond_q > 0) {
    if (beyond_p < 0) ltc_between(p, q, beyond_p, beyond_q, p);
    if (beyond_q < 0) ltc_between(p, q, beyond_p, beyond_q, q);
    sum += ltc_edge(p, q);
  }
  return side * sum;
}

/* And what is between the creases: [start, end] of the edge. */
static inline void ltc_cut(double at_a, double at_b, double *start, double *end) {
  if (at_a < 0) *start = fmax(*start, at_a / (at_a - fmax(at_b, 0)));
  if (at_b < 0) *end = fmin(*end, fmax(at_a, 0) / (fmax(at_a, 0) - at_b));
}
static inline double ltc_edge_between(const ltc_lobe *lobe, const double a[3], const double b[3]) {
  double start = 0, end = 1, p[3], q[3];
  int i;
  ltc_cut(lobe->h * a[2] - a[0], lobe->h * b[2] - b[0], &start, &end);
  ltc_cut(lobe->h * a[2] + a[0], lobe->h * b[2] + b[0], &start, &end);
  if (start >= end) return 0;
  for (i = 0; i < 3; ++i) {
    p[i] = a[i] + start * (b[i] - a[i]);
    q[i] = a[i] + end * (b[i] - a[i]);
  }
  return ltc_edge(p, q);
}

/* An edge of what stands above the surface. Where it crosses x = 0, the outlines of the two sides go
   on along it, from one such place to the next, a quarter of a turn each where they pass the y-axis:
   the sum of those that lie below, or above, tells. */
static inline double ltc_folded_edge(const ltc_lobe *lobe, const double a[3], const double b[3]) {
  const double height_a = a[2] - lobe->g * fabs(a[0]), height_b = b[2] - lobe->g * fabs(b[0]);
  const double side = a[0] < 0 ? -1 : 1;
  double c[3], sum = ltc_edge_between(lobe, a, b);
  if ((a[0] < 0) == (b[0] < 0)) return sum + ltc_edge_beyond(lobe, a, height_a, b, height_b, side);
  ltc_between(a, b, a[0], b[0], c);
  c[0] = 0;
  sum += ltc_edge_beyond(lobe, a, height_a, c, c[2], side) +
         ltc_edge_beyond(lobe, c, c[2], b, height_b, -side);
  if ((c[2] < 0) == (lobe->m[8] > 0))
    sum += ((c[2] < 0) == (c[1] > 0) ? 0.5 : -0.5) * 3.14159265358979323846 * side;
  return sum;
}

static inline float ltc_polygon(const ltc_lobe *lobe, const float (*vertices)[3], int count) {
  double inverse[9]; /* but for a factor, which no direction feels */
  double a[3], b[3], from[3], to[3], left[3], entered[3], sum = 0;
  int i, j, has_left = 0, has_entered = 0;
  ltc_adjugate(lobe->m, inverse);
  for (i = 0; i < count; ++i) {
    const float *const v = vertices[i], *const w = vertices[(i + 1) % count];
    double p[3], q[3];
    if (v[2] < 0 && w[2] < 0) continue;
    for (j = 0; j < 3; ++j) p[j] = v[j], q[j] = w[j];
    ltc_times(inverse, p, from);
    ltc_times(inverse, q, to);
    for (j = 0; j < 3; ++j) a[j] = from[j], b[j] = to[j];
    /* Cut at the surface's horizon, along which the outline is closed. */
    if (w[2] < 0) {
      ltc_between(from, to, v[2], w[2], b);
      for (j = 0; j < 3; ++j) left[j] = b[j];
      has_left = 1;
    }
    if (v[2] < 0) {
      ltc_between(from, to, v[2], w[2], a);
      if (has_left)
        sum += ltc_folded_edge(lobe, left, a);
      else
        for (j = 0; j < 3; ++j) entered[j] = a[j];
      has_entered = has_entered || !has_left;
    }
    sum += ltc_folded_edge(lobe, a, b);
  }
  if (has_entered) sum += ltc_folded_edge(lobe, left, entered);
  sum = fabs(sum / 3.14159265358979323846);
  return (float)(sum < 1 ? sum : 1);
}

/* Undoes the fold of a direction; the factor that volumes get by it. */
static inline double ltc_unfold(const ltc_lobe *lobe, double p[3]) {
  const double beyond = fabs(p[0]) - lobe->h * p[2], unfolding = ltc_unfolding(lobe);
  if (beyond <= 0) return 1;
  p[1] -= lobe->k * unfolding * beyond;
  p[2] -= lobe->g * unfolding * beyond;
  return unfolding;
}
static inline void ltc_fold(const ltc_lobe *lobe, float p[3]) {
  const float beyond = fabsf(p[0]) - lobe->h * p[2];
  if (beyond <= 0) return;
  p[1] += lobe->k * beyond;
  p[2] += lobe->g * beyond;
}
)";

inline constexpr std::string_view tail = R"(
/* Its density per steradian at a unit direction: of the lobe, whose whole is 1 over the sphere. */
static inline float ltc_density(const ltc_lobe *lobe, const float omega[3]) {
  const double direction[3] = {omega[0], omega[1], omega[2]};
  double inverse[9], p[3], determinant, squared, factor;
  determinant = ltc_adjugate(lobe->m, inverse);
  ltc_times(inverse, direction, p);
  factor = ltc_unfold(lobe, p);
  squared = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  if (!(p[2] > 0)) return 0;
  return (float)(p[2] * determinant * determinant * factor /
                 (3.14159265358979323846 * squared * squared));
}

/* A unit direction distributed as the lobe (it may be below the horizon), from two numbers in
   [0, 1). */
static inline void ltc_sample(const ltc_lobe *lobe, float u1, float u2, float omega[3]) {
  const float radius = sqrtf(u1), angle = 6.28318530717958648f * u2;
  const float *const m = lobe->m;
  float p[3], length = 0;
  int i;
  p[0] = radius * cosf(angle);
  p[1] = radius * sinf(angle);
  p[2] = sqrtf(u1 < 1 ? 1 - u1 : 0);
  ltc_fold(lobe, p);
  for (i = 0; i < 3; ++i) {
    omega[i] = m[3 * i] * p[0] + m[3 * i + 1] * p[1] + m[3 * i + 2] * p[2];
    length += omega[i] * omega[i];
  }
  length = sqrtf(length);
  for (i = 0; i < 3; ++i) omega[i] /= length;
}

#endif
)";

}  // namespace ltc::c_header
