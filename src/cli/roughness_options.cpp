// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/roughness_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "cli/options.h"
#include "core/error.h"
#include "core/shell_quoted.h"

namespace ltc::cli {
namespace {

double require_in(const char* option, double value, double least) {
  if (!(value >= least && value <= 1))
    throw InputError(fmt::format("{} {}: expected a number in [{}, 1]", option, value, least));
  return value;
}

// The roughness whose alpha is the least.
double least_roughness(double least_alpha) {
  return std::sqrt(least_alpha);
}

// The number behind the prefix; nothing if the text is not that and a number alone.
std::optional<double> number_behind(std::string_view prefix, std::string_view text) {
  double value = 0;
  if (!text.starts_with(prefix))
    return std::nullopt;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + prefix.size(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace

void add_roughness_options(CLI::App& app, RoughnessArguments& arguments,
                           const RoughnessHelp& help) {
  const auto add = [&](const char* name, std::optional<double>& value, const std::string& what,
                       const char* text) {
    allow(app.add_option(name, value, what), any_number())->option_text(text)->group(help.group);
  };
  add("--alpha-x", arguments.alpha_x, help.x, "X");
  add("--alpha-y", arguments.alpha_y, help.y, "Y");
  add("--roughness", arguments.roughness,
      "instead of both, roughness as editors have it: alpha is its square", "R");
  add("--anisotropy", arguments.anisotropy,
      "with --roughness, glTF's anisotropy in [0, 1]: alpha along x is mix(alpha, 1, its square) "
      "[0]",
      "A");
}

LobeRoughness roughness_of(const RoughnessArguments& arguments, double least_alpha) {
  const auto& [alpha_x, alpha_y, roughness, anisotropy] = arguments;
  if ((alpha_x || alpha_y) && (roughness || anisotropy))
    throw InputError(fmt::format(
        "{} and {}: expected --alpha-x and --alpha-y, or --roughness and, if it is not isotropic, "
        "--anisotropy",
        alpha_x ? "--alpha-x" : "--alpha-y", roughness ? "--roughness" : "--anisotropy"));
  if (alpha_x.has_value() != alpha_y.has_value())
    throw InputError(fmt::format("--alpha-{} without --alpha-{}; expected both or neither",
                                 alpha_x ? "x" : "y", alpha_x ? "y" : "x"));
  if (anisotropy && !roughness)
    throw InputError("--anisotropy without --roughness; expected both or --roughness alone");
  if (!roughness)
    return {require_in("--alpha-x", alpha_x.value(), least_alpha),
            require_in("--alpha-y", alpha_y.value(), least_alpha)};
  return lobe_roughness(require_in("--roughness", *roughness, least_roughness(least_alpha)),
                        require_in("--anisotropy", anisotropy.value_or(0), 0));
}

LobeRoughness parse_roughness(const std::string& option, const std::string& text,
                              double least_alpha) {
  const std::size_t comma = text.find(',');
  const std::string_view first = std::string_view(text).substr(0, comma),
                         second = comma == std::string::npos
                                      ? std::string_view()
                                      : std::string_view(text).substr(comma + 1);
  RoughnessArguments arguments;
  arguments.roughness = number_behind("roughness=", first);
  if (arguments.roughness) {
    arguments.anisotropy = comma == std::string::npos ? 0.0 : number_behind("anisotropy=", second);
  } else {
    arguments.alpha_x = number_behind("", first);
    arguments.alpha_y = number_behind("", second);
  }
  const auto in = [](std::optional<double> value, double least) {
    return value && *value >= least && *value <= 1;
  };
  if (!(in(arguments.alpha_x, least_alpha) && in(arguments.alpha_y, least_alpha)) &&
      !(in(arguments.roughness, least_roughness(least_alpha)) && in(arguments.anisotropy, 0)))
    throw InputError(fmt::format(
        "{} {}: expected alpha along x and y in [{}, 1], for example 0.3,0.05, or a roughness in "
        "[{}, 1] and an anisotropy in [0, 1], for example roughness=0.3,anisotropy=0.5",
        option, shell_quoted(text), least_alpha, least_roughness(least_alpha)));
  return roughness_of(arguments, least_alpha);
}

}  // namespace ltc::cli
