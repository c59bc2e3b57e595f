// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "shaders/cases.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/random.h"
#include "export/entry_channels.h"
#include "export/field_code.h"
#include "export/table_code.h"
#include "export/texture_layout.h"
#include "field/synthetic_field.h"
#include "ltc/disk.h"
#include "ltc/horizon.h"
#include "ltc/ltsd.h"
#include "ltc/polygon.h"
#include "support/program.h"
#include "table/field_table.h"
#include "table/lookup.h"
#include "table/reduction.h"
#include "test_paths.h"

namespace ltc::test::shaders {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t picture_size = 64, picture_levels = 7;

Table without_field(const Field& field, const Grid& grid, Storage storage) {
  Table table = table_of_field(field, grid, storage);
  table.field.reset();
  return table;
}

// The axes that engines have.
Grid engines_grid() {
  Grid grid;
  grid.alpha = Axis::make(0, 1, 64, Warp::sqrt);
  grid.lambda = Axis::make(1, 1, 1, Warp::linear);
  grid.theta = Axis::make(0, pi / 2, 64, Warp::half_sine);
  grid.phi = Axis::make(0, 0, 1, Warp::linear);
  return grid;
}

Eigen::Vector3d rounded(const Eigen::Vector3d& v) {
  return v.cast<float>().cast<double>();
}

// ---- Sources ----

std::string text_of(const std::string& language, const std::string& name) {
  return read_file(LTCFIT_SOURCE_DIR "/shaders/" + language + "/ltc_" + name + "." + language);
}

// The files of shaders/ in the order of their needs, with what they need of table and field.
std::string library(const std::string& language, CodeLanguage code, const Tables& tables) {
  std::string text = text_of(language, "lobe") + text_of(language, "table") +
                     table_constant(tables.table.grid, tables.table.storage, code);
  std::string folded =
      table_constant(tables.folded.grid, tables.folded.storage, code, tables.folded.creases);
  folded.replace(folded.find("LTC_TABLE"), 9, "LTC_FOLDED_TABLE");
  text += folded;
  text += field_function(*tables.field.field, code);
  text += field_function(*tables.folded_field.field, code);
  for (const char* const name : {"field", "isotropic", "polygon", "disk", "line", "texture",
                                 "folded", "folded_lights", "folded_field", "folded_table"})
    text += text_of(language, name);
  return text;
}

std::string cases_in(const std::string& language) {
  const std::string file = LTCFIT_SOURCE_DIR "/tests/shaders/cases.glsl";
  if (language == "glsl")
    return read_file(file);
  const ProgramResult result = run_program(
      {"/usr/bin/python3", LTCFIT_SOURCE_DIR "/scripts/translate-shaders", file, "-l", language});
  if (result.exit_code != 0)
    throw std::runtime_error(result.err);
  return result.out;
}

// ---- Textures ----

Texture texture_of(const std::string& name, const Image& image, std::uint32_t depth) {
  return {.name = name,
          .width = static_cast<std::uint32_t>(image.width),
          .height = static_cast<std::uint32_t>(image.height),
          .depth = depth,
          .values = image.values};
}

// As docs/files.md has the three volumes, or four: slices of lambda + N_lambda alpha, of phi along
// theta.
std::vector<Texture> volumes(const Table& table, const std::string& name) {
  const Grid& grid = table.grid;
  std::vector<Texture> result;
  for (std::size_t k = 0; k < texels_of(table); ++k) {
    result.push_back({.name = name + std::to_string(k),
                      .width = static_cast<std::uint32_t>(grid.phi.size()),
                      .height = static_cast<std::uint32_t>(grid.theta.size()),
                      .depth = static_cast<std::uint32_t>(grid.alpha.size() * grid.lambda.size())});
    for (std::size_t flat = 0; flat < grid.size(); ++flat)
      for (std::size_t c = 0; c < channels_per_texel; ++c)
        result[k].values.push_back(channel_value(table, flat, channels_per_texel * k + c));
  }
  return result;
}

// A texel holds where it is, and its level: what is fetched tells place and level. Both are linear
// in between, so that a trilinear filter adds nothing.
Texture picture() {
  Texture texture{
      .name = "picture", .width = picture_size, .height = picture_size, .levels = picture_levels};
  for (std::uint32_t level = 0; level < picture_levels; ++level) {
    const std::uint32_t size = picture_size >> level;
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t x = 0; x < size; ++x)
        for (const double value :
             {(x + 0.5) / size, (y + 0.5) / size, static_cast<double>(level), 1.0})
          texture.values.push_back(static_cast<float>(value));
  }
  return texture;
}

