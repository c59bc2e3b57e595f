// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What is drawn and when: by the tables, then by GGX in passes until the noise is small, in bands of
// rows, so that the page answers on slow devices too. A coarse picture stands in while things move.

const NOISE_WANTED = 0.01;     // of the mean
const MOST_SAMPLES = 4096;     // of each kind, point and half
const MOST_A_PASS = 16;        // of these
const FRAME_MS = 28;           // of drawing, between looks at the page
const SLOWEST_TABLE_MS = 4000;  // what takes longer is made smaller: a table's picture,
const SLOWEST_GGX_MS = 12000;   // and this many samples of GGX
const GGX_SAMPLES = 64;
const NOISE_TO_EXPOSE = 0.1;   // from where on GGX tells its own brightness
const BRIGHTEST = 0.9;         // what nearly the brightest becomes, as in `ltcfit render`
const NEARLY_ALL = 0.998;
const DETAILS = [1, 0.75, 0.5, 0.35, 0.25];
const POINTS = 4;
// What of the canvas lies under words, pixels of the page: the picture is the largest square between.
const ABOVE = 58, BELOW = 40;

// Of the colours of a texel.
const meanOf = (values, at) => (values[at] + values[at + 1] + values[at + 2]) / 3;

// How far a picture is. `passes` of GGX are whole ones.
class Picture {
  constructor(graphics, width, height, points) {
    Object.assign(this, { graphics, width, height, points });
    this.tables = graphics.data.tables.map(() => graphics.target(width, height, 1));
    this.restart();
  }
  // Two of two halves: one is read while the other is written.
  get ggx() {
    this.sums ??= [0, 1].map(() => this.graphics.target(this.width, this.height, 2));
    return this.sums;
  }
  restart() {
    this.tablesDone = 0;
    this.samples = 0;  // of each point and half, of either kind
    this.front = 0;    // which of `ggx` has them
    this.row = 0;      // of the job under way
    this.job = null;
  }
  get ready() { return this.tablesDone === this.tables.length; }
  release() { [...this.tables, ...(this.sums ?? [])].forEach((target) => this.graphics.release(target)); }
}

class Stage {
  // `heard`: functions that are told of figures, exposure and errors.
  constructor(canvas, data, heard) {
    Object.assign(this, { canvas, data, heard });
    this.graphics = new Graphics(canvas, data);
    this.nanoseconds = { table: null, ggx: null };  // a point of a pixel; a sample of one
    this.detail = { table: 0, ggx: 0 };             // of DETAILS
    this.drawn = new WeakSet();  // programs
    this.fixed = null;           // a size that was asked for
    this.seed = 1;
    this.lobes = this.graphics.target(2 * LOBE_TEXELS, LOBE_TEXELS, 1);
    this.probed = this.graphics.target(6, 1, 1);
  }

  // ---- What is asked for ----

  // `moving`: more will follow soon. Returns whether the light on the object changed.
  show(state, moving) {
    const before = this.state;
    this.state = state;
    this.moving = moving;
    const key = JSON.stringify({ ...state, view: 0, split: 0, exposure: 0 });
    if (before && key === this.key) {
      this.stale = true;
      return false;
    }
    this.key = key;
    this.uniforms = this.sceneUniforms(state);
    this.restart();
    return true;
  }

  settle() { this.moving = false; }

  resize(width, height) {
    if (this.canvas.width === width && this.canvas.height === height) return;
    Object.assign(this.canvas, { width, height });
    this.drop();
  }

  // Of what is as large as the canvas or smaller: the middle of the picture's square, and its side.
  squareOf(width, height) {
    if (this.fixed) return [width / 2, height / 2, Math.min(width, height)];
    const unit = height / Math.max(this.canvas.clientHeight, 1);
    const room = Math.max(height - (ABOVE + BELOW) * unit, 0.3 * height);
    return [width / 2, Math.max(height - ABOVE * unit - room, 0) + room / 2, Math.min(width, room)];
  }

