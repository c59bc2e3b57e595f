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
  float4 size;         // nodes along alpha, lambda, theta, phi
  float4 first;        // the axes' first and last values; angles in radians
  float4 last;
  float4 warp;         // 0 linear, 1 sqrt, 2 complement-sqrt, 3 half-sine
  float storage;     // 0 matrix, 1 roughness-scaled, 2 mirror-frame, 3 inverse, 4 folded
  float alpha_min;
  float crease;      // of folded ones: h
};

// A query brought to what tables hold, alpha_x >= alpha_y and a view in the first quadrant (equations
// 13 to 15 of Aakash et al. 2022), and the way back.
struct LtcReduced {
  float3 view;
  float alpha;  // the larger roughness
  float beta;
  float2 signs;
  float swapped;  // 0 or 1
  float2 turn;      // cosine and sine; of isotropic tables, which have one azimuth
};

// What was fetched.
struct LtcTexels {
  float4 a;
  float4 b;
  float4 c;
};

LtcReduced ltc_reduce(LtcTable table, float3 view, float alpha_x, float alpha_y) {
  LtcReduced reduced;
  reduced.view = view;
  reduced.alpha = max(alpha_x, alpha_y);
  reduced.beta = min(alpha_x, alpha_y);
  reduced.signs = float2(1.0, 1.0);
  reduced.swapped = 0.0;
  reduced.turn = float2(1.0, 0.0);
  if (table.size.y < 1.5 && table.size.w < 1.5) {
    float far = length(view.xy);
    float2 own = float2(cos(table.first.w), sin(table.first.w));
    float2 unit = own;
    if (far > 0.0) {
      unit = view.xy / far;
    }
    reduced.view = float3(far * own, view.z);
    reduced.turn = float2(dot(unit, own), unit.y * own.x - unit.x * own.y);
    reduced.beta = reduced.alpha;
    return reduced;
  }
  if (view.x < 0.0) {
    reduced.signs.x = -1.0;
  }
  if (view.y < 0.0) {
    reduced.signs.y = -1.0;
  }
  reduced.view = float3(abs(view.x), abs(view.y), view.z);
  if (alpha_y > alpha_x) {
    reduced.swapped = 1.0;
    reduced.view = float3(abs(view.y), abs(view.x), view.z);
  }
  return reduced;
}

