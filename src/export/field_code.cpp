// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "export/field_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

namespace ltc {
namespace {

// How a language writes what the description consists of.
struct Spelling {
  std::string_view constant;  // before the name of a value that stays
  std::string_view variable;  // and of one that does not
  std::string_view suffix;    // of a number
  std::string_view library;   // before sqrt, max and so on
  std::string_view library_suffix;
  std::string_view maximum, minimum;
  std::string_view conditional;  // of condition, value if so, and if not
};

const Spelling& spelling(CodeLanguage language) {
  static const std::array<Spelling, 5> all = {{
      {"const float ", "float ", "f", "", "f", "fmaxf", "fminf", "({0} ? {1} : {2})"},
      {"const ", "let ", "", "Math.", "", "Math.max", "Math.min", "({0} ? {1} : {2})"},
      {"float ", "float ", "", "", "", "max", "min", "({0} ? {1} : {2})"},
      {"float ", "float ", "", "", "", "max", "min", "({0} ? {1} : {2})"},
      {"let ", "var ", "", "", "", "max", "min", "select({2}, {1}, {0})"},
  }};
  return all[static_cast<std::size_t>(language)];
}

// Writes statements in the words of a language.
class Writer {
 public:
  explicit Writer(CodeLanguage language) : spelling_(spelling(language)) {}

  void constant(std::string_view name, const std::string& value) {
    line(spelling_.constant, name, value);
  }
  void variable(std::string_view name, const std::string& value) {
    line(spelling_.variable, name, value);
  }
  void assign(std::string_view name, const std::string& value) { line("", name, value); }

  std::string number(float value) const { return float_literal(value, spelling_.suffix); }
  std::string root(std::string_view of) const {
    return fmt::format("{}sqrt{}({})", spelling_.library, spelling_.library_suffix, of);
  }
  std::string larger(std::string_view a, std::string_view b) const {
    return fmt::format("{}({}, {})", spelling_.maximum, a, b);
  }
  std::string smaller(std::string_view a, std::string_view b) const {
    return fmt::format("{}({}, {})", spelling_.minimum, a, b);
  }
  std::string chosen(std::string_view condition, std::string_view a, std::string_view b) const {
    return fmt::format(fmt::runtime(spelling_.conditional), condition, a, b);
  }
  std::string take() { return std::move(text_); }

 private:
  void line(std::string_view prefix, std::string_view name, const std::string& value) {
    text_ += fmt::format("  {}{} = {};\n", prefix, name, value);
  }