  // Pixels of the picture alone, whatever the canvas; null: as many as fit.
  fix(size) {
    this.fixed = size;
    this.drop();
  }

  drop() {
    for (const picture of new Set([this.sharp, this.measured, this.coarse])) picture?.release();
    this.sharp = this.measured = this.coarse = null;
    if (this.state) this.restart();
  }

  restart() {
    this.figures = this.levels = null;
    this.stale = true;
    this.finished = false;
    this.chosen = {};
    for (const picture of [this.sharp, this.measured, this.coarse]) picture?.restart();
  }

  sceneUniforms(state) {
    const camera = cameraOf(state), light = lightOf(state), rotation = radians(state.rotation);
    return { camera: camera.position, camera_frame: camera.frame, view_scale: VIEW_SCALE / state.zoom,
             turn: [Math.cos(rotation), Math.sin(rotation)], light_center: light.center,
             light_u: light.u, light_v: light.v, light_radius: light.radius,
             alpha: alphasOf(state), f0: reflectanceOf(state), seed: this.seed,
             light_levels: state.light === 'picture' ? this.graphics.picture() : this.graphics.colors };
  }

  tableUniforms(number) {
    const { size, first, last, warp, storage, alpha_min, crease } = this.data.tables[number];
    return { values: this.graphics.tables[number], 'table.size': size, 'table.first': first,
             'table.last': last, 'table.warp': warp, 'table.storage': storage,
             'table.alpha_min': alpha_min, 'table.crease': crease };
  }

  // ---- Sizes ----

  sizeOf(kind) {
    if (this.fixed) return this.fixed;
    const share = DETAILS[this.detail[kind]];
    return [this.canvas.width, this.canvas.height].map((side) => Math.max(16, Math.round(share * side)));
  }

  // Of a picture by the tables, or with some samples of GGX, as far as it is known.
  milliseconds(kind, detail = this.detail[kind]) {
    const pixels = this.fixed ? this.fixed[0] * this.fixed[1]
      : this.canvas.width * this.canvas.height * DETAILS[detail] ** 2;
    const each = kind === 'table' ? (this.nanoseconds.table ?? 1000) * this.data.tables.length
      : (this.nanoseconds.ggx ?? (this.nanoseconds.table ?? 1000) / 3) * GGX_SAMPLES;
    return each * pixels * POINTS * 1e-6;
  }

  // Once for each picture begun, when most is known.
  chooseDetail(kind, slowest) {
    if (this.chosen[kind]) return;
    this.chosen[kind] = true;
    const wanted = DETAILS.findIndex((_, i) => this.milliseconds(kind, i) < slowest);
    const next = wanted < 0 ? DETAILS.length - 1 : wanted;
    // Sharper again only where there is much room.
    if (next > this.detail[kind] || this.milliseconds(kind, next) < slowest / 2) this.detail[kind] = next;
  }

  get fast() { return this.nanoseconds.table !== null && this.milliseconds('table') < FRAME_MS; }

  coarsePicture() {
    if (!this.coarse) {
      const pixels = clamp(FRAME_MS * 1e6 / (this.nanoseconds.table ?? 4000), 64 ** 2, 256 ** 2);
      const [width, height] = this.fixed ?? [this.canvas.width, this.canvas.height];
      const share = Math.min(1, Math.sqrt(pixels / (width * height)));
      this.coarse = new Picture(this.graphics, Math.max(8, Math.round(width * share)),
                                Math.max(8, Math.round(height * share)), 1);
    }
    return this.coarse;
  }

  // The picture, or another of its size.
  sized(picture, [width, height]) {
    if (picture?.width === width && picture.height === height) return picture;
    if (picture !== this.sharp) picture?.release();
    return new Picture(this.graphics, width, height, POINTS);
  }

