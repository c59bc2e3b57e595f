// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The camera, the light, and the picture on it.

const VIEW_SCALE = 1 / (Math.sqrt(35) * 0.94);  // the sphere is 0.94 of the picture's height
const CAMERA_DISTANCE = 6;

// Degrees above the horizontal: never over the pole, nor below what has no underside.
function elevationOf(state) {
  const flat = state.shape !== 'sphere';
  return clamp((flat ? 30 : 0) + state.pitch, flat ? 4 : -86, 86);
}

function cameraOf(state) {
  const azimuth = radians(state.yaw), elevation = radians(elevationOf(state));
  const back = [Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation),
                Math.cos(azimuth) * Math.cos(elevation)];
  const right = [Math.cos(azimuth), 0, -Math.sin(azimuth)];
  return { position: scaled(CAMERA_DISTANCE, back), frame: [...right, ...cross(back, right), ...back] };
}

const HALF_SIDES = { rectangle: [1.1, 0.7], picture: [1.1, 0.7], star: [1, 1], disk: [0.8, 0.8],
                     sphere: [0.6, 0.6], line: [1.1, 1.1] };
const LIGHT_RADII = { sphere: 0.6, line: 0.03 };

// Turned towards the origin, its u side level, as src/render/sphere_scene.cpp does.
function lightOf(state) {
  const center = PLACES.map((key) => state[key]);
  const normal = lengthOf(center) > 1e-3 ? unit(scaled(-1, center)) : [0, -1, 0];
  const level = Math.hypot(normal[0], normal[2]);
  const east = level > 0 ? [normal[2] / level, 0, -normal[0] / level] : [1, 0, 0];
  const [u, v] = HALF_SIDES[state.light];
  return { center, u: scaled(u * state.light_size, east),
           v: scaled(v * state.light_size, cross(normal, east)),
           radius: (LIGHT_RADII[state.light] ?? 0) * state.light_size };
}

// The light's outline in the world, for drawings.
function outlineOf(state, steps = 48) {
  const { center, u, v } = lightOf(state);
  const at = (a, b) => sum(center, sum(scaled(a, u), scaled(b, v)));
  if (state.light === 'line') return [at(-1, 0), at(1, 0)];
  const points = [];
  if (state.light === 'rectangle' || state.light === 'picture') {
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    corners.forEach(([a, b], i) => {
      const [c, d] = corners[(i + 1) % 4];
      for (let k = 0; k < 12; ++k) points.push(at(a + (c - a) * k / 12, b + (d - b) * k / 12));
    });
    return points;
  }
  const count = state.light === 'star' ? 10 : steps;
  for (let i = 0; i < count; ++i) {
    const r = state.light !== 'star' ? 1 : i % 2 ? 0.45 : 1.1, angle = 2 * Math.PI * i / count;
    points.push(at(-r * Math.sin(angle), r * Math.cos(angle)));
  }
  return points;
}

// Why the picture is not what it should be; empty where nothing is wrong.
function faultOfLight(state) {
  const { center, radius } = lightOf(state);
  const ball = state.light === 'sphere' ? radius : 0;
  const [x, y, z] = center;
  const far = state.shape === 'sphere' ? lengthOf(center) - 1
    : state.shape === 'plane' ? Math.hypot(Math.max(Math.abs(x) - 1.6, 0), y, Math.max(Math.abs(z) - 1.6, 0))
    : Math.max(Math.abs(x) - 1.6, 0) + Math.abs(Math.hypot(y + 1, z) - 1.5);
  if (far > ball) return '';
  return `The light touches the ${state.shape}: what is shown is not to be trusted.`;
}

// ---- The picture: panes of stained glass, the same everywhere ----

const PICTURE_TEXELS = 192, LEVEL_TEXELS = 256;

function paneSeeds() {
  const seeds = [];
  const colors = [[0.9, 0.03, 0.02], [1, 0.36, 0.03], [0.02, 0.11, 0.9], [0.01, 0.42, 0.13],
                  [0.9, 0.72, 0.32], [0.36, 0.02, 0.55], [0.02, 0.5, 0.75]];
  let state = 12345;
  const random = () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state / 2 ** 32; };
  for (let row = 0; row < 5; ++row)
    for (let column = 0; column < 7; ++column)
      seeds.push({ x: (column + 0.2 + 0.6 * random()) / 7, y: (row + 0.2 + 0.6 * random()) / 5,
                   color: colors[Math.floor(random() * colors.length)] });
  return seeds;
}

// Three planes of linear values, row 0 at the light's lower side.
function stainedGlass() {
  const n = PICTURE_TEXELS, planes = [0, 1, 2].map(() => new Float32Array(n * n));
  const seeds = paneSeeds();
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      const x = (i + 0.5) / n, y = (j + 0.5) / n;
      let first = { d: 9 }, second = 9;
      for (const seed of seeds) {
        const d = Math.hypot((x - seed.x) * 1.57, y - seed.y);
        if (d < first.d) { second = first.d; first = { d, seed }; } else if (d < second) second = d;
      }
      const frame = Math.min(x, 1 - x) < 0.018 || Math.min(y, 1 - y) < 0.028;
      const lead = frame || second - first.d < 0.016 ? 0.02 : 1;
      const glow = 0.75 + 0.5 * Math.exp(-30 * first.d * first.d);
      first.seed.color.forEach((c, k) => { planes[k][j * n + i] = Math.min(lead * glow * c, 1.5); });
    }
  return planes;
}

// Weights of a Gaussian about each texel of a level, over the picture alone: `ltcfit prefilter`'s.
function levelWeights(level) {
  const size = LEVEL_TEXELS >> level, n = PICTURE_TEXELS, rows = [];
  for (let i = 0; i < size; ++i) {
    const at = ((i + 0.5) / size - 0.125) / 0.75;
    const sigma = Math.max(2 ** level / LEVEL_TEXELS, Math.max(-at, at - 1) / 2);
    const from = Math.max(0, Math.floor((at - 4 * sigma) * n)), to = Math.min(n, Math.ceil((at + 4 * sigma) * n));
    const weights = [];
    let total = 0;
    for (let j = from; j < to; ++j) {
      const d = ((j + 0.5) / n - at) / sigma;
      weights.push(Math.exp(-0.5 * d * d));
      total += weights.at(-1);
    }
    rows.push({ from, weights: weights.map((w) => w / total) });
  }
  return rows;
}

// One level as RGBA. Margins have other widths than the inside, so that rows and columns each have
// their own weights.
function pictureLevel(planes, level) {
  const weights = levelWeights(level), size = weights.length, n = PICTURE_TEXELS;
  const values = new Float32Array(4 * size * size).fill(1);
  planes.forEach((plane, channel) => {
    const across = new Float32Array(size * n);
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < size; ++i) {
        let total = 0;
        weights[i].weights.forEach((w, k) => { total += w * plane[j * n + weights[i].from + k]; });
        across[j * size + i] = total;
      }
    for (let j = 0; j < size; ++j)
      for (let i = 0; i < size; ++i) {
        let total = 0;
        weights[j].weights.forEach((w, k) => { total += w * across[(weights[j].from + k) * size + i]; });
        values[4 * (j * size + i) + channel] = total;
      }
  });
  return { size, values };
}

function pictureLevels() {
  const planes = stainedGlass(), levels = [];
  for (let level = 0; LEVEL_TEXELS >> level > 0; ++level) levels.push(pictureLevel(planes, level));
  return levels;
}
