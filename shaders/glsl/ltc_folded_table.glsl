// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-up in the textures of a folded table, storage "folded": the three of other tables and a fourth,
// laid out as they are, of kappa and gamma. Needs ltc_lobe, ltc_table, ltc_folded.

// The lobe of what was fetched. Rows alone are unfolded, since a fold feels what its columns are
// turned by but for their x's sign, which keeps the determinant positive.
LtcFoldedLobe ltc_unreduce_folded(LtcTable table, LtcReduced reduced, LtcTexels texels, vec4 fold) {
  LtcLobe lobe = ltc_reduced_lobe(table, reduced, texels);
  float x = reduced.signs.x;
  float y = reduced.signs.y;
  float mirrored = x * y;
  if (reduced.swapped > 0.5) {
    LtcLobe other = lobe;
    lobe.m0 = other.m1;
    lobe.m1 = other.m0;
    lobe.w0 = vec3(other.w0.y, other.w0.x, other.w0.z);
    lobe.w1 = vec3(other.w1.y, other.w1.x, other.w1.z);
    lobe.w2 = vec3(other.w2.y, other.w2.x, other.w2.z);
    mirrored = -mirrored;
  }
  lobe.m0 = x * vec3(mirrored * lobe.m0.x, lobe.m0.y, lobe.m0.z);
  lobe.m1 = y * vec3(mirrored * lobe.m1.x, lobe.m1.y, lobe.m1.z);
  lobe.m2 = vec3(mirrored * lobe.m2.x, lobe.m2.y, lobe.m2.z);
  lobe.w0 = mirrored * vec3(x * lobe.w0.x, y * lobe.w0.y, lobe.w0.z);
  lobe.w1 = vec3(x * lobe.w1.x, y * lobe.w1.y, lobe.w1.z);
  lobe.w2 = vec3(x * lobe.w2.x, y * lobe.w2.y, lobe.w2.z);
  if (table.size.y < 1.5 && table.size.w < 1.5) {
    lobe = ltc_turned(lobe, reduced.turn.x, reduced.turn.y);
  }
  vec3 scale = ltc_column_scale(table, reduced);
  float k = scale.x * scale.x * fold.x / scale.y;
  float g = min(fold.y, 0.95 / max(table.crease, 1e-6));
  return ltc_folded_lobe_of(lobe, vec3(k, g, table.crease));
}

LtcFoldedLobe ltc_look_up_folded(sampler3D values_0, sampler3D values_1, sampler3D values_2,
                                 sampler3D values_3, LtcTable table, vec3 view, float alpha_x,
                                 float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  vec4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch(values_0, table, at, 0.0, 1.0);
  texels.b = ltc_fetch(values_1, table, at, 0.0, 1.0);
  texels.c = ltc_fetch(values_2, table, at, 0.0, 1.0);
  return ltc_unreduce_folded(table, reduced, texels, ltc_fetch(values_3, table, at, 0.0, 1.0));
}

LtcFoldedLobe ltc_look_up_folded_exact(sampler3D values_0, sampler3D values_1, sampler3D values_2,
                                       sampler3D values_3, LtcTable table, vec3 view,
                                       float alpha_x, float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  vec4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch_exact(values_0, table, at, 0.0);
  texels.b = ltc_fetch_exact(values_1, table, at, 0.0);
  texels.c = ltc_fetch_exact(values_2, table, at, 0.0);
  return ltc_unreduce_folded(table, reduced, texels, ltc_fetch_exact(values_3, table, at, 0.0));
}
