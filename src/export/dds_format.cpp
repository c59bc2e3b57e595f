// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as DDS textures, one image a file.
#include "export/dds.h"
#include "export/texture_format.h"

namespace ltc {

Format dds_format() {
  return texture_format(
      {.name = "DDS",
       .endings = {".dds"},
       .asked = &OutputSettings::dds,
       .half = &OutputSettings::half,
       .two_files = true,
       .three_files = true,
       .named = {{TextureLayout::godot, {"_lut1.dds", "_lut2.dds"}},
                 {TextureLayout::ltc_2017_06, {"_mat.dds", "_amp.dds"}}},
       .four_channels = true,
       .encode = [](const std::vector<Image>& images, const TableFiles&,
                    const WriteOptions&) { return std::vector{encode_dds(images.front())}; },
       .decode =
           [](const std::vector<NamedBytes>& files) {
             return std::vector{decode_dds(files.front().bytes, files.front().file)};
           }});
}

}  // namespace ltc
