// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page: renders each sphere by GGX, by three.js' own table and by the given one, and sends
// figures and a picture to run.js.
import { draw, percent, sides } from './picture.js';

const asked = new URLSearchParams(location.search);
const size = Number(asked.get('size')), lightSize = Number(asked.get('lightSize')), f0 = 0.6;

const errors = [];
const note = (...parts) => errors.push(parts.join(' '));
console.error = note;  // where three.js tells of shaders that do not compile

const mean = (values) => values.reduce((sum, x) => sum + x, 0) / values.length;

function compare(own, given, roughness) {
  const ggx = own.draw('ggx', roughness);
  const images = { own: own.draw('rendered', roughness), given: given.draw('rendered', roughness) };
  const inside = [];
  for (let i = 0; i < ggx.length; i += 4) if (ggx[i + 3] > 0) inside.push(i);
  const reference_mean = mean(inside.map((i) => ggx[i]));
  const error = (image) => mean(inside.map((i) => Math.abs(image[i] - ggx[i]))) / reference_mean;
  return { ggx, images, figures: {
    roughness, reference_mean, own: error(images.own), given: error(images.given),
    own_lobes: error(own.draw('lobe', roughness)), given_lobes: error(given.draw('lobe', roughness)),
    reference_error: error(own.draw('ggx', roughness, 0.75))
  } };
}

// One value a pixel, from the topmost line on; WebGL's first row is the lowest.
const topFirst = (image, channel) =>
  Float32Array.from({ length: size * size }, (_, i) =>
    image[4 * ((size - 1 - Math.floor(i / size)) * size + i % size) + channel]);

function shown({ ggx, images, figures }) {
  return {
    ggx: topFirst(ggx, 0), images: [images.own, images.given].map((image) => topFirst(image, 0)),
    covered: topFirst(ggx, 3), head: `roughness ${figures.roughness}`,
    lines: [
      'its own table', `mean |error| ${percent(figures.own)}`, `lobes alone ${percent(figures.own_lobes)}`, '',
      'given table', `mean |error| ${percent(figures.given)}`, `lobes alone ${percent(figures.given_lobes)}`
    ]
  };
}

const result = { errors };
try {
  const { Sphere, REVISION, sphereShare } = await import('/own/scene.js');
  const other = await import('/given/scene.js').catch((error) => {
    throw new Error(`${asked.get('table')}: ${error.message}`);
  });
  const own = new Sphere(size, f0, lightSize), given = new other.Sphere(size, f0, lightSize);
  const rows = asked.get('roughness').split(',').map(Number)
    .map((roughness) => compare(own, given, roughness));
  Object.assign(result, {
    three: REVISION, f0, size, light_size: lightSize, spheres: rows.map((row) => row.figures)
  });
  result.picture = draw(rows.map(shown), {
    size, sphereShare, title: `Spheres under a RectAreaLight, three.js r${REVISION}`,
    heads: ['GGX, integrated', 'its own table', 'difference', 'given table', 'difference'], below: [
      `Metal, F0 = ${f0}; light ${sides(lightSize)}, sphere of radius 1. Errors over the mean of GGX; lobes ` +
        "alone: integrated, without three.js' formula for polygons.",
      `Differences from GGX are in units of the light's radiance. Given: ${asked.get('table')}`
    ]
  });
} catch (error) {
  note(error.message);
}
await fetch('/result', { method: 'POST', body: JSON.stringify(result) });
