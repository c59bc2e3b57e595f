// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/light_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ltc {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// Which of the intervals a share of all mass falls into, by the masses before their ends, and where
// in it.
double drawn(std::span<const double> before, double share, std::size_t& interval) {
  const double wanted = share * before.back();
  const auto above = std::upper_bound(before.begin() + 1, before.end() - 1, wanted);
  interval = static_cast<std::size_t>(above - before.begin()) - 1;
  const double mass = before[interval + 1] - before[interval];
  return mass > 0 ? std::clamp((wanted - before[interval]) / mass, 0.0, 1.0) : 0.5;
}

}  // namespace

LightCells::LightCells(std::vector<double> heights, std::vector<double> azimuths,
                       std::vector<double> values, CellMeasure measure)
    : heights_(std::move(heights)),
      azimuths_(std::move(azimuths)),
      values_(std::move(values)),
      measure_(measure) {
  const std::size_t rows = heights_.size() - 1, columns = azimuths_.size() - 1;
  below_row_.push_back(0);
  for (std::size_t i = 0; i < rows; ++i) {
    const double band = level(heights_[i]) - level(heights_[i + 1]);
    double row = 0;
    below_cell_.push_back(0);
    for (std::size_t j = 0; j < columns; ++j) {
      const double of_cell = mean(i, j);
      row += of_cell * band * (azimuths_[j + 1] - azimuths_[j]);
      below_cell_.push_back(row);
      if (of_cell > 0)
        steepest_ = std::max(steepest_, std::max({value(i, j), value(i, j + 1), value(i + 1, j),
                                                  value(i + 1, j + 1)}) /
                                            of_cell);
    }
    below_row_.push_back(below_row_.back() + row);
  }
  total_ = below_row_.back();
}

LightCells::Spot LightCells::draw(double cos_turn, double sin_turn, double uniform) const {
  double share = std::atan2(sin_turn, cos_turn) / turn;
  share -= std::floor(share);
  Spot spot;
  const double down = drawn(below_row_, uniform, spot.row);
  const std::size_t ends = azimuths_.size();
  const double along =
      drawn(std::span(below_cell_).subspan(spot.row * ends, ends), share, spot.column);
  const double upper = level(heights_[spot.row]), lower = level(heights_[spot.row + 1]);
  const double at = upper + down * (lower - upper);
  spot.height = measure_ == CellMeasure::projected ? std::sqrt(2 * at) : at;
  spot.azimuth =
      azimuths_[spot.column] + along * (azimuths_[spot.column + 1] - azimuths_[spot.column]);
  return spot;
}

LightCells::Spot LightCells::spot_of(double height, double azimuth) const {
  Spot spot;
  const double turns = (azimuth - azimuths_.front()) / turn;
  spot.height = height;
  spot.azimuth = azimuths_.front() + turn * (turns - std::floor(turns));
  const auto lower = std::upper_bound(heights_.begin() + 1, heights_.end() - 1, height,
                                      [](double at, double node) { return at > node; });
  spot.row = static_cast<std::size_t>(lower - heights_.begin()) - 1;
  const auto above = std::upper_bound(azimuths_.begin() + 1, azimuths_.end() - 1, spot.azimuth);
  spot.column = static_cast<std::size_t>(above - azimuths_.begin()) - 1;
  return spot;
}

LobeSample sample_about_normal(const Eigen::Vector3d& omega_v, const Eigen::Vector3d& omega_l,
                               double brdf_cosine, double density) {
  LobeSample sample;
  sample.omega_l = omega_l;
  // z - 1 of a direction near the normal, from its sine.
  sample.offset << omega_l.head<2>(), -omega_l.head<2>().squaredNorm() / (1 + omega_l.z());
  const Eigen::Vector3d half = omega_v + omega_l;
  sample.v_dot_h = omega_v.dot(half) / half.norm();
  if (omega_l.z() > 0 && density > 0)
    sample.weight = brdf_cosine / density;
  return sample;
}

}  // namespace ltc