// Where a value stands on an axis, in nodes.
float ltc_position(float value, float size, float first, float last, float warp) {
  if (size < 1.5) {
    return 0.0;
  }
  float x = (value - first) / (last - first);
  if (warp > 2.5) {
    float below = ltc_sine(0.5 * first);
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
float4 ltc_positions(LtcTable table, LtcReduced reduced) {
  float lambda = 1.0;
  if (reduced.alpha > 0.0) {
    lambda = reduced.beta / reduced.alpha;
  }
  float away = length(reduced.view.xy);
  float theta = ltc_angle(away, reduced.view.z);
  float phi = 0.0;
  if (away > 0.0) {
    phi = ltc_angle(reduced.view.y, reduced.view.x);
  }
  return float4(
      ltc_position(reduced.alpha, table.size.x, table.first.x, table.last.x, table.warp.x),
      ltc_position(lambda, table.size.y, table.first.y, table.last.y, table.warp.y),
      ltc_position(theta, table.size.z, table.first.z, table.last.z, table.warp.z),
      ltc_position(phi, table.size.w, table.first.w, table.last.w, table.warp.w));
}

// By the texture unit: one whole number of alpha. `volume` of `volumes` behind each other.
float4 ltc_fetch_slice(Texture3D<float4> values, SamplerState values_sampler, LtcTable table,
    float4 at, float volume, float volumes) {
  float slice = at.y + table.size.y * (at.x + table.size.x * volume);
  float3 place = float3((at.w + 0.5) / table.size.w, (at.z + 0.5) / table.size.z,
                    (slice + 0.5) / (table.size.x * table.size.y * volumes));
  return values.SampleLevel(values_sampler, place, 0.0);
}
float4 ltc_fetch(Texture3D<float4> values, SamplerState values_sampler, LtcTable table, float4 at,
    float volume, float volumes) {
  float lower = floor(at.x);
  float upper = min(lower + 1.0, table.size.x - 1.0);
  float4 a = ltc_fetch_slice(values, values_sampler, table, float4(lower, at.y, at.z, at.w),
      volume, volumes);
  float4 b = ltc_fetch_slice(values, values_sampler, table, float4(upper, at.y, at.z, at.w),
      volume, volumes);
  return lerp(a, b, at.x - lower);
}

// By texels.
float4 ltc_texel(Texture3D<float4> values, LtcTable table, float4 node, float volume) {
  float slice = node.y + table.size.y * (node.x + table.size.x * volume);
  return values.Load(int4(int3(int(node.w), int(node.z), int(slice + 0.5)), 0));
}
float4 ltc_fetch_exact(Texture3D<float4> values, LtcTable table, float4 at, float volume) {
  float4 most = max(table.size - float4(2.0, 2.0, 2.0, 2.0), float4(0.0, 0.0, 0.0, 0.0));
  float4 lower = min(floor(at), most);
  float4 part = at - lower;
  float4 sum = float4(0.0, 0.0, 0.0, 0.0);
  for (int i = 0; i < 16; ++i) {
    float4 side = float4(float(i / 8), float((i / 4) % 2), float((i / 2) % 2), float(i % 2));
    // Not mix(), which drivers may round to a hundredth of a small weight.
    float4 one = float4(1.0, 1.0, 1.0, 1.0);
    float4 weights = (one - side) * (one - part) + side * part;
    float weight = weights.x * weights.y * weights.z * weights.w;
    if (weight > 0.0) {
      sum = sum + weight * ltc_texel(values, table, lower + side, volume);
    }
  }
  return sum;
}

// What the columns of M are scaled by: the roughnesses, or alpha_x and s_y (src/field/field.h).
float3 ltc_column_scale(LtcTable table, LtcReduced reduced) {
  float alpha = max(reduced.alpha, table.alpha_min);
  float beta = max(reduced.beta, table.alpha_min);
  if (table.storage > 3.5) {
    float lambda = beta / alpha;
    float least = 0.1 * alpha;
    beta = alpha * sqrt(lambda * lambda + least * least * (1.0 - lambda * lambda));
  }
  return float3(alpha, beta, 1.0);
}

// The reduced query's lobe of what was fetched. S is inverted, which is of the order of one, and not
// M; the roughness and the mirror's rotation are put on either side of the inverse (docs/files.md,
// "Inverting").
LtcLobe ltc_reduced_lobe(LtcTable table, LtcReduced reduced, LtcTexels texels) {
  float3 s0 = texels.a.xyz;
  float3 s1 = float3(texels.a.w, texels.b.x, texels.b.y);
  float3 s2 = float3(texels.b.z, texels.b.w, texels.c.x);
  float3 v = reduced.view;
  float3 scale = ltc_column_scale(table, reduced);
  LtcLobe lobe;
  if (table.storage > 2.5 && table.storage < 3.5) {
    // "inverse": W is what is stored.
    lobe = ltc_lobe_of_inverse_rows(s0, s1, s2, texels.c.y, texels.c.z);
  } else {
    // The columns of Q, the least rotation from z to the mirror direction (-vx, -vy, vz).
    float k = 1.0 / (1.0 + v.z);
    float3 q0 = float3(v.z + v.y * v.y * k, -v.x * v.y * k, v.x);
    float3 q1 = float3(-v.x * v.y * k, v.z + v.x * v.x * k, v.y);
    float3 q2 = float3(-v.x, -v.y, v.z);
    if (table.storage < 0.5) {
      s0 = s0 / scale;
      s1 = s1 / scale;
      s2 = s2 / scale;
    }
    if (table.storage < 1.5) {
      float3 r0 = s0;
      float3 r1 = s1;
      float3 r2 = s2;
      s0 = q0.x * r0 + q0.y * r1 + q0.z * r2;
      s1 = q1.x * r0 + q1.y * r1 + q1.z * r2;
      s2 = q2.x * r0 + q2.y * r1 + q2.z * r2;
    }
    lobe = ltc_lobe_of_rows(s0, s1, s2, texels.c.y, texels.c.z);
    // M = Q S A, W = A^-1 S^-1 Q^T.
    float3 a0 = scale * s0;
    float3 a1 = scale * s1;
    float3 a2 = scale * s2;
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
LtcLobe ltc_unreduce(LtcTable table, LtcReduced reduced, LtcTexels texels) {
  LtcLobe lobe = ltc_reduced_lobe(table, reduced, texels);
  if (reduced.swapped > 0.5) {
    LtcLobe other = lobe;
    lobe.m0 = float3(other.m1.y, other.m1.x, other.m1.z);
    lobe.m1 = float3(other.m0.y, other.m0.x, other.m0.z);
    lobe.m2 = float3(other.m2.y, other.m2.x, other.m2.z);
    lobe.w0 = float3(other.w1.y, other.w1.x, other.w1.z);
    lobe.w1 = float3(other.w0.y, other.w0.x, other.w0.z);
    lobe.w2 = float3(other.w2.y, other.w2.x, other.w2.z);
  }
  float3 signs = float3(reduced.signs.x, reduced.signs.y, 1.0);
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
LtcLobe ltc_look_up(Texture3D<float4> values_0, SamplerState values_0_sampler,
    Texture3D<float4> values_1, SamplerState values_1_sampler, Texture3D<float4> values_2,
    SamplerState values_2_sampler, LtcTable table, float3 view, float alpha_x, float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  float4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch(values_0, values_0_sampler, table, at, 0.0, 1.0);
  texels.b = ltc_fetch(values_1, values_1_sampler, table, at, 0.0, 1.0);
  texels.c = ltc_fetch(values_2, values_2_sampler, table, at, 0.0, 1.0);
  return ltc_unreduce(table, reduced, texels);
}

// The same of one texture with the three behind each other.
LtcLobe ltc_look_up_stacked(Texture3D<float4> values, SamplerState values_sampler, LtcTable table,
    float3 view, float alpha_x, float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  float4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch(values, values_sampler, table, at, 0.0, 3.0);
  texels.b = ltc_fetch(values, values_sampler, table, at, 1.0, 3.0);
  texels.c = ltc_fetch(values, values_sampler, table, at, 2.0, 3.0);
  return ltc_unreduce(table, reduced, texels);
}

LtcLobe ltc_look_up_exact(Texture3D<float4> values_0, Texture3D<float4> values_1,
    Texture3D<float4> values_2, LtcTable table, float3 view, float alpha_x, float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  float4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch_exact(values_0, table, at, 0.0);
  texels.b = ltc_fetch_exact(values_1, table, at, 0.0);
  texels.c = ltc_fetch_exact(values_2, table, at, 0.0);
  return ltc_unreduce(table, reduced, texels);
}

LtcLobe ltc_look_up_stacked_exact(Texture3D<float4> values, LtcTable table, float3 view,
    float alpha_x, float alpha_y) {
  LtcReduced reduced = ltc_reduce(table, view, alpha_x, alpha_y);
  float4 at = ltc_positions(table, reduced);
  LtcTexels texels;
  texels.a = ltc_fetch_exact(values, table, at, 0.0);
  texels.b = ltc_fetch_exact(values, table, at, 1.0);
  texels.c = ltc_fetch_exact(values, table, at, 2.0);
  return ltc_unreduce(table, reduced, texels);
}
