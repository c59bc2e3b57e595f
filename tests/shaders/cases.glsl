// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What every driver is asked of shaders/: one look-up and one light of it. Turned into the other
// languages as those are; shader_jobs.cpp puts versions, bindings and an entry point around it.

// The lobe's M and W by rows; amplitude, Fresnel term, the light's share; what a picture shows, or a
// folded lobe's k, g and h.
struct LtcCase {
  vec4 r0;
  vec4 r1;
  vec4 r2;
  vec4 r3;
  vec4 r4;
  vec4 r5;
};

LtcLobe ltc_case_lobe(sampler3D values_0, sampler3D values_1, sampler3D values_2,
                      sampler3D stacked, sampler2D inverses, sampler2D terms, float look,
                      vec3 view, float alpha_x, float alpha_y) {
  if (look < 0.5) {
    return ltc_look_up_exact(values_0, values_1, values_2, LTC_TABLE, view, alpha_x, alpha_y);
  }
  if (look < 1.5) {
    return ltc_look_up_stacked_exact(stacked, LTC_TABLE, view, alpha_x, alpha_y);
  }
  if (look < 2.5) {
    return ltc_look_up(values_0, values_1, values_2, LTC_TABLE, view, alpha_x, alpha_y);
  }
  if (look < 3.5) {
    return ltc_look_up_stacked(stacked, LTC_TABLE, view, alpha_x, alpha_y);
  }
  if (look < 4.5) {
    return ltc_look_up_isotropic(inverses, terms, 64.0, view, alpha_x);
  }
  return ltc_look_up_field(view, alpha_x, alpha_y);
}

// Of ten: at (1, 0) turned by i times 36 degrees, every second one nearer. Not by the driver's sine.
vec2 ltc_case_star_vertex(int i) {
  vec2 at = vec2(1.0, 0.0);
  for (int j = 0; j < i; ++j) {
    at = vec2(0.809016994 * at.x - 0.587785252 * at.y, 0.587785252 * at.x + 0.809016994 * at.y);
  }
  if (i % 2 == 1) {
    at = 0.4 * at;
  }
  return at;
}

// A star about `center`, with points along a and b: not convex.
float ltc_case_star(LtcLobe lobe, vec3 center, vec3 a, vec3 b) {
  LtcOutline outline = ltc_outline_begin();
  for (int i = 0; i < 10; ++i) {
    vec2 v = ltc_case_star_vertex(i);
    outline = ltc_outline_add(outline, lobe, center + v.x * a + v.y * b);
  }
  return ltc_outline_share(outline, lobe);
}

// p: a corner or centre; a, b: sides, half axes or, of lines, the way to the other end.
float ltc_case_light(LtcLobe lobe, float light, vec3 p, vec3 a, vec3 b, float radius) {
  if (light < 0.5) {
    return ltc_quad(lobe, p, p + a, p + a + b, p + b);
  }
  if (light < 1.5) {
    return ltc_case_star(lobe, p, a, b);
  }
  if (light < 2.5) {
    return ltc_ellipse(lobe, p, a, b);
  }
  if (light < 3.5) {
    return ltc_sphere(lobe, p, radius);
  }
  if (light < 4.5) {
    return ltc_line(lobe, p, p + a, radius);
  }
  if (light < 5.5) {
    return ltc_quad_as_sphere(lobe, p, p + a, p + a + b, p + b);
  }
  if (light < 6.5) {
    return ltc_density(lobe, normalize(p));
  }
  if (light < 7.5) {
    return dot(ltc_direction(lobe, fract(abs(b.x)), fract(abs(b.y))), normalize(a));
  }
  if (light < 8.5) {
    return ltc_below_horizon(lobe);
  }
  return ltc_horizon_factor(lobe);
}

float ltc_case_star_folded(LtcFoldedLobe lobe, vec3 center, vec3 a, vec3 b) {
  LtcFoldedOutline outline = ltc_outline_begin_folded();
  for (int i = 0; i < 10; ++i) {
    vec2 v = ltc_case_star_vertex(i);
    outline = ltc_outline_add_folded(outline, lobe, center + v.x * a + v.y * b);
  }
  return ltc_outline_share_folded(outline, lobe);
}

