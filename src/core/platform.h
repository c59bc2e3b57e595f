// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// All that differs between operating systems: durable renames, signals, the terminal, the process's
// memory and clock. Nothing else in the project includes a platform header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ltc::platform {

// Files that take their places together, once all of them are written: as long as anything can
// still fail for want of space, every older file stands as it was.
//
// Temporary files are known to end_process() as long as they may be there.
class FileSet {
 public:
  FileSet() = default;
  ~FileSet();  // removes what was written and not committed
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  // Calls `write` with the name of a temporary file in the same folder as `path` and flushes what
  // it wrote to the disk. Throws IoError on what the system refuses and for a `path` that is a
  // device, a pipe or a folder; lets `write`'s own exceptions through; the temporary file is then
  // gone.
  void add(const std::filesystem::path& path,
           const std::function<void(const std::filesystem::path&)>& write);

  // Has `path` removed, if there is such a file, before the others take their places.
  void remove(const std::filesystem::path& path) { removed_.push_back(path); }

  // Removes what is to be removed, then renames all to their paths, in the order they were added.
  // Throws IoError if a name is refused; the files before it have then taken their places.
  void commit();

 private:
  struct File {
    std::filesystem::path temporary, path;
  };
  std::vector<File> written_;
  std::vector<std::filesystem::path> removed_;
};

// Removes temporary files that processes left beside `path` when they were killed while writing it.
// Only for who knows that nobody writes `path` now.
void remove_abandoned_temporaries(const std::filesystem::path& path);

// Keeps other processes that ask for the same from working in a folder while it lives. The system
// gives the lock back when the process ends, however it ends, and nothing lies in the folder for
// it. On a file system without locks it does nothing.
class FolderLock {
 public:
  // With `shared`, others that ask so may work there too. Throws IoError if another process has the
  // lock or the folder cannot be opened.
  explicit FolderLock(const std::filesystem::path& folder, bool shared = false);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

// From now on, writing beyond the size that the user allows for files (ulimit -f), or to a reader
// that has gone, is an error of the write, and no longer ends the process.
void report_failed_writes_as_errors();

// Standard streams that the process was started without are taken, so that no file that is opened
// later gets their place and with it what is meant for them. They cannot be read or written still.
void occupy_closed_standard_streams();

// Creates the folder and its parents if need be and proves that a file can be created in it.
// Throws IoError naming the folder and the reason.
void require_writable_folder(const std::filesystem::path& folder);

// Proves that `path` can be written by FileSet::add: that its folder is there and takes a file of
// such a name. Throws IoError naming the path and the reason.
void require_writable_file(const std::filesystem::path& path);

// The first min(size, most_bytes) bytes of a file or a pipe. Throws std::system_error on what the
// system refuses, and Interrupted where an interrupt comes during the wait for a pipe's writer.
std::string read_up_to(const std::filesystem::path& path, std::size_t most_bytes);

// From now on an interrupt (Ctrl-C, SIGTERM, a terminal that closes) calls `handler`, which may
// only touch lock-free atomics; a second one ends the process as it would have without the handler.
// What this process was started to ignore stays ignored.
void on_interrupt(void (*handler)());

// Waits for an interrupt of which on_interrupt() told, or for end_wait_for_interrupt(). One thread.
void wait_for_interrupt();
void end_wait_for_interrupt();

// Ends the process with this exit code, whatever its other threads do: first removes the temporary
// files of all FileSets and writes `message` to standard error. Nothing else is cleaned up.
[[noreturn]] void end_process(int exit_code, const std::string& message);

// What a piece of work may use up.
struct WorkLimits {
  std::size_t memory_bytes;  // beyond what this process has now
  unsigned processor_seconds;
};

// The text that `work` returns, worked out in a copy of this process, which nothing that becomes of
// the copy can harm; it has none of this process's open files and locks. Nothing if the copy
// crashed, threw, or went beyond a limit; what it says on standard output and standard error is
// thrown away. Not while other threads hold locks that `work` takes. Throws IoError if the system
// refuses a process.
std::optional<std::string> in_a_process_apart(const std::function<std::string()>& work,
                                              const WorkLimits& limits);

bool standard_error_is_terminal();

// Of standard error or, where that is no terminal, of standard output; 80 where neither is one.
std::size_t terminal_columns();

// The largest resident size this process has had, in bytes; 0 where the system does not say.
std::size_t peak_memory_bytes();

// How much more memory this process can have without anything being swapped out, in bytes: what the
// machine, its control group and the limit on its address space leave. The largest number there is
// where the system does not say.
std::size_t available_memory_bytes();

// One flag for each processor of the machine, up to some number that is the same everywhere:
// whether this process may use it. All 0 where the system does not say.
std::vector<std::uint8_t> allowed_processors();

// Seconds of processor time this process has used, all threads together.
double processor_seconds();

// "2026-11-22T01:02:03Z": a time in seconds since 1970, up to the year 9999; and now.
std::string utc_iso8601(std::int64_t seconds);
std::string utc_now_iso8601();

}  // namespace ltc::platform
