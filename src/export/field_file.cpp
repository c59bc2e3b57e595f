// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/field_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "brdf/lobe_model.h"
#include "core/error.h"
#include "core/file.h"
#include "core/read_file.h"
#include "core/write_file.h"
#include "export/consistency.h"
#include "table/field_table.h"

namespace ltc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view format_name = "ltc-field";

// Of a field with the most coefficients there can be, and a long config.
constexpr std::size_t most_bytes = 4 << 20;

// Of a matrix and of the albedo as config allows them, with room.
constexpr std::size_t most_terms = 16384;

// What 16 bits hold; fields have no use for more.
constexpr float most_coefficient = 65504;

// As configs have it.
constexpr double least_alpha_min = 1e-6;

// How to read the terms, for people; readers go by `basis`.
Json variables() {
  return {{"alpha", "the larger roughness, alpha_x of the folded lobe, at least alpha_min"},
          {"lambda", "the smaller one over the larger"},
          {"r",
           "sqrt(b / sqrt(2)), b = sqrt(cos(theta)^2 + (alpha_x cos(phi))^2 + (alpha_y "
           "sin(phi))^2)"},
          {"w", "cos(theta) / b"},
          {"term",
           "[i, j, k, l, m]: T_i(2 alpha - 1) L_j(lambda) T_k(2 r - 1) T_l(2 w - 1) "
           "F_m(phi)"}};
}

// The shortest that reads back as the same float.
Json number(float value) {
  return Json::parse(fmt::format("{}", value));
}

Json json_of(const Field& field, FieldPart part) {
  Json terms = Json::array(), coefficients = Json::array();
  for (std::size_t i = 0; i < field.terms.size(); ++i)
    if (field.terms[i].part == part) {
      terms.push_back(numbers_of(field.terms[i]));
      coefficients.push_back(number(field.coefficients[i]));
    }
  return {{"terms", terms}, {"coefficients", coefficients}};
}

// Those of the fold are there where there are creases.
std::size_t part_count(const Field& field) {
  return field_part_count - (field.creases.empty() ? field_fold_part_count : 0);
}

class Reader {
 public:
  Reader(std::string_view text, const fs::path& file) : file_(file) {
    if (text.size() > most_bytes)
      refuse_file(file_, fmt::format("{} bytes long; allowed: {}", text.size(), most_bytes));
    json_ = Json::parse(text, nullptr, false);
    if (!json_.is_object())
      refuse_file(file_, "no JSON object");
  }

  Table table() const {
    require("format", format_name);
    require("format_version", field_format_version);
    Field field;
    require("basis", basis_name(json_.contains("creases")));
    field.alpha_min = real("alpha_min");
    if (!(field.alpha_min >= least_alpha_min && field.alpha_min <= 1))
      refuse_file(file_, fmt::format("alpha_min is {}; allowed: {} to 1", field.alpha_min,
                                     least_alpha_min));
    try {
      field.model = &lobe_model(text("brdf"));
    } catch (const InputError& error) {
      refuse_file(file_, fmt::format("brdf: {}", error.what()));
    }
    read_material(field);
    const Json& parts = member(json_, "parts", "the file");
    read_creases(field);
    for (std::size_t part = 0; part < part_count(field); ++part)
      read_part(parts, static_cast<FieldPart>(part), field);
    require_consistent(field, file_);
    Table table = table_of_field(field, Grid::paper(), Storage::matrix);
    table.config = optional_text("config");
    table.generator = optional_text("generator");
    table.created = optional_text("created");
    if (const auto seed = json_.find("seed"); seed != json_.end() && seed->is_number_unsigned())
      table.seed = seed->get<std::uint64_t>();
    return table;
  }

 private:
  const Json& member(const Json& json, const std::string& name, std::string_view of) const {
    const auto at = json.is_object() ? json.find(name) : json.end();
    if (at == json.end())
      refuse_file(file_, fmt::format("{} has no \"{}\"", of, name));
    return *at;
  }
  template <typename Value>
  void require(const std::string& name, const Value& expected) const {
    if (const Json& value = member(json_, name, "the file"); value != Json(expected))
      refuse_file(file_, fmt::format("{} is {}; allowed: {}", name, short_text(value),
                                     Json(expected).dump()));
  }
  // What stands in a message: on one line, and not all of a long list.
  static std::string short_text(const Json& value) {
    constexpr std::size_t most = 40;
    std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    if (text.size() > most)
      text = text.substr(0, most) + "…";
    return text;
  }
  double real(const std::string& name) const {
    const Json& value = member(json_, name, "the file");
    if (!value.is_number())
      refuse_file(file_, fmt::format("{} is {}; allowed: a number", name, short_text(value)));
    return value.get<double>();
  }
  std::string text(const std::string& name) const {
    const Json& value = member(json_, name, "the file");
    if (!value.is_string())
      refuse_file(file_, fmt::format("{} is {}; allowed: a text", name, short_text(value)));
    return value.get<std::string>();
  }
  std::string optional_text(const std::string& name) const {
    return json_.contains(name) ? text(name) : "";
  }

  // Of a folded field alone.
  void read_creases(Field& field) const {
    const auto json = json_.find("creases");
    if (json == json_.end())
      return;
    if (!json->is_array() || !std::all_of(json->begin(), json->end(),
                                          [](const Json& value) { return value.is_number(); }))
      refuse_file(file_, fmt::format("creases are {}; expected numbers", short_text(*json)));
    field.creases = json->get<Creases>();
    require_creases(field.creases, file_);
  }

