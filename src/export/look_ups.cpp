// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/look_ups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>

#include "core/angle.h"
#include "core/file.h"
#include "core/range.h"
#include "export/npy_header.h"

namespace ltc {
namespace {

// The last two of folded lobes alone.
constexpr std::array<std::string_view, 17> columns = {
    "alpha_x", "alpha_y", "theta", "phi", "m00",       "m01",     "m02", "m10", "m11",
    "m12",     "m20",     "m21",   "m22", "amplitude", "fresnel", "k",   "g"};

std::size_t column_count(const std::vector<LookUp>& found) {
  return columns.size() - (found.empty() || found.front().creases.empty() ? 2 : 0);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(',');
    cells.push_back(trimmed(line.substr(0, end)));
    line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
  }
  return cells;
}

class QueryReader {
 public:
  QueryReader(const std::filesystem::path& file, const LobeModel& model)
      : file_(file), model_(model) {}

  std::vector<Lobe> read(std::string_view text) {
    std::vector<Lobe> lobes;
    if (constexpr std::string_view mark = "\xef\xbb\xbf"; text.starts_with(mark))
      text.remove_prefix(mark.size());  // as spreadsheets write it
    for (std::size_t number = 1; !text.empty(); ++number) {
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      if (trimmed(line).empty())
        continue;
      if (alpha_x_.name.empty())
        find_columns(cells_of(line));
      else
        lobes.push_back(lobe_of(cells_of(line), number));
    }
    if (alpha_x_.name.empty())
      refuse_file(file_, "no line; expected one that names alpha_x, alpha_y, theta and phi");
    return lobes;
  }

 private:
  struct Column {
    std::string name;
    std::size_t index = 0;
    double unit = 1;
  };

  Column column(const std::vector<std::string_view>& names, const std::string& name,
                bool angle) const {
    for (const auto& [wanted, unit] :
         {std::pair(name, 1.0), std::pair(name + "_degrees", radians_per_degree)})
      if (const auto found = std::ranges::find(names, wanted);
          found != names.end() && (angle || unit == 1))
        return {wanted, static_cast<std::size_t>(found - names.begin()), unit};
    refuse_file(
        file_,
        fmt::format("its first line names no column {}{}; expected alpha_x, alpha_y, theta and "
                    "phi in radians, or theta_degrees and phi_degrees",
                    name, angle ? " or " + name + "_degrees" : ""));
  }

  void find_columns(const std::vector<std::string_view>& names) {
    alpha_y_ = column(names, "alpha_y", false);
    theta_ = column(names, "theta", true);
    phi_ = column(names, "phi", true);
    alpha_x_ = column(names, "alpha_x", false);
  }

  double value(const std::vector<std::string_view>& cells, const Column& column,
               const Range& allowed, std::size_t line) const {
    const std::string_view text = column.index < cells.size() ? cells[column.index] : "";
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number) ||
        !allowed.contains(number * column.unit))
      refuse_file(
          file_,
          fmt::format("line {}: {} is \"{}\"; allowed: {}", line, column.name, text,
                      Range{allowed.least / column.unit, allowed.most / column.unit}.text()));
    return number * column.unit;
  }

  Lobe lobe_of(const std::vector<std::string_view>& cells, std::size_t line) const {
    const double quarter_turn = std::numbers::pi / 2 * (1 + 1e-9);
    return {value(cells, alpha_x_, {0, 1}, line), value(cells, alpha_y_, {0, 1}, line),
            value(cells, theta_, {0, quarter_turn}, line), value(cells, phi_, {-1e6, 1e6}, line),
            &model_};
  }

  std::filesystem::path file_;
  const LobeModel& model_;
  Column alpha_x_, alpha_y_, theta_, phi_;
};

std::array<float, columns.size()> values_of(const Lobe& lobe, const LookUp& found) {
  std::array<float, columns.size()> values{
      static_cast<float>(lobe.alpha_x), static_cast<float>(lobe.alpha_y),
      static_cast<float>(lobe.theta_radians), static_cast<float>(lobe.phi_radians)};
  for (int entry = 0; entry < 9; ++entry)
    values[4 + static_cast<std::size_t>(entry)] =
        static_cast<float>(found.matrix(entry / 3, entry % 3));
  values[13] = static_cast<float>(found.amplitude);
  values[14] = static_cast<float>(found.fresnel);
  values[15] = static_cast<float>(found.fold.k);
  values[16] = static_cast<float>(found.fold.g);
  return values;
}

}  // namespace

std::vector<Lobe> parse_queries(std::string_view text, const std::filesystem::path& file,
                                const LobeModel& model) {
  return QueryReader(file, model).read(text);
}

std::string look_ups_csv(const std::vector<Lobe>& queries, const std::vector<LookUp>& found) {
  const std::size_t count = column_count(found);
  std::string text = fmt::format("{}\n", fmt::join(std::span(columns).first(count), ","));
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto values = values_of(queries[i], found[i]);
    text += fmt::format("{}\n", fmt::join(std::span(values).first(count), ","));
  }
  return text;
}

std::string look_ups_json(const std::vector<Lobe>& queries, const std::vector<LookUp>& found) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < queries.size(); ++i) {
    nlohmann::ordered_json row;
    const auto values = values_of(queries[i], found[i]);
    for (std::size_t column = 0; column < column_count(found); ++column)
      row[columns[column]] = values[column];  // null where there is none
    rows.push_back(row);
  }
  return rows.dump(1) + "\n";
}

std::string look_ups_npy(const std::vector<Lobe>& queries, const std::vector<LookUp>& found) {
  const std::size_t count = column_count(found);
  std::string bytes = npy_header(std::array{queries.size(), count});
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto values = values_of(queries[i], found[i]);
    bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof values.front());
  }
  return bytes;
}

}  // namespace ltc
