// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The kinds of config keys: number, flag, choice of names, file name.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/draft.h"
#include "config/value.h"

namespace ltc::config {

struct Key {
  std::string name;     // dotted: "fit.sgd.steps"
  std::string allowed;  // completes "expected …"
  std::string summary;
  std::function<bool(Draft&, const Value&)>
      set;  // false, and no change, if the value is not allowed
  std::function<Value(const Draft&)> get;
};

// `member` is a function from Draft& to a pointer to the member that the key sets; the member's
// type is the type that the file must have.

template <typename Member>
using MemberType = std::remove_pointer_t<std::invoke_result_t<Member, Draft&>>;

// The numbers allowed: [least, most], without `least` itself if `above_least`, likewise
// `below_most`.
struct Range {
  double least, most;
  bool above_least = false, below_most = false;

  bool contains(double value) const {  // false for NaN
    return (above_least ? value > least : value >= least) &&
           (below_most ? value < most : value <= most);
  }
  std::string text() const {
    return fmt::format("{}{}, {}{}", above_least ? '(' : '[', least, most, below_most ? ')' : ']');
  }
};
inline constexpr Range above(double least, double most) {
  return {least, most, true, false};
}
inline constexpr Range below(double least, double most) {
  return {least, most, false, true};
}

template <typename T, typename Member>
T get_member(Member member, const Draft& draft) {
  return *member(const_cast<Draft&>(draft));  // read only: `member` takes Draft& to serve both ways
}

// A number: floating-point members take whole numbers too, integers take nothing else.
template <typename Member>
Key key(std::string name, Member member, Range range, std::string summary) {
  using T = MemberType<Member>;
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
  constexpr bool whole = std::is_integral_v<T>;
  return {std::move(name),
          fmt::format("a {} in {}", whole ? "whole number" : "number", range.text()),
          std::move(summary),
          [=](Draft& draft, const Value& value) {
            const auto* integer = std::get_if<std::int64_t>(&value);
            const auto* real = std::get_if<double>(&value);
            if (!integer && (whole || !real))
              return false;
            if (!range.contains(integer ? static_cast<double>(*integer) : *real))
              return false;
            *member(draft) = integer ? static_cast<T>(*integer) : static_cast<T>(*real);
            return true;
          },
          [=](const Draft& draft) -> Value {
            using Stored = std::conditional_t<whole, std::int64_t, double>;
            return static_cast<Stored>(get_member<T>(member, draft));
          }};
}

// true or false.
template <typename Member>
Key key(std::string name, Member member, std::string summary) {
  static_assert(std::is_same_v<MemberType<Member>, bool>);
  return {std::move(name), "true or false", std::move(summary),
          [=](Draft& draft, const Value& value) {
            if (!std::holds_alternative<bool>(value))
              return false;
            *member(draft) = std::get<bool>(value);
            return true;
          },
          [=](const Draft& draft) -> Value { return get_member<bool>(member, draft); }};
}

template <typename T>
using Choices = std::vector<std::pair<std::string_view, T>>;

// One of several names.
template <typename Member>
Key key(std::string name, Member member, Choices<MemberType<Member>> choices, std::string summary) {
  using T = MemberType<Member>;
  std::string allowed;
  for (const auto& [choice, meaning] : choices) {
    const bool last = choice == choices.back().first;
    allowed += (allowed.empty() ? "" : last ? " or " : ", ") + quoted(choice);
  }
  return {std::move(name), allowed, std::move(summary),
          [=](Draft& draft, const Value& value) {
            const auto* text = std::get_if<std::string>(&value);
            for (const auto& [choice, meaning] : choices)
              if (text && *text == choice) {
                *member(draft) = meaning;
                return true;
              }
            return false;
          },
          [=](const Draft& draft) -> Value {
            for (const auto& [choice, meaning] : choices)
              if (meaning == get_member<T>(member, draft))
                return std::string(choice);
            return {};
          }};
}

// A name for files that is good on every system: no folders, nothing hidden.
Key file_name_key(std::string name, std::string* (*member)(Draft&), std::string summary);

}  // namespace ltc::config
