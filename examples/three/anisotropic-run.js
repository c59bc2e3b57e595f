// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Renders anisotropic spheres with three.js in Chromium (or $CHROMIUM) by a table and by a field of
// ltcfit, in WebGL and in WebGPU; prints how far they are from GGX, and from `ltcfit render`. Exit
// codes: 1 the page, the browser or ltcfit failed, 2 bad arguments, 3 a file.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { attempt, fail, showPage, temporaryFolder } from './chromium.js';

const usage = `usage: node anisotropic-run.js TABLE.h5 FIELD.json [-o PICTURE.png] [--json FILE]
           [--material ROUGHNESS,ANISOTROPY[,DEGREES]]... [--f0 X] [--light-size S]
           [--size PIXELS] [--samples N] [--ltcfit PROGRAM] [--variants]`;
const folder = fileURLToPath(new URL('.', import.meta.url));

// As glTF and three.js have it. ltcfit's sphere has x along the parallels, so that a quarter of a
// turn exchanges the two roughnesses.
function readMaterial(text) {
  const numbers = text.split(',').map((part) => part ? Number(part) : NaN);
  const [roughness, anisotropy, rotation = 0, ...more] = numbers;
  if (!(roughness >= 0.045 && roughness <= 1 && anisotropy >= 0 && anisotropy <= 1) ||
      ![0, 90].includes(rotation) || more.length)
    throw new Error(`--material is ${text}; allowed: a roughness from 0.045 to 1, an anisotropy from 0 ` +
                    'to 1, and a rotation of 0 or 90');
  const across = Number((roughness ** 2).toPrecision(7));
  const along = Number((across + (1 - across) * anisotropy ** 2).toPrecision(7));
  const [alpha_x, alpha_y] = rotation ? [across, along] : [along, across];
  return { roughness, anisotropy, rotation, alpha_x, alpha_y };
}

function readArguments() {
  const { values, positionals } = parseArgs({ allowPositionals: true, options: {
    output: { type: 'string', short: 'o' }, json: { type: 'string' },
    material: { type: 'string', multiple: true, default: ['0.3,0.7', '0.3,0.7,90', '0.5,0.5', '0.2,0.4'] },
    f0: { type: 'string', default: '1' }, 'light-size': { type: 'string', default: '1' },
    size: { type: 'string', default: '200' }, samples: { type: 'string', default: '2048' },
    ltcfit: { type: 'string', default: 'ltcfit' }, variants: { type: 'boolean', default: false }
  } });
  const number = (name, least, most, step) => {
    const text = values[name];
    if (!text || !(text >= least && text <= most) || (step && text % step))
      throw new Error(`--${name} is ${text}; allowed: ${least} to ${most}` +
                      (step > 1 ? `, multiples of ${step}` : ''));
    return Number(text);
  };
  if (positionals.length !== 2) throw new Error(usage);
  return {
    table: positionals[0], field: positionals[1], output: values.output, json: values.json,
    materials: values.material.map(readMaterial), f0: number('f0', 0, 1),
    light_size: number('light-size', 0.01, 2), size: number('size', 16, 1000, 8),
    samples: number('samples', 16, 1e6, 1), ltcfit: values.ltcfit, variants: values.variants
  };
}

function ltcfit(...words) {
  const { error, status, stderr } = spawnSync(asked.ltcfit, words, { encoding: 'utf8' });
  if (error) fail(1, `cannot run ${asked.ltcfit}: ${error.message}`);
  if (status) fail(status, stderr.trim().split('\n').at(-1));
}

// What three.js is given, and what it is compared with.
function make() {
  ltcfit('convert', asked.table, '--as', 'stacked', '-o', join(made, 'table.dds'));
  for (const language of ['glsl', 'wgsl']) {
    ltcfit('convert', asked.table, '-o', join(made, `table.${language}`));
    ltcfit('convert', asked.field, '-o', join(made, `field.${language}`));
  }
  const materials = asked.materials
    .flatMap(({ alpha_x, alpha_y }) => ['--material', `${alpha_x},${alpha_y}`]);
  ltcfit('render', asked.table, '--table-b', asked.field, ...materials, '--f0', `${asked.f0}`,
         '--light-size', `${asked.light_size}`, '--size', `${asked.size}`, '--samples', `${asked.samples}`,
         '-o', join(made, 's.png'), '--json', join(made, 'render.json'));
  JSON.parse(readFileSync(join(made, 'render.json'))).materials.forEach(({ image }, i) => {
    asked.materials[i].image = basename(image);
  });
}

// The files of this folder, shaders/, and what was made.
function answer(path) {
  if (path === '/asked.json') return JSON.stringify(asked);
  if (path.startsWith('/made/')) return readFileSync(join(made, path.slice(6)));
  return readFileSync(join(folder, path.startsWith('/shaders/') ? '../..' : '.', path));
}

function report({ spheres, three, variants = {}, without_webgpu }) {
  const line = (cells) => console.log(cells.map((cell) => String(cell).padStart(13)).join(''));
  const percent = (x) => `${(100 * x).toFixed(2)} %`, apart = (x) => x === undefined ? '-' : x.toExponential(1);
  console.log(`three.js r${three}; mean |error| over the mean of GGX, whose own noise is the last`);
  line(['roughness', 'anisotropy', 'rotation', 'as it comes', 'table', 'field', 'noise']);
  for (const { roughness, anisotropy, rotation, error, noise } of spheres)
    line([roughness, anisotropy, rotation, ...[error.three, error.table, error.field, noise].map(percent)]);
  console.log("\nlargest difference from ltcfit render, of the light's radiance");
  line(['alpha_x', 'alpha_y', 'rays, table', 'field', 'WebGL table', 'field', 'WebGPU table', 'field']);
  for (const s of spheres)
    line([...[s.alpha_x, s.alpha_y].map((x) => Number(x.toPrecision(3))),
          ...[s.rays_from_ltcfit, s.webgl_from_ltcfit, s.webgpu_from_ltcfit]
            .flatMap(({ table, field }) => [table, field].map(apart))]);
  for (const [name, { from_ltcfit, webgpu_from_webgl }] of Object.entries(variants))
    console.log(`${name}: ${apart(from_ltcfit)} from the first by ltcfit render, ` +
                `WebGPU from WebGL ${apart(webgpu_from_webgl)}`);
  if (without_webgpu) console.log(`no WebGPU: ${without_webgpu}`);
}

function finish({ errors, picture, ...figures }) {
  report(figures);
  attempt(3, () => {
    if (asked.output) writeFileSync(asked.output, Buffer.from(picture.split(',')[1], 'base64'));
    if (asked.json) writeFileSync(asked.json, JSON.stringify(figures, null, 2) + '\n');
  });
}

const asked = attempt(2, readArguments);
if (!existsSync(join(folder, 'node_modules/three'))) fail(1, 'no three.js: npm ci --prefix examples/three');
const made = temporaryFolder();
attempt(3, make);
showPage('anisotropic.html', answer, finish, ['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader']);
