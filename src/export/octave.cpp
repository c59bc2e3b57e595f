// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltc_code's ltc.mat, in Octave's text: matrices tabMagnitude and tab00, tab10, ... of a value
// each, column and row of M in their names, with a line a theta. Read only.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <map>
#include <utility>

#include "export/image_bytes.h"
#include "export/number_lists.h"
#include "export/texture_format.h"

namespace ltc {
namespace {

constexpr std::array<const char*, 9> entry_names = {"tab00", "tab01", "tab02", "tab10", "tab11",
                                                    "tab12", "tab20", "tab21", "tab22"};
constexpr const char* magnitude_name = "tabMagnitude";

class Reader {
 public:
  Reader(std::string_view text, const std::filesystem::path& file) : rest_(text), file_(file) {}

  std::map<std::string, Image> matrices() {
    std::map<std::string, Image> found;
    while (const auto name = next_name()) {
      Image image = matrix(*name);
      if (!found.emplace(*name, std::move(image)).second)
        refuse_file(file_, fmt::format("the matrix {} stands twice", *name));
    }
    return found;
  }

 private:
  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return result;
  }

  // Of the next matrix, past "# type: matrix" and "# ndims: 2".
  std::optional<std::string> next_name() {
    constexpr std::string_view start = "# name: ";
    while (!rest_.empty()) {
      const std::string_view text = line();
      if (!text.starts_with(start))
        continue;
      const std::string name = on_one_line(std::string(text.substr(start.size())));
      if (line() != "# type: matrix" || line() != "# ndims: 2")
        refuse_file(file_, fmt::format("{} is no matrix of two dimensions", name));
      return name;
    }
    return std::nullopt;
  }

  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n\r\t"), rest_.size()));
    const std::size_t end = std::min(rest_.find_first_of(" \n\r\t"), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return result;
  }

  Image matrix(const std::string& name) {
    Image image;
    unsigned long height = 0, width = 0;
    const std::string size(line());
    if (std::sscanf(size.c_str(), "%lu %lu", &height, &width) != 2)
      refuse_file(file_, fmt::format("{} has no size; allowed: two whole numbers", name));
    image.name = name;
    image.width = width;
    image.height = height;
    image.channels = 1;
    require_size(image, fmt::format("{}: {}", file_.string(), name));
    for (std::size_t i = 0; i < image.texels(); ++i)
      image.values.push_back(number_of(word(), name, file_));
    return image;
  }

  std::string_view rest_;
  const std::filesystem::path& file_;
};

}  // namespace

std::vector<Image> decode_octave(std::string_view text, const std::filesystem::path& file) {
  const std::map<std::string, Image> found = Reader(text, file).matrices();
  Image all;
  all.name = "tabM";
  all.channels = entry_names.size();
  for (std::size_t channel = 0; channel < all.channels; ++channel) {
    const auto one = found.find(entry_names[channel]);
    if (one == found.end())
      refuse_file(file, fmt::format("it has no matrix {}", entry_names[channel]));
    const Image& values = one->second;
    if (channel == 0) {
      all.width = values.width;
      all.height = values.height;
      require_size(all, file.string());
      all.values.resize(value_count(all));
    }
    if (values.width != all.width || values.height != all.height)
      refuse_file(file, fmt::format("{} is {} x {}; expected {} x {}, as tab00", values.name,
                                    values.height, values.width, all.height, all.width));
    for (std::size_t texel = 0; texel < all.texels(); ++texel)
      all.values[texel * all.channels + channel] = values.values[texel];
  }
  std::vector<Image> images{std::move(all)};
  if (const auto magnitude = found.find(magnitude_name); magnitude != found.end())
    images.push_back(magnitude->second);
  return images;
}

}  // namespace ltc
