// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is shown of the sums: radiance in sRGB, or a difference in colours; behind it the stage and
// the light's lit side.

uniform sampler2D table_a, table_b, ggx_0, ggx_1, scale_colors;
uniform sampler2D outline;  // the sharpest picture's: how much the object covers
uniform float ggx_weight;  // 1 over the samples of both sums; 0: none yet
uniform int view;          // 0 A, 1 B, 2 GGX, 3 A - GGX, 4 B - GGX, 5 A and GGX beside each other
uniform float divider;     // of 5, pixels from the left
uniform float exposure, bound;
uniform vec2 canvas_size;
uniform vec3 stage_inner, stage_outer;
out vec4 result;

vec3 encoded(vec3 linear) {
  linear = clamp(linear, 0.0, 1.0);
  return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
             step(vec3(0.0031308), linear));
}

// Where the ray meets the light's lit side: its distance, and radiance.
vec4 light_seen(vec3 ray) {
  if (LIGHT == BALL) {
    vec3 from = camera - light_center;
    float towards = -dot(from, ray);
    vec3 nearest = from + towards * ray;
    float squared = light_radius * light_radius - dot(nearest, nearest);
    return squared > 0.0 ? vec4(vec3(1), towards - sqrt(squared)) : vec4(vec3(0), 1e9);
  }
  vec3 u = light_u, v = light_v, from = light_center - camera;
  if (LIGHT == LINE) {
    v = light_radius * normalize(cross(u, from));
    v = dot(cross(u, v), from) > 0.0 ? -v : v;
  }
  vec3 normal = cross(u, v);
  float towards = dot(normal, ray);
  float far = dot(normal, from) / towards;
  vec3 d = far * ray - from;
  vec2 place = vec2(dot(d, u) / dot(u, u), dot(d, v) / dot(v, v));
  if (towards >= 0.0 || far <= 0.0 || !in_light(place)) {
    return vec4(vec3(0), 1e9);
  }
  vec3 radiance = LIGHT == PICTURE ? textureLod(light_levels, 0.375 * place + 0.5, 0.0).xyz : vec3(1);
  return vec4(radiance, far);
}

vec3 stage(vec2 place) {
  float x = clamp(length(place * vec2(0.62, 0.7)), 0.0, 1.0);
  return mix(stage_inner, stage_outer, x * x * (3.0 - 2.0 * x));
}

void main() {
  vec2 at = gl_FragCoord.xy / canvas_size;
  vec4 a = texture(table_a, at);
  vec4 b = texture(table_b, at);
  vec4 sum = texture(ggx_0, at);
  vec4 ggx = vec4(ggx_weight * (sum.xyz + texture(ggx_1, at).xyz), sum.w);
  bool right = view == 5 && gl_FragCoord.x > divider;
  vec4 shown = view == 1 || view == 4 ? b : view == 2 || right ? ggx : a;
  vec3 light = vec3(0);
  float lit = 0.0;
  float cover = texture(outline, at).w;
  // Of a coarser picture, edges as sharp as the outline.
  shown.xyz *= shown.w > 0.02 ? min(cover / shown.w, 4.0) : 1.0;
  for (int i = 0; i < 4; ++i) {
    vec2 pixel = (floor(gl_FragCoord.xy) + vec2(0.25 + 0.5 * float(i % 2), 0.25 + 0.5 * float(i / 2)));
    vec3 ray = ray_at(pixel);
    vec4 seen = light_seen(ray);
    if (seen.w < 1e8) {
      Hit hit = hit_of(ray);
      if (!hit.found || hit.far > seen.w) {
        light += 0.25 * seen.xyz;
        lit += 0.25;
      }
    }
  }
  vec3 behind = stage(2.0 * (gl_FragCoord.xy - picture.xy) / picture.z);
  vec3 color;
  if (view == 3 || view == 4) {
    // Divided by the cover, so that edges are not paler than what is within.
    vec3 table = (view == 3 ? a : b).xyz;
    float d = dot(table - ggx.xyz, vec3(1.0 / 3.0)) / max(a.w, 1e-3);
    vec3 scaled = texture(scale_colors, vec2(0.5 + 0.5 * clamp(d / bound, -1.0, 1.0), 0.5)).xyz;
    color = mix(encoded(behind), scaled, cover);
    color = mix(color, encoded(min(light, vec3(1))), lit * 0.35);
  } else {
    vec3 linear = exposure * shown.xyz + (1.0 - cover) * behind;
    color = encoded(mix(linear, min(light, vec3(1)) / max(lit, 1e-3), lit));
  }
  if (view == 5 && abs(gl_FragCoord.x - divider) < 1.0) {
    color = vec3(0.92);
  }
  result = vec4(color, 1);
}
