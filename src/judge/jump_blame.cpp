// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/jump_blame.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

namespace ltc {
namespace {

constexpr std::size_t axes = Grid::axis_count;
constexpr std::size_t most_bridged = 1000;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Blame {
 public:
  Blame(const Grid& grid, std::vector<float>& jumps)
      : grid_(grid),
        jumps_(jumps),
        aside_(grid.size()),
        values_(grid.size(), nan),
        strides_(grid.strides()) {
    std::vector<Jump> all;
    for (std::size_t link = 0; link < jumps.size(); ++link)
      if (!std::isnan(jumps[link])) {
        all.emplace_back(jumps[link], link);
        const std::size_t flat = link / axes;
        values_[flat] = values_[flat - strides_[link % axes]] = 0;
      }
    largest_ = std::priority_queue<Jump>(std::less<Jump>(), std::move(all));
  }

  std::vector<double> run(double suspicious,
                          const std::function<double(std::size_t, std::size_t)>& jump_between) {
    std::size_t bridged = 0;
    while (!largest_.empty()) {
      const auto [jump, link] = largest_.top();
      largest_.pop();
      // One of the two is put aside, or its side is bridged: that jump stands no more.
      if (aside_[link / axes] || jumps_[link] != jump)
        continue;
      const std::size_t after = link / axes, before = *before_of(after, link % axes);
      const std::size_t blamed = mean_jump(after) >= mean_jump(before) ? after : before;
      values_[blamed] = jump;
      const bool bridge = jump > suspicious && bridged < most_bridged;
      put_aside(blamed, bridge ? &jump_between : nullptr);
      bridged += bridge;
    }
    return std::move(values_);
  }

 private:
  using Jump = std::pair<float, std::size_t>;  // and its place in jumps_

  // The nearest entry that is not put aside, along an axis; none where there is no jump to it.
  std::optional<std::size_t> before_of(std::size_t flat, std::size_t axis) const {
    if (std::isnan(jumps_[axes * flat + axis]))
      return std::nullopt;
    do
      flat -= strides_[axis];
    while (aside_[flat]);
    return flat;
  }
  std::optional<std::size_t> after_of(std::size_t flat, std::size_t axis) const {
    auto after = grid_.after(flat, axis);
    while (after && aside_[*after])
      after = grid_.after(*after, axis);
    return after && std::isnan(jumps_[axes * *after + axis]) ? std::nullopt : after;
  }

  double mean_jump(std::size_t flat) const {
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](float jump) {
      sum += jump;
      ++count;
    };
    for (std::size_t axis = 0; axis < axes; ++axis) {
      if (before_of(flat, axis))
        add(jumps_[axes * flat + axis]);
      if (const auto after = after_of(flat, axis))
        add(jumps_[axes * *after + axis]);
    }
    return sum / static_cast<double>(count);
  }

  void put_aside(std::size_t flat,
                 const std::function<double(std::size_t, std::size_t)>* jump_between) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto before = before_of(flat, axis), after = after_of(flat, axis);
      if (!after)
        continue;
      const std::size_t link = axes * *after + axis;
      jumps_[link] =
          static_cast<float>(before && jump_between ? (*jump_between)(*before, *after) : nan);
      if (!std::isnan(jumps_[link]))
        largest_.emplace(jumps_[link], link);
    }
    aside_[flat] = true;
  }

  const Grid& grid_;
  std::vector<float>& jumps_;
  std::vector<bool> aside_;
  std::vector<double> values_;
  const std::array<std::size_t, axes> strides_;
  std::priority_queue<Jump> largest_;
};

}  // namespace

std::vector<double> blame_jumps(
    const Grid& grid, std::vector<float> jumps, double suspicious,
    const std::function<double(std::size_t, std::size_t)>& jump_between) {
  return Blame(grid, jumps).run(suspicious, jump_between);
}

}  // namespace ltc
