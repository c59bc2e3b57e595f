// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate: config in, table files out.
#include "pipeline/generate.h"

#include <fmt/format.h>

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

namespace ltc::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  ConfigArguments config;
  std::string output = "out";
  int threads = default_threads();
};

std::vector<fs::path> files_of(const OutputSettings& output, const fs::path& folder) {
  std::vector<fs::path> files;
  if (output.hdf5)
    files.push_back(folder / (output.name + ".h5"));
  for (int i = 0; output.exr && i < 3; ++i)
    files.push_back(folder / fmt::format("{}.{}.exr", output.name, i));
  if (output.npy)
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

void write_files(const Table& table, const OutputSettings& output, const fs::path& folder) {
  if (output.hdf5)
    write_hdf5(table, folder / (output.name + ".h5"));
  if (output.exr)
    write_exr(table, folder / output.name, output.exr_half);
  if (output.npy)
    write_npy(table, folder / (output.name + ".npy"));
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
  const OutputFolder folder(arguments.output);
  RunReport report;
  report.files = files_of(config.output, folder.path());
  require_replaceable(report.files);

  const Table table = generate_table(config, arguments.threads, &progress, &report.generate);

  // The last chance to stop: the files are written all or none.
  progress.throw_if_stopped();
  const Clock::time_point writing_began = Clock::now();
  write_files(table, config.output, folder.path());
  report.generate.stage_seconds.emplace_back("write", seconds_since(writing_began));

  report.seconds = seconds_since(began);
  report.peak_memory_bytes = platform::peak_memory_bytes();
  report.debug_command = "ltcfit fit" + arguments.config.as_text() + " --entry";
  print(summary_text(table, report));
}

}  // namespace

Action declare_generate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_config_options(app, arguments->config);
  add_output_option(app, arguments->output);
  add_threads_option(app, arguments->threads);
  return [arguments] { generate(*arguments); };
}

}  // namespace ltc::cli
