// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The same as anisotropic.js for WebGPURenderer, as a node material:
//   const lobes = await loadLobes('shaders/wgsl', { table: 'table' });
//   const material = new LobesNodeMaterial(lobes, { metalness: 1, roughness: 0.3, anisotropy: 0.7 });
// It wants the WebGPU backend, for its code is WGSL, and RectAreaLightNode.setLTC, once.
import { MeshPhysicalNodeMaterial } from 'three/webgpu';
import {
  alphaT, anisotropy, anisotropyT, diffuseContribution, materialRoughness, mix, normalView, positionView,
  positionViewDirection, roughness, specularColorBlended, specularF90, texture3D, vec3, wgsl, wgslFn
} from 'three/tsl';

export { loadLobes } from './lobes.js';

// (amplitude, Fresnel term) times the lobe's share of the light, and the cosine's share.
const rectArea = ({ values, filter, folded }) => {
  let [textures, lookUp] = ['', folded ? 'ltc_look_up_folded_field(' : 'ltc_look_up_field('];
  if (values)
    [textures, lookUp] = filter
      ? ['values: texture_3d<f32>, values_sampler: sampler,',
         'ltc_look_up_stacked(values, values_sampler, LTC_TABLE, ']
      : ['values: texture_3d<f32>,', 'ltc_look_up_stacked_exact(values, LTC_TABLE, '];
  return `
fn ltc_rect_area(${textures}
    normal: vec3<f32>, along: vec3<f32>, view_dir: vec3<f32>, center: vec3<f32>,
    half_width: vec3<f32>, half_height: vec3<f32>, alpha_x: f32, alpha_y: f32) -> vec3<f32> {
  if (dot(cross(half_height, half_width), center) >= 0.0) {
    return vec3<f32>(0.0);  // its back
  }
  let x = normalize(along - normal * dot(along, normal));
  let to_tangent = transpose(mat3x3<f32>(x, cross(normal, x), normal));
  let seen = to_tangent * view_dir;
  let view = normalize(vec3<f32>(seen.xy, max(seen.z, 1e-4)));
  let c = to_tangent * center;
  let u = to_tangent * half_width;
  let v = to_tangent * half_height;
  let found = ${lookUp}view, alpha_x, alpha_y);
  let lobe = found${folded ? '.lobe' : ''};
  let cosine = ltc_lobe_of_rows(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0),
                                vec3<f32>(0.0, 0.0, 1.0), 1.0, 0.0);
  let share = ltc_quad${folded ? '_folded' : ''}(found, c - u - v, c + u - v, c + u + v, c - u + v);
  return vec3<f32>(lobe.amplitude * share, lobe.fresnel * share,
                   ltc_quad(cosine, c - u - v, c + u - v, c + u + v, c - u + v));
}`;
};

export class LobesNodeMaterial extends MeshPhysicalNodeMaterial {
  static get type() { return 'LobesNodeMaterial'; }

  // widen: as in anisotropic.js.
  constructor(lobes, parameters, { widen = true } = {}) {
    super(parameters);
    this.lobes = lobes;
    this.widen = widen;
  }

  customProgramCacheKey() {
    return `${super.customProgramCacheKey()} ${this.lobes.id} ${this.widen}`;
  }

  setupLightingModel(builder) {
    const { lobes, widen } = this, model = super.setupLightingModel(builder);
    const own = model.directRectArea.bind(model);
    const shares = wgslFn(rectArea(lobes), [wgsl(lobes.code)]);
    model.directRectArea = (light, ...rest) => {
      const { lightColor, lightPosition, halfWidth, halfHeight, reflectedLight } = light;
      if (model.clearcoat)  // three.js' own adds to variables of its own
        own({ ...light, reflectedLight: { directSpecular: vec3().toVar(), directDiffuse: vec3().toVar() } },
            ...rest);
      // glTF: alpha along the tangent is mix(alpha, 1, anisotropy^2), across it alpha.
      const alpha = (widen ? roughness : materialRoughness.clamp(0.045, 1)).pow2();
      // Without anisotropy: in the plane of incidence, anywhere where there is none.
      let along = positionViewDirection.add(vec3(1e-5, 0, 0)), alphaAlong = alpha;
      if (model.anisotropy)
        [along, alphaAlong] = [anisotropyT, widen ? alphaT : mix(alpha, 1, anisotropy.pow2())];
      const values = lobes.values && texture3D(lobes.values);
      const share = shares(
        ...[values, lobes.filter && values].filter(Boolean), normalView, along, positionViewDirection,
        lightPosition.sub(positionView), halfWidth, halfHeight, alphaAlong, alpha).toVar();
      const ofFresnel = specularF90.sub(specularColorBlended).mul(share.y);
      reflectedLight.directSpecular.addAssign(
        lightColor.mul(specularColorBlended.mul(share.x).add(ofFresnel)));
      reflectedLight.directDiffuse.addAssign(lightColor.mul(diffuseContribution).mul(share.z));
    };
    return model;
  }
}
