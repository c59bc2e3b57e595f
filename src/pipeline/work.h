// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What a scene and an existing table leave to do of a run (pipeline/run.h).
#pragma once

#include <optional>
#include <vector>

#include "pipeline/generate.h"
#include "pipeline/run.h"
#include "table/table.h"

namespace ltc {

struct Work {
  std::vector<bool> needed;  // by the scene
  std::vector<bool> to_fit;  // needed and not in the existing table
  std::optional<Table> existing;
  std::vector<QueryRange> asked;  // by the scene's materials; none without a scene

  RefineContext refinement() const { return {asked, existing ? &*existing : nullptr}; }
};

// Throws as load_scene, read_table and require_extendable; InputError where ranks do not plan the
// same, or where it would take more memory than there is.
Work plan_work(const RunRequest& request, Ranks* ranks);

}  // namespace ltc
