// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What lies under the pointer, as texels beside each other: found, position, the frame, the view.

uniform vec2 pointer;
out vec4 result;

void main() {
  vec3 ray = ray_at(pointer);
  Hit hit = hit_of(ray);
  int i = int(gl_FragCoord.x);
  vec3 texel = i == 0   ? vec3(hit.found ? 1 : 0, 0, 0)
               : i == 1 ? hit.position
               : i == 2 ? hit.tangent
               : i == 3 ? hit.bitangent
               : i == 4 ? hit.normal
                        : view_of(hit, ray);
  result = vec4(texel, 0);
}
