// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "pipeline/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/ranks.h"
#include "core/version.h"
#include "export/table_file.h"
#include "pipeline/require_model.h"
#include "scene/coverage.h"
#include "scene/query_ranges.h"
#include "table/extend.h"

namespace ltc {
namespace {

Work planned(const RunRequest& request) {
  const Config& config = request.config;
  Work work;
  work.needed.assign(config.grid.size(), true);
  if (!request.scene.empty()) {
    const Scene scene = load_scene(request.scene);
    if (request.warn)
      std::ranges::for_each(scene.warnings, request.warn);
    work.needed = needed_entries(scene, config.grid);
    work.asked = query_ranges(scene);
  }
  work.to_fit = work.needed;
  if (!request.extend.empty()) {
    if (config.field.size > 0)
      throw InputError(
          fmt::format("{}: a field is made as a whole; nothing extends it (field.size "
                      "= {}; 0 for a table)",
                      request.extend.string(), config.field.size));
    if (!is_whole_table(request.extend))
      throw InputError(fmt::format("{}: cannot be extended; expected a table's {}",
                                   request.extend.string(), endings_text(keeps_fits)));
    work.existing = read_table(request.extend);
    require_extendable(*work.existing, request.extend.string(), config.grid, config.storage);
    work.to_fit = lacking_entries(*work.existing, work.needed);
  }
  return work;
}

// All that makes one run another than the next.
std::string told(const RunRequest& request, const Work& work) {
  std::string text = generator() + to_toml(request.config);
  for (const std::vector<bool>& flags : {work.needed, work.to_fit})
    for (const bool flag : flags)
      text += flag ? '1' : '0';
  for (QueryRange range : work.asked)
    append_bytes(range, text);
  return text;
}

}  // namespace

Work plan_work(const RunRequest& request, Ranks* ranks) {
  Work work = planned(request);
  require_same(ranks, "program, config, scene or table to extend", told(request, work));
  require_model(request.config);
  require_memory(request.config, work.to_fit, work.refinement(), ranks ? ranks->size_here() : 1);
  return work;
}

}  // namespace ltc
