// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// All that differs between operating systems: durable renames, signals, the terminal, the process's
// memory and clock. Nothing else in the project includes a platform header.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace ltc::platform {

// Calls `write` with the name of a temporary file in the same folder as `path`, flushes what it
// wrote to the disk and renames it to `path`. If `write` throws, or the flush or the rename fails,
// the temporary file is removed and an older `path` stands as it was. Throws IoError on what the
// system refuses; lets `write`'s own exceptions through.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

// Creates the folder and its parents if need be and proves that a file can be created in it.
// Throws IoError naming the folder and the reason.
void require_writable_folder(const std::filesystem::path& folder);

// From now on an interrupt (Ctrl-C, SIGTERM) calls `handler`, which may only touch lock-free
// atomics; a second one ends the process as it would have without the handler.
void on_interrupt(void (*handler)());

// What a piece of work may use up.
struct WorkLimits {
  std::size_t memory_bytes;  // beyond what this process has now
  unsigned processor_seconds;
};

// The text that `work` returns, worked out in a copy of this process, which nothing that becomes of
// the copy can harm. Nothing if the copy crashed, threw, or went beyond a limit; what it says on
// standard output and standard error is thrown away. Not while other threads hold locks that `work`
// takes. Throws IoError if the system refuses a process.
std::optional<std::string> in_a_process_apart(const std::function<std::string()>& work,
                                              const WorkLimits& limits);

// Whether standard error is a terminal, and how many columns it has (80 where it does not say).
bool standard_error_is_terminal();
std::size_t terminal_columns();

// The largest resident size this process has had, in bytes; 0 where the system does not say.
std::size_t peak_memory_bytes();

// Seconds of processor time this process has used, all threads together.
double processor_seconds();

// "2026-11-22T01:02:03Z".
std::string utc_now_iso8601();

}  // namespace ltc::platform
