// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// BRDFs from files of values: GGX written to one is GGX again, and what is wrong with a file is
// said.
#include "brdf/measured.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "brdf/albedo.h"
#include "brdf/ggx.h"
#include "brdf/measured_file.h"
#include "config/config.h"
#include "core/error.h"
#include "core/hdf5_file.h"
#include "judge/held_out.h"
#include "pipeline/generate.h"
#include "statistics.h"
#include "support/refusal.h"
#include "support/temporary_directory.h"

namespace ltc {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> evenly(double first, double last, std::size_t count) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i < count; ++i)
    nodes.push_back(first + (last - first) * static_cast<double>(i) /
                                static_cast<double>(std::max<std::size_t>(count - 1, 1)));
  return nodes;
}

// The BRDF of GGX on a grid; `weighted` by the light's cosine if asked for.
MeasuredBrdf sampled_ggx(MeasuredBrdf brdf, bool weighted = false) {
  for (const double alpha : brdf.alpha)
    for (const double lambda : brdf.lambda)
      for (const double theta : brdf.theta)
        for (const double phi : brdf.phi) {
          const GgxSampler sampler({alpha, alpha * lambda, theta, phi});
          for (const double elevation : brdf.theta_light)
            for (const double azimuth : brdf.phi_light) {
              // Just above the horizon, where there is a BRDF.
              const double t = std::min(elevation, kPi / 2 - 1e-6);
              const Eigen::Vector3d l(std::sin(t) * std::cos(azimuth),
                                      std::sin(t) * std::sin(azimuth), std::cos(t));
              brdf.values.push_back(
                  static_cast<float>(sampler.brdf_cosine(l) / (weighted ? 1 : std::cos(t))));
            }
        }
  return brdf;
}

MeasuredBrdf isotropic() {
  MeasuredBrdf brdf;
  brdf.alpha = evenly(0.4, 1, 4);
  brdf.lambda = {1};
  brdf.theta = evenly(0, 1.5, 16);
  brdf.phi = {0};
  brdf.theta_light = evenly(0, kPi / 2, 64);
  brdf.phi_light = evenly(0, kPi, 64);
  return brdf;
}
MeasuredBrdf anisotropic() {
  MeasuredBrdf brdf;
  brdf.alpha = {0.5, 0.8};
  brdf.lambda = {0.5, 1};
  brdf.theta = evenly(0, 1.2, 7);
  brdf.phi = evenly(0, kPi / 2, 7);
  brdf.theta_light = evenly(0, kPi / 2, 48);
  brdf.phi_light = evenly(0, 2 * kPi * 95 / 96, 96);
  return brdf;
}

void write(const MeasuredBrdf& brdf, const std::filesystem::path& path,
           const std::string& quantity = "brdf") {
  Hdf5Output file(path.string());
  file.text("/", "format", "ltc-brdf");
  file.number<std::int32_t>("/", "format_version", 1);
  file.text("/", "quantity", quantity);
  const auto axis = [&](const std::string& name, const std::vector<double>& nodes) {
    file.values<double>(name, {nodes.size()}, nodes);
  };
  axis("alpha", brdf.alpha);
  axis("lambda", brdf.lambda);
  axis("theta", brdf.theta);
  axis("phi", brdf.phi);
  axis("theta_light", brdf.theta_light);
  axis("phi_light", brdf.phi_light);
  file.values<float>("values", brdf.shape(), brdf.values);
  std::ofstream(path, std::ios::binary) << file.finish();
}

