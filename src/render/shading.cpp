// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "render/shading.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "ltc/disk.h"
#include "ltc/line.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "render/light_texture.h"
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

// The flat light as points in units of its half sides: which are on it, and where those uniform on
// its area lie.
class Outline {
 public:
  explicit Outline(const Light& flat) : flat_(flat), corners_(flat.outline()) {
    double squares = 0;  // of the unit square's four
    if (flat.shape == LightShape::disk)
      squares = std::numbers::pi;
    else if (flat.shape == LightShape::rectangle)
      squares = 4;
    else
      squares = static_cast<double>(corners_.size()) * triangle_area(0);
    area_ = squares * flat.half_u.norm() * flat.half_v.norm();
  }

  double area() const { return area_; }

  // From u and v on [0, 1): continuous maps, periodic in u but for the rectangle's.
  Eigen::Vector2d at(double u, double v) const {
    if (flat_.shape == LightShape::rectangle)
      return {2 * u - 1, 2 * v - 1};
    if (flat_.shape == LightShape::disk) {
      const double azimuth = 2 * std::numbers::pi * u;
      return std::sqrt(v) * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    }
    // A star is a fan of triangles of one size about its centre.
    const double place = u * static_cast<double>(corners_.size());
    const auto first = std::min(static_cast<std::size_t>(place), corners_.size() - 1);
    const double along = place - static_cast<double>(first);
    return std::sqrt(v) * ((1 - along) * corners_[first] + along * corner_after(first));
  }

  bool contains(const Eigen::Vector2d& point) const {
    if (flat_.shape == LightShape::rectangle)
      return std::abs(point.x()) <= 1 && std::abs(point.y()) <= 1;
    if (flat_.shape == LightShape::disk)
      return point.squaredNorm() <= 1;
    bool inside = false;  // edges to the right of it, even or odd
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Eigen::Vector2d &a = corners_[i], b = corner_after(i);
      if ((a.y() > point.y()) != (b.y() > point.y()) &&
          point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
    return inside;
  }

 private:
  const Eigen::Vector2d& corner_after(std::size_t i) const {
    return corners_[(i + 1) % corners_.size()];
  }
  double triangle_area(std::size_t i) const {
    const Eigen::Vector2d &a = corners_[i], &b = corner_after(i);
    return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
  }

  const Light& flat_;
  std::span<const Eigen::Vector2d> corners_;
  double area_ = 0;
};

// One point's integral over a flat light: what both techniques need to know.
class Integrand {
 public:
  Integrand(const Lobe& lobe, double f0, const Light& flat)
      : f0_(f0),
        light_(flat),
        outline_(light_),
        sampler_(lobe.model->sampler(lobe)),
        normal_(light_.normal().dot(light_.center) > 0 ? -light_.normal() : light_.normal()),
        height_(-normal_.dot(light_.center)),
        inverse_square_u_(1 / light_.half_u.squaredNorm()),
        inverse_square_v_(1 / light_.half_v.squaredNorm()) {}
  Integrand(const Integrand&) = delete;
  Integrand& operator=(const Integrand&) = delete;

  // Of a point of the light, u and v on [0, 1].
  double from_light(Technique technique, double u, double v) const {
    const Eigen::Vector2d place = outline_.at(u, v);
    const Eigen::Vector3d point =
        light_.center + place.x() * light_.half_u + place.y() * light_.half_v;
    if (!(point.z() > 0))
      return 0;
    const double distance = point.norm();
    const Eigen::Vector3d omega_l = point / distance;
    const LobeDensities lobe = sampler_->densities(omega_l);
    const double v_dot_h = std::sqrt((1 + sampler_->omega_v().dot(omega_l)) / 2);
    return weighed(technique, {light_density(distance), lobe.sampling,
                               lobe.brdf_cosine * schlick(f0_, v_dot_h) * emitted(place)});
  }

  // Of a sample of the lobe.
  double from_lobe(Technique technique, double cos_azimuth, double sin_azimuth,
                   double u_height) const {
    const LobeSample sample = sampler_->sample(cos_azimuth, sin_azimuth, u_height);
    const double distance = -height_ / normal_.dot(sample.omega_l);
    if (!(sample.weight > 0 && distance > 0))
      return 0;
    const Eigen::Vector3d from_center = distance * sample.omega_l - light_.center;
    const Eigen::Vector2d place(from_center.dot(light_.half_u) * inverse_square_u_,
                                from_center.dot(light_.half_v) * inverse_square_v_);
    if (!outline_.contains(place))
      return 0;
    const LobeDensities lobe = sampler_->densities_at_offset(sample.offset);
    return weighed(technique, {light_density(distance), lobe.sampling,
                               lobe.brdf_cosine * schlick(f0_, sample.v_dot_h) * emitted(place)});
  }

