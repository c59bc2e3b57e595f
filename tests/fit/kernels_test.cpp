// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The vector kernels against plain double arithmetic, for every vector unit of this CPU.
//
// Unit of the bounds: single precision's epsilon, 6e-8 (half a unit in the last place of one).
#include "fit/kernels.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include "brdf/ggx.h"
#include "fit/lobes.h"
#include "fit/starting_points.h"
#include "statistics.h"

namespace ltc {
namespace {

constexpr double kEpsilon = 0x1p-24;
constexpr std::size_t row_width = kernels::row_width;

// Runs the test on one vector unit after the other, and restores the best one.
class EveryTarget {
 public:
  ~EveryTarget() { hwy::SetSupportedTargetsForTest(0); }
  template <typename Test>
  void run(Test&& test) {
    hwy::SetSupportedTargetsForTest(0);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      SCOPED_TRACE(hwy::TargetName(target));
      test();
    }
  }
};

AlignedFloats random_floats(std::size_t count, std::uint64_t seed, double low, double high) {
  test::Uniform uniform(seed);
  AlignedFloats values(count);
  for (float& value : values)
    value = static_cast<float>(low + (high - low) * uniform());
  return values;
}

struct Transformed {
  explicit Transformed(std::size_t count)
      : gx(count), gy(count), gz(count), rows(count * row_width) {}
  AlignedFloats gx, gy, gz, rows;
};

Transformed transform(const float* p, const Lobe& lobe, const CosineSet& cosines) {
  Transformed result(cosines.size());
  kernels::transform_samples(
      {p, static_cast<float>(lobe.alpha_x), static_cast<float>(lobe.alpha_y)},
      {cosines.x.data(), cosines.y.data(), cosines.z.data(), cosines.size()},
      {result.gx.data(), result.gy.data(), result.gz.data(), result.rows.data()});
  return result;
}

// Offset of a direction's image from e_z in double, without cancellation.
Eigen::Vector3d offset_from_z(const Eigen::Vector3d& f) {
  const double length = f.norm(), lateral = f.x() * f.x() + f.y() * f.y();
  return {f.x() / length, f.y() / length,
          f.z() > 0 ? -lateral / (length * (length + f.z())) : f.z() / length - 1};
}

TEST(Kernels, TransformSamplesAgreesWithDouble) {
  const CosineSet cosines = make_cosine_set(1024);
  double worst_offset = 0, worst_row = 0;
  EveryTarget().run([&] {
    for (const Lobe& lobe : test::all_lobes()) {
      const LobeFrame frame(lobe);
      float p[9];
      Eigen::Matrix3d rounded;
      for (int i = 0; i < 9; ++i)
        rounded(i / 3, i % 3) = p[i] = static_cast<float>(frame.first_order(i / 3, i % 3));
      const Eigen::Matrix3d m = rounded * Eigen::Vector3d(static_cast<float>(lobe.alpha_x),
                                                          static_cast<float>(lobe.alpha_y), 1)
                                              .asDiagonal();
      const Transformed result = transform(p, lobe, cosines);
      for (std::size_t i = 0; i < cosines.size(); ++i) {
        const Eigen::Vector3d omega(cosines.x[i], cosines.y[i], cosines.z[i]);
        const Eigen::Vector3d f = m * omega, expected = offset_from_z(f);
        const Eigen::Vector3d g(result.gx[i], result.gy[i], result.gz[i]);
        // Sums of three products may cancel, so errors count in terms of the addends.
        const Eigen::Vector3d addends = (m.cwiseAbs() * omega.cwiseAbs()) / f.norm();
        const double lateral = addends.head<2>().maxCoeff();
        const double error = (g - expected).head<2>().cwiseAbs().maxCoeff() / lateral;
        worst_offset = std::max(worst_offset, error / kEpsilon);
        // The offset along z is lateral^2 large, and as exact in proportion.
        worst_offset =
            std::max(worst_offset, std::abs(g.z() - expected.z()) /
                                       std::max(lateral * lateral, -expected.z()) / kEpsilon);
        const Eigen::Vector3d a =
            Eigen::Vector3d(static_cast<float>(lobe.alpha_x) * omega.x(),
                            static_cast<float>(lobe.alpha_y) * omega.y(), omega.z()) /
            f.norm();
        const float* row = result.rows.data() + i * row_width;
        for (int c = 0; c < 3; ++c) {
          for (int r = 0; r < 3; ++r)
            worst_row = std::max(worst_row, std::abs(row[3 * r + c] - double(g[r]) * a[c]) /
                                                (std::abs(g[r] * a[c]) + 1e-30) / kEpsilon);
          worst_row = std::max(worst_row, std::abs(row[9 + c] - a[c]) / std::abs(a[c]) / kEpsilon);
          EXPECT_EQ(row[12 + c], row[9 + c]);
        }
        EXPECT_EQ(row[15], 1.0f);
      }
    }
  });
  // Measured: 4.9 and 4.6. Some ten roundings, of products, sums, a root and a quotient, in a row.
  EXPECT_LT(worst_offset, 16);
  EXPECT_LT(worst_row, 16);
}

TEST(Kernels, TransformSamplesKeepsDirectionsBehindTheMirrorPlane) {
  // f_z < 0 and f along -z, where the offset is -2 and nothing may divide by length + f_z = 0.
  const CosineSet cosines = make_cosine_set(64);
  const float p[9] = {0.5f, 0, 0, 0, 0.5f, 0, 0, 0, -1};
  EveryTarget().run([&] {
    const Transformed result = transform(p, {1, 1, 0, 0}, cosines);
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      const Eigen::Vector3d expected = offset_from_z(
          {0.5 * cosines.x[i], 0.5 * cosines.y[i], -static_cast<double>(cosines.z[i])});
      EXPECT_NEAR(result.gx[i], expected.x(), 8 * kEpsilon);
      EXPECT_NEAR(result.gz[i], expected.z(), 8 * kEpsilon);
    }
  });
}