  // By the tables, as sharp as can be; and the one that GGX is sampled for: the same where that is
  // fast enough.
  sharpPicture() {
    this.chooseDetail('table', SLOWEST_TABLE_MS);
    const before = this.sharp, next = this.sized(before, this.sizeOf('table'));
    if (before && next !== before) {
      before.release();
      if (this.measured === before) this.measured = null;
    }
    this.sharp = next;
    return next;
  }
  measuredPicture() {
    this.chooseDetail('ggx', SLOWEST_GGX_MS);
    const size = this.sizeOf('ggx');
    const same = this.sharp.width === size[0] && this.sharp.height === size[1];
    if (same && this.measured !== this.sharp) this.measured?.release();
    if (!same && this.measured === this.sharp) this.measured = null;
    this.measured = same ? this.sharp : this.sized(this.measured, size);
    return this.measured;
  }

  // ---- Work ----

  get needsGgx() { return !['table', 'table_b'].includes(this.state.view); }

  nextJob() {
    if (!this.state || this.broken) return null;
    if (!this.fast) {
      const coarse = this.coarsePicture();
      if (!coarse.ready) return this.tableJob(coarse);
      if (this.needsGgx && coarse.samples < 4 && !this.measured?.samples)
        return this.ggxJob(coarse, coarse.samples === 0 ? 1 : 3);
      if (this.moving) return null;
    }
    const sharp = this.sharpPicture();
    if (!sharp.ready) return this.tableJob(sharp);
    const measured = this.measuredPicture();
    if (!measured.ready) return this.tableJob(measured);
    if (this.finished) return null;
    return this.ggxJob(measured, clamp(measured.samples, 1, MOST_A_PASS));
  }

  tableJob(picture) {
    const number = picture.tablesDone;
    return picture.job ??= {
      picture, kind: 'table', cost: picture.width * picture.points, target: picture.tables[number],
      program: this.graphics.program('table', this.state, number),
      values: { ...this.uniforms, ...this.tableUniforms(number), points: picture.points },
      done: () => { ++picture.tablesDone; } };
  }

  ggxJob(picture, count) {
    const before = picture.ggx[picture.front];
    return picture.job ??= {
      picture, kind: 'ggx', cost: picture.width * picture.points * count,
      target: picture.ggx[1 - picture.front], program: this.graphics.program('ggx', this.state),
      values: { ...this.uniforms, before_0: before.textures[0], before_1: before.textures[1],
                points: picture.points, first: picture.samples, count },
      done: () => { picture.front = 1 - picture.front; picture.samples += count; } };
  }

  // Some rows, as many as fit into the time; true when the job is done.
  runBand(job, milliseconds) {
    const { picture, kind } = job, known = this.nanoseconds[kind] ?? 1000;
    const compiled = this.drawn.has(job.program);
    const rows = compiled ? Math.floor(milliseconds * 1e6 / (known * job.cost)) : 4;
    const band = clamp(rows, 1, picture.height - picture.row);
    this.graphics.use(job.program, { ...job.values, picture: this.squareOf(picture.width, picture.height) });
    const began = performance.now();
    this.graphics.draw(job.target, picture.width, picture.height, picture.row, band);
    this.graphics.read(job.target, 0, 1, 1, picture.row);  // waits
    // The first draw compiles, and is no measure.
    if (compiled) this.measure(kind, performance.now() - began, job.cost * band);
    this.drawn.add(job.program);
    picture.row += band;
    if (picture.row < picture.height) return false;
    picture.row = 0;
    picture.job = null;
    job.done();
    return true;
  }

  // What takes no time is mostly waiting: a bound from above.
  measure(kind, milliseconds, work) {
    const each = milliseconds * 1e6 / work, known = this.nanoseconds[kind];
    if (known === null || each < known) this.nanoseconds[kind] = each;
    else if (milliseconds > 4) this.nanoseconds[kind] = 0.8 * known + 0.2 * each;
  }

  // Works for one frame; returns whether there is more to do.
  frame() {
    const end = performance.now() + FRAME_MS;
    let job = null;
    for (let left = FRAME_MS; left > 0 && (job = this.nextJob()); left = end - performance.now())
      if (this.runBand(job, Math.max(left, 4))) this.afterPass(job);
    if (this.stale) this.present();
    return !!this.nextJob();
  }

