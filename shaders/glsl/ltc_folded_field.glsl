// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in a folded field: what `ltcfit generate --config config/folded-field.toml` and `ltcfit
// convert FIELD -o NAME.glsl` write, ltcLookUpFolded, as a lobe. By hand in each language, since their
// matrices differ. Needs ltc_lobe, ltc_folded and that file.

LtcFoldedLobe ltc_look_up_folded_field(vec3 view, float alpha_x, float alpha_y) {
  mat3 m;
  vec2 albedo;
  vec3 fold;
  ltcLookUpFolded(alpha_x, alpha_y, view, m, albedo, fold);
  LtcLobe lobe =
      ltc_lobe_of_rows(vec3(m[0].x, m[1].x, m[2].x), vec3(m[0].y, m[1].y, m[2].y),
                       vec3(m[0].z, m[1].z, m[2].z), albedo.x, albedo.y);
  return ltc_folded_lobe_of(lobe, fold);
}
