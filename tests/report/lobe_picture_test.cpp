// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "report/lobe_picture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "fit/lobes.h"
#include "fit/starting_points.h"
#include "ltc/ltsd.h"

namespace ltc {
namespace {

constexpr std::size_t side = 128;

// Of one of a window's pixels: the projection keeps areas.
double pixel_solid_angle(const LobeWindow& window, std::size_t pixels) {
  const double step = 2 * window.half_width / static_cast<double>(pixels);
  return step * step;
}

double integral(const picture::Field& field, const LobeWindow& window) {
  double sum = 0;
  for (const float value : field.values)
    if (!std::isnan(value))
      sum += value;
  return sum * pixel_solid_angle(window, field.width);
}

Eigen::Matrix3d first_order_matrix(const Lobe& lobe) {
  const LobeFrame frame(lobe);
  return frame.to_matrix(first_order_start(frame));
}

// The share of a lobe's weighted samples that a window contains; fresh random numbers.
double ggx_share(const Lobe& lobe, const LobeWindow& window) {
  const GgxSampler sampler(lobe);
  Random random(7);
  double inside = 0, all = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = random.uniform();
    const LobeSample sample = sampler.sample(u, random.uniform());
    all += sample.weight;
    inside += sample.weight * window.contains(sample.omega_l);
  }
  return inside / all;
}

double ltc_share(const Eigen::Matrix3d& matrix, const LobeWindow& window) {
  const LinearlyTransformed ltc(matrix);
  Random random(8);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double u = random.uniform();
    inside += window.contains(ltc.sample(u, random.uniform()));
  }
  return inside / 20000.0;
}

TEST(LobePicture, ProjectionKeepsAnglesAndAreas) {
  const LobeWindow window = hemisphere_window();
  for (const double angle : {0.0, 1e-5, 0.3, 1.0, std::numbers::pi / 2}) {
    const Eigen::Vector2d at = window.project({0, std::sin(angle), std::cos(angle)});
    EXPECT_NEAR(at.x(), 0, 1e-15);
    EXPECT_NEAR(at.y(), 2 * std::sin(angle / 2), 1e-14) << angle;
  }
  // The disc of the hemisphere in its square: pi 2 of 8, its solid angle 2 pi.
  EXPECT_NEAR(pixel_solid_angle(window, side) * side * side * std::numbers::pi / 4,
              2 * std::numbers::pi, 1e-12);
}

TEST(LobePicture, DensitiesIntegrateToOneOverTheHemisphere) {
  // Lobes that a picture resolves, and ridges of a fiftieth of a pixel and less.
  for (const Lobe& lobe : {Lobe{1, 1, 0, 0}, Lobe{0.6, 0.4, 0.5, 0.3}, Lobe{0.43, 1e-4, 0.8, 0.9},
                           Lobe{0.43, 1e-4, 1.5, 0.9}, Lobe{1e-3, 1e-3, 0.8, 0.9}}) {
    const LobeWindow window = hemisphere_window();
    // Pixels at the rim count in full or not at all; at most 2 % of the pixels, where lobes are
    // dim. Within a pixel four points, or 2^20 samples: together 1 %.
    EXPECT_NEAR(integral(lobe_density(lobe, window, side), window), 1, 0.02)
        << test::describe(lobe);
    const Eigen::Matrix3d matrix = first_order_matrix(lobe);
    // An LTC may lie below the horizon in part.
    EXPECT_NEAR(integral(ltc_density({matrix}, lobe, window, side), window),
                ltc_share(matrix, window), 0.02)
        << test::describe(lobe);
  }
}

TEST(LobePicture, DensitiesOfAZoomedWindowIntegrateToItsShare) {
  for (const Lobe& lobe : {Lobe{0.05, 0.005, 1, 0.5}, Lobe{1e-4, 1e-4, 0.7, 0.3},
                           Lobe{1e-6, 1e-6, 0.3, 1}, Lobe{0.02, 1e-6, 0.8, 0.5}}) {
    const Eigen::Matrix3d matrix = first_order_matrix(lobe);
    const LobeWindow window = choose_window(lobe, matrix);
    ASSERT_FALSE(window.hemisphere) << test::describe(lobe);
    // 20,000 random samples: a standard error of 0.2 %; the picture's own error 1 %.
    EXPECT_NEAR(integral(lobe_density(lobe, window, side), window), ggx_share(lobe, window), 0.02)
        << test::describe(lobe);
    EXPECT_NEAR(integral(ltc_density({matrix}, lobe, window, side), window),
                ltc_share(matrix, window), 0.02)
        << test::describe(lobe);
  }
}

