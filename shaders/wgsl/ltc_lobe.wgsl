// SPDX-License-Identifier: MIT
// Made from shaders/glsl/ltc_lobe.glsl by scripts/translate-shaders; change that.
// Copyright (c) 2026 the ltcfit authors
// A lobe in a shader: a linearly transformed cosine and how much of the light it reflects.
//
// Directions and points are of the tangent frame: z the surface normal, x the direction of alpha_x,
// points relative to the one that is shaded. Written in the part of GLSL (4.50 and ES 3.00) that
// scripts/translate-shaders turns into HLSL and WGSL: see shaders/README.md.

const LTC_PI: f32 = 3.14159265;

// M takes directions of the clamped cosine to those of the lobe; W is its inverse. Both by their rows;
// their determinants are positive.
struct LtcLobe {
  m0: vec3<f32>,
  m1: vec3<f32>,
  m2: vec3<f32>,
  w0: vec3<f32>,
  w1: vec3<f32>,
  w2: vec3<f32>,
  amplitude: f32,  // integral of BRDF times cosine with F = 1: the albedo of a white mirror
  fresnel: f32,    // of its part by Schlick's (1 - v.h)^5
}

// Of W, of M: a direction to the space of the cosine, and from there to that of the lobe.
fn ltc_to_cosine(lobe: LtcLobe, p: vec3<f32>) -> vec3<f32> {
  return vec3<f32>(dot(lobe.w0, p), dot(lobe.w1, p), dot(lobe.w2, p));
}
fn ltc_from_cosine(lobe: LtcLobe, p: vec3<f32>) -> vec3<f32> {
  return vec3<f32>(dot(lobe.m0, p), dot(lobe.m1, p), dot(lobe.m2, p));
}

// The lobe of M alone: its inverse is computed. What a field's function gives.
fn ltc_lobe_of_rows(m0: vec3<f32>, m1: vec3<f32>, m2: vec3<f32>, amplitude: f32,
    fresnel: f32) -> LtcLobe {
  var lobe: LtcLobe;
  lobe.m0 = m0;
  lobe.m1 = m1;
  lobe.m2 = m2;
  var c0: vec3<f32> = vec3<f32>(m0.x, m1.x, m2.x);
  var c1: vec3<f32> = vec3<f32>(m0.y, m1.y, m2.y);
  var c2: vec3<f32> = vec3<f32>(m0.z, m1.z, m2.z);
  var last: vec3<f32> = cross(c0, c1);
  var scale: f32 = 1.0 / max(dot(last, c2), 1e-30);
  lobe.w0 = scale * cross(c1, c2);
  lobe.w1 = scale * cross(c2, c0);
  lobe.w2 = scale * last;
  lobe.amplitude = amplitude;
  lobe.fresnel = fresnel;
  return lobe;
}

// The lobe of W alone: M is computed. What engines' textures hold.
fn ltc_lobe_of_inverse_rows(w0: vec3<f32>, w1: vec3<f32>, w2: vec3<f32>, amplitude: f32,
    fresnel: f32) -> LtcLobe {
  var other: LtcLobe = ltc_lobe_of_rows(w0, w1, w2, amplitude, fresnel);
  var lobe: LtcLobe = other;
  lobe.m0 = other.w0;
  lobe.m1 = other.w1;
  lobe.m2 = other.w2;
  lobe.w0 = other.m0;
  lobe.w1 = other.m1;
  lobe.w2 = other.m2;
  return lobe;
}

// Per steradian, at a unit direction: equation (7) of Aakash et al. 2022. Integrates to 1 over the
// sphere; the share below the horizon is that of ltc_below_horizon.
fn ltc_density(lobe: LtcLobe, omega: vec3<f32>) -> f32 {
  var cosine: vec3<f32> = ltc_to_cosine(lobe, omega);
  var squared: f32 = dot(cosine, cosine);
  var determinant: f32 = dot(lobe.w0, cross(lobe.w1, lobe.w2));
  return max(cosine.z, 0.0) * determinant / (LTC_PI * squared * squared);
}

