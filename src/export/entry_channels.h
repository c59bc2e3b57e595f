// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The values of an entry as the channels of textures, in order: nine of the matrix by rows,
// amplitude, Fresnel term, and zero in the rest of three texels; of folded lobes kappa, gamma and
// zeros in a fourth.
#pragma once

#include <cstddef>

#include "table/table.h"

namespace ltc {

inline constexpr std::size_t amplitude_channel = 9, fresnel_channel = 10;
inline constexpr std::size_t texels_per_entry = 3, channels_per_texel = 4;
inline constexpr std::size_t kappa_channel = 12, gamma_channel = 13;

inline std::size_t texels_of(const Table& table) {
  return texels_per_entry + (is_folded(table) ? 1 : 0);
}

inline float channel_value(const Table& table, std::size_t entry, std::size_t channel) {
  if (channel < amplitude_channel)
    return table.stored[9 * entry + channel];
  if (channel == amplitude_channel)
    return table.amplitude[entry];
  if (channel == kappa_channel || channel == gamma_channel)
    return table.fold[2 * entry + channel - kappa_channel];
  return channel == fresnel_channel ? table.fresnel[entry] : 0.0f;
}

inline void set_channel_value(Table& table, std::size_t entry, std::size_t channel, float value) {
  if (channel < amplitude_channel)
    table.stored[9 * entry + channel] = value;
  else if (channel == amplitude_channel)
    table.amplitude[entry] = value;
  else if (channel == fresnel_channel)
    table.fresnel[entry] = value;
  else if (channel == kappa_channel || channel == gamma_channel)
    table.fold[2 * entry + channel - kappa_channel] = value;
}

}  // namespace ltc
