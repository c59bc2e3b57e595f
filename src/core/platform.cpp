// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/platform.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <semaphore.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/uninterrupted.h"

namespace ltc::platform {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_io(std::string_view what, const fs::path& path, int error) {
  throw IoError(fmt::format("{} {}: {}", what, path.string(), std::strerror(error)));
}

// fsync by name: a file's content, or a folder's list of names.
void flush_to_disk(const fs::path& path, int flags, const fs::path& shown_as) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0)
    throw_io("cannot write", shown_as, errno);
  const int failed = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  // Some file systems cannot flush a folder; that is no reason to refuse the file.
  if (failed && !(flags & O_DIRECTORY && error == EINVAL))
    throw_io("cannot write", shown_as, error);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Names of temporary files: ".<name>.<process>.tmp", so that no two processes share one.
constexpr std::string_view temporary_end = ".tmp";

std::string temporary_start(const fs::path& path) {
  return fmt::format(".{}.", path.filename().string());
}

fs::path temporary_beside(const fs::path& path) {
  return folder_of(path) / fmt::format("{}{}{}", temporary_start(path), ::getpid(), temporary_end);
}

bool is_temporary_of(const fs::path& path, std::string_view name) {
  const std::string start = temporary_start(path);
  if (name.size() <= start.size() + temporary_end.size() || !name.starts_with(start) ||
      !name.ends_with(temporary_end))
    return false;
  name.remove_prefix(start.size());
  name.remove_suffix(temporary_end.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

// Those that may be there now.
std::mutex temporaries_mutex;
std::set<fs::path> temporaries;

void note_temporary(const fs::path& path) {
  const std::lock_guard lock(temporaries_mutex);
  temporaries.insert(path);
}

void remove_temporary(const fs::path& path) {
  const std::lock_guard lock(temporaries_mutex);
  ::unlink(path.c_str());
  temporaries.erase(path);
}

void (*interrupt_handler)() = nullptr;
std::atomic<bool> was_interrupted{false};

// Posted for who waits for an interrupt: of all that wakes another thread, a signal handler may do
// this alone.
sem_t* interrupt_semaphore() {
  static sem_t semaphore;
  static const bool made = ::sem_init(&semaphore, 0, 0) == 0;
  return made ? &semaphore : nullptr;
}

extern "C" void handle_signal(int) {
  const int error = errno;
  was_interrupted = true;
  if (interrupt_handler)
    interrupt_handler();
  ::sem_post(interrupt_semaphore());
  errno = error;
}

// A device or a pipe would be replaced by a file, which is never what is meant.
void require_replaceable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_type kind = fs::status(path, ignored).type();
  const auto refuse = [&](std::string_view reason) {
    throw IoError(fmt::format("cannot write {}: {}", path.string(), reason));
  };
  // Of the system's folders too, what leads to a file: /dev/stdout.
  const std::string folder =
      fs::weakly_canonical(folder_of(fs::absolute(path, ignored)), ignored).string();
  if (kind == fs::file_type::character || kind == fs::file_type::block ||
      kind == fs::file_type::fifo || kind == fs::file_type::socket || folder == "/dev" ||
      folder.starts_with("/proc/"))
    refuse("it is a device or a pipe; expected the name of a file");
  if (kind == fs::file_type::directory)
    refuse("it is a folder; expected the name of a file");
}

// Makes an empty temporary file for `path` and removes it again; the error, or 0.
int try_to_create(const fs::path& path) {
  const fs::path probe = temporary_beside(path);
  const int descriptor = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0)
    return errno;
  ::close(descriptor);
  ::unlink(probe.c_str());
  return 0;
}

// Waits until there is something to read. In turns: an interrupt that came just before the wait
// would not end it.
void wait_for_input(int descriptor) {
  constexpr int turn_milliseconds = 50;
  pollfd waited{descriptor, POLLIN, 0};
  while (::poll(&waited, 1, turn_milliseconds) <= 0)
    if (was_interrupted)
      throw Interrupted();
}

void limit(decltype(RLIMIT_CPU) resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(resource, &both);
}

// A limit counts all of the address space, and a sanitizer has reserved terabytes of it.
void limit_memory(std::size_t beyond_now) {
  std::size_t pages_now = 0;
  if (std::ifstream("/proc/self/statm") >> pages_now)
    limit(RLIMIT_AS, pages_now * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + beyond_now);
}