// ---- What the library has ----

Lobe lobe_of(const Case& asked) {
  return {asked.alpha_x, asked.alpha_y, std::atan2(asked.view.head<2>().norm(), asked.view.z()),
          std::atan2(asked.view.y(), asked.view.x())};
}

// A look-up with a positive determinant. Of a reduced query alone where lobes are plain: at phi =
// 90 degrees the library mirrors x, which shaders do not.
LookUp of_folded(const Table& table, const Case& folded) {
  LookUp found = look_up(table, lobe_of(folded));
  if (found.matrix.determinant() < 0)
    found.matrix.col(0) *= -1;
  return found;
}

// Rows and columns alike: look_up itself leaves the columns.
Eigen::Matrix3d conjugated(const Table& table, const Case& asked, LookUp& found) {
  if (is_isotropic(table.grid)) {
    const double away = asked.view.head<2>().norm();
    Case straight = asked;
    straight.view = {away, 0, asked.view.z()};
    straight.alpha_y = straight.alpha_x;
    found = look_up(table, lobe_of(straight));
    const double c = away > 0 ? asked.view.x() / away : 1, s = away > 0 ? asked.view.y() / away : 0;
    Eigen::Matrix3d turn;
    turn << c, -s, 0, s, c, 0, 0, 0, 1;
    return turn * found.matrix;
  }
  const bool swapped = asked.alpha_y > asked.alpha_x;
  Case folded = asked;
  folded.view = asked.view.cwiseAbs();
  if (swapped) {
    std::swap(folded.view.x(), folded.view.y());
    std::swap(folded.alpha_x, folded.alpha_y);
  }
  found = of_folded(table, folded);
  Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
  if (swapped)
    back.col(0).swap(back.col(1));
  back.row(0) *= asked.view.x() < 0 ? -1 : 1;
  back.row(1) *= asked.view.y() < 0 ? -1 : 1;
  return back * found.matrix * back.transpose();
}

double share_of(const Eigen::Matrix3d& matrix, const std::vector<Eigen::Vector3d>& vertices) {
  return std::abs(
      LinearlyTransformed(matrix).integrate_polygon(clip_to_upper_hemisphere(vertices)));
}

std::vector<Eigen::Vector3d> quad(const Case& asked) {
  return {asked.p, asked.p + asked.a, asked.p + asked.a + asked.b, asked.p + asked.b};
}

std::vector<Eigen::Vector3d> star(const Case& asked) {
  std::vector<Eigen::Vector3d> vertices;
  for (int i = 0; i < 10; ++i) {
    const double turn = 0.2 * pi * i, radius = i % 2 == 1 ? 0.4 : 1;
    vertices.push_back(asked.p + radius * (std::cos(turn) * asked.a + std::sin(turn) * asked.b));
  }
  return vertices;
}

// A strip upright on the plane of line and origin, so thin that its share is as its width.
struct Strip {
  std::vector<Eigen::Vector3d> vertices;
  double half;
};
Strip strip_of(const Eigen::Matrix3d& matrix, const Case& asked) {
  const Eigen::Vector3d q = asked.p + asked.a, normal = asked.p.cross(q).normalized();
  // A millionth of the lobe's own width.
  const double half = 1e-6 * (matrix.transpose() * normal).norm() * asked.p.norm();
  return {{asked.p - half * normal, q - half * normal, q + half * normal, asked.p + half * normal},
          half};
}
double line(const Eigen::Matrix3d& matrix, const Case& asked, double radius) {
  const Strip strip = strip_of(matrix, asked);
  return share_of(matrix, strip.vertices) * radius / strip.half;
}

