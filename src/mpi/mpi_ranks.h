// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The ranks of an MPI launcher. Part of the program where it is built with LTCFIT_MPI.
#pragma once

#include <memory>

#include "core/ranks.h"

namespace ltc {

// Joins the ranks that this process was started as one of; leaves them when it is destroyed. Once a
// process, in the thread that then speaks to them. Null where there are no others. MPI itself ends
// all processes where it fails.
std::unique_ptr<Ranks> join_mpi_ranks();

}  // namespace ltc