  void read_material(Field& field) const {
    const auto json = json_.find("material");
    if (json == json_.end())
      return;
    const auto is_roughness = [&](const Json& value) {
      return value.is_number() && value.get<double>() >= field.alpha_min &&
             value.get<double>() <= 1;
    };
    if (!json->is_array() || json->size() != 2 ||
        !std::all_of(json->begin(), json->end(), is_roughness) || (*json)[0] < (*json)[1])
      refuse_file(file_,
                  fmt::format("material is {}; allowed: the larger and the smaller roughness, "
                              "alpha_min to 1",
                              short_text(*json)));
    field.material = json->get<std::array<double, 2>>();
  }

  FieldTerm term_of(const Json& json, FieldPart part) const {
    const auto is_degree = [](const Json& value) {
      return value.is_number_unsigned() && value.get<std::uint64_t>() <= field_most_degree;
    };
    if (!json.is_array() || json.size() != numbers_of({}).size() ||
        !std::all_of(json.begin(), json.end(), is_degree))
      refuse_file(file_, fmt::format("term {} of {}; allowed: five whole numbers up to {}",
                                     short_text(json), name_of(part), field_most_degree));
    const auto n = json.get<std::array<std::uint8_t, 5>>();
    return {part, n[0], n[1], n[2], n[3], n[4]};
  }

  void read_part(const Json& parts, FieldPart part, Field& field) const {
    const std::string name(name_of(part));
    const Json& json = member(parts, name, "\"parts\"");
    const Json& terms = member(json, "terms", name);
    const Json& coefficients = member(json, "coefficients", name);
    if (!terms.is_array() || !coefficients.is_array() || terms.size() != coefficients.size())
      refuse_file(file_, fmt::format("{} has {} terms and {} coefficients; as many are needed",
                                     name, terms.size(), coefficients.size()));
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Json& value = coefficients[i];
      if (!value.is_number() || !std::isfinite(static_cast<float>(value.get<double>())))
        refuse_file(file_, fmt::format("coefficient {} of {} is {}; allowed: a finite number", i,
                                       name, short_text(value)));
      field.terms.push_back(term_of(terms[i], part));
      field.coefficients.push_back(static_cast<float>(value.get<double>()));
    }
  }

  const fs::path& file_;
  Json json_;
};

}  // namespace

std::array<std::uint8_t, 5> numbers_of(const FieldTerm& term) {
  return {term.alpha, term.lambda, term.radius, term.angle, term.order};
}

void require_consistent(const Field& field, const fs::path& file) {
  if (field.terms.size() != field.coefficients.size() || field.terms.size() > most_terms)
    refuse_file(file, fmt::format("{} terms and {} coefficients; allowed: as many, up to {}",
                                  field.terms.size(), field.coefficients.size(), most_terms));
  for (std::size_t i = 0; i < field.terms.size(); ++i) {
    const FieldTerm& term = field.terms[i];
    const auto refuse = [&](std::string_view what) {
      refuse_file(file, fmt::format("term [{}] of {}: {}", fmt::join(numbers_of(term), ", "),
                                    name_of(term.part), what));
    };
    if (!is_allowed(term))
      refuse("symmetry does not allow it");
    if (i > 0 && !(field.terms[i - 1] < term))
      refuse("it stands twice, or not in rising order");
    if (!(std::abs(field.coefficients[i]) <= most_coefficient))
      refuse(fmt::format("its coefficient is {}; allowed: up to {}", field.coefficients[i],
                         most_coefficient));
  }
}

std::string encode_field(const Table& table) {
  const Field& field = *table.field;
  Json json = {{"format", format_name},
               {"format_version", field_format_version},
               {"basis", basis_name(!field.creases.empty())},
               {"brdf", field.model->name()},
               {"alpha_min", field.alpha_min},
               {"generator", table.generator},
               {"created", table.created},
               {"seed", table.seed},
               {"config", table.config},
               {"variables", variables()}};
  if (field.material)
    json["material"] = *field.material;
  if (!field.creases.empty())
    json["creases"] = field.creases;
  for (std::size_t i = 0; i < part_count(field); ++i) {
    const auto part = static_cast<FieldPart>(i);
    json["parts"][std::string(name_of(part))] = json_of(field, part);
  }
  return json.dump() + "\n";
}

bool is_field(std::string_view text) {
  const std::string_view start = text.substr(0, 64);
  return start.find("\"format\"") != std::string_view::npos &&
         start.find(format_name) != std::string_view::npos;
}

Table decode_field(std::string_view text, const fs::path& file) {
  return Reader(text, file).table();
}

Format field_format() {
  return {.name = "field JSON",
          .sets = {{"_field.json"}},
          .asked = &OutputSettings::field,
          .contents = {.albedo = true, .loss = false},
          .of_fields = true,
          .of_materials = true,
          .of_folded = true,
          .read =
              [](const TableFiles& files, const ReadAs&) {
                require_readable(files.front());
                return decode_field(read_whole_file(files.front(), "field", most_bytes),
                                    files.front());
              },
          .add = [](platform::FileSet& set, const Table& table, const TableFiles& files,
                    const WriteOptions&) { add_file(set, files.front(), encode_field(table)); }};
}

}  // namespace ltc
