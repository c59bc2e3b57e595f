// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page: renders each sphere by GGX, by three.js' own table and by the given one, and sends
// figures and a picture to run.js.
import { draw } from './picture.js';

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
  return { ggx, inside, images, figures: {
    roughness, reference_mean, own: error(images.own), given: error(images.given),
    own_lobes: error(own.draw('lobe', roughness)), given_lobes: error(given.draw('lobe', roughness)),
    reference_error: error(own.draw('ggx', roughness, 0.75))
  } };
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
  result.picture = draw(rows, result, sphereShare, asked.get('table'));
} catch (error) {
  note(error.message);
}
await fetch('/result', { method: 'POST', body: JSON.stringify(result) });
