// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is seen: an object, its tangent frame and the light, as src/render has them. SHAPE and LIGHT
// are numbers that the page puts before the shaders.

const int SPHERE = 0, PLANE = 1, SHEET = 2;
const int RECTANGLE = 0, STAR = 1, DISK = 2, BALL = 3, LINE = 4, PICTURE = 5;

uniform vec3 camera;
uniform mat3 camera_frame;  // columns: to the right, up, back
uniform float view_scale;   // of the picture's half side at distance 1
uniform vec3 picture;       // the middle of its square, and its side, pixels
uniform vec2 turn;          // cosine and sine of the tangent frame's turn about the normal

// One-sided lights emit to the side of u x v. Half sides; of disks radii, of stars unit lengths.
uniform vec3 light_center, light_u, light_v;
uniform float light_radius;  // of spheres and lines

uniform sampler2D light_levels;  // of a light with a picture

uniform vec2 alpha;
uniform vec3 f0;

struct Hit {
  bool found;
  float far;
  vec3 position;
  vec3 tangent, bitangent, normal;
};

vec3 ray_at(vec2 pixel) {
  vec2 place = 2.0 * (pixel - picture.xy) / picture.z;
  return normalize(camera_frame * vec3(view_scale * place, -1.0));
}

// One of the 2 x 2 points of a pixel, or its middle.
vec2 point_of_pixel(int i, int points) {
  vec2 corner = floor(gl_FragCoord.xy);
  if (points == 1) {
    return corner + 0.5;
  }
  return corner + vec2(0.25 + 0.5 * float(i % 2), 0.25 + 0.5 * float(i / 2));
}

Hit hit_sphere(vec3 ray) {
  Hit hit;
  float towards = -dot(camera, ray);
  vec3 nearest = camera + towards * ray;
  float squared = 1.0 - dot(nearest, nearest);
  hit.found = squared > 0.0 && towards > 0.0;
  hit.far = towards - sqrt(max(squared, 0.0));
  hit.normal = normalize(camera + hit.far * ray);
  hit.position = hit.normal;
  // East and north.
  float across = length(hit.normal.xz);
  hit.tangent = across > 0.0 ? vec3(hit.normal.z, 0.0, -hit.normal.x) / across : vec3(1, 0, 0);
  hit.bitangent = cross(hit.normal, hit.tangent);
  return hit;
}

Hit hit_plane(vec3 ray) {
  Hit hit;
  hit.far = -camera.y / ray.y;
  hit.position = camera + hit.far * ray;
  hit.position.y = 0.0;
  hit.found = ray.y < 0.0 && hit.far > 0.0 &&
              max(abs(hit.position.x), abs(hit.position.z)) <= 1.6;
  hit.normal = vec3(0, 1, 0);
  hit.tangent = vec3(1, 0, 0);
  hit.bitangent = vec3(0, 0, -1);
  return hit;
}

// Of a cylinder of radius 1.5 about an axis along x; its back is not seen.
Hit hit_sheet(vec3 ray) {
  Hit hit;
  vec2 from = vec2(camera.y + 1.0, camera.z) / 1.5;
  vec2 along = ray.yz / 1.5;
  float a = dot(along, along);
  float towards = -dot(from, along) / a;
  vec2 nearest = from + towards * along;
  float squared = (1.0 - dot(nearest, nearest)) / a;
  hit.far = towards - sqrt(max(squared, 0.0));
  vec2 around = normalize(from + hit.far * along);
  hit.position = vec3(camera.x + hit.far * ray.x, 1.5 * around.x - 1.0, 1.5 * around.y);
  hit.found = squared > 0.0 && hit.far > 0.0 && abs(hit.position.x) <= 1.6 && around.x >= 0.5;
  hit.normal = vec3(0, around);
  hit.tangent = vec3(1, 0, 0);
  hit.bitangent = vec3(0, around.y, -around.x);
  return hit;
}

Hit hit_of(vec3 ray) {
  Hit hit;
  if (SHAPE == SPHERE) {
    hit = hit_sphere(ray);
  } else if (SHAPE == PLANE) {
    hit = hit_plane(ray);
  } else {
    hit = hit_sheet(ray);
  }
  vec3 tangent = turn.x * hit.tangent + turn.y * hit.bitangent;
  hit.bitangent = turn.x * hit.bitangent - turn.y * hit.tangent;
  hit.tangent = tangent;
  return hit;
}

vec3 to_tangent(Hit hit, vec3 d) {
  return vec3(dot(hit.tangent, d), dot(hit.bitangent, d), dot(hit.normal, d));
}

// Never below the horizon, where rounding may take it.
vec3 view_of(Hit hit, vec3 ray) {
  vec3 view = to_tangent(hit, -ray);
  view.z = max(view.z, 1e-6);
  return normalize(view);
}

// The light as a point sees it: relative to it, in its tangent frame.
struct Light {
  vec3 center, u, v;
};
Light light_of(Hit hit) {
  Light light;
  light.center = to_tangent(hit, light_center - hit.position);
  light.u = to_tangent(hit, light_u);
  light.v = to_tangent(hit, light_v);
  return light;
}

// The ten vertices: five points of radius 1.1, notches of radius 0.45, the first point up.
vec2 star_vertex(int i) {
  float angle = 0.62831853 * float(i);
  return (i % 2 == 0 ? 1.1 : 0.45) * vec2(-sin(angle), cos(angle));
}
bool in_star(vec2 place) {
  float sector = 1.25663706;
  float angle = abs(mod(atan(place.x, place.y) + 0.5 * sector, sector) - 0.5 * sector);
  vec2 folded = length(place) * vec2(cos(angle), sin(angle)) - vec2(1.1, 0.0);
  vec2 edge = 0.45 * vec2(0.80901699, 0.58778525) - vec2(1.1, 0.0);
  return edge.x * folded.y - edge.y * folded.x >= 0.0;
}
bool in_light(vec2 place) {
  if (LIGHT == STAR) {
    return in_star(place);
  }
  if (LIGHT == DISK) {
    return dot(place, place) <= 1.0;
  }
  return max(abs(place.x), abs(place.y)) <= 1.0;
}
