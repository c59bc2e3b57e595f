// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fields in files: ltc_field.json, and what every file of one must keep. docs/files.md has the
// contract.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "export/format.h"

namespace ltc {

// The basis of field/field.h as files name it, and the version of their contract.
constexpr const char* basis_name(bool folded) {
  return folded ? "chebyshev-polar-folded" : "chebyshev-polar";
}
inline constexpr int field_format_version = 1;

// A term's numbers as files have them: degrees in alpha, lambda, r and w, and the order in phi.
std::array<std::uint8_t, 5> numbers_of(const FieldTerm& term);

// Throws InputError naming the file where terms are out of order, stand twice or are none that the
// part may have, or where a coefficient is not finite.
void require_consistent(const Field& field, const std::filesystem::path& file);

std::string encode_field(const Table& table);

// Whether a JSON file is a field's, by its beginning; then read by decode_field, which gives the
// field as a table over the paper's grid. Throws InputError naming the file and what is wrong.
bool is_field(std::string_view text);
Table decode_field(std::string_view text, const std::filesystem::path& file);

Format field_format();

}  // namespace ltc