// Places of bins against double arithmetic, for both spacings.
void check_project_and_bin(kernels::BinSpacing spacing) {
  constexpr std::size_t count = 4096, bins = 64;
  double worst = 0;
  std::size_t moved = 0, total = 0;
  EveryTarget().run([&] {
    for (const double width : {1.0, 1e-3, 1e-6}) {
      const AlignedFloats gx = random_floats(count, 1, -width, width);
      const AlignedFloats gy = random_floats(count, 2, -width, width);
      const AlignedFloats gz = random_floats(count, 3, -width * width, 0);
      for (const Eigen::Vector3d& direction : fibonacci_directions(8)) {
        const Eigen::Vector3f d = direction.cast<float>();
        const kernels::ProjectionMap map{
            d.x(),  d.y(), d.z(), static_cast<float>(0.1 * width), static_cast<float>(4 / width),
            spacing};
        AlignedFloats xi(count);
        AlignedVector<std::int32_t> bin(count);
        kernels::project_and_bin(map, {gx.data(), gy.data(), gz.data(), count}, bins, xi.data(),
                                 bin.data());
        for (std::size_t i = 0; i < count; ++i) {
          const double expected =
              double(d.x()) * gx[i] + double(d.y()) * gy[i] + double(d.z()) * gz[i];
          worst = std::max(worst, std::abs(xi[i] - expected) / width / kEpsilon);
          const double z = (expected - map.centre) * map.inverse_scale;
          double t = z / std::sqrt(1 + z * z);
          if (spacing == kernels::BinSpacing::graded)
            t = std::copysign(1 - std::sqrt(1 - std::abs(t)), t);
          const double place = (1 + t) / 2 * bins;
          ASSERT_GE(bin[i], 0);
          ASSERT_LT(bin[i], static_cast<std::int32_t>(bins));
          // A bin's edges are as exact as its place is: a sample on the edge may go either way.
          ASSERT_GT(bin[i] + 1 + 1e-4, place);
          ASSERT_LT(bin[i] - 1e-4, place);
          moved += bin[i] != static_cast<std::int32_t>(place);
          ++total;
        }
      }
    }
  });
  // Measured: 2.6, and no sample beside its bin. Three products and two sums.
  EXPECT_LT(worst, 4);
  EXPECT_LT(static_cast<double>(moved) / static_cast<double>(total), 1e-4);
}

TEST(Kernels, ProjectAndBinAgreesWithDouble) {
  check_project_and_bin(kernels::BinSpacing::even);
  check_project_and_bin(kernels::BinSpacing::graded);
}

