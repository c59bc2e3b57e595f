// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reads the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <span>

#include "cli/files.h"

namespace ltc::cli {

// What the arguments ask for.
enum class Request { work, help, version };

// Reads arguments into the options of `app`. Throws InputError of one line for what they do not
// take.
Request read_arguments(CLI::App& app, std::span<const char* const> arguments);

// The files that the options name which were given.
void tell_files(const CLI::App& app, Files& files);

}  // namespace ltc::cli
