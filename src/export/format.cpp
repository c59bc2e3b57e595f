// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/format.h"

#include <iterator>

namespace ltc {

// Each in the file of its name.
Format hdf5_format(), exr_format(), npy_format();

namespace {

std::list<Format>& list() {
  static std::list<Format> all = {hdf5_format(), exr_format(), npy_format()};
  return all;
}

}  // namespace

TableFiles Format::files(const std::filesystem::path& prefix) const {
  TableFiles result;
  for (const std::string& ending : endings)
    result.emplace_back(prefix.string() + ending);
  return result;
}

std::string Format::why_not(const Grid& grid, Storage storage) const {
  if (!without_axes && grid.layout != Layout::alpha_lambda)
    return "is over alpha_x and alpha_y; expected alpha and lambda";
  return limits ? limits(grid, storage) : "";
}

const std::list<Format>& formats() {
  return list();
}

AddedFormat::AddedFormat(Format format) : place_(list().insert(list().end(), std::move(format))) {}

AddedFormat::~AddedFormat() {
  list().erase(place_);
}

const Format* find_format(const std::filesystem::path& file) {
  for (const Format& format : formats())
    for (const std::string& ending : format.endings)
      if (file.string().ends_with(ending))
        return &format;
  return nullptr;
}

std::string endings_text(const std::function<bool(const Format&)>& which) {
  std::vector<std::string> endings;
  for (const Format& format : formats())
    if (which(format))
      endings.push_back(format.endings.front());
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i)
    text += (i == 0 ? "" : i + 1 < endings.size() ? ", " : " or ") + endings[i];
  return text;
}

}  // namespace ltc
