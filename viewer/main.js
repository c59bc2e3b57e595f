// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The page put together: the state, its fragment, the pointer, and what is said.

const SETTLE_MS = 220;
const MOST_PIXELS = 1.4e6;

class Viewer {
  constructor(data) {
    this.data = data;
    this.canvas = element('picture');
    this.sentences = [];
    this.fingers = new Map();  // on the picture, and where
    this.state = standardState(data.tables);
    this.words();
    // Throws where nothing can be drawn: then nothing can be set either.
    this.begin();
    this.controls = new Controls(data, (key, value, moving) => this.set(key, value, moving));
    this.probe = new Probe(data);
    this.listen();
    this.readFragment();
  }

  // What depends on the context, anew when that was lost.
  begin() {
    this.stage = new Stage(this.canvas, this.data, {
      figures: () => this.tellFigures(),
      presented: ({ exposure, bound }) => this.presented(exposure, bound) });
    this.notes = this.stage.graphics.notes;
    this.fit();
  }

  words() {
    const text = (table) => table.field ? `${table.folded ? 'folded ' : ''}field of ${table.numbers} numbers`
      : `${table.size.join(' × ')} nodes, ${table.storage_name}, ${table.half ? 16 : 32} bits`;
    element('tables').replaceChildren(...this.data.tables.map((table, i) => {
      const line = document.createElement('p'), name = document.createElement('b');
      name.textContent = (this.data.tables.length > 1 ? `${'AB'[i]}: ` : '') + table.name;
      line.append(name, ` ${text(table)}`);
      if (table.missing)
        line.append(`; ${table.missing} entries are missing: the nearest stand for them`);
      return line;
    }));
    element('version').textContent = this.data.version;
    element('scale').style.background = `linear-gradient(90deg, ${this.scaleColors().join(', ')})`;
  }

  scaleColors() {
    const bytes = this.data.diverging, colors = [];
    for (let i = 0; i < bytes.length; i += 12) colors.push(`rgb(${bytes.slice(i, i + 3)})`);
    return colors;
  }

  // ---- State ----

  set(key, value, moving) {
    if (key === 'gltf')
      return value === this.state.gltf || this.change(withOtherRoughness(this.state), moving);
    if (key === 'auto') {
      const exposure = value ? 'auto' : Number(short(this.stage.exposure));
      return this.change({ ...this.state, exposure }, moving);
    }
    const taken = valueOf(key, String(value));
    if (taken === undefined) {
      this.sentences = [refusalOf(key, value, this.state)];
      this.controls.follow(this.state, this.stage.exposure);
      return this.tell();
    }
    const next = { ...this.state, [key]: taken };
    // A light that stands where it does by default goes where the shape has it.
    const isStandard = (place) => this.state[place] === standardOf(place, this.state.shape);
    if (key === 'shape' && PLACES.every(isStandard))
      PLACES.forEach((place) => { next[place] = standardOf(place, taken); });
    this.change(next, moving);
  }

  // The address follows when things stand still: browsers count how often it changes.
  change(next, moving) {
    this.state = next;
    this.sentences = [];
    this.show(moving);
    if (!moving) this.writeAddress();
  }

  writeAddress() {
    const fragment = fragmentOf(this.state, this.data.tables);
    if (fragment === location.hash.slice(1)) return;
    const address = `${location.href.replace(/#.*$/, '')}#${fragment}`;
    try { history.replaceState(null, '', address); } catch { location.replace(address); }
  }

  // Nothing has moved for a while.
  settle() {
    clearTimeout(this.settling);
    this.stage.settle();
    this.writeAddress();
    this.wake();
  }

  readFragment() {
    const { state, refused } = stateOfFragment(location.hash, this.data.tables);
    this.state = state;
    this.sentences = refused;
    this.show(false);
  }

  show(moving) {
    if (!this.stage) return;
    clearTimeout(this.settling);
    if (moving) this.settling = setTimeout(() => this.settle(), SETTLE_MS);
    const changed = this.attempt(() => this.stage.show(this.state, moving));
    this.controls.follow(this.state, this.stage.exposure);
    element('divider').hidden = this.state.view !== 'split';
    element('divider').style.left = `${100 * this.state.split}%`;
    element('divider').setAttribute('aria-valuenow', Math.round(100 * this.state.split));
    for (const label of document.querySelectorAll('.side')) label.hidden = this.state.view !== 'split';
    element('legend').hidden = !this.state.view.startsWith('difference');
    if (changed) element('measured').classList.add('stale');
    this.tellFigures();
    this.tell();
    this.wake();
  }

  // ---- Frames, only while there is something to do ----

  wake() {
    this.awake ??= requestAnimationFrame(() => this.frame());
  }

  frame() {
    this.awake = null;
    if (this.lost || this.failed) return;
    const more = this.attempt(() => this.stage.frame());
    if (this.probing && this.stage.shownPicture()) {
      this.probing = false;
      this.attempt(() => this.probe.show(this.stage, this.place));
    }
    this.tell();
    if (more || this.probing) this.wake();
  }

