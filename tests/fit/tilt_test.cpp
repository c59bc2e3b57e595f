// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a bound of the horizon's tilt is for: lobes of sheen seen from above.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "brdf/charlie.h"
#include "fit/solver.h"
#include "judge/area_light.h"

namespace ltc {
namespace {

// Charlie without the bound.
class FreeSheen final : public LobeModel {
 public:
  std::string_view name() const override { return "free"; }
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    return sheen_.sampler(lobe);
  }
  Eigen::Matrix3d frame(const Lobe& lobe) const override { return sheen_.frame(lobe); }
  Eigen::Vector3d widths(const Lobe& lobe) const override { return sheen_.widths(lobe); }
  Eigen::Matrix3d first_order(const Lobe& lobe) const override { return sheen_.first_order(lobe); }
  bool about_mirror() const override { return false; }

 private:
  const LobeModel& sheen_ = charlie(SheenVisibility::charlie);
};

struct Fitted {
  double tilt, error;
};
Fitted fitted(const Lobe& lobe) {
  FitSettings settings;
  const FitWorkspacePointer workspace = make_fit_workspace();
  FitRequest request;
  request.lobe = lobe;
  const Eigen::Matrix3d m = make_solver(settings)->fit(request, *workspace, nullptr).matrix;
  AreaLightJudge judge;
  judge.set_lobe(lobe);
  return {std::hypot(m(2, 0), m(2, 1)) / std::abs(m(2, 2)), judge.error(LtcLobe(m)).mean_absolute};
}

TEST(Tilt, OfSheenIsBoundAndHalvesTheErrorOfLights) {
  const FreeSheen free;
  const LobeModel& sheen = charlie(SheenVisibility::charlie);
  for (const double degrees : {20.0, 55.0}) {
    Lobe lobe{0.0121, 0.0121, degrees * std::numbers::pi / 180, 0, &sheen};
    const Fitted bound = fitted(lobe);
    lobe.model = &free;
    const Fitted unbound = fitted(lobe);
    // What there is room for is taken.
    EXPECT_NEAR(bound.tilt, sheen.most_tilt(), 1e-6) << degrees;
    EXPECT_GT(unbound.tilt, 2 * sheen.most_tilt()) << degrees;
    EXPECT_LT(bound.error, 0.65 * unbound.error) << degrees;
  }
  // Turned as the view is.
  Lobe turned{0.0121, 0.0121, 1, 0.7, &sheen};
  EXPECT_LT(fitted(turned).tilt, sheen.most_tilt() + 1e-6);
}

TEST(Tilt, OfLobesThatLieOtherwiseIsWhatItWas) {
  const FreeSheen free;
  Lobe lobe{0.3, 0.3, 1.4, 0, &charlie(SheenVisibility::charlie)};
  const Fitted bound = fitted(lobe);
  EXPECT_LT(bound.tilt, 0.19);
  lobe.model = &free;
  // From another start, which the bound limits: to what descents leave of the last gains.
  EXPECT_NEAR(fitted(lobe).tilt, bound.tilt, 2e-3);
  EXPECT_NEAR(fitted(lobe).error / bound.error, 1, 0.02);
}

}  // namespace
}  // namespace ltc
