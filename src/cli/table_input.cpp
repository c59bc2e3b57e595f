// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/table_input.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/options.h"
#include "cli/output.h"
#include "export/table_file.h"

namespace ltc::cli {

void add_layout_option(CLI::App& app, std::optional<Layout>& layout) {
  const auto set = [&layout](const std::string& name) { layout = value_named<Layout>(name); };
  CLI::Option* const option = app.add_option_function<std::string>(
      "--layout", set,
      fmt::format(
          "what the first two axes of an {} hold: alpha-lambda or alphax-alphay [told apart "
          "by the symmetry of alpha_x and alpha_y]",
          endings_text([](const Format& format) { return format.without_axes; })));
  allow_names(option, all_names<Layout>())->option_text("LAYOUT")->group("How to read tables");
}

Table read_input(const std::string& file, std::optional<Layout> layout) {
  Table table = read_table(file, layout);
  // A line that cannot be written is no reason to stop.
  if (!layout && table.grid.layout == Layout::alphax_alphay)
    std::fputs(
        fmt::format("{}: read with axes alpha_x, alpha_y, theta, phi, since exchanging the first "
                    "two is its symmetry; --layout alpha-lambda reads it otherwise\n",
                    one_line(file))
            .c_str(),
        stderr);
  return table;
}

}  // namespace ltc::cli