// Where even bins have long put everything into the last one, graded ones still tell samples apart:
// z = 22 is the last edge of 64, beyond which lies a share of 1 - sqrt(1 - 1/32^2) = 1/2048.
TEST(Kernels, GradedBinsTellTailsApart) {
  constexpr std::size_t count = 16, bins = 64;
  AlignedFloats gx(count, 0.0f), gy(count, 0.0f), gz(count, 0.0f), xi(count);
  const std::array<float, 6> z = {8, -8, 12, -12, 23, -23};
  std::copy(z.begin(), z.end(), gx.begin());
  AlignedVector<std::int32_t> bin(count);
  const auto bins_of = [&](kernels::BinSpacing spacing) {
    kernels::project_and_bin({1, 0, 0, 0, 1, spacing}, {gx.data(), gy.data(), gz.data(), count},
                             bins, xi.data(), bin.data());
    return std::vector<std::int32_t>(bin.begin(), bin.begin() + z.size());
  };
  EveryTarget().run([&] {
    EXPECT_EQ(bins_of(kernels::BinSpacing::graded),
              (std::vector<std::int32_t>{61, 2, 62, 1, 63, 0}));
    EXPECT_EQ(bins_of(kernels::BinSpacing::even), (std::vector<std::int32_t>{63, 0, 63, 0, 63, 0}));
  });
}

TEST(Kernels, ProjectionsFarOutsideGoIntoTheOuterBins) {
  constexpr std::size_t count = 16, bins = 32;
  AlignedFloats gx(count, -2.0f), gy(count, 0.0f), gz(count, 0.0f), xi(count);
  std::fill_n(gx.begin(), 8, 2.0f);
  AlignedVector<std::int32_t> bin(count);
  EveryTarget().run([&] {
    // The narrowest scale that TargetQuantiles allows: z^2 = 4e30 must not overflow.
    kernels::project_and_bin({1, 0, 0, 0, 1e15f}, {gx.data(), gy.data(), gz.data(), count}, bins,
                             xi.data(), bin.data());
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(bin[i], i < 8 ? 31 : 0);
  });
}

// Rows along a group of directions, summed in double beside the kernel.
void check_accumulate_rows(std::size_t group) {
  constexpr std::size_t count = 1024, bins = 32;
  const std::vector<float> direction_z = {0.6f, -0.2f, 0.9f, -1.0f};
  const AlignedFloats xi = random_floats(group * count, 4, -0.5, 0.5);
  const AlignedFloats rows = random_floats(count * row_width, 5, -1, 1);
  AlignedVector<std::int32_t> bin(group * count);
  for (std::size_t i = 0; i < bin.size(); ++i)
    bin[i] = static_cast<std::int32_t>(i * i % bins);
  std::vector<double> expected(group * bins * row_width, 0.0), magnitude = expected;
  std::vector<std::int32_t> expected_populations(group * bins, 0);
  for (std::size_t i = 0; i < bin.size(); ++i) {
    const std::size_t sample = i % count, place = i / count * bins + bin[i];
    for (std::size_t c = 0; c < row_width; ++c) {
      const double factor = c < 9               ? double(xi[i]) + direction_z[i / count]
                            : c < 12 || c == 15 ? double(xi[i])
                                                : 1.0;
      const double addend = factor * rows[sample * row_width + c];
      expected[place * row_width + c] += addend;
      magnitude[place * row_width + c] += std::abs(addend);
    }
    ++expected_populations[place];
  }
  double worst = 0;
  EveryTarget().run([&] {
    AlignedFloats sums(group * bins * row_width, 0.0f);
    AlignedVector<std::int32_t> populations(group * bins, 0);
    kernels::accumulate_rows({xi.data(), bin.data(), count, bins}, rows.data(), direction_z.data(),
                             group, {sums.data(), populations.data()});
    for (std::size_t j = 0; j < sums.size(); ++j)
      if (magnitude[j] > 0)
        worst = std::max(worst, std::abs(sums[j] - expected[j]) / magnitude[j] / kEpsilon);
    EXPECT_TRUE(std::equal(populations.begin(), populations.end(), expected_populations.begin()));
  });
  // Measured: 1.1, for 64 addends a bin whose roundings mostly cancel.
  EXPECT_LT(worst, 16);
  EXPECT_GT(worst, 0);  // the kernel adds in single precision, so something must differ
}

TEST(Kernels, AccumulateRowsAgreesWithDouble) {
  for (std::size_t group = 1; group <= kernels::directions_at_once; ++group) {
    SCOPED_TRACE(group);
    check_accumulate_rows(group);
  }
}

