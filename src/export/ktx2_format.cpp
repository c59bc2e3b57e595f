// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Tables as KTX2 textures; the two flat images of an isotropic table as the layers of one array.
#include "export/ktx2.h"
#include "export/texture_format.h"

namespace ltc {
namespace {

Image layers_of(const std::vector<Image>& images) {
  Image array = images.front();
  if (images.size() == 1)
    return array;
  array.shape = ImageShape::array;
  array.layers = images.size();
  for (std::size_t i = 1; i < images.size(); ++i)
    array.values.insert(array.values.end(), images[i].values.begin(), images[i].values.end());
  return array;
}

// Two layers are the images of an isotropic table: other arrays have three a pair of roughnesses.
std::vector<Image> images_in(const Image& array) {
  if (array.shape != ImageShape::array || array.layers > 2)
    return {array};
  std::vector<Image> images;
  const std::size_t size = array.values.size() / array.layers;
  for (std::size_t layer = 0; layer < array.layers; ++layer) {
    Image& image = images.emplace_back(array);
    image.shape = ImageShape::flat;
    image.layers = 1;
    const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(layer * size);
    image.values.assign(first, first + static_cast<std::ptrdiff_t>(size));
  }
  return images;
}

}  // namespace

Format ktx2_format() {
  return texture_format(
      {.name = "KTX2",
       .endings = {".ktx2"},
       .asked = &OutputSettings::ktx2,
       .half = &OutputSettings::half,
       .three_files = true,
       .four_channels = true,
       .encode =
           [](const std::vector<Image>& images, const TableFiles&, const WriteOptions& options) {
             return std::vector{encode_ktx2(layers_of(images), options.zstd)};
           },
       .decode =
           [](const std::vector<NamedBytes>& files) {
             return images_in(decode_ktx2(files.front().bytes, files.front().file));
           }});
}

}  // namespace ltc
