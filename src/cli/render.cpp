// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit render: spheres and sheets under a light, by sampled GGX and by a table.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "brdf/lobe_model.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/light_options.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/render_report.h"
#include "cli/roughness_options.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/version.h"
#include "core/write_file.h"
#include "export/table_file.h"
#include "render/image_exr.h"
#include "render/missing_albedo.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string table, table_b;  // table_b empty: none
  std::optional<ReadAs> layout;
  RoughnessArguments roughness;
  std::vector<std::string> materials;  // as parse_roughness takes them
  double f0 = 1;
  LightArguments light;
  SphereSettings settings;
  std::string output = "out";
  std::string json;  // empty: none
  int threads = processor_count();
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

constexpr double least_alpha = 1e-4;

// Those of figure 14 of Aakash et al. 2022, unless others are asked for.
std::vector<SphereMaterial> materials_of(const Arguments& arguments, const Tables& tables) {
  const Grid& grid = tables.tables.front().grid;
  const double f0 = arguments.f0;
  std::vector<SphereMaterial> materials;
  const auto add = [&](const LobeRoughness& roughness) {
    materials.push_back({roughness.alpha_x, roughness.alpha_y, f0});
  };
  if (arguments.roughness.any())
    add(roughness_of(arguments.roughness, least_alpha));
  for (const std::string& text : arguments.materials)
    add(parse_roughness("--material", text, least_alpha));
  for (const SphereMaterial& material : materials)
    require_material(material, *grid.model, grid.alpha_min);
  return materials.empty() ? usual_materials(*grid.model, f0) : materials;
}

Tables load_tables(const Arguments& arguments) {
  Tables tables;
  tables.paths = {arguments.table};
  if (!arguments.table_b.empty())
    tables.paths.push_back(arguments.table_b);
  for (std::size_t i = 0; i < tables.paths.size(); ++i) {
    tables.tables.push_back(read_input(tables.paths[i], arguments.layout));
    fill_missing_albedo(tables.tables.back());
    tables.names.push_back(tables.paths.size() == 1 ? "LTC" : i == 0 ? "LTC, A" : "LTC, B");
  }
  return tables;
}

// What several objects are called: the files, and the picture's title.
std::string plural_of(ObjectShape shape) {
  return fmt::format("{}s", name_of(shape));
}

// Where the files go: DIR/spheres.png and beside it, or, for a name that ends with .png, that file
// and beside it.
struct Destination {
  fs::path folder;
  std::string stem;
  bool is_folder;  // what was named

  fs::path picture() const { return folder / (stem + ".png"); }
  fs::path images(const SphereMaterial& material) const {
    return folder / fmt::format("{}_{}_{}.exr", stem, material.alpha_x, material.alpha_y);
  }
};

Destination destination_of(const fs::path& output, ObjectShape shape) {
  if (output.extension() != ".png")
    return {output, plural_of(shape), true};
  return {output.parent_path(), output.stem().string(), false};
}

// A folder may have a dot in its name, but one that is called like another picture is a mistake.
bool is_folder_or_png(const std::string& text) {
  const std::string ending = fs::path(text).extension().string();
  for (const char* other :
       {".bmp", ".exr", ".gif", ".jpeg", ".jpg", ".pdf", ".svg", ".tif", ".tiff"})
    if (ending == other && !fs::is_directory(text))
      return false;
  return !text.empty();
}

// Which table clamps what of a material.
std::vector<std::vector<ClampedAxis>> clamping_of(const SphereMaterial& material,
                                                  const Tables& tables) {
  std::vector<std::vector<ClampedAxis>> clamped;
  for (const Table& table : tables.tables)
    clamped.push_back(clamped_axes(table.grid, material));
  return clamped;
}

RenderReport report_of(const Arguments& arguments, const std::vector<SphereMaterial>& materials,
                       const Tables& tables, const Destination& destination) {
  RenderReport report;
  report.files = tables.paths;
  report.names = tables.names;
  const ObjectShape shape = arguments.settings.scene.shape;
  report.shape = name_of(shape);
  report.light = arguments.light.kind;
  report.light_position = arguments.light.center(shape);
  report.light_size = arguments.light.size;
  report.two_sided = arguments.light.two_sided;
  report.samples = arguments.settings.samples;
  report.horizon = name_of(arguments.settings.horizon);
  report.reference = tables.tables.front().grid.model->label();
  report.size = arguments.settings.size;
  report.picture = destination.picture();
  for (const SphereMaterial& material : materials) {
    report.rows.push_back({material, {}, clamping_of(material, tables)});
    report.images.push_back(destination.images(material));
  }
  return report;
}

void render_all(const Arguments& arguments, const Tables& tables, RenderReport& report,
                Progress& progress) {
  const RunContext run{arguments.threads, &progress};
  SphereSettings settings = arguments.settings;
  settings.scene.light = light_of(arguments.light, settings.scene.shape, run);
  for (SphereRow& row : report.rows) {
    const Clock::time_point began = Clock::now();
    const std::string stage =
        fmt::format("render {:.4g}, {:.4g}", row.material.alpha_x, row.material.alpha_y);
    row.images = render_sphere(tables.pointers(), row.material, settings, stage, run);
    report.seconds.push_back(std::chrono::duration<double>(Clock::now() - began).count());
  }
}

