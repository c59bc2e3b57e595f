// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit render: spheres under a rectangular light, by sampled GGX and by a table.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "core/error.h"
#include "core/version.h"
#include "export/reader.h"
#include "render/image_exr.h"
#include "render/missing_albedo.h"
#include "render/sphere_images.h"
#include "render/sphere_picture.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string table, table_b;  // table_b empty: none
  std::optional<double> alpha_x, alpha_y;
  std::vector<std::string> materials;  // "alpha_x,alpha_y" each
  double f0 = 1;
  double light_size = 1;  // times that of figure 14
  SphereSettings settings;
  std::string output = "out";
  int threads = default_threads();
};

// The tables that are rendered with, and what the pictures call them.
struct Tables {
  std::vector<Table> tables;
  std::vector<std::string> paths, names;

  std::vector<const Table*> pointers() const {
    std::vector<const Table*> all;
    for (const Table& table : tables)
      all.push_back(&table);
    return all;
  }
};

// Every material's images, and how long each took.
struct Results {
  std::vector<SphereRow> rows;
  std::vector<double> seconds;
};

constexpr double least_alpha = 1e-4;

// "0.3,0.05"; throws InputError for anything else.
SphereMaterial material_of(const std::string& text, double f0) {
  double alpha_x = 0, alpha_y = 0;
  int length = 0;
  const int read = std::sscanf(text.c_str(), "%lf,%lf%n", &alpha_x, &alpha_y, &length);
  const auto allowed = [](double alpha) { return alpha >= least_alpha && alpha <= 1; };
  if (read != 2 || static_cast<std::size_t>(length) != text.size() || !allowed(alpha_x) ||
      !allowed(alpha_y))
    throw InputError(
        fmt::format("--material {}: expected two roughnesses in [{}, 1], for example 0.3,0.05",
                    text, least_alpha));
  return {alpha_x, alpha_y, f0};
}

// Those of figure 14 of Aakash et al. 2022, unless others are asked for.
std::vector<SphereMaterial> materials_of(const Arguments& arguments) {
  if (arguments.alpha_x.has_value() != arguments.alpha_y.has_value())
    throw InputError(fmt::format("--alpha-{} without --alpha-{}; expected both or neither",
                                 arguments.alpha_x ? "x" : "y", arguments.alpha_x ? "y" : "x"));
  const double f0 = arguments.f0;
  std::vector<SphereMaterial> materials;
  if (arguments.alpha_x)
    materials.push_back({*arguments.alpha_x, *arguments.alpha_y, f0});
  for (const std::string& text : arguments.materials)
    materials.push_back(material_of(text, f0));
  if (!materials.empty())
    return materials;
  return {{0.05, 0.25, f0}, {0.5, 0.02, f0}, {0.5, 0.25, f0}, {0.5, 1.0, f0}};
}

Tables load_tables(const Arguments& arguments) {
  Tables tables;
  tables.paths = {arguments.table};
  if (!arguments.table_b.empty())
    tables.paths.push_back(arguments.table_b);
  for (std::size_t i = 0; i < tables.paths.size(); ++i) {
    tables.tables.push_back(read_table(tables.paths[i]));
    fill_missing_albedo(tables.tables.back());
    tables.names.push_back(tables.paths.size() == 1 ? "LTC" : i == 0 ? "LTC, A" : "LTC, B");
  }
  return tables;
}

// Where the files go: DIR/spheres.png and beside it, or, for a name that ends with .png, that file
// and beside it.
struct Destination {
  fs::path folder;
  std::string stem;

  fs::path picture() const { return folder / (stem + ".png"); }
  fs::path images(const SphereMaterial& material) const {
    return folder / fmt::format("{}_{}_{}.exr", stem, material.alpha_x, material.alpha_y);
  }
};

Destination destination_of(const fs::path& output) {
  if (output.extension() != ".png")
    return {output, "spheres"};
  const fs::path folder = output.parent_path();
  return {folder.empty() ? fs::path(".") : folder, output.stem().string()};
}

// What is wrong with an output, if anything. A folder may have a dot in its name, but one that is
// called like another picture is a mistake.
std::string refusal_of_output(const std::string& text) {
  if (text.empty())
    return "is empty; expected a folder or a .png";
  const std::string ending = fs::path(text).extension().string();
  for (const char* other :
       {".bmp", ".exr", ".gif", ".jpeg", ".jpg", ".pdf", ".svg", ".tif", ".tiff"})
    if (ending == other && !fs::is_directory(text))
      return fmt::format("{} is neither a folder nor a .png", text);
  return {};
}

