// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The sphere of `ltcfit render` in three.js, by WebGL and by WebGPU, at the very points it is
// rendered at there.
import {
  BufferAttribute, FloatType, Mesh, MeshPhysicalMaterial, RenderTarget, Scene, ShaderChunk, SphereGeometry,
  WebGLRenderer, WebGLRenderTarget
} from 'three';
import { RectAreaLightTexturesLib } from 'three/addons/lights/RectAreaLightTexturesLib.js';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { lightByLobes, loadLobes } from './anisotropic.js';
import { cameraDistance, makeCamera, makeLight, sphereShare } from './scene.js';

// With tangents along the parallels, as computeTangents has them, without its rounding at the poles.
function sphere() {
  const geometry = new SphereGeometry(1, 512, 256), uv = geometry.attributes.uv;
  const tangents = Float32Array.from({ length: 4 * uv.count }, (_, i) => {
    const azimuth = 2 * Math.PI * uv.getX(i >> 2);
    return [Math.sin(azimuth), 0, Math.cos(azimuth), 1][i % 4];
  });
  return geometry.setAttribute('tangent', new BufferAttribute(tangents, 4));
}

// In place of the mesh, which rasterizers put on a grid, the sphere itself.
function castRays(material, side) {
  const distance = cameraDistance.toFixed(1), horizon = cameraDistance ** 2 - 1;
  const rays = `
  vec2 at = (2.0 * gl_FragCoord.xy / ${side}.0 - 1.0) / ${Math.sqrt(horizon) * sphereShare};
  geometryViewDir = normalize(vec3(-at, 1.0));
  float towards = ${distance} * geometryViewDir.z;
  float away = towards - sqrt(max(towards * towards - ${horizon}.0, 0.0));
  geometryPosition = -away * geometryViewDir;
  geometryNormal = normalize(geometryPosition + vec3(0.0, 0.0, ${distance}));
  #ifdef USE_ANISOTROPY
  vec3 east = normalize(vec3(geometryNormal.z, 0.0, -geometryNormal.x));
  vec2 turn = normalize(anisotropyVector);
  material.anisotropyT = turn.x * east + turn.y * cross(geometryNormal, east);
  #endif`;
  const { onBeforeCompile, customProgramCacheKey } = material;
  material.onBeforeCompile = (shader) => {
    onBeforeCompile(shader);
    const chunk = ShaderChunk.lights_fragment_begin.replace(/vec3 geometryViewDir = .*;/, `$&${rays}`);
    shader.fragmentShader = shader.fragmentShader.replace('#include <lights_fragment_begin>', chunk);
  };
  material.customProgramCacheKey = () => `${customProgramCacheKey()} rays`;
  return material;
}

// Radiances, of 2 x 2 points a pixel, from the topmost line on.
function averaged(pixels, size, lowestFirst) {
  const line = pixels.length / (2 * size), image = new Float32Array(size * size);
  for (let row = 0; row < 2 * size; ++row)
    for (let column = 0; column < 2 * size; ++column)
      image[((lowestFirst ? 2 * size - 1 - row : row) >> 1) * size + (column >> 1)] +=
        pixels[row * line + 4 * column] / 4;
  return image;
}

class Drawing {
  constructor(size, lightSize) {
    this.size = size;
    this.mesh = new Mesh(sphere());
    this.scene = new Scene().add(this.mesh, makeLight(lightSize));
    this.camera = makeCamera();
  }
  async load(files) {
    const load = (what) => loadLobes(`/shaders/${this.language}`, what);
    const { table, field } = files;
    this.lobes = {
      table: await load({ table }), field: await load({ field }), filtered: await load({ table, filter: true })
    };
  }
  begin(material, target) {
    this.mesh.material = material;
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene, this.camera);
  }
}

export class WebGL extends Drawing {
  language = 'glsl';
  async start(files) {
    RectAreaLightUniformsLib.init();
    await this.load(files);
    this.renderer = new WebGLRenderer();
    this.target = new WebGLRenderTarget(2 * this.size, 2 * this.size, { type: FloatType });
    return this;
  }
  // by: table, filtered, field, or three for its own. Of a mesh, or by rays.
  async draw(parameters, by, { widen = false, rays = false } = {}) {
    const own = new MeshPhysicalMaterial(parameters), side = 2 * this.size;
    const material = by === 'three' ? own : lightByLobes(own, this.lobes[by], { widen });
    this.begin(rays ? castRays(material, side) : material, this.target);
    const pixels = new Float32Array(4 * side * side);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, side, side, pixels);
    const error = this.renderer.getContext().getError();
    if (error) throw new Error(`WebGL error ${error}`);
    return averaged(pixels, this.size, true);
  }
}

export class WebGPU extends Drawing {
  language = 'wgsl';
  async start(files) {
    if (!await navigator.gpu?.requestAdapter()) throw new Error('this browser has no WebGPU');
    const { RectAreaLightNode, WebGPURenderer } = await import('three/webgpu');
    const { LobesNodeMaterial } = await import('./anisotropic-webgpu.js');
    this.make = (...all) => new LobesNodeMaterial(...all);
    RectAreaLightNode.setLTC(RectAreaLightTexturesLib.init());
    await this.load(files);
    this.renderer = new WebGPURenderer();
    await this.renderer.init();
    this.target = new RenderTarget(2 * this.size, 2 * this.size, { type: FloatType });
    return this;
  }
  async draw(parameters, by, { widen = false } = {}) {
    this.begin(this.make(this.lobes[by], parameters, { widen }), this.target);
    const side = 2 * this.size;
    const pixels = await this.renderer.readRenderTargetPixelsAsync(this.target, 0, 0, side, side);
    return averaged(pixels, this.size, false);
  }
}
