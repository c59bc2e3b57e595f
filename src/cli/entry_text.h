// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Moved: entries are written the same way in messages of the library.
#pragma once

#include "table/entry_text.h"
