// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/lobe_model.h"

#include <fmt/format.h>

#include "brdf/beckmann.h"
#include "brdf/charlie.h"
#include "brdf/ggx.h"
#include "brdf/measured.h"
#include "core/error.h"

namespace ltc {
namespace {

std::vector<const LobeModel*>& models() {
  static std::vector<const LobeModel*> all = {&ggx(), &beckmann(),
                                              &charlie(SheenVisibility::charlie),
                                              &charlie(SheenVisibility::ashikhmin)};
  return all;
}

}  // namespace

const LobeModel& lobe_model(std::string_view name) {
  for (const LobeModel* model : models())
    if (model->name() == name)
      return *model;
  if (names_brdf_file(name))
    return measured(name);
  std::string names;
  for (const LobeModel* model : models())
    names += (names.empty() ? "" : ", ") + std::string(model->name());
  throw InputError(
      fmt::format("BRDF \"{}\"; expected one of: {}, or a file of values (.h5)", name, names));
}

const std::vector<const LobeModel*>& lobe_models() {
  return models();
}

void add_lobe_model(const LobeModel& model) {
  models().push_back(&model);
}

void TargetSamples::reserve(std::size_t count) {
  size = count;
  for (AlignedFloats* array : {&gx, &gy, &gz, &weight})
    if (array->size() < count)
      array->resize(count);
}

void LobeSampler::sample_all(const SampleLattice& lattice, WeightedSamples& samples) const {
  fill(lattice, samples, [&](double c, double s, double u) { return sample(c, s, u); });
}

void LobeModel::sample_target(const Lobe& lobe, const Eigen::Matrix3d& rotation,
                              const TargetLattice& lattice, TargetSamples& samples) const {
  const std::unique_ptr<LobeSampler> from = sampler(lobe);
  const double scale = 1 / from->most_weight();
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const LobeSample found =
        from->sample(lattice.cos_azimuth[i], lattice.sin_azimuth[i], lattice.height[i]);
    const Eigen::Vector3f offset = (rotation.transpose() * found.offset).cast<float>();
    samples.gx[i] = offset.x();
    samples.gy[i] = offset.y();
    samples.gz[i] = offset.z();
    samples.weight[i] = static_cast<float>(found.weight * scale);
  }
}

Albedo LobeModel::albedo(const Lobe& lobe, const AlbedoRule& rule) const {
  const std::unique_ptr<LobeSampler> from = sampler(lobe);
  Albedo sum;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    const LobeSample found = from->sample(rule.cos_azimuth[i], rule.sin_azimuth[i], rule.height[i]);
    const double share = static_cast<double>(rule.weight[i]) * found.weight;
    sum.amplitude += share;
    sum.fresnel += share * std::pow(1 - found.v_dot_h, 5);
  }
  return sum;
}

Eigen::Matrix3d LobeModel::frame(const Lobe& lobe) const {
  return mirror_rotation(lobe.omega_v());
}

Eigen::Vector3d LobeModel::widths(const Lobe& lobe) const {
  return {lobe.alpha_x, lobe.alpha_y, 1};
}

// Reflecting about the normal of slopes (p, q), to first order: l = m + p (2vz, 0, 2vx) + q (0,
// 2vz, 2vy).
Eigen::Matrix3d LobeModel::first_order(const Lobe& lobe) const {
  const Eigen::Vector3d v = lobe.omega_v();
  Eigen::Matrix3d matrix;
  matrix.col(0) << 2 * v.z(), 0, 2 * v.x();
  matrix.col(1) << 0, 2 * v.z(), 2 * v.y();
  matrix.col(2) = lobe.mirror();
  return matrix;
}

}  // namespace ltc
