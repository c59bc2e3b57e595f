// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Writing, and JSON; number_lists.cpp reads programs.
#include "export/number_text.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "export/image_bytes.h"
#include "export/number_lists.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view size_key = "size";

using NameCheck = bool (*)(std::string_view);

bool is_json_name(std::string_view name) {
  return !name.empty() && name != size_key;
}

bool is_identifier(std::string_view name) {
  return !name.empty() && !is_digit(name.front()) &&
         std::all_of(name.begin(), name.end(), is_of_identifier);
}

constexpr std::string_view identifier_rule = "letters, digits and _, no digit first";

void require_writable(const std::vector<Image>& images, NameCheck allowed, std::string_view rule) {
  if (images.empty())
    throw InputError("no images; allowed: one or more");
  std::set<std::string_view> names;
  for (const Image& image : images) {
    if (!allowed(image.name))
      throw InputError(fmt::format("image name \"{}\"; allowed: {}", image.name, rule));
    if (!names.insert(image.name).second)
      throw InputError(fmt::format("image name \"{}\" stands twice", image.name));
    require_storable(image);
  }
}

// Numbers with what follows each, a texel a line. Without a point, a number with an "f" is none in
// C, and -0 is 0 to readers of JSON.
void append_values(std::string& text, const Image& image, std::string_view suffix) {
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    text += i == 0 ? "\n" : i % image.channels == 0 ? ",\n" : ", ";
    const std::size_t begin = text.size();
    fmt::format_to(std::back_inserter(text), "{}", stored_value(image.values[i], image.precision));
    const std::string_view number = std::string_view(text).substr(begin);
    if (number == "-0" || (!suffix.empty() && number.find_first_of(".e") == std::string_view::npos))
      text += ".0";
    text += suffix;
  }
  text += '\n';
}

std::string json_text(std::string_view name) {
  return nlohmann::json(name).dump();
}

// What is in it, for people and for our own reader, which looks for it before a list.
std::string size_comment(const Image& image) {
  return fmt::format("/* width {}, height {}, layers {}, channels {} */\n", image.width,
                     image.height, image.layers, image.channels);
}

// Collects what the parser meets: never a tree, which would take ten times the text.
class Collector : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Collector(const fs::path& file) : file_(file) {}

  std::vector<Image> finish() {
    std::vector<Image> images;
    for (auto& [name, list] : lists_) {
      const auto size = sizes_.find(name);
      images.push_back(
          image_of_list(name, std::move(list),
                        size == sizes_.end() ? std::nullopt : std::optional(size->second), file_));
    }
    for (const auto& [name, size] : sizes_)
      if (name == size_key || !seen_.contains({false, name}))
        refuse_file(file_, fmt::format("it has a size of {}, but no such list", on_one_line(name)));
    if (images.empty())
      refuse_file(file_, "it has no lists; allowed: an object of lists of numbers");
    return images;
  }

  bool null() override { refuse_value("null"); }
  bool boolean(bool) override { refuse_value("true or false"); }
  bool string(string_t&) override { refuse_value("a text"); }
  bool binary(binary_t&) override { refuse_value("bytes"); }
  bool number_integer(number_integer_t value) override {
    if (in_sizes_)
      refuse_value(std::to_string(value));
    return number(static_cast<float>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    if (!in_sizes_)
      return number(static_cast<float>(value));
    if (depth_ != 3 || sizes_[name_].size() == 4)
      refuse_value(std::to_string(value));
    sizes_[name_].push_back(value);
    return true;
  }
  bool number_float(number_float_t, const string_t& text) override {
    if (in_sizes_)
      refuse_value(text);
    return number(number_of(text, name_, file_));
  }

  bool start_object(std::size_t) override {
    ++depth_;
    if (depth_ == 2 && name_ == size_key && !in_list_)
      in_sizes_ = true;
    else if (depth_ != 1)
      refuse_value("an object");
    return true;
  }
  bool end_object() override {
    --depth_;
    in_sizes_ = false;
    return true;
  }
  bool key(string_t& name) override {
    name_ = name;
    if (!seen_.insert({in_sizes_, name}).second)
      refuse_file(file_, fmt::format("\"{}\" stands twice", on_one_line(name)));
    return true;
  }
  bool start_array(std::size_t) override {
    ++depth_;
    if (in_sizes_ ? depth_ != 3 : depth_ < 2 || name_ == size_key)
      refuse_value("a list");
    if (in_sizes_)
      sizes_[name_];
    else if (in_list_++ == 0)
      lists_.push_back({name_, {}});
    return true;
  }
  bool end_array() override {
    --depth_;
    if (!in_sizes_)
      --in_list_;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception&) override {
    refuse_file(file_, fmt::format("no JSON: the fault is at byte {}", position));
  }

 private:
  bool number(float value) {
    if (!in_list_)
      refuse_value("a number");
    lists_.back().second.push_back(value);
    return true;
  }
  [[noreturn]] void refuse_value(std::string_view what) const {
    refuse_file(file_,
                fmt::format("{} {}; allowed: an object of lists of numbers, and their sizes as "
                            "[width, height, layers, channels]",
                            name_.empty() ? "it is" : fmt::format("\"{}\" has", on_one_line(name_)),
                            on_one_line(std::string(what))));
  }

  const fs::path& file_;
  std::size_t depth_ = 0, in_list_ = 0;
  bool in_sizes_ = false;
  std::string name_;
  std::set<std::pair<bool, std::string>> seen_;
  std::vector<std::pair<std::string, std::vector<float>>> lists_;
  std::map<std::string, std::vector<std::uint64_t>> sizes_;
};

}  // namespace

