// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Look-ups in C, JavaScript and GLSL as compilers and interpreters have them, against the library.
#include "export/field_code.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/random.h"
#include "export/files.h"
#include "export/format.h"
#include "field/synthetic_field.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "support/temporary_directory.h"
#include "table/field_table.h"
#include "table/lookup.h"

namespace ltc {
namespace {

using test::TemporaryDirectory;
using testing::synthetic_field;

constexpr const char* print_look_ups = R"(
#include <stdio.h>
#include "ltc.h"
int main(void) {
  float a, b, theta, phi;
  while (scanf("%f %f %f %f", &a, &b, &theta, &phi) == 4) {
    const float quad[4][3] = {{-1.0f, -0.5f, 0.6f}, {1.0f, -0.8f, 0.4f}, {0.9f, 1.0f, -0.2f},
                              {-0.7f, 0.8f, 0.5f}};
    const ltc_lobe lobe = ltc_look_up(a, b, theta, phi);
    const float up[3] = {0.6f, 0.0f, 0.8f};
    float m[9], omega[3], share = ltc_polygon(&lobe, quad, 4);
    int i;
    ltc_matrix(&lobe, m);
    ltc_sample(&lobe, 0.3f, 0.6f, omega);
    for (i = 0; i < 9; ++i) printf("%.9g ", (double)m[i]);
    printf("%.9g %.9g %.9g ", (double)ltc_amplitude(&lobe), (double)ltc_fresnel(&lobe),
           (double)share);
    for (i = 0; i < 3; ++i) printf("%.9g ", (double)omega[i]);
    printf("%.9g\n", (double)ltc_density(&lobe, up));
  }
  return 0;
}
)";

const std::vector<Eigen::Vector3d> quad = {
    {-1.0, -0.5, 0.6}, {1.0, -0.8, 0.4}, {0.9, 1.0, -0.2}, {-0.7, 0.8, 0.5}};

// In all quadrants and both orders, exact in single precision.
std::vector<Lobe> lobes() {
  Random random(3);
  const auto number = [&](double least, double most) {
    return static_cast<double>(static_cast<float>(least + (most - least) * random.uniform()));
  };
  std::vector<Lobe> result = {{0.5f, 0.5f, 0, 0}, {1, 1e-4f, 1.5f, 0.25f}, {0.01f, 1, 1.25f, 4}};
  for (int i = 0; i < 300; ++i)
    result.push_back({number(0.01, 1), number(0.01, 1), number(0, 1.55), number(-3, 7)});
  return result;
}

std::string lines_of(const std::vector<Lobe>& lobes) {
  std::string text;
  for (const Lobe& lobe : lobes)
    text += fmt::format("{} {} {} {}\n", lobe.alpha_x, lobe.alpha_y, lobe.theta_radians,
                        lobe.phi_radians);
  return text;
}

std::vector<std::vector<double>> numbers_in(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (double value; cells >> value;)
      rows.back().push_back(value);
  }
  return rows;
}

Eigen::Matrix3d matrix_of(const std::vector<double>& row) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i)
    matrix(i / 3, i % 3) = row[static_cast<std::size_t>(i)];
  return matrix;
}

// The same lobe: the third columns, and M M^T, which is as much as a lobe knows of M.
double difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const double scale = a.col(2).norm() / b.col(2).norm();
  const Eigen::Matrix3d c = scale * b;
  return std::max((a.col(2) - c.col(2)).norm(),
                  (a * a.transpose() - c * c.transpose()).cwiseAbs().maxCoeff()) /
         a.squaredNorm();
}

double share_of_quad(const Eigen::Matrix3d& matrix) {
  return std::abs(LinearlyTransformed(matrix).integrate_polygon(clip_to_upper_hemisphere(quad)));
}

