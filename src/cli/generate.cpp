// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit generate: config in, table files out; or the fits of a shard, which ltcfit merge goes on
// with.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "cli/command.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/table_run.h"
#include "pipeline/shards.h"

namespace ltc::cli {
namespace {

struct Arguments {
  ConfigArguments config;
  TableRunArguments run;
  std::string shard;  // empty: all of it
};

// "2/5".
std::optional<Shard> shard_of(std::string_view text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/')
    return std::nullopt;
  const auto count = std::from_chars(number.ptr + 1, end, shard.count);
  if (count.ec != std::errc() || count.ptr != end || shard.number < 1 ||
      shard.number > shard.count || shard.count > most_shards)
    return std::nullopt;
  return shard;
}

std::string shard_text(const Shard& shard, const ShardReport& report) {
  return fmt::format(
      "shard    {} of {}: {} fits, {} of them taken from its file\n"
      "file     {}\n"
      "time     {}; ltcfit merge puts all shards together\n",
      shard.number, shard.count, report.fits, report.resumed, report.file.string(),
      duration_text(report.seconds));
}

std::string shard_json(const Shard& shard, const ShardReport& report) {
  nlohmann::ordered_json json;
  json["shard"] = shard.number;
  json["shards"] = shard.count;
  json["files"] = {report.file.string()};
  json["fits"] = report.fits;
  json["resumed"] = report.resumed;
  json["seconds"] = report.seconds;
  return json_text(json);
}

void make_and_tell_shard(const Arguments& arguments, const RunRequest& request,
                         const RunContext& context, Files& files) {
  const Shard shard = *shard_of(arguments.shard);
  if (is_first(context.ranks))
    files.write("--output", shard_file(request.config, request.folder, shard));
  const ShardReport report = make_shard(request, shard, context);
  if (is_first(context.ranks))
    print_results(
        arguments.run.json, [&] { return shard_text(shard, report); },
        [&] { return shard_json(shard, report); });
}

std::string fit_command(const Arguments& arguments) {
  std::string command = "ltcfit fit" + arguments.config.as_text();
  if (!arguments.run.scene.empty())
    command += " --scene " + shell_quoted(arguments.run.scene);
  return command + " --entry";
}

void generate(const Arguments& arguments, Files& files) {
  run_watched(
      arguments.run, [&] { return arguments.config.load(); }, files,
      [&](RunRequest& request, const RunContext& context) {
        request.inputs = {arguments.config.file};
        if (arguments.shard.empty())
          make_and_tell(arguments.run, request, context, files, fit_command(arguments));
        else
          make_and_tell_shard(arguments, request, context, files);
      });
}

}  // namespace

Action declare_generate(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_config_options(app, arguments->config);
  add_table_run_options(app, arguments->run);
  allow(app.add_option("--shard", arguments->shard,
                       "make the I-th of N parts of the fits alone, and leave a file of them for "
                       "ltcfit merge [all]"),
        {fmt::format("I/N with I from 1 to N, and N up to {}", most_shards),
         [](std::string& text) { return shard_of(text).has_value(); }})
      ->option_text("I/N")
      ->group(what_to_fit);
  return [arguments](Files& files) { generate(*arguments, files); };
}

}  // namespace ltc::cli
