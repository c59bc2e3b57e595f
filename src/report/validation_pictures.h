// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The pictures of a validation page.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "picture/canvas.h"
#include "picture/chart.h"
#include "report/validation_page.h"

namespace ltc {

struct NamedPicture {
  std::string title;
  std::string caption;
  picture::Canvas canvas;
};

// Over the whole table: relative loss, amplitude, Fresnel term and condition number; those that the
// table has no values of are left out.
std::vector<NamedPicture> table_pictures(const Validation& validation);

// Mean loss and error under area lights over each parameter of the queries, beside their floors.
std::vector<picture::Chart> band_charts(const QualityReport& quality);

// GGX, LTC and difference of the worst queries as the table looks them up, then of entries that
// break an invariant.
std::vector<NamedPicture> lobe_pictures(const Validation& validation, std::size_t lobes,
                                        const RunContext& run);

// The spheres of figure 14 of Aakash et al. 2022 by the table.
NamedPicture sphere_picture(const Validation& validation, const PageSettings& settings,
                            const RunContext& run);

}  // namespace ltc