// Closes all but the standard ones and `kept`, and returns what that one is called from then on.
int keep_open_only(int kept) {
  constexpr int first = STDERR_FILENO + 1;
  if (kept != first)
    ::dup2(kept, first);
  ::close_range(first + 1, ~0U, 0);
  return first;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0)
      return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t got; (got = ::read(descriptor, piece.data(), piece.size())) != 0;) {
    if (got > 0)
      text.append(piece.data(), static_cast<std::size_t>(got));
    else if (errno != EINTR)
      break;
  }
  return text;
}

// The life of the copy. It ends without a word to anyone: no handlers, no buffers flushed twice, no
// core file, nothing on the terminal.
[[noreturn]] void work_and_exit(const std::function<std::string()>& work, const WorkLimits& limits,
                                int result) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  // A lock that the copy shares would be held until its end, even where this process is killed.
  result = keep_open_only(result);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.processor_seconds);
  limit_memory(limits.memory_bytes);
  try {
    ::_exit(write_all(result, work()) ? 0 : 1);
  } catch (...) {
    ::_exit(1);
  }
}

}  // namespace

std::optional<std::string> in_a_process_apart(const std::function<std::string()>& work,
                                              const WorkLimits& limits) {
  std::array<int, 2> result{};
  if (::pipe2(result.data(), O_CLOEXEC) != 0)
    throw IoError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  const pid_t copy = ::fork();
  const int error = errno;
  if (copy == 0)
    work_and_exit(work, limits, result[1]);
  ::close(result[1]);
  std::string text = copy > 0 ? read_all(result[0]) : std::string();
  ::close(result[0]);
  if (copy < 0)
    throw IoError(fmt::format("cannot start a process: {}", std::strerror(error)));
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return std::nullopt;
  return text;
}

FileSet::~FileSet() {
  for (const File& file : written_)
    remove_temporary(file.temporary);
}

void FileSet::add(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  require_replaceable(path);
  const File file{temporary_beside(path), path};
  note_temporary(file.temporary);
  try {
    write(file.temporary);
    flush_to_disk(file.temporary, O_RDONLY, path);
    written_.push_back(file);
  } catch (...) {
    remove_temporary(file.temporary);
    throw;
  }
}

void FileSet::commit() {
  const Uninterrupted whole;
  std::set<fs::path> folders;
  for (const fs::path& path : removed_)
    if (::unlink(path.c_str()) == 0)
      folders.insert(folder_of(path));
    else if (errno != ENOENT)
      throw_io("cannot remove", path, errno);
  while (!written_.empty()) {
    const File& file = written_.front();
    if (std::rename(file.temporary.c_str(), file.path.c_str()) != 0)
      throw_io("cannot write", file.path, errno);
    folders.insert(folder_of(file.path));
    remove_temporary(file.temporary);  // which has another name now
    written_.erase(written_.begin());
  }
  for (const fs::path& folder : folders)
    flush_to_disk(folder, O_RDONLY | O_DIRECTORY, folder);
}

void remove_abandoned_temporaries(const fs::path& path) {
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(path), ignored))
    if (is_temporary_of(path, entry.path().filename().string()))
      abandoned.push_back(entry.path());
  for (const fs::path& temporary : abandoned)
    ::unlink(temporary.c_str());
}

FolderLock::FolderLock(const fs::path& folder, bool shared)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw_io("cannot open output folder", folder, errno);
  if (::flock(descriptor_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  ::close(descriptor_);
  throw IoError(
      fmt::format("another run is working in output folder {}; wait for it, or name "
                  "another folder",
                  folder.string()));
}

FolderLock::~FolderLock() {
  ::close(descriptor_);
}

void report_failed_writes_as_errors() {
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
}

void occupy_closed_standard_streams() {
  // The wrong way round, so that reading and writing them still fail.
  for (const auto& [descriptor, flags] :
       {std::pair{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_RDONLY}})
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", flags);  // gets the lowest number that is free, which is this one
}

void require_writable_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw IoError(fmt::format("output folder {} is a file; name a folder", folder.string()));
  fs::create_directories(folder, error);
  if (error)
    throw IoError(
        fmt::format("cannot create output folder {}: {}", folder.string(), error.message()));
  remove_abandoned_temporaries(folder / "probe");
  if (const int refused = try_to_create(folder / "probe"))
    throw_io("cannot write into output folder", folder, refused);
}

void require_writable_file(const fs::path& path) {
  require_replaceable(path);
  std::error_code ignored;
  if (const fs::path folder = folder_of(path); !fs::is_directory(folder, ignored))
    throw IoError(
        fmt::format("cannot write {}: there is no folder {}", path.string(), folder.string()));
  if (const int refused = try_to_create(path))
    throw_io("cannot write", path, refused);
}

