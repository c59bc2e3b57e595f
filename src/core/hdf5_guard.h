// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A guard around the HDF5 library, which crashes on many a damaged file.
#pragma once

#include <filesystem>
#include <functional>

namespace ltc {

// Calls `read`, which reads the file by the library, in a copy of this process first, with bounds
// on its memory and time. If the copy comes to its end, the same steps on the same memory come to
// their end here too. Throws what `read` threw there if that was InputError or IoError, and
// InputError if the copy crashed or went beyond its bounds.
void require_harmless(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace ltc