Results render_all(const Arguments& arguments, const std::vector<SphereMaterial>& materials,
                   const Tables& tables, Progress& progress) {
  SphereSettings settings = arguments.settings;
  settings.scene.light.half_u *= arguments.light_size;
  settings.scene.light.half_v *= arguments.light_size;
  Results results;
  for (const SphereMaterial& material : materials) {
    const Clock::time_point began = Clock::now();
    const std::string stage = fmt::format("render {}, {}", material.alpha_x, material.alpha_y);
    results.rows.push_back({material, render_sphere(tables.pointers(), material, settings, stage,
                                                    arguments.threads, &progress)});
    results.seconds.push_back(std::chrono::duration<double>(Clock::now() - began).count());
  }
  return results;
}

// A table made for a scene may lack entries; one that lacks all that are asked for is of no use.
void require_some_entries(const Results& results, const Tables& tables) {
  for (std::size_t table = 0; table < tables.paths.size(); ++table) {
    const auto any = [&](const SphereRow& row) {
      return sphere_error(row.images, table).pixels > 0;
    };
    if (std::none_of(results.rows.begin(), results.rows.end(), any))
      throw InputError(fmt::format(
          "{}: has none of the entries that these materials need; expected a table with entries "
          "at, for example, alpha_x {} and alpha_y {}",
          tables.paths[table], results.rows[0].material.alpha_x, results.rows[0].material.alpha_y));
  }
}

void write_images(const SphereRow& row, const Arguments& arguments, const fs::path& path) {
  const SphereImages& images = row.images;
  const SphereMaterial& material = row.material;
  std::vector<picture::Field> differences;
  for (std::size_t table = 0; table < images.ltc.size(); ++table)
    differences.push_back(difference(images, table));
  std::vector<ImageLayer> layers{{"ggx.Y", &images.reference},
                                 {"standard_error.Y", &images.standard_error},
                                 {"coverage.Y", &images.coverage},
                                 {"ltc.Y", &images.ltc[0]},
                                 {"difference.Y", &differences[0]}};
  std::vector<ImageAttribute> attributes{
      {"ltc:generator", generator()},
      {"ltc:material", fmt::format("alpha_x {}, alpha_y {}, F0 {}", material.alpha_x,
                                   material.alpha_y, material.f0)},
      {"ltc:light_size", fmt::format("{}", arguments.light_size)},
      {"ltc:samples", fmt::format("{}", arguments.settings.samples)},
      {"ltc:table", arguments.table}};
  if (images.ltc.size() > 1) {
    layers.push_back({"ltc_b.Y", &images.ltc[1]});
    layers.push_back({"difference_b.Y", &differences[1]});
    attributes.push_back({"ltc:table_b", arguments.table_b});
  }
  write_image_exr(layers, attributes, path);
}

std::string row_text(const SphereRow& row, std::size_t table, const std::string& name,
                     double seconds) {
  const SphereError error = sphere_error(row.images, table);
  std::string text =
      fmt::format("{:>8} {:>8}  {:<7} ", row.material.alpha_x, row.material.alpha_y, name);
  if (error.pixels == 0)
    return text + "no entries for this material\n";
  text += fmt::format("{:>12.5f} {:>12.2f} % {:>12.5f} {:>8.2f}\n", error.mean_absolute,
                      100 * error.relative_rmse, error.standard_error, seconds);
  if (error.without > 0)
    text += fmt::format("{:19}{} of {} pixels without an entry\n", "", error.without,
                        error.without + error.pixels);
  return text;
}

// "Table: out/ltc.h5", or "A: out/ltc.h5, B: other.npy".
std::string tables_text(const Tables& tables) {
  if (tables.paths.size() == 1)
    return "Table: " + tables.paths[0];
  return fmt::format("A: {}, B: {}", tables.paths[0], tables.paths[1]);
}

