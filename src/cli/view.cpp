// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit view: a page in which a table is looked at under area lights, beside GGX.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/table_input.h"
#include "core/write_file.h"
#include "render/missing_albedo.h"
#include "report/viewer_page.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string table, table_b;  // table_b empty: none
  std::optional<ReadAs> layout;
  std::string output;  // empty: default_page
};

constexpr const char* default_page = "viewer.html";

void view(const Arguments& arguments, Files& files) {
  const std::string output = arguments.output.empty() ? default_page : arguments.output;
  // One that is asked for is known already.
  if (arguments.output.empty())
    files.write("--output", output);
  std::vector<std::string> names = {arguments.table};
  if (!arguments.table_b.empty())
    names.push_back(arguments.table_b);
  std::vector<Table> tables;
  for (const std::string& name : names) {
    tables.push_back(read_input(name, arguments.layout));
    fill_missing_albedo(tables.back());
  }
  std::vector<ViewedTable> viewed;
  for (std::size_t i = 0; i < tables.size(); ++i)
    viewed.push_back({names[i], &tables[i]});
  const std::string page = viewer_page(viewed);
  write_file(output, page);
  print(fmt::format("wrote {}, {:.1f} MB: open it in a browser with WebGL 2\n", one_line(output),
                    static_cast<double>(page.size()) / 1e6));
}

}  // namespace

Action declare_view(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_table_argument(app, "TABLE", arguments->table, "table or field to look at");
  add_input_option(app, "TABLE_B", arguments->table_b, "another to compare it with [none]");
  add_layout_option(app, arguments->layout);
  allow(app.add_option("-o,--output", arguments->output,
                       "page to write, HTML that needs no other file and no network "
                       "[viewer.html]"),
        {"a file that ends in .html", [](std::string& file) { return file.ends_with(".html"); }})
      ->type_name(std::string(value_kind::output))
      ->option_text("FILE")
      ->group("What to write");
  return [arguments](Files& files) { view(*arguments, files); };
}

}  // namespace ltc::cli
