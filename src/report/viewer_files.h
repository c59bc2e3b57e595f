// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The files of the viewer, of viewer/ and shaders/glsl, which the build puts into the program
// (cmake/embed.cmake): nothing is looked for when it runs.
#pragma once

#include <string_view>

namespace ltc {

// What a file holds, by its name without folders: "page.html". Throws InputError for others.
std::string_view viewer_file(std::string_view name);

}  // namespace ltc
