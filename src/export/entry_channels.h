// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The values of an entry as the channels of textures, in order: nine of the matrix by rows,
// amplitude, Fresnel term, and zero in the rest of three texels.
#pragma once

#include <cstddef>

#include "table/table.h"

namespace ltc {

inline constexpr std::size_t amplitude_channel = 9, fresnel_channel = 10;
inline constexpr std::size_t texels_per_entry = 3, channels_per_texel = 4;

inline float channel_value(const Table& table, std::size_t entry, std::size_t channel) {
  if (channel < amplitude_channel)
    return table.stored[9 * entry + channel];
  if (channel == amplitude_channel)
    return table.amplitude[entry];
  return channel == fresnel_channel ? table.fresnel[entry] : 0.0f;
}

inline void set_channel_value(Table& table, std::size_t entry, std::size_t channel, float value) {
  if (channel < amplitude_channel)
    table.stored[9 * entry + channel] = value;
  else if (channel == amplitude_channel)
    table.amplitude[entry] = value;
  else if (channel == fresnel_channel)
    table.fresnel[entry] = value;
}

}  // namespace ltc
