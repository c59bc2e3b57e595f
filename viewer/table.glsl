// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Shading by a table or a field: the share of the light by the shader library, times reflectance.
// FIELD, FOLDED, EXACT and BOTH_ALPHAS say which look-up.

uniform sampler3D values;
uniform LtcTable table;

// Of folded lobes and of plain ones, by one name each.
#if FOLDED
#define VOLUMES 4.0
#define Lobe LtcFoldedLobe
#define Outline LtcFoldedOutline
#define outline_begin ltc_outline_begin_folded
#define outline_add ltc_outline_add_folded
#define outline_share ltc_outline_share_folded
#define quad ltc_quad_folded
#define ellipse ltc_ellipse_folded
#define sphere ltc_sphere_folded
#define line ltc_line_folded
#define density ltc_density_folded
LtcLobe plain(LtcFoldedLobe lobe) { return lobe.lobe; }
#else
#define VOLUMES 3.0
#define Lobe LtcLobe
#define Outline LtcOutline
#define outline_begin ltc_outline_begin
#define outline_add ltc_outline_add
#define outline_share ltc_outline_share
#define quad ltc_quad
#define ellipse ltc_ellipse
#define sphere ltc_sphere
#define line ltc_line
#define density ltc_density
LtcLobe plain(LtcLobe lobe) { return lobe; }
#endif

#if FIELD
Lobe lobe_of(vec3 view, vec2 alphas) {
  mat3 columns;
  vec2 albedo;
#if FOLDED
  vec3 fold;
  FIELD_FUNCTION(alphas.x, alphas.y, view, columns, albedo, fold);
#else
  FIELD_FUNCTION(alphas.x, alphas.y, view, columns, albedo);
#endif
  mat3 rows = transpose(columns);
  LtcLobe lobe = ltc_lobe_of_rows(rows[0], rows[1], rows[2], albedo.x, albedo.y);
#if FOLDED
  return ltc_folded_lobe_of(lobe, fold);
#else
  return lobe;
#endif
}
#else
// Of the volume of this number.
vec4 fetched(vec4 at, float volume) {
#if EXACT
  return ltc_fetch_exact(values, table, at, volume);
#else
  return ltc_fetch(values, table, at, volume, VOLUMES);
#endif
}

Lobe found(LtcReduced reduced, vec4 at) {
  LtcTexels texels = LtcTexels(fetched(at, 0.0), fetched(at, 1.0), fetched(at, 2.0));
#if FOLDED
  return ltc_unreduce_folded(table, reduced, texels, fetched(at, 3.0));
#else
  return ltc_unreduce(table, reduced, texels);
#endif
}

#if BOTH_ALPHAS
// A table over alpha_x and alpha_y, which has both orders: nothing is swapped.
Lobe lobe_of(vec3 view, vec2 alphas) {
  LtcReduced reduced = ltc_reduce(table, view, 1.0, 1.0);
  reduced.alpha = alphas.x;
  reduced.beta = alphas.y;
  vec4 at = ltc_positions(table, reduced);
  at.y = ltc_position(alphas.y, table.size.y, table.first.y, table.last.y, table.warp.y);
  return found(reduced, at);
}
#else
Lobe lobe_of(vec3 view, vec2 alphas) {
  LtcReduced reduced = ltc_reduce(table, view, alphas.x, alphas.y);
  return found(reduced, ltc_positions(table, reduced));
}
#endif
#endif

// What of the lobe's light comes from the source, by colour.
vec3 share_of(Lobe lobe, Light light) {
  bool seen = dot(cross(light.u, light.v), light.center) < 0.0;
  if (LIGHT == BALL) {
    return vec3(sphere(lobe, light.center, light_radius));
  }
  if (LIGHT == LINE) {
    return vec3(line(lobe, light.center - light.u, light.center + light.u, light_radius));
  }
  if (!seen) {
    return vec3(0);
  }
  if (LIGHT == DISK) {
    return vec3(ellipse(lobe, light.center, light.u, light.v));
  }
  if (LIGHT == STAR) {
    Outline outline = outline_begin();
    for (int i = 0; i < 10; ++i) {
      vec2 vertex = star_vertex(i);
      outline = outline_add(outline, lobe, light.center + vertex.x * light.u + vertex.y * light.v);
    }
    return vec3(outline_share(outline, lobe));
  }
  vec3 corner = light.center - light.u - light.v;
  vec3 share = vec3(quad(lobe, corner, corner + 2.0 * light.u, light.center + light.u + light.v,
                             corner + 2.0 * light.v));
  if (LIGHT == PICTURE) {
    share *= ltc_picture(light_levels, float(textureSize(light_levels, 0).x), plain(lobe), corner,
                         2.0 * light.u, 2.0 * light.v);
  }
  return share;
}