std::string report_text(const Results& results, const Tables& tables) {
  std::string text = fmt::format(
      "{}\nmean |error| and noise (standard error of a pixel) in units of the light's radiance\n\n",
      tables_text(tables));
  text += fmt::format("{:>8} {:>8}  {:<7} {:>12} {:>14} {:>12} {:>8}\n", "alpha_x", "alpha_y",
                      "table", "mean |error|", "RMSE/mean GGX", "noise of GGX", "seconds");
  for (std::size_t row = 0; row < results.rows.size(); ++row)
    for (std::size_t table = 0; table < tables.names.size(); ++table)
      text += row_text(results.rows[row], table, tables.names[table], results.seconds[row]);
  return text;
}

SpherePicture picture_of(const Arguments& arguments, const Tables& tables, Results results) {
  SpherePicture content;
  content.title = "Spheres under a rectangular light";
  content.caption = {
      fmt::format(
          "x along the parallels about the upright axis, y along the meridians. GGX: multiple "
          "importance sampling, {} samples a pixel.",
          arguments.settings.samples),
      "Differences and errors are in units of the light's radiance. " + tables_text(tables)};
  content.tables = tables.names;
  content.rows = std::move(results.rows);
  return content;
}

void render(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const std::vector<SphereMaterial> materials = materials_of(arguments);
  const Tables tables = load_tables(arguments);
  const Destination destination = destination_of(arguments.output);
  const OutputFolder folder(destination.folder);

  Results results = render_all(arguments, materials, tables, progress);
  require_some_entries(results, tables);
  std::string text = report_text(results, tables) + "\nwrote ";
  const SpherePicture content = picture_of(arguments, tables, std::move(results));
  const picture::Canvas picture = draw(content);
  // The last chance to stop.
  progress.throw_if_stopped();
  for (const SphereRow& row : content.rows) {
    const fs::path path = destination.images(row.material);
    write_images(row, arguments, path);
    text += path.string() + "\n      ";
  }
  picture.write_png(destination.picture());
  print(text + destination.picture().string() + "\n");
}

void add_number_option(CLI::App& app, const char* name, std::optional<double>& value,
                       const char* what) {
  app.add_option(name, value, what)
      ->check(CLI::Range(least_alpha, 1.0))
      ->option_text("X")
      ->group("What to render");
}

}  // namespace

Action declare_render(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("TABLE", arguments->table, "table to render with, .h5, .npy or .0.exr")
      ->required()
      ->option_text(" ");
  add_number_option(app, "--alpha-x", arguments->alpha_x,
                    "roughness along the parallels [the four materials of figure 14]");
  add_number_option(app, "--alpha-y", arguments->alpha_y,
                    "roughness along the meridians, together with --alpha-x");
  app.add_option("--material", arguments->materials,
                 "roughness along the parallels and along the meridians; can be repeated")
      ->allow_extra_args(false)
      ->option_text("X,Y")
      ->group("What to render");
  app.add_option("--light-size", arguments->light_size,
                 "width and height of the light over those of figure 14 [1]")
      ->check([](const std::string& text) {
        const double size = std::strtod(text.c_str(), nullptr);  // Range lets NaN pass
        return std::string(size >= 0.001 && size <= 2 ? "" : text + " is not in [0.001, 2]");
      })
      ->option_text("S")
      ->group("What to render");
  app.add_option("--f0", arguments->f0, "reflectance at normal incidence, of Schlick's term [1]")
      ->check(CLI::Range(0.0, 1.0))
      ->option_text("X")
      ->group("What to render");
  app.add_option("--table-b", arguments->table_b, "another table to compare with [none]")
      ->option_text("FILE")
      ->group("What to render");
  app.add_option("--size", arguments->settings.size, "width and height of a sphere, pixels [320]")
      ->check(CLI::Range(8, 2048))
      ->option_text("N")
      ->group("How to render");
  app.add_option("--samples", arguments->settings.samples,
                 "samples of the GGX reference a pixel, rounded up to a multiple of 16 [2048]")
      ->check(CLI::Range(16, 1 << 20))
      ->option_text("N")
      ->group("How to render");
  app.add_option("-o,--output", arguments->output,
                 "folder for spheres.png and an .exr a material, or the name of the .png [out]")
      ->check(refusal_of_output)
      ->option_text("PATH")
      ->group("Where to write");
  add_threads_option(app, arguments->threads);
  return [arguments] { render(*arguments); };
}

}  // namespace ltc::cli
