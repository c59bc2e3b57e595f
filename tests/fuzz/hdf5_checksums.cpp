// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "fuzz/hdf5_checksums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

namespace ltc::fuzz {
namespace {

constexpr std::array<std::string_view, 9> signatures = {"\x89HDF", "OHDR", "OCHK", "BTHD", "BTIN",
                                                        "BTLF",    "FRHP", "FHDB", "FHIB"};
constexpr std::size_t longest_block = 1024;

std::uint32_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, bytes.size()); ++i)
    value |= std::uint32_t{bytes[i]} << (8 * i);
  return value;
}

struct State {
  std::uint32_t a, b, c;

  void take(std::span<const std::uint8_t> bytes) {
    a += little_endian(bytes);
    b += bytes.size() > 4 ? little_endian(bytes.subspan(4)) : 0;
    c += bytes.size() > 8 ? little_endian(bytes.subspan(8)) : 0;
  }
  void mix() {
    a = (a - c) ^ std::rotl(c, 4), c += b;
    b = (b - a) ^ std::rotl(a, 6), a += c;
    c = (c - b) ^ std::rotl(b, 8), b += a;
    a = (a - c) ^ std::rotl(c, 16), c += b;
    b = (b - a) ^ std::rotl(a, 19), a += c;
    c = (c - b) ^ std::rotl(b, 4), b += a;
  }
  void finish() {
    c = (c ^ b) - std::rotl(b, 14);
    a = (a ^ c) - std::rotl(c, 11);
    b = (b ^ a) - std::rotl(a, 25);
    c = (c ^ b) - std::rotl(b, 16);
    a = (a ^ c) - std::rotl(c, 4);
    b = (b ^ a) - std::rotl(a, 14);
    c = (c ^ b) - std::rotl(b, 24);
  }
};

bool starts_with_a_signature(std::span<const std::uint8_t> bytes) {
  return std::any_of(signatures.begin(), signatures.end(), [&](std::string_view signature) {
    return bytes.size() >= signature.size() &&
           std::equal(signature.begin(), signature.end(), bytes.begin(),
                      [](char x, std::uint8_t y) { return static_cast<std::uint8_t>(x) == y; });
  });
}

}  // namespace

std::uint32_t lookup3(std::span<const std::uint8_t> bytes) {
  const std::uint32_t start = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size());
  State state{start, start, start};
  if (bytes.empty())
    return state.c;
  for (; bytes.size() > 12; bytes = bytes.subspan(12)) {
    state.take(bytes.first(12));
    state.mix();
  }
  state.take(bytes);
  state.finish();
  return state.c;
}

std::vector<ChecksummedBlock> checksummed_blocks(std::span<const std::uint8_t> file) {
  std::vector<ChecksummedBlock> blocks;
  for (std::size_t begin = 0; begin + 8 < file.size(); ++begin) {
    const auto rest = file.subspan(begin);
    if (!starts_with_a_signature(rest))
      continue;
    for (std::size_t length = 8; length + 4 <= std::min(rest.size(), longest_block); ++length)
      if (little_endian(rest.subspan(length, 4)) == lookup3(rest.first(length))) {
        blocks.push_back({begin, length});
        break;
      }
  }
  return blocks;
}

void renew_checksums(const std::vector<ChecksummedBlock>& blocks, std::span<std::uint8_t> file) {
  for (const auto& [begin, length] : blocks) {
    if (begin + length + 4 > file.size())
      continue;
    const std::uint32_t sum = lookup3(file.subspan(begin, length));
    for (std::size_t i = 0; i < 4; ++i)
      file[begin + length + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  }
}

}  // namespace ltc::fuzz
