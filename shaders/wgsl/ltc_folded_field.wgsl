// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in a folded field: what `ltcfit generate --config config/folded-field.toml` and `ltcfit
// convert FIELD -o NAME.wgsl` write, ltcLookUpFolded, as a lobe. By hand in each language, since their
// matrices differ. Needs ltc_lobe, ltc_folded and that file.

fn ltc_look_up_folded_field(view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcFoldedLobe {
  let found = ltcLookUpFolded(alpha_x, alpha_y, view);
  let m = transpose(found.matrix);
  let lobe = ltc_lobe_of_rows(m[0], m[1], m[2], found.amplitude, found.fresnel);
  return ltc_folded_lobe_of(lobe, found.fold);
}
