// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "cli/output.h"
#include "core/platform.h"

namespace ltc::cli {
namespace {

constexpr std::chrono::milliseconds bar_interval{100};
// The first line of a stage comes soon: it tells by the pace of the first units whether the rest is
// worth the wait.
constexpr std::chrono::seconds first_line{1}, line_interval{10};

double rate(const StageState& state) {
  return state.seconds > 0 ? static_cast<double>(state.done) / state.seconds : 0;
}

// "512/s, 4 s left"; nothing as long as there is nothing to judge by.
std::string rate_and_rest(const StageState& state, std::string_view separator) {
  if (state.done == 0 || state.seconds <= 0)
    return "";
  const double per_second = rate(state);
  const double left = static_cast<double>(state.total - state.done) / per_second;
  return fmt::format("{0}{1:.{2}f}/s{0}{3} left", separator, per_second, per_second < 10 ? 1 : 0,
                     duration_text(left));
}

// One that knows no bars: it would show the codes that draw them.
bool terminal_is_dumb() {
  const char* const kind = std::getenv("TERM");
  return kind && std::string_view(kind) == "dumb";
}

// What is counted, where the stage's name does not say it.
std::string_view unit_of(std::string_view stage) {
  return stage == "refine" ? " evaluations of queries" : "";
}

double fraction(const StageState& state) {
  return state.total ? static_cast<double>(state.done) / static_cast<double>(state.total) : 0;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 1)
    return fmt::format("{:.2f} s", seconds);
  if (seconds < 99.95)
    return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::min(seconds, 1e15) + 0.5);
  if (whole < 3600)
    return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string bar_text(const StageState& state, std::size_t columns) {
  constexpr std::size_t width = 20;  // with all the rest within 80 columns
  const auto filled = static_cast<std::size_t>(fraction(state) * width);
  std::string bar(filled, '=');
  if (filled < width)
    bar += '>';
  std::string text =
      fmt::format("{:<11} [{:<{}}] {:3.0f} %  {}/{}{}", state.name, bar, width,
                  100 * fraction(state), state.done, state.total, rate_and_rest(state, "  "));
  if (columns > 0 && text.size() >= columns)
    text.resize(columns - 1);  // the last column would make some terminals wrap
  return text;
}

std::string line_text(const StageState& state) {
  return fmt::format("{}: {} of {}{}{}", state.name, state.done, state.total, unit_of(state.name),
                     rate_and_rest(state, ", "));
}

ProgressDisplay::ProgressDisplay()
    : on_terminal_(platform::standard_error_is_terminal() && !terminal_is_dumb()) {}

ProgressDisplay::~ProgressDisplay() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    erase_bar();
  }
  wake_.notify_all();
  if (drawer_.joinable())
    drawer_.join();
}

void ProgressDisplay::begin_stage(std::string_view name, std::size_t total) {
  const std::lock_guard lock(mutex_);
  reset_done();
  stage_ = name;
  total_ = total;
  stage_began_ = Clock::now();
  next_line_ = stage_began_ + first_line;
  if (!on_terminal_)
    tell(fmt::format("{}: {}{} to do\n", stage_, total_, unit_of(stage_)));
  if (!drawer_.joinable())
    drawer_ = std::thread([this] { draw_until_closed(); });
}

void ProgressDisplay::end_stage() {
  const std::lock_guard lock(mutex_);
  erase_bar();
  const double seconds = std::chrono::duration<double>(Clock::now() - stage_began_).count();
  if (!on_terminal_ && !stage_.empty())
    tell(fmt::format("{}: {} {}\n", stage_, stop_requested() ? "stopped after" : "done in",
                     duration_text(seconds)));
  stage_.clear();
}

void ProgressDisplay::draw_until_closed() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, bar_interval, [this] { return closed_; }))
    if (on_terminal_ || Clock::now() >= next_line_) {
      draw();
      next_line_ = Clock::now() + line_interval;
    }
}

void ProgressDisplay::draw() {
  if (stage_.empty())
    return;
  const double seconds = std::chrono::duration<double>(Clock::now() - stage_began_).count();
  const StageState state{stage_, std::min(done(), total_), total_, seconds};
  if (on_terminal_) {
    tell("\r\033[K" + bar_text(state, platform::terminal_columns()));
    bar_visible_ = true;
  } else {
    tell(line_text(state) + "\n");
  }
}

void ProgressDisplay::erase_bar() {
  if (bar_visible_)
    tell("\r\033[K");
  bar_visible_ = false;
}

}  // namespace ltc::cli
