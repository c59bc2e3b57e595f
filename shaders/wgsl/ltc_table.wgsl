// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_table.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// Look-up in a table's textures: three 3-D ones, width N_phi, height N_theta, slice lambda +
// N_lambda alpha, or one with the three behind each other. Any axes, warps, node counts and storage.
//
// Two ways to interpolate. The texture unit's (six fetches; clamp to edge, linear filter, no
// mipmaps) has weights of 8 bits on most GPUs and wants textures that can be filtered: 16 bits
// everywhere, 32 not on every device. By texels (ltc_look_up_exact: up to 48 fetches, no sampler) to
// the last bits. Needs ltc_lobe.

// What a table is; `ltcfit convert TABLE -o NAME.glsl` writes one down.
struct LtcTable {
  size: vec4<f32>,         // nodes along alpha, lambda, theta, phi
  first: vec4<f32>,        // the axes' first and last values; angles in radians
  last: vec4<f32>,
  warp: vec4<f32>,         // 0 linear, 1 sqrt, 2 complement-sqrt, 3 half-sine
  storage: f32,     // 0 matrix, 1 roughness-scaled, 2 mirror-frame, 3 inverse, 4 folded
  alpha_min: f32,
  crease: f32,      // of folded ones: h
}

// A query brought to what tables hold, alpha_x >= alpha_y and a view in the first quadrant (equations
// 13 to 15 of Aakash et al. 2022), and the way back.
struct LtcReduced {
  view: vec3<f32>,
  alpha: f32,  // the larger roughness
  beta: f32,
  signs: vec2<f32>,
  swapped: f32,  // 0 or 1
  turn: vec2<f32>,      // cosine and sine; of isotropic tables, which have one azimuth
}

// What was fetched.
struct LtcTexels {
  a: vec4<f32>,
  b: vec4<f32>,
  c: vec4<f32>,
}