// As docs/shading.md has the approximation by a sphere of the same form factor.
double as_sphere(const Eigen::Matrix3d& matrix, const Case& asked) {
  const Eigen::Matrix3d inverse = matrix.inverse();
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Vector3d form = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : quad(asked))
    vertices.push_back((inverse * vertex).normalized());
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d normal = vertices[i].cross(vertices[(i + 1) % 4]);
    if (normal.norm() > 0)
      form += std::atan2(normal.norm(), vertices[i].dot(vertices[(i + 1) % 4])) / (2 * pi) *
              normal.normalized();
    sum += vertices[i];
  }
  if (form.dot(sum) < 0)
    form = -form;
  // The sphere of that squared sine.
  const double length = form.norm();
  if (length == 0)
    return 0;
  const Eigen::Vector3d axis = form / length;
  const double sine = std::sqrt(std::min(length, 1.0)),
               cosine = std::sqrt(std::max(1 - length, 0.0));
  const Eigen::Vector3d a = axis.unitOrthogonal(), b = axis.cross(a);
  return clamped_cosine_share({cosine * axis, sine * a, sine * b});
}

constexpr double light_radius = 0.2f;

double uniform(double x) {
  return std::abs(x) - std::floor(std::abs(x));
}

double light_of(const Eigen::Matrix3d& matrix, const Case& asked) {
  switch (asked.light) {
    case LightKind::quad:
      return share_of(matrix, quad(asked));
    case LightKind::star:
      return share_of(matrix, star(asked));
    case LightKind::ellipse:
      return ltc_share(matrix, Ellipse{asked.p, asked.a, asked.b});
    case LightKind::sphere:
      return ltc_share(matrix, disk_of_sphere(asked.p, light_radius));
    case LightKind::line:
      return std::min(line(matrix, asked, light_radius), 1.0);
    case LightKind::quad_as_sphere:
      return as_sphere(matrix, asked);
    case LightKind::density:
      return LinearlyTransformed(matrix).density(asked.p.normalized());
    case LightKind::direction:
      return LinearlyTransformed(matrix)
          .sample(uniform(asked.b.x()), uniform(asked.b.y()))
          .dot(asked.a.normalized());
    case LightKind::below_horizon:
      return share_below_horizon(matrix);
    default:
      return horizon_factor(matrix, HorizonMode::scaled);
  }
}

// The polygon of ltc_ellipse_folded; and of ltc_sphere_folded, whose disk it turns as Duff et al.
// do.
std::vector<Eigen::Vector3d> corners_of(const Eigen::Vector3d& center, const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b) {
  const double turn = pi / 12, scale = std::sqrt(turn / std::sin(turn));
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 24; ++i)
    corners.push_back(center + scale * (std::cos(turn * i) * a + std::sin(turn * i) * b));
  return corners;
}
std::vector<Eigen::Vector3d> corners_of_sphere(const Eigen::Vector3d& center, double radius) {
  const Ellipse disk = disk_of_sphere(center, radius);
  const Eigen::Vector3d n = center.normalized();
  const double side = n.z() < 0 ? -1 : 1, p = -1 / (side + n.z()), q = n.x() * n.y() * p;
  return corners_of(
      disk.center,
      disk.half_u.norm() * Eigen::Vector3d(1 + side * n.x() * n.x() * p, side * q, -side * n.x()),
      disk.half_u.norm() * Eigen::Vector3d(q, side + n.y() * n.y() * p, -n.y()));
}

double folded_light_of(const Eigen::Matrix3d& matrix, const Fold& fold, const Creases& creases,
                       const Case& asked) {
  const FoldedCosine lobe(matrix, fold, creases);
  const auto share = [&](const std::vector<Eigen::Vector3d>& vertices) {
    return std::abs(lobe.integrate_polygon(clip_to_upper_hemisphere(vertices)));
  };
  switch (asked.light) {
    case LightKind::star:
      return share(star(asked));
    case LightKind::ellipse:
      return share(corners_of(asked.p, asked.a, asked.b));
    case LightKind::sphere:
      return share(corners_of_sphere(asked.p, light_radius));
    case LightKind::line: {
      const Strip strip = strip_of(matrix, asked);
      return std::min(share(strip.vertices) * light_radius / strip.half, 1.0);
    }
    case LightKind::density:
      return lobe.density(asked.p.normalized());
    case LightKind::direction:
      return lobe.sample(uniform(asked.b.x()), uniform(asked.b.y())).dot(asked.a.normalized());
    case LightKind::below_horizon:
      return share_below_horizon(LtcLobe(matrix, fold, creases));
    case LightKind::horizon_factor:
      return horizon_factor({matrix, fold, creases}, HorizonMode::scaled);
    default:
      return share(quad(asked));
  }
}

