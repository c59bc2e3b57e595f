// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Anisotropic metal (and anything else of MeshPhysicalMaterial) under RectAreaLights, in WebGL:
//   const lobes = await loadLobes('shaders/glsl', { table: 'table' });
//   const material = lightByLobes(
//     new MeshPhysicalMaterial({ metalness: 1, roughness: 0.3, anisotropy: 0.7 }), lobes);
// The mesh has tangents (BufferGeometry.computeTangents) or at least uv. All else of the material,
// and all other lights, are three.js' own; so is RectAreaLightUniformsLib.init(), once.
import { ShaderChunk } from 'three';

export { loadLobes } from './lobes.js';

const functions = '#include <lights_physical_pars_fragment>';
const values = '#include <lights_physical_fragment>';

const lookUp = ({ values, filter, folded }) => values ? `
uniform highp sampler3D ltc_values;
LtcLobe ltc_found(vec3 view, float alpha_x, float alpha_y) {
  return ltc_look_up_stacked${filter ? '' : '_exact'}(ltc_values, LTC_TABLE, view, alpha_x, alpha_y);
}` : folded ? `
LtcFoldedLobe ltc_found(vec3 view, float alpha_x, float alpha_y) {
  return ltc_look_up_folded_field(view, alpha_x, alpha_y);
}` : `
LtcLobe ltc_found(vec3 view, float alpha_x, float alpha_y) {
  return ltc_look_up_field(view, alpha_x, alpha_y);
}`;

const rectArea = ({ folded }) => `
void ltc_rect_area(const in RectAreaLight light, const in vec3 position, const in vec3 normal,
    const in vec3 viewDir, const in vec3 clearcoatNormal, const in PhysicalMaterial material,
    inout ReflectedLight reflected) {
#ifdef USE_CLEARCOAT
  ReflectedLight own;  // three.js' clearcoat adds to variables of its own
  RE_Direct_RectArea_Physical(light, position, normal, viewDir, clearcoatNormal, material, own);
#endif
  vec3 center = light.position - position;
  if (dot(cross(light.halfHeight, light.halfWidth), center) >= 0.0) return;  // its back
  // glTF: alpha along the tangent is mix(alpha, 1, anisotropy^2), across it alpha.
  float alpha = material.roughness * material.roughness;
#ifdef USE_ANISOTROPY
  vec2 alphas = vec2(material.alphaT, alpha);
  vec3 x = material.anisotropyT;
#else
  vec2 alphas = vec2(alpha);
  vec3 x = viewDir + vec3(1e-5, 0.0, 0.0);  // in the plane of incidence, anywhere where there is none
#endif
  x = normalize(x - normal * dot(x, normal));
  mat3 toTangent = transpose(mat3(x, cross(normal, x), normal));
  vec3 view = toTangent * viewDir;
  view = normalize(vec3(view.xy, max(view.z, 1e-4)));
  vec3 c = toTangent * center, u = toTangent * light.halfWidth, v = toTangent * light.halfHeight;
  ${folded ? 'LtcFoldedLobe' : 'LtcLobe'} found = ltc_found(view, alphas.x, alphas.y);
  LtcLobe lobe = found${folded ? '.lobe' : ''};
  vec3 f0 = material.specularColorBlended;
  vec3 reflectance = f0 * lobe.amplitude + (vec3(material.specularF90) - f0) * lobe.fresnel;
  reflected.directSpecular += light.color * reflectance *
      ltc_quad${folded ? '_folded' : ''}(found, c - u - v, c + u - v, c + u + v, c - u + v);
  if (material.metalness < 1.0) {
    LtcLobe cosine = ltc_lobe_of_rows(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), 1.0, 0.0);
    reflected.directDiffuse += light.color * material.diffuseContribution *
        ltc_quad(cosine, c - u - v, c + u - v, c + u + v, c - u + v);
  }
}
#undef RE_Direct_RectArea
#define RE_Direct_RectArea ltc_rect_area`;

// widen: three.js adds to the roughness where normals turn fast from pixel to pixel; without it the
// roughness is what the material says.
export function lightByLobes(material, lobes, { widen = true } = {}) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.ltc_values = { value: lobes.values };
    const chunk = ShaderChunk.lights_physical_fragment;
    shader.fragmentShader = shader.fragmentShader
      .replace(functions, [functions, lobes.code, lookUp(lobes), rectArea(lobes)].join('\n'))
      .replace(values, widen ? chunk : chunk.replace('material.roughness += geometryRoughness;', ''));
  };
  material.customProgramCacheKey = () => `ltcfit ${lobes.id} ${widen}`;
  return material;
}
