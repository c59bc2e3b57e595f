// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_isotropic.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Look-up in the two 2-D textures of isotropic lobes that engines ship (layout "ltc", docs/files.md):
// the inverse's four values; amplitude and Fresnel term. Column sqrt(alpha), row sqrt(1 - cos theta).
// Clamp to edge, linear filter. Needs ltc_lobe.

// `size`: texels along either side, 64. alpha is GGX's, the square of a perceptual roughness.
fn ltc_look_up_isotropic(inverses: texture_2d<f32>, inverses_sampler: sampler,
    terms: texture_2d<f32>, terms_sampler: sampler, size: f32, view: vec3<f32>,
    alpha: f32) -> LtcLobe {
  var away: f32 = length(view.xy);
  var unit: vec2<f32> = vec2<f32>(1.0, 0.0);
  if (away > 0.0) {
    unit = view.xy / away;
  }
  // 1 - cos theta keeps its digits where the view is steep.
  var height: f32 = sqrt(max(away * away / (1.0 + view.z), 0.0));
  var place: vec2<f32> = vec2<f32>(sqrt(alpha), height) * (1.0 - 1.0 / size) +
      vec2<f32>(0.5 / size, 0.5 / size);
  var inverse: vec4<f32> = textureSampleLevel(inverses, inverses_sampler, place, 0.0);
  var term: vec4<f32> = textureSampleLevel(terms, terms_sampler, place, 0.0);
  var lobe: LtcLobe = ltc_lobe_of_inverse_rows(vec3<f32>(inverse.x, 0.0, inverse.z), vec3<f32>(0.0,
      1.0, 0.0),
                                          vec3<f32>(inverse.y, 0.0, inverse.w), term.x, term.y);
  return ltc_turned(lobe, unit.x, unit.y);
}
