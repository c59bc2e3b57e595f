// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A pixel by the table: the mean of its points, and how much of it the object covers.

uniform int points;
out vec4 result;

void main() {
  vec4 sum = vec4(0);
  for (int i = 0; i < points; ++i) {
    vec3 ray = ray_at(point_of_pixel(i, points));
    Hit hit = hit_of(ray);
    if (hit.found) {
      Lobe lobe = lobe_of(view_of(hit, ray), alpha);
      sum += vec4(ltc_reflectance(plain(lobe), f0) * share_of(lobe, light_of(hit)), 1);
    }
  }
  result = sum / float(points);
}