 private:
  // distance^2/(area cos), with cos = height/distance.
  double light_density(double distance) const {
    return distance * distance * distance / (outline_.area() * height_);
  }
  double emitted(const Eigen::Vector2d& place) const {
    return light_.texture ? light_.texture->emitted(place) : 1;
  }

  double f0_;
  Light light_;
  Outline outline_;
  std::unique_ptr<LobeSampler> sampler_;
  Eigen::Vector3d normal_;  // towards the origin
  double height_;           // of the origin above the light's plane
  double inverse_square_u_, inverse_square_v_;
};

bool is_seen(const Light& light) {
  return light.emits_to_origin() && light.reaches_above_horizon();
}

// What stands in for the image in the LTC's integral.
double fetched(const Eigen::Matrix3d& matrix, const Light& light) {
  if (!light.texture)
    return 1;
  const Eigen::Matrix3d inverse = matrix.inverse();
  return light.texture->fetched(inverse * light.center, inverse * light.half_u,
                                inverse * light.half_v);
}

// A fold takes polygons to polygons, and nothing else to anything simple: disks are polygons of the
// same area, within 1e-4 of their share, lines the strip of their outline.
double folded_share(const FoldedCosine& lobe, const Light& light) {
  constexpr int edges = 128;
  const std::optional<Light> flat = light.flat();
  if (!flat)
    return 0;
  std::vector<Eigen::Vector3d> vertices = flat->corners();
  if (vertices.empty()) {
    const double turn = 2 * std::numbers::pi / edges, scale = std::sqrt(turn / std::sin(turn));
    for (int i = 0; i < edges; ++i)
      vertices.push_back(flat->center + scale * (std::cos(i * turn) * flat->half_u +
                                                 std::sin(i * turn) * flat->half_v));
  }
  return std::abs(lobe.integrate_polygon(clip_to_upper_hemisphere(vertices)));
}

}  // namespace

std::vector<SphereMaterial> usual_materials(const LobeModel& model, double f0) {
  const auto served = [&](std::vector<SphereMaterial> materials) {
    std::erase_if(materials, [&](const SphereMaterial& material) {
      try {
        require_material(material, model, 0);
        return false;
      } catch (const InputError&) {
        return true;
      }
    });
    return materials;
  };
  const std::vector<SphereMaterial> anisotropic =
      served({{0.05, 0.25, f0}, {0.5, 0.02, f0}, {0.5, 0.25, f0}, {0.5, 1.0, f0}});
  return anisotropic.empty()
             ? served({{0.02, 0.02, f0}, {0.1, 0.1, f0}, {0.3, 0.3, f0}, {1.0, 1.0, f0}})
             : anisotropic;
}

void require_material(const SphereMaterial& material, const LobeModel& model, double alpha_min) {
  const auto raised = [&](double alpha) { return std::max(alpha, alpha_min); };
  model.require({raised(material.alpha_x), raised(material.alpha_y), 0, 0, &model});
}

double ltc_share(const LtcLobe& ltc, const Light& light) {
  if (!is_seen(light))
    return 0;
  if (!ltc.creases.empty())
    return folded_share(FoldedCosine(ltc), light);
  if (light.shape == LightShape::line) {
    const double radius = light.half_v.norm();
    return light.flat() ? ltc_share(ltc.matrix, Line{light.center - light.half_u,
                                                     light.center + light.half_u, radius})
                        : 0;
  }
  if (light.outline().empty()) {
    const Light disk = *light.flat();
    return ltc_share(ltc.matrix, Ellipse{disk.center, disk.half_u, disk.half_v});
  }
  // Seen from behind it turns the other way.
  return std::abs(
      LinearlyTransformed(ltc.matrix).integrate_polygon(clip_to_upper_hemisphere(light.corners())));
}

double ltc_radiance(const Table& table, const Lobe& lobe, double f0, const Light& light,
                    HorizonMode horizon) {
  const LookUp found = look_up(table, lobe);
  const double albedo = f0 * found.amplitude + (1 - f0) * found.fresnel;
  if (!found.matrix.allFinite() || found.matrix.determinant() == 0 || !std::isfinite(albedo))
    return std::numeric_limits<double>::quiet_NaN();
  const double share = horizon_factor(found.ltc(), horizon) * ltc_share(found.ltc(), light);
  return share > 0 ? albedo * share * fetched(found.matrix, light) : 0;
}

ReferenceIntegrator::ReferenceIntegrator(std::size_t samples, Technique technique)
    : technique_(technique), lattice_(samples) {}

double ReferenceIntegrator::radiance(const Lobe& lobe, double f0, const Light& light,
                                     const Shifts& shifts) const {
  const std::optional<Light> flat = is_seen(light) ? light.flat() : std::nullopt;
  if (!flat)
    return 0;
  const Integrand integrand(lobe, f0, *flat);
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
