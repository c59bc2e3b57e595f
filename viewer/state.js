// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the page shows, as the fragment of its address has it: #alpha_x=0.1&view=difference. What is
// the default is left out.

const SHAPES = ['sphere', 'plane', 'sheet'];
const LIGHTS = ['rectangle', 'star', 'disk', 'sphere', 'line', 'picture'];
const VIEWS = ['table', 'table_b', 'ggx', 'difference', 'difference_b', 'split'];
// Reflectances at normal incidence, linear; F0 scales them.
const METALS = { white: [1, 1, 1], silver: [0.97, 0.96, 0.91], gold: [1, 0.78, 0.34],
                 copper: [0.96, 0.64, 0.54], bronze: [0.72, 0.55, 0.36], steel: [0.63, 0.65, 0.68] };

const one = (names, standard) => ({ names, standard });
const number = (least, most, standard) => ({ least, most, standard });
const PARAMETERS = {
  view: one(VIEWS, 'table'),
  shape: one(SHAPES, 'sphere'),
  light: one(LIGHTS, 'rectangle'),
  metal: one(Object.keys(METALS), 'white'),
  lookup: one(['exact', 'filter'], 'exact'),
  alpha_x: number(1e-4, 1, 0.1),
  alpha_y: number(1e-4, 1, 0.4),
  roughness: number(0.01, 1, 0.4),
  anisotropy: number(0, 1, 0.6),
  rotation: number(-180, 180, 0),
  f0: number(0, 1, 1),
  light_size: number(0.001, 2, 1),
  light_x: number(-10, 10, null),  // of the shape
  light_y: number(-10, 10, null),
  light_z: number(-10, 10, null),
  exposure: { least: 1e-3, most: 1e3, standard: 'auto', or: 'auto' },
  yaw: number(-180, 180, 0),
  pitch: number(-90, 90, 0),
  zoom: number(0.3, 4, 1),
  split: number(0, 1, 0.5),
};
const PLACES = ['light_x', 'light_y', 'light_z'];

const standardPlace = (shape) => shape === 'sphere' ? [1, 1.5, 2.1] : [0, 1.5, -2];

function standardOf(key, shape) {
  const place = PLACES.indexOf(key);
  return place < 0 ? PARAMETERS[key].standard : standardPlace(shape)[place];
}

// A field of one material has no other.
function standardState(tables) {
  const state = { gltf: false };
  for (const key of Object.keys(PARAMETERS)) state[key] = standardOf(key, 'sphere');
  if (tables[0]?.material) [state.alpha_x, state.alpha_y] = tables[0].material;
  return state;
}

function allowedText(key) {
  const { names, least, most, or } = PARAMETERS[key];
  return names ? names.join(', ') : `a number in [${least}, ${most}]${or ? ` or ${or}` : ''}`;
}

// The value of a text; undefined where it is not allowed.
function valueOf(key, text) {
  const { names, least, most, or } = PARAMETERS[key];
  if (names) return names.includes(text) ? text : undefined;
  if (or && text === or) return or;
  const value = Number(text);
  return /^[-+.\deE]+$/.test(text) && value >= least && value <= most ? value : undefined;
}

function refusalOf(key, text, state) {
  return `${key}=${text} is not allowed; expected ${allowedText(key)}; taken: ${state[key]}.`;
}

// The state of a fragment, and a sentence for each part of it that is refused.
function stateOfFragment(fragment, tables) {
  const state = standardState(tables);
  const refused = [];
  const given = new Map(new URLSearchParams(fragment.replace(/^#/, '')));
  const shape = given.get('shape');
  if (SHAPES.includes(shape)) PLACES.forEach((key) => { state[key] = standardOf(key, shape); });
  for (const [key, text] of given) {
    if (!Object.hasOwn(PARAMETERS, key)) {
      refused.push(`${key} is unknown; known: ${Object.keys(PARAMETERS).join(', ')}.`);
      continue;
    }
    const value = valueOf(key, text);
    if (value === undefined) refused.push(refusalOf(key, text, state));
    else state[key] = value;
  }
  state.gltf = given.has('roughness') || given.has('anisotropy');
  if (state.gltf && (given.has('alpha_x') || given.has('alpha_y')))
    refused.push('alpha_x and alpha_y do not go with roughness and anisotropy; taken: the latter.');
  if (tables.length < 2 && state.view.endsWith('_b')) {
    refused.push(`view=${state.view} is not allowed; expected a second table; taken: table.`);
    state.view = 'table';
  }
  return { state, refused };
}

function fragmentOf(state, tables) {
  const standard = standardState(tables);
  const parts = [];
  for (const key of Object.keys(PARAMETERS)) {
    const ofMaterial = key === 'roughness' || key === 'anisotropy';
    if (state.gltf ? key.startsWith('alpha_') : ofMaterial) continue;
    const usual = PLACES.includes(key) ? standardOf(key, state.shape) : standard[key];
    const value = state[key];
    if (value !== usual || ofMaterial)
      parts.push(`${key}=${typeof value === 'number' ? short(value) : value}`);
  }
  return parts.join('&');
}

// The roughnesses along the tangent and the bitangent; of glTF's, KHR_materials_anisotropy.
function alphasOf(state) {
  if (!state.gltf) return [state.alpha_x, state.alpha_y];
  const alpha = state.roughness ** 2;
  return [alpha + (1 - alpha) * state.anisotropy ** 2, alpha];
}

// The same material by the other two numbers. glTF's rough direction is the tangent.
function withOtherRoughness(state) {
  const next = { ...state, gltf: !state.gltf };
  const [x, y] = alphasOf(state);
  if (state.gltf) return { ...next, alpha_x: x, alpha_y: y };
  const rough = Math.max(x, y), smooth = Math.min(x, y);
  next.roughness = clamp(Math.sqrt(smooth), 0.01, 1);
  next.anisotropy = smooth < 1 ? Math.sqrt((rough - smooth) / (1 - smooth)) : 0;
  if (y > x) next.rotation = state.rotation > 90 ? state.rotation - 270 : state.rotation + 90;
  return next;
}

const reflectanceOf = (state) => scaled(state.f0, METALS[state.metal]);
