// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fit/sliced_wasserstein.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace ltc {
namespace {

using Atom = SlicedWassersteinLoss::Atom;

// The set's weights with a total of one.
std::vector<double> normalised_weights(const PointSet& set) {
  const std::size_t count = set.points.size();
  if (count == 0)
    throw InputError("a point set of size 0 has no distance to another; allowed: 1 and more");
  for (std::size_t i = 0; i < count; ++i)
    if (!set.points[i].allFinite())
      throw InputError(
          fmt::format("point {} of a point set is not finite; allowed: finite coordinates", i));
  if (set.weights.empty())
    return std::vector<double>(count, 1 / static_cast<double>(count));
  if (set.weights.size() != count)
    throw InputError(fmt::format("a point set has {} weights for {} points; allowed: {} or none",
                                 set.weights.size(), count, count));
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(set.weights[i] >= 0 && std::isfinite(set.weights[i])))
      throw InputError(fmt::format(
          "weight {} of a point set is {}; allowed: finite and not negative", i, set.weights[i]));
    total += set.weights[i];
  }
  if (!(total > 0))
    throw InputError(
        fmt::format("the weights of a point set add up to {}; allowed: more than 0", total));
  std::vector<double> weights = set.weights;
  for (double& weight : weights)
    weight /= total;
  return weights;
}

void require_directions(const std::vector<Eigen::Vector3d>& directions) {
  if (directions.empty())
    throw InputError("0 projection directions define no distance; allowed: 1 and more");
  for (std::size_t k = 0; k < directions.size(); ++k)
    if (!directions[k].allFinite())
      throw InputError(fmt::format("direction {} is not finite; allowed: unit vectors", k));
}

std::vector<Atom> sorted_projections(const std::vector<Eigen::Vector3d>& points,
                                     const std::vector<double>& weights,
                                     const Eigen::Vector3d& direction) {
  std::vector<Atom> atoms(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    atoms[i] = {direction.dot(points[i]), weights[i], i};
  std::sort(atoms.begin(), atoms.end(), [](const Atom& a, const Atom& b) {
    return a.projection != b.projection ? a.projection < b.projection : a.index < b.index;
  });
  return atoms;
}

// Calls visit(du, f atom, g atom) for every interval of u on which both quantile functions are
// constant.
template <typename Visit>
void for_each_interval(const std::vector<Atom>& f, const std::vector<Atom>& g, Visit&& visit) {
  std::size_t i = 0, j = 0;
  double left_f = f[0].mass, left_g = g[0].mass;
  for (;;) {
    const double length = std::min(left_f, left_g);
    visit(length, f[i], g[j]);
    const bool f_ends = left_f <= left_g, g_ends = left_g <= left_f;
    left_f -= length;
    left_g -= length;
    if (f_ends) {
      if (++i == f.size())
        return;
      left_f = f[i].mass;
    }
    if (g_ends) {
      if (++j == g.size())
        return;
      left_g = g[j].mass;
    }
  }
}

double sign(double value) {
  return static_cast<double>((value > 0) - (value < 0));
}

// Folds one number into a hash: Fowler, Noll and Vo's FNV-1a, eight bytes at a time.
std::uint64_t folded(std::uint64_t hash, std::int64_t value) {
  return (hash ^ static_cast<std::uint64_t>(value)) * 0x100000001b3u;
}

}  // namespace

double sliced_wasserstein(const PointSet& f, const PointSet& g,
                          const std::vector<Eigen::Vector3d>& directions) {
  require_directions(directions);
  const std::vector<double> f_weights = normalised_weights(f), g_weights = normalised_weights(g);
  double distance = 0;
  for (const Eigen::Vector3d& direction : directions)
    for_each_interval(sorted_projections(f.points, f_weights, direction),
                      sorted_projections(g.points, g_weights, direction),
                      [&](double length, const Atom& x, const Atom& y) {
                        distance += length * std::abs(x.projection - y.projection);
                      });
  return distance / static_cast<double>(directions.size());
}

SlicedWassersteinLoss::SlicedWassersteinLoss(std::vector<Eigen::Vector3d> omega_o,
                                             const PointSet& target,
                                             std::vector<Eigen::Vector3d> directions)
    : omega_o_(std::move(omega_o)), directions_(std::move(directions)) {
  require_directions(directions_);
  normalised_weights({omega_o_, {}});  // for its checks
  const std::vector<double> weights = normalised_weights(target);
  for (const Eigen::Vector3d& direction : directions_)
    target_.push_back(sorted_projections(target.points, weights, direction));
}

LossAndGradient SlicedWassersteinLoss::operator()(const Eigen::Matrix3d& matrix) const {
  const std::size_t count = omega_o_.size();
  LossAndGradient result;
  std::vector<Eigen::Vector3d> f(count);
  std::vector<double> length(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d image = matrix * omega_o_[i];
    length[i] = image.norm();
    f[i] = image / length[i];
    if (!f[i].allFinite()) {
      result.loss = std::numeric_limits<double>::quiet_NaN();
      result.gradient.setConstant(result.loss);
      return result;
    }
  }
  const std::vector<double> weights(count, 1 / static_cast<double>(count));
  std::vector<double> pull(count);  // s_i
  result.piece = 0xcbf29ce484222325u;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Eigen::Vector3d& d = directions_[k];
    std::fill(pull.begin(), pull.end(), 0.0);
    for_each_interval(sorted_projections(f, weights, d), target_[k],
                      [&](double du, const Atom& x, const Atom& y) {
                        const double difference = x.projection - y.projection;
                        result.loss += du * std::abs(difference);
                        pull[x.index] += du * sign(difference);
                      });
    for (std::size_t i = 0; i < count; ++i) {
      const double x = d.dot(f[i]);
      result.gradient += (pull[i] / length[i]) * (d - x * f[i]) * omega_o_[i].transpose();
      // Rounded, since the same pull is summed from other addends when samples change places.
      result.piece =
          folded(result.piece, std::llround(pull[i] * static_cast<double>(count) * 0x1p32));
    }
  }
  const double share = 1 / static_cast<double>(directions_.size());
  result.loss *= share;
  result.gradient *= share;
  return result;
}

}  // namespace ltc
