// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "brdf/measured_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "core/hdf5_file.h"
#include "core/hdf5_guard.h"

namespace ltc {
namespace {

constexpr std::string_view brdf_format = "ltc-brdf";
constexpr std::int64_t brdf_format_version = 1;

// In either precision, for both are what programs write by default.
std::vector<double> numbers(const Hdf5Input& file, const std::string& dataset,
                            const std::vector<std::size_t>& shape) {
  try {
    return file.values<double>(dataset, shape);
  } catch (const InputError&) {
    const std::vector<float> single = file.values<float>(dataset, shape);
    return {single.begin(), single.end()};
  }
}

std::vector<double> axis(const Hdf5Input& file, const std::filesystem::path& path,
                         const std::string& name) {
  const std::vector<std::size_t> shape = file.shape(name);
  if (shape.size() != 1 || shape[0] < 1)
    throw InputError(
        fmt::format("{}: dataset {} must be a list of at least one number", path.string(), name));
  return numbers(file, name, shape);
}

MeasuredBrdf read_unguarded(const std::filesystem::path& path) {
  const Hdf5Input file(path);
  if (const std::string format = file.text("/", "format"); format != brdf_format)
    throw InputError(fmt::format("{}: attribute format is \"{}\"; allowed: \"{}\"", path.string(),
                                 format, brdf_format));
  if (const std::int64_t version = file.integer("/", "format_version");
      version != brdf_format_version)
    throw InputError(fmt::format("{}: attribute format_version is {}; allowed: {}", path.string(),
                                 version, brdf_format_version));
  const std::string quantity = file.text("/", "quantity");
  if (quantity != "brdf" && quantity != "brdf-cosine")
    throw InputError(
        fmt::format("{}: attribute quantity is \"{}\"; allowed: \"brdf\" and "
                    "\"brdf-cosine\"",
                    path.string(), quantity));
  MeasuredBrdf brdf;
  brdf.alpha = axis(file, path, "alpha");
  brdf.lambda = axis(file, path, "lambda");
  brdf.theta = axis(file, path, "theta");
  brdf.phi = axis(file, path, "phi");
  brdf.theta_light = axis(file, path, "theta_light");
  brdf.phi_light = axis(file, path, "phi_light");
  const std::vector<double> values = numbers(file, "values", brdf.shape());
  const bool weighted = quantity == "brdf-cosine";
  brdf.values.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t row = i / brdf.phi_light.size() % brdf.theta_light.size();
    const double cosine = std::cos(brdf.theta_light[row]);
    if (weighted && !(cosine > 1e-3))
      throw InputError(
          fmt::format("{}: quantity \"brdf-cosine\" with theta_light {}; expected "
                      "below 1.5697: at the horizon it says nothing of the BRDF",
                      path.string(), brdf.theta_light[row]));
    brdf.values.push_back(static_cast<float>(weighted ? values[i] / cosine : values[i]));
  }
  require_sound(brdf, path.string());
  return brdf;
}

}  // namespace

MeasuredBrdf read_brdf(const std::filesystem::path& path) {
  require_harmless(path, [&] { read_unguarded(path); });
  return read_unguarded(path);
}

}  // namespace ltc