// What the table's header prints of lobes(), compiled as C99; as C++ it compiles too.
std::vector<std::vector<double>> rows_of_header(const Table& table) {
  const TemporaryDirectory folder;
  const Format* header = set_to_write(folder / "ltc.h", true).format;
  platform::FileSet set;
  header->add(set, table, {folder / "ltc.h"}, {});
  set.commit();
  folder.write("print.c", print_look_ups);
  folder.write("lobes", lines_of(lobes()));
  const std::string in_folder = "cd " + folder.path().string() + " && ";
  const testing::Finished c_plus_plus =
      testing::run(in_folder + "c++ -x c++ -Wall -Wextra -pedantic -Werror -fsyntax-only print.c");
  EXPECT_EQ(c_plus_plus.exit_code, 0) << c_plus_plus.output;
  const testing::Finished printed = testing::run(
      in_folder +
      "cc -std=c99 -Wall -Wextra -pedantic -Werror print.c -o print -lm && ./print < lobes");
  EXPECT_EQ(printed.exit_code, 0) << printed.output;
  const auto rows = numbers_in(printed.output);
  for (const std::vector<double>& row : rows)
    EXPECT_EQ(row.size(), 16u);
  return rows;
}

// A density is as large as its lobe is small.
void expect_density(double found, double expected) {
  EXPECT_NEAR(found, expected, 2e-5 * std::max(1.0, expected));
}

const Eigen::Vector3d up(0.6, 0, 0.8);

Eigen::Vector3d cosine_sample() {
  const double angle = 2 * std::numbers::pi * 0.6;
  return {std::sqrt(0.3) * std::cos(angle), std::sqrt(0.3) * std::sin(angle), std::sqrt(0.7)};
}

void expect_header_agrees(const Table& table) {
  const auto rows = rows_of_header(table);
  ASSERT_EQ(rows.size(), lobes().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(lines_of({lobes()[i]}));
    const LookUp expected = look_up(table, lobes()[i]);
    const Eigen::Matrix3d found = matrix_of(rows[i]);
    EXPECT_GT(found.determinant(), 0);
    // Some hundred roundings of single precision.
    EXPECT_LT(difference(expected.matrix, found), 1e-5);
    EXPECT_NEAR(rows[i][9], expected.amplitude, 1e-5);
    EXPECT_NEAR(rows[i][10], expected.fresnel, 1e-5);
    // By the header's own matrix: the polygon's part alone; by the library's: the whole look-up.
    EXPECT_NEAR(rows[i][11], share_of_quad(found), 1e-6);
    EXPECT_NEAR(rows[i][11], share_of_quad(expected.matrix), 1e-5);
    const Eigen::Vector3d sample = (found * cosine_sample()).normalized();
    EXPECT_LT((sample - Eigen::Vector3d(rows[i][12], rows[i][13], rows[i][14])).norm(), 1e-5);
    expect_density(rows[i][15], LinearlyTransformed(expected.matrix).density(up));
  }
}

// The signs of columns that `found` has others of than a matrix: x's is not felt by a fold, and y's
// if k has the other sign too. Anything else fails.
Eigen::Vector3d column_signs(const Eigen::Matrix3d& matrix, const Eigen::Matrix3d& found,
                             double tolerance) {
  Eigen::Vector3d signs;
  for (int column = 0; column < 3; ++column) {
    signs(column) = matrix.col(column).dot(found.col(column)) < 0 ? -1 : 1;
    EXPECT_LT((matrix.col(column) - signs(column) * found.col(column)).norm(),
              tolerance * matrix.col(column).norm());
  }
  EXPECT_EQ(signs.z(), 1);
  EXPECT_GT(found.determinant(), 0);
  return signs;
}

Table folded_table(const Creases& creases = usual_creases) {
  return table_of_field(testing::synthetic_folded_field(creases), Grid::paper(2), Storage::matrix);
}

