// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// From what was judged one by one to the figures of a quality report, and the limits set to them.
#pragma once

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "judge/quality.h"

namespace ltc {

// Sets everything in the report that follows from its node losses, floors and queries.
void summarize_quality(QualityReport& report);

// The largest means that a table may have; each is compared with what the report has by that name.
struct QualityThresholds {
  double node_loss = 0.07;
  double query_loss = 0.13;
  double area_light_error = 0.026;

  bool operator==(const QualityThresholds&) const = default;
};

struct ThresholdCheck {
  std::string key;   // as in the settings' file
  std::string what;  // in words
  double value = 0;  // NaN where nothing could be judged, or next to nothing
  double limit = 0;
  bool passed = true;  // what could not be judged fails only where it is demanded
  std::string reason;  // why no limit is set, in words, for whoever knows; empty where one is

  bool judged() const { return !std::isnan(value); }
  // Whether `passed` says anything: of a failure, and of what was judged by a limit.
  bool has_verdict() const { return !passed || (judged() && reason.empty()); }
};
// `demanded` are the keys of limits that somebody asked for; those that nobody did may be without
// anything to judge.
std::vector<ThresholdCheck> check_thresholds(const QualityReport& report,
                                             const QualityThresholds& thresholds,
                                             const std::set<std::string>& demanded = {});

// "passed", "FAILED", "not judged".
std::string verdict_text(const ThresholdCheck& check);

// "mean relative loss between nodes is 0.31, above quality.query_loss = 0.13".
std::string failure_line(const ThresholdCheck& check);

// "0.1–0.2", "> 75°".
std::string band_text(const Bands& bands, const Band& band);

}  // namespace ltc
