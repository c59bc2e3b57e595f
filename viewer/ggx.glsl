// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// GGX itself, by sampling: as src/brdf/ggx.cpp, without cancellation, and src/render/shading.cpp, with
// samples of the light and of the lobe weighted by the balance heuristic. Other BRDFs are evaluated
// in its place: Beckmann, whose tails are lighter, by the same samples, sheen by even ones.

const float PI = 3.14159265;

const int GGX = 0, BECKMANN = 1, CHARLIE = 2, ASHIKHMIN = 3;
const int BRDF = GGX;  // the page's tables'

struct Ggx {
  vec3 view;
  vec2 alpha;
  vec3 stretched;  // the view at unit roughness
  float one_minus_stretched_z;
  float vz_one_plus_lambda;
};

float squared(float x) { return x * x; }

Ggx ggx_of(vec3 view, vec2 alphas) {
  Ggx ggx;
  ggx.view = view;
  ggx.alpha = alphas;
  ggx.stretched = normalize(vec3(alphas * view.xy, view.z));
  ggx.one_minus_stretched_z = dot(ggx.stretched.xy, ggx.stretched.xy) / (1.0 + ggx.stretched.z);
  vec2 slopes = alphas * view.xy;
  ggx.vz_one_plus_lambda = 0.5 * (view.z + sqrt(view.z * view.z + dot(slopes, slopes)));
  return ggx;
}

// Abramowitz and Stegun 7.1.26, to 1.5e-7; of what is not negative.
float erfc_over_exp(float x) {
  float t = 1.0 / (1.0 + 0.3275911 * x);
  return t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 +
              t * 1.061405429))));
}

// z Lambda of brdf/beckmann.h, s the stretched sine.
float beckmann_z_lambda(float z, float s) {
  float a = min(z / max(s, 1e-20), 9.0);
  return max(0.5 * exp(-a * a) * (s * 0.56418958 - z * erfc_over_exp(a)), 0.0);
}

// BRDF times cosine.
float beckmann(Ggx ggx, vec3 half_vector, vec3 light) {
  if (half_vector.z <= 0.0 || light.z <= 0.0) {
    return 0.0;
  }
  float z_squared = squared(half_vector.z);
  float steepness = (squared(half_vector.x / ggx.alpha.x) + squared(half_vector.y / ggx.alpha.y)) /
                    z_squared;
  float ndf = exp(-steepness) * squared(dot(half_vector, half_vector) / z_squared) /
              (PI * ggx.alpha.x * ggx.alpha.y);
  float of_view = ggx.view.z + beckmann_z_lambda(ggx.view.z, length(ggx.alpha * ggx.view.xy));
  float lambda = beckmann_z_lambda(light.z, length(ggx.alpha * light.xy)) / light.z;
  return ndf / (4.0 * (of_view + ggx.view.z * lambda));
}

// brdf/charlie.h.
float charlie_fit(float alpha, float x) {
  float t = squared(1.0 - alpha);
  return mix(21.5473, 25.3245, t) / (1.0 + mix(3.82987, 3.32435, t) *
         pow(max(x, 1e-9), mix(0.19823, 0.16801, t))) - mix(1.97760, 1.27393, t) * x -
         mix(4.32054, 4.85967, t);
}
float charlie_lambda(float alpha, float z) {
  return z < 0.5 ? exp(charlie_fit(alpha, z))
                 : exp(2.0 * charlie_fit(alpha, 0.5) - charlie_fit(alpha, 1.0 - z));
}
float sheen(Ggx ggx, vec3 half_vector, vec3 light) {
  float v = ggx.view.z, l = light.z, alpha = ggx.alpha.x;
  if (l <= 0.0) {
    return 0.0;
  }
  float sine_squared = dot(half_vector.xy, half_vector.xy) / dot(half_vector, half_vector);
  float ndf = (2.0 + 1.0 / alpha) * pow(sine_squared, 0.5 / alpha) / (2.0 * PI);
  return BRDF == ASHIKHMIN
             ? ndf * l / (4.0 * (v + l - v * l))
             : ndf / ((1.0 + charlie_lambda(alpha, v) + charlie_lambda(alpha, l)) * 4.0 * v);
}

