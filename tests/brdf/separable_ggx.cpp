// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/separable_ggx.h"

#include "brdf/ggx.h"

namespace ltc::test {
namespace {

// G2 = G1(v) G1(l), so that samples by visible normals keep the weight G1(l).
class SeparableSampler final : public LobeSampler {
 public:
  explicit SeparableSampler(const Lobe& lobe)
      : LobeSampler(lobe.omega_v()), lobe_(lobe), ggx_(lobe) {}

  LobeDensities densities(const Eigen::Vector3d& omega_l) const override {
    const double sampling = ggx_.densities(omega_l).sampling;
    return {sampling * masking(omega_l), sampling};
  }
  using LobeSampler::sample;
  LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const override {
    LobeSample sample = ggx_.sample(cos_azimuth, sin_azimuth, u_height);
    sample.weight = masking(sample.omega_l);
    return sample;
  }

 private:
  double masking(const Eigen::Vector3d& omega_l) const {
    return omega_l.z() > 0 ? 1 / (1 + ggx_lambda(lobe_.alpha_x, lobe_.alpha_y, omega_l)) : 0;
  }

  Lobe lobe_;
  GgxSampler ggx_;
};

class SeparableGgx final : public LobeModel {
 public:
  std::string_view name() const override { return "separable-ggx"; }
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    return std::make_unique<SeparableSampler>(lobe);
  }
  bool heavy_tails() const override { return true; }
};

// The one line.
const bool added = (add_lobe_model(separable_ggx()), true);

}  // namespace

const LobeModel& separable_ggx() {
  static const SeparableGgx model;
  return model;
}

}  // namespace ltc::test
