// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in a field: what `ltcfit generate --config config/field.toml` and `ltcfit convert FIELD -o
// NAME.hlsl` write, ltcLookUp, as a lobe. By hand in each language, since their matrices differ.
// Needs ltc_lobe and that file.

LtcLobe ltc_look_up_field(float3 view, float alpha_x, float alpha_y) {
  float3x3 m;
  float2 albedo;
  ltcLookUp(alpha_x, alpha_y, view, m, albedo);
  return ltc_lobe_of_rows(m[0], m[1], m[2], albedo.x, albedo.y);
}
