// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The panel: sliders with numbers beside them, choices, and what follows the state.

// How sliders are spaced, and by what one step of an arrow key changes them.
const linear = { to: (x) => x, from: (x) => x };
const root = { to: Math.sqrt, from: (x) => x * x };
const octaves = { to: Math.log2, from: (x) => 2 ** x };
const SLIDERS = {
  alpha_x: { label: 'α<sub>x</sub>', say: 'alpha x', scale: root, step: 0.005 },
  alpha_y: { label: 'α<sub>y</sub>', say: 'alpha y', scale: root, step: 0.005 },
  roughness: { label: 'roughness', scale: linear, step: 0.005 },
  anisotropy: { label: 'anisotropy', scale: linear, step: 0.005 },
  rotation: { label: 'rotation', say: 'rotation of the tangent frame, degrees', scale: linear,
              step: 1, unit: '°' },
  f0: { label: 'F<sub>0</sub>', say: 'F 0', scale: linear, step: 0.01 },
  light_size: { label: 'size', say: 'light size', scale: root, step: 0.01 },
  light_x: { label: 'x', say: 'light x', scale: linear, step: 0.05, span: [-4, 4] },
  light_y: { label: 'y', say: 'light y', scale: linear, step: 0.05, span: [-4, 4] },
  light_z: { label: 'z', say: 'light z', scale: linear, step: 0.05, span: [-4, 4] },
  exposure: { label: 'exposure', scale: octaves, step: 0.05, span: [-6, 6] },
};
const CHOICES = {
  view: { table: 'Table', table_b: 'Table B', ggx: '@BRDF@', difference: 'Difference',
          difference_b: 'Difference B', split: 'Split' },
  shape: { sphere: 'Sphere', plane: 'Plane', sheet: 'Sheet' },
  light: { rectangle: 'Rectangle', star: 'Star', disk: 'Disk', sphere: 'Sphere', line: 'Line',
           picture: 'Picture' },
  lookup: { exact: 'by texels, exact', filter: 'by the texture unit' },
  metal: Object.fromEntries(Object.keys(METALS).map((name) => [name, name])),
};

const element = (id) => document.getElementById(id);

class Controls {
  // `change(key, value, moving)` is told of what the reader does.
  constructor(data, change) {
    Object.assign(this, { data, change, sliders: {} });
    for (const holder of document.querySelectorAll('[data-slider]')) this.addSlider(holder);
    for (const holder of document.querySelectorAll('[data-choice]')) this.addChoice(holder);
    for (const select of document.querySelectorAll('select[data-key]')) this.addSelect(select);
    element('gltf').addEventListener('change', (event) => change('gltf', event.target.checked, false));
    element('auto').addEventListener('change', (event) => change('auto', event.target.checked, false));
  }

  addSlider(holder) {
    const key = holder.dataset.slider, { label, say, scale, step, span, unit = '' } = SLIDERS[key];
    const { least, most } = PARAMETERS[key], [low, high] = span ?? [scale.to(least), scale.to(most)];
    holder.className = 'slider';
    holder.innerHTML = `<label for="${key}">${label}</label>` +
      `<input type="range" id="${key}" min="${low}" max="${high}" step="${step}">` +
      `<input type="text" inputmode="decimal" id="${key}-number" autocomplete="off" ` +
      `aria-label="${say ?? key}, as a number">`;
    const [, range, text] = holder.children;
    if (say) range.setAttribute('aria-label', say);
    const value = () => clamp(Number(short(scale.from(Number(range.value)))), least, most);
    const slide = (moving) => this.change(key, value(), moving);
    range.addEventListener('input', () => slide(true));
    range.addEventListener('change', () => slide(false));
    text.addEventListener('change', () => this.change(key, text.value.trim().replace(unit, ''), false));
    this.sliders[key] = { range, text, scale, unit };
  }

  addChoice(holder) {
    const key = holder.dataset.choice;
    for (const [name, words] of Object.entries(CHOICES[key])) {
      if (name.endsWith('_b') && this.data.tables.length < 2) continue;
      const label = document.createElement('label'), input = document.createElement('input');
      Object.assign(input, { type: 'radio', name: key, value: name, id: `${key}-${name}` });
      input.addEventListener('change', () => this.change(key, name, false));
      const icon = document.createElement('i');
      icon.className = `icon ${key}-${name}`;
      label.append(input, icon, document.createTextNode(words));
      holder.append(label);
    }
  }

  addSelect(select) {
    const key = select.dataset.key;
    for (const [name, words] of Object.entries(CHOICES[key])) select.add(new Option(words, name));
    select.addEventListener('change', () => this.change(key, select.value, false));
  }

  // ---- After the state ----

  follow(state, exposure) {
    for (const [key, { range, text, scale, unit }] of Object.entries(this.sliders)) {
      const value = key === 'exposure' && state.exposure === 'auto' ? exposure : state[key];
      range.value = scale.to(value);
      range.setAttribute('aria-valuetext', short(value) + unit);
      text.value = Number(value.toPrecision(4)) + unit;
    }
    for (const key of Object.keys(CHOICES)) {
      const radio = element(`${key}-${state[key]}`);
      if (radio) radio.checked = true;
    }
    for (const select of document.querySelectorAll('select[data-key]'))
      select.value = state[select.dataset.key];
    element('gltf').checked = state.gltf;
    element('auto').checked = state.exposure === 'auto';
    for (const part of document.querySelectorAll('[data-gltf]'))
      part.hidden = (part.dataset.gltf === 'true') !== state.gltf;
    this.lockMaterial();
  }

  // A field of one material shows no other.
  lockMaterial() {
    if (!this.data.tables.some((table) => table.material)) return;
    for (const key of ['alpha_x', 'alpha_y', 'roughness', 'anisotropy'])
      for (const input of [this.sliders[key].range, this.sliders[key].text]) input.disabled = true;
    element('gltf').disabled = true;
  }

  exposureIs(value) {
    const { range, text, scale } = this.sliders.exposure;
    range.value = scale.to(value);
    range.setAttribute('aria-valuetext', short(value));
    if (document.activeElement !== text) text.value = Number(value.toPrecision(3));
  }
}
