// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What fit tells of a lobe: text, JSON, the trace, the words and the chart of its picture.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/gradient_check.h"
#include "picture/chart.h"
#include "pipeline/fit_one.h"
#include "report/lobe_picture.h"

namespace ltc::cli {

// "first-order", "moments", "identity", "random", as in configs.

struct FitReport {
  LobeFit fit;
  FitSettings settings;
  Storage storage = Storage::matrix;
  Grid grid;
  bool refined = false;              // whether the config moves its table's entries after the fit
  std::optional<std::size_t> entry;  // of the grid, where it is one
  std::optional<std::size_t> representative;  // what `entry` is copied from, where it is not itself
  std::string start;                          // as asked for; empty for the solver's own
  std::optional<GradientCheck> gradient;
};

std::string report_text(const FitReport& report);
std::string report_json(const FitReport& report);  // with a line break at its end

// phase,step,loss,gradient_norm,damping,seconds,accepted; one line a step.
std::string trace_csv(const FitReport& report);

picture::Words picture_words(const FitReport& report);
std::vector<NamedLobe> pictured_lobes(const FitReport& report);
picture::Chart loss_chart(const FitReport& report);

}  // namespace ltc::cli
