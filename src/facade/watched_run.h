// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Long work under the eyes of a caller's function.
#pragma once

#include <functional>

#include "core/progress.h"
#include "ltcfit/ltcfit.h"

namespace ltcfit {

// The threads that the run asks for, one a processor where it says nothing. Throws InputError for
// fewer than 0 or more than 1024.
int thread_count(const Run& run);

// Does the work, on a thread of its own while `run.progress` is called on this one; without it,
// here. What either throws comes through, that of `run.progress` first.
void do_watched(const Run& run, const std::function<void(ltc::Progress*)>& work);

}  // namespace ltcfit