void expect_folded_header_agrees(const Table& table) {
  const auto rows = rows_of_header(table);
  ASSERT_EQ(rows.size(), lobes().size());
  double most_k = 0, most_g = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(lines_of({lobes()[i]}));
    const LookUp expected = look_up(table, lobes()[i]);
    const FoldedCosine lobe(expected.matrix, expected.fold, expected.creases);
    const Eigen::Vector3d signs = column_signs(expected.matrix, matrix_of(rows[i]), 1e-5);
    EXPECT_NEAR(rows[i][9], expected.amplitude, 1e-5);
    EXPECT_NEAR(rows[i][10], expected.fresnel, 1e-5);
    EXPECT_NEAR(rows[i][11], std::abs(lobe.integrate_polygon(clip_to_upper_hemisphere(quad))),
                1e-5);
    const Eigen::Vector3d sample = (expected.matrix * folded(signs.asDiagonal() * cosine_sample(),
                                                             expected.fold, expected.creases))
                                       .normalized();
    EXPECT_LT((sample - Eigen::Vector3d(rows[i][12], rows[i][13], rows[i][14])).norm(), 1e-5);
    expect_density(rows[i][15], lobe.density(up));
    most_k = std::max(most_k, std::abs(expected.fold.k));
    most_g = std::max(most_g, expected.fold.g);
  }
  // They bend.
  EXPECT_GT(most_k, 1);
  EXPECT_GT(most_g, 0.5);
}

TEST(CHeader, OfAFoldedFieldAgreesWithTheLibrary) {
  for (const double crease : {0.4, 0.0, 1.5}) {
    SCOPED_TRACE(crease);
    expect_folded_header_agrees(folded_table({crease}));
  }
}

TEST(CHeader, OfAFoldedTableAgreesWithTheLibrary) {
  Table table =
      table_of_field(testing::synthetic_folded_field(), Grid::paper({4, 3, 5, 3}), Storage::folded);
  table.field.reset();
  expect_folded_header_agrees(table);
}

Table node_table(Storage storage, const Grid& grid) {
  Table table = table_of_field(synthetic_field(), grid, storage);
  table.field.reset();
  return table;
}

TEST(CHeader, OfAFieldAgreesWithTheLibrary) {
  expect_header_agrees(table_of_field(synthetic_field(), Grid::paper(2), Storage::matrix));
}

TEST(CHeader, OfTablesAgreesWithTheLibraryWhateverTheyStore) {
  Grid grid = Grid::paper({4, 3, 5, 3});
  grid.alpha = Axis::make(0, 1, 4, Warp::sqrt);
  grid.theta = Axis::make(0, steepest_theta, 5, Warp::complement_sqrt);
  for (const Storage storage :
       {Storage::matrix, Storage::roughness_scaled, Storage::mirror_frame}) {
    SCOPED_TRACE(name_of(storage));
    expect_header_agrees(node_table(storage, grid));
  }
}

TEST(CHeader, OfIsotropicTablesAgreesWithTheLibrary) {
  Grid grid;
  grid.alpha = Axis::make(0, 1, 6, Warp::sqrt);
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  grid.theta = Axis::make(0, std::numbers::pi / 2, 6, Warp::half_sine);
  grid.phi = Axis::make(0, 0, 1, Warp::linear);
  for (const Storage storage : {Storage::inverse, Storage::mirror_frame}) {
    SCOPED_TRACE(name_of(storage));
    expect_header_agrees(node_table(storage, grid));
  }
}

// What the module's function prints of lobes(): M, amplitude, Fresnel term and `more`.
std::vector<std::vector<double>> rows_of_javascript(const Field& field, const std::string& function,
                                                    const std::string& more) {
  const TemporaryDirectory folder;
  folder.write("ltc.mjs", field_function(field, CodeLanguage::javascript));
  std::string program = fmt::format("import {{ {} as look }} from './ltc.mjs';\n", function);
  for (const Lobe& lobe : lobes()) {
    const Eigen::Vector3d v = lobe.omega_v();
    program += fmt::format(
        "{{ const l = look({}, {}, [{}, {}, {}]); console.log(...l.matrix, l.amplitude, "
        "l.fresnel{}); }}\n",
        lobe.alpha_x, lobe.alpha_y, v.x(), v.y(), v.z(), more);
  }
  folder.write("run.mjs", program);
  const testing::Finished printed =
      testing::run("cd " + folder.path().string() + " && NO_COLOR=1 node run.mjs");
  EXPECT_EQ(printed.exit_code, 0) << printed.output;
  return numbers_in(printed.output);
}

