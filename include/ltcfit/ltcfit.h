// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The library in one header: fit a lobe, make a table, read, write, look up and judge it. Needs
// Eigen alone.
//
// Directions are of the tangent frame: z is the surface normal, x the direction of alpha_x. A
// matrix M maps clamped-cosine directions to the lobe, omega = M omega_o / |M omega_o| (Heitz et
// al. 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"). Angles are in
// radians.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ltcfit/error.h"

namespace ltc {
struct Table;
}

namespace ltcfit {

struct Validation;

// What the functions below throw, each with a message of one line: a value, config or file that
// cannot be used; a file that the system refuses; a check that failed; a stop that was asked for.
using ltc::CheckFailure;
using ltc::InputError;
using ltc::Interrupted;
using ltc::IoError;

// "0.2.0"
std::string_view version();

// The lobe of anisotropic GGX that a viewer sees.
struct Lobe {
  double alpha_x = 1, alpha_y = 1;  // roughness along x and y, (0, 1] in use
  double theta_radians = 0;         // between view direction and normal, [0, pi/2)
  double phi_radians = 0;           // azimuth of the view direction, any
};

// What shading needs of a lobe: its light is F0 amplitude + (1 - F0) fresnel.
struct Shading {
  Eigen::Matrix3d matrix;  // M
  double amplitude = 0;    // integral of rho cos(theta_l) with F = 1
  double fresnel = 0;      // integral of (1 - v.h)^5 rho cos(theta_l)
};

// What a config file and `ltcfit --set` say (config/default.toml names every key).
struct Config {
  std::filesystem::path file;          // TOML, or the .h5 of a table made so; empty: the defaults
  std::vector<std::string> overrides;  // "key=value", in order
};

// How work is done; the result has the same bits whatever this says.
struct Run {
  int threads = 0;  // 0: one a processor
  // Called on the calling thread some ten times a second with the stage, and the units of work done
  // and in all; false asks for a stop, which throws Interrupted. What it throws stops too and comes
  // through. Empty: nobody watches.
  std::function<bool(std::string_view stage, std::size_t done, std::size_t total)> progress;
  // Hears, on the thread that works, what a user should know and is no error, a line at a time.
  // Empty: nobody does.
  std::function<void(const std::string& line)> warn = nullptr;
};

// What of a table is made; all of it where this says nothing.
struct Part {
  std::filesystem::path scene;   // only what the materials of this scene need (docs/scenes.md)
  std::filesystem::path extend;  // only what this table's .h5 lacks; the rest is kept bit for bit
};

struct FittedLobe {
  Shading shading;    // M aligned, equation (16) enforced, third column of unit length
  double loss = 0;    // sliced-Wasserstein distance to GGX, on samples that the fit has not seen
  double spread = 0;  // mean absolute deviation of the lobe: the scale of losses
};

// An LTC of this very lobe, by the config's solver. Throws InputError for a lobe out of range,
// CheckFailure where no finite matrix is found.
FittedLobe fit(const Lobe& lobe, const Config& config = {});

// A table over larger roughness alpha, ratio lambda, theta and phi. Immutable; copies share it.
class Table {
 public:
  // The name's ending says of which format it is (docs/files.md); of a set of textures one file,
  // .0.exr, brings in the others.
  static Table read(const std::filesystem::path& file);
  // By the ending too; an older file stands until the new one is whole. `half`: 16-bit textures.
  void write(const std::filesystem::path& file, bool half = false) const;

  // Nodes along alpha, lambda, theta, phi; values are in this C order, phi fastest.
  std::array<std::size_t, 4> shape() const;
  const std::vector<double>& axis(std::size_t index) const;
  std::string_view storage() const;   // what `stored` is and interpolates: docs/files.md
  const std::string& config() const;  // the TOML that made it; empty where the file has none

  // Nine numbers a node, row-major; one a node. NaN where a node or the file has none.
  std::span<const float> stored() const;
  std::span<const float> amplitude() const;
  std::span<const float> fresnel() const;
  std::span<const float> loss() const;

  // M of a node, whatever the storage. Throws InputError for a node that is not there.
  Eigen::Matrix3d matrix(const std::array<std::size_t, 4>& node) const;

  // What a shader gets for the lobe: folded by symmetry (equations 13 to 15 of Aakash et al. 2022),
  // interpolated, and unfolded. Beyond the axes it is clamped; NaN where a node has no values.
  Shading look_up(const Lobe& lobe) const;

 private:
  explicit Table(ltc::Table table, bool has_albedo, bool has_loss);
  struct Data;
  std::shared_ptr<const Data> data_;
  friend Table generate(const Config&, const Run&, const Part&);
  friend Validation validate(const Table&, const Config&, bool, const Run&);
};

// The table of a config, its [output] section aside.
Table generate(const Config& config = {}, const Run& run = {}, const Part& part = {});

// One property that every sound table has (docs/validation.md).
struct Check {
  std::string name;
  bool checked = false;  // false: the file lacks what it needs
  bool passed = true;
  double value = 0, limit = 0;
  std::string message;  // names the worst entry; empty if passed
};

// Means over held-out look-ups: losses relative to the lobe's spread, errors under rectangular
// lights as a share of the lobe's light; the floor is an LTC fitted to each very lobe.
struct Quality {
  double node_loss = 0;
  double loss = 0, floor_loss = 0;
  double area_light_error = 0, floor_area_light_error = 0;
};

struct Validation {
  std::vector<Check> checks;
  std::optional<Quality> quality;
  bool passed() const;
};

// `limits` is a config of `ltcfit validate` (config/validate.toml). Without `quality` the checks
// alone, in seconds.
Validation validate(const Table& table, const Config& limits = {}, bool quality = true,
                    const Run& run = {});

}  // namespace ltcfit
