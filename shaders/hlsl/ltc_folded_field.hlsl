// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in a folded field: what `ltcfit generate --config config/folded-field.toml` and `ltcfit
// convert FIELD -o NAME.hlsl` write, ltcLookUpFolded, as a lobe. By hand in each language, since their
// matrices differ. Needs ltc_lobe, ltc_folded and that file.

LtcFoldedLobe ltc_look_up_folded_field(float3 view, float alpha_x, float alpha_y) {
  float3x3 m;
  float2 albedo;
  float3 fold;
  ltcLookUpFolded(alpha_x, alpha_y, view, m, albedo, fold);
  return ltc_folded_lobe_of(ltc_lobe_of_rows(m[0], m[1], m[2], albedo.x, albedo.y), fold);
}
