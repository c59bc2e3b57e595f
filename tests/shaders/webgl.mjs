// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Runs a job's GLSL ES on WebGL 2 in headless Chromium (or $CHROMIUM). Exit code 77 names what is
// missing.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const folder = process.argv[2];
const page = `<!doctype html><meta charset="utf-8"><title>shaders</title><script type="module">
const values = async (name) => new Float32Array(await (await fetch(name)).arrayBuffer());
const version = '#version 300 es\\nprecision highp float;\\nprecision highp int;\\n' +
  'precision highp sampler2D;\\nprecision highp sampler3D;\\n';
async function run() {
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  if (!gl) return { missing: 'no WebGL 2' };
  for (const name of ['EXT_color_buffer_float', 'OES_texture_float_linear'])
    if (!gl.getExtension(name)) return { missing: 'no ' + name };
  const job = await (await fetch('job.json')).json();
  const program = gl.createProgram();
  const add = (kind, text) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, version + text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  };
  add(gl.VERTEX_SHADER, 'void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, ' +
    'gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }');
  add(gl.FRAGMENT_SHADER, await (await fetch('cases.frag')).text());
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const input = await values('input.bin');
  const rows = Math.ceil(input.length / 4 / 4096), padded = new Float32Array(4 * 4096 * rows);
  padded.set(input);
  const textures = [...job.textures, { name: 'asked', width: 4096, height: rows, depth: 0, levels: 1,
    data: padded }];
  for (const [unit, { name, width, height, depth, levels, data }] of textures.entries()) {
    const target = depth ? gl.TEXTURE_3D : gl.TEXTURE_2D, all = data ?? await values(name + '.bin');
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, gl.createTexture());
    if (depth) gl.texStorage3D(target, levels, gl.RGBA32F, width, height, depth);
    else gl.texStorage2D(target, levels, gl.RGBA32F, width, height);
    let from = 0;
    for (let level = 0; level < levels; ++level) {
      const w = width >> level, h = height >> level, count = 4 * w * h * Math.max(depth, 1);
      const part = all.subarray(from, from + count);
      if (depth) gl.texSubImage3D(target, level, 0, 0, 0, w, h, depth, gl.RGBA, gl.FLOAT, part);
      else gl.texSubImage2D(target, level, 0, 0, w, h, gl.RGBA, gl.FLOAT, part);
      from += count;
    }
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, levels > 1 ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
    gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
      gl.texParameteri(target, side, gl.CLAMP_TO_EDGE);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  }
  const height = Math.ceil(job.count / 1024);
  gl.activeTexture(gl.TEXTURE15);
  const image = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, image);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, 1024, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, image, 0);
  gl.viewport(0, 0, 1024, height);
  const output = new Float32Array(24 * job.count), pixels = new Float32Array(4 * 1024 * height);
  for (let which = 0; which < 6; ++which) {
    gl.uniform1i(gl.getUniformLocation(program, 'which'), which);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.readPixels(0, 0, 1024, height, gl.RGBA, gl.FLOAT, pixels);
    for (let i = 0; i < job.count; ++i)
      output.set(pixels.subarray(4 * i, 4 * i + 4), 24 * i + 4 * which);
  }
  const error = gl.getError();
  if (error) throw new Error('WebGL error ' + error);
  await fetch('output.bin', { method: 'POST', body: output });
  return {};
}
const result = await run().catch((error) => ({ error: String(error.message ?? error) }));
await fetch('result', { method: 'POST', body: JSON.stringify(result) });
</script>`;

function end(code, message) {
  if (message) console.error(message);
  browser?.removeAllListeners('exit').on('exit', () => process.exit(code)).kill();
  if (!browser?.pid) process.exit(code);
}

function serve(request, response) {
  const name = request.url.slice(1);
  if (request.method === 'POST') {
    const parts = [];
    request.on('data', (part) => parts.push(part)).on('end', () => {
      const body = Buffer.concat(parts);
      response.end();
      if (name === 'output.bin') return writeFileSync(join(folder, name), body);
      const { missing, error } = JSON.parse(body);
      return end(missing ? 77 : error ? 1 : 0, missing ?? error);
    });
    return;
  }
  try {
    response.setHeader('Content-Type', name ? 'application/octet-stream' : 'text/html');
    response.end(name ? readFileSync(join(folder, name)) : page);
  } catch {
    response.writeHead(404).end();
  }
}

let browser;
const profile = mkdtempSync(join(tmpdir(), 'ltcfit-webgl-'));
process.on('exit', () => rmSync(profile, { recursive: true, force: true, maxRetries: 9 }));
const server = createServer(serve).listen(0, '127.0.0.1', () => {
  browser = spawn(process.env.CHROMIUM ?? 'chromium', ['--headless', '--no-sandbox',
    '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-gpu-watchdog', `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/`], { stdio: 'ignore' });
  browser.on('error', () => end(77, 'no Chromium'));
  browser.on('exit', (code) => end(1, `Chromium ended with ${code}`));
  setTimeout(() => end(1, 'the page did not end within 20 minutes'), 1_200_000);
});