// BRDF times cosine, and the density of reflections about visible normals; of a half vector of any
// length.
vec2 ggx_densities(Ggx ggx, vec3 half_vector, vec3 light) {
  if (BRDF == CHARLIE || BRDF == ASHIKHMIN) {
    return vec2(sheen(ggx, half_vector, light), light.z > 0.0 ? 0.5 / PI : 0.0);
  }
  float stretched = squared(half_vector.x / ggx.alpha.x) + squared(half_vector.y / ggx.alpha.y) +
                    squared(half_vector.z);
  float ndf = half_vector.z > 0.0 ? squared(dot(half_vector, half_vector) / stretched) /
                                        (PI * ggx.alpha.x * ggx.alpha.y)
                                  : 0.0;
  vec2 densities = vec2(0, ndf / (4.0 * ggx.vz_one_plus_lambda));
  if (BRDF == BECKMANN) {
    densities.x = beckmann(ggx, half_vector, light);
  } else if (light.z > 0.0) {
    vec2 slopes = ggx.alpha * light.xy;
    float s = dot(slopes, slopes);
    float lambda = s / (2.0 * light.z * (light.z + sqrt(light.z * light.z + s)));
    densities.x = ndf / (4.0 * (ggx.vz_one_plus_lambda + ggx.view.z * lambda));
  }
  return densities;
}

// The offset of a reflection from the mirror direction (-vx, -vy, vz), and v.h.
vec4 ggx_sample(Ggx ggx, vec2 random) {
  float azimuth = 2.0 * PI * random.x;
  if (BRDF == CHARLIE || BRDF == ASHIKHMIN) {
    float sine_of_even = sqrt((1.0 - random.y) * (1.0 + random.y));
    vec3 light = vec3(sine_of_even * vec2(cos(azimuth), sin(azimuth)), random.y);
    return vec4(light - vec3(-ggx.view.xy, ggx.view.z),
                sqrt(max(0.5 + 0.5 * dot(ggx.view, light), 0.0)));
  }
  float depth = random.y * (1.0 + ggx.stretched.z);
  float above_rim = (1.0 - random.y) * (1.0 + ggx.stretched.z);
  float sine = sqrt(depth * (above_rim + ggx.one_minus_stretched_z));
  vec2 cap = sine * vec2(cos(azimuth), sin(azimuth)) + ggx.stretched.xy;
  vec3 h = normalize(vec3(ggx.alpha * cap, above_rim));
  float hz_minus_one = -dot(h.xy, h.xy) / (1.0 + h.z);
  float beyond = dot(ggx.view.xy, h.xy) + ggx.view.z * hz_minus_one;
  float v_dot_h = ggx.view.z + beyond;
  return vec4(2.0 * vec3(v_dot_h * h.xy, beyond * h.z + ggx.view.z * hz_minus_one), v_dot_h);
}

vec3 schlick(float v_dot_h) {
  float x = clamp(1.0 - v_dot_h, 0.0, 1.0);
  return f0 + (1.0 - f0) * (x * x * x * x * x);
}

// A light in the way that its samples want it.
struct Source {
  bool seen;
  vec3 center, u, v, normal;
  float height;  // of the point above the light's plane
  float area;
  vec2 inverse_squares;
  float spread;  // 1 - cosine of a sphere's cone
};

Source source_of(Light light) {
  Source source;
  source.center = light.center;
  source.u = light.u;
  source.v = light.v;
  source.spread = 0.0;
  if (LIGHT == LINE) {
    // A thin cylinder is as wide to any point: a strip that faces it.
    vec3 side = normalize(cross(light.u, light.center));
    source.v = light_radius * side;
    if (dot(cross(source.u, source.v), source.center) > 0.0) {
      source.v = -source.v;
    }
  }
  if (LIGHT == BALL) {
    float ratio = light_radius * light_radius / dot(light.center, light.center);
    source.spread = ratio < 1.0 ? ratio / (1.0 + sqrt(1.0 - ratio)) : 2.0;
    source.seen = true;
    return source;
  }
  source.normal = normalize(cross(source.u, source.v));
  source.height = -dot(source.normal, source.center);
  source.seen = source.height > 0.0;
  source.inverse_squares = 1.0 / vec2(dot(source.u, source.u), dot(source.v, source.v));
  float shape = LIGHT == DISK ? PI : LIGHT == STAR ? 1.45477852 : 4.0;
  source.area = shape * length(source.u) * length(source.v);
  return source;
}

