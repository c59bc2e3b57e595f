// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit lookup: what a table gives for many lobes, as a shader has it.
#include <algorithm>
#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/table_input.h"
#include "core/error.h"
#include "core/read_file.h"
#include "core/write_file.h"
#include "export/look_ups.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string table, queries, output;
  std::optional<ReadAs> layout;
};

constexpr std::size_t most_query_bytes = std::size_t{1} << 28;

void lookup(const Arguments& arguments) {
  const Table table = read_input(arguments.table, arguments.layout);
  const std::vector<Lobe> queries =
      parse_queries(read_whole_file(arguments.queries, "queries", most_query_bytes),
                    arguments.queries, *table.grid.model);
  std::vector<LookUp> found;
  std::ranges::transform(queries, std::back_inserter(found),
                         [&](const Lobe& lobe) { return look_up(table, lobe); });
  if (arguments.output.empty())
    print(look_ups_csv(queries, found));
  else
    write_file(arguments.output, arguments.output.ends_with(".npy") ? look_ups_npy(queries, found)
                                 : arguments.output.ends_with(".json")
                                     ? look_ups_json(queries, found)
                                     : look_ups_csv(queries, found));
}

}  // namespace

Action declare_lookup(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "TABLE", arguments->table, "table to ask");
  add_input_option(app, "-q,--queries", arguments->queries,
                   "CSV whose first line names alpha_x, alpha_y, and theta and phi in radians, or "
                   "theta_degrees and phi_degrees")
      ->required()
      ->group("What to look up");
  allow(add_output_option(app, "-o,--output", arguments->output,
                          "write M, amplitude and Fresnel term of each to this file, not as CSV to "
                          "standard output")
            ->group("What to write"),
        {"a file that ends in .csv, .npy or .json", [](std::string& file) {
           return file.ends_with(".csv") || file.ends_with(".npy") || file.ends_with(".json");
         }});
  add_layout_option(app, arguments->layout);
  return [arguments](Files&) { lookup(*arguments); };
}

}  // namespace ltc::cli