  attempt(work) {
    try {
      return work();
    } catch (error) {
      if (!this.stage.graphics.gl.isContextLost()) fail(error);
      this.failed = !this.stage.graphics.gl.isContextLost();
      return false;
    }
  }

  fit() {
    const { clientWidth, clientHeight } = this.canvas;
    if (!clientWidth || !clientHeight) return;
    const ratio = Math.min(devicePixelRatio || 1, 2, Math.sqrt(MOST_PIXELS / (clientWidth * clientHeight)));
    this.stage.resize(Math.round(clientWidth * ratio), Math.round(clientHeight * ratio));
    this.probing = true;
    this.wake();
  }

  // ---- What is said ----

  presented(exposure, bound) {
    if (this.state.exposure === 'auto') this.controls.exposureIs(exposure);
    if (bound) {
      element('legend-least').textContent = `−${bound}`;
      element('legend-most').textContent = `+${bound}`;
    }
    const { view, shape, light } = this.state;
    this.canvas.setAttribute('aria-label',
      `${CHOICES.view[view]}: ${shape} under a light, ${light}. Arrow keys turn it.`);
  }

  tellFigures() {
    const figures = this.stage.figures, number = this.state.view.endsWith('_b') ? 1 : 0;
    element('rmse').classList.toggle('waiting', !figures);
    if (!figures) {
      element('rmse').textContent = '…';
      element('noise').textContent = 'waiting for @BRDF@';
      element('done').style.width = '0';
      return;
    }
    const { rmse, noise } = figures.errors[number], percent = (x) => `${(100 * x).toPrecision(3)} %`;
    element('measured').classList.remove('stale');
    element('rmse').textContent = Number.isFinite(rmse) ? percent(rmse) : 'no light on it';
    element('noise').textContent = Number.isFinite(noise)
      ? `noise of @BRDF@ in it ${percent(noise)}${noise > rmse / 5 ? ', still much' : ''}` : '';
    element('done').style.width = figures.finished ? '100%' : `${100 * clamp(NOISE_WANTED / noise, 0, 1)}%`;
    this.probing = true;
  }

  tell() {
    const clampings = this.data.tables.map((table) => clampingOf(table, alphasOf(this.state)));
    const said = [...this.notes, ...this.sentences, ...clampings, faultOfLight(this.state)]
      .filter(Boolean);
    const unfiltered = this.data.tables.some((table) => !table.field && !table.filtered);
    if (this.state.lookup === 'filter' && unfiltered)
      said.push('This browser does not filter 32-bit textures (OES_texture_float_linear): looked up ' +
        'by texels.');
    if (this.data.tables.some((table) => table.material))
      said.push('A field of one material: its roughness is its own.');
    const text = [...said, this.progress()].join(' ');
    // Readers of screens say it aloud: once.
    if (element('status').textContent !== text) element('status').textContent = text;
    element('status').classList.toggle('warning', said.length > 0);
  }

  progress() {
    const { figures, measured } = this.stage;
    if (!figures) return measured?.ready ? '@BRDF@ is sampled.' : 'The table is drawn.';
    const noise = `noise ${(100 * figures.errors[0].noise).toPrecision(2)} % of the mean`;
    const size = `${measured.width} × ${measured.height} pixels`;
    return figures.finished ? `@BRDF@ is done: ${figures.samples} samples a pixel, ${noise}; ${size}.`
      : `@BRDF@ is sampled: ${figures.samples} samples a pixel, ${noise}.`;
  }

  say(sentence) {
    this.sentences = [sentence];
    this.tell();
  }

  // ---- Hands ----