  afterPass({ picture, kind }) {
    this.stale = true;
    if (kind === 'table' && picture.ready) this.measureTable(picture);
    if (kind === 'ggx' && picture === this.coarse) this.measureCoarse(picture);
    if (kind === 'ggx' && picture === this.measured && Number.isInteger(Math.log2(picture.samples)))
      this.measureError();
  }

  // ---- Figures ----

  // Exposure by the table, until GGX is known well enough.
  measureTable(picture) {
    const values = this.graphics.read(picture.tables[0]);
    this.levels = { table: this.brightest(picture, [values], 1) };
  }

  measureCoarse(picture) {
    if (this.bound) return;
    const a = this.graphics.read(picture.tables[0]);
    const g = [0, 1].map((i) => this.graphics.read(picture.ggx[picture.front], i));
    this.bound = this.boundOf(picture, [a], g, this.weightOf(picture));
  }

  // Within the square alone: what is to its sides depends on the window.
  eachOfObject(picture, cover, visit) {
    const { width, height } = picture, [x0, y0, side] = this.squareOf(width, height);
    const from = (middle) => Math.max(Math.round(middle - side / 2), 0);
    const to = (middle, most) => Math.min(Math.round(middle + side / 2), most);
    for (let y = from(y0); y < to(y0, height); ++y)
      for (let x = from(x0); x < to(x0, width); ++x) {
        const at = 4 * (y * width + x);
        if (cover[at + 3] > 0) visit(at);
      }
  }

  brightest(picture, parts, weight) {
    const magnitudes = [];
    this.eachOfObject(picture, parts[0], (at) => {
      let most = 0;
      for (let c = 0; c < 3; ++c) {
        let total = 0;
        for (const part of parts) total += part[at + c];
        most = Math.max(most, Math.abs(total * weight));
      }
      magnitudes.push(most);
    });
    return quantile(magnitudes, NEARLY_ALL);
  }

  boundOf(picture, tables, ggx, weight) {
    const magnitudes = [];
    for (const table of tables)
      this.eachOfObject(picture, table, (at) => {
        magnitudes.push(Math.abs(meanOf(table, at) - weight * (meanOf(ggx[0], at) + meanOf(ggx[1], at))));
      });
    return roundedUp(quantile(magnitudes, NEARLY_ALL));
  }

  // As sphere_error of src/render/sphere_images.cpp has it; of colours, their means.
  errorOf(picture, table, ggx, weight) {
    let pixels = 0, mean = 0, squares = 0, variance = 0;
    this.eachOfObject(picture, table, (at) => {
      const first = weight * meanOf(ggx[0], at), second = weight * meanOf(ggx[1], at);
      const d = meanOf(table, at) - (first + second);
      ++pixels;
      mean += first + second;
      squares += d * d;
      variance += (first - second) ** 2;
    });
    mean /= pixels;
    return { pixels, mean, rmse: Math.sqrt(squares / pixels) / mean,
             noise: Math.sqrt(variance / pixels) / mean };
  }

  measureError() {
    const picture = this.measured, { graphics } = this;
    const tables = picture.tables.map((target) => graphics.read(target));
    const ggx = [0, 1].map((i) => graphics.read(picture.ggx[picture.front], i));
    const weight = this.weightOf(picture);
    const errors = tables.map((table) => this.errorOf(picture, table, ggx, weight));
    // Samples a pixel, of both kinds and halves, as `ltcfit render --samples` counts them.
    const samples = 2 * 2 * POINTS * picture.samples;
    this.finished = !(errors[0].noise > NOISE_WANTED) || picture.samples >= MOST_SAMPLES;
    this.bound = this.boundOf(picture, tables, ggx, weight);
    if (errors[0].noise < NOISE_TO_EXPOSE && this.levels)
      this.levels.ggx = this.brightest(picture, ggx, weight);
    this.figures = { errors, samples, finished: this.finished, tables, ggx, weight, picture };
    this.heard.figures(this.figures);
  }

