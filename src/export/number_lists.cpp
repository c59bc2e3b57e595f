// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Lists of numbers in programs.
#include "export/number_lists.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "export/image_bytes.h"
#include "export/number_text.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

using Size = std::vector<std::uint64_t>;

// How many values or lists the lists of each depth have, from the outermost on; none of one depth
// where they differ.
class Nesting {
 public:
  void open() { counts_.push_back(0); }
  void add() { ++counts_.back(); }
  void close() {
    const std::size_t depth = counts_.size() - 1, count = counts_.back();
    counts_.pop_back();
    if (depth >= sizes_.size())
      sizes_.resize(depth + 1, unknown);
    sizes_[depth] = sizes_[depth] == unknown || sizes_[depth] == count ? count : uneven;
    if (!counts_.empty())
      ++counts_.back();
  }

  // [height][width][channels], or [n^2][channels] of a square; nothing where it is neither.
  std::optional<Size> size() const {
    const std::size_t depth = sizes_.size();
    if (depth < 2 || depth > 3 || std::ranges::find(sizes_, uneven) != sizes_.end())
      return std::nullopt;
    if (depth == 3)
      return Size{sizes_[1], sizes_[0], 1, sizes_[2]};
    const auto side = static_cast<std::size_t>(std::lround(std::sqrt(sizes_[0])));
    return side * side == sizes_[0] ? std::optional(Size{side, side, 1, sizes_[1]}) : std::nullopt;
  }

 private:
  static constexpr std::size_t unknown = SIZE_MAX, uneven = SIZE_MAX - 1;
  std::vector<std::size_t> counts_, sizes_;
};

// Walks over a program of JavaScript, C or C# without understanding it: what counts is NAME = [,
// NAME[...] = { or NAME = new TYPE[...] {, followed by a number.
class Walker {
 public:
  Walker(std::string_view text, const fs::path& file) : text_(text), file_(file) {}

  std::vector<Image> images() {
    std::vector<Image> found;
    std::set<std::string> names;
    std::string name;  // the identifier just passed, as long as it may be what is assigned to
    while (skip_blanks(), !at_end()) {
      const char c = peek();
      if (is_of_identifier(c)) {
        name = word();
      } else if (c == '[' && !name.empty()) {
        skip_to(']');
      } else if (c == '=' && !name.empty()) {
        ++at_;
        skip_blanks();
        const bool halves = skip_new();
        std::vector<float> values;
        Nesting nesting;
        if (list(name, values, nesting)) {
          if (!names.insert(name).second)
            refuse_file(file_, fmt::format("the list {} stands twice", name));
          if (halves)
            values = halves_of(values, name);
          found.push_back(
              image_of_list(name, std::move(values), size_ ? size_ : nesting.size(), file_));
          found.back().precision = halves ? Precision::half : Precision::single;
          size_.reset();
        }
        name.clear();
      } else if (c == '"' || c == '\'' || c == '`') {
        skip_text();
        name.clear();
      } else {
        ++at_;
        name.clear();
      }
    }
    if (found.empty())
      refuse_file(file_, "it has no lists of numbers; allowed: name = [...] or name[...] = {...}");
    return found;
  }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  bool follows(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  // Blanks and comments.
  void skip_blanks() {
    while (!at_end())
      if (std::string_view(" \t\r\n\f\v").find(peek()) != std::string_view::npos)
        ++at_;
      else if (follows("//"))
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (follows("/*"))
        skip_comment();
      else
        return;
  }

  // One of those that our own files have says the size of the list that comes next.
  void skip_comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos)
      refuse_file(file_, fmt::format("the comment of line {} does not end", line()));
    const std::string comment(text_.substr(at_ + 2, std::min<std::size_t>(end - at_ - 2, 200)));
    unsigned long width = 0, height = 0, layers = 0, channels = 0;
    if (std::sscanf(comment.c_str(), " width %lu, height %lu, layers %lu, channels %lu", &width,
                    &height, &layers, &channels) == 4)
      size_ = Size{width, height, layers, channels};
    at_ = end + 2;
  }

  std::string word() {
    const std::size_t begin = at_;
    while (is_of_identifier(peek()))
      ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  void skip_to(char end) { at_ = std::min(text_.find(end, at_), text_.size() - 1) + 1; }

  // Text in quotes; one that does not end, such as an apostrophe of another language, ends with its
  // line.
  void skip_text() {
    const char quote = peek();
    for (++at_; !at_end() && peek() != quote && (quote == '`' || peek() != '\n'); ++at_)
      at_ += peek() == '\\';
    ++at_;
  }

  // C#'s "new double[64 * 64, 9]". Whether the type is that of the bits of halves.
  bool skip_new() {
    const std::size_t before = at_;
    if (word() != "new") {
      at_ = before;
      return false;
    }
    skip_blanks();
    const std::string type = word();
    skip_blanks();
    if (peek() == '[') {
      const std::size_t begin = at_ + 1;
      skip_to(']');
      take_size(std::string(text_.substr(begin, at_ - begin)));
    }
    return type == "ushort";
  }

  // "64 * 64 * 4": width, height and channels.
  void take_size(const std::string& product) {
    unsigned long width = 0, height = 0, channels = 0;
    char end = 0;
    if (std::sscanf(product.c_str(), "%lu * %lu * %lu%c", &width, &height, &channels, &end) == 4 &&
        end == ']')
      size_ = Size{width, height, 1, channels};
  }

  std::vector<float> halves_of(const std::vector<float>& bits, std::string_view name) const {
    std::string bytes(2 * bits.size(), '\0');
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if (!(bits[i] >= 0 && bits[i] <= 65535 && bits[i] == std::floor(bits[i])))
        refuse_file(file_, fmt::format("list {}: {}; allowed: the bits of a half, 0 to 65535", name,
                                       bits[i]));
      put_number(bytes, 2 * i, static_cast<std::uint16_t>(bits[i]));
    }
    return values_of(bytes, Precision::half);
  }

  // The numbers of [ ... ] or { ... }, nested ones too; false if it is no list of numbers at all.
  bool list(std::string_view name, std::vector<float>& values, Nesting& nesting) {
    std::string open;          // the brackets still to close
    bool after_value = false;  // a comma or the end must follow
    do {
      skip_blanks();
      const char c = peek();
      if (c == '[' || c == '{') {
        if (after_value)
          refuse_list(name, "a comma");
        open += c == '[' ? ']' : '}';
        nesting.open();
        ++at_;
      } else if (open.empty()) {
        return false;
      } else if (c == open.back()) {
        open.pop_back();
        nesting.close();
        after_value = true;
        ++at_;
      } else if (c == ',' && after_value) {
        after_value = false;
        ++at_;
      } else if (!after_value && starts_number()) {
        values.push_back(number(name));
        nesting.add();
        after_value = true;
      } else if (values.empty() && !starts_not_finite()) {
        return false;
      } else {
        refuse_list(name, after_value ? "a comma or its end" : "a finite number");
      }
    } while (!open.empty());
    return !values.empty();
  }

  bool starts_number() const {
    return is_digit(peek()) || peek() == '.' || peek() == '-' || peek() == '+';
  }

  bool starts_not_finite() const {
    return follows("NaN") || follows("NAN") || follows("nan") || follows("Inf") || follows("INF") ||
           follows("inf");
  }

  float number(std::string_view name) {
    const bool negative = peek() == '-';
    if (negative || peek() == '+') {
      ++at_;
      skip_blanks();
    }
    const std::size_t begin = at_;
    const auto of_number = [&] {
      const bool sign = peek() == '-' || peek() == '+';
      return is_of_identifier(peek()) || peek() == '.' ||
             (sign && at_ > begin && (text_[at_ - 1] == 'e' || text_[at_ - 1] == 'E'));
    };
    while (of_number())
      ++at_;
    std::string_view digits = text_.substr(begin, at_ - begin);
    if (!digits.empty() && (digits.back() == 'f' || digits.back() == 'F'))
      digits.remove_suffix(1);
    const float value = number_of(digits, name, file_);
    return negative ? -value : value;
  }

  std::size_t line() const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
  }

  [[noreturn]] void refuse_list(std::string_view name, std::string_view expected) const {
    const std::string found = at_end() ? "the file ends"
                              : peek() > ' ' && peek() <= '~'
                                  ? fmt::format("there is '{}'", peek())
                                  : fmt::format("there is byte {}", static_cast<int>(peek()) & 255);
    refuse_file(file_,
                fmt::format("line {}: {} where the list {} has {}", line(), found, name, expected));
  }

  std::string_view text_;
  const fs::path& file_;
  std::size_t at_ = 0;
  std::optional<Size> size_;
};

