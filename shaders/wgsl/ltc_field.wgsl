// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in a field: what `ltcfit generate --config config/field.toml` and `ltcfit convert FIELD -o
// NAME.wgsl` write, ltcLookUp, as a lobe. By hand in each language, since their matrices differ.
// Needs ltc_lobe and that file.

fn ltc_look_up_field(view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcLobe {
  let found = ltcLookUp(alpha_x, alpha_y, view);
  let m = transpose(found.matrix);
  return ltc_lobe_of_rows(m[0], m[1], m[2], found.amplitude, found.fresnel);
}
