// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// WebGL 2: programs by what they are compiled for, textures, targets of floats.

const VERTEX_SHADER = `#version 300 es
void main() {
  gl_Position = vec4(4.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0, 1);
}`;
const LIBRARY = ['ltc_lobe', 'ltc_polygon', 'ltc_disk', 'ltc_line', 'ltc_table', 'ltc_texture',
                 'ltc_folded', 'ltc_folded_lights', 'ltc_folded_table'];
// What each program is made of; `table` programs also of a table's look-up.
const PROGRAMS = {
  table: [...LIBRARY, 'scene', 'table', 'table_main'],
  ggx: ['scene', 'ggx', 'ggx_main'],
  present: ['scene', 'present'],
  probe: ['scene', 'probe_main'],
  lobe: [...LIBRARY, 'scene', 'table', 'ggx', 'lobe_main'],
};
const OF_TABLES = ['table', 'lobe'];

class Graphics {
  constructor(canvas, data) {
    this.gl = canvas.getContext('webgl2', { antialias: false, alpha: false, depth: false,
                                            preserveDrawingBuffer: true });
    if (!this.gl)
      throw new Error('This browser gives the page no WebGL 2, with which it draws: switch on ' +
        'hardware acceleration, or open the page in another browser.');
    this.data = data;
    this.programs = new Map();
    this.chooseFloats();
    this.tables = data.tables.map((table) => table.field ? null : this.tableTexture(table));
    this.colors = this.colorTexture(data.diverging);
    // A vertex array of nothing: the vertices are numbers alone.
    this.gl.bindVertexArray(this.gl.createVertexArray());
    this.gl.enable(this.gl.SCISSOR_TEST);
  }

  chooseFloats() {
    const { gl } = this;
    this.notes = [];
    this.linearFloats = !!gl.getExtension('OES_texture_float_linear');
    if (gl.getExtension('EXT_color_buffer_float')) {
      this.format = gl.RGBA32F;
    } else if (gl.getExtension('EXT_color_buffer_half_float')) {
      this.format = gl.RGBA16F;
      this.notes.push('This browser cannot draw to 32-bit floats (EXT_color_buffer_float): sums ' +
        'are of 16 bits, and errors below 0.1 % are not to be trusted.');
    } else {
      throw new Error('This browser cannot draw to floats (EXT_color_buffer_float), in which the ' +
        'page sums up light: open it in another browser.');
    }
  }

  // ---- Textures ----

