// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>

#include "brdf/light_cells.h"
#include "brdf/measured_file.h"
#include "core/error.h"
#include "core/gauss_rule.h"

namespace ltc {
namespace {

constexpr double pi = std::numbers::pi;

// So little beyond an axis is no matter: the last view of tables is 1.6e-4 from the horizon, and
// angles have been degrees.
constexpr double angle_tolerance = 2e-4, roughness_tolerance = 1e-6;

// Between which nodes a value is, and its share of the upper one. Clamped to the axis.
struct Bracket {
  std::size_t lower = 0, upper = 0;
  double share = 0;
};
Bracket bracket(const std::vector<double>& nodes, double value) {
  const auto above = std::ranges::upper_bound(nodes, value);
  if (above == nodes.begin())
    return {};
  const auto lower = static_cast<std::size_t>(above - nodes.begin()) - 1;
  if (above == nodes.end())
    return {lower, lower, 0};
  return {lower, lower + 1, (value - nodes[lower]) / (nodes[lower + 1] - nodes[lower])};
}

// Where a lobe stands in the file, and what turns and mirrors it there.
struct Place {
  double alpha = 1, lambda = 1, phi = 0;
  double sign_x = 1, sign_y = 1;  // of directions
  bool swaps = false;
};
Place place_of(const Lobe& lobe, bool turns) {
  Place place;
  const Eigen::Vector3d v = lobe.omega_v();
  place.swaps = lobe.alpha_y > lobe.alpha_x;
  place.alpha = std::max(lobe.alpha_x, lobe.alpha_y);
  place.lambda = std::min(lobe.alpha_x, lobe.alpha_y) / place.alpha;
  if (turns)
    return place;
  place.sign_x = v.x() < 0 ? -1 : 1;
  place.sign_y = v.y() < 0 ? -1 : 1;
  const double x = std::abs(v.x()), y = std::abs(v.y());
  place.phi = place.swaps ? std::atan2(x, y) : std::atan2(y, x);
  if (x == 0 && y == 0)
    place.phi = 0;
  return place;
}

// One lobe of a file, as cells of light in the file's frame.
LightCells cells_of(const MeasuredBrdf& brdf, const Place& place, double theta) {
  const Bracket along[4] = {bracket(brdf.alpha, place.alpha), bracket(brdf.lambda, place.lambda),
                            bracket(brdf.theta, theta), bracket(brdf.phi, place.phi)};
  const std::size_t rows = brdf.theta_light.size(), columns = brdf.phi_light.size();
  std::vector<double> lobe(rows * columns);
  for (unsigned corner = 0; corner < 16; ++corner) {
    std::size_t flat = 0;
    double share = 1;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const bool upper = corner >> axis & 1;
      share *= upper ? along[axis].share : 1 - along[axis].share;
      flat = flat * brdf.shape()[axis] + (upper ? along[axis].upper : along[axis].lower);
    }
    if (share == 0)
      continue;
    const float* const values = brdf.values.data() + flat * lobe.size();
    for (std::size_t i = 0; i < lobe.size(); ++i)
      lobe[i] += share * static_cast<double>(values[i]);
  }

