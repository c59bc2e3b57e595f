// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate: config in, table files out.
#include "pipeline/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/summary.h"
#include "core/platform.h"
#include "export/exr.h"
#include "export/hdf5.h"
#include "export/npy.h"
#include "export/reader.h"
#include "scene/coverage.h"
#include "scene/scene.h"
#include "table/extend.h"

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  ConfigArguments config;
  std::string scene;   // empty: the whole table
  std::string extend;  // empty: a new table
  std::string output = "out";
  int threads = default_threads();
};

// NPY says nothing of axes and storage: it is for the paper's grid alone.
bool writes_npy(const Config& config) {
  return config.output.npy && npy_can_hold(config.grid);
}

std::vector<fs::path> files_of(const Config& config, const fs::path& folder) {
  const OutputSettings& output = config.output;
  std::vector<fs::path> files;
  if (output.hdf5)
    files.push_back(folder / (output.name + ".h5"));
  for (int i = 0; output.exr && i < 3; ++i)
    files.push_back(folder / fmt::format("{}.{}.exr", output.name, i));
  if (writes_npy(config))
    files.push_back(folder / (output.name + ".npy"));
  return files;
}

// Better now than after the fit: a folder cannot be replaced by a file.
void require_replaceable(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files)
    if (fs::is_directory(file, ignored))
      throw IoError(fmt::format("cannot write {}: it is a folder; remove it or set output.name",
                                file.string()));
}

void write_files(const Table& table, const Config& config, const fs::path& folder) {
  const OutputSettings& output = config.output;
  if (output.hdf5)
    write_hdf5(table, folder / (output.name + ".h5"));
  if (output.exr)
    write_exr(table, folder / output.name, output.exr_half);
  if (writes_npy(config))
    write_npy(table, folder / (output.name + ".npy"));
}

// What a scene and an existing table leave to do.
struct Work {
  std::vector<bool> needed;  // by the scene
  std::vector<bool> to_fit;  // needed and not in the existing table
  std::optional<Table> existing;
};

Work plan_work(const Arguments& arguments, const Config& config) {
  Work work;
  work.needed = arguments.scene.empty() ? std::vector<bool>(config.grid.size(), true)
                                        : needed_entries(load_scene(arguments.scene), config.grid);
  work.to_fit = work.needed;
  if (!arguments.extend.empty()) {
    work.existing = read_table(arguments.extend);
    require_extendable(*work.existing, arguments.extend, config.grid, config.storage, config.brdf);
    work.to_fit = lacking_entries(*work.existing, work.needed);
  }
  return work;
}

std::size_t count_true(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

void generate(const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const Clock::time_point began = Clock::now();
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);

  const Config config = arguments.config.load();
  const Work work = plan_work(arguments, config);
  const OutputFolder folder(arguments.output);
  RunReport report;
  report.files = files_of(config, folder.path());
  require_replaceable(report.files);

  Table table = generate_table(config, work.to_fit, arguments.threads, &progress, &report.generate);
  if (work.existing)
    table = extended(*work.existing, table);
  report.needed = count_true(work.needed);
  report.added = count_true(work.to_fit);
  report.extends = work.existing.has_value();
  report.npy_left_out = config.output.npy && !writes_npy(config);

  // The last chance to stop: the files are written all or none.
  progress.throw_if_stopped();
  const Clock::time_point writing_began = Clock::now();
  write_files(table, config, folder.path());
  report.generate.stage_seconds.emplace_back("write", seconds_since(writing_began));

  report.seconds = seconds_since(began);
  report.peak_memory_bytes = platform::peak_memory_bytes();
  report.debug_command = "ltcfit fit" + arguments.config.as_text();
  if (!arguments.scene.empty())
    report.debug_command += " --scene " + shell_quoted(arguments.scene);
  report.debug_command += " --entry";
  print(summary_text(table, report));
}

}  // namespace

Action declare_generate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_config_options(app, arguments->config);
  app.add_option(
      "--scene", arguments->scene,
      "fit only what this scene's materials need: TOML, .gltf or .glb [the whole table]");
  app.add_option("--extend", arguments->extend,
                 "keep the entries of this .h5 bit for bit and add what is lacking [none]");
  add_output_option(app, arguments->output);
  add_threads_option(app, arguments->threads);
  return [arguments] { generate(*arguments); };
}

}  // namespace ltc::cli
