// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A table or a field as one C99 header: look-up, polygons, sampling, no dependency.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "core/file.h"
#include "core/write_file.h"
#include "export/c_header_parts.h"
#include "export/field_code.h"
#include "export/format.h"
#include "table/reduction.h"

namespace ltc {
namespace {

// Entries as text take a hundred bytes: beyond this no compiler likes the file.
constexpr std::size_t most_entries = 1 << 17;

constexpr std::string_view look_up_comment =
    R"(/* The lobe of roughnesses in either order, seen from theta, the angle from the normal in [0, pi/2),
   and phi, the azimuth from the direction of alpha_x in any quadrant; both in radians. */
static inline ltc_lobe ltc_look_up(float alpha_x, float alpha_y, float theta, float phi) {
)";

std::string field_look_up(const Field& field) {
  std::string text(look_up_comment);
  text +=
      R"(  const float vx = sinf(theta) * cosf(phi), vy = sinf(theta) * sinf(phi), vz = cosf(theta);
)";
  text += field_statements(field, CodeLanguage::c);
  text +=
      R"(  const ltc_lobe lobe = {{m00, m01, m02, m10, m11, m12, m20, m21, m22}, amplitude, fresnel)";
  text += field.creases.empty() ? "" : ", fold_k, fold_g, fold_h";
  return text + "};\n  return lobe;\n}\n";
}

std::string number(double value) {
  return float_literal(static_cast<float>(value), "f");
}

// Where a value stands on an axis, in nodes.
std::string axis_function(std::string_view name, const Axis& axis) {
  const double last = static_cast<double>(axis.size() - 1);
  std::string text = fmt::format("static inline float ltc_position_{}(float value) {{\n", name);
  if (axis.size() == 1)
    return text + "  (void)value;\n  return 0;\n}\n";
  if (axis.warp == Warp::half_sine)
    text +=
        fmt::format("  float x = sinf(0.5f * value) / {};\n", number(std::sin(axis.last() / 2)));
  else
    text += fmt::format("  float x = (value - {}) / {};\n", number(axis.first()),
                        number(axis.last() - axis.first()));
  text += "  x = x > 0 ? x < 1 ? x : 1 : 0;\n";
  if (axis.warp == Warp::sqrt)
    text += "  x = sqrtf(x);\n";
  if (axis.warp == Warp::complement_sqrt)
    text += "  x = 1 - sqrtf(1 - x);\n";
  return text + fmt::format("  return {} * x;\n}}\n", number(last));
}

std::size_t values_of_node(const Table& table) {
  return is_folded(table) ? 13 : 11;
}

std::string table_data(const Table& table) {
  std::string text = fmt::format(
      "/* Of each node, in C order of alpha, lambda, theta, phi: nine values row by row, "
      "amplitude,\n"
      "   Fresnel term{}. */\nstatic const float ltc_nodes[{}][{}] = {{\n",
      is_folded(table) ? ", kappa, gamma" : "", table.grid.size(), values_of_node(table));
  for (std::size_t flat = 0; flat < table.grid.size(); ++flat) {
    text += "{";
    for (std::size_t i = 0; i < 9; ++i)
      text += number(static_cast<double>(table.stored[9 * flat + i])) + ", ";
    text += number(static_cast<double>(table.amplitude[flat])) + ", " +
            number(static_cast<double>(table.fresnel[flat]));
    if (is_folded(table))
      text += ", " + number(static_cast<double>(table.fold[2 * flat])) + ", " +
              number(static_cast<double>(table.fold[2 * flat + 1]));
    text += "},\n";
  }
  return text + "};\n\n";
}

// S of the folded lobe to M.
std::string_view storage_code(Storage storage) {
  switch (storage) {
    case Storage::matrix:
      return "";
    case Storage::inverse:
      return R"(  {
    /* The adjugate, of the third column's length 1. */
    float inverse[9], length;
    for (i = 0; i < 3; ++i)
      for (j = 0; j < 3; ++j) {
        const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
        inverse[3 * i + j] = m[3 * r + c] * m[3 * s + d] - m[3 * r + d] * m[3 * s + c];
      }
    length = sqrtf(inverse[2] * inverse[2] + inverse[5] * inverse[5] + inverse[8] * inverse[8]);
    for (i = 0; i < 9; ++i) m[i] = inverse[i] / length;
  }
)";
    case Storage::roughness_scaled:
      return R"(  for (i = 0; i < 3; ++i) {
    m[3 * i] *= alpha;
    m[3 * i + 1] *= beta;
  }
)";
    case Storage::folded:
    case Storage::mirror_frame:
      return R"(  {
    const float x = sinf(theta) * cosf(phi), y = sinf(theta) * sinf(phi), z = cosf(theta);
    const float k = 1 / (1 + z);
    for (j = 0; j < 3; ++j) {
      const float scale = j == 0 ? alpha : j == 1 ? width : 1;
      const float a = scale * m[j], b = scale * m[3 + j], c = scale * m[6 + j];
      m[j] = (z + y * y * k) * a - x * y * k * b - x * c;
      m[3 + j] = (z + x * x * k) * b - x * y * k * a - y * c;
      m[6 + j] = x * a + y * b + z * c;
    }
  }
)";
  }
  return "";
}