// A table made for a scene may lack entries; one that lacks all that are asked for is of no use.
void require_some_entries(const RenderReport& report) {
  for (std::size_t table = 0; table < report.files.size(); ++table) {
    const auto any = [&](const SphereRow& row) {
      return sphere_error(row.images, table).pixels > 0;
    };
    if (std::none_of(report.rows.begin(), report.rows.end(), any))
      throw InputError(fmt::format(
          "{}: has none of the entries that these materials need; expected a table with entries "
          "at, for example, alpha_x {} and alpha_y {}",
          report.files[table], report.rows[0].material.alpha_x, report.rows[0].material.alpha_y));
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
      {"ltc:shape", std::string(name_of(arguments.settings.scene.shape))},
      {"ltc:light", arguments.light.kind},
      {"ltc:light_size", fmt::format("{}", arguments.light.size)},
      {"ltc:samples", fmt::format("{}", arguments.settings.samples)},
      {"ltc:horizon", std::string(name_of(arguments.settings.horizon))},
      {"ltc:table", arguments.table}};
  if (images.ltc.size() > 1) {
    layers.push_back({"ltc_b.Y", &images.ltc[1]});
    layers.push_back({"difference_b.Y", &differences[1]});
    attributes.push_back({"ltc:table_b", arguments.table_b});
  }
  write_image_exr(layers, attributes, path);
}

SpherePicture picture_of(const Arguments& arguments, const RenderReport& report) {
  SpherePicture content;
  content.shape = arguments.settings.scene.shape;
  content.title =
      fmt::format("{} under {}", plural_of(content.shape), one_line(arguments.light.text()));
  content.title.front() = static_cast<char>(std::toupper(content.title.front()));
  content.caption = {
      fmt::format("{}. {}: multiple importance sampling, {} samples a pixel.",
                  content.shape == ObjectShape::sphere
                      ? "x along the parallels about the upright axis, y along the meridians"
                      : "x to the right, y away from the camera",
                  report.reference, report.samples),
      "Differences and errors are in units of the light's radiance. " + tables_text(report)};
  content.tables = report.names;
  content.rows = report.rows;
  content.reference = report.reference;
  return content;
}

void render(const Arguments& arguments, Files& files) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const Tables tables = load_tables(arguments);
  const std::vector<SphereMaterial> materials = materials_of(arguments, tables);
  const Destination destination = destination_of(arguments.output, arguments.settings.scene.shape);
  if (arguments.light.has_image())
    files.read_alone("--light", arguments.light.kind);
  if (destination.is_folder)
    files.make_folder(destination.folder);
  RenderReport report = report_of(arguments, materials, tables, destination);
  files.write("--output", report.picture);
  for (const fs::path& image : report.images)
    files.write("--output", image);
  // Before the work: whoever meant another table stops it.
  tell(clamping_warnings(report));
  render_all(arguments, tables, report, progress);
  require_some_entries(report);
  const picture::Canvas picture = draw(picture_of(arguments, report));
  // The last chance to stop.
  progress.throw_if_stopped();
  for (std::size_t row = 0; row < report.rows.size(); ++row)
    write_images(report.rows[row], arguments, report.images[row]);
  picture.write_png(report.picture);
  print_results(
      arguments.json, [&] { return report_text(report); }, [&] { return report_json(report); });
}

}  // namespace

Action declare_render(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "TABLE", arguments->table, "table to render with");
  add_layout_option(app, arguments->layout);
  constexpr const char* what = "What to render";
  add_roughness_options(
      app, arguments->roughness,
      {"roughness along x, the parallels of a sphere [the four materials of figure "
       "14]",
       "roughness along y, together with --alpha-x", what});
  app.add_option("--material", arguments->materials,
                 "roughness along x and along y, or "
                 "roughness=R,anisotropy=A; can be repeated")
      ->allow_extra_args(false)
      ->option_text("X,Y")
      ->group(what);
  add_names_option(
      app, "--shape", arguments->settings.scene.shape,
      "what is lit: a sphere, a level plane, or a sheet bent about the x axis [sphere]")
      ->option_text("SHAPE")
      ->group(what);
  add_light_options(app, arguments->light, "Under which light");
  allow(app.add_option("--f0", arguments->f0,
                       "reflectance at normal incidence, of Schlick's term [1]"),
        number({0, 1}))
      ->option_text("X")
      ->group(what);
  add_input_option(app, "--table-b", arguments->table_b, "another table to compare with [none]")
      ->group(what);
  add_names_option(app, "--horizon", arguments->settings.horizon,
                   "what becomes of a lobe's light below the horizon: lost, or made up for by what "
                   "is above [clipped]")
      ->option_text("MODE")
      ->group("How to render");
  allow(app.add_option("--size", arguments->settings.size,
                       "width and height of an image, pixels [320]"),
        whole_number(8, 2048))
      ->option_text("N")
      ->group("How to render");
  allow(app.add_option("--samples", arguments->settings.samples,
                       "samples of the GGX reference a pixel, rounded up to a multiple of 16 "
                       "[2048]"),
        whole_number(16, 1 << 20))
      ->option_text("N")
      ->group("How to render");
  allow(app.add_option("-o,--output", arguments->output,
                       "folder for spheres.png (planes.png, sheets.png) and an .exr a material, "
                       "created if need be, or the name of the .png [out]"),
        {"a folder, or a file that ends in .png", is_folder_or_png})
      ->type_name(std::string(value_kind::folder))
      ->option_text("PATH")
      ->group("What to write");
  add_json_option(app, arguments->json)->group("What to write");
  add_threads_option(app, arguments->threads);
  return [arguments](Files& files) { render(*arguments, files); };
}

}  // namespace ltc::cli
