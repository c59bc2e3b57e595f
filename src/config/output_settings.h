// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the config's [output] section says: which files are written, and how.
#pragma once

#include <string>

#include "core/enum_names.h"

namespace ltc {

// How the values of a table lie in textures (export/texture_layout.h).
enum class TextureLayout {
  automatic,  // `ltc` for tables that it can hold, else `volumes`
  ltc,        // two images, as in ltc_code since October 2017 and in most engines
  eight,      // those of `ltc` in one image of eight channels
  unity,      // one image, the inverse with the last entry 1
  godot,      // two images, the matrix itself over theta
  volumes,    // three 3-D images, the texels of the OpenEXR textures
  stacked,    // those three one behind the other in one 3-D image
  array,      // the same as layers
  // Read only:
  ltc_2017_07,      // as `ltc` in another order and of another scale
  ltc_2017_06,      // over theta, the first entry 1; amplitudes apart
  columns,          // nine values, the matrix column by column
  inverse_columns,  // nine values, the inverse column by column
  rows,             // nine values, the matrix row by row, over alpha and theta
  rows_sqrt,        // the same over sqrt(alpha) and theta
};
constexpr EnumNames<TextureLayout, 14> enum_names(TextureLayout) {
  return {"layout of textures",
          {{{TextureLayout::automatic, "automatic"},
            {TextureLayout::ltc, "ltc"},
            {TextureLayout::eight, "eight"},
            {TextureLayout::unity, "unity"},
            {TextureLayout::godot, "godot"},
            {TextureLayout::volumes, "volumes"},
            {TextureLayout::stacked, "stacked"},
            {TextureLayout::array, "array"},
            {TextureLayout::ltc_2017_07, "ltc-2017-07"},
            {TextureLayout::ltc_2017_06, "ltc-2017-06"},
            {TextureLayout::columns, "columns"},
            {TextureLayout::inverse_columns, "inverse-columns"},
            {TextureLayout::rows, "rows"},
            {TextureLayout::rows_sqrt, "rows-sqrt"}}}};
}

// What a JavaScript file is.
enum class ScriptStyle {
  arrays,  // a module that exports the arrays
  three,   // RectAreaLightTexturesLib, as three.js imports it
};
constexpr EnumNames<ScriptStyle, 2> enum_names(ScriptStyle) {
  return {"style", {{{ScriptStyle::arrays, "arrays"}, {ScriptStyle::three, "three"}}}};
}

struct OutputSettings {
  std::string name = "ltc";  // files are <name>.h5, <name>.0.exr, …, <name>.npy
  bool field = true;
  bool hdf5 = true;
  bool exr = true;
  bool npy = true;
  bool dds = false;
  bool ktx2 = false;
  bool json = false;
  bool javascript = false;
  bool c_header = false;
  bool c_sharp = false;
  bool header = false;   // C header with functions
  bool shaders = false;
  bool raw = false;
  bool exr_half = false;  // 16-bit OpenEXR instead of 32-bit
  bool half = true;       // 16-bit values in DDS, KTX2 and raw files
  TextureLayout layout = TextureLayout::automatic;
  bool zstd = true;  // compress KTX2
  ScriptStyle javascript_style = ScriptStyle::arrays;
  bool operator==(const OutputSettings&) const = default;
};

}  // namespace ltc
