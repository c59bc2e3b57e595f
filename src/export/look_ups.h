// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Queries from a CSV file, and what a table gives for them as CSV, NPY or JSON.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "table/lookup.h"

namespace ltc {

// The lobes of a text whose first line names the columns: alpha_x, alpha_y and theta and phi in
// radians, or theta_degrees and phi_degrees, in any order; others are ignored. alpha in [0, 1],
// theta in [0, pi/2], any finite phi. Throws InputError, naming file, line, value and what is
// allowed.
std::vector<Lobe> parse_queries(std::string_view text, const std::filesystem::path& file,
                                const LobeModel& model);

// One line or row a query: alpha_x, alpha_y, theta, phi in radians, the nine entries of M by rows,
// amplitude and Fresnel term, in single precision as tables have them.
std::string look_ups_csv(const std::vector<Lobe>& queries, const std::vector<LookUp>& found);
std::string look_ups_json(const std::vector<Lobe>& queries, const std::vector<LookUp>& found);
// f32, (queries, 15), in the order of the columns of the CSV.
std::string look_ups_npy(const std::vector<Lobe>& queries, const std::vector<LookUp>& found);

}  // namespace ltc
