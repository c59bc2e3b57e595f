// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"

namespace ltc::picture {
namespace {

// Slack for ticks that rounding puts just outside an end, in units of the scale's length.
constexpr double slack = 1e-9;

std::string superscript(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += digits[digit - '0'];
  return text;
}

// A hyphen is too short for a minus sign.
std::string with_minus_sign(const std::string& text) {
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string format_number(double value) {
  value += 0.0;  // no negative zero
  const double magnitude = std::abs(value);
  if (value == 0 || (magnitude >= 0.999e-3 && magnitude < 99999.5))
    return with_minus_sign(fmt::format("{:.6g}", value));
  int exponent = static_cast<int>(std::floor(std::log10(magnitude) + 1e-12));
  const std::string mantissa = fmt::format("{:.4g}", value * std::pow(10, -exponent));
  const std::string power = "10" + superscript(exponent);
  if (mantissa == "1" || mantissa == "-1")
    return (value < 0 ? "−" : "") + power;
  return with_minus_sign(mantissa) + "·" + power;
}

std::string format_duration(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr Unit units[] = {{86400, "day"}, {3600, "h"},  {60, "min"},
                            {1, "s"},       {1e-3, "ms"}, {1e-6, "µs"}};
  for (const Unit& unit : units)
    if (std::abs(seconds) >= unit.seconds * (1 - slack)) {
      const std::string count = format_number(seconds / unit.seconds);
      return count + " " + unit.name + (unit.seconds == 86400 && count != "1" ? "s" : "");
    }
  return format_number(seconds) + " s";
}

// The smallest of 1, 2, 5 times a power of ten that is not below `least`.
double round_step(double least) {
  const double decade = std::pow(10, std::floor(std::log10(least) + slack));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= least * (1 - slack))
      return factor * decade;
  return 10 * decade;
}

std::vector<double> linear_values(double first, double last, std::size_t at_most) {
  double step = round_step((last - first) / static_cast<double>(at_most));
  const double edge = slack * (last - first);
  std::vector<double> values;
  do {
    values.clear();
    const double begin = std::ceil((first - edge) / step), end = std::floor((last + edge) / step);
    // The reciprocal of a step below one is whole, and dividing by it is exact where 3 * 0.1 is
    // not.
    for (double i = begin; i <= end; ++i)
      values.push_back(step < 1 ? i / std::round(1 / step) : i * step);
    step = round_step(1.5 * step);
  } while (values.size() > at_most);
  return values;
}

struct Decades {
  int begin, end;  // exponents, both included
};

// The powers of ten that touch [first, last].
Decades decades_around(double first, double last) {
  return {static_cast<int>(std::floor(std::log10(first) + slack)),
          static_cast<int>(std::ceil(std::log10(last) - slack))};
}

// Those of `multiples` times powers of ten that lie in [first, last].
std::vector<double> decade_values(double first, double last, std::span<const double> multiples) {
  const Decades decades = decades_around(first, last);
  std::vector<double> values;
  for (int exponent = decades.begin; exponent <= decades.end; ++exponent)
    for (const double multiple : multiples) {
      const double value = multiple * std::pow(10, exponent);
      if (value >= first * (1 - slack) && value <= last * (1 + slack))
        values.push_back(value);
    }
  return values;
}

constexpr double one_two_five[] = {1, 2, 5};
constexpr double one_three[] = {1, 3};
constexpr double one[] = {1};
constexpr double one_to_nine[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};

std::vector<double> every(std::vector<double> values, std::size_t stride) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); i += stride)
    kept.push_back(values[i]);
  return kept;
}

std::vector<double> logarithmic_values(double first, double last, std::size_t at_most) {
  if (decade_values(first, last, one_two_five).size() < 3)
    return linear_values(first, last, at_most);
  for (const std::span<const double> multiples :
       {std::span<const double>(one_two_five), std::span<const double>(one_three)}) {
    const std::vector<double> values = decade_values(first, last, multiples);
    if (values.size() <= at_most)
      return values;
  }
  const std::vector<double> values = decade_values(first, last, one);
  return every(values, (values.size() + at_most - 1) / at_most);
}

// Round numbers of seconds, minutes, hours and days in three densities, the finest that fits.
std::vector<double> duration_values(double first, double last, std::size_t at_most) {
  constexpr double fine[] = {1,    2,    5,    10,    20,    60,    120,    300,   600,
                             1200, 3600, 7200, 18000, 36000, 86400, 172800, 432000};
  constexpr double medium[] = {1, 10, 60, 600, 3600, 36000, 86400};
  constexpr double coarse[] = {1, 60, 3600, 86400};
  const auto in_range = [&](std::span<const double> below_a_day,
                            std::span<const double> multiples) {
    std::vector<double> values = decade_values(first, std::min(last, 0.99), multiples);
    for (const double value : below_a_day)
      if (value >= first * (1 - slack) && value <= last * (1 + slack))
        values.push_back(value);
    if (last > 864000 * (1 - slack))
      for (const double days : decade_values(std::max(first / 86400, 10.0), last / 86400, one))
        values.push_back(86400 * days);
    return values;
  };
  for (const auto& [seconds, multiples] :
       {std::pair<std::span<const double>, std::span<const double>>{fine, one_two_five},
        {medium, one},
        {coarse, one}}) {
    const std::vector<double> values = in_range(seconds, multiples);
    if (values.size() <= at_most)
      return values.size() < 2 ? linear_values(first, last, at_most) : values;
  }
  const std::vector<double> values = in_range(coarse, one);
  return every(values, (values.size() + at_most - 1) / at_most);
}

