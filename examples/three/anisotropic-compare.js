// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page: renders each material by three.js as it comes, by the table and by the field, compares
// with the images of `ltcfit render`, and sends figures and a picture to anisotropic-run.js.
import { REVISION } from 'three';
import { WebGL, WebGPU } from './anisotropic-scene.js';
import { readExr } from './exr.js';
import { draw, percent, sides } from './picture.js';
import { sphereShare } from './scene.js';

const errors = [];
const note = (...parts) => errors.push(parts.join(' '));
console.error = note;  // where three.js tells of shaders that do not compile

const fetched = async (path) => (await fetch(path)).arrayBuffer();
const mean = (values) => values.reduce((sum, x) => sum + x, 0) / values.length;

// Not those next to the outline, where a mesh is not quite a sphere.
const pixelsInside = (coverage, size) => [...coverage.keys()].filter((i) =>
  [-1, 0, 1].every((x) => [-1, 0, 1].every((y) => coverage[i + x + size * y] === 1)));

const parametersOf = ({ roughness, anisotropy, rotation }, { f0 }) =>
  ({ color: [f0, f0, f0], metalness: 1, roughness, anisotropy, anisotropyRotation: rotation * Math.PI / 180 });

async function compare(material, asked, { webgl, webgpu }) {
  const { channels } = await readExr(await fetched(`/made/${material.image}`));
  const ggx = channels['ggx.Y'], covered = channels['coverage.Y'];
  const reference = { table: channels['ltc.Y'], field: channels['ltc_b.Y'] };
  const inside = pixelsInside(covered, asked.size), reference_mean = mean(inside.map((i) => ggx[i]));
  const apart = (a, b) => inside.map((i) => Math.abs(a[i] - b[i]));
  const largest = (a, b) => Math.max(...apart(a, b));
  const error = (image) => mean(apart(image, ggx)) / reference_mean;

  const parameters = parametersOf(material, asked);
  const images = { three: await webgl.draw(parameters, 'three') };
  const figures = {
    ...material, reference_mean,
    noise: mean(inside.map((i) => channels['standard_error.Y'][i])) / reference_mean,
    error: { three: error(images.three) }, error_of_ltcfit: {}, rays_from_ltcfit: {}, webgl_from_ltcfit: {},
    webgpu_from_ltcfit: {}, webgpu_from_webgl: {}
  };
  for (const by of ['table', 'field']) {
    images[by] = await webgl.draw(parameters, by);
    figures.error[by] = error(images[by]);
    figures.error_of_ltcfit[by] = error(reference[by]);
    figures.webgl_from_ltcfit[by] = largest(images[by], reference[by]);
    figures.rays_from_ltcfit[by] = largest(await webgl.draw(parameters, by, { rays: true }), reference[by]);
    if (!webgpu) continue;
    const image = await webgpu.draw(parameters, by);
    figures.webgpu_from_ltcfit[by] = largest(image, reference[by]);
    figures.webgpu_from_webgl[by] = largest(image, images[by]);
  }
  return { ggx, covered, inside, reference, images, figures };
}

// What else a material may have, and mistakes that must be seen: what they change, and how far WebGPU
// is from WebGL.
async function compareVariants(material, asked, { webgl, webgpu }, { inside, reference }) {
  const parameters = parametersOf(material, asked);
  const variants = {
    'roughness for alpha': [{ roughness: Math.sqrt(parameters.roughness) }],
    'axes exchanged': [{ anisotropyRotation: parameters.anisotropyRotation + Math.PI / 2 }],
    dielectric: [{ metalness: 0 }], 'half a metal': [{ metalness: 0.5 }], isotropic: [{ anisotropy: 0 }],
    'less specular': [{ metalness: 0, specularIntensity: 0.5 }],
    clearcoat: [{ clearcoat: 1, clearcoatRoughness: 0.4 }],
    'texture unit': [{}, 'filtered'], widened: [{}, 'table', { widen: true }]
  };
  const largest = (a, b) => Math.max(...inside.map((i) => Math.abs(a[i] - b[i])));
  const figures = {};
  for (const [name, [more, by = 'table', options]] of Object.entries(variants)) {
    const image = await webgl.draw({ ...parameters, ...more }, by, options);
    figures[name] = { from_ltcfit: largest(image, reference.table) };
    if (!webgpu) continue;
    const other = await webgpu.draw({ ...parameters, ...more }, by, options);
    figures[name].webgpu_from_webgl = largest(other, image);
  }
  return figures;
}

function shown({ ggx, covered, images, figures: { error, ...material } }) {
  const alphas = [material.alpha_x, material.alpha_y].map((x) => Number(x.toPrecision(2)));
  return {
    ggx, covered, images: [images.three, images.field], head: `roughness ${material.roughness}`, lines: [
      `anisotropy ${material.anisotropy}`, `rotation ${material.rotation}°`, `α ${alphas.join(', ')}`, '',
      'mean |error|', `as it comes ${percent(error.three)}`, `by the table ${percent(error.table)}`,
      `by the field ${percent(error.field)}`
    ]
  };
}

const result = { errors };
try {
  const asked = JSON.parse(new TextDecoder().decode(await fetched('/asked.json')));
  const { size, light_size, f0 } = asked, files = { table: '/made/table', field: '/made/field' };
  const by = { webgl: await new WebGL(size, light_size).start(files) };
  by.webgpu = await new WebGPU(size, light_size).start(files)
    .catch((error) => { result.without_webgpu = error.message; });
  const rows = [];
  for (const material of asked.materials) rows.push(await compare(material, asked, by));
  if (asked.variants) result.variants = await compareVariants(asked.materials[0], asked, by, rows[0]);
  Object.assign(result, { three: REVISION, f0, size, light_size, spheres: rows.map(({ figures }) => figures) });
  result.picture = draw(rows.map(shown), {
    size, sphereShare, title: `Anisotropic spheres under a RectAreaLight, three.js r${REVISION}`,
    heads: ['GGX, sampled', 'three.js as it comes', 'difference', 'by our field', 'difference'], below: [
      `Metal, F0 = ${f0}; light ${sides(light_size)}, sphere of radius 1; α along the parallels and along ` +
        'the meridians. Errors over the mean of GGX.',
      "Differences from GGX are in units of the light's radiance. As it comes, three.js has no anisotropy " +
        'under area lights, only the lesser roughness.'
    ]
  });
} catch (error) {
  note(error.message);
}
await fetch('/result', { method: 'POST', body: JSON.stringify(result) });