// Equations (13) to (15) of Aakash et al. 2022, or the turn to the one azimuth of an isotropic
// table.
std::string fold_code(const Grid& grid) {
  const std::string least = number(grid.alpha_min);
  std::string text = R"(  const float pi = 3.14159265358979f;
  float sign_x = 1, sign_y = 1, turn = 0, alpha, beta, lambda;
  int swapped = alpha_y > alpha_x;
  alpha = swapped ? alpha_y : alpha_x;
  beta = swapped ? alpha_x : alpha_y;
  phi = fmodf(phi, 2 * pi);
  if (phi < 0) phi += 2 * pi;
)";
  if (Reduction(grid).turns())
    text += fmt::format(R"(  turn = phi - {};
  phi = {};
  beta = alpha;
  swapped = 0;
)",
                        number(grid.phi.first()), number(grid.phi.first()));
  else
    text += R"(  if (phi > pi) {
    phi = 2 * pi - phi;
    sign_y = -1;
  }
  if (phi > 0.5f * pi) {
    phi = pi - phi;
    sign_x = -1;
  }
  if (swapped) phi = 0.5f * pi - phi;
)";
  return text + "  lambda = alpha > 0 ? beta / alpha : 1;\n" +
         fmt::format(R"(  position[0] = ltc_position_alpha(alpha);
  position[1] = ltc_position_lambda(lambda);
  position[2] = ltc_position_theta(theta);
  position[3] = ltc_position_phi(phi);
  alpha = alpha > {0} ? alpha : {0};
  beta = beta > {0} ? beta : {0};
)",
                     least);
}

// s_y of field/field.h.
constexpr std::string_view width_of_folded = R"(  {
    const float least = 0.1f * alpha, l = beta / alpha;
    width = alpha * sqrtf(l * l + least * least * (1 - l * l));
  }
)";

constexpr std::string_view plain_rows =
    R"(  /* Back from the folded lobe, rows and columns alike: the determinant keeps its sign. */
  for (i = 0; i < 3; ++i)
    for (j = 0; j < 3; ++j) {
      const int r = swapped && i < 2 ? 1 - i : i, c = swapped && j < 2 ? 1 - j : j;
      const float sign = (i == 0 ? sign_x : i == 1 ? sign_y : 1) *
                         (j == 0 ? sign_x : j == 1 ? sign_y : 1);
      turned[3 * i + j] = sign * m[3 * r + c];
    }
)";
constexpr std::string_view folded_rows =
    R"(  /* Back from the reduced query, rows alone: the fold feels what its columns are turned by, but for
     their x's sign, which keeps the determinant positive. */
  for (i = 0; i < 3; ++i)
    for (j = 0; j < 3; ++j) {
      const float mirrored = sign_x * sign_y * (swapped ? -1.0f : 1.0f);
      turned[3 * i + j] = (i == 0 ? sign_x : i == 1 ? sign_y : 1) * (j == 0 ? mirrored : 1) *
                          m[3 * (swapped && i < 2 ? 1 - i : i) + j];
    }
)";

std::string fold_of_table(const Creases& creases) {
  return fmt::format(R"(  lobe.k = alpha * alpha * sum[11] / width;
  lobe.g = sum[12] < {0} ? sum[12] : {0};
  lobe.h = {1};
)",
                     number(std::min(most_fold(creases), 1e30)), number(creases.front()));
}

