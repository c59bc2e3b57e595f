// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_folded_table.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Look-up in the textures of a folded table, storage "folded": the three of other tables and a fourth,
// laid out as they are, of kappa and gamma. Needs ltc_lobe, ltc_table, ltc_folded.

// The lobe of what was fetched. Rows alone are unfolded, since a fold feels what its columns are
// turned by but for their x's sign, which keeps the determinant positive.
fn ltc_unreduce_folded(table: LtcTable, reduced: LtcReduced, texels: LtcTexels,
    fold: vec4<f32>) -> LtcFoldedLobe {
  var lobe: LtcLobe = ltc_reduced_lobe(table, reduced, texels);
  var x: f32 = reduced.signs.x;
  var y: f32 = reduced.signs.y;
  var mirrored: f32 = x * y;
  if (reduced.swapped > 0.5) {
    var other: LtcLobe = lobe;
    lobe.m0 = other.m1;
    lobe.m1 = other.m0;
    lobe.w0 = vec3<f32>(other.w0.y, other.w0.x, other.w0.z);
    lobe.w1 = vec3<f32>(other.w1.y, other.w1.x, other.w1.z);
    lobe.w2 = vec3<f32>(other.w2.y, other.w2.x, other.w2.z);
    mirrored = -mirrored;
  }
  lobe.m0 = x * vec3<f32>(mirrored * lobe.m0.x, lobe.m0.y, lobe.m0.z);
  lobe.m1 = y * vec3<f32>(mirrored * lobe.m1.x, lobe.m1.y, lobe.m1.z);
  lobe.m2 = vec3<f32>(mirrored * lobe.m2.x, lobe.m2.y, lobe.m2.z);
  lobe.w0 = mirrored * vec3<f32>(x * lobe.w0.x, y * lobe.w0.y, lobe.w0.z);
  lobe.w1 = vec3<f32>(x * lobe.w1.x, y * lobe.w1.y, lobe.w1.z);
  lobe.w2 = vec3<f32>(x * lobe.w2.x, y * lobe.w2.y, lobe.w2.z);
  if (table.size.y < 1.5 && table.size.w < 1.5) {
    lobe = ltc_turned(lobe, reduced.turn.x, reduced.turn.y);
  }
  var scale: vec3<f32> = ltc_column_scale(table, reduced);
  var k: f32 = scale.x * scale.x * fold.x / scale.y;
  var g: f32 = min(fold.y, 0.95 / max(table.crease, 1e-6));
  return ltc_folded_lobe_of(lobe, vec3<f32>(k, g, table.crease));
}

fn ltc_look_up_folded(values_0: texture_3d<f32>, values_0_sampler: sampler,
    values_1: texture_3d<f32>, values_1_sampler: sampler, values_2: texture_3d<f32>,
    values_2_sampler: sampler, values_3: texture_3d<f32>, values_3_sampler: sampler,
    table: LtcTable, view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcFoldedLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch(values_0, values_0_sampler, table, at, 0.0, 1.0);
  texels.b = ltc_fetch(values_1, values_1_sampler, table, at, 0.0, 1.0);
  texels.c = ltc_fetch(values_2, values_2_sampler, table, at, 0.0, 1.0);
  return ltc_unreduce_folded(table, reduced, texels, ltc_fetch(values_3, values_3_sampler, table,
      at, 0.0, 1.0));
}

fn ltc_look_up_folded_exact(values_0: texture_3d<f32>, values_1: texture_3d<f32>,
    values_2: texture_3d<f32>, values_3: texture_3d<f32>, table: LtcTable, view: vec3<f32>,
    alpha_x: f32, alpha_y: f32) -> LtcFoldedLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch_exact(values_0, table, at, 0.0);
  texels.b = ltc_fetch_exact(values_1, table, at, 0.0);
  texels.c = ltc_fetch_exact(values_2, table, at, 0.0);
  return ltc_unreduce_folded(table, reduced, texels, ltc_fetch_exact(values_3, table, at, 0.0));
}