TEST(LobePicture, DensityOfAPixelIsThatOfItsMiddleWhereTheLobeIsSmooth) {
  const Lobe lobe{0.6, 0.4, 0.5, 0.3};
  const Eigen::Matrix3d matrix = first_order_matrix(lobe);
  const LinearlyTransformed ltc(matrix);
  const picture::Field field = ltc_density({matrix}, lobe, hemisphere_window(), side);
  // A pixel right of the middle and one above: x to the right, y up.
  const double step = 2 * std::numbers::sqrt2 / side;
  const auto direction = [](double x, double y) {
    const double r2 = x * x + y * y;
    return Eigen::Vector3d(x * std::sqrt(1 - r2 / 4), y * std::sqrt(1 - r2 / 4), 1 - r2 / 2);
  };
  const double right = ltc.density(direction(20.5 * step, 0.5 * step));
  const double up = ltc.density(direction(0.5 * step, 20.5 * step));
  ASSERT_GT(std::abs(right / up - 1), 0.05);
  // The second derivative over a pixel of 0.02 radians: 1e-3 and less.
  EXPECT_NEAR(field.at(side / 2 - 1, side / 2 + 20) / right, 1, 2e-3);
  EXPECT_NEAR(field.at(side / 2 - 21, side / 2) / up, 1, 2e-3);
}

TEST(LobePicture, WindowHoldsBothLobes) {
  for (const Lobe& lobe : test::all_lobes()) {
    const Eigen::Matrix3d matrix = first_order_matrix(lobe);
    const LobeWindow window = choose_window(lobe, matrix);
    // At most 8 % outside by construction; sampling leaves 2 % to spare.
    EXPECT_GE(ggx_share(lobe, window), 0.9) << test::describe(lobe);
    // Over the hemisphere, what the LTC has below the horizon is not shown.
    if (!window.hemisphere) {
      EXPECT_GE(ltc_share(matrix, window), 0.9) << test::describe(lobe);
    }
  }
}

TEST(LobePicture, WindowZoomsInOnSmallLobesAndNotOnBroadOnes) {
  const auto window_of = [](const Lobe& lobe) {
    return choose_window(lobe, first_order_matrix(lobe));
  };
  EXPECT_TRUE(window_of({0.5, 0.5, 0.5, 0.3}).hemisphere);
  EXPECT_TRUE(window_of({0.43, 1e-4, 1.5, 0.9}).hemisphere);
  // GGX slopes have 95 % of their marginal within three roughnesses; half the window is a few.
  const LobeWindow sharp = window_of({1e-4, 1e-4, 0.7, 0.3});
  EXPECT_FALSE(sharp.hemisphere);
  EXPECT_GT(sharp.half_width, 3e-4);
  EXPECT_LT(sharp.half_width, 3e-3);
}

TEST(LobePicture, WindowFollowsAMisplacedLtc) {
  const Lobe lobe{0.01, 0.01, 0.5, 0};
  const Eigen::Matrix3d right = first_order_matrix(lobe);
  const Eigen::Matrix3d wrong = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()) * right;
  EXPECT_GE(ltc_share(wrong, choose_window(lobe, wrong)), 0.9);
  EXPECT_LT(ltc_share(wrong, choose_window(lobe, right)), 0.1);
}

TEST(LobePicture, ScaleIsLogarithmicForSharpLobes) {
  const auto kind_of = [](const Lobe& lobe, const LobeWindow& window) {
    const picture::Field ggx = lobe_density(lobe, window, side);
    return density_scale(ggx, std::array{ggx}).kind();
  };
  const LobeWindow hemisphere = hemisphere_window();
  EXPECT_EQ(kind_of({1, 1, 0, 0}, hemisphere), picture::ScaleKind::linear);
  EXPECT_EQ(kind_of({0.6, 0.4, 0.5, 0.3}, hemisphere), picture::ScaleKind::linear);
  EXPECT_EQ(kind_of({0.43, 1e-4, 1.5, 0.9}, hemisphere), picture::ScaleKind::logarithmic);
  EXPECT_EQ(kind_of({0.05, 0.05, 0.5, 0.3}, hemisphere), picture::ScaleKind::logarithmic);
}