  // Rows at both ends of the hemisphere where the file has none, and the turn closed.
  std::vector<double> heights, azimuths = brdf.phi_light;
  std::vector<std::size_t> row_of, column_of(columns);
  if (brdf.theta_light.front() > 0) {
    heights.push_back(1);
    row_of.push_back(0);
  }
  const bool at_horizon = brdf.theta_light.back() >= pi / 2 - 1e-6;
  for (std::size_t i = 0; i < rows; ++i) {
    heights.push_back(at_horizon && i + 1 == rows ? 0 : std::cos(brdf.theta_light[i]));
    row_of.push_back(i);
  }
  if (!at_horizon) {
    heights.push_back(0);
    row_of.push_back(rows - 1);
  }
  std::iota(column_of.begin(), column_of.end(), 0);
  if (brdf.turns()) {
    for (std::size_t j = columns - 1; j-- > 0;) {
      azimuths.push_back(2 * pi - brdf.phi_light[j]);
      column_of.push_back(j);
    }
  } else {
    azimuths.push_back(brdf.phi_light[0] + 2 * pi);
    column_of.push_back(0);
  }
  std::vector<double> values;
  for (const std::size_t row : row_of)
    for (const std::size_t column : column_of)
      values.push_back(lobe[row * columns + column]);
  return {std::move(heights), std::move(azimuths), std::move(values), CellMeasure::projected};
}

// A sample's weight is the BRDF there over the mean of its cell's corners, times the albedo.
class MeasuredSampler final : public LobeSampler {
 public:
  MeasuredSampler(const Lobe& lobe, const MeasuredBrdf& brdf)
      : LobeSampler(lobe.omega_v(), Eigen::Vector3d::UnitZ()),
        turns_(brdf.turns()),
        place_(place_of(lobe, turns_)),
        along_(omega_v().head<2>().norm() > 0 ? omega_v().head<2>().normalized().eval()
                                              : Eigen::Vector2d::UnitX()),
        cells_(cells_of(brdf, place_, lobe.theta_radians)) {}

  LobeDensities densities(const Eigen::Vector3d& omega_l) const override {
    if (!(omega_l.z() > 0))
      return {};
    const Eigen::Vector3d l = to_file(omega_l);
    const LightCells::Spot spot = cells_.spot_of(l.z(), std::atan2(l.y(), l.x()));
    return {value_at(spot) * omega_l.z(), cells_.density(spot)};
  }
  double most_weight() const override { return cells_.total() * cells_.steepest(); }

  // By Gauss's rule with so many points along both sides of every cell, within which the BRDF has
  // no edges.
  Albedo albedo(std::size_t points_a_side) const {
    const std::vector<GaussNode> nodes = gauss_nodes_of_unit(points_a_side);
    const std::vector<double>&heights = cells_.heights(), &azimuths = cells_.azimuths();
    Albedo sum;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i)
      for (std::size_t j = 0; j + 1 < azimuths.size(); ++j)
        for (const GaussNode& up : nodes)
          for (const GaussNode& along : nodes) {
            const double rise = heights[i] - heights[i + 1], width = azimuths[j + 1] - azimuths[j];
            const LightCells::Spot spot{i, j, heights[i + 1] + up.place * rise,
                                        azimuths[j] + along.place * width};
            const double value =
                value_at(spot) * spot.height * up.weight * rise * along.weight * width;
            const Eigen::Vector3d half = omega_v() + direction(spot);
            sum.amplitude += value;
            sum.fresnel += value * std::pow(1 - omega_v().dot(half) / half.norm(), 5);
          }
    return sum;
  }

  using LobeSampler::sample;
  LobeSample sample(double cos_azimuth, double sin_azimuth, double u_height) const override {
    const LightCells::Spot spot = cells_.draw(cos_azimuth, sin_azimuth, u_height);
    return sample_about_normal(omega_v(), direction(spot), value_at(spot),
                               cells_.per_measure(spot));
  }

 private:
  Eigen::Vector3d direction(const LightCells::Spot& spot) const {
    const double sine = std::sqrt((1 - spot.height) * (1 + spot.height));
    return to_tangent({sine * std::cos(spot.azimuth), sine * std::sin(spot.azimuth), spot.height});
  }

  // From the file's frame, and into it.
  Eigen::Vector3d to_tangent(const Eigen::Vector3d& there) const {
    if (turns_)
      return {along_.x() * there.x() - along_.y() * there.y(),
              along_.y() * there.x() + along_.x() * there.y(), there.z()};
    const double x = place_.swaps ? there.y() : there.x(), y = place_.swaps ? there.x() : there.y();
    return {place_.sign_x * x, place_.sign_y * y, there.z()};
  }
  Eigen::Vector3d to_file(const Eigen::Vector3d& here) const {
    if (turns_)
      return {along_.x() * here.x() + along_.y() * here.y(),
              along_.x() * here.y() - along_.y() * here.x(), here.z()};
    const double x = place_.sign_x * here.x(), y = place_.sign_y * here.y();
    return {place_.swaps ? y : x, place_.swaps ? x : y, here.z()};
  }