// Of a table rows alone are unfolded; a field's function goes on into the other quadrants, where
// columns are mirrored too and k is of the other sign where y is. The first column has the sign of
// a positive determinant.
Expected expected_folded(const Table& table, const Case& asked) {
  const bool swapped = asked.alpha_y > asked.alpha_x;
  Case reduced = asked;
  if (swapped) {
    std::swap(reduced.view.x(), reduced.view.y());
    std::swap(reduced.alpha_x, reduced.alpha_y);
  }
  const Eigen::Vector3d signs(reduced.view.x() < 0 ? -1 : 1, reduced.view.y() < 0 ? -1 : 1, 1);
  reduced.view = reduced.view.cwiseAbs();
  const LookUp found = of_folded(table, reduced);
  Eigen::Matrix3d matrix = signs.asDiagonal() * found.matrix;
  Fold fold = found.fold;
  if (table.field) {
    matrix = (matrix * signs.asDiagonal()).eval();
    fold.k *= signs.y();
  }
  if (swapped)
    matrix.row(0).swap(matrix.row(1));
  if (matrix.determinant() < 0)
    matrix.col(0) *= -1;
  return {matrix,
          found.amplitude,
          found.fresnel,
          folded_light_of(matrix, fold, found.creases, asked),
          {fold.k, fold.g, found.creases.front()}};
}

Eigen::Vector3d picture_of(const Eigen::Matrix3d& matrix, const Case& asked) {
  const Eigen::Matrix3d inverse = matrix.inverse();
  const Eigen::Vector3d p = inverse * asked.p, u = inverse * asked.a, v = inverse * asked.b;
  Eigen::Matrix3d sides;
  sides << u, v, u.cross(v);
  // The origin as p + place_u u + place_v v + height normal.
  const Eigen::Vector3d place = sides.fullPivLu().solve(-p);
  const double area = u.cross(v).norm(), distance = std::abs(place.z()) * area;
  const double sigma = std::sqrt(distance * distance / (2 * area));
  const double level =
      std::clamp(std::log2(std::max(picture_size * sigma, 1.0)), 0.0, picture_levels - 1.0);
  const auto held = [](double x, double at) {
    // The last texels' centres, between two levels.
    const auto side = [&](double k) {
      const double edge = 0.5 / (picture_size / std::exp2(k));
      return std::clamp(x, edge, 1 - edge);
    };
    const double lower = std::floor(at);
    return side(lower) + (at - lower) * (side(lower + 1) - side(lower));
  };
  return {held(0.125 + 0.75 * place.x(), level), held(0.125 + 0.75 * place.y(), level), level};
}

}  // namespace

Tables make_tables(const Grid& grid, Storage storage, const Creases& creases) {
  const auto of_field = [](const Field& field) {
    return table_of_field(field, Grid::paper(2), Storage::matrix);
  };
  const Field plain = ltc::testing::synthetic_field(),
              folded = ltc::testing::synthetic_folded_field(creases);
  return {without_field(plain, grid, storage),
          without_field(plain, engines_grid(), Storage::inverse), of_field(plain), of_field(folded),
          // Of an axis of one node nothing is folded.
          without_field(folded, is_isotropic(grid) ? Grid::paper(3) : grid, Storage::folded)};
}