  const Spelling& spelling_;
  std::string text_;
};

struct Factor {
  char name;               // of its values in the code
  std::size_t degree = 0;  // 0: it is 1
};

// Of the product of values in `factors`, one of each: a term of a sum.
struct Product {
  std::vector<Factor> factors;
  float coefficient;
};

// The sum of products, nested: the terms of each value of the first factor are summed before they
// are multiplied with it.
std::string nested_sum(const Writer& writer, std::vector<Product> terms) {
  if (terms.front().factors.empty())
    return writer.number(terms.front().coefficient);
  std::map<std::size_t, std::vector<Product>> by_degree;
  const char name = terms.front().factors.front().name;
  for (Product& term : terms) {
    const std::size_t degree = term.factors.front().degree;
    term.factors.erase(term.factors.begin());
    by_degree[degree].push_back(std::move(term));
  }
  std::string text;
  for (auto& [degree, inner] : by_degree) {
    const std::string value = nested_sum(writer, std::move(inner));
    const bool bare = value.find(" + ") == std::string::npos;
    text += text.empty() ? "" : " + ";
    text += degree == 0 ? value
                        : fmt::format("{}{} * {}{}{}", name, degree, bare ? "" : "(", value,
                                      bare ? "" : ")");
  }
  return text;
}

std::string name_in_code(FieldPart part) {
  return "f_" + std::string(name_of(part));
}

// T_1 .. of 2 u - 1 as name1 ..., or L_1 ... .
void write_chebyshev(Writer& writer, char name, std::string_view u, std::size_t most) {
  if (most == 0)
    return;
  writer.constant(fmt::format("{}1", name),
                  fmt::format("{} * {} - {}", writer.number(2), u, writer.number(1)));
  for (std::size_t i = 2; i <= most; ++i)
    writer.constant(
        fmt::format("{}{}", name, i),
        i == 2 ? fmt::format("{0} * {1}1 * {1}1 - {2}", writer.number(2), name, writer.number(1))
               : fmt::format("{} * {}1 * {}{} - {}{}", writer.number(2), name, name, i - 1, name,
                             i - 2));
}

struct Degrees {
  std::size_t alpha = 0, lambda = 0, radius = 0, angle = 0, albedo_radius = 0, albedo_angle = 0,
              order = 0;
};
Degrees most_degrees(const Field& field) {
  Degrees most;
  const auto raise = [](std::size_t& value, std::uint8_t degree) {
    value = std::max<std::size_t>(value, degree);
  };
  for (const FieldTerm& term : field.terms) {
    const bool of_albedo = is_of_albedo(term.part);
    raise(most.alpha, term.alpha);
    raise(most.lambda, term.lambda);
    raise(of_albedo ? most.albedo_radius : most.radius, term.radius);
    raise(of_albedo ? most.albedo_angle : most.angle, term.angle);
    raise(most.order, term.order);
  }
  return most;
}

void write_variables(Writer& writer, const Field& field) {
  const auto n = [&](double value) { return writer.number(static_cast<float>(value)); };
  // Equation (14): the larger roughness along x.
  writer.constant("swapped", "alpha_y > alpha_x");
  writer.constant("alpha", field.material ? n((*field.material)[0])
                                          : writer.larger(writer.larger("alpha_x", "alpha_y"),
                                                          n(field.alpha_min)));
  writer.constant("beta", field.material ? n((*field.material)[1])
                                         : writer.larger(writer.smaller("alpha_x", "alpha_y"),
                                                         n(field.alpha_min)));
  writer.constant("lambda", "beta / alpha");
  writer.constant("x", writer.chosen("swapped", "vy", "vx"));
  writer.constant("y", writer.chosen("swapped", "vx", "vy"));
  writer.constant("s2", "x * x + y * y");
  writer.constant("s", writer.root("s2"));
  writer.constant("cx", writer.chosen("s > " + n(0), "x / s", n(1)));
  writer.constant("cy", writer.chosen("s > " + n(0), "y / s", n(0)));
  writer.constant("least", n(field_least_width) + " * alpha");
  writer.constant(
      "beta_s",
      "alpha * " + writer.root(fmt::format(
                       "lambda * lambda + least * least * ({} - lambda * lambda)", n(1))));
  writer.constant("along", "alpha * alpha * x * x + beta_s * beta_s * y * y");
  writer.constant("b", writer.root("vz * vz + along"));
  writer.constant("b_albedo", writer.root("vz * vz + alpha * alpha * x * x + beta * beta * y * y"));
  writer.constant("c2", fmt::format("cx * cx - cy * cy"));
  writer.constant("d2", fmt::format("{} * cx * cy", n(2)));
}

void write_basis(Writer& writer, const Degrees& most) {
  write_chebyshev(writer, 'a', "alpha", most.alpha);
  write_chebyshev(writer, 'r', writer.root("b"), most.radius);
  write_chebyshev(writer, 'w', "(vz / b)", most.angle);
  write_chebyshev(writer, 'q', writer.root("b_albedo"), most.albedo_radius);
  write_chebyshev(writer, 'z', "(vz / b_albedo)", most.albedo_angle);
  if (most.lambda > 0)
    writer.constant("l1", writer.number(1) + " - lambda");
  if (most.lambda > 1) {
    writer.constant("lx", fmt::format("{} * lambda - {}", writer.number(2), writer.number(1)));
    writer.constant("l2", "l1 * lx");
  }
  for (std::size_t j = 3; j <= most.lambda; ++j)
    writer.constant(fmt::format("l{}", j),
                    fmt::format("{} * lx * l{} - l{}", writer.number(2), j - 1, j - 2));
  // c and d: cosine and sine of m phi times s or s^2.
  for (std::size_t m = 1; m <= std::max<std::size_t>(most.order, 2); ++m) {
    const std::string c = fmt::format("g{}", m), d = fmt::format("h{}", m);
    if (m <= 2) {
      writer.constant(c, m == 1 ? "x" : "s2 * c2");
      writer.constant(d, m == 1 ? "y" : "s2 * d2");
      continue;
    }
    writer.constant(c, fmt::format("g{0} * c2 - h{0} * d2", m - 2));
    writer.constant(d, fmt::format("h{0} * c2 + g{0} * d2", m - 2));
  }
}

void write_parts(Writer& writer, const Field& field) {
  for (std::size_t i = 0; i < field_part_count; ++i) {
    const auto part = static_cast<FieldPart>(i);
    if (is_of_fold(part) && field.creases.empty())
      continue;
    const bool of_albedo = is_of_albedo(part);
    // By order and degree in lambda a statement each, so that none is too long for a compiler.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Product>> groups;
    for (std::size_t t = 0; t < field.terms.size(); ++t)
      if (const FieldTerm& term = field.terms[t]; term.part == part)
        groups[{term.order, term.lambda}].push_back({{{'a', term.alpha},
                                                      {of_albedo ? 'q' : 'r', term.radius},
                                                      {of_albedo ? 'z' : 'w', term.angle}},
                                                     field.coefficients[t]});
    const std::string name = name_in_code(part);
    writer.variable(name, writer.number(0));
    for (auto& [outer, terms] : groups) {
      const std::string value = nested_sum(writer, std::move(terms));
      std::string factor;
      if (outer.first > 0)
        factor += fmt::format("{}{} * ", is_sine(part) ? 'h' : 'g', outer.first);
      if (outer.second > 0)
        factor += fmt::format("l{} * ", outer.second);
      writer.assign(name, fmt::format("{} + {}({})", name, factor, value));
    }
  }
}

// Equation (14) the other way: where axes were exchanged, rows and columns are, for a cosine does
// not feel what its columns are turned by. A fold does: there the rows alone are exchanged, and the
// first column is negated, which nothing feels, so that the determinant stays positive.
void write_unswapped(Writer& writer, bool folded) {
  const auto name = [](int row, int column) {
    return row == 2 ? fmt::format("m2{}_", column) : fmt::format("n{}{}", row, column);
  };
  const auto other = [](int i) { return i == 2 ? 2 : 1 - i; };
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const std::string swapped =
          folded ? fmt::format("{}{}", column == 0 ? "-" : "", name(other(row), column))
                 : name(other(row), other(column));
      writer.constant(fmt::format("m{}{}", row, column),
                      writer.chosen("swapped", swapped, name(row, column)));
    }
}

void write_matrix(Writer& writer, bool folded) {
  const auto n = [&](double value) { return writer.number(static_cast<float>(value)); };
  writer.constant("far", writer.root("vz * vz + alpha * alpha * s2"));
  writer.constant("k", "alpha * alpha / far");
  writer.constant("h", n(1) + " / " + writer.root("far"));
  writer.variable("t00", "f_A + g2 * f_B + f_m00");
  writer.constant("t01", "h2 * f_B + f_m01");
  writer.constant("t02", "k * (x * f_C + f_m02)");
  writer.constant("t10", "h2 * f_B + f_m10");
  writer.variable("t11", "f_A - g2 * f_B + f_m11");
  writer.constant("t12", "k * (y * f_C + f_m12)");
  writer.constant("t20", "h * (x * f_D + f_m20)");
  writer.constant("t21", "h * (y * f_D + f_m21)");
  writer.constant("own", fmt::format("beta * ({} - vz)", n(1)));
  writer.constant("t22", fmt::format("{} - {} * own * own", n(1), n(field_own_factor)));
  // Where the determinant would be too small.
  writer.constant("p", n(1) + " / t22");
  writer.constant("u00", "t00 - t02 * t20 * p");
  writer.constant("u11", "t11 - t12 * t21 * p");
  writer.constant("lacking",
                  writer.larger(fmt::format("{} * p - (u00 * u11 - (t01 - t02 * t21 * p) * (t10 - "
                                            "t12 * t20 * p))",
                                            n(field_least_determinant)),
                                n(0)));
  writer.constant("trace", "u00 + u11");
  writer.constant("root", writer.root(fmt::format("trace * trace + {} * lacking", n(4))));
  writer.constant(
      "mu", writer.chosen("trace > " + n(0), fmt::format("{} * lacking / (root + trace)", n(2)),
                          fmt::format("{} * (root - trace)", n(0.5))));
  writer.assign("t00", "t00 + mu");
  writer.assign("t11", "t11 + mu");
  // Foreshortening across the plane of incidence, then the rotation to the mirror direction.
  writer.constant("u",
                  fmt::format("{} - {}", writer.root("vz * vz + " + writer.root("along")), n(1)));
  writer.constant("i", n(1) + " / (" + n(1) + " + vz)");
  for (int column = 0; column < 3; ++column) {
    const std::string scale = column == 0 ? "alpha * " : column == 1 ? "beta_s * " : "";
    writer.constant(fmt::format("e{}", column),
                    fmt::format("u * (t1{0} * cx - t0{0} * cy)", column));
    writer.constant(fmt::format("p0{}", column),
                    fmt::format("{1}(t0{0} - e{0} * cy)", column, scale));
    writer.constant(fmt::format("p1{}", column),
                    fmt::format("{1}(t1{0} + e{0} * cx)", column, scale));
    writer.constant(fmt::format("p2{}", column), fmt::format("{1}t2{0}", column, scale));
    writer.constant(
        fmt::format("n0{}", column),
        fmt::format("(vz + y * y * i) * p0{0} - x * y * i * p1{0} - x * p2{0}", column));
    writer.constant(
        fmt::format("n1{}", column),
        fmt::format("(vz + x * x * i) * p1{0} - x * y * i * p0{0} - y * p2{0}", column));
    writer.constant(fmt::format("m2{}_", column),
                    fmt::format("x * p0{0} + y * p1{0} + vz * p2{0}", column));
  }
  write_unswapped(writer, folded);
}

void write_fold(Writer& writer, const Field& field) {
  const auto most = static_cast<float>(most_fold(field.creases));
  writer.constant("fold_k", "alpha * alpha * f_kappa / beta_s");
  writer.constant("fold_g",
                  std::isfinite(most) ? writer.smaller("f_gamma", writer.number(most)) : "f_gamma");
  writer.constant("fold_h", writer.number(static_cast<float>(field.creases.front())));
}

void write_albedo(Writer& writer) {
  const std::string zero = writer.number(0), one = writer.number(1);
  writer.constant("amplitude", writer.smaller(writer.larger("f_amplitude", zero), one));
  writer.constant("away", writer.smaller(writer.larger(one + " - f_view_cosine", zero), one));
  writer.constant("away2", "away * away");
  writer.constant("fresnel", "amplitude * away2 * away2 * away");
}

// C's compilers warn of values that this field happens not to need.
std::string unused(const Field& field) {
  const std::size_t most = std::max<std::size_t>(most_degrees(field).order, 2);
  std::string text = "  (void)b, (void)b_albedo, (void)c2, (void)d2";
  for (std::size_t m = most - 1; m <= most; ++m)
    text += fmt::format(", (void)g{0}, (void)h{0}", m);
  return text + ";\n";
}

// What of the roughnesses a function of one material looks at.
std::string material_text(const Field& field) {
  return field.material ? fmt::format(
                              "\n// Of the material with roughnesses {} and {} alone; which "
                              "is along x, alpha_x > alpha_y says.",
                              (*field.material)[0], (*field.material)[1])
                        : "";
}

constexpr std::string_view what_it_is =
    "The lobe that anisotropic GGX reflects, as a linearly transformed cosine: the matrix M "
    "(clamped\n"
    "// cosine to lobe, tangent frame, positive determinant), amplitude and Fresnel term. Shading "
    "is\n"
    "// (F0 * amplitude + (1 - F0) * fresnel) * (share of the lobe's light, by the inverse of M).";

constexpr std::string_view what_a_folded_one_is =
    "The lobe that anisotropic GGX reflects, as a folded linearly transformed cosine: M fold(o), o "
    "a\n"
    "// direction of the clamped cosine, fold(x, y, z) = (x, y + k u, z + g u), u = max(0, |x| - h "
    "z); the\n"
    "// matrix M (tangent frame, positive determinant), amplitude, Fresnel term and k, g, h. "
    "Shading is\n"
    "// (F0 * amplitude + (1 - F0) * fresnel) * (share of the lobe's light: shaders/ltc_folded).";

// What the function of a language differs by where it tells of a fold.
struct FunctionParts {
  std::string_view name, parameter, statement;
};
FunctionParts function_parts(const Field& field, CodeLanguage language) {
  if (field.creases.empty())
    return {"ltcLookUp", "", ""};
  switch (language) {
    case CodeLanguage::javascript:
      return {"ltcLookUpFolded", "", ", fold: { k: fold_k, g: fold_g, h: fold_h }"};
    case CodeLanguage::glsl:
      return {"ltcLookUpFolded", ", out vec3 fold", "  fold = vec3(fold_k, fold_g, fold_h);\n"};
    case CodeLanguage::hlsl:
      return {"ltcLookUpFolded", ", out float3 fold", "  fold = float3(fold_k, fold_g, fold_h);\n"};
    default:
      return {"ltcLookUpFolded", ", fold: vec3<f32>", ", vec3<f32>(fold_k, fold_g, fold_h)"};
  }
}

}  // namespace