std::vector<double> symmetric_values(double bound, double linear_within, std::size_t at_most) {
  std::vector<double> positive = decade_values(linear_within, bound, one);
  if (positive.empty())
    return linear_values(-bound, bound, at_most);
  const std::size_t each_side = std::max<std::size_t>(1, (at_most - 1) / 2);
  // From the outermost inwards, since the ends are what a reader looks for.
  std::reverse(positive.begin(), positive.end());
  positive = every(positive, (positive.size() + each_side - 1) / each_side);
  std::vector<double> values;
  for (const double value : positive)
    values.push_back(-value);
  values.push_back(0);
  values.insert(values.end(), positive.rbegin(), positive.rend());
  return values;
}

void add_minor_ticks(std::vector<Tick>& ticks, double first, double last) {
  // Beyond the larger ratio they are a grey haze; below the smaller the labelled ones stand
  // densely.
  if (last / first < 4 || last / first > 1e7)
    return;
  for (const double value : decade_values(first, last, one_to_nine))
    if (std::none_of(ticks.begin(), ticks.end(), [&](const Tick& tick) {
          return std::abs(tick.value - value) <= slack * value;
        }))
      ticks.push_back({value, ""});
  std::sort(ticks.begin(), ticks.end(),
            [](const Tick& a, const Tick& b) { return a.value < b.value; });
}

}  // namespace

std::string format_value(double value, TickFormat format) {
  switch (format) {
    case TickFormat::percent:
      return format_number(100 * value) + " %";
    case TickFormat::duration:
      return format_duration(value);
    case TickFormat::number:
      break;
  }
  return format_number(value);
}

Scale::Scale(ScaleKind kind, double first, double last, double linear_within)
    : kind_(kind), first_(first), last_(last), linear_within_(linear_within) {
  if (!(std::isfinite(first) && std::isfinite(last) && first < last))
    throw InputError(
        fmt::format("scale from {} to {}: the ends must be finite and ascend", first, last));
}

Scale Scale::linear(double first, double last) {
  return {ScaleKind::linear, first, last, 0};
}

Scale Scale::logarithmic(double first, double last) {
  if (!(first > 0))
    throw InputError(fmt::format("logarithmic scale from {}: it must start above 0", first));
  return {ScaleKind::logarithmic, first, last, 0};
}

Scale Scale::symmetric_logarithmic(double bound, double linear_within) {
  if (!(linear_within > 0 && std::isfinite(linear_within)))
    throw InputError(
        fmt::format("symmetric scale, linear within {}: it must be above 0", linear_within));
  return {ScaleKind::symmetric_logarithmic, -bound, bound, linear_within};
}

Scale Scale::around(std::span<const double> values, ScaleKind kind, double margin) {
  const bool logarithmic = kind == ScaleKind::logarithmic;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const double value : values)
    if (std::isfinite(value) && (value > 0 || !logarithmic)) {
      first = std::min(first, value);
      last = std::max(last, value);
    }
  if (first > last)
    return logarithmic ? Scale::logarithmic(0.1, 10) : linear(0, 1);
  if (logarithmic) {
    const double factor = first == last ? 2 : std::pow(last / first, margin);
    return Scale::logarithmic(first / factor, last * factor);
  }
  const double spare =
      first == last ? std::max(0.5 * std::abs(first), 1e-12) : margin * (last - first);
  return linear(first - spare, last + spare);
}

double Scale::warp(double value) const {
  if (kind_ == ScaleKind::logarithmic)
    return value > 0 || std::isnan(value) ? std::log(value)
                                          : -std::numeric_limits<double>::infinity();
  return kind_ == ScaleKind::linear ? value : std::asinh(value / linear_within_);
}

double Scale::position(double value) const {
  return (warp(value) - warp(first_)) / (warp(last_) - warp(first_));
}

double Scale::value(double position) const {
  const double warped = warp(first_) + position * (warp(last_) - warp(first_));
  if (kind_ == ScaleKind::logarithmic)
    return std::exp(warped);
  return kind_ == ScaleKind::linear ? warped : linear_within_ * std::sinh(warped);
}

std::vector<Tick> Scale::ticks(TickFormat format, std::size_t at_most) const {
  at_most = std::max<std::size_t>(at_most, 2);
  // Percentages are round where hundred times the value is, which 1-2-5 steps give already.
  std::vector<double> values;
  if (kind_ == ScaleKind::linear)
    values = linear_values(first_, last_, at_most);
  else if (kind_ == ScaleKind::symmetric_logarithmic)
    values = symmetric_values(last_, linear_within_, at_most);
  else if (format == TickFormat::duration)
    values = duration_values(first_, last_, at_most);
  else
    values = logarithmic_values(first_, last_, at_most);

  std::vector<Tick> ticks;
  for (const double value : values)
    ticks.push_back({value, format_value(value, format)});
  if (kind_ == ScaleKind::logarithmic && format != TickFormat::duration)
    add_minor_ticks(ticks, first_, last_);
  return ticks;
}

}  // namespace ltc::picture