  // Of the sums of both halves: each is of `samples` of two kinds together.
  weightOf(picture) { return picture.samples ? 0.5 / picture.samples : 0; }

  get exposure() {
    if (this.state.exposure !== 'auto') return this.state.exposure;
    const level = this.levels?.ggx ?? this.levels?.table ?? 0;
    return level > 0 ? BRIGHTEST / level : 1;
  }

  // ---- To the canvas ----

  // The best picture there is; null where none is whole.
  shownPicture() {
    const best = this.needsGgx ? [this.measured, this.coarse] : [this.sharp, this.measured, this.coarse];
    return best.find((picture) => picture?.ready && (!this.needsGgx || picture.samples > 0)) ?? null;
  }

  present() {
    const picture = this.shownPicture();
    if (!picture) return;
    const { graphics, canvas, state } = this;
    const sharp = this.sharp?.ready ? this.sharp : picture;
    // Differences are of pixels that both have.
    const tables = (state.view.startsWith('difference') ? picture : sharp).tables;
    const ggx = (picture.samples ? picture.ggx[picture.front] : picture.tables[0]).textures;
    graphics.use(graphics.program('present', state), {
      ...this.uniforms, picture: this.squareOf(canvas.width, canvas.height),
      canvas_size: [canvas.width, canvas.height], table_a: tables[0].textures[0],
      table_b: tables.at(-1).textures[0], outline: sharp.tables[0].textures[0],
      ggx_0: ggx[0], ggx_1: ggx.at(-1), ggx_weight: this.weightOf(picture),
      scale_colors: graphics.colors, view: VIEWS.indexOf(state.view),
      divider: state.split * canvas.width, exposure: this.exposure, bound: this.bound ?? 1,
      stage_inner: [0.020, 0.021, 0.024], stage_outer: [0.0045, 0.005, 0.006] });
    graphics.draw(null, canvas.width, canvas.height);
    this.stale = false;
    this.heard.presented({ exposure: this.exposure, bound: this.bound });
  }

  // ---- Under the pointer ----

  // Of a point of the canvas, from its left and lower side, each on [0, 1].
  probe(x, y) {
    const { graphics, canvas } = this;
    const size = [canvas.width, canvas.height];
    graphics.use(graphics.program('probe', this.state),
                 { ...this.uniforms, picture: this.squareOf(...size), pointer: [x * size[0], y * size[1]] });
    graphics.draw(this.probed, 6, 1);
    const values = graphics.read(this.probed);
    const texel = (i) => [...values.subarray(4 * i, 4 * i + 3)];
    if (values[0] < 0.5) return null;
    return { position: texel(1), frame: [texel(2), texel(3), texel(4)], view: texel(5),
             values: this.valuesAt(x, y) };
  }

  // Radiances of the pixel, where they are known.
  valuesAt(x, y) {
    if (!this.figures) return null;
    const { tables, ggx, weight, picture } = this.figures;
    const at = 4 * (Math.min(Math.floor(y * picture.height), picture.height - 1) * picture.width +
                    Math.min(Math.floor(x * picture.width), picture.width - 1));
    const mean = (values) => meanOf(values, at);
    return { tables: tables.map(mean), ggx: weight * (mean(ggx[0]) + mean(ggx[1])) };
  }

  // Densities of GGX and of the table's lobe, one square behind the other, row by row from below.
  lobeDensities(view, number, window) {
    const { graphics } = this;
    graphics.use(graphics.program('lobe', this.state, number),
                 { ...this.uniforms, ...this.tableUniforms(number), view,
                   window_center: window.center, window_half: window.half, side: LOBE_TEXELS });
    graphics.draw(this.lobes, 2 * LOBE_TEXELS, LOBE_TEXELS);
    const values = graphics.read(this.lobes);
    return [0, 1].map((half) => Float32Array.from({ length: LOBE_TEXELS ** 2 }, (_, i) => {
      const row = Math.floor(i / LOBE_TEXELS);
      return values[4 * ((2 * row + half) * LOBE_TEXELS + i % LOBE_TEXELS)];
    }));
  }
}
