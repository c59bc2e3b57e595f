// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Random numbers with the same bits on every platform: the standard distributions are free to
// differ between implementations, the standard engines are not.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace ltc {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Uniform on [0, 1), 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  // Standard normal (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

  // Uniform on the sphere: height and azimuth (Archimedes).
  Eigen::Vector3d direction() {
    const double z = 2 * uniform() - 1;
    const double azimuth = 2 * std::numbers::pi * uniform();
    const double radius = std::sqrt((1 - z) * (1 + z));
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace ltc