std::string shown(std::string_view text) {
  return std::string(text.substr(0, 40)) + (text.size() > 40 ? "..." : "");
}

}  // namespace

float number_of(std::string_view text, std::string_view list, const fs::path& file) {
  float value = 0;
  const char* const end = text.data() + text.size();
  const bool starts = !text.empty() && (is_digit(text.front()) || text.front() == '.' ||
                                        text.front() == '-');  // no "inf"
  auto [stop, error] = std::from_chars(text.data(), end, value);
  // What is smaller than any float is zero, or the least float.
  if (double wide = 0; error == std::errc::result_out_of_range)
    if (error = std::from_chars(text.data(), end, wide).ec; error == std::errc())
      value = static_cast<float>(wide);
  if (!starts || error != std::errc() || stop != end || !std::isfinite(value))
    refuse_file(file, fmt::format("list {}: \"{}\"; allowed: a finite number of 32 bits",
                                  on_one_line(std::string(list)), shown(text)));
  return value;
}

Image image_of_list(const std::string& name, std::vector<float> values,
                    const std::optional<Size>& size, const fs::path& file) {
  const std::string shown_name = on_one_line(name);
  Image image;
  image.name = name;
  if (size) {
    if (size->size() != 4)
      refuse_file(file, fmt::format("size of {} has {} numbers; allowed: width, height, layers, "
                                    "channels",
                                    shown_name, size->size()));
    image.width = (*size)[0];
    image.height = (*size)[1];
    image.layers = (*size)[2];
    image.channels = (*size)[3];
    image.shape = image.layers == 1 ? ImageShape::flat : ImageShape::array;
  } else {
    image.width = image.height =
        static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(values.size()) / 4)));
    if (values.size() != 4 * image.width * image.width || values.empty())
      refuse_file(file, fmt::format("list {} has {} numbers; allowed without a size: 4 n^2, a "
                                    "square image of 4 channels",
                                    shown_name, values.size()));
  }
  const std::string where = fmt::format("{}: list {}", file.string(), shown_name);
  require_size(image, where);
  if (values.size() != value_count(image))
    throw InputError(fmt::format("{} has {} numbers; its size asks for {}", where, values.size(),
                                 value_count(image)));
  image.values = std::move(values);
  return image;
}

std::vector<Image> decode_number_lists(std::string_view text, const fs::path& file) {
  std::vector<Image> images = Walker(text, file).images();
  // Beside matrices, a bare list of one number each has no other shape than theirs.
  const auto matrices = std::ranges::find(images, most_channels, &Image::channels);
  if (matrices != images.end())
    for (Image& image : images)
      if (image.channels == 4 && image.values.size() == matrices->texels()) {
        image.width = matrices->width;
        image.height = matrices->height;
        image.channels = 1;
      }
  return images;
}

}  // namespace ltc