  texture(target, filter) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(target, texture);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R])
      gl.texParameteri(target, side, gl.CLAMP_TO_EDGE);
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter === gl.NEAREST ? filter : gl.LINEAR);
    return texture;
  }

  tableTexture(table) {
    const { gl } = this;
    const [alphas, lambdas, thetas, phis] = table.size, depth = (table.folded ? 4 : 3) * alphas * lambdas;
    const most = gl.getParameter(gl.MAX_3D_TEXTURE_SIZE);
    if (Math.max(depth, thetas, phis) > most)
      throw new Error(`${table.name} is ${phis} x ${thetas} x ${depth} texels; this browser's 3-D ` +
        `textures have at most ${most} a side. Fewer nodes along alpha and lambda will do.`);
    // 32 bits cannot be filtered everywhere; texels can be read everywhere.
    table.filtered = table.half || this.linearFloats;
    const texture = this.texture(gl.TEXTURE_3D, table.filtered ? gl.LINEAR : gl.NEAREST);
    gl.texImage3D(gl.TEXTURE_3D, 0, table.half ? gl.RGBA16F : gl.RGBA32F, phis, thetas, depth, 0,
                  gl.RGBA, table.half ? gl.HALF_FLOAT : gl.FLOAT, table.values);
    return texture;
  }

  colorTexture(bytes) {
    const { gl } = this, count = bytes.length / 3;
    const texture = this.texture(gl.TEXTURE_2D, gl.LINEAR);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, count, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, new Uint8Array(bytes));
    return texture;
  }

  // Made when a light asks for it: half a second of filtering.
  picture() {
    const { gl } = this;
    if (this.levels) return this.levels;
    this.levels = this.texture(gl.TEXTURE_2D, gl.LINEAR_MIPMAP_LINEAR);
    pictureLevels().forEach(({ size, values }, level) => gl.texImage2D(
      gl.TEXTURE_2D, level, gl.RGBA16F, size, size, 0, gl.RGBA, gl.FLOAT, values));
    return this.levels;
  }

  target(width, height, count) {
    const { gl } = this, framebuffer = gl.createFramebuffer();
    // 32 bits are filtered where they can be: of the coarse picture, which is enlarged.
    const filter = this.linearFloats || this.format === gl.RGBA16F ? gl.LINEAR : gl.NEAREST;
    const textures = [];
    for (let i = 0; i < count; ++i) {
      textures.push(this.texture(gl.TEXTURE_2D, filter));
      gl.texStorage2D(gl.TEXTURE_2D, 1, this.format, width, height);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    const places = textures.map((texture, i) => {
      const place = gl.COLOR_ATTACHMENT0 + i;
      gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, texture, 0);
      return place;
    });
    gl.drawBuffers(places);
    return { framebuffer, textures, width, height };
  }

  release(target) {
    if (!target) return;
    target.textures.forEach((texture) => this.gl.deleteTexture(texture));
    this.gl.deleteFramebuffer(target.framebuffer);
  }

  // ---- Programs ----

  // Of a scene and, where it looks up, a table: small shaders compile soon.
  program(kind, state, number = 0) {
    const ofTable = OF_TABLES.includes(kind);
    const exact = state.lookup === 'exact' || !this.data.tables[number].filtered;
    const key = [kind, state.shape, state.light, ofTable ? `${number} ${exact}` : ''].join(' ');
    if (!this.programs.has(key)) this.programs.set(key, this.link(this.source(kind, state, number, exact)));
    return this.programs.get(key);
  }

  source(kind, state, number, exact) {
    const { shaders, tables } = this.data, table = tables[number];
    const text = ['#version 300 es', 'precision highp float;', 'precision highp int;',
                  'precision highp sampler2D;', 'precision highp sampler3D;',
                  `const int SHAPE = ${SHAPES.indexOf(state.shape)};`,
                  `const int LIGHT = ${LIGHTS.indexOf(state.light)};`,
                  `#define FIELD ${table.field ? 1 : 0}`,
                  `#define FOLDED ${table.folded ? 1 : 0}`, `#define EXACT ${exact ? 1 : 0}`,
                  `#define BOTH_ALPHAS ${table.both_alphas ? 1 : 0}`];
    if (OF_TABLES.includes(kind) && table.field) {
      text.push(table.field);
      text.push(`#define FIELD_FUNCTION ${/void (\w+)\(/.exec(table.field)[1]}`);
    }
    return [...text, ...PROGRAMS[kind].map((name) => shaders[name])].join('\n');
  }

  shader(type, source) {
    const { gl } = this, shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    return shader;
  }

  link(source) {
    const { gl } = this, program = gl.createProgram();
    const shaders = [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, source]]
      .map(([type, text]) => this.shader(type, text));
    shaders.forEach((shader) => gl.attachShader(program, shader));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error('This browser refuses a shader of the page: ' +
        (shaders.map((shader) => gl.getShaderInfoLog(shader)).join(' ').trim() ||
         gl.getProgramInfoLog(program)));
    const uniforms = {};
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
    for (let i = 0; i < count; ++i) {
      const { name, type } = gl.getActiveUniform(program, i);
      uniforms[name] = { type, place: gl.getUniformLocation(program, name) };
    }
    return { program, uniforms };
  }

  // Uses it with these values; textures get units in their order.
  use({ program, uniforms }, values) {
    const { gl } = this;
    gl.useProgram(program);
    let textures = 0;
    for (const [name, { type, place }] of Object.entries(uniforms)) {
      const value = values[name];
      if (type === gl.SAMPLER_2D || type === gl.SAMPLER_3D) {
        gl.activeTexture(gl.TEXTURE0 + textures);
        gl.bindTexture(type === gl.SAMPLER_2D ? gl.TEXTURE_2D : gl.TEXTURE_3D, value);
        gl.uniform1i(place, textures++);
      } else if (type === gl.INT) gl.uniform1i(place, value);
      else if (type === gl.FLOAT) gl.uniform1f(place, value);
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value);
      else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, value);
      else gl.uniformMatrix3fv(place, false, value);
    }
  }

  // Rows of a target, or of the canvas where there is none.
  draw(target, width, height, first = 0, rows = height) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target?.framebuffer ?? null);
    gl.viewport(0, 0, width, height);
    gl.scissor(0, first, width, rows);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Waits until all is drawn; floats of part of a target.
  read(target, index = 0, width = target.width, height = target.height, row = 0) {
    const { gl } = this, values = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.framebuffer);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + index);
    gl.readPixels(0, row, width, height, gl.RGBA, gl.FLOAT, values);
    return values;
  }
}