vec3 light_radiance(vec2 place) {
  return LIGHT == PICTURE ? textureLod(light_levels, 0.375 * place + 0.5, 0.0).xyz : vec3(1);
}

vec2 place_on_light(vec2 random) {
  if (LIGHT == DISK) {
    float azimuth = 2.0 * PI * random.y;
    return sqrt(random.x) * vec2(cos(azimuth), sin(azimuth));
  }
  if (LIGHT == STAR) {
    float which = min(floor(10.0 * random.x), 9.0);
    float far = sqrt(10.0 * random.x - which);
    int i = int(which);
    return far * mix(star_vertex(i), star_vertex(i + 1), random.y);
  }
  return 2.0 * random - 1.0;
}

float plane_density(Source source, float far) {
  return far * far * far / (source.area * source.height);
}

vec3 weighed(Ggx ggx, vec3 half_vector, vec3 direction, float v_dot_h, float light_density,
             vec3 radiance) {
  vec2 lobe = ggx_densities(ggx, half_vector, direction);
  float both = light_density + lobe.y;
  return lobe.x > 0.0 && both > 0.0 ? lobe.x / both * schlick(v_dot_h) * radiance : vec3(0);
}

vec3 of_light(Ggx ggx, Source source, vec2 random) {
  vec3 direction;
  float density;
  vec3 radiance = vec3(1);
  if (LIGHT == BALL) {
    vec3 axis = normalize(source.center);
    float z = 1.0 - random.x * source.spread;
    float r = sqrt(max(random.x * source.spread * (1.0 + z), 0.0));
    vec3 side = normalize(abs(axis.z) < 0.7 ? cross(axis, vec3(0, 0, 1)) : cross(axis, vec3(1, 0, 0)));
    float azimuth = 2.0 * PI * random.y;
    direction = normalize(z * axis + r * (cos(azimuth) * side + sin(azimuth) * cross(axis, side)));
    density = 1.0 / (2.0 * PI * source.spread);
  } else {
    vec2 place = place_on_light(random);
    vec3 point = source.center + place.x * source.u + place.y * source.v;
    float far = length(point);
    direction = point / far;
    density = plane_density(source, far);
    radiance = light_radiance(place);
  }
  if (direction.z <= 0.0) {
    return vec3(0);
  }
  float v_dot_h = sqrt(max(0.5 + 0.5 * dot(ggx.view, direction), 0.0));
  return weighed(ggx, ggx.view + direction, direction, v_dot_h, density, radiance);
}

vec3 of_lobe(Ggx ggx, Source source, vec2 random) {
  vec4 offset = ggx_sample(ggx, random);
  vec3 direction = vec3(-ggx.view.xy, ggx.view.z) + offset.xyz;
  if (direction.z <= 0.0) {
    return vec3(0);
  }
  float density;
  vec3 radiance = vec3(1);
  if (LIGHT == BALL) {
    float inside = length(direction - normalize(source.center) * length(direction));
    if (0.5 * inside * inside > source.spread) {
      return vec3(0);
    }
    density = 1.0 / (2.0 * PI * source.spread);
  } else {
    float towards = dot(source.normal, direction);
    if (towards >= 0.0) {
      return vec3(0);
    }
    float far = -source.height / towards;
    vec3 from_center = far * direction - source.center;
    vec2 place = vec2(dot(from_center, source.u), dot(from_center, source.v)) * source.inverse_squares;
    if (!in_light(place)) {
      return vec3(0);
    }
    density = plane_density(source, far);
    radiance = light_radiance(place);
  }
  vec3 half_vector = vec3(offset.xy, 2.0 * ggx.view.z + offset.z);
  return weighed(ggx, half_vector, direction, offset.w, density, radiance);
}
