// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reads the images of `ltcfit render`: OpenEXR of lines, 32-bit channels, ZIP.

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Each byte is stored as the difference from the one before, first the even ones and then the odd.
function unfiltered(bytes) {
  for (let i = 1; i < bytes.length; ++i) bytes[i] += bytes[i - 1] - 128;
  const half = Math.ceil(bytes.length / 2);
  return Uint8Array.from(bytes, (_, i) => bytes[i % 2 ? half + (i >> 1) : i >> 1]);
}

// { width, height, channels: { name: Float32Array, from the topmost line on } }
export async function readExr(buffer) {
  const view = new DataView(buffer), bytes = new Uint8Array(buffer);
  let at = 8;
  const int = () => view.getInt32((at += 4) - 4, true);
  const text = () => {
    const end = bytes.indexOf(0, at), found = new TextDecoder().decode(bytes.subarray(at, end));
    at = end + 1;
    return found;
  };
  const header = {};
  for (let name = text(); name; name = text()) {
    text();  // its type
    const size = int();
    header[name] = at;
    at += size;
  }
  const lines = at;
  const names = [];
  for (at = header.channels; bytes[at];) {
    names.push(text());
    if (int() !== 2) throw new Error(`channel ${names.at(-1)} is not of 32-bit floats`);
    at += 12;
  }
  at = header.dataWindow;
  const [left, top, right, bottom] = [int(), int(), int(), int()];
  const width = right - left + 1, height = bottom - top + 1;
  if (view.getInt32(0, true) !== 20000630 || bytes[header.compression] !== 3)
    throw new Error('no OpenEXR with ZIP');
  const channels = Object.fromEntries(names.map((name) => [name, new Float32Array(width * height)]));
  for (let first = 0; first < height; first += 16) {
    at = Number(view.getBigUint64(lines + first / 2, true)) + 4;
    const size = int(), rows = Math.min(16, height - first), whole = 4 * width * names.length * rows;
    const part = bytes.slice(at, at + size);
    const values = new Float32Array((size < whole ? unfiltered(await inflated(part)) : part).buffer);
    for (let row = 0; row < rows; ++row)
      names.forEach((name, i) => channels[name].set(
        values.subarray((row * names.length + i) * width, (row * names.length + i + 1) * width),
        (first + row) * width));
  }
  return { width, height, channels };
}
