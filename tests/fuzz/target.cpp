// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// libFuzzer's entry to one reader, whose name is compiled in as LTCFIT_FUZZED_READER.
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "fuzz/hdf5_checksums.h"
#include "fuzz/readers.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

namespace fs = std::filesystem;
using namespace ltc::fuzz;

constexpr std::string_view fuzzed = LTCFIT_FUZZED_READER;

const Reader& fuzzed_reader() {
  if (fuzzed == "hdf5")  // of what happens in the guard's process, a fuzzer learns nothing
    return unguarded_hdf5_reader();
  if (fuzzed == "checkpoint")
    return unguarded_checkpoint_reader();
  return *std::find_if(readers().begin(), readers().end(),
                       [](const Reader& reader) { return reader.name == fuzzed; });
}

// One for each process, so that several can work at a time.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("ltcfit-fuzz-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const fs::path& folder() {
  static const Folder own;
  return own.path();
}

constexpr bool is_hdf5 = fuzzed == "hdf5" || fuzzed == "checkpoint";

std::size_t copy(std::string_view bytes, std::uint8_t* data, std::size_t most) {
  const std::size_t size = std::min(bytes.size(), most);
  std::copy_n(bytes.begin(), size, data);
  return size;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  accepts(fuzzed_reader(), folder(), {reinterpret_cast<const char*>(data), size});
  return 0;
}

// HDF5 refuses what has a wrong checksum at once: most mutations would go no further.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (!is_hdf5)
    return LLVMFuzzerMutate(data, size, most);
  // A search without seeds starts from nothing; a checkpoint of this build is found nowhere else.
  if (fuzzed == "checkpoint" && size < 8)
    return copy(good_checkpoint(folder()), data, most);
  const auto blocks = checksummed_blocks({data, size});
  const std::size_t mutated = LLVMFuzzerMutate(data, size, most);
  if (seed % 16 != 0)  // now and then a wrong one
    renew_checksums(blocks, {data, mutated});
  return mutated;
}
