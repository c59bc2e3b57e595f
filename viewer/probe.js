// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What lies under the pointer: the lobe, the table's nearest entry, and both lobes drawn.

const LOBE_TEXELS = 120;

// The part of the hemisphere, seen from above, that is worth drawing: about the mirror direction.
function windowOf(view, alphas) {
  const half = clamp(3.2 * Math.max(...alphas) ** 0.8, 0.12, 1);
  const inside = (x) => clamp(x, half - 1, 1 - half);
  return { half, center: [inside(-view[0]), inside(-view[1])] };
}

// Rows from below, as the framebuffer has them; gamma, for densities span decades.
function paintDensities(canvas, densities, most, colors) {
  const context = canvas.getContext('2d'), image = context.createImageData(LOBE_TEXELS, LOBE_TEXELS);
  const steps = colors.length / 3 - 1;
  densities.forEach((density, i) => {
    const x = i % LOBE_TEXELS, y = LOBE_TEXELS - 1 - Math.floor(i / LOBE_TEXELS);
    const at = 4 * (y * LOBE_TEXELS + x), below = density < 0;
    const color = Math.round(steps * Math.sqrt(clamp(density / most, 0, 1)));
    for (let c = 0; c < 3; ++c) image.data[at + c] = colors[3 * color + c];
    image.data[at + 3] = below ? 0 : 255;
  });
  context.putImageData(image, 0, 0);
}

// The light's outline and the mirror direction in the window.
function paintMarks(canvas, window, mirror, outline) {
  const context = canvas.getContext('2d');
  const place = ([x, y]) => [0.5 * LOBE_TEXELS * (1 + (x - window.center[0]) / window.half),
                             0.5 * LOBE_TEXELS * (1 - (y - window.center[1]) / window.half)];
  context.lineWidth = 1;
  context.strokeStyle = 'rgba(255,255,255,0.85)';
  context.setLineDash([2, 2]);
  context.beginPath();
  let before = false;
  for (const d of [...outline, outline[0]]) {
    const above = d[2] > 0;
    if (above) context[before ? 'lineTo' : 'moveTo'](...place(d));
    before = above;
  }
  context.stroke();
  context.setLineDash([]);
  const [x, y] = place(mirror);
  context.strokeStyle = '#ff6b5a';
  context.beginPath();
  context.moveTo(x - 4, y); context.lineTo(x + 4, y);
  context.moveTo(x, y - 4); context.lineTo(x, y + 4);
  context.stroke();
}

class Probe {
  constructor(data) {
    this.data = data;
    this.canvases = ['lobe-ggx', 'lobe-table'].map((id) => document.getElementById(id));
    for (const canvas of this.canvases) canvas.width = canvas.height = LOBE_TEXELS;
    this.empty();
  }

  empty() {
    document.getElementById('entry').textContent =
      'Point at the object, or move the cross with Shift and the arrow keys.';
    document.getElementById('lobes').hidden = true;
  }

  // `place` on [0, 1]^2 of the canvas, from its lower left.
  show(stage, place) {
    const found = place && stage.probe(...place);
    if (!found) return this.empty();
    const number = stage.state.view.endsWith('_b') ? 1 : 0, table = this.data.tables[number];
    this.write(found, foldedLobe(found.view, alphasOf(stage.state), table), table, number);
    this.draw(stage, found, number);
  }

  write({ view, values }, lobe, table, number) {
    const degrees = (x) => `${(x * 180 / Math.PI).toFixed(1)}°`;
    const theta = Math.atan2(Math.hypot(view[0], view[1]), view[2]);
    const rows = [['θ, φ', `${degrees(theta)}, ${degrees(Math.atan2(view[1], view[0]))}`],
                  [table.both_alphas ? 'αx, αy' : 'α, λ', `${short(lobe.alpha)}, ${lobe.second.toFixed(3)}`],
                  ['entry', table.field ? `a field: ${table.numbers} numbers, no nodes`
                                        : `--entry ${nearestEntry(table, lobe).join(',')}`]];
    if (values) {
      const [t, g] = [values.tables[number], values.ggx];
      rows.push(['table, @BRDF@', `${t.toPrecision(3)}, ${g.toPrecision(3)}`]);
    }
    document.getElementById('entry').replaceChildren(...rows.map(([name, value]) => {
      const row = document.createElement('span'), label = document.createElement('i');
      row.className = 'row';
      label.textContent = name;
      row.append(label, document.createTextNode(value));
      return row;
    }));
  }

  draw(stage, { position, frame, view }, number) {
    const window = windowOf(view, alphasOf(stage.state));
    const densities = stage.lobeDensities(view, number, window);
    const most = Math.max(quantile(densities[0], 0.998), quantile(densities[1], 0.998), 1e-9);
    const outline = outlineOf(stage.state).map((point) => {
      const d = sum(point, scaled(-1, position));
      return unit(frame.map((axis) => dot(axis, d)));
    });
    this.canvases.forEach((canvas, i) => {
      paintDensities(canvas, densities[i], most, this.data.viridis);
      paintMarks(canvas, window, [-view[0], -view[1]], outline);
    });
    document.getElementById('lobes').hidden = false;
  }
}
