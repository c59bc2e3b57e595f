// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Processes that make one table together, on one machine or on many. All of them run the same code
// on the same values; what is spread (core/spread.h) each does a part of, and learns of the rest.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ltc {

// How ranks speak to each other: two calls, which all of them make together and in the same order,
// each from the thread that joined them. Whoever calls waits for the others.
class Ranks {
 public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0;  // of this process, in [0, size())
  virtual int size() const = 0;
  // Of all ranks, those on this one's machine, itself among them; and the processors that it has
  // there for itself, at least one.
  virtual int size_here() const = 0;
  virtual int processors() const = 0;

  // What every rank says, in their order.
  using Word = std::array<std::uint64_t, 4>;
  virtual std::vector<Word> exchange(const Word& own) = 0;

  // `bytes` become those of rank `from`; as many on all ranks.
  virtual void broadcast(std::span<std::byte> bytes, int from) = 0;
};

// Whether this process speaks for all: prints, asks, writes files.
inline bool is_first(const Ranks* ranks) {
  return !ranks || ranks->rank() == 0;
}

// The bytes of a value that holds all it is: numbers, matrices of fixed size, structs of these.
template <typename Value>
std::span<std::byte> bytes_of(Value& value) {
  static_assert(std::is_trivially_destructible_v<Value> && !std::is_pointer_v<Value>);
  return {reinterpret_cast<std::byte*>(&value), sizeof(Value)};
}

// The same appended to a text, and taken from it; how many they are.
template <typename Value>
void append_bytes(Value& value, std::string& text) {
  for (const std::byte byte : bytes_of(value))
    text += static_cast<char>(byte);
}
template <typename Value>
std::size_t take_bytes(const std::string& text, std::size_t at, Value& value) {
  const std::span<std::byte> bytes = bytes_of(value);
  std::ranges::transform(std::span(text).subspan(at, bytes.size()), bytes.begin(),
                         [](char c) { return static_cast<std::byte>(c); });
  return bytes.size();
}

// How far a rank is in work that is spread.
struct RankState {
  std::size_t done = 0;        // pieces since the last meeting
  double seconds_a_piece = 0;  // about
};

// Amid work: what every rank says. `work` tells one piece of work from another. Throws Interrupted
// where a rank is at its end (for whatever reason, which agree_on_end tells), CheckFailure where
// ranks are at different work.
std::vector<RankState> meet(Ranks& ranks, std::uint64_t work, const RankState& own);

// The first rank's text, on all. Throws as meet; without ranks nothing happens.
void share_from_first(Ranks* ranks, std::string& text);

// Throws InputError, naming `what`, unless all have the same text. Throws as meet.
void require_same(Ranks* ranks, std::string_view what, const std::string& text);

// How a process ends: its exit code, and a message where that is not 0. `interrupted` is the code
// of one that was asked to.
struct RankEnd {
  int exit_code = 0;
  std::string message;
};

// The end of all of them, which each calls once, last, whether its work was done or failed; those
// still at work learn of it at their next meeting. Where the first rank has done its work, that is
// the end of all; otherwise the failure of the lowest rank, one that was asked to stop the last.
RankEnd agree_on_end(Ranks& ranks, const RankEnd& own, int interrupted);

}  // namespace ltc
