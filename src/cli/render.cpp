// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit render: spheres under a rectangular light, by sampled GGX and by a table.
#include <fmt/format.h>

#include <chrono>
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
  double f0 = 1;
  SphereSettings settings;
  std::string output = "out";
  int threads = default_threads();
};

// One rendered material.
struct Result {
  SphereRow row;
  double seconds = 0;
};

// Those of figure 14 of Aakash et al. 2022, unless one is asked for.
std::vector<Material> materials_of(const Arguments& arguments) {
  if (arguments.alpha_x.has_value() != arguments.alpha_y.has_value())
    throw InputError(fmt::format("--alpha-{} without --alpha-{}; expected both or neither",
                                 arguments.alpha_x ? "x" : "y", arguments.alpha_x ? "y" : "x"));
  const double f0 = arguments.f0;
  if (arguments.alpha_x)
    return {{*arguments.alpha_x, *arguments.alpha_y, f0}};
  return {{0.05, 0.25, f0}, {0.5, 0.02, f0}, {0.5, 0.25, f0}, {0.5, 1.0, f0}};
}

Table load(const std::string& path) {
  Table table = read_table(path);
  fill_missing_albedo(table);
  return table;
}

// Where the files go: DIR/spheres.png and beside it, or, for a name that ends with .png, that file
// and beside it.
struct Destination {
  fs::path folder;
  std::string stem;

  fs::path picture() const { return folder / (stem + ".png"); }
  fs::path images(const Material& material) const {
    return folder / fmt::format("{}_{}_{}.exr", stem, material.alpha_x, material.alpha_y);
  }
};

Destination destination_of(const fs::path& output) {
  if (output.extension() != ".png")
    return {output, "spheres"};
  const fs::path folder = output.parent_path();
  return {folder.empty() ? fs::path(".") : folder, output.stem().string()};
}

std::vector<Result> render_all(const Arguments& arguments, const std::vector<Material>& materials,
                               const std::vector<const Table*>& tables, Progress& progress) {
  std::vector<Result> results;
  for (const Material& material : materials) {
    const Clock::time_point began = Clock::now();
    const std::string stage = fmt::format("render {}, {}", material.alpha_x, material.alpha_y);
    SphereImages images =
        render_sphere(tables, material, arguments.settings, stage, arguments.threads, &progress);
    const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
    results.push_back({{material, std::move(images)}, seconds});
  }
  return results;
}

void require_some_entries(const std::vector<Result>& results, std::size_t table,
                          const std::string& path) {
  for (const Result& result : results)
    if (sphere_error(result.row.images, table).pixels > 0)
      return;
  throw InputError(
      fmt::format("{}: has none of the entries that {} {} needs; expected a table "
                  "fitted for these roughnesses",
                  path, results.size() > 1 ? "materials" : "material",
                  results.size() > 1 ? "of figure 14" : "asked for"));
}

void write_images(const Result& result, const Arguments& arguments, const fs::path& path) {
  const SphereImages& images = result.row.images;
  const Material& material = result.row.material;
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
      {"ltc:samples", fmt::format("{}", arguments.settings.samples)},
      {"ltc:table", arguments.table}};
  if (images.ltc.size() > 1) {
    layers.push_back({"ltc_b.Y", &images.ltc[1]});
    layers.push_back({"difference_b.Y", &differences[1]});
    attributes.push_back({"ltc:table_b", arguments.table_b});
  }
  write_image_exr(layers, attributes, path);
}

std::string report_text(const std::vector<Result>& results, const std::vector<std::string>& names) {
  std::string text = "mean |error| and noise in units of the light's radiance\n\n";
  text += fmt::format("{:>8} {:>8}  {:<24} {:>12} {:>14} {:>12} {:>8}\n", "alpha_x", "alpha_y",
                      "table", "mean |error|", "RMSE/mean GGX", "noise of GGX", "seconds");
  for (const Result& result : results)
    for (std::size_t table = 0; table < names.size(); ++table) {
      const SphereError error = sphere_error(result.row.images, table);
      const Material& material = result.row.material;
      text += fmt::format("{:>8} {:>8}  {:<24} ", material.alpha_x, material.alpha_y, names[table]);
      if (error.pixels == 0)
        text += "no entries for this material\n";
      else
        text += fmt::format("{:>12.5f} {:>12.2f} % {:>12.5f} {:>8.2f}\n", error.mean_absolute,
                            100 * error.relative_rmse, error.standard_error, result.seconds);
      if (error.pixels > 0 && error.without > 0)
        text += fmt::format("{:19}{} of {} pixels without an entry\n", "", error.without,
                            error.without + error.pixels);
    }
  return text;
}

SpherePicture picture_of(const Arguments& arguments, std::vector<Result>& results) {
  SpherePicture content;
  content.title = "Spheres under a rectangular light";
  content.tables = {"LTC, table"};
  if (!arguments.table_b.empty())
    content.tables = {"LTC, table A", "LTC, table B"};
  content.caption = fmt::format(
      "x along the parallels about the upright axis, y along the meridians. GGX: multiple "
      "importance "
      "sampling, {} samples a pixel.",
      arguments.settings.samples);
  for (Result& result : results)
    content.rows.push_back(std::move(result.row));
  return content;
}

void render(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const std::vector<Material> materials = materials_of(arguments);
  const Table table = load(arguments.table);
  std::vector<const Table*> tables{&table};
  std::optional<Table> table_b;
  std::vector<std::string> names{arguments.table};
  if (!arguments.table_b.empty()) {
    table_b = load(arguments.table_b);
    tables.push_back(&*table_b);
    names.push_back(arguments.table_b);
  }
  const Destination destination = destination_of(arguments.output);
  const OutputFolder folder(destination.folder);

  std::vector<Result> results = render_all(arguments, materials, tables, progress);
  for (std::size_t i = 0; i < names.size(); ++i)
    require_some_entries(results, i, names[i]);
  std::string text = report_text(results, names);
  progress.throw_if_stopped();
  for (const Result& result : results) {
    const fs::path path = destination.images(result.row.material);
    write_images(result, arguments, path);
    text +=
        fmt::format("{}{}\n", &result == &results.front() ? "\nwrote " : "      ", path.string());
  }
  draw(picture_of(arguments, results)).write_png(destination.picture());
  print(text + fmt::format("      {}\n", destination.picture().string()));
}

void add_number_option(CLI::App& app, const char* name, std::optional<double>& value,
                       const char* what) {
  app.add_option(name, value, what)
      ->check(CLI::Range(1e-4, 1.0))
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
                 "samples of the GGX reference a pixel, rounded up to a multiple of 16 [1024]")
      ->check(CLI::Range(16, 1 << 20))
      ->option_text("N")
      ->group("How to render");
  app.add_option("-o,--output", arguments->output,
                 "folder for spheres.png and an .exr a material, or the name of the .png [out]")
      ->check([](const std::string& text) {
        return std::string(text.empty() ? "is empty; expected a folder or a .png" : "");
      })
      ->option_text("PATH")
      ->group("Where to write");
  add_threads_option(app, arguments->threads);
  return [arguments] { render(*arguments); };
}

}  // namespace ltc::cli
