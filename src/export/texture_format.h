// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The formats whose files are textures: a layout of the table's values (texture_layout.h) in a
// container, each in a file of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/format.h"

namespace ltc {

struct NamedBytes {
  std::filesystem::path file;
  std::string bytes;
};

// A layout whose images have files of their own, called as others call them.
struct NamedLayout {
  TextureLayout layout;
  std::vector<std::string> endings;
};

struct Container {
  std::string name;
  std::vector<std::string> endings;  // of the files of one set that holds all images
  bool OutputSettings::*asked = nullptr;
  bool OutputSettings::*half = nullptr;  // as of Format
  // Whether the images of layouts that have several go to files of their own: "_1", "_2" of two and
  // ".0", ".1", ".2" of three before the ending.
  bool two_files = false, three_files = false;
  std::vector<NamedLayout> named = {};
  std::optional<TextureLayout> only = std::nullopt;  // the one layout that it holds
  bool four_channels = false;                        // whether texels have no more
  bool ending_of_others = false;                     // as of Format
  // The bytes of each file; of images that have files of their own, called with one at a time. Null
  // where files are only read.
  std::vector<std::string> (*encode)(const std::vector<Image>& images, const TableFiles& files,
                                     const WriteOptions& options) = nullptr;
  // Of the files that there are, the first of a set at least.
  std::vector<Image> (*decode)(const std::vector<NamedBytes>& files) = nullptr;
};

Format texture_format(const Container& container);

}  // namespace ltc
