// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A table in memory: all that its files hold.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/enum_names.h"
#include "field/field.h"
#include "table/grid.h"
#include "table/precision.h"
#include "table/storage.h"

namespace ltc {

enum class Status : std::uint8_t {
  skipped = 0,       // not needed; its values are NaN
  fitted = 1,        // fitted by the solver
  copied = 2,        // copied, rotated or mirrored from an entry that symmetry makes equal
  analytic = 3,      // closed form
  failed = 4,        // the solver found no finite matrix; its values are NaN
  interpolated = 5,  // between fits (interpolate/between_fits.h)
};

constexpr EnumNames<Status, 6> enum_names(Status) {
  return {"status",
          {{{Status::skipped, "skipped"},
            {Status::fitted, "fitted"},
            {Status::copied, "copied"},
            {Status::analytic, "analytic"},
            {Status::failed, "failed"},
            {Status::interpolated, "interpolated"}}}};
}

// Whether entries of this status have values; those of the others are NaN.
inline bool has_values(Status status) {
  return status != Status::skipped && status != Status::failed;
}

struct Table {
  Grid grid;
  Storage storage = Storage::matrix;
  std::uint64_t seed = 0;
  std::string config;     // the full effective TOML
  std::string generator;  // program, version, commit
  std::string created;    // UTC, ISO 8601
  // Whether nodes were moved for the sake of what lies between them (refine/refine.h) and stayed
  // so; nothing where that is not known.
  std::optional<bool> refined;
  Precision precision = Precision::single;  // of the file that it was read from
  bool without_albedo = false;              // whether its file lacks amplitudes or Fresnel terms
  bool of_any_scale = false;                // whether its S have no certain scale: of others' files
  std::string read_as;  // what a file was taken for that does not say it, and why; else empty

  // Where there is one, look-ups go to it and not to the nodes, whose values are the field's.
  std::optional<Field> field;

  // One value (nine for `stored`, row-major) an entry, in the grid's C order.
  std::vector<float> stored;     // S, third column of unit length; M itself with Storage::matrix
  std::vector<float> amplitude;  // integral of rho cos(theta_l) with F = 1
  std::vector<float> fresnel;    // integral of (1 - v.h)^5 rho cos(theta_l)
  std::vector<float> sw_loss;    // sliced-Wasserstein loss of the stored matrix
  std::vector<float> fold;       // kappa and gamma, two an entry; of Storage::folded alone
  std::vector<Status> status;
  std::vector<std::uint16_t> iterations;  // optimiser steps spent

  // Of folded lobes; with Storage::folded alone, at least one.
  Creases creases = {};

  // All arrays sized for the grid, every value NaN and every status `skipped`.
  static Table empty(const Grid& grid, Storage storage);

  Eigen::Matrix3d stored_at(std::size_t flat) const;
  void set_stored(std::size_t flat, const Eigen::Matrix3d& stored);
  // M of the node, whatever the storage.
  Eigen::Matrix3d matrix_at(std::size_t flat) const;
  // The fold of the node's lobe; none with other storages. And the lobe itself.
  Fold fold_at(std::size_t flat) const;
  LtcLobe ltc_at(std::size_t flat) const { return {matrix_at(flat), fold_at(flat), creases}; }
};

// Whether its lobes are folded (ltc/folded.h): then matrices alone are none.
inline bool is_folded(const Table& table) {
  return table.storage == Storage::folded;
}

}  // namespace ltc
