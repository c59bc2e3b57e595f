// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/hdf5_guard.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/platform.h"

namespace ltc {
namespace {

// The first letter of what the copy says: how it fared.
constexpr char read_whole = 'r', refused = 'i', unreadable = 'o';

std::string outcome_of(const std::function<void()>& read) {
  try {
    read();
    return {read_whole};
  } catch (const InputError& error) {
    return refused + std::string(error.what());
  } catch (const IoError& error) {
    return unreadable + std::string(error.what());
  }
}

// A table is read into memory about as large as its file; a library's own structures are small.
platform::WorkLimits limits_for(std::uintmax_t file_bytes) {
  constexpr std::size_t base_bytes = std::size_t{512} << 20;
  constexpr std::size_t bytes_per_second = std::size_t{20} << 20;
  return {base_bytes + 4 * static_cast<std::size_t>(file_bytes),
          10 + static_cast<unsigned>(file_bytes / bytes_per_second)};
}

}  // namespace

void require_harmless(const std::filesystem::path& path, const std::function<void()>& read) {
  const platform::WorkLimits limits = limits_for(require_readable(path));
  const std::optional<std::string> outcome =
      platform::in_a_process_apart([&] { return outcome_of(read); }, limits);
  if (!outcome || outcome->empty())
    throw InputError(
        fmt::format("{}: damaged: the HDF5 library cannot cope with it", path.string()));
  if (outcome->front() == refused)
    throw InputError(outcome->substr(1));
  if (outcome->front() == unreadable)
    throw IoError(outcome->substr(1));
}

}  // namespace ltc
