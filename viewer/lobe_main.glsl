// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A lobe's density over the hemisphere, seen from above: x and y of the directions, a window of them.
// To the left by GGX, to the right by the table; both times the albedo.

uniform vec3 view;
uniform vec2 window_center;
uniform float window_half, side;  // side: texels of either half
out vec4 result;

void main() {
  vec2 at = gl_FragCoord.xy;
  bool of_table = at.x > side;
  at.x -= of_table ? side : 0.0;
  vec2 xy = window_center + window_half * (2.0 * at / side - 1.0);
  float squared_z = 1.0 - dot(xy, xy);
  if (squared_z <= 0.0) {
    result = vec4(-1, 0, 0, 0);
    return;
  }
  vec3 direction = vec3(xy, sqrt(squared_z));
  float value;
  if (of_table) {
    Lobe lobe = lobe_of(view, alpha);
    value = plain(lobe).amplitude * density(lobe, direction);
  } else {
    value = ggx_densities(ggx_of(view, alpha), view + direction, direction).x;
  }
  result = vec4(value, 0, 0, 0);
}
