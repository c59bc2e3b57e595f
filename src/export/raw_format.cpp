// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as the bytes of their textures, with a JSON file beside that says what they are.
#include "export/raw_image.h"
#include "export/texture_format.h"

namespace ltc {

Format raw_format() {
  return texture_format(
      {.name = "raw",
       .endings = {".bin", ".bin.json"},
       .asked = &OutputSettings::raw,
       .half = &OutputSettings::half,
       .ending_of_others = true,
       .encode =
           [](const std::vector<Image>& images, const TableFiles&, const WriteOptions&) {
             return std::vector{encode_raw(images), describe_raw(images)};
           },
       .decode =
           [](const std::vector<NamedBytes>& files) {
             return files.size() == 1
                        ? decode_bare(files[0].bytes, files[0].file)
                        : decode_raw(files[0].bytes, files[1].bytes, files[0].file, files[1].file);
           }});
}

}  // namespace ltc
