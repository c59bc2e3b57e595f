// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "core/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/error.h"

namespace ltc {
namespace {

// The first number of every word: where a rank is.
enum At : std::uint64_t { at_work, at_end };

std::vector<Ranks::Word> meet_at_work(Ranks& ranks, std::uint64_t work, std::uint64_t a,
                                      std::uint64_t b) {
  const std::vector<Ranks::Word> all = ranks.exchange({at_work, work, a, b});
  if (std::ranges::any_of(all, [](const Ranks::Word& word) { return word[0] == at_end; }))
    throw Interrupted();
  return all;
}

// The first rank that says another number than rank 0; 0 where none does.
std::size_t first_other(const std::vector<Ranks::Word>& all, std::size_t number) {
  const auto other = std::ranges::find_if(
      all, [&](const Ranks::Word& word) { return word[number] != all[0][number]; });
  return other == all.end() ? 0 : static_cast<std::size_t>(other - all.begin());
}

std::uint64_t hash_of(std::string_view text) {
  // FNV-1a, the same on every machine.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::span<std::byte> bytes_of_text(std::string& text) {
  return std::as_writable_bytes(std::span(text));
}

// No rank may leave before the others have it: they would wait.
void share(Ranks& ranks, std::size_t size, int from, std::string& text) noexcept {
  text.resize(size);
  if (size > 0)
    ranks.broadcast(bytes_of_text(text), from);
}

// Whose end is that of all.
std::size_t deciding_rank(const std::vector<Ranks::Word>& all, std::uint64_t interrupted) {
  if (all[0][1] == 0)
    return 0;
  const auto find = [&](auto&& is) {
    return static_cast<std::size_t>(std::ranges::find_if(all, is) - all.begin());
  };
  const std::size_t failed =
      find([&](const Ranks::Word& word) { return word[1] != 0 && word[1] != interrupted; });
  return failed < all.size() ? failed : 0;
}

}  // namespace

std::vector<RankState> meet(Ranks& ranks, std::uint64_t work, const RankState& own) {
  const std::vector<Ranks::Word> all =
      meet_at_work(ranks, work, own.done, std::bit_cast<std::uint64_t>(own.seconds_a_piece));
  if (const std::size_t other = first_other(all, 1))
    throw CheckFailure(fmt::format("ranks are at different work: rank {} has {} pieces, rank 0 {}",
                                   other, all[other][1], all[0][1]));
  std::vector<RankState> states;
  for (const Ranks::Word& word : all)
    states.push_back({word[2], std::bit_cast<double>(word[3])});
  return states;
}

void share_from_first(Ranks* ranks, std::string& text) {
  if (!ranks)
    return;
  const std::size_t size = meet(*ranks, 0, {text.size(), 0}).front().done;
  share(*ranks, size, 0, text);
}

void require_same(Ranks* ranks, std::string_view what, const std::string& text) {
  if (!ranks)
    return;
  if (const std::size_t other = first_other(meet_at_work(*ranks, 0, hash_of(text), 0), 2))
    throw InputError(
        fmt::format("{}: rank {} has another than rank 0; expected the same", what, other));
}

RankEnd agree_on_end(Ranks& ranks, const RankEnd& own, int interrupted) {
  std::vector<Ranks::Word> all;
  do {
    all =
        ranks.exchange({at_end, static_cast<std::uint64_t>(own.exit_code), own.message.size(), 0});
  } while (std::ranges::any_of(all, [](const Ranks::Word& word) { return word[0] != at_end; }));
  const std::size_t deciding = deciding_rank(all, static_cast<std::uint64_t>(interrupted));
  RankEnd end = own;
  end.exit_code = static_cast<int>(all[deciding][1]);
  share(ranks, all[deciding][2], static_cast<int>(deciding), end.message);
  return end;
}

}  // namespace ltc
