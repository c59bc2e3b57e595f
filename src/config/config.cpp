// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "config/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/draft.h"
#include "config/reader.h"
#include "config/registry.h"
#include "config/toml_file.h"
#include "core/error.h"

namespace ltc {
namespace {

using config::AxisSettings;
using config::Draft;

void check_axis(const std::string& section, const std::string& unit, const AxisSettings& axis,
                const config::Sources& sources) {
  if (axis.nodes == 1 || axis.first < axis.last)
    return;
  const std::string first = section + ".first" + unit, last = section + ".last" + unit;
  throw InputError(fmt::format("{}: {} = {} does not lie below {} = {}; expected {} below {}{}",
                               config::latest_source(sources, {first, last}), first, axis.first,
                               last, axis.last, first, last, ", or one node"));
}

// What no single key can tell.
void check_together(const Draft& draft, const config::Sources& sources) {
  check_axis("table.alpha", "", draft.alpha, sources);
  check_axis("table.lambda", "", draft.lambda, sources);
  check_axis("table.theta", "_degrees", draft.theta_degrees, sources);
  check_axis("table.phi", "_degrees", draft.phi_degrees, sources);
  if (draft.config.storage == Storage::inverse && !is_isotropic(config::config_of(draft).grid))
    throw InputError(fmt::format(
        "{}: table.storage = \"inverse\" with other nodes than lambda = 1 and phi = 0; expected "
        "one "
        "node of each: inverses of other lobes do not interpolate",
        config::latest_source(sources, {"table.storage", "table.lambda.first", "table.lambda.nodes",
                                        "table.phi.first_degrees", "table.phi.nodes"})));
  if (draft.config.storage == Storage::folded && draft.config.fit.lobe != LobeKind::folded)
    throw InputError(fmt::format(
        "{}: table.storage = \"folded\" with fit.lobe = \"{}\"; expected \"folded\", which is "
        "stored so whatever else is asked for",
        config::latest_source(sources, {"table.storage", "fit.lobe"}),
        name_of(draft.config.fit.lobe)));
  const OutputSettings& output = draft.config.output;
  constexpr std::array formats = {&OutputSettings::hdf5,     &OutputSettings::exr,
                                  &OutputSettings::npy,      &OutputSettings::dds,
                                  &OutputSettings::ktx2,     &OutputSettings::json,
                                  &OutputSettings::raw,      &OutputSettings::javascript,
                                  &OutputSettings::c_header, &OutputSettings::c_sharp};
  if (std::ranges::none_of(formats, [&](bool OutputSettings::*format) { return output.*format; }))
    throw InputError(fmt::format(
        "{}: no format of [output] is true; expected at least one true, such as output.hdf5",
        config::latest_source(sources, {"output.hdf5", "output.exr", "output.npy"})));
  if (output.layout == TextureLayout::unity && draft.config.refine.steps > 0)
    throw InputError(
        fmt::format("{}: output.layout = \"unity\" with refine.steps = {}; expected 0: refinement "
                    "moves nodes to where that layout divides by what is not positive",
                    config::latest_source(sources, {"output.layout", "refine.steps"}),
                    draft.config.refine.steps));
  const FitSettings& fit = draft.config.fit;
  if (fit.lobe == LobeKind::folded && fit.solver != SolverKind::gauss_newton)
    throw InputError(fmt::format(
        "{}: fit.lobe = \"folded\" with fit.solver = \"{}\"; expected \"gauss-newton\", the only "
        "one that fits folds",
        config::latest_source(sources, {"fit.lobe", "fit.solver"}), name_of(fit.solver)));
  if (fit.horizon == HorizonMode::scaled && fit.solver != SolverKind::gauss_newton)
    throw InputError(fmt::format(
        "{}: fit.horizon = \"scaled\" with fit.solver = \"{}\"; expected \"gauss-newton\", the "
        "only "
        "one that fits what is above the horizon alone",
        config::latest_source(sources, {"fit.horizon", "fit.solver"}), name_of(fit.solver)));
  if (fit.lobe == LobeKind::folded && fit.second_crease > 0 && fit.second_crease <= fit.crease)
    throw InputError(
        fmt::format("{}: fit.second_crease = {} is not above fit.crease = {}; expected more, or 0",
                    config::latest_source(sources, {"fit.second_crease", "fit.crease"}),
                    fit.second_crease, fit.crease));
  if (fit.sgd.lattice_samples && fit.target == TargetKind::rejection)
    throw InputError(
        fmt::format("{}: fit.sgd.lattice_samples = true with fit.target = \"rejection\"; expected "
                    "\"weighted\": rejection leaves no lattice",
                    config::latest_source(sources, {"fit.sgd.lattice_samples", "fit.target"})));
}

// The defaults, what `read` says, then the overrides.
template <class Read>
Config config_from(Read&& read, std::span<const std::string> overrides,
                   std::string_view overrides_from) {
  Draft draft = config::draft_of(Config{});
  const config::Vocabulary vocabulary =
      config::vocabulary(config::keys(), draft, "config/default.toml lists the keys there are");
  config::Sources sources;
  read(vocabulary, sources);
  for (const std::string& override : overrides)
    config::read_override(override, std::string(overrides_from), vocabulary, sources);
  check_together(draft, sources);
  return config::config_of(draft);
}

}  // namespace

Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides, std::string_view overrides_from) {
  return config_from(
      [&](const config::Vocabulary& vocabulary, config::Sources& sources) {
        if (file)
          config::read_file(*file, vocabulary, sources);
      },
      overrides, overrides_from);
}

std::string read_config(const std::filesystem::path& file) {
  return config::read_toml_text(file, "config");
}

Config parse_config(std::string_view text, const std::filesystem::path& source,
                    std::span<const std::string> overrides, std::string_view overrides_from) {
  return config_from(
      [&](const config::Vocabulary& vocabulary, config::Sources& sources) {
        config::read_text(text, source, vocabulary, sources);
      },
      overrides, overrides_from);
}

std::string to_toml(const Config& config) {
  const Draft draft = config::draft_of(config);
  std::string text, section;
  for (const config::Key& key : config::keys()) {
    const std::size_t dot = key.name.rfind('.');
    if (const std::string own = key.name.substr(0, dot); own != section) {
      text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", own);
      section = own;
    }
    text += fmt::format("{} = {}\n", key.name.substr(dot + 1), config::toml_of(key.get(draft)));
  }
  return text;
}

std::optional<KeyDifference> first_difference(const Config& config, const std::string& toml,
                                              const std::filesystem::path& source) {
  const toml::table table = config::parse_toml(toml, source);
  const Draft draft = config::draft_of(config);
  for (const config::Key& key : config::keys()) {
    if (key.name.starts_with("output."))
      continue;
    const toml::node* const node = table.at_path(key.name).node();
    const std::string other = node ? config::toml_of(config::value_of(*node)) : "";
    if (const std::string value = config::toml_of(key.get(draft)); value != other)
      return KeyDifference{key.name, value, other};
  }
  return std::nullopt;
}

std::vector<ConfigKey> config_keys() {
  const Draft defaults = config::draft_of(Config{});
  std::vector<ConfigKey> result;
  for (const config::Key& key : config::keys())
    result.push_back({key.name, key.allowed, key.summary, config::toml_of(key.get(defaults))});
  return result;
}

}  // namespace ltc
