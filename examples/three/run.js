// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Renders with three.js in Chromium (or $CHROMIUM), by its own table and by the given one; prints how
// far both are from GGX. Exit codes: 1 the page or the browser failed, 2 bad arguments, 3 a file.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { attempt, fail, showPage } from './chromium.js';

const usage = `usage: node run.js TABLE.js [-o PICTURE.png] [--json FILE] [--roughness R,R,...]
                   [--light-size S] [--size PIXELS]`;
const folder = fileURLToPath(new URL('.', import.meta.url));
const replaced = '/given/examples/jsm/lights/RectAreaLightTexturesLib.js';

function readArguments() {
  const { values, positionals } = parseArgs({ allowPositionals: true, options: {
    output: { type: 'string', short: 'o' }, json: { type: 'string' },
    roughness: { type: 'string', default: '0.15,0.3,0.5,0.8' },
    'light-size': { type: 'string', default: '1' }, size: { type: 'string', default: '200' }
  } });
  const check = (name, least, most, whole) => {
    for (const text of values[name].split(name === 'roughness' ? ',' : '\0'))
      if (!text || !(text >= least && text <= most) || (whole && text % 1))
        throw new Error(`--${name} is ${values[name]}; allowed: ${least} to ${most}`);
  };
  check('roughness', 0.1, 1);
  check('light-size', 0.01, 2);
  check('size', 16, 1000, true);
  if (positionals.length !== 1) throw new Error(usage);
  return { table: positionals[0], ...values };
}

// The files of this folder, and three.js twice: /own/ as it comes, in /given/ one file is replaced.
function answer(path) {
  if (path === replaced) return table;
  const inThree = path.endsWith('/scene.js') ? null : /^\/(?:own|given)(\/.*)$/.exec(path);
  return readFileSync(inThree ? join(folder, 'node_modules/three', inThree[1])
                              : join(folder, path.replace(/^\/(own|given)\//, '/')));
}

function report({ spheres, three }) {
  const line = (cells) => console.log(cells.map((cell) => cell.padStart(11)).join(''));
  console.log(`three.js r${three}; mean |error| over the mean of GGX, as rendered and of the lobes alone`);
  line(['roughness', 'own table', 'given', 'own lobes', 'given', 'in GGX']);
  for (const s of spheres)
    line([String(s.roughness), ...[s.own, s.given, s.own_lobes, s.given_lobes, s.reference_error]
      .map((x) => `${(100 * x).toFixed(2)} %`)]);
}

function finish({ errors, picture, ...figures }) {
  report(figures);
  attempt(3, () => {
    if (asked.output) writeFileSync(asked.output, Buffer.from(picture.split(',')[1], 'base64'));
    if (asked.json) writeFileSync(asked.json, JSON.stringify(figures, null, 2) + '\n');
  });
}

const asked = attempt(2, readArguments);
const table = attempt(3, () => readFileSync(asked.table));
if (!existsSync(join(folder, 'node_modules/three'))) fail(1, 'no three.js: npm ci --prefix examples/three');
const { roughness, size, 'light-size': lightSize } = asked;
const query = new URLSearchParams({ roughness, size, lightSize, table: asked.table });
showPage(`index.html?${query}`, answer, finish);