TEST(LobePicture, ScaleHoldsThePeaksOfBoth) {
  const picture::Field low{2, 1, {0.5f, 1.0f}}, high{2, 1, {0.5f, 3.0f}};
  EXPECT_FLOAT_EQ(static_cast<float>(density_scale(low, std::array{high}).last()), 3);
  EXPECT_FLOAT_EQ(static_cast<float>(density_scale(high, std::array{low}).last()), 3);
}

TEST(LobePicture, WithoutAMatrixTheLtcIsMissing) {
  const Lobe lobe{0.3, 0.2, 0.5, 0.3};
  const Eigen::Matrix3d none = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Eigen::Matrix3d& matrix : {none, Eigen::Matrix3d::Zero().eval()}) {
    const picture::PanelRow row = lobe_panels(lobe, matrix, {}, 32);
    ASSERT_EQ(row.panels.size(), 3u);
    for (std::size_t i = 0; i < row.panels[0].field.values.size(); ++i) {
      EXPECT_TRUE(std::isnan(row.panels[1].field.values[i]));
      EXPECT_TRUE(std::isnan(row.panels[2].field.values[i]));
    }
    EXPECT_GT(integral(row.panels[0].field, choose_window(lobe, matrix)), 0.9);
  }
}

TEST(LobePicture, AFoldedLobeStandsBesideTheLtc) {
  const Lobe lobe{0.5, 0.3, 0.6, 0.4};
  const Eigen::Matrix3d matrix = first_order_matrix(lobe);
  const LtcLobe bent{matrix, {-0.8, 0.2}, usual_creases};
  const picture::PanelRow row =
      lobe_panels(lobe, {{"LTC", {matrix}}, {"folded LTC", bent}}, {}, 64);
  ASSERT_EQ(row.panels.size(), 4u);
  EXPECT_EQ(row.panels[2].title, "folded LTC");
  EXPECT_EQ(row.panels[3].title, "folded LTC − GGX");
  // A density: what of it is above the horizon, to a hundredth.
  const LobeWindow window = hemisphere_window();
  EXPECT_NEAR(integral(ltc_density(bent, lobe, window, 128), window),
              1 - share_below_horizon({matrix, bent.fold, bent.creases}), 0.01);
  // Where it is the LTC's, so is its picture, but for rounding.
  const picture::Field straight = ltc_density({matrix, {}, usual_creases}, lobe, window, 32);
  const picture::Field plain = ltc_density({matrix}, lobe, window, 32);
  double difference = 0, bend = 0;
  for (std::size_t i = 0; i < plain.values.size(); ++i)
    if (!std::isnan(plain.values[i]))
      difference =
          std::max(difference, std::abs(static_cast<double>(straight.values[i]) - plain.values[i]));
  for (std::size_t i = 0; i < row.panels[1].field.values.size(); ++i)
    if (!std::isnan(row.panels[1].field.values[i]))
      bend = std::max(bend, std::abs(static_cast<double>(row.panels[2].field.values[i]) -
                                     row.panels[1].field.values[i]));
  EXPECT_LT(difference, 1e-5);
  EXPECT_GT(bend, 0.1);
}

TEST(LobePicture, DifferenceIsThatOfThePanels) {
  const Lobe lobe{0.3, 0.2, 0.5, 0.3};
  const picture::PanelRow row = lobe_panels(lobe, first_order_matrix(lobe), {"title"}, 32);
  EXPECT_EQ(row.words.title, "title");
  EXPECT_EQ(row.panels[0].scale, row.panels[1].scale);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < row.panels[0].field.values.size(); ++i)
    if (!std::isnan(row.panels[0].field.values[i])) {
      EXPECT_EQ(row.panels[2].field.values[i],
                row.panels[1].field.values[i] - row.panels[0].field.values[i]);
      ++compared;
    }
  EXPECT_GT(compared, 500u);
}

}  // namespace
}  // namespace ltc