TEST(Kernels, AccumulateWeightsAgreesWithDouble) {
  constexpr std::size_t count = 4096, bins = 64;
  const AlignedFloats xi = random_floats(count, 6, -1, 1), weights = random_floats(count, 7, 0, 1);
  AlignedVector<std::int32_t> bin(count);
  std::vector<double> expected(2 * bins, 0.0), magnitude(2 * bins, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    bin[i] = static_cast<std::int32_t>(i * 7 % bins);
    expected[2 * bin[i]] += weights[i];
    expected[2 * bin[i] + 1] += double(weights[i]) * xi[i];
    magnitude[2 * bin[i]] += weights[i];
    magnitude[2 * bin[i] + 1] += std::abs(double(weights[i]) * xi[i]);
  }
  double worst = 0;
  EveryTarget().run([&] {
    AlignedFloats sums(2 * bins, 0.0f);
    AlignedFloats scratch(2 * count);
    kernels::accumulate_weights(xi.data(), bin.data(), weights.data(), count, scratch.data(),
                                sums.data());
    for (std::size_t j = 0; j < sums.size(); ++j)
      worst = std::max(worst, std::abs(sums[j] - expected[j]) / magnitude[j] / kEpsilon);
  });
  // Measured: 5.4, for 64 addends of one sign.
  EXPECT_LT(worst, 16);
}

// A target whose quantile function is piecewise linear, cut into cells as kernels.h says, and the
// plain evaluation of its integral.
struct PlantedTarget {
  static constexpr std::size_t bins = 32;
  std::vector<double> mass{0.0}, quantile{-1.0};
  AlignedFloats mass_f, moment, inverse_width, c1, c2, c3;
  AlignedVector<std::int32_t> first_cell;
  // Added to the integral over the outer cells, and taken from what lies beyond the last one.
  static constexpr float first_tail = -0.02f, last_tail = 0.03f;

  PlantedTarget() {
    const AlignedFloats widths = random_floats(bins, 21, 0.2f, 1.8f);
    const double total = std::accumulate(widths.begin(), widths.end(), 0.0);
    double sum = 0;
    for (std::size_t j = 0; j < bins; ++j) {
      const double width = widths[j] / total;
      mass.push_back(mass.back() + width);
      quantile.push_back(quantile.back() + 2.0 / bins);
      const double rise = width * (quantile[j] + quantile[j + 1]) / 2;
      moment.push_back(static_cast<float>(sum + (j > 0 ? first_tail : 0)));
      inverse_width.push_back(static_cast<float>(1 / width));
      c1.push_back(static_cast<float>(width * quantile[j]));
      c2.push_back(static_cast<float>(rise - width * quantile[j]));
      c3.push_back(0.0f);
      sum += rise;
    }
    mass_f.assign(mass.begin(), mass.end());
    mass_f[bins] = 1.0f;
    for (std::size_t i = 0; i < bins; ++i) {
      std::int32_t cell = 0;
      while (mass_f[cell + 1] < static_cast<float>(i) / bins)
        ++cell;
      first_cell.push_back(cell);
    }
  }

  kernels::TargetCells cells() const {
    return {mass_f.data(), first_cell.data(), moment.data(), inverse_width.data(),
            c1.data(),     c2.data(),         c3.data(),     first_tail,
            last_tail};
  }

  double integral(double u) const {
    double sum = 0;
    for (std::size_t j = 0; j < bins && mass[j] < u; ++j) {
      const double width = mass[j + 1] - mass[j];
      const double s = std::min((u - mass[j]) / width, 1.0);
      sum += width * s * (quantile[j] + s * (quantile[j + 1] - quantile[j]) / 2);
      if (j == 0)
        sum += first_tail * std::sqrt(s);
      if (j + 1 == bins)
        sum += last_tail * (1 - std::sqrt(1 - s));
    }
    return sum;
  }
};

