// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/l3_error.h"

#include <cmath>
#include <limits>
#include <utility>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

// One direction's share of the estimate.
double share(double ltc_density, const L3Error::Densities& target) {
  const double sampling = ltc_density + target.sampling;
  if (!(sampling > 0))
    return 0;
  const double difference = std::abs(ltc_density - target.lobe);
  return difference * difference * difference / sampling;
}

}  // namespace

L3Error::L3Error(Target target, std::vector<Eigen::Vector3d> samples, const CosineSet& cosines)
    : target_(std::move(target)), cosines_(cosines) {
  samples_.reserve(samples.size());
  for (const Eigen::Vector3d& omega : samples)
    samples_.push_back({omega, target_(omega)});
}

double L3Error::operator()(const Eigen::Matrix3d& matrix) const try {
  const LinearlyTransformed ltc(matrix);
  double of_lobe = 0;
  for (const auto& [omega, densities] : samples_)
    of_lobe += share(ltc.density(omega), densities);
  double of_ltc = 0;
  for (std::size_t i = 0; i < cosines_.size(); ++i) {
    const Eigen::Vector3d omega =
        (matrix * Eigen::Vector3d(cosines_.x[i], cosines_.y[i], cosines_.z[i])).normalized();
    of_ltc += share(ltc.density(omega), target_(omega));
  }
  const double integral = of_lobe / static_cast<double>(samples_.size()) +
                          of_ltc / static_cast<double>(cosines_.size());
  return std::isfinite(integral) ? std::cbrt(integral) : std::numeric_limits<double>::infinity();
} catch (const InputError&) {
  return std::numeric_limits<double>::infinity();  // no distribution
}

L3Error lobe_l3_error(const Lobe& lobe, double amplitude, const TargetLattice& lattice,
                      const CosineSet& cosines) {
  const std::shared_ptr<const LobeSampler> sampler = lobe.model->sampler(lobe);
  std::vector<Eigen::Vector3d> samples;
  samples.reserve(lattice.size());
  for (std::size_t i = 0; i < lattice.size(); ++i)
    samples.push_back(
        sampler->sample(lattice.cos_azimuth[i], lattice.sin_azimuth[i], lattice.height[i]).omega_l);
  return L3Error(
      [sampler, amplitude](const Eigen::Vector3d& omega) {
        const LobeDensities densities = sampler->densities(omega);
        return L3Error::Densities{densities.brdf_cosine / amplitude, densities.sampling};
      },
      std::move(samples), cosines);
}

}  // namespace ltc
