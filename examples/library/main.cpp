// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fits a lobe of brushed metal, makes a small table, writes it, reads it back and looks the lobe
// up.
#include <ltcfit/ltcfit.h>

#include <cstdio>
#include <filesystem>

int main() {
  try {
    const ltcfit::Lobe lobe{.alpha_x = 0.4, .alpha_y = 0.1, .theta_radians = 1, .phi_radians = 0.5};
    const ltcfit::FittedLobe fit = ltcfit::fit(lobe);
    std::printf("fitted: %.4f of the lobe's spread from GGX, amplitude %.4f\n",
                fit.loss / fit.spread, fit.shading.amplitude);

    const ltcfit::Config config{
        .file = {},
        .overrides = {"table.alpha.nodes=4", "table.lambda.nodes=3", "table.theta.nodes=4",
                      "table.phi.nodes=3", "refine.steps=2"}};
    const std::filesystem::path file = "example.h5";
    ltcfit::generate(config).write(file);
    const ltcfit::Table table = ltcfit::Table::read(file);
    const ltcfit::Shading shading = table.look_up(lobe);
    std::printf("looked up: amplitude %.4f, M =\n", shading.amplitude);
    for (int row = 0; row < 3; ++row)
      std::printf("%9.5f %9.5f %9.5f\n", shading.matrix(row, 0), shading.matrix(row, 1),
                  shading.matrix(row, 2));
    for (const ltcfit::Check& check : ltcfit::validate(table, {}, false).checks)
      if (check.checked && !check.passed)
        std::printf("%s\n", check.message.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
