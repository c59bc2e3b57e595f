// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/shading.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

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
  double light_density;   // of points uniform on the light
  double normal_density;  // of reflections about visible normals
  double value;           // GGX times Fresnel and cosine
};

double weighed(Technique technique, const Contribution& c) {
  switch (technique) {
    case Technique::light:
      return c.value / c.light_density;
    case Technique::visible_normals:
      return c.value / c.normal_density;
    default:
      return c.value / (c.light_density + c.normal_density);
  }
}

// One point's integral: what both techniques need to know.
class Integrand {
 public:
  Integrand(const Lobe& lobe, double f0, const RectangleLight& light)
      : lobe_(lobe),
        f0_(f0),
        light_(light),
        sampler_(lobe),
        lambda_v_(ggx_lambda(lobe.alpha_x, lobe.alpha_y, sampler_.omega_v())),
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
    Contribution c;
    c.light_density = light_density(distance);
    c.normal_density = sampler_.vndf_density(omega_l);
    const double v_dot_h = std::sqrt((1 + sampler_.omega_v().dot(omega_l)) / 2);
    const double weight =
        (1 + lambda_v_) / (1 + lambda_v_ + ggx_lambda(lobe_.alpha_x, lobe_.alpha_y, omega_l));
    c.value = c.normal_density * weight * schlick(f0_, v_dot_h);
    return weighed(technique, c);
  }

  // Of a reflection about a visible normal.
  double from_normal(Technique technique, double cos_azimuth, double sin_azimuth,
                     double u_height) const {
    const GgxSample sample =
        sampler_.reflect(sampler_.visible_normal(cos_azimuth, sin_azimuth, u_height));
    const double distance = -height_ / normal_.dot(sample.omega_l);
    if (!(sample.weight > 0 && distance > 0))
      return 0;
    const Eigen::Vector3d from_center = distance * sample.omega_l - light_.center;
    if (std::abs(from_center.dot(light_.half_u)) * inverse_square_u_ > 1 ||
        std::abs(from_center.dot(light_.half_v)) * inverse_square_v_ > 1)
      return 0;
    Contribution c;
    c.light_density = light_density(distance);
    c.normal_density = sampler_.vndf_density_at_offset(sample.offset);
    c.value = c.normal_density * sample.weight * schlick(f0_, sample.v_dot_h);
    return weighed(technique, c);
  }

 private:
  // distance^2/(area cos), with cos = height/distance.
  double light_density(double distance) const {
    return distance * distance * distance / (area_ * height_);
  }

  Lobe lobe_;
  double f0_;
  RectangleLight light_;
  GgxSampler sampler_;
  double lambda_v_;
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

double ltc_radiance(const Table& table, const Lobe& lobe, double f0,
                    const RectangleLight& light) {
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
  const double golden = std::numbers::phi - 1;
  double sum = 0, u = shifts[2];
  for (std::size_t i = 0; i < lattice_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (technique_ != Technique::light) {
      const double cosine = lattice_.cos_azimuth()[k], sine = lattice_.sin_azimuth()[k];
      sum += integrand.from_normal(technique_, cosine * cos_turn - sine * sin_turn,
                                   sine * cos_turn + cosine * sin_turn,
                                   wrapped(lattice_.u_height()[k] + shifts[1]));
    }
    if (technique_ != Technique::visible_normals) {
      sum += integrand.from_light(technique_, u, wrapped(lattice_.u_height()[k] + shifts[3]));
      u = wrapped(u + golden);
    }
  }
  return sum / static_cast<double>(lattice_.size());
}

}  // namespace ltc