  // Linear in elevation and azimuth between the cell's corners.
  double value_at(const LightCells::Spot& spot) const {
    const std::size_t i = spot.row, j = spot.column;
    const auto elevation = [](double height) { return std::acos(std::clamp(height, 0.0, 1.0)); };
    const double first = elevation(cells_.heights()[i]), last = elevation(cells_.heights()[i + 1]);
    const double s = std::clamp((elevation(spot.height) - first) / (last - first), 0.0, 1.0);
    const double left = cells_.azimuths()[j], right = cells_.azimuths()[j + 1];
    const double t = std::clamp((spot.azimuth - left) / (right - left), 0.0, 1.0);
    const auto along_row = [&](std::size_t row) {
      return (1 - t) * cells_.value(row, j) + t * cells_.value(row, j + 1);
    };
    return (1 - s) * along_row(i) + s * along_row(i + 1);
  }

  bool turns_;
  Place place_;
  Eigen::Vector2d along_;  // the view's azimuth
  LightCells cells_;
};

class MeasuredModel final : public LobeModel {
 public:
  explicit MeasuredModel(std::string name) : name_(std::move(name)) {}

  std::string_view name() const override { return name_; }
  // Beyond the axes as at their ends: pictures and judges look a little further than tables reach.
  std::unique_ptr<LobeSampler> sampler(const Lobe& lobe) const override {
    return std::make_unique<MeasuredSampler>(lobe, brdf());
  }

  // A finer rule takes more points of each cell.
  Albedo albedo(const Lobe& lobe, const AlbedoRule& rule) const override {
    return MeasuredSampler(lobe, brdf()).albedo(rule.size() > AlbedoRule::default_points ? 4 : 3);
  }

  // Nothing is known of where the lobe will be.
  Eigen::Matrix3d frame(const Lobe&) const override { return Eigen::Matrix3d::Identity(); }
  Eigen::Vector3d widths(const Lobe&) const override { return Eigen::Vector3d::Ones(); }
  Eigen::Matrix3d first_order(const Lobe&) const override { return Eigen::Matrix3d::Identity(); }
  bool about_mirror() const override { return false; }
  bool conserves_energy() const override { return false; }

  void require(const Lobe& lobe) const override {
    const MeasuredBrdf& file = brdf();
    const Place place = place_of(lobe, file.turns());
    require_within("roughness", place.alpha, file.alpha, roughness_tolerance, true);
    require_within("ratio of roughnesses", place.lambda, file.lambda, roughness_tolerance, false);
    require_within("view elevation, in radians,", lobe.theta_radians, file.theta, angle_tolerance,
                   false);
    if (!file.turns())
      require_within("view azimuth, in radians,", place.phi, file.phi, angle_tolerance, false);
  }

 private:
  // An axis of one roughness serves every one: the material has no such parameter.
  void require_within(std::string_view what, double value, const std::vector<double>& axis,
                      double tolerance, bool any_if_one) const {
    if (any_if_one && axis.size() == 1)
      return;
    if (!(value >= axis.front() - tolerance && value <= axis.back() + tolerance))
      throw InputError(
          fmt::format("BRDF \"{}\": a lobe of the {} {:.6g}; the file has {:.6g} to "
                      "{:.6g}",
                      name_, what, value, axis.front(), axis.back()));
  }

  const MeasuredBrdf& brdf() const {
    std::call_once(read_, [this] { brdf_ = read_brdf(name_); });
    return brdf_;
  }

  std::string name_;
  mutable std::once_flag read_;
  mutable MeasuredBrdf brdf_;
};

