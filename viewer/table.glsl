// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Shading by a table or a field: the share of the light by the shader library, times reflectance.
// FIELD, EXACT and BOTH_ALPHAS say which look-up.

uniform sampler3D values;
uniform LtcTable table;

#if FIELD
LtcLobe lobe_of(vec3 view, vec2 alphas) {
  mat3 columns;
  vec2 albedo;
  FIELD_FUNCTION(alphas.x, alphas.y, view, columns, albedo);
  mat3 rows = transpose(columns);
  return ltc_lobe_of_rows(rows[0], rows[1], rows[2], albedo.x, albedo.y);
}
#else
LtcTexels fetched(vec4 at) {
  LtcTexels texels;
#if EXACT
  texels.a = ltc_fetch_exact(values, table, at, 0.0);
  texels.b = ltc_fetch_exact(values, table, at, 1.0);
  texels.c = ltc_fetch_exact(values, table, at, 2.0);
#else
  texels.a = ltc_fetch(values, table, at, 0.0, 3.0);
  texels.b = ltc_fetch(values, table, at, 1.0, 3.0);
  texels.c = ltc_fetch(values, table, at, 2.0, 3.0);
#endif
  return texels;
}

#if BOTH_ALPHAS
// A table over alpha_x and alpha_y, which has both orders: nothing is swapped.
LtcLobe lobe_of(vec3 view, vec2 alphas) {
  LtcFolded folded = ltc_fold(table, view, 1.0, 1.0);
  folded.alpha = alphas.x;
  folded.beta = alphas.y;
  vec4 at = ltc_positions(table, folded);
  at.y = ltc_position(alphas.y, table.size.y, table.first.y, table.last.y, table.warp.y);
  return ltc_unfold(table, folded, fetched(at));
}
#else
LtcLobe lobe_of(vec3 view, vec2 alphas) {
  LtcFolded folded = ltc_fold(table, view, alphas.x, alphas.y);
  return ltc_unfold(table, folded, fetched(ltc_positions(table, folded)));
}
#endif
#endif

// What of the lobe's light comes from the source, by colour.
vec3 share_of(LtcLobe lobe, Light light) {
  bool seen = dot(cross(light.u, light.v), light.center) < 0.0;
  if (LIGHT == BALL) {
    return vec3(ltc_sphere(lobe, light.center, light_radius));
  }
  if (LIGHT == LINE) {
    return vec3(ltc_line(lobe, light.center - light.u, light.center + light.u, light_radius));
  }
  if (!seen) {
    return vec3(0);
  }
  if (LIGHT == DISK) {
    return vec3(ltc_ellipse(lobe, light.center, light.u, light.v));
  }
  if (LIGHT == STAR) {
    LtcOutline outline = ltc_outline_begin();
    for (int i = 0; i < 10; ++i) {
      vec2 vertex = star_vertex(i);
      outline = ltc_outline_add(outline, lobe, light.center + vertex.x * light.u + vertex.y * light.v);
    }
    return vec3(ltc_outline_share(outline, lobe));
  }
  vec3 corner = light.center - light.u - light.v;
  vec3 share = vec3(ltc_quad(lobe, corner, corner + 2.0 * light.u, light.center + light.u + light.v,
                             corner + 2.0 * light.v));
  if (LIGHT == PICTURE) {
    share *= ltc_picture(light_levels, float(textureSize(light_levels, 0).x), lobe, corner,
                         2.0 * light.u, 2.0 * light.v);
  }
  return share;
}