std::string table_look_up(const Table& table) {
  const Grid& grid = table.grid;
  std::string text = table_data(table);
  for (std::size_t i = 0; i < Grid::axis_count; ++i)
    text += axis_function(grid.axis_names()[i], grid.axis(i));
  const auto shape = grid.shape();
  text += "\n";
  text += look_up_comment;
  text += fmt::format(R"(  static const int shape[4] = {{{}, {}, {}, {}}};
  ltc_lobe lobe;
  float position[4], fraction[4], sum[{}] = {{0}}, m[9], turned[9], width;
  int node[4], i, j, corner;
)",
                      shape[0], shape[1], shape[2], shape[3], values_of_node(table));
  text += fold_code(grid);
  text += is_folded(table) ? width_of_folded : "  width = beta;\n";
  text += R"(  for (i = 0; i < 4; ++i) {
    node[i] = (int)position[i];
    if (node[i] > shape[i] - 2) node[i] = shape[i] > 1 ? shape[i] - 2 : 0;
    fraction[i] = shape[i] > 1 ? position[i] - (float)node[i] : 0;
  }
  for (corner = 0; corner < 16; ++corner) {
    float weight = 1;
    int flat = 0;
    for (i = 0; i < 4; ++i) {
      const int side = corner >> (3 - i) & 1;
      weight *= side ? fraction[i] : 1 - fraction[i];
      flat = flat * shape[i] + node[i] + (shape[i] > 1 ? side : 0);
    }
    if (weight != 0)
      for (i = 0; i < (int)(sizeof sum / sizeof *sum); ++i) sum[i] += weight * ltc_nodes[flat][i];
  }
  for (i = 0; i < 9; ++i) m[i] = sum[i];
)";
  text += storage_code(table.storage);
  text += is_folded(table) ? folded_rows : plain_rows;
  text += R"(  for (j = 0; j < 3; ++j) {
    const float a = turned[j], b = turned[3 + j];
    lobe.m[j] = cosf(turn) * a - sinf(turn) * b;
    lobe.m[3 + j] = sinf(turn) * a + cosf(turn) * b;
    lobe.m[6 + j] = turned[6 + j];
  }
  lobe.amplitude = sum[9];
  lobe.fresnel = sum[10];
)";
  if (is_folded(table))
    text += fold_of_table(table.creases);
  return text + "  (void)alpha, (void)beta, (void)width;\n  return lobe;\n}\n";
}
// What a file says cannot end a comment.
std::string in_comment(std::string text) {
  for (std::size_t at = 0; (at = text.find("*/", at)) != std::string::npos;)
    text.replace(at, 2, "* /");
  return on_one_line(text);
}

constexpr std::string_view folded_comment =
    ", and the\n"
    "   fold before it: the lobe is that of M (x, y + k u, z + g u), u = max(0, |x| - h z), (x, y, "
    "z) "
    "a\n   direction of the clamped cosine";

std::string header_of(const Table& table) {
  const std::size_t count = table.field ? table.field->terms.size() : table.grid.size();
  std::string text = fmt::format(
      fmt::runtime(c_header::head), fmt::arg("fold", is_folded(table) ? folded_comment : ""),
      fmt::arg("members", is_folded(table) ? "\n  float k, g, h;" : ""),
      fmt::arg("brdf", table.grid.model->name()),
      fmt::arg("generator", table.generator.empty() ? "ltcfit" : in_comment(table.generator)),
      fmt::arg("what", table.field ? fmt::format("A field of {} numbers: no table.", count)
                                   : fmt::format("A table of {} nodes, interpolated.", count)));
  text += table.field ? field_look_up(*table.field) : table_look_up(table);
  text += c_header::accessors;
  text += is_folded(table) ? c_header::folded_polygon : c_header::plain_polygon;
  text += c_header::tail;
  return text;
}

}  // namespace

Format header_format() {
  return {.name = "C header with look-up",
          .sets = {{".h"}},
          .asked = &OutputSettings::header,
          .contents = {.albedo = true, .loss = false},
          .of_materials = true,
          .of_folded = true,
          .of_one_pair = true,
          .ending_of_others = true,
          .limits = [](const Grid& grid, Storage, TextureLayout) -> std::string {
            return grid.size() > most_entries
                       ? fmt::format("has {} entries, more than the {} of a header", grid.size(),
                                     most_entries)
                       : "";
          },
          .add = [](platform::FileSet& set, const Table& table, const TableFiles& files,
                    const WriteOptions&) { add_file(set, files.front(), header_of(table)); }};
}

}  // namespace ltc