std::string encode_json(const std::vector<Image>& images) {
  require_writable(images, is_json_name, "any text but \"size\"");
  std::string text = "{\n\"size\": {";
  for (const Image& image : images)
    text +=
        fmt::format("{}{}: [{}, {}, {}, {}]", &image == images.data() ? "" : ", ",
                    json_text(image.name), image.width, image.height, image.layers, image.channels);
  text += '}';
  for (const Image& image : images) {
    text += fmt::format(",\n{}: [", json_text(image.name));
    append_values(text, image, "");
    text += ']';
  }
  return text + "\n}\n";
}

std::string encode_javascript(const std::vector<Image>& images, std::string_view declaration) {
  require_writable(images, is_identifier, identifier_rule);
  std::string text;
  for (const Image& image : images) {
    text += size_comment(image) + fmt::format("{} {} = [", declaration, image.name);
    append_values(text, image, "");
    text += "];\n";
  }
  return text;
}

std::string encode_c_header(const std::vector<Image>& images, std::string_view guard_name) {
  require_writable(images, is_identifier, identifier_rule);
  if (!is_identifier(guard_name))
    throw InputError(fmt::format("include guard \"{}\"; allowed: {}", guard_name, identifier_rule));
  std::string text = fmt::format("#ifndef {0}\n#define {0}\n", guard_name);
  for (const Image& image : images) {
    text += '\n' + size_comment(image) +
            fmt::format("static const float {}[{}] = {{", image.name, image.values.size());
    append_values(text, image, "f");
    text += "};\n";
  }
  return text + "\n#endif\n";
}

std::string encode_c_sharp(const std::vector<Image>& images) {
  require_writable(images, is_identifier, identifier_rule);
  std::string text =
      "namespace UnityEngine.Rendering.HighDefinition\n{\n"
      "    internal partial class LTCAreaLight\n    {\n";
  for (Image image : images) {
    image.precision = Precision::half;
    require_storable(image);
    text +=
        fmt::format("        internal static ushort[] {} = new ushort[{} * {} * {}]\n        {{",
                    image.name, image.width, image.height * image.layers, image.channels);
    const std::string bytes = value_bytes(image);
    for (std::size_t i = 0; i < image.values.size(); ++i)
      text += fmt::format("{}{},", i % image.channels ? " " : "\n            ",
                          number_at<std::uint16_t>(bytes, 2 * i));
    text += "\n        };\n";
  }
  return text + "    }\n}\n";
}

std::vector<Image> decode_json(std::string_view text, const fs::path& file) {
  Collector collector(file);
  nlohmann::json::sax_parse(text.begin(), text.end(), &collector);
  return collector.finish();
}

}  // namespace ltc