// The same of a folded lobe; what has no such function is a quad.
float ltc_case_light_folded(LtcFoldedLobe lobe, float light, vec3 p, vec3 a, vec3 b, float radius) {
  if (light > 0.5 && light < 1.5) {
    return ltc_case_star_folded(lobe, p, a, b);
  }
  if (light > 1.5 && light < 2.5) {
    return ltc_ellipse_folded(lobe, p, a, b);
  }
  if (light > 2.5 && light < 3.5) {
    return ltc_sphere_folded(lobe, p, radius);
  }
  if (light > 3.5 && light < 4.5) {
    return ltc_line_folded(lobe, p, p + a, radius);
  }
  if (light > 5.5 && light < 6.5) {
    return ltc_density_folded(lobe, normalize(p));
  }
  if (light > 6.5 && light < 7.5) {
    return dot(ltc_direction_folded(lobe, fract(abs(b.x)), fract(abs(b.y))), normalize(a));
  }
  if (light > 8.5) {
    return ltc_horizon_factor_folded(lobe);
  }
  if (light > 7.5) {
    return ltc_below_horizon_folded(lobe);
  }
  return ltc_quad_folded(lobe, p, p + a, p + a + b, p + b);
}

LtcFoldedLobe ltc_case_folded_lobe(sampler3D folded_0, sampler3D folded_1, sampler3D folded_2,
                                   sampler3D folded_3, float look, vec3 view, float alpha_x,
                                   float alpha_y) {
  if (look < 6.5) {
    return ltc_look_up_folded_field(view, alpha_x, alpha_y);
  }
  if (look < 7.5) {
    return ltc_look_up_folded_exact(folded_0, folded_1, folded_2, folded_3, LTC_FOLDED_TABLE, view,
                                    alpha_x, alpha_y);
  }
  return ltc_look_up_folded(folded_0, folded_1, folded_2, folded_3, LTC_FOLDED_TABLE, view, alpha_x,
                            alpha_y);
}

LtcCase ltc_case(sampler3D values_0, sampler3D values_1, sampler3D values_2, sampler3D stacked,
                 sampler2D inverses, sampler2D terms, sampler2D picture, sampler3D folded_0,
                 sampler3D folded_1, sampler3D folded_2, sampler3D folded_3, vec4 i0, vec4 i1,
                 vec4 i2, vec4 i3) {
  LtcLobe lobe;
  float share = 0.0;
  vec3 seen = vec3(0.0, 0.0, 0.0);
  if (i2.w > 5.5) {
    LtcFoldedLobe folded = ltc_case_folded_lobe(folded_0, folded_1, folded_2, folded_3, i2.w, i0.xyz,
                                                i0.w, i1.w);
    lobe = folded.lobe;
    share = ltc_case_light_folded(folded, floor(i3.w), i1.xyz, i2.xyz, i3.xyz, 0.2);
    seen = vec3(folded.k, folded.g, folded.h);
  } else {
    lobe = ltc_case_lobe(values_0, values_1, values_2, stacked, inverses, terms, i2.w, i0.xyz, i0.w,
                         i1.w);
    share = ltc_case_light(lobe, floor(i3.w), i1.xyz, i2.xyz, i3.xyz, 0.2);
    seen = ltc_picture(picture, 64.0, lobe, i1.xyz, i2.xyz, i3.xyz);
  }
  LtcCase result;
  result.r0 = vec4(lobe.m0, lobe.amplitude);
  result.r1 = vec4(lobe.m1, lobe.fresnel);
  result.r2 = vec4(lobe.m2, share);
  result.r3 = vec4(lobe.w0, seen.x);
  result.r4 = vec4(lobe.w1, seen.y);
  result.r5 = vec4(lobe.w2, seen.z);
  return result;
}
