// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Samples of light directions by their density on a grid of the hemisphere: for BRDFs that have no
// sampler of their own.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "brdf/lobe_sampler.h"

namespace ltc {

// What cells are even in: the solid angle, or the projected one, which counts light at the horizon
// for nothing.
enum class CellMeasure { solid_angle, projected };

// Rows between heights (cosines of the elevation) that fall from 1 to 0, columns between azimuths
// that rise through one turn. A cell counts as much as its measure times the mean of a density per
// measure at its corners; within it samples are even in the measure. Samples are a map of the unit
// square that is continuous but for the steps from cell to cell, and periodic in the azimuth.
class LightCells {
 public:
  // `values` at all nodes, height by height, not negative.
  LightCells(std::vector<double> heights, std::vector<double> azimuths, std::vector<double> values,
             CellMeasure measure);

  struct Spot {
    std::size_t row = 0, column = 0;  // of its cell
    double height = 0, azimuth = 0;
  };
  // Of an angle around, from its cosine and sine, and a uniform on [0, 1).
  Spot draw(double cos_turn, double sin_turn, double uniform) const;
  Spot spot_of(double height, double azimuth) const;

  // The density of samples about a spot, per measure and per steradian; none where nothing is lit.
  double per_measure(const Spot& spot) const {
    return total_ > 0 ? mean(spot.row, spot.column) / total_ : 0;
  }
  double density(const Spot& spot) const {
    return per_measure(spot) * (measure_ == CellMeasure::projected ? spot.height : 1);
  }

  double total() const { return total_; }
  // The largest value at a cell's corner over the cell's mean.
  double steepest() const { return steepest_; }

  double value(std::size_t row, std::size_t column) const {
    return values_[row * azimuths_.size() + column];
  }
  const std::vector<double>& heights() const { return heights_; }
  const std::vector<double>& azimuths() const { return azimuths_; }

 private:
  double mean(std::size_t row, std::size_t column) const {
    return (value(row, column) + value(row, column + 1) + value(row + 1, column) +
            value(row + 1, column + 1)) /
           4;
  }
  // What the measure is even in: the height, or half its square.
  double level(double height) const {
    return measure_ == CellMeasure::projected ? height * height / 2 : height;
  }

  std::vector<double> heights_, azimuths_, values_;
  CellMeasure measure_;
  std::vector<double> below_row_;   // mass above each row, one more than rows
  std::vector<double> below_cell_;  // likewise along each row
  double total_ = 0, steepest_ = 0;
};

// A light direction on or above the horizon as a sample of a sampler whose axis is the normal, its
// weight that of the cosine-weighted BRDF over the density of samples; none where one of them is.
LobeSample sample_about_normal(const Eigen::Vector3d& omega_v, const Eigen::Vector3d& omega_l,
                               double brdf_cosine, double density);

}  // namespace ltc
