// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/npy_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ltc {

std::string npy_header(std::span<const std::size_t> shape) {
  std::string dictionary = fmt::format(
      "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", fmt::join(shape, ", "));
  // Version 1.0: npy_magic, two bytes of version, two of length; the whole a multiple of 64, the
  // last byte a line break.
  const std::size_t unpadded = npy_magic.size() + 4 + dictionary.size() + 1;
  dictionary.append((64 - unpadded % 64) % 64, ' ');
  dictionary += '\n';
  std::string header(npy_magic);
  header += {'\x01', '\x00', static_cast<char>(dictionary.size() & 0xff),
             static_cast<char>(dictionary.size() >> 8)};
  return header + dictionary;
}

}  // namespace ltc