TEST(FieldCode, JavaScriptAgreesWithTheLibrary) {
  const std::vector<Lobe> asked = lobes();
  const auto rows = rows_of_javascript(synthetic_field(), "ltcLookUp", "");
  ASSERT_EQ(rows.size(), asked.size());
  const Table table = table_of_field(synthetic_field(), Grid::paper(2), Storage::matrix);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const LookUp expected = look_up(table, asked[i]);
    // Constants such as 0.1 have single precision.
    EXPECT_LT(difference(expected.matrix, matrix_of(rows[i])), 1e-7) << lines_of({asked[i]});
    EXPECT_NEAR(rows[i][9], expected.amplitude, 1e-7);
    EXPECT_NEAR(rows[i][10], expected.fresnel, 1e-7);
  }
}

TEST(FieldCode, JavaScriptOfAFoldedFieldAgreesWithTheLibrary) {
  const Table table = folded_table();
  const auto rows =
      rows_of_javascript(*table.field, "ltcLookUpFolded", ", l.fold.k, l.fold.g, l.fold.h");
  ASSERT_EQ(rows.size(), lobes().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(lines_of({lobes()[i]}));
    const LookUp expected = look_up(table, lobes()[i]);
    const Eigen::Vector3d signs = column_signs(expected.matrix, matrix_of(rows[i]), 1e-7);
    EXPECT_NEAR(rows[i][9], expected.amplitude, 1e-7);
    EXPECT_NEAR(rows[i][10], expected.fresnel, 1e-7);
    EXPECT_NEAR(rows[i][11], signs.y() * expected.fold.k, 1e-6);
    EXPECT_NEAR(rows[i][12], expected.fold.g, 1e-6);
    EXPECT_NEAR(rows[i][13], 0.4, 1e-7);
  }
}

TEST(FieldCode, GlslCompiles) {
  const TemporaryDirectory folder;
  const std::string text = field_function(synthetic_field(), CodeLanguage::glsl);
  for (const std::string version : {"300 es\nprecision highp float;", "450"}) {
    folder.write("field.frag", "#version " + version + "\n" + text +
                                   "layout(location = 0) out vec4 color;\nvoid main() { mat3 m; "
                                   "vec2 a; ltcLookUp(0.3, 0.1, vec3(0.6, 0.0, 0.8), m, a); color "
                                   "= vec4(m[0], a.x); }\n");
    const testing::Finished finished =
        testing::run("glslangValidator " + (folder / "field.frag").string());
    EXPECT_EQ(finished.exit_code, 0) << finished.output;
  }
}

TEST(FieldCode, HlslCompiles) {
  const TemporaryDirectory folder;
  folder.write("field.hlsl", field_function(synthetic_field(), CodeLanguage::hlsl) +
                                 "float4 main() : SV_Target { float3x3 m; float2 a; ltcLookUp(0.3, "
                                 "0.1, float3(0.6, 0, 0.8), m, a); return float4(m[0], a.x); }\n");
  const testing::Finished finished =
      testing::run("glslangValidator -D -V -S frag -e main -o " + (folder / "field.spv").string() +
                   " " + (folder / "field.hlsl").string());
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
}

TEST(FieldCode, CountsItsMultiplications) {
  Field one;
  one.terms = {{FieldPart::a, 0, 0, 0, 0, 0}};
  one.coefficients = {2};
  Field two = one;
  two.terms.push_back({FieldPart::a, 2, 0, 3, 0, 0});
  two.coefficients.push_back(1);
  // Two Chebyshev polynomials more of alpha (1 + 2), three of r (1 + 2 + 2), and a2 * r3 * 1.
  EXPECT_EQ(field_multiplications(two) - field_multiplications(one), 10u);
}

}  // namespace
}  // namespace ltc
