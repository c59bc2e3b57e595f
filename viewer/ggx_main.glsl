// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A pixel of the reference: two independent sums of estimates, whose difference tells the noise.

uniform sampler2D before_0, before_1;
uniform int points;
uniform int first;   // which samples of each of a pixel's points
uniform int count;
uniform int seed;
layout(location = 0) out vec4 result_0;
layout(location = 1) out vec4 result_1;

uint scrambled(uint x) {
  x = x * 747796405u + 2891336453u;
  x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
  return (x >> 22u) ^ x;
}

float on_unit(uint x) { return float(x >> 8u) * (1.0 / 16777216.0); }

// The first two dimensions of Sobol's sequence: any power of two of its points, from its multiples
// on, are spread evenly.
uvec2 sobol(uint i) {
  uvec2 point = uvec2(0);
  uvec2 digit = uvec2(0x80000000u);
  for (uint rest = i; rest != 0u; rest >>= 1u) {
    if ((rest & 1u) != 0u) {
      point ^= digit;
    }
    digit = uvec2(digit.x >> 1u, digit.y ^ (digit.y >> 1u));
  }
  return point;
}

vec2 on_square(uvec2 x) { return vec2(on_unit(x.x), on_unit(x.y)); }

vec3 estimate(Ggx ggx, Source source, uint start) {
  uint a = scrambled(start);
  uint b = scrambled(a);
  uint c = scrambled(b);
  uint d = scrambled(c);
  vec3 sum = vec3(0);
  for (int i = 0; i < count; ++i) {
    uvec2 point = sobol(uint(first + i));
    sum += of_lobe(ggx, source, on_square(point ^ uvec2(a, b)));
    sum += of_light(ggx, source, on_square(point ^ uvec2(c, d)));
  }
  return sum;
}

void main() {
  vec3 sum_0 = vec3(0), sum_1 = vec3(0);
  float covered = 0.0;
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  uint start = scrambled(pixel.x + scrambled(pixel.y + scrambled(uint(seed))));
  for (int i = 0; i < points; ++i) {
    vec3 ray = ray_at(point_of_pixel(i, points));
    Hit hit = hit_of(ray);
    if (hit.found) {
      covered += 1.0;
      Source source = source_of(light_of(hit));
      if (source.seen) {
        Ggx ggx = ggx_of(view_of(hit, ray), alpha);
        sum_0 += estimate(ggx, source, start + uint(2 * i));
        sum_1 += estimate(ggx, source, start + uint(2 * i + 1));
      }
    }
  }
  vec4 share = vec4(covered) / float(points);
  result_0 = vec4(sum_0 / float(points), share.w);
  result_1 = vec4(sum_1 / float(points), share.w);
  if (first > 0) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    result_0.xyz += texelFetch(before_0, at, 0).xyz;
    result_1.xyz += texelFetch(before_1, at, 0).xyz;
  }
}