std::string read_up_to(const fs::path& path, std::size_t most_bytes) {
  const auto fail = [] { throw std::system_error(errno, std::generic_category()); };
  // O_NONBLOCK: opening a pipe that nobody writes to must not wait where no interrupt ends it.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0)
    fail();
  const std::unique_ptr<const int, void (*)(const int*)> closed_at_end(
      &descriptor, [](const int* open) { ::close(*open); });
  // In pieces: most files are far smaller than the most that is allowed.
  constexpr std::size_t piece_bytes = 1 << 20;
  std::string content;
  while (content.size() < most_bytes) {
    wait_for_input(descriptor);
    const std::size_t begin = content.size();
    content.resize(begin + std::min(piece_bytes, most_bytes - begin));
    const ssize_t got = ::read(descriptor, content.data() + begin, content.size() - begin);
    if (got < 0 && errno != EAGAIN && errno != EINTR)
      fail();
    content.resize(begin + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0)
      break;
  }
  return content;
}

void on_interrupt(void (*handler)()) {
  interrupt_semaphore();  // made before a handler wants it
  interrupt_handler = handler;
  struct sigaction action {};
  action.sa_handler = handle_signal;
  // SA_RESETHAND: a second signal finds the default action, for the impatient.
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)  // by nohup, or a shell that works in the background
      ::sigaction(signal, &action, nullptr);
  }
}

void wait_for_interrupt() {
  while (::sem_wait(interrupt_semaphore()) != 0 && errno == EINTR) {
  }
}

void end_wait_for_interrupt() {
  ::sem_post(interrupt_semaphore());
}

void end_process(int exit_code, const std::string& message) {
  // Kept: no other thread makes one any more.
  temporaries_mutex.lock();
  for (const fs::path& temporary : temporaries)
    ::unlink(temporary.c_str());
  write_all(STDERR_FILENO, message);
  std::_Exit(exit_code);
}

bool standard_error_is_terminal() {
  return ::isatty(STDERR_FILENO) != 0;
}

std::size_t terminal_columns() {
  winsize size{};
  for (const int descriptor : {STDERR_FILENO, STDOUT_FILENO})
    if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
      return size.ws_col;
  return 80;
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0)
    return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

namespace {

// The number that a file begins with, or that follows a word in it; none of "max".
std::optional<std::size_t> number_in(const fs::path& file, const std::string& word = "") {
  std::ifstream stream(file);
  std::string read;
  while (!word.empty() && stream >> read && read != word) {
  }
  std::size_t number = 0;
  return stream >> number ? std::optional(number) : std::nullopt;
}

// What the control group in this folder, of version 2, leaves its processes; files that it caches
// give way.
std::optional<std::size_t> memory_left_in(const fs::path& group) {
  const auto limit = number_in(group / "memory.max"), used = number_in(group / "memory.current");
  if (!limit || !used)
    return std::nullopt;
  const std::size_t cached = number_in(group / "memory.stat", "inactive_file").value_or(0);
  const std::size_t needed = *used - std::min(*used, cached);
  return *limit - std::min(*limit, needed);
}

}  // namespace

std::size_t available_memory_bytes() {
  std::size_t available = std::numeric_limits<std::size_t>::max();
  const auto bound = [&](std::optional<std::size_t> bytes) {
    available = std::min(available, bytes.value_or(available));
  };
  if (const auto kilobytes = number_in("/proc/meminfo", "MemAvailable:"))
    bound(*kilobytes * 1024);
  const fs::path root = "/sys/fs/cgroup";
  bound(memory_left_in(root));
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);)
    if (line.starts_with("0::/"))
      for (fs::path group = line.substr(4); !group.empty(); group = group.parent_path())
        bound(memory_left_in(root / group));
  rlimit limit{};
  const auto used = number_in("/proc/self/statm");  // pages of address space
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && used) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    bound(limit.rlim_cur - std::min<std::size_t>(limit.rlim_cur, *used * page));
  }
  return available;
}

std::vector<std::uint8_t> allowed_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) != 0)
    CPU_ZERO(&allowed);
  std::vector<std::uint8_t> flags;
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor)
    flags.push_back(CPU_ISSET(processor, &allowed) ? 1 : 0);
  return flags;
}

double processor_seconds() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0)
    return 0;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string utc_iso8601(std::int64_t seconds) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

std::string utc_now_iso8601() {
  return utc_iso8601(std::time(nullptr));
}

}  // namespace ltc::platform
