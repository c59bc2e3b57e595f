// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "judge/lobe_invariants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/parallel.h"
#include "judge/jump_blame.h"
#include "judge/lobe_quantiles.h"

namespace ltc {
namespace {

constexpr std::size_t blocks = 32;
constexpr double loss_noise = 1.0 / 300, jump_noise = 0.03;  // shares of the spread
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The quantiles of all entries with one alpha.
struct Layer {
  std::vector<float> ggx, ltc;
  std::vector<double> spread;

  Layer(std::size_t entries, std::size_t size)
      : ggx(entries * size), ltc(entries * size), spread(entries) {}
};

// Works through the table alpha by alpha, with no more than two layers in memory.
class LobeMeter {
 public:
  LobeMeter(const Table& table, const std::vector<bool>& judged, const LobeEffort& effort,
            const RunContext& run)
      : table_(table),
        judged_(judged),
        prototype_(effort.samples, effort.directions, blocks),
        suspicious_(effort.suspicious_jump),
        slack_(effort.slack),
        run_(run),
        layer_entries_(table.grid.strides()[0]),
        below_(layer_entries_, prototype_.size()),
        here_(layer_entries_, prototype_.size()),
        jumps_(Grid::axis_count * table.grid.size(), static_cast<float>(nan)) {
    measures_.loss_excess.assign(table.grid.size(), nan);
  }

  LobeMeasures measure() {
    const Stage stage(run_, "lobes", table_.grid.size());
    for (std::size_t alpha = 0; alpha < table_.grid.alpha.size(); ++alpha) {
      std::swap(below_, here_);
      measure_layer(alpha * layer_entries_);
      find_jumps(alpha * layer_entries_);
    }
    measures_.neighbour_excess =
        blame_jumps(table_.grid, std::move(jumps_), suspicious_,
                    [&](std::size_t a, std::size_t b) { return jump_anew(a, b); });
    return std::move(measures_);
  }

 private:
  void measure_layer(std::size_t first) {
    parallel_for<LobeQuantiles>(
        layer_entries_, run_, [&] { return prototype_; },
        [&](std::size_t i, LobeQuantiles& quantiles) {
          const std::size_t flat = first + i;
          if (judged_[flat]) {
            const double distance = measure_entry(flat, i, quantiles, here_);
            measures_.loss_excess[flat] =
                distance / (table_.sw_loss[flat] + loss_noise * here_.spread[i]);
          }
          run_.advance();
        });
  }

  // Fills place i of a layer; the distance of the two lobes.
  double measure_entry(std::size_t flat, std::size_t i, LobeQuantiles& quantiles,
                       Layer& layer) const {
    const LobeFrame frame(table_.grid.lobe(flat));
    float* const ggx = &layer.ggx[i * prototype_.size()];
    float* const ltc = &layer.ltc[i * prototype_.size()];
    quantiles.of_ggx(frame, ggx);
    quantiles.of_ltc(frame, table_.ltc_at(flat), ltc);
    layer.spread[i] = quantiles.spread(ggx);
    return quantiles.distance(ggx, ltc);
  }

  // The jumps from each entry of the layer to those before it along the four axes.
  void find_jumps(std::size_t first) {
    for (std::size_t i = 0; i < layer_entries_; ++i) {
      const std::size_t flat = first + i;
      for (std::size_t axis = 0; axis < Grid::axis_count; ++axis)
        if (const auto before = table_.grid.before(flat, axis);
            before && judged_[flat] && judged_[*before])
          jumps_[Grid::axis_count * flat + axis] = static_cast<float>(
              axis == 0 ? jump(here_, i, below_, i) : jump(here_, i, here_, *before - first));
    }
  }

  double jump(const Layer& layer_a, std::size_t a, const Layer& layer_b, std::size_t b) const {
    const std::size_t size = prototype_.size();
    const double ltc = prototype_.distance(&layer_a.ltc[a * size], &layer_b.ltc[b * size]);
    const double ggx = prototype_.distance(&layer_a.ggx[a * size], &layer_b.ggx[b * size]);
    return std::max(ltc - slack_, 0.0) /
           (ggx + jump_noise * std::min(layer_a.spread[a], layer_b.spread[b]));
  }

  // The jump between two entries wherever they are, measured anew.
  double jump_anew(std::size_t a, std::size_t b) {
    Layer pair(2, prototype_.size());
    LobeQuantiles quantiles = prototype_;
    measure_entry(a, 0, quantiles, pair);
    measure_entry(b, 1, quantiles, pair);
    return jump(pair, 0, pair, 1);
  }

  const Table& table_;
  const std::vector<bool>& judged_;
  const LobeQuantiles prototype_;
  const double suspicious_, slack_;
  const RunContext run_;
  const std::size_t layer_entries_;
  Layer below_, here_;
  std::vector<float> jumps_;  // to the entry before, four an entry; NaN where there is none
  LobeMeasures measures_;
};

}  // namespace

LobeMeasures measure_lobes(const Table& table, const std::vector<bool>& judged,
                           const LobeEffort& effort, const RunContext& run) {
  return LobeMeter(table, judged, effort, run).measure();
}

}  // namespace ltc
