// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a shader of three.js needs to look a lobe up: its code and, of a table, the texture.
import { ClampToEdgeWrapping, Data3DTexture, FloatType, LinearFilter, NearestFilter, RGBAFormat } from 'three';

async function fetched(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response;
}

// A DDS of `ltcfit convert TABLE -o NAME.dds --as stacked`: 148 bytes of header, then RGBA32F.
async function loadTexture(url, filter) {
  const bytes = await (await fetched(url)).arrayBuffer();
  const header = new DataView(bytes, 0, Math.min(bytes.byteLength, 148));
  if (bytes.byteLength < 148 || header.getUint32(0) !== 0x44445320) throw new Error(`${url} is no DDS`);
  const [height, width, depth] = [12, 16, 24].map((at) => header.getUint32(at, true));
  if (bytes.byteLength !== 148 + 16 * width * height * depth)
    throw new Error(`${url} is no 3-D texture of 32-bit floats: convert --as stacked`);
  const texture = new Data3DTexture(new Float32Array(bytes, 148), width, height, depth);
  texture.format = RGBAFormat;
  texture.type = FloatType;
  texture.minFilter = texture.magFilter = filter ? LinearFilter : NearestFilter;
  texture.wrapS = texture.wrapT = texture.wrapR = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

let loaded = 0;

// shaders: where shaders/glsl (for anisotropic.js) or shaders/wgsl (for anisotropic-webgpu.js) is
// served. Either table: a path without its ending, .dds and .glsl or .wgsl; or field: a path to what
// `ltcfit generate` or `convert` writes of a field, folded or not, without its ending. filter:
// interpolate by the texture unit, six fetches instead of 48, by weights of 8 bits on most GPUs.
export async function loadLobes(shaders, { table, field, filter = false }) {
  const language = /wgsl\/?$/.test(shaders) ? 'wgsl' : 'glsl';
  const text = async (path) => (await fetched(`${path}.${language}`)).text();
  const own = await text(table ?? field), folded = own.includes('ltcLookUpFolded');
  const library = async (...names) =>
    (await Promise.all(names.map((name) => text(`${shaders}/ltc_${name}`)))).join('\n');
  const lookUp = folded ? ['folded', 'folded_field'] : table ? [] : ['field'];
  const before = await library('lobe', 'polygon', ...(table ? ['table'] : []));
  return {
    id: ++loaded,
    code: [before, own, await library(...lookUp)].join('\n'),
    values: table ? await loadTexture(`${table}.dds`, filter) : null,
    folded,
    filter
  };
}
