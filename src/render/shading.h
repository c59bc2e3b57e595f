// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Radiance that a point reflects from a light: by a table's LTC, exactly integrated, and by
// sampling the lobe, which is the reference.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "brdf/lattice.h"
#include "ltc/folded.h"
#include "ltc/horizon.h"
#include "render/sphere_scene.h"
#include "table/table.h"

namespace ltc {

struct SphereMaterial {
  double alpha_x = 0.5, alpha_y = 0.5;
  double f0 = 1;  // reflectance at normal incidence, of Schlick's Fresnel term

  bool operator==(const SphereMaterial&) const = default;
};

// The four of figure 14 of Aakash et al. 2022; of a BRDF that has no such lobes, as sheen has not,
// isotropic ones that it has.
std::vector<SphereMaterial> usual_materials(const LobeModel& model, double f0 = 1);
// Throws InputError for one that the BRDF does not have, roughnesses raised to `alpha_min`.
void require_material(const SphereMaterial& material, const LobeModel& model, double alpha_min);

// The integral of a clamped cosine's transform by M (ltc/ltsd.h) over what emits to the origin: of
// polygons by equation 11 of Heitz et al. 2016, of disks and spheres by ltc/disk.h, of lines by
// ltc/line.h. The light is cut off at the point's horizon first, and then, transformed, at that of
// the cosine. Throws InputError where the origin lies within the light.
double ltc_share(const LtcLobe& ltc, const Light& light);

// (F0 amplitude + (1 - F0) fresnel) times that, and times what is fetched from the light's texture
// (render/light_texture.h); scaled up for what the lobe has below the horizon if `horizon` says so.
// NaN where the table has no value or a matrix without an inverse.
double ltc_radiance(const Table& table, const Lobe& lobe, double f0, const Light& light,
                    HorizonMode horizon = HorizonMode::clipped);

// Which samples an estimate is made of. Every choice has the same mean.
enum class Technique {
  light,  // points uniform on the light's area, or on that of the flat light in its place
  lobe,   // of the lobe itself, for GGX reflections about visible normals
  both,   // as many of each, weighted by the balance heuristic (Veach 1997)
};

// Integrates the BRDF times Schlick's Fresnel term over a light with samples on shifted lattices.
class ReferenceIntegrator {
 public:
  // `samples` >= 1 of each technique.
  explicit ReferenceIntegrator(std::size_t samples, Technique technique = Technique::both);

  // Independent uniforms on [0, 1) that shift the lattices: estimates with independent shifts are
  // independent, each with the exact radiance as its mean.
  using Shifts = std::array<double, 4>;
  double radiance(const Lobe& lobe, double f0, const Light& light, const Shifts& shifts) const;

 private:
  Technique technique_;
  SampleLattice lattice_;
};

}  // namespace ltc
