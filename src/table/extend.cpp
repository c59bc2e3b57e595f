// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "table/extend.h"

#include "brdf/lobe_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/angle.h"
#include "core/error.h"

namespace ltc {
namespace {

void require_same(std::string_view source, std::string_view what, const std::string& found,
                  const std::string& expected, bool same) {
  if (!same)
    throw InputError(
        fmt::format("{}: cannot be extended: its {} is {}; expected {}, as in the "
                    "config of this run",
                    source, what, found, expected));
}

std::string text_of(const Axis& axis, double unit) {
  std::string text = fmt::format("{} nodes from {} to {}, {}", axis.size(), axis.first() / unit,
                                 axis.last() / unit, name_of(axis.warp));
  // A file may place its nodes where no warp does.
  const Axis regular = Axis::make(axis.first(), axis.last(), axis.size(), axis.warp);
  return axis == regular ? text : text + " but for its nodes";
}

// The text as a comment of TOML.
std::string commented(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    result += fmt::format("#{}{}\n", line.empty() ? "" : " ", line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return result;
}

std::string config_with_history(const Table& existing, const Table& additions) {
  const std::string whence =
      fmt::format("Extends a table of {} by {}", existing.created, existing.generator);
  // The same config need not be said twice; what follows it is the history before.
  if (existing.config.starts_with(additions.config))
    return fmt::format("{}\n{}{}", additions.config, commented(whence + ", of the same config."),
                       existing.config.substr(additions.config.size()));
  return fmt::format("{}\n{}", additions.config,
                     commented(fmt::format("{}, of this config:\n{}", whence, existing.config)));
}

// Of two that may not be known.
std::optional<bool> either(std::optional<bool> a, std::optional<bool> b) {
  if (a == true || b == true)
    return true;
  return a && b ? std::optional(false) : std::nullopt;
}

template <typename T>
void copy_entry(const std::vector<T>& from, std::vector<T>& to, std::size_t flat,
                std::size_t values = 1) {
  std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(values * flat), values,
              to.begin() + static_cast<std::ptrdiff_t>(values * flat));
}

void copy_entry(const Table& from, Table& to, std::size_t flat) {
  copy_entry(from.stored, to.stored, flat, 9);
  copy_entry(from.amplitude, to.amplitude, flat);
  copy_entry(from.fresnel, to.fresnel, flat);
  copy_entry(from.sw_loss, to.sw_loss, flat);
  copy_entry(from.status, to.status, flat);
  copy_entry(from.iterations, to.iterations, flat);
  if (is_folded(from))
    copy_entry(from.fold, to.fold, flat, 2);
}

}  // namespace

void require_extendable(const Table& existing, std::string_view source, const Grid& grid,
                        Storage storage) {
  require_same(source, "BRDF", fmt::format("\"{}\"", existing.grid.model->name()),
               fmt::format("\"{}\"", grid.model->name()), existing.grid.model == grid.model);
  require_same(source, "storage", fmt::format("\"{}\"", name_of(existing.storage)),
               fmt::format("\"{}\"", name_of(storage)), existing.storage == storage);
  const auto require_same_axis = [&](std::string_view what, const Axis& found, const Axis& expected,
                                     double unit) {
    require_same(source, what, text_of(found, unit), text_of(expected, unit), found == expected);
  };
  require_same_axis("alpha axis", existing.grid.alpha, grid.alpha, 1);
  require_same_axis("lambda axis", existing.grid.lambda, grid.lambda, 1);
  require_same_axis("theta axis (in degrees)", existing.grid.theta, grid.theta, radians_per_degree);
  require_same_axis("phi axis (in degrees)", existing.grid.phi, grid.phi, radians_per_degree);
  require_same(source, "alpha_min", fmt::format("{}", existing.grid.alpha_min),
               fmt::format("{}", grid.alpha_min), existing.grid.alpha_min == grid.alpha_min);
}

std::vector<bool> lacking_entries(const Table& existing, const std::vector<bool>& needed) {
  std::vector<bool> lacking(needed.size());
  for (std::size_t flat = 0; flat < needed.size(); ++flat)
    lacking[flat] = needed[flat] && existing.status[flat] == Status::skipped;
  return lacking;
}

Table extended(const Table& existing, const Table& additions) {
  require_extendable(existing, "the table", additions.grid, additions.storage);
  Table result = additions;
  bool adds = false;
  for (std::size_t flat = 0; flat < existing.status.size(); ++flat)
    if (existing.status[flat] != Status::skipped)
      copy_entry(existing, result, flat);
    else
      adds = adds || additions.status[flat] != Status::skipped;
  if (!adds)
    return existing;
  result.config = config_with_history(existing, additions);
  result.refined = either(existing.refined, additions.refined);
  return result;
}

}  // namespace ltc
