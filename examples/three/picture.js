// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Draws spheres and their differences from GGX, as `ltcfit render` does.
const diverging = [
  0x062b5f, 0x054a9a, 0x3072c1, 0x649dd7, 0xa1c6e6, 0xcde1f0, 0xf3f3f3, 0xf2d8cc, 0xe9b39e, 0xdb795b,
  0xc23d1f, 0x8d1b14, 0x570e10
].map((color) => [color >> 16, color >> 8 & 255, color & 255]);
const ink = '#222222', faint = '#6b6b70', font = 'DejaVu Sans, sans-serif', em = 12;

function differenceColor(position) {
  const along = Math.min(Math.max(position, 0), 1) * 12, i = Math.min(Math.floor(along), 11);
  return diverging[i].map((c, k) => c + (along - i) * (diverging[i + 1][k] - c));
}

function grey(linear) {
  const x = Math.min(linear, 1);
  return Array(3).fill(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

// All but the largest 0.2 % keep below: a few pixels at an edge shall not pale the others.
const nearlyLargest = (values) => values.sort((a, b) => a - b)[Math.floor(0.998 * values.length)];

function roundedUp(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  return decade * [1, 2, 5, 10].find((step) => value <= step * decade);
}

export const percent = (x) => `${(100 * x).toFixed(1)} %`;

// rows: images of radiances from the topmost line on, `ggx` and two to judge, whether a pixel is
// `covered` by the sphere, and what stands at the left. Of the whole: size in pixels, sphereShare,
// title, the columns' heads, and the lines below.
export function draw(rows, { size, sphereShare, title, heads, below }) {
  const canvas = document.createElement('canvas'), context = canvas.getContext('2d');
  const columns = [0, 1.4, 0.7, 1.4, 0.7];  // gaps before them, in em
  const lefts = [];
  columns.reduce((x, gap) => { lefts.push(Math.round(x + gap * em)); return lefts.at(-1) + size; }, 11 * em);
  const barLeft = lefts[4] + size + em, top = 65, step = Math.max(size, 160) + 8;
  canvas.width = barLeft + 7 * em;
  canvas.height = top + rows.length * step + 3.8 * em;
  context.fillStyle = 'white';
  context.fillRect(0, 0, canvas.width, canvas.height);

  const write = (text, x, y, { bold, scale = 1, color = ink, align = 'left' } = {}) => {
    context.font = `${bold ? 'bold ' : ''}${scale * em}px ${font}`;
    [context.fillStyle, context.textAlign] = [color, align];
    context.fillText(text, x, y);
  };
  const image = (x, y, color) => {
    const data = context.createImageData(size, size);
    for (let i = 0; i < size * size; ++i) data.data.set([...color(i), 255], 4 * i);
    context.putImageData(data, x, y);
  };

  write(title, 14, 31, { bold: true, scale: 1.3 });
  heads.forEach((head, i) => write(head, lefts[i] + size / 2, 59, { bold: true, align: 'center' }));
  rows.forEach(({ ggx, images, covered, head, lines }, index) => {
    const y = top + index * step;
    const inside = [...ggx.keys()].filter((i) => covered[i]);
    const exposure = 0.9 / nearlyLargest(inside.map((i) => ggx[i]));
    const bound = roundedUp(nearlyLargest(
      images.flatMap((shown) => inside.map((i) => Math.abs(shown[i] - ggx[i])))));
    const sphere = (x, shown) => image(x, y, (i) => grey(covered[i] ? exposure * shown[i] : 0.02));
    const difference = (x, shown) => {
      image(x, y, (i) => differenceColor(0.5 + (shown[i] - ggx[i]) / (2 * bound)));
      context.strokeStyle = faint;
      context.beginPath();
      context.arc(x + size / 2, y + size / 2, sphereShare * size / 2, 0, 2 * Math.PI);
      context.stroke();
    };
    sphere(lefts[0], ggx);
    images.forEach((shown, i) => {
      sphere(lefts[1 + 2 * i], shown);
      difference(lefts[2 + 2 * i], shown);
    });

    write(head, 14, y + 14, { bold: true });
    [`shown ${exposure.toPrecision(2)} × as bright`, '', ...lines].forEach(
      (line, i) => write(line, 14, y + 30 + 13 * i, { scale: 0.8, color: faint }));

    for (let row = 0; row < size; ++row) {
      context.fillStyle = `rgb(${differenceColor(1 - row / (size - 1)).map(Math.round)})`;
      context.fillRect(barLeft, y + row, em, 1);
    }
    for (const part of [-1, -0.5, 0, 0.5, 1])
      write(String(Number((part * bound).toPrecision(2))).replace('-', '−'), barLeft + 1.4 * em,
            y + (1 - part) / 2 * (size - 9) + 8, { scale: 0.8 });
  });
  below.forEach((line, i) => write(line, 14, top + rows.length * step + 14 + 17 * i));
  return canvas.toDataURL();
}

export const sides = (size) => [2.2, 1.4].map((side) => Number((side * size).toPrecision(3))).join(' × ');
