// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Long work under the eyes of a caller's function.
#pragma once

#include <functional>

#include "core/run_context.h"
#include "ltcfit/ltcfit.h"

namespace ltcfit {

// Does the work with the threads that the run asks for, one a processor where it says nothing: on a
// thread of its own while `run.progress` is called on this one; without it, here. What either
// throws comes through, that of `run.progress` first. Throws InputError for fewer threads than 0 or
// more than 1024.
void do_watched(const Run& run, const std::function<void(const ltc::RunContext&)>& work);

}  // namespace ltcfit
