// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs a job's WGSL on WebGPU (the npm package webgpu). Exit code 77 names what is missing.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

function missing(what) {
  console.error(what);
  process.exit(77);
}

// Of Chromium, where the system's own driver is too old for WebGPU.
const swiftshader = '/usr/lib/chromium/vk_swiftshader_icd.json';

async function openDevice() {
  let webgpu;
  try {
    webgpu = await import('webgpu');
  } catch {
    missing('no npm package webgpu: npm ci --prefix tests');
  }
  Object.assign(globalThis, webgpu.globals);
  const request = () => {
    // Kept: what comes of it dies with it.
    globalThis.gpus = [...globalThis.gpus ?? [], webgpu.create([])];
    return globalThis.gpus.at(-1).requestAdapter();
  };
  let adapter = await request();
  if (!adapter && existsSync(swiftshader)) {
    process.env.VK_ICD_FILENAMES = swiftshader;
    adapter = await request();
  }
  if (!adapter) missing('no adapter of WebGPU');
  if (!adapter.features.has('float32-filterable')) missing('no float32-filterable in WebGPU');
  return adapter.requestDevice({ requiredFeatures: ['float32-filterable'] });
}

const folder = process.argv[2];
const values = (name) => {
  const bytes = readFileSync(join(folder, name));
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
};
const job = JSON.parse(readFileSync(join(folder, 'job.json'), 'utf8'));

function upload(device, { name, width, height, depth, levels }) {
  const texture = device.createTexture({
    size: [width, height, Math.max(depth, 1)], dimension: depth ? '3d' : '2d', mipLevelCount: levels,
    format: 'rgba32float', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST
  });
  const data = values(`${name}.bin`);
  let from = 0;
  for (let level = 0; level < levels; ++level) {
    const size = [width >> level, height >> level, Math.max(depth, 1)];
    const count = 4 * size[0] * size[1] * size[2];
    device.queue.writeTexture({ texture, mipLevel: level }, data.subarray(from, from + count),
      { bytesPerRow: 16 * size[0], rowsPerImage: size[1] }, size);
    from += count;
  }
  return texture;
}

const names = job.textures.map(({ name }) => name);
const kinds = Object.fromEntries(job.textures.map(({ name, depth }) =>
  [name, `texture_${depth ? 3 : 2}d<f32>`]));
const code = `${readFileSync(join(folder, 'cases.wgsl'), 'utf8')}
@group(0) @binding(0) var<storage, read> asked: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> answers: array<vec4<f32>>;
@group(0) @binding(2) var linear_clamp: sampler;
${names.map((name, i) => `@group(0) @binding(${i + 3}) var ${name}: ${kinds[name]};`).join('\n')}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
  let item = id.x;
  if (item >= ${job.count}u) { return; }
  let found = ltc_case(${names.map((name) => `${name}, linear_clamp`).join(', ')},
    asked[4 * item], asked[4 * item + 1], asked[4 * item + 2], asked[4 * item + 3]);
${[0, 1, 2, 3, 4, 5].map((i) => `  answers[6 * item + ${i}] = found.r${i};`).join('\n')}
}`;

const device = await openDevice();
let fault = null;
device.addEventListener('uncapturederror', ({ error }) => { fault ??= error.message; });
const module = device.createShaderModule({ code });
const complaints = (await module.getCompilationInfo()).messages.filter(({ type }) => type === 'error');
if (complaints.length) {
  console.error(complaints.map(({ lineNum, message }) => `${lineNum}: ${message}`).join('\n'));
  process.exit(1);
}
const pipeline = device.createComputePipeline({
  layout: 'auto', compute: { module, entryPoint: 'main' } });
const input = values('input.bin'), bytes = job.count * 6 * 16;
const asked = device.createBuffer({ size: input.byteLength,
  usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
device.queue.writeBuffer(asked, 0, input);
const answers = device.createBuffer({ size: bytes,
  usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
const read = device.createBuffer({ size: bytes,
  usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
const sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear',
  mipmapFilter: 'linear' });
const textures = job.textures.map((texture) => upload(device, texture));
const resources = [{ buffer: asked }, { buffer: answers }, sampler,
  ...textures.map((texture) => texture.createView())];
const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0),
  entries: resources.map((resource, binding) => ({ binding, resource })) });
const encoder = device.createCommandEncoder();
const pass = encoder.beginComputePass();
pass.setPipeline(pipeline);
pass.setBindGroup(0, group);
pass.dispatchWorkgroups(Math.ceil(job.count / 64));
pass.end();
encoder.copyBufferToBuffer(answers, 0, read, 0, bytes);
device.queue.submit([encoder.finish()]);
await read.mapAsync(GPUMapMode.READ);
writeFileSync(join(folder, 'output.bin'), Buffer.from(read.getMappedRange()));
if (fault) console.error(fault);
process.exit(fault ? 1 : 0);