// A unit direction so distributed, from two numbers on [0, 1); before it, that of the cosine.
fn ltc_cosine_direction(u1: f32, u2: f32) -> vec3<f32> {
  var radius: f32 = sqrt(u1);
  var azimuth: f32 = 2.0 * LTC_PI * u2;
  return vec3<f32>(radius * cos(azimuth), radius * sin(azimuth), sqrt(max(1.0 - u1, 0.0)));
}
fn ltc_direction(lobe: LtcLobe, u1: f32, u2: f32) -> vec3<f32> {
  return normalize(ltc_from_cosine(lobe, ltc_cosine_direction(u1, u2)));
}

// The share of the lobe below the horizon, exact.
fn ltc_below_horizon(lobe: LtcLobe) -> f32 { return 0.5 - 0.5 * lobe.m2.z / length(lobe.m2); }

// GGX has nothing there. What the share of any light may be multiplied by to make up for it, at most
// 16; one factor serves all lights of a pixel.
fn ltc_horizon_factor(lobe: LtcLobe) -> f32 {
  return 1.0 / max(1.0 - ltc_below_horizon(lobe), 0.0625);
}

// The same lobe turned about the normal by an angle of this cosine and sine.
fn ltc_turned(lobe: LtcLobe, c: f32, s: f32) -> LtcLobe {
  var turned: LtcLobe = lobe;
  turned.m0 = c * lobe.m0 - s * lobe.m1;
  turned.m1 = s * lobe.m0 + c * lobe.m1;
  turned.w0 = vec3<f32>(c * lobe.w0.x - s * lobe.w0.y, s * lobe.w0.x + c * lobe.w0.y, lobe.w0.z);
  turned.w1 = vec3<f32>(c * lobe.w1.x - s * lobe.w1.y, s * lobe.w1.x + c * lobe.w1.y, lobe.w1.z);
  turned.w2 = vec3<f32>(c * lobe.w2.x - s * lobe.w2.y, s * lobe.w2.x + c * lobe.w2.y, lobe.w2.z);
  return turned;
}

// Shading is this times the share of the lobe's light that comes from the source. F0: the reflectance
// at normal incidence.
fn ltc_reflectance(lobe: LtcLobe, f0: vec3<f32>) -> vec3<f32> {
  return lobe.fresnel * vec3<f32>(1.0, 1.0, 1.0) + (lobe.amplitude - lobe.fresnel) * f0;
}

// What one bounce loses of a rough metal's light, given back: the factor 1 + F0 (1/E - 1), E being
// the amplitude (Turquin 2019, "Practical multiple scattering compensation for microfacet models").
fn ltc_energy_compensation(lobe: LtcLobe, f0: vec3<f32>) -> vec3<f32> {
  return vec3<f32>(1.0, 1.0, 1.0) + (1.0 / max(lobe.amplitude, 1e-3) - 1.0) * f0;
}

// The angle of (x, y) for y >= 0, on [0, pi], within 2e-7: drivers' own are up to 1e-3 off.
fn ltc_angle(y: f32, x: f32) -> f32 {
  var far: f32 = max(abs(x), y);
  var t: f32 = min(abs(x), y) / max(far, 1e-30);
  var s: f32 = t * t;
  var angle: f32 = 0.00290351757;
  angle = angle * s - 0.0162828695;
  angle = angle * s + 0.0430391431;
  angle = angle * s - 0.0753365755;
  angle = angle * s + 0.106546685;
  angle = angle * s - 0.142071322;
  angle = angle * s + 0.199930534;
  angle = angle * s - 0.333330929;
  angle = angle * s + 1.0;
  angle = angle * t;
  if (abs(x) < y) {
    angle = 0.5 * LTC_PI - angle;
  }
  if (x < 0.0) {
    angle = LTC_PI - angle;
  }
  return angle;
}

// The sine of an angle on [-pi/2, pi/2], within 1e-7: drivers' own may be 5e-4 off.
fn ltc_sine(x: f32) -> f32 {
  var s: f32 = x * x;
  var sine: f32 = -2.3889779e-08;
  sine = sine * s + 2.75253046e-06;
  sine = sine * s - 0.000198408612;
  sine = sine * s + 0.00833333097;
  sine = sine * s - 0.166666672;
  sine = sine * s + 1.0;
  return sine * x;
}
