// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The tables that the page holds.

// FNV-1a of 32 bits, as src/report/viewer_page.cpp has it.
function checksumOf(text) {
  let hash = 2166136261;
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 16777619);
  return hash >>> 0;
}

function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// The values of a table of nodes, 16 bits or 32; throws a sentence where they are damaged.
function valuesOf(table, number) {
  const text = document.getElementById(`values-${number}`)?.textContent ?? '';
  if (text.length !== table.length || checksumOf(text) !== table.checksum)
    throw new Error(`The values of ${table.name} are damaged: ${text.length} characters of ` +
      `${table.length}, checksum ${checksumOf(text)} where ${table.checksum} was written. ` +
      'Make the page anew with ltcfit view.');
  const { buffer } = bytesOf(text);
  return table.half ? new Uint16Array(buffer) : new Float32Array(buffer);
}

function readData() {
  let data;
  try {
    data = JSON.parse(document.getElementById('data').textContent);
  } catch (error) {
    throw new Error(`The page is damaged (${error.message}). Make it anew with ltcfit view.`);
  }
  data.tables.forEach((table, i) => { if (!table.field) table.values = valuesOf(table, i); });
  return data;
}

// Where a value stands on an axis, in nodes: ltc_position of the shaders.
function positionOn(table, axis, value) {
  const first = table.first[axis], last = table.last[axis], warp = table.warp[axis];
  if (table.size[axis] < 2) return 0;
  const of = warp === 3 ? (x) => Math.sin(x / 2) : (x) => x;
  let x = clamp((of(value) - of(first)) / (of(last) - of(first)), 0, 1);
  if (warp === 1) x = Math.sqrt(x);
  if (warp === 2) x = 1 - Math.sqrt(1 - x);
  return x * (table.size[axis] - 1);
}

// A lobe as tables hold it: the first quadrant, the larger roughness along x.
function foldedLobe(view, alphas, table) {
  const swapped = !table.both_alphas && alphas[1] > alphas[0];
  const [x, y] = swapped ? [Math.abs(view[1]), Math.abs(view[0])] : [Math.abs(view[0]), Math.abs(view[1])];
  const alpha = swapped ? alphas[1] : alphas[0], other = swapped ? alphas[0] : alphas[1];
  return { alpha, lambda: other / alpha, second: table.both_alphas ? other : other / alpha,
           theta: Math.atan2(Math.hypot(x, y), view[2]), phi: Math.atan2(y, x) };
}

// What of a material lies beyond a table's axes, as `ltcfit render` says it: look-ups clamp it, and
// so show another material.
function clampingOf(table, alphas) {
  if (table.field) return '';
  const lobe = foldedLobe([0, 0, 1], alphas, table);
  const names = table.both_alphas ? ['alpha_x', 'alpha_y'] : ['alpha', 'lambda'];
  const clamped = [lobe.alpha, lobe.second].flatMap((value, axis) => {
    const taken = clamp(value, table.first[axis], table.last[axis]);
    return Math.abs(taken - value) > 1e-9
      ? [`${names[axis]} ${Number(value.toPrecision(3))} to ${Number(taken.toPrecision(3))}`] : [];
  });
  return clamped.length
    ? `Beyond the axes of ${table.name}, clamped: ${clamped.join(', ')}.` : '';
}

// The nearest node, as `ltcfit fit --entry` takes it.
function nearestEntry(table, lobe) {
  return [lobe.alpha, lobe.second, lobe.theta, lobe.phi]
    .map((value, axis) => Math.round(positionOn(table, axis, value)));
}
