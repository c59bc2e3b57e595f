// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Reading input files whole, up to a size that the caller states.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ltc {

// The first min(size, most_bytes) bytes of a file. `kind` says in messages what it should be:
// "cannot read scene x.toml: ...". Throws IoError if it is missing, a folder or not readable, or a
// pipe, of which the rest could not be read afterwards.
std::string read_first_bytes(const std::filesystem::path& file, std::string_view kind,
                             std::size_t most_bytes);

// The whole of a file or a pipe; an interrupt ends the wait for its writer. Throws InputError if it
// has more than `most_bytes`, else as above.
std::string read_whole_file(const std::filesystem::path& file, std::string_view kind,
                            std::size_t most_bytes);

}  // namespace ltc
