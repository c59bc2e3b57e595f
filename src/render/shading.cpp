// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/shading.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/lobe_model.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "table/lookup.h"

namespace ltc {
namespace {

double wrapped(double x) {
  return x < 1 ? x : x - 1;
}

double schlick(double f0, double v_dot_h) {
  const double one_minus = 1 - v_dot_h;
  const double squared = one_minus * one_minus;
  return f0 + (1 - f0) * squared * squared * one_minus;
}

// The densities that the balance heuristic weighs, per steradian, and what a direction brings.
struct Contribution {
  double light_density;  // of points uniform on the light
  double lobe_density;   // of the lobe's own samples
  double value;          // BRDF times Fresnel and cosine
};

double weighed(Technique technique, const Contribution& c) {
  switch (technique) {
    case Technique::light:
      return c.value / c.light_density;
    case Technique::lobe:
      return c.value / c.lobe_density;
    default:
      return c.value / (c.light_density + c.lobe_density);
  }
}

// One point's integral: what both techniques need to know.
class Integrand {
 public:
  Integrand(const Lobe& lobe, double f0, const RectangleLight& light)
      : f0_(f0),
        light_(light),
        sampler_(lobe.model->sampler(lobe)),
        normal_(light.normal()),
        height_(-normal_.dot(light.center)),
        area_(light.area()),
        inverse_square_u_(1 / light.half_u.squaredNorm()),
        inverse_square_v_(1 / light.half_v.squaredNorm()) {}

  // Of a point of the light, u and v on [0, 1].
  double from_light(Technique technique, double u, double v) const {
    const Eigen::Vector3d point =
        light_.center + (2 * u - 1) * light_.half_u + (2 * v - 1) * light_.half_v;
    if (!(point.z() > 0))
      return 0;
    const double distance = point.norm();
    const Eigen::Vector3d omega_l = point / distance;
    const LobeDensities lobe = sampler_->densities(omega_l);
    const double v_dot_h = std::sqrt((1 + sampler_->omega_v().dot(omega_l)) / 2);
    return weighed(technique, {light_density(distance), lobe.sampling,
                               lobe.brdf_cosine * schlick(f0_, v_dot_h)});
  }

  // Of a sample of the lobe.
  double from_lobe(Technique technique, double cos_azimuth, double sin_azimuth,
                   double u_height) const {
    const LobeSample sample = sampler_->sample(cos_azimuth, sin_azimuth, u_height);
    const double distance = -height_ / normal_.dot(sample.omega_l);
    if (!(sample.weight > 0 && distance > 0))
      return 0;
    const Eigen::Vector3d from_center = distance * sample.omega_l - light_.center;
    if (std::abs(from_center.dot(light_.half_u)) * inverse_square_u_ > 1 ||
        std::abs(from_center.dot(light_.half_v)) * inverse_square_v_ > 1)
      return 0;
    const LobeDensities lobe = sampler_->densities_at_offset(sample.offset);
    return weighed(technique, {light_density(distance), lobe.sampling,
                               lobe.brdf_cosine * schlick(f0_, sample.v_dot_h)});
  }

 private:
  // distance^2/(area cos), with cos = height/distance.
  double light_density(double distance) const {
    return distance * distance * distance / (area_ * height_);
  }

  double f0_;
  RectangleLight light_;
  std::unique_ptr<LobeSampler> sampler_;
  Eigen::Vector3d normal_;
  double height_;  // of the origin above the light's plane
  double area_, inverse_square_u_, inverse_square_v_;
};

bool is_seen(const RectangleLight& light) {
  if (!light.faces_origin())
    return false;
  for (const Eigen::Vector3d& corner : light.corners())
    if (corner.z() > 0)
      return true;
  return false;
}

}  // namespace

double ltc_radiance(const Table& table, const Lobe& lobe, double f0, const RectangleLight& light) {
  const LookUp found = look_up(table, lobe);
  const double albedo = f0 * found.amplitude + (1 - f0) * found.fresnel;
  if (!found.matrix.allFinite() || found.matrix.determinant() == 0 || !std::isfinite(albedo))
    return std::numeric_limits<double>::quiet_NaN();
  if (!is_seen(light))
    return 0;
  const LinearlyTransformed cosine(found.matrix);
  return albedo * cosine.integrate_polygon(clip_to_upper_hemisphere(light.corners()));
}

ReferenceIntegrator::ReferenceIntegrator(std::size_t samples, Technique technique)
    : technique_(technique), lattice_(samples) {}

double ReferenceIntegrator::radiance(const Lobe& lobe, double f0, const RectangleLight& light,
                                     const Shifts& shifts) const {
  if (!is_seen(light))
    return 0;
  const Integrand integrand(lobe, f0, light);
  const double turn = 2 * std::numbers::pi * shifts[0];
  const double cos_turn = std::cos(turn), sin_turn = std::sin(turn);
  double sum = 0;
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    if (technique_ != Technique::light) {
      const double cosine = lattice_.cos_azimuth[i], sine = lattice_.sin_azimuth[i];
      sum += integrand.from_lobe(technique_, cosine * cos_turn - sine * sin_turn,
                                 sine * cos_turn + cosine * sin_turn,
                                 wrapped(lattice_.height[i] + shifts[1]));
    }
    if (technique_ != Technique::lobe)
      sum += integrand.from_light(technique_, golden_turns(i, shifts[2]),
                                  wrapped(lattice_.height[i] + shifts[3]));
  }
  return sum / static_cast<double>(lattice_.size());
}

}  // namespace ltc
