// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The readers of files that others may have made, each as a function of the file's bytes: for the
// fuzzers, and for the test that replays what they found.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ltc::fuzz {

struct Reader {
  std::string_view name;  // also of its folders in tests/fuzz/seeds and tests/fuzz/crashers
  // Reads the bytes as a file in `folder`. Whatever they are, this returns or throws InputError or
  // IoError. Throws std::logic_error if something was read that could not be worked with.
  void (*read)(const std::filesystem::path& folder, std::string_view bytes);
};

const std::vector<Reader>& readers();

// The HDF5 reader without its guard, which the library crashes with some files.
const Reader& unguarded_hdf5_reader();

// The reader of checkpoints, with and without its guard. It has no seeds among the files: a
// checkpoint is for one build of the program. The last makes one that is accepted.
const Reader& checkpoint_reader();
const Reader& unguarded_checkpoint_reader();
std::string good_checkpoint(const std::filesystem::path& folder);

// True if the bytes were accepted, false if they were refused as documented; all other exceptions
// pass.
bool accepts(const Reader& reader, const std::filesystem::path& folder, std::string_view bytes);

}  // namespace ltc::fuzz
