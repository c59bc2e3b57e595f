// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit merge: shards of a table in, its files out.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/table_run.h"
#include "pipeline/shards.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::vector<std::string> shards, overrides;
  TableRunArguments run;
};

void merge(const Arguments& arguments, Files& files) {
  const std::vector<std::filesystem::path> shards(arguments.shards.begin(), arguments.shards.end());
  const auto load = [&] {
    return parse_config(config_of_shards(shards), shards.front(), arguments.overrides,
                        ConfigArguments::override_option);
  };
  run_watched(arguments.run, load, files, [&](RunRequest& request, const RunContext& context) {
    request.shards = shards;
    make_and_tell(arguments.run, request, context, files, "");
  });
}

}  // namespace

Action declare_merge(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  allow(app.add_option("SHARD", arguments->shards,
                       "the files of all shards, as generate --shard leaves them"),
        not_empty("a file"))
      ->type_name(std::string(value_kind::input))
      ->option_text("FILE ...")
      ->required();
  app.add_option("-s,--set", arguments->overrides,
                 "change one key of the shards' config, of [output] alone, for example "
                 "output.npy=false; can be repeated")
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE")
      ->group(what_to_fit);
  add_table_run_options(app, arguments->run);
  return [arguments](Files& files) { merge(*arguments, files); };
}

}  // namespace ltc::cli