// How far a file's lobe is from GGX: half the L1 distance of the cosine-weighted BRDFs, over the
// albedo.
double distance_to_ggx(const LobeModel& model, Lobe lobe, const Lobe& other) {
  const GgxSampler exact(other);
  lobe.model = &model;
  const auto sampler = model.sampler(lobe);
  test::Uniform uniform(3);
  double distance = 0, albedo = 0;
  for (int i = 0; i < 20000; ++i) {
    const double z = uniform(), azimuth = 2 * kPi * uniform(), sine = std::sqrt(1 - z * z);
    const Eigen::Vector3d l(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
    distance += std::abs(sampler->brdf_cosine(l) - exact.brdf_cosine(l));
    albedo += exact.brdf_cosine(l);
  }
  return distance / albedo / 2;
}

double distance_to_ggx(const LobeModel& model, const Lobe& lobe) {
  return distance_to_ggx(model, lobe, lobe);
}

TEST(Measured, GgxFromAFileIsGgx) {
  const test::TemporaryDirectory folder;
  write(sampled_ggx(isotropic()), folder / "iso.h5");
  write(sampled_ggx(anisotropic()), folder / "aniso.h5");
  const LobeModel& iso = lobe_model((folder / "iso.h5").string());
  const LobeModel& aniso = lobe_model((folder / "aniso.h5").string());
  EXPECT_EQ(&iso, &lobe_model((folder / "iso.h5").string()));
  EXPECT_EQ(iso.name(), (folder / "iso.h5").string());
  // At the file's nodes nothing but the interpolation between light directions 1.4 and 3.8 degrees
  // apart is in the way: a hundredth, of lobes some tens of degrees wide.
  for (const double phi : {0.0, 1.0, 4.0}) {
    EXPECT_LT(distance_to_ggx(iso, {0.4, 0.4, 0.8, phi}), 0.01);
    EXPECT_LT(distance_to_ggx(iso, {1, 1, 1.5, phi}), 0.01);
  }
  // In all quadrants, and with the roughnesses exchanged.
  for (const double phi : {kPi / 6, -kPi / 6, kPi - kPi / 6, kPi + kPi / 3})
    EXPECT_LT(distance_to_ggx(aniso, {0.8, 0.4, 0.8, phi}), 0.01);
  EXPECT_LT(distance_to_ggx(aniso, {0.25, 0.5, 0.6, kPi / 3}), 0.02);
  // The check can fail: another lobe.
  EXPECT_GT(distance_to_ggx(aniso, {0.8, 0.4, 0.8, 0.1}, {0.8, 0.4, 0.8, 0.6}), 0.02);
}

TEST(Measured, SamplesFollowItsValues) {
  const test::TemporaryDirectory folder;
  write(sampled_ggx(anisotropic()), folder / "a.h5");
  const LobeModel& model = measured((folder / "a.h5").string());
  const AlbedoRule rule;
  for (const double phi : {0.3, 2.5}) {
    const Lobe lobe{0.7, 0.4, 1.1, phi, &model};
    const auto sampler = model.sampler(lobe);
    // A moment of each axis, by samples and by the density: the lattice's error is below 1e-3.
    Eigen::Vector4d by_samples = Eigen::Vector4d::Zero(), by_density = by_samples;
    const int count = 20000, steps = 600;
    for (int i = 0; i < count; ++i) {
      const LobeSample sample = sampler->sample(
          lattice_point(static_cast<std::size_t>(i), static_cast<std::size_t>(count)));
      const LobeDensities densities = sampler->densities(sample.omega_l);
      EXPECT_NEAR(sample.weight * densities.sampling, densities.brdf_cosine,
                  1e-6 * densities.sampling);
      EXPECT_LE(sample.weight, sampler->most_weight() * (1 + 1e-12));
      by_samples += sample.weight / count * sample.omega_l.homogeneous();
    }
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const double z = (i + 0.5) / steps, azimuth = 2 * kPi * (j + 0.5) / steps;
        const double sine = std::sqrt(1 - z * z);
        const Eigen::Vector3d l(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
        by_density += sampler->brdf_cosine(l) * 2 * kPi / (steps * steps) * l.homogeneous();
      }
    for (int axis = 0; axis < 4; ++axis)
      EXPECT_NEAR(by_samples[axis], by_density[axis], 1e-3);
    EXPECT_NEAR(integrate_albedo(lobe, rule).amplitude, by_density[3], 1e-3);
  }
}

TEST(Measured, TablesOfItAreThoseOfItsModel) {
  const test::TemporaryDirectory folder;
  write(sampled_ggx(isotropic()), folder / "g.h5");
  const auto config_of = [&](const std::string& brdf) {
    return parse_config("table.brdf = \"" + brdf +
                            "\"\ntable.alpha = {first = 0.4, last = 1, nodes = 2}\n"
                            "table.lambda = {first = 1, nodes = 1}\n"
                            "table.theta = {last_degrees = 80, nodes = 3}\n"
                            "table.phi = {nodes = 1}\nrefine.steps = 0\n",
                        "test.toml", {});
  };
  const Table of_file = generate_table(config_of((folder / "g.h5").string()), {2});
  const Table of_ggx = generate_table(config_of("ggx"), {2});
  for (std::size_t flat = 0; flat < of_ggx.grid.size(); ++flat) {
    HeldOutJudge judge(4096, 32);
    judge.set_lobe(of_ggx.grid.lobe(flat));
    // As near to GGX as its own fit, but for the interpolation in the file.
    EXPECT_LT(judge.loss(of_file.matrix_at(flat)),
              1.1 * judge.loss(of_ggx.matrix_at(flat)) + 0.01 * judge.spread());
    EXPECT_NEAR(of_file.amplitude[flat], of_ggx.amplitude[flat], 0.01f);
  }
}

TEST(Measured, ACosineWeightedFileIsTheSame) {
  const test::TemporaryDirectory folder;
  MeasuredBrdf grid = isotropic();
  grid.theta_light = evenly(0, 1.5, 64);
  write(sampled_ggx(grid), folder / "a.h5");
  write(sampled_ggx(grid, true), folder / "b.h5", "brdf-cosine");
  const MeasuredBrdf plain = read_brdf(folder / "a.h5"), weighted = read_brdf(folder / "b.h5");
  for (std::size_t i = 0; i < plain.values.size(); ++i)
    ASSERT_NEAR(plain.values[i], weighted.values[i], 1e-5 * plain.values[i]);  // single precision
  write(sampled_ggx(isotropic(), true), folder / "c.h5", "brdf-cosine");
  EXPECT_THROW(read_brdf(folder / "c.h5"), InputError);  // at the horizon
}

std::string refusal_of(const MeasuredBrdf& brdf) {
  return test::message_of<InputError>([&] { require_sound(brdf, "x.h5"); });
}

TEST(Measured, SaysWhatIsWrongWithAFile) {
  const MeasuredBrdf good = sampled_ggx(isotropic());
  require_sound(good, "x.h5");
  MeasuredBrdf bad = good;
  bad.alpha[2] = bad.alpha[1];
  test::expect_one_line(refusal_of(bad), {"x.h5", "alpha", "rise strictly"});
  bad = good;
  bad.theta.back() = 1.6;
  test::expect_one_line(refusal_of(bad), {"x.h5", "theta", "1.6"});
  bad = good;
  bad.phi_light = evenly(0, 3, 64);
  test::expect_one_line(refusal_of(bad), {"x.h5", "phi_light", "3", "0 to pi"});
  bad = good;
  bad.values[70] = -1;
  test::expect_one_line(refusal_of(bad), {"x.h5", "-1", "values[0, 0, 0, 0, 1, 6]"});
  bad = good;
  bad.values[64 * 64 + 3] = std::nanf("");
  test::expect_one_line(refusal_of(bad), {"x.h5", "nan", "values[0, 0, 1, 0, 0, 3]"});
  bad = good;
  std::fill_n(bad.values.begin() + 64 * 64, 64 * 64, 0.0f);
  test::expect_one_line(refusal_of(bad), {"x.h5", "values[0, 0, 1, 0, 0, 0]", "nothing"});
  bad = good;
  bad.phi = {0.5};
  test::expect_one_line(refusal_of(bad), {"x.h5", "phi", "0.5"});
  bad = sampled_ggx(anisotropic());
  bad.phi_light.back() = 2 * kPi;
  test::expect_one_line(refusal_of(bad), {"x.h5", "phi_light", "closes"});
}

TEST(Measured, RefusesFilesAndLobesThatAreNone) {
  const test::TemporaryDirectory folder;
  EXPECT_THROW(measured((folder / "none.h5").string()).require({}), IoError);
  std::ofstream(folder / "text.h5") << "no HDF5";
  EXPECT_THROW(measured((folder / "text.h5").string()).require({}), InputError);
  write(sampled_ggx(isotropic()), folder / "odd.h5", "radiance");
  const std::string quantity = test::message_of<InputError>([&] { read_brdf(folder / "odd.h5"); });
  test::expect_one_line(quantity, {"odd.h5", "radiance", "brdf-cosine"});
  write(sampled_ggx(isotropic()), folder / "g.h5");
  const LobeModel& model = measured((folder / "g.h5").string());
  model.require({0.5, 0.5, 1.0, 2.0, &model});
  const auto refusal = [&](const Lobe& lobe) {
    return test::message_of<InputError>([&] { model.require(lobe); });
  };
  test::expect_one_line(refusal({0.2, 0.2, 1, 0, &model}), {"g.h5", "roughness 0.2", "0.4 to 1"});
  test::expect_one_line(refusal({0.5, 0.4, 1, 0, &model}), {"g.h5", "ratio", "0.8"});
  test::expect_one_line(refusal({0.5, 0.5, 1.55, 0, &model}), {"g.h5", "elevation", "1.55"});
}

}  // namespace
}  // namespace ltc
