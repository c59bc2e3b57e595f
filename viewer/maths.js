// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Vectors of three, and numbers as they are written.

const radians = (degrees) => degrees * Math.PI / 180;
const clamp = (x, least, most) => Math.min(Math.max(x, least), most);
const scaled = (s, a) => a.map((x) => s * x);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]];
const sum = (a, b) => a.map((x, i) => x + b[i]);
const lengthOf = (a) => Math.hypot(...a);
const unit = (a) => scaled(1 / lengthOf(a), a);

// Six digits are more than a control has.
const short = (x) => String(Number(x.toPrecision(6)));

// The value that all but this share of the numbers keep below; 0 of none.
function quantile(numbers, share) {
  if (!numbers.length) return 0;
  const sorted = Float64Array.from(numbers).sort();
  const at = share * (sorted.length - 1);
  const low = Math.floor(at);
  return sorted[low] + (at - low) * (sorted[Math.min(low + 1, sorted.length - 1)] - sorted[low]);
}

// The next round number up: 1, 2 or 5 times a power of ten.
function roundedUp(value) {
  if (!(value > 1e-6)) return 1e-6;
  const decade = 10 ** Math.floor(Math.log10(value));
  return decade * [1, 2, 5, 10].find((step) => value <= step * decade * (1 + 1e-6));
}