std::string float_literal(float value, std::string_view suffix) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos)
    text += ".0";
  return text.append(suffix);
}

std::string field_statements(const Field& field, CodeLanguage language) {
  Writer writer(language);
  write_variables(writer, field);
  write_basis(writer, most_degrees(field));
  write_parts(writer, field);
  write_matrix(writer, !field.creases.empty());
  write_albedo(writer);
  if (!field.creases.empty())
    write_fold(writer, field);
  std::string text = writer.take();
  // The one value that is no number.
  const std::string_view constant = spelling(language).constant;
  const std::string declared = std::string("  ") + std::string(constant) + "swapped";
  const std::string_view as = language == CodeLanguage::c      ? "  const int swapped"
                              : language == CodeLanguage::glsl ? "  bool swapped"
                              : language == CodeLanguage::hlsl ? "  bool swapped"
                                                               : "";
  if (!as.empty())
    text.replace(text.find(declared), declared.size(), as);
  if (language == CodeLanguage::c)
    text += unused(field);
  return text;
}

std::size_t field_multiplications(const Field& field) {
  const std::string text = field_statements(field, CodeLanguage::glsl);
  return static_cast<std::size_t>(std::ranges::count(text, '*'));
}

std::string field_function(const Field& field, CodeLanguage language) {
  const std::string body = field_statements(field, language);
  const std::string what =
      std::string(field.creases.empty() ? what_it_is : what_a_folded_one_is) + material_text(field);
  const auto [name, parameter, statement] = function_parts(field, language);
  switch (language) {
    case CodeLanguage::javascript:
      return fmt::format(
          R"(// {}
// `view` is a unit vector [x, y, z]; `matrix` is row-major.
export function {}(alpha_x, alpha_y, view) {{
  const [vx, vy, vz] = view;
{}  return {{ matrix: [m00, m01, m02, m10, m11, m12, m20, m21, m22], amplitude, fresnel{} }};
}}
)",
          what, name, body, statement);
    case CodeLanguage::glsl:
      return fmt::format(
          R"(// {}
// GLSL ES 3.00 and later.
void {}(float alpha_x, float alpha_y, vec3 view, out mat3 M, out vec2 albedo{}) {{
  float vx = view.x, vy = view.y, vz = view.z;
{}  M = mat3(m00, m10, m20, m01, m11, m21, m02, m12, m22);  // by columns
  albedo = vec2(amplitude, fresnel);
{}}}
)",
          what, name, parameter, body, statement);
    case CodeLanguage::hlsl:
      return fmt::format(
          R"(// {}
// Multiply as mul(M, direction).
void {}(float alpha_x, float alpha_y, float3 view, out float3x3 M, out float2 albedo{}) {{
  float vx = view.x, vy = view.y, vz = view.z;
{}  M = float3x3(m00, m01, m02, m10, m11, m12, m20, m21, m22);
  albedo = float2(amplitude, fresnel);
{}}}
)",
          what, name, parameter, body, statement);
    case CodeLanguage::wgsl:
      return fmt::format(
          R"(// {0}
struct {5} {{ matrix: mat3x3<f32>, amplitude: f32, fresnel: f32{2} }}
fn {1}(alpha_x: f32, alpha_y: f32, view: vec3<f32>) -> {5} {{
  let vx = view.x; let vy = view.y; let vz = view.z;
{3}  return {5}(mat3x3<f32>(m00, m10, m20, m01, m11, m21, m02, m12, m22), amplitude, fresnel{4});
}}
)",
          what, name, parameter, body, statement,
          field.creases.empty() ? "LtcFieldLobe" : "LtcFoldedFieldLobe");
    case CodeLanguage::c:
      break;
  }
  throw InputError("a field's function in C; allowed: JavaScript, GLSL, HLSL or WGSL");
}

}  // namespace ltc
