// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// The kinds of config keys: number, flag, choice of names, file name.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/draft.h"
#include "config/value.h"
#include "core/enum_names.h"
#include "core/range.h"

namespace ltc::config {

using ltc::above, ltc::below, ltc::Range;

// A key of the files that Settings are read from.
template <typename Settings>
struct KeyOf {
  std::string name;     // dotted: "fit.sgd.steps"
  std::string allowed;  // completes "expected …"
  std::string summary;
  std::function<bool(Settings&, const Value&)>
      set;  // false, and no change, if the value is not allowed
  std::function<Value(const Settings&)> get;
};
using Key = KeyOf<Draft>;

// `member` is a function from Settings& to a pointer to the member that the key sets; the member's
// type is the type that the file must have.

template <typename Pointer, typename Lambda, typename Settings>
Settings settings_of_call(Pointer (Lambda::*)(Settings&) const);
template <typename Member>
using SettingsType = decltype(settings_of_call(&Member::operator()));
template <typename Member>
using MemberType = std::remove_pointer_t<std::invoke_result_t<Member, SettingsType<Member>&>>;
template <typename Member>
using KeyFor = KeyOf<SettingsType<Member>>;

template <typename T, typename Member, typename Settings>
T get_member(Member member, const Settings& settings) {
  // Read only: `member` takes Settings& to serve both ways.
  return *member(const_cast<Settings&>(settings));
}

// A number: floating-point members take whole numbers too, integers also those in the form 1e6.
template <typename Member>
KeyFor<Member> key(std::string name, Member member, Range range, std::string summary) {
  using T = MemberType<Member>;
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
  constexpr bool whole = std::is_integral_v<T>;
  return {std::move(name),
          fmt::format("a {} in {}", whole ? "whole number" : "number", range.text()),
          std::move(summary),
          [=](SettingsType<Member>& settings, const Value& value) {
            const auto* integer = std::get_if<std::int64_t>(&value);
            const auto* real = std::get_if<double>(&value);
            if (!integer && (!real || (whole && *real != std::trunc(*real))))
              return false;
            if (!range.contains(integer ? static_cast<double>(*integer) : *real))
              return false;
            *member(settings) = integer ? static_cast<T>(*integer) : static_cast<T>(*real);
            return true;
          },
          [=](const SettingsType<Member>& settings) -> Value {
            using Stored = std::conditional_t<whole, std::int64_t, double>;
            return static_cast<Stored>(get_member<T>(member, settings));
          }};
}

// true or false.
template <typename Member>
requires std::is_same_v < MemberType<Member>,
bool > KeyFor<Member> key(std::string name, Member member, std::string summary) {
  return {std::move(name), "true or false", std::move(summary),
          [=](SettingsType<Member>& settings, const Value& value) {
            if (!std::holds_alternative<bool>(value))
              return false;
            *member(settings) = std::get<bool>(value);
            return true;
          },
          [=](const SettingsType<Member>& settings) -> Value {
            return get_member<bool>(member, settings);
          }};
}

template <typename T>
using Choices = std::vector<std::pair<std::string_view, T>>;

// One of several names.
template <typename Member>
KeyFor<Member> key(std::string name, Member member, Choices<MemberType<Member>> choices,
                   std::string summary) {
  using T = MemberType<Member>;
  std::string allowed;
  for (const auto& [choice, meaning] : choices) {
    const bool last = choice == choices.back().first;
    allowed += (allowed.empty() ? "" : last ? " or " : ", ") + quoted(choice);
  }
  return {std::move(name), allowed, std::move(summary),
          [=](SettingsType<Member>& settings, const Value& value) {
            const auto* text = std::get_if<std::string>(&value);
            for (const auto& [choice, meaning] : choices)
              if (text && *text == choice) {
                *member(settings) = meaning;
                return true;
              }
            return false;
          },
          [=](const SettingsType<Member>& settings) -> Value {
            for (const auto& [choice, meaning] : choices)
              if (meaning == get_member<T>(member, settings))
                return std::string(choice);
            return {};
          }};
}

// One of the names of an enum.
template <typename Member>
requires Named<MemberType<Member>> KeyFor<Member> key(std::string name, Member member,
                                                      std::string summary) {
  Choices<MemberType<Member>> choices;
  for (const auto& [value, choice] : enum_names(MemberType<Member>()).pairs)
    choices.emplace_back(choice, value);
  return key(std::move(name), member, std::move(choices), std::move(summary));
}

// A name for files that is good on every system: no folders, nothing hidden.
Key file_name_key(std::string name, std::string* (*member)(Draft&), std::string summary);

}  // namespace ltc::config
