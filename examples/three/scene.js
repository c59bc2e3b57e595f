// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A metal sphere under a RectAreaLight, as three.js renders it and integrated point by point. The
// scene is that of `ltcfit render`.
import {
  FloatType, Mesh, MeshStandardMaterial, PerspectiveCamera, RectAreaLight, Scene, SphereGeometry,
  UniformsLib, Vector2, WebGLRenderer, WebGLRenderTarget
} from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';

export { REVISION } from 'three';
export const sphereShare = 0.94;  // of the picture's width and height
export const cameraDistance = 6;
const mostNodes = 128;

// In place of the formula for polygons: the sum over points of the rectangle of a point light there,
// by three's own GGX or by the table's lobe, which is cut at the horizon as GGX is.
const integral = (radiance) => `
#include <lights_physical_pars_fragment>
uniform vec2 nodes[${mostNodes}];  // x: where on [-1, 1], y: weight
uniform int count;
vec3 ggx(vec3 l, vec3 v, vec3 n, PhysicalMaterial material) {
  return BRDF_GGX(l, v, n, material) * dot(n, l);
}
vec3 lobe(vec3 l, vec3 v, vec3 n, PhysicalMaterial material) {
  vec2 uv = LTC_Uv(n, v, material.roughness);
  vec4 t1 = texture2D(ltc_1, uv), t2 = texture2D(ltc_2, uv);
  mat3 inverted = mat3(t1.x, 0, t1.y, 0, 1, 0, t1.z, 0, t1.w);
  vec3 x = normalize(v - n * dot(v, n));
  vec3 cosine = inverted * (l * mat3(x, -cross(n, x), n));
  float squared = dot(cosine, cosine);
  return (material.specularColorBlended * t2.x + (1.0 - material.specularColorBlended) * t2.y) *
    max(cosine.z, 0.0) * abs(determinant(inverted)) / (PI * squared * squared);
}
void integrateRectArea(const in RectAreaLight light, const in vec3 position, const in vec3 normal,
    const in vec3 viewDir, const in vec3 clearcoatNormal, const in PhysicalMaterial material,
    inout ReflectedLight reflected) {
  vec3 shining = cross(light.halfHeight, light.halfWidth);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      vec3 ray = light.position + nodes[i].x * light.halfWidth + nodes[j].x * light.halfHeight;
      ray -= position;
      float squared = dot(ray, ray);
      vec3 l = ray * inversesqrt(squared);
      float facing = -dot(shining, l);
      if (facing > 0.0 && dot(normal, l) > 0.0)
        reflected.directSpecular += light.color * ${radiance}(l, viewDir, normal, material) *
          (nodes[i].y * nodes[j].y * facing / squared);
    }
}
#undef RE_Direct_RectArea
#define RE_Direct_RectArea integrateRectArea`;

// Nodes and weights of Gauss and Legendre.
function quadrature(count) {
  return Array.from({ length: count }, (_, i) => {
    let x = Math.cos(Math.PI * (i + 0.75) / (count + 0.5)), slope;
    for (let step = 0; step < 8; ++step) {
      let [p, before] = [1, 0];
      for (let k = 1; k <= count; ++k)
        [p, before] = [((2 * k - 1) * x * p - (k - 1) * before) / k, p];
      slope = count * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    return new Vector2(x, 2 / ((1 - x * x) * slope * slope));
  });
}

// The points lie closer than a lobe is wide; from there on the sum converges exponentially.
const nodesFor = (roughness, lightSize) =>
  Math.min(mostNodes, Math.max(24, Math.round(1.4 * lightSize / roughness ** 2)));

// The camera and the light of `ltcfit render`.
export function makeCamera() {
  const halfAngle = Math.atan(1 / (Math.sqrt(cameraDistance ** 2 - 1) * sphereShare));
  const camera = new PerspectiveCamera(halfAngle * 360 / Math.PI, 1, 1, 10);
  camera.position.z = cameraDistance;
  return camera;
}

export function makeLight(size) {
  const light = new RectAreaLight('white', 1, 2.2 * size, 1.4 * size);
  light.position.set(1, 1.5, 2.1);
  light.lookAt(0, 0, 0);
  return light;
}

export class Sphere {
  constructor(size, f0, lightSize) {
    RectAreaLightUniformsLib.init();
    for (const { image } of [UniformsLib.LTC_FLOAT_1, UniformsLib.LTC_FLOAT_2])
      if (image.width !== 64 || image.height !== 64)
        throw new Error(`the table is ${image.width} x ${image.height}; three's shader takes 64 x 64`);
    this.lightSize = lightSize;
    this.renderer = new WebGLRenderer();
    this.renderer.setClearAlpha(0);
    this.target = new WebGLRenderTarget(size, size, { type: FloatType });
    this.camera = makeCamera();
    const rendered = new MeshStandardMaterial({ metalness: 1 });
    rendered.color.setScalar(f0);
    this.uniforms = { nodes: { value: null }, count: { value: 0 } };
    this.materials = {
      rendered, ggx: this.integrated(rendered, 'ggx'), lobe: this.integrated(rendered, 'lobe')
    };
    this.mesh = new Mesh(new SphereGeometry(1, 512, 256));
    this.scene = new Scene().add(this.mesh, makeLight(lightSize));
  }

  integrated(rendered, radiance) {
    const material = rendered.clone();
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.fragmentShader = shader.fragmentShader.replace(
        '#include <lights_physical_pars_fragment>', integral(radiance));
    };
    material.customProgramCacheKey = () => radiance;
    return material;
  }

  // Linear: four values a pixel, the first the radiance and the last the coverage. The material is
  // rendered, ggx or lobe; of all nodes, a share can be taken.
  draw(material, roughness, share = 1) {
    const count = Math.round(share * nodesFor(roughness, this.lightSize)), nodes = quadrature(count);
    this.uniforms.nodes.value = Array.from({ length: mostNodes }, (_, i) => nodes[i] ?? nodes[0]);
    this.uniforms.count.value = count;
    this.mesh.material = this.materials[material];
    this.mesh.material.roughness = roughness;
    this.renderer.setRenderTarget(this.target);
    this.renderer.render(this.scene, this.camera);
    const { width, height } = this.target, pixels = new Float32Array(4 * width * height);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, width, height, pixels);
    const error = this.renderer.getContext().getError();
    if (error) throw new Error(`WebGL error ${error}`);
    return pixels;
  }
}