  listen() {
    addEventListener('hashchange', () => this.readFragment());
    new ResizeObserver(() => this.attempt(() => this.fit())).observe(this.canvas);
    this.canvas.addEventListener('webglcontextlost', (event) => this.lose(event));
    this.canvas.addEventListener('webglcontextrestored', () => this.restore());
    this.canvas.addEventListener('pointerdown', (event) => this.grab(event));
    this.canvas.addEventListener('pointermove', (event) => this.move(event));
    this.canvas.addEventListener('pointerup', (event) => this.letGo(event));
    this.canvas.addEventListener('pointercancel', (event) => this.letGo(event));
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    this.canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    this.listenToDivider(element('divider'));
    element('reset').addEventListener('click', () => this.change(standardState(this.data.tables), false));
    element('copy').addEventListener('click', () => this.copy());
  }

  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
  }

  // Two fingers zoom.
  grab(event) {
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.held = { x: event.clientX, y: event.clientY, yaw: this.state.yaw, pitch: this.state.pitch };
    this.canvas.setPointerCapture(event.pointerId);
    this.place = this.placeOf(event);
    this.probing = true;
    this.wake();
  }

  move(event) {
    if (!this.held) {
      this.place = this.placeOf(event);
      this.probing = true;
      return this.wake();
    }
    if (this.fingers.size > 1) return this.pinch(event);
    const degrees = 180 / this.canvas.clientHeight;
    this.turnTo(this.held.yaw - (event.clientX - this.held.x) * degrees,
                this.held.pitch + (event.clientY - this.held.y) * degrees);
  }

  pinch(event) {
    const apart = () => {
      const [a, b] = [...this.fingers.values()];
      return Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), 1);
    };
    const before = apart();
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    this.zoomBy(apart() / before);
  }

  // What was pinched does not turn with the finger that stays.
  letGo(event) {
    this.fingers.delete(event.pointerId);
    this.held = null;
    this.settle();
  }

  turnTo(yaw, pitch) {
    const around = (yaw + 540) % 360 - 180;
    const [low, high] = this.state.shape === 'sphere' ? [-86, 86] : [-26, 56];
    const [yawNow, pitchNow] = [around, clamp(pitch, low, high)].map((x) => Number(short(x)));
    this.change({ ...this.state, yaw: yawNow, pitch: pitchNow }, true);
  }

  zoomBy(factor) {
    const { least, most } = PARAMETERS.zoom;
    const zoom = clamp(this.state.zoom * factor, least, most);
    this.change({ ...this.state, zoom: Number(zoom.toPrecision(3)) }, true);
  }

  wheel(event) {
    event.preventDefault();
    this.zoomBy(Math.exp(-0.001 * clamp(event.deltaY, -200, 200)));
  }

  key(event) {
    if ('+-'.includes(event.key)) return this.zoomBy(event.key === '+' ? 1.1 : 1 / 1.1);
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    if (!event.shiftKey) return this.turnTo(this.state.yaw + 5 * step[0], this.state.pitch + 5 * step[1]);
    const from = this.place ?? [0.5, 0.5];
    this.place = from.map((x, i) => clamp(x + 0.01 * step[i], 0, 1));
    this.probing = true;
    this.showCross();
    this.wake();
  }

  showCross() {
    element('cross').hidden = false;
    element('cross').style.left = `${100 * this.place[0]}%`;
    element('cross').style.bottom = `${100 * this.place[1]}%`;
  }

  listenToDivider(divider) {
    const to = (event) => this.set('split', clamp(this.placeOf(event)[0], 0, 1), true);
    divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener('pointermove', (event) => { if (event.buttons) to(event); });
    divider.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.set('split', Number(short(clamp(this.state.split + step, 0, 1))), false);
    });
  }

  async copy() {
    try {
      await navigator.clipboard.writeText(location.href);
      this.say('The link is copied.');
    } catch {
      this.say(this.copyByHand() ? 'The link is copied.'
        : `The browser copies nothing; the link is ${location.href}`);
    }
  }

  copyByHand() {
    const text = document.createElement('textarea');
    text.value = location.href;
    document.body.append(text);
    text.select();
    const done = document.execCommand('copy');
    text.remove();
    return done;
  }

  // ---- A context comes and goes ----

  lose(event) {
    event.preventDefault();
    this.lost = true;
    showMessage('The browser took the graphics context away. The picture comes back when it gives ' +
      'it back; if not, reload the page.');
    element('status').textContent = 'The graphics context is lost.';
  }

  restore() {
    this.lost = false;
    hideMessage();
    this.attempt(() => {
      const fixed = this.stage.fixed;
      this.begin();
      if (fixed) this.stage.fix(fixed);
    });
    this.sentences = ['The graphics context was lost, and is back.'];
    this.show(false);
  }

  // ---- For tests ----

  hook() {
    return {
      state: () => ({ ...this.state, alphas: alphasOf(this.state), finished: this.stage.finished,
                      ready: !!this.stage.sharp?.ready, errors: this.stage.figures?.errors ?? null,
                      samples: this.stage.figures?.samples ?? 0, nanoseconds: this.stage.nanoseconds,
                      sizes: ['table', 'ggx'].map((kind) => this.stage.sizeOf(kind)), exposure_shown: this.stage.exposure,
                      status: element('status').textContent }),
      set: (key, value) => this.set(key, value, false),
      fix: (size) => { this.stage.fix(size); this.wake(); },
      // Of table A: radiance and cover, rows from below.
      pixels: (number = 0) => [...this.stage.graphics.read(this.stage.sharp.tables[number])],
      loseContext: () => {
        const extension = this.stage.graphics.gl.getExtension('WEBGL_lose_context');
        extension.loseContext();
        return { back: () => extension.restoreContext() };
      },
    };
  }
}

function showMessage(sentence) {
  element('message').textContent = sentence;
  element('message').hidden = false;
}

function hideMessage() { element('message').hidden = true; }

function fail(error) {
  showMessage(error.message);
  element('status').textContent = error.message;
  element('status').classList.add('warning');
}

function switchTheme() {
  const dark = getComputedStyle(document.documentElement).colorScheme.trim() === 'dark';
  document.documentElement.dataset.theme = dark ? 'light' : 'dark';
}

element('theme').addEventListener('click', switchTheme);
try {
  window.ltcViewer = new Viewer(readData()).hook();
} catch (error) {
  document.body.classList.add('off');
  fail(error);
}