fn ltc_reduce(table: LtcTable, view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcReduced {
  var reduced: LtcReduced;
  reduced.view = view;
  reduced.alpha = max(alpha_x, alpha_y);
  reduced.beta = min(alpha_x, alpha_y);
  reduced.signs = vec2<f32>(1.0, 1.0);
  reduced.swapped = 0.0;
  reduced.turn = vec2<f32>(1.0, 0.0);
  if (table.size.y < 1.5 && table.size.w < 1.5) {
    var far: f32 = length(view.xy);
    var own: vec2<f32> = vec2<f32>(cos(table.first.w), sin(table.first.w));
    var unit: vec2<f32> = own;
    if (far > 0.0) {
      unit = view.xy / far;
    }
    reduced.view = vec3<f32>(far * own, view.z);
    reduced.turn = vec2<f32>(dot(unit, own), unit.y * own.x - unit.x * own.y);
    reduced.beta = reduced.alpha;
    return reduced;
  }
  if (view.x < 0.0) {
    reduced.signs.x = -1.0;
  }
  if (view.y < 0.0) {
    reduced.signs.y = -1.0;
  }
  reduced.view = vec3<f32>(abs(view.x), abs(view.y), view.z);
  if (alpha_y > alpha_x) {
    reduced.swapped = 1.0;
    reduced.view = vec3<f32>(abs(view.y), abs(view.x), view.z);
  }
  return reduced;
}

// Where a value stands on an axis, in nodes.
fn ltc_position(value: f32, size: f32, first: f32, last: f32, warp: f32) -> f32 {
  if (size < 1.5) {
    return 0.0;
  }
  var x: f32 = (value - first) / (last - first);
  if (warp > 2.5) {
    var below: f32 = ltc_sine(0.5 * first);
    x = (ltc_sine(0.5 * value) - below) / (ltc_sine(0.5 * last) - below);
  }
  x = clamp(x, 0.0, 1.0);
  if (warp > 0.5 && warp < 1.5) {
    x = sqrt(x);
  }
  if (warp > 1.5 && warp < 2.5) {
    x = 1.0 - sqrt(1.0 - x);
  }
  return x * (size - 1.0);
}

// Of alpha, lambda, theta, phi.
fn ltc_positions(table: LtcTable, reduced: LtcReduced) -> vec4<f32> {
  var lambda: f32 = 1.0;
  if (reduced.alpha > 0.0) {
    lambda = reduced.beta / reduced.alpha;
  }
  var away: f32 = length(reduced.view.xy);
  var theta: f32 = ltc_angle(away, reduced.view.z);
  var phi: f32 = 0.0;
  if (away > 0.0) {
    phi = ltc_angle(reduced.view.y, reduced.view.x);
  }
  return vec4<f32>(
      ltc_position(reduced.alpha, table.size.x, table.first.x, table.last.x, table.warp.x),
      ltc_position(lambda, table.size.y, table.first.y, table.last.y, table.warp.y),
      ltc_position(theta, table.size.z, table.first.z, table.last.z, table.warp.z),
      ltc_position(phi, table.size.w, table.first.w, table.last.w, table.warp.w));
}

// By the texture unit: one whole number of alpha. `volume` of `volumes` behind each other.
fn ltc_fetch_slice(values: texture_3d<f32>, values_sampler: sampler, table: LtcTable,
    at: vec4<f32>, volume: f32, volumes: f32) -> vec4<f32> {
  var slice: f32 = at.y + table.size.y * (at.x + table.size.x * volume);
  var place: vec3<f32> = vec3<f32>((at.w + 0.5) / table.size.w, (at.z + 0.5) / table.size.z,
                    (slice + 0.5) / (table.size.x * table.size.y * volumes));
  return textureSampleLevel(values, values_sampler, place, 0.0);
}
fn ltc_fetch(values: texture_3d<f32>, values_sampler: sampler, table: LtcTable, at: vec4<f32>,
    volume: f32, volumes: f32) -> vec4<f32> {
  var lower: f32 = floor(at.x);
  var upper: f32 = min(lower + 1.0, table.size.x - 1.0);
  var a: vec4<f32> = ltc_fetch_slice(values, values_sampler, table, vec4<f32>(lower, at.y, at.z,
      at.w), volume, volumes);
  var b: vec4<f32> = ltc_fetch_slice(values, values_sampler, table, vec4<f32>(upper, at.y, at.z,
      at.w), volume, volumes);
  return mix(a, b, at.x - lower);
}

// By texels.
fn ltc_texel(values: texture_3d<f32>, table: LtcTable, node: vec4<f32>, volume: f32) -> vec4<f32> {
  var slice: f32 = node.y + table.size.y * (node.x + table.size.x * volume);
  return textureLoad(values, vec3<i32>(i32(node.w), i32(node.z), i32(slice + 0.5)), 0);
}
fn ltc_fetch_exact(values: texture_3d<f32>, table: LtcTable, at: vec4<f32>,
    volume: f32) -> vec4<f32> {
  var most: vec4<f32> = max(table.size - vec4<f32>(2.0, 2.0, 2.0, 2.0), vec4<f32>(0.0, 0.0, 0.0,
      0.0));
  var lower: vec4<f32> = min(floor(at), most);
  var part: vec4<f32> = at - lower;
  var sum: vec4<f32> = vec4<f32>(0.0, 0.0, 0.0, 0.0);
  for (var i: i32 = 0; i < 16; i++) {
    var side: vec4<f32> = vec4<f32>(f32(i / 8), f32((i / 4) % 2), f32((i / 2) % 2), f32(i % 2));
    // Not mix(), which drivers may round to a hundredth of a small weight.
    var one: vec4<f32> = vec4<f32>(1.0, 1.0, 1.0, 1.0);
    var weights: vec4<f32> = (one - side) * (one - part) + side * part;
    var weight: f32 = weights.x * weights.y * weights.z * weights.w;
    if (weight > 0.0) {
      sum = sum + weight * ltc_texel(values, table, lower + side, volume);
    }
  }
  return sum;
}

// What the columns of M are scaled by: the roughnesses, or alpha_x and s_y (src/field/field.h).
fn ltc_column_scale(table: LtcTable, reduced: LtcReduced) -> vec3<f32> {
  var alpha: f32 = max(reduced.alpha, table.alpha_min);
  var beta: f32 = max(reduced.beta, table.alpha_min);
  if (table.storage > 3.5) {
    var lambda: f32 = beta / alpha;
    var least: f32 = 0.1 * alpha;
    beta = alpha * sqrt(lambda * lambda + least * least * (1.0 - lambda * lambda));
  }
  return vec3<f32>(alpha, beta, 1.0);
}

// The reduced query's lobe of what was fetched. S is inverted, which is of the order of one, and not
// M; the roughness and the mirror's rotation are put on either side of the inverse (docs/files.md,
// "Inverting").
fn ltc_reduced_lobe(table: LtcTable, reduced: LtcReduced, texels: LtcTexels) -> LtcLobe {
  var s0: vec3<f32> = texels.a.xyz;
  var s1: vec3<f32> = vec3<f32>(texels.a.w, texels.b.x, texels.b.y);
  var s2: vec3<f32> = vec3<f32>(texels.b.z, texels.b.w, texels.c.x);
  var v: vec3<f32> = reduced.view;
  var scale: vec3<f32> = ltc_column_scale(table, reduced);
  var lobe: LtcLobe;
  if (table.storage > 2.5 && table.storage < 3.5) {
    // "inverse": W is what is stored.
    lobe = ltc_lobe_of_inverse_rows(s0, s1, s2, texels.c.y, texels.c.z);
  } else {
    // The columns of Q, the least rotation from z to the mirror direction (-vx, -vy, vz).
    var k: f32 = 1.0 / (1.0 + v.z);
    var q0: vec3<f32> = vec3<f32>(v.z + v.y * v.y * k, -v.x * v.y * k, v.x);
    var q1: vec3<f32> = vec3<f32>(-v.x * v.y * k, v.z + v.x * v.x * k, v.y);
    var q2: vec3<f32> = vec3<f32>(-v.x, -v.y, v.z);
    if (table.storage < 0.5) {
      s0 = s0 / scale;
      s1 = s1 / scale;
      s2 = s2 / scale;
    }
    if (table.storage < 1.5) {
      var r0: vec3<f32> = s0;
      var r1: vec3<f32> = s1;
      var r2: vec3<f32> = s2;
      s0 = q0.x * r0 + q0.y * r1 + q0.z * r2;
      s1 = q1.x * r0 + q1.y * r1 + q1.z * r2;
      s2 = q2.x * r0 + q2.y * r1 + q2.z * r2;
    }
    lobe = ltc_lobe_of_rows(s0, s1, s2, texels.c.y, texels.c.z);
    // M = Q S A, W = A^-1 S^-1 Q^T.
    var a0: vec3<f32> = scale * s0;
    var a1: vec3<f32> = scale * s1;
    var a2: vec3<f32> = scale * s2;
    lobe.m0 = q0.x * a0 + q1.x * a1 + q2.x * a2;
    lobe.m1 = q0.y * a0 + q1.y * a1 + q2.y * a2;
    lobe.m2 = q0.z * a0 + q1.z * a1 + q2.z * a2;
    lobe.w0 = (lobe.w0.x * q0 + lobe.w0.y * q1 + lobe.w0.z * q2) / scale.x;
    lobe.w1 = (lobe.w1.x * q0 + lobe.w1.y * q1 + lobe.w1.z * q2) / scale.y;
    lobe.w2 = lobe.w2.x * q0 + lobe.w2.y * q1 + lobe.w2.z * q2;
  }
  return lobe;
}

// And back, rows and columns alike, which the cosine does not feel: determinants keep their sign.
fn ltc_unreduce(table: LtcTable, reduced: LtcReduced, texels: LtcTexels) -> LtcLobe {
  var lobe: LtcLobe = ltc_reduced_lobe(table, reduced, texels);
  if (reduced.swapped > 0.5) {
    var other: LtcLobe = lobe;
    lobe.m0 = vec3<f32>(other.m1.y, other.m1.x, other.m1.z);
    lobe.m1 = vec3<f32>(other.m0.y, other.m0.x, other.m0.z);
    lobe.m2 = vec3<f32>(other.m2.y, other.m2.x, other.m2.z);
    lobe.w0 = vec3<f32>(other.w1.y, other.w1.x, other.w1.z);
    lobe.w1 = vec3<f32>(other.w0.y, other.w0.x, other.w0.z);
    lobe.w2 = vec3<f32>(other.w2.y, other.w2.x, other.w2.z);
  }
  var signs: vec3<f32> = vec3<f32>(reduced.signs.x, reduced.signs.y, 1.0);
  lobe.m0 = signs.x * signs * lobe.m0;
  lobe.m1 = signs.y * signs * lobe.m1;
  lobe.m2 = signs * lobe.m2;
  lobe.w0 = signs.x * signs * lobe.w0;
  lobe.w1 = signs.y * signs * lobe.w1;
  lobe.w2 = signs * lobe.w2;
  if (table.size.y < 1.5 && table.size.w < 1.5) {
    lobe = ltc_turned(lobe, reduced.turn.x, reduced.turn.y);
  }
  return lobe;
}

// view: unit, in the tangent frame. Roughnesses in either order.
fn ltc_look_up(values_0: texture_3d<f32>, values_0_sampler: sampler, values_1: texture_3d<f32>,
    values_1_sampler: sampler, values_2: texture_3d<f32>, values_2_sampler: sampler,
    table: LtcTable, view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch(values_0, values_0_sampler, table, at, 0.0, 1.0);
  texels.b = ltc_fetch(values_1, values_1_sampler, table, at, 0.0, 1.0);
  texels.c = ltc_fetch(values_2, values_2_sampler, table, at, 0.0, 1.0);
  return ltc_unreduce(table, reduced, texels);
}

// The same of one texture with the three behind each other.
fn ltc_look_up_stacked(values: texture_3d<f32>, values_sampler: sampler, table: LtcTable,
    view: vec3<f32>, alpha_x: f32, alpha_y: f32) -> LtcLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch(values, values_sampler, table, at, 0.0, 3.0);
  texels.b = ltc_fetch(values, values_sampler, table, at, 1.0, 3.0);
  texels.c = ltc_fetch(values, values_sampler, table, at, 2.0, 3.0);
  return ltc_unreduce(table, reduced, texels);
}

fn ltc_look_up_exact(values_0: texture_3d<f32>, values_1: texture_3d<f32>,
    values_2: texture_3d<f32>, table: LtcTable, view: vec3<f32>, alpha_x: f32,
    alpha_y: f32) -> LtcLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch_exact(values_0, table, at, 0.0);
  texels.b = ltc_fetch_exact(values_1, table, at, 0.0);
  texels.c = ltc_fetch_exact(values_2, table, at, 0.0);
  return ltc_unreduce(table, reduced, texels);
}

fn ltc_look_up_stacked_exact(values: texture_3d<f32>, table: LtcTable, view: vec3<f32>,
    alpha_x: f32, alpha_y: f32) -> LtcLobe {
  var reduced: LtcReduced = ltc_reduce(table, view, alpha_x, alpha_y);
  var at: vec4<f32> = ltc_positions(table, reduced);
  var texels: LtcTexels;
  texels.a = ltc_fetch_exact(values, table, at, 0.0);
  texels.b = ltc_fetch_exact(values, table, at, 1.0);
  texels.c = ltc_fetch_exact(values, table, at, 2.0);
  return ltc_unreduce(table, reduced, texels);
}
