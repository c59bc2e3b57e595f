// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/format.h"

#include <algorithm>
#include <iterator>

#include "export/field_code.h"
#include "export/field_file.h"

namespace ltc {

// Each in the file of its name.
Format hdf5_format(), exr_format(), npy_format(), dds_format(), ktx2_format(), raw_format(),
    json_format(), javascript_format(), c_header_format(), c_sharp_format(), octave_format(),
    c_source_format(const char*ending), header_format(),
    field_function_format(const char*ending, CodeLanguage language);

namespace {

std::list<Format>& list() {
  static std::list<Format> all = {field_format(),
                                  hdf5_format(),
                                  exr_format(),
                                  npy_format(),
                                  dds_format(),
                                  ktx2_format(),
                                  raw_format(),
                                  json_format(),
                                  javascript_format(),
                                  c_header_format(),
                                  c_sharp_format(),
                                  octave_format(),
                                  c_source_format(".inc"),
                                  c_source_format(".inl"),
                                  header_format(),
                                  field_function_format(".glsl", CodeLanguage::glsl),
                                  field_function_format(".hlsl", CodeLanguage::hlsl),
                                  field_function_format(".wgsl", CodeLanguage::wgsl),
                                  field_function_format(".mjs", CodeLanguage::javascript)};
  return all;
}

TableFiles named(const std::filesystem::path& prefix, const std::vector<std::string>& endings) {
  TableFiles files;
  for (const std::string& ending : endings)
    files.emplace_back(prefix.string() + ending);
  return files;
}

}  // namespace

TableFiles Format::files(const std::filesystem::path& prefix, const Grid& grid, Storage storage,
                         TextureLayout layout) const {
  if (storage == Storage::folded && !folded_set.empty())
    return named(prefix, folded_set);
  return named(prefix, set_for ? set_for(resolved(layout, grid, storage)) : sets.front());
}

TableFiles Format::all_files(const std::filesystem::path& prefix) const {
  TableFiles result;
  for (const std::vector<std::string>& endings : sets)
    std::ranges::copy(named(prefix, endings), std::back_inserter(result));
  if (!folded_set.empty())
    result.push_back(named(prefix, folded_set).back());
  return result;
}

std::string Format::why_not(const Grid& grid, Storage storage, TextureLayout layout) const {
  if (!without_axes && grid.layout != Layout::alpha_lambda)
    return "is over alpha_x and alpha_y; expected alpha and lambda";
  return limits ? limits(grid, storage, resolved(layout, grid, storage)) : "";
}

const std::list<Format>& formats() {
  return list();
}

AddedFormat::AddedFormat(Format format) : place_(list().insert(list().end(), std::move(format))) {}

AddedFormat::~AddedFormat() {
  list().erase(place_);
}

const Format* find_format(const std::filesystem::path& file) {
  return set_of(file).format;
}

NamedSet set_of(const std::filesystem::path& file) {
  const std::string name = file.string();
  NamedSet found{nullptr, file, {file}};
  std::size_t longest = 0;
  for (const Format& format : formats()) {
    const std::vector<std::vector<std::string>> of_folded = {format.folded_set};
    for (const auto* const sets : {&format.sets, &format.named_sets, &of_folded})
      for (const std::vector<std::string>& endings : *sets)
        for (const std::string& ending : endings)
          if (name.ends_with(ending) && ending.size() > longest) {
            longest = ending.size();
            const std::filesystem::path prefix = name.substr(0, name.size() - longest);
            found = {&format, prefix, named(prefix, endings)};
          }
  }
  return found;
}

NamedSet set_to_write(const std::filesystem::path& file, bool functions) {
  NamedSet set = set_of(file);
  if (functions && set.format)
    for (const Format& format : formats())
      if (format.asked == &OutputSettings::header && format.sets == set.format->sets)
        set.format = &format;
  return set;
}

WriteOptions write_options(const Format& format, const OutputSettings& output) {
  return {format.half && output.*format.half, output.layout, output.zstd, output.javascript_style};
}

std::string endings_text(const std::function<bool(const Format&)>& which) {
  std::vector<std::string> endings;
  for (const Format& format : formats())
    if (const std::string& ending = format.sets.back().front();
        which(format) && std::ranges::find(endings, ending) == endings.end())
      endings.push_back(ending);
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i)
    text += (i == 0 ? "" : i + 1 < endings.size() ? ", " : " or ") + endings[i];
  return text;
}

}  // namespace ltc