std::vector<Case> make_cases(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const auto number = [&](double least, double most) {
    return static_cast<double>(static_cast<float>(least + (most - least) * random.uniform()));
  };
  // Now and then one of the domain's ends.
  const auto one_of = [&](std::initializer_list<double> ends, double least, double most) {
    const auto i =
        static_cast<std::size_t>(random.uniform() * 4 * static_cast<double>(ends.size()));
    return i < ends.size() ? static_cast<double>(static_cast<float>(ends.begin()[i]))
                           : number(least, most);
  };
  std::vector<Case> cases;
  for (std::size_t i = 0; i < count; ++i) {
    Case one;
    const auto roughness = [&] {
      const double root = one_of({0, 0.01, 0.03, 1}, 0.1, 1);
      return static_cast<double>(static_cast<float>(root * root));
    };
    one.alpha_x = roughness();
    one.alpha_y = random.uniform() < 0.2 ? one.alpha_x : roughness();
    const double theta = one_of({0, 1e-3, 1.2, 1.55, 1.5706}, 0, 1.55);
    const double phi = one_of({0, pi / 2, pi, 4.71238898, 1e-4}, 0, 2 * pi);
    one.view = rounded(
        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    one.look_up = static_cast<LookUpKind>(i % look_up_kinds);
    one.light = static_cast<LightKind>(i / look_up_kinds % light_kinds);
    if (one.look_up == LookUpKind::isotropic)
      one.alpha_y = one.alpha_x;
    // About the mirror's direction, as far as lobes reach, and of any size.
    const double size = std::exp(number(-2.5, 0.7));
    const auto any = [&] { return Eigen::Vector3d(number(-1, 1), number(-1, 1), number(-1, 1)); };
    const Eigen::Vector3d mirror(-one.view.x(), -one.view.y(), one.view.z());
    const double reach = std::max(one.alpha_x, one.alpha_y) + size;
    one.p = rounded(2 * (mirror + reach * any()));
    while (one.p.norm() < 0.5)
      one.p = rounded(2 * (mirror + reach * any()));
    const Eigen::Vector3d side = any(), other = any();
    one.a = rounded(size * side);
    // Of an ellipse in whatever place, these are its half axes.
    one.b = rounded(size * (other - other.dot(side) / side.squaredNorm() * side));
    cases.push_back(one);
  }
  return cases;
}

Job make_job(const Tables& tables, const std::vector<Case>& cases) {
  Job job;
  job.glsl = library("glsl", CodeLanguage::glsl, tables) + cases_in("glsl");
  job.hlsl = library("hlsl", CodeLanguage::hlsl, tables) + cases_in("hlsl");
  job.wgsl = library("wgsl", CodeLanguage::wgsl, tables) + cases_in("wgsl");
  for (const Case& one : cases) {
    const auto add = [&](const Eigen::Vector3d& v, double w) {
      for (const double value : {v.x(), v.y(), v.z(), w})
        job.input.push_back(static_cast<float>(value));
    };
    add(one.view, one.alpha_x);
    add(one.p, one.alpha_y);
    add(one.a, static_cast<double>(one.look_up));
    add(one.b, static_cast<double>(one.light));
  }
  job.textures = volumes(tables.table, "values_");
  Texture stacked = job.textures.front();
  stacked.name = "stacked";
  stacked.depth *= 3;
  for (std::size_t k = 1; k < 3; ++k)
    stacked.values.insert(stacked.values.end(), job.textures[k].values.begin(),
                          job.textures[k].values.end());
  const std::vector<Image> images = images_of(tables.isotropic, TextureLayout::ltc);
  for (const Texture& texture : {stacked, texture_of("inverses", images[0], 0),
                                 texture_of("terms", images[1], 0), picture()})
    job.textures.push_back(texture);
  for (const Texture& texture : volumes(tables.folded, "folded_"))
    job.textures.push_back(texture);
  return job;
}

Expected expected(const Tables& tables, const Case& asked) {
  if (asked.look_up == LookUpKind::folded_field)
    return expected_folded(tables.folded_field, asked);
  if (is_folded(asked.look_up))
    return expected_folded(tables.folded, asked);
  const Table& table = asked.look_up == LookUpKind::isotropic ? tables.isotropic
                       : asked.look_up == LookUpKind::field   ? tables.field
                                                              : tables.table;
  LookUp found;
  Expected result;
  result.matrix = conjugated(table, asked, found);
  result.amplitude = found.amplitude;
  result.fresnel = found.fresnel;
  result.share = light_of(result.matrix, asked);
  result.seen = picture_of(result.matrix, asked);
  return result;
}

}  // namespace ltc::test::shaders
