// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A sphere of radius 1 about the origin under a rectangle, as `ltcfit render` has it; rays are cast
// here, so that there is no mesh. main.cpp puts the version, shaders/ and the table before it.
uniform sampler3D stacked;
uniform vec2 roughness;  // alpha along the parallels, along the meridians
uniform float f0;
uniform float size;      // pixels of the sphere's picture
uniform vec2 corner;     // where that begins
uniform int mistake;     // 0: none; docs/shading.md has a picture of each
out vec4 color;

const vec3 LIGHT = vec3(1.0, 1.5, 2.1);
const vec2 HALF_SIDES = vec2(1.1, 0.7);
const float DISTANCE = 6.0;
const float SHARE = 0.94;

// The lobe as the look-up gives it, or spoilt.
LtcLobe lobe_of(vec3 view) {
  vec2 alpha = roughness;
  if (mistake == 1) alpha = sqrt(alpha);  // perceptual roughness taken for alpha
  if (mistake == 2) alpha = alpha.yx;     // axes exchanged
  if (mistake == 3) view.xy = -view.xy;   // a view that points away from the eye
  LtcLobe lobe = ltc_look_up_stacked_exact(stacked, LTC_TABLE, view, alpha.x, alpha.y);
  if (mistake == 4) {  // the inverse transposed
    vec3 w0 = vec3(lobe.w0.x, lobe.w1.x, lobe.w2.x);
    vec3 w1 = vec3(lobe.w0.y, lobe.w1.y, lobe.w2.y);
    vec3 w2 = vec3(lobe.w0.z, lobe.w1.z, lobe.w2.z);
    lobe.w0 = w0;
    lobe.w1 = w1;
    lobe.w2 = w2;
  }
  if (mistake == 5) {  // M taken for its inverse
    lobe.w0 = lobe.m0;
    lobe.w1 = lobe.m1;
    lobe.w2 = lobe.m2;
  }
  return lobe;
}

float radiance(vec3 n, vec3 to_eye) {
  // East along the parallels, north along the meridians.
  vec3 east = vec3(n.z, 0.0, -n.x);
  east = length(east) > 0.0 ? normalize(east) : vec3(1.0, 0.0, 0.0);
  vec3 north = cross(n, east);
  mat3 tangent = transpose(mat3(east, north, n));
  vec3 view = tangent * to_eye;
  if (mistake == 6) tangent = mat3(east, north, n);  // the frame transposed
  // The rectangle faces the origin, its first side level, and shines from that side alone.
  vec3 facing = -normalize(LIGHT);
  vec3 u = normalize(cross(vec3(0.0, 1.0, 0.0), facing));
  vec3 v = cross(facing, u);
  vec3 center = LIGHT - n;
  if (dot(center, facing) > 0.0) return 0.0;
  u = tangent * (HALF_SIDES.x * u);
  v = tangent * (HALF_SIDES.y * v);
  center = tangent * center;
  vec3 a = center - u - v, b = center + u - v, c = center + u + v, d = center - u + v;
  LtcLobe lobe = lobe_of(view);
  float share = ltc_quad(lobe, a, b, c, d);
  if (mistake == 7) {  // not cut at any horizon
    a = normalize(ltc_to_cosine(lobe, a));
    b = normalize(ltc_to_cosine(lobe, b));
    c = normalize(ltc_to_cosine(lobe, c));
    d = normalize(ltc_to_cosine(lobe, d));
    share = abs(ltc_edge(a, b) + ltc_edge(b, c) + ltc_edge(c, d) + ltc_edge(d, a));
  }
  if (mistake == 8) share = ltc_quad_as_sphere(lobe, a, b, c, d);
  float reflected = ltc_reflectance(lobe, vec3(f0)).x;
  return share * (mistake == 9 ? 1.0 : reflected);  // the amplitude forgotten
}

// Through a point of the picture, x to the right and y up, from -1 to 1; and how much of it is sphere.
vec2 traced(vec2 at) {
  float scale = 1.0 / (sqrt(DISTANCE * DISTANCE - 1.0) * SHARE);
  vec3 eye = vec3(0.0, 0.0, DISTANCE), ray = normalize(vec3(at * scale, -1.0));
  float towards = -dot(eye, ray), inside = towards * towards - (DISTANCE * DISTANCE - 1.0);
  if (inside <= 0.0) return vec2(0.0);
  vec3 n = normalize(eye + (towards - sqrt(inside)) * ray);
  return vec2(radiance(n, -ray), 1.0);
}

void main() {
  vec2 pixel = gl_FragCoord.xy - corner;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 place = floor(pixel) + vec2(i % 2 == 0 ? 0.25 : 0.75, i / 2 == 0 ? 0.25 : 0.75);
    sum += traced(2.0 * place / size - 1.0);
  }
  color = vec4(vec3(sum.x / 4.0), sum.y / 4.0);
}
