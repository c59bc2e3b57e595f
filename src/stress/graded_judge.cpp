// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "stress/graded_judge.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "brdf/lobe_model.h"
#include "core/ordered_float.h"
#include "fit/sample_sets.h"

namespace ltc {
namespace {

// int_0^1 |F^-1(u) - G^-1(u)| du of two staircases.
double distance(const std::vector<double>& f, const std::vector<double>& f_mass,
                const std::vector<double>& g, const std::vector<double>& g_mass) {
  double sum = 0;
  std::size_t i = 0, j = 0;
  double of_f = f_mass[0], of_g = g_mass[0];  // what is left of the two steps
  for (;;) {
    const double width = std::min(of_f, of_g);
    sum += width * std::abs(f[i] - g[j]);
    of_f -= width;
    of_g -= width;
    if (of_f <= 0) {
      if (++i == f.size())
        return sum;
      of_f = f_mass[i];
    }
    if (of_g <= 0) {
      if (++j == g.size())
        return sum;
      of_g = g_mass[j];
    }
  }
}

// int_0^1 |F^-1(u) - F^-1(1/2)| du.
double deviation(const std::vector<double>& f, const std::vector<double>& mass) {
  double below = 0, median = f.back();
  for (std::size_t i = 0; i < f.size(); ++i)
    if ((below += mass[i]) >= 0.5) {
      median = f[i];
      break;
    }
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    sum += mass[i] * std::abs(f[i] - median);
  return sum;
}

}  // namespace

GradedJudge::GradedJudge(std::size_t samples, std::size_t directions, std::uint64_t seed)
    : of_lobe_(make_graded_lattice(samples, 0.713 + 1e-3 * static_cast<double>(seed % 991))),
      of_lobe_again_(make_graded_lattice(samples, 0.391 + 1e-3 * static_cast<double>(seed % 983))),
      of_cosine_(make_graded_lattice(samples, 0.237 + 1e-3 * static_cast<double>(seed % 997))),
      directions_(turned_directions(directions, seed)),
      lobe_(directions),
      keys_(of_lobe_.size()) {
  points_.offset.resize(3, static_cast<Eigen::Index>(keys_.size()));
  points_.mass.resize(keys_.size());
  staircase_.value.resize(keys_.size());
  staircase_.mass.resize(keys_.size());
}

void GradedJudge::sample_lobe(const LobeSampler& sampler, const GradedLattice& lattice,
                              Points& points) const {
  const Eigen::Matrix3d to_frame = frame_->rotation.transpose();
  double total = 0;
  for (std::size_t i = 0; i < lattice.mass.size(); ++i) {
    const LobeSample sample =
        sampler.sample(lattice.cos_azimuth[i], lattice.sin_azimuth[i], 1 - lattice.depth[i]);
    points.offset.col(static_cast<Eigen::Index>(i)) = to_frame * sample.offset;
    points.mass[i] = lattice.mass[i] * sample.weight;
    total += points.mass[i];
  }
  for (double& mass : points.mass)
    mass /= total;
}

void GradedJudge::sort(const Points& points, const Eigen::Vector3d& direction,
                       const hwy::Sorter& sorter, Staircase& staircase) {
  for (std::uint32_t i = 0; i < keys_.size(); ++i)
    keys_[i] = sort_key(static_cast<float>(direction.dot(points.offset.col(i))), i);
  sorter(keys_.data(), keys_.size(), hwy::SortAscending());
  staircase.value.resize(keys_.size());
  staircase.mass.resize(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    staircase.value[i] = static_cast<double>(key_value(keys_[i]));
    staircase.mass[i] = points.mass[key_index(keys_[i])];
  }
}

double GradedJudge::distance_to_lobe(const Points& points) {
  const hwy::Sorter sorter;
  double sum = 0;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    sort(points, frame_->rotation.transpose() * directions_[k], sorter, staircase_);
    sum += distance(lobe_[k].value, lobe_[k].mass, staircase_.value, staircase_.mass);
  }
  return sum / static_cast<double>(directions_.size());
}

void GradedJudge::set_lobe(const Lobe& lobe) {
  frame_.emplace(lobe);
  const std::unique_ptr<LobeSampler> sampler = lobe.model->sampler(lobe);
  sample_lobe(*sampler, of_lobe_, points_);
  spread_ = 0;
  const hwy::Sorter sorter;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    sort(points_, frame_->rotation.transpose() * directions_[k], sorter, lobe_[k]);
    spread_ += deviation(lobe_[k].value, lobe_[k].mass);
  }
  spread_ /= static_cast<double>(directions_.size());
  sample_lobe(*sampler, of_lobe_again_, points_);
  noise_ = distance_to_lobe(points_);
}

double GradedJudge::loss(const Eigen::Matrix3d& matrix, const Fold& fold, const Creases& creases) {
  const Eigen::Matrix3d p = frame_->rotation.transpose() * matrix / matrix.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < of_cosine_.mass.size(); ++i) {
    // Of a clamped cosine the squared sine is uniform, and the squared cosine t^2.
    const double sine = std::sqrt(1 - of_cosine_.depth[i]);
    const Eigen::Vector3d omega_o(sine * of_cosine_.cos_azimuth[i],
                                  sine * of_cosine_.sin_azimuth[i], std::sqrt(of_cosine_.depth[i]));
    const Eigen::Vector3d f = p * folded(omega_o, fold, creases);
    const double lateral = f.head<2>().squaredNorm(), length = f.norm();
    // f_z / |f| - 1, without cancellation in front.
    points_.offset.col(static_cast<Eigen::Index>(i)) << f.x() / length, f.y() / length,
        f.z() > 0 ? -lateral / (length * (length + f.z())) : f.z() / length - 1;
  }
  if (!points_.offset.allFinite())
    return std::numeric_limits<double>::quiet_NaN();
  points_.mass = of_cosine_.mass;
  return distance_to_lobe(points_);
}

}  // namespace ltc
