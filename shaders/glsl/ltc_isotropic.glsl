// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in the two 2-D textures of isotropic lobes that engines ship (layout "ltc", docs/files.md):
// the inverse's four values; amplitude and Fresnel term. Column sqrt(alpha), row sqrt(1 - cos theta).
// Clamp to edge, linear filter. Needs ltc_lobe.

// `size`: texels along either side, 64. alpha is GGX's, the square of a perceptual roughness.
LtcLobe ltc_look_up_isotropic(sampler2D inverses, sampler2D terms, float size, vec3 view,
                              float alpha) {
  float away = length(view.xy);
  vec2 unit = vec2(1.0, 0.0);
  if (away > 0.0) {
    unit = view.xy / away;
  }
  // 1 - cos theta keeps its digits where the view is steep.
  float height = sqrt(max(away * away / (1.0 + view.z), 0.0));
  vec2 place = vec2(sqrt(alpha), height) * (1.0 - 1.0 / size) + vec2(0.5 / size, 0.5 / size);
  vec4 inverse = textureLod(inverses, place, 0.0);
  vec4 term = textureLod(terms, place, 0.0);
  LtcLobe lobe = ltc_lobe_of_inverse_rows(vec3(inverse.x, 0.0, inverse.z), vec3(0.0, 1.0, 0.0),
                                          vec3(inverse.y, 0.0, inverse.w), term.x, term.y);
  return ltc_turned(lobe, unit.x, unit.y);
}