void require_axis(const std::vector<double>& nodes, std::string_view name, double least,
                  double most, const std::string& source) {
  constexpr double tolerance = 1e-6;  // of ends that were written in single precision
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!(nodes[i] >= least - tolerance && nodes[i] <= most + tolerance) ||
        (i > 0 && !(nodes[i] > nodes[i - 1])))
      throw InputError(
          fmt::format("{}: {} has {} as value {}; expected values that rise strictly "
                      "within {:.6g} to {:.6g}",
                      source, name, nodes[i], i, least, most));
}

}  // namespace

void require_sound(const MeasuredBrdf& brdf, const std::string& source) {
  require_axis(brdf.alpha, "alpha", 0, 1, source);
  require_axis(brdf.lambda, "lambda", 0, 1, source);
  require_axis(brdf.theta, "theta", 0, pi / 2, source);
  require_axis(brdf.phi, "phi", 0, pi / 2, source);
  require_axis(brdf.theta_light, "theta_light", 0, pi / 2, source);
  require_axis(brdf.phi_light, "phi_light", 0, brdf.turns() ? pi : 2 * pi, source);
  if (brdf.theta_light.size() < 2 || brdf.phi_light.size() < 2)
    throw InputError(
        fmt::format("{}: {} elevations and {} azimuths of light; expected at least 2 "
                    "each",
                    source, brdf.theta_light.size(), brdf.phi_light.size()));
  const auto require_only = [&](const std::vector<double>& axis, std::string_view name,
                                double value) {
    if (axis.size() == 1 && std::abs(axis[0] - value) > 1e-6)
      throw InputError(
          fmt::format("{}: the one value of {} is {}; expected {}, as of isotropic "
                      "lobes, or more values",
                      source, name, axis[0], value));
  };
  require_only(brdf.phi, "phi", 0);
  require_only(brdf.lambda, "lambda", 1);
  const double first = brdf.phi_light.front(), last = brdf.phi_light.back();
  if (brdf.turns() ? first > 1e-6 || last < pi - 1e-6 : last - first > 2 * pi - 1e-6)
    throw InputError(fmt::format("{}: phi_light from {:.6g} to {:.6g}; expected {}", source, first,
                                 last,
                                 brdf.turns() ? "0 to pi, since phi has one value"
                                              : "less than a turn: its first value closes it"));
  const auto indices_of = [&](std::size_t flat) {
    const std::vector<std::size_t> shape = brdf.shape();
    std::vector<std::size_t> indices(shape.size());
    for (std::size_t axis = shape.size(); axis-- > 0; flat /= shape[axis])
      indices[axis] = flat % shape[axis];
    return indices;
  };
  const std::size_t lobe = brdf.theta_light.size() * brdf.phi_light.size();
  for (std::size_t i = 0; i < brdf.values.size(); i += lobe) {
    bool any = false;
    for (std::size_t j = i; j < i + lobe; ++j) {
      if (!(brdf.values[j] >= 0 && std::isfinite(brdf.values[j])))
        throw InputError(fmt::format(
            "{}: values[{}] is {}; expected finite ones in single precision, not negative", source,
            fmt::join(indices_of(j), ", "), brdf.values[j]));
      any = any || brdf.values[j] > 0;
    }
    if (!any)
      throw InputError(
          fmt::format("{}: the lobe of values[{}] reflects nothing; expected some "
                      "value above 0",
                      source, fmt::join(indices_of(i), ", ")));
  }
}

bool names_brdf_file(std::string_view name) {
  return name.ends_with(".h5") || name.ends_with(".hdf5");
}

const LobeModel& measured(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, MeasuredModel, std::less<>> models;
  const std::lock_guard lock(mutex);
  const auto found = models.find(name);
  return found != models.end()
             ? found->second
             : models.try_emplace(std::string(name), std::string(name)).first->second;
}

}  // namespace ltc
