// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The commands that look into an entry of a table.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "cli/options.h"
#include "table/table.h"

namespace ltc::cli {

// Commands for the entries of a table that was read from a file; the table must outlive them.
class EntryCommands {
 public:
  EntryCommands(const std::string& file, const Table& table);

  // "ltcfit fit --as-in out/ltc.h5 --entry 3,0,7,4": what the file holds.
  std::string stored(std::size_t flat) const;
  // "ltcfit fit --config out/ltc.h5 --entry 3,0,7,4": the fit that the entry had when the table was
  // made. Empty where the file does not say how that was, or says it of some entries only.
  std::string fitted(std::size_t flat) const;
  // The fit where that is what the table holds, else what it holds.
  std::string best(std::size_t flat) const;
  bool refined() const { return refined_; }

 private:
  const Table& table_;
  std::string file_;  // as a shell reads it
  bool has_config_ = false, refined_ = false;
};

// A lobe by the numbers that the command line takes.
struct NamedLobe {
  double alpha_x, alpha_y, theta_degrees, phi_degrees;
};

// The command that fits this very lobe, every number to its last bit, from `start` as --start takes
// it (empty: the solver's own).
std::string fit_command(const ConfigArguments& config, const NamedLobe& lobe,
                        const std::string& start);

// "matrix=1,0,0,…": M by rows, as --start takes it, to the last bit.
std::string matrix_text(const Eigen::Matrix3d& matrix);

}  // namespace ltc::cli