TEST(Kernels, ReduceDirectionAgreesWithDouble) {
  constexpr std::size_t bins = PlantedTarget::bins;
  constexpr float smoothing = 0.05f;
  const PlantedTarget target;
  const kernels::ProjectionMap map{0.6f, -0.48f, 0.64f, 0.0f, 1.0f};
  AlignedFloats sums = random_floats(bins * row_width, 22, -4, 4);
  AlignedVector<std::int32_t> populations(bins);
  std::size_t count = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    populations[b] = b % 5 == 3 ? 0 : static_cast<std::int32_t>(4 + b);  // some are empty
    if (populations[b] == 0)
      std::fill_n(sums.begin() + b * row_width, row_width, 0.0f);
    count += static_cast<std::size_t>(populations[b]);
  }

  double loss = 0, loss_magnitude = 0;
  std::array<double, 9> gradient{}, gradient_magnitude{};
  Matrix9 hessian = Matrix9::Zero(), hessian_magnitude = Matrix9::Zero();
  std::size_t below = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    if (populations[b] == 0)
      continue;
    const double n = populations[b];
    const double lower = target.integral(static_cast<double>(below) / count);
    below += static_cast<std::size_t>(populations[b]);
    const double upper = target.integral(static_cast<double>(below) / count);
    const float* sum = sums.data() + b * row_width;
    const double residual = (sum[15] - (upper - lower) * count) / n;
    const double weight = 1 / (std::abs(residual) + smoothing);
    loss += std::abs(residual) * n;
    loss_magnitude += std::abs(residual) * n + std::abs(double(sum[15]));
    std::array<double, 9> j{};
    for (int c = 0; c < 3; ++c) {
      j[c] = double(map.direction_x) * sum[12 + c] - sum[c];
      j[3 + c] = double(map.direction_y) * sum[12 + c] - sum[3 + c];
      j[6 + c] = -double(sum[9 + c]) - sum[6 + c];
    }
    for (int row = 0; row < 9; ++row) {
      gradient[row] += residual * weight * j[row];
      gradient_magnitude[row] += std::abs(j[row]);
      for (int column = 0; column < 9; ++column) {
        hessian(row, column) += weight / n * j[row] * j[column];
        hessian_magnitude(row, column) += weight / n * std::abs(j[row] * j[column]);
      }
    }
  }

  double worst = 0;
  EveryTarget().run([&] {
    alignas(vector_alignment) float gradient_f[row_width] = {};
    alignas(vector_alignment) float hessian_f[9 * row_width] = {};
    AlignedFloats scratch((4 + row_width) * bins);
    kernels::DirectionSums result{gradient_f, hessian_f, 0};
    kernels::reduce_direction({map, sums.data(), populations.data(), bins, count}, target.cells(),
                              smoothing, scratch.data(), result);
    worst = std::max(worst, std::abs(result.loss - loss) / loss_magnitude / kEpsilon);
    for (int row = 0; row < 9; ++row) {
      worst = std::max(
          worst, std::abs(gradient_f[row] - gradient[row]) / gradient_magnitude[row] / kEpsilon);
      for (int column = 0; column < 9; ++column)
        worst =
            std::max(worst, std::abs(hessian_f[row * row_width + column] - hessian(row, column)) /
                                hessian_magnitude(row, column) / kEpsilon);
    }
  });
  // The difference of two integrals of order 1 over a bin that holds 1/100 of the mass loses two
  // digits of the residual, 1 % of whose scale the smoothing is.
  EXPECT_LT(worst, 500);
  RecordProperty("worst_in_half_ulps", std::to_string(worst));
}

TEST(Kernels, SampleTargetAgreesWithTheSamplerInDouble) {
  for (const std::size_t count : {1024u, 65536u}) {
    const TargetLattice lattice = make_target_lattice(count, 0.3);
    EveryTarget().run([&] {
      for (const Lobe& lobe : test::all_lobes()) {
        const LobeFrame frame(lobe);
        const GgxSampler sampler(lobe);
        TargetSamples samples;
        sample_weighted_target(frame, lattice, samples);
        std::vector<LobeSample> expected;
        double mean_offset = 0;
        for (std::size_t i = 0; i < lattice.size(); ++i) {
          expected.push_back(sampler.reflect(sampler.visible_normal(
              lattice.cos_azimuth[i], lattice.sin_azimuth[i], lattice.height[i])));
          mean_offset += expected.back().offset.norm() / static_cast<double>(lattice.size());
        }
        double worst_offset = 0, worst_weight = 0, mean_error = 0, mean_weight_error = 0;
        for (std::size_t i = 0; i < lattice.size(); ++i) {
          const Eigen::Vector3d g = frame.rotation.transpose() * expected[i].offset;
          const Eigen::Vector3d error(samples.gx[i] - g.x(), samples.gy[i] - g.y(),
                                      samples.gz[i] - g.z());
          worst_offset = std::max(worst_offset, error.norm() / (mean_offset + g.norm()));
          const double weight_error = std::abs(samples.weight[i] - expected[i].weight);
          worst_weight = std::max(worst_weight, weight_error);
          mean_error += error.norm() / mean_offset / static_cast<double>(lattice.size());
          mean_weight_error += weight_error / static_cast<double>(lattice.size());
        }
        // Relative to the lobe. Means measured: 8e-7 and 5e-7. At the rim of the cap c + s and
        // v . h vanish together, so that single samples of the tail, which count next to nothing,
        // lose digits: 2e-4 and 5.8e-3 measured among 65,536.
        EXPECT_LT(mean_error, 2e-6) << test::describe(lobe);
        EXPECT_LT(mean_weight_error, 1e-6) << test::describe(lobe);
        EXPECT_LT(worst_offset, 1e-3) << test::describe(lobe);
        EXPECT_LT(worst_weight, 1e-2) << test::describe(lobe);
      }
    });
  }
}

}  // namespace
}  // namespace ltc
