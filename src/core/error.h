// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The errors of the library, which its users catch too.
#pragma once

#include "ltcfit/error.h"
