// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The checksums of an HDF5 file's metadata, so that a fuzzer's changes get past them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ltc::fuzz {

// A block of metadata: `length` bytes from `begin`, then their checksum in four.
struct ChecksummedBlock {
  std::size_t begin, length;
};

// Bob Jenkins's lookup3, "hashlittle" with an initial value of 0: HDF5's metadata checksum.
std::uint32_t lookup3(std::span<const std::uint8_t> bytes);

// The blocks of a file whose checksums are right, found by their signatures (superblock, object
// headers, B-trees of version 2, fractal heaps).
std::vector<ChecksummedBlock> checksummed_blocks(std::span<const std::uint8_t> file);

// Makes the checksums of these blocks right, of those that still lie within the file.
void renew_checksums(const std::vector<ChecksummedBlock>& blocks, std::span<std::uint8_t> file);

}  // namespace ltc::fuzz
