// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "bench/frontier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/report.h"
#include "core/error.h"
#include "fit/fit_table.h"
#include "judge/held_out.h"
#include "support/refusal.h"

namespace ltc {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FrontierTask small_task(std::string_view settings, std::size_t entries) {
  FrontierTask task;
  task.grid = Grid::paper(4);
  task.settings = select_settings(bench_settings(1), settings);
  task.entries = strided(fitted_entries(task.grid), entries);
  task.judge.samples = 1024;
  task.judge.directions = 16;
  return task;
}

// A run with made-up numbers: entry i took (i + 1) seconds and has the given loss.
FrontierRun made_up(const std::vector<std::vector<double>>& losses,
                    const std::vector<double>& reference) {
  FrontierRun run;
  for (const std::vector<double>& of_setting : losses) {
    run.measurements.emplace_back();
    for (std::size_t i = 0; i < of_setting.size(); ++i)
      run.measurements.back().push_back(
          {static_cast<double>((i + 1) * (i + 1)), of_setting[i], 3, true});
  }
  run.reference_loss = reference;
  return run;
}

// ---- Which entries ----

TEST(Frontier, FitsWhatSymmetryLeaves) {
  const Grid grid = Grid::paper(4);
  const std::vector<std::size_t> entries = fitted_entries(grid);
  const auto entries_are_fitted = fit_table(grid,
                                            [] {
                                              FitSettings least;
                                              GaussNewtonSettings& few = least.gauss_newton;
                                              few.coarse_samples = few.samples =
                                                  few.target_samples = 64;
                                              few.coarse_directions = few.directions = 4;
                                              few.coarse_steps = few.neighbour_sweeps = 0;
                                              few.steps = few.starts = 1;
                                              return least;
                                            }(),
                                            plan_by_symmetry(grid), {1});
  std::size_t count = 0;
  for (std::size_t flat = 0; flat < grid.size(); ++flat) {
    const bool fitted = entries_are_fitted[flat].status != Status::copied;
    count += fitted;
    EXPECT_EQ(std::binary_search(entries.begin(), entries.end(), flat), fitted) << flat;
  }
  EXPECT_EQ(entries.size(), count);
}

TEST(Frontier, StridesEvenlyAndWithoutRepeats) {
  std::vector<std::size_t> all(100);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = 10 * i;
  EXPECT_EQ(strided(all, 4), (std::vector<std::size_t>{120, 370, 620, 870}));
  EXPECT_EQ(strided(all, 1), (std::vector<std::size_t>{500}));
  EXPECT_EQ(strided(all, 100), all);
  EXPECT_EQ(strided(all, 1000), all);
  EXPECT_TRUE(strided(all, 0).empty());
  for (std::size_t count = 1; count < 100; ++count) {
    const std::vector<std::size_t> chosen = strided(all, count);
    ASSERT_EQ(chosen.size(), count);
    EXPECT_EQ(std::adjacent_find(chosen.begin(), chosen.end(), std::greater_equal<>()),
              chosen.end());
  }
}

// ---- Statistics of numbers made up ----

TEST(Frontier, SummarizesTimesAndRatios) {
  const FrontierTask task = small_task("default,gn-256x16", 4);
  const FrontierRun run = made_up({{1, 2, 3, 4}, {1.1, 2.4, 3.9, nan}}, {1, 2, 3, 4});
  const std::vector<SettingSummary> summaries = summarize(task, run);
  ASSERT_EQ(summaries.size(), 2u);
  EXPECT_DOUBLE_EQ(summaries[0].seconds.p50, 4);  // of 1, 4, 9, 16
  EXPECT_DOUBLE_EQ(summaries[0].seconds.mean, 7.5);
  EXPECT_DOUBLE_EQ(summaries[0].table_seconds,
                   7.5 * static_cast<double>(fitted_entries(task.grid).size()));
  EXPECT_DOUBLE_EQ(summaries[0].ratios.mean, 1);
  EXPECT_EQ(summaries[0].failures, 0u);
  EXPECT_DOUBLE_EQ(summaries[1].ratios.mean, (1.1 + 1.2 + 1.3) / 3);
  EXPECT_DOUBLE_EQ(summaries[1].ratios.largest, 1.3);
  EXPECT_EQ(summaries[1].judged, 4u);
  EXPECT_EQ(summaries[1].failures, 1u);
}

TEST(Frontier, TheWorstEntryIsOneOfTheTable) {
  const FrontierTask task = small_task("default", 3);
  const std::vector<SettingSummary> summaries = summarize(task, made_up({{1, 5, 2}}, {1, 1, 1}));
  EXPECT_EQ(summaries[0].ratios.largest_index, task.entries[1]);
}

TEST(Frontier, TellsMirrorsFromTheRest) {
  const FrontierTask task = small_task("default", 1000);
  std::vector<double> losses, ones(task.entries.size(), 1);
  std::size_t mirrors = 0;
  for (const std::size_t flat : task.entries) {
    const bool mirror = task.grid.node(flat).alpha == 0;
    mirrors += mirror;
    losses.push_back(mirror ? 50 : 1.5);
  }
  ASSERT_GT(mirrors, 0u);
  const SettingSummary summary = summarize(task, made_up({losses}, ones))[0];
  EXPECT_DOUBLE_EQ(summary.rough_ratios.mean, 1.5);
  EXPECT_EQ(summary.rough_ratios.count + mirrors, summary.ratios.count);
  EXPECT_GT(summary.ratios.mean, 1.5);
}

// ---- Measurements ----

TEST(Frontier, JudgesWhatTheTableWouldHold) {
  const FrontierTask task = small_task("default,default-sweep", 5);
  const FrontierRun run = measure_frontier(task);
  HeldOutJudge judge(task.judge.samples, task.judge.directions, task.judge.seed);
  for (std::size_t i = 0; i < task.settings.size(); ++i) {
    const std::vector<FittedEntry> table =
        fit_table(task.grid, task.settings[i].fit, plan_by_symmetry(task.grid), {1});
    for (std::size_t place = 0; place < task.entries.size(); ++place) {
      const std::size_t flat = task.entries[place];
      judge.set_lobe(task.grid.lobe(flat));
      // fit_table also rounds isotropic lobes seen from above; nothing else may differ.
      EXPECT_NEAR(run.measurements[i][place].loss, judge.loss(table[flat].matrix),
                  1e-3 * run.measurements[i][place].loss)
          << task.settings[i].name << ' ' << flat;
      EXPECT_GT(run.measurements[i][place].seconds, 0);
      EXPECT_TRUE(run.measurements[i][place].judged);
    }
  }
}

TEST(Frontier, TheReferenceIsTheBestOfAllOrTheTable) {
  FrontierTask task = small_task("gn-256x16,default", 4);
  const FrontierRun best = measure_frontier(task);
  for (std::size_t place = 0; place < task.entries.size(); ++place)
    EXPECT_EQ(best.reference_loss[place],
              std::min(best.measurements[0][place].loss, best.measurements[1][place].loss));
  Table cosines = Table::empty(task.grid, Storage::matrix);
  for (std::size_t flat = 0; flat < task.grid.size(); ++flat)
    cosines.set_stored(flat, Eigen::Matrix3d::Identity());
  task.reference = &cosines;
  const FrontierRun against = measure_frontier(task);
  HeldOutJudge judge(task.judge.samples, task.judge.directions, task.judge.seed);
  judge.set_lobe(task.grid.lobe(task.entries[2]));
  EXPECT_EQ(against.reference_loss[2], judge.loss(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(against.measurements[1][2].loss, best.measurements[1][2].loss);
}

TEST(Frontier, ExtrapolatesTheDescentAndLetsItsErrorBeStoodInFor) {
  FrontierTask task = small_task("sgd-published", 3);
  task.settings[0].fit.sgd.samples = 64;
  task.settings[0].fit.sgd.directions = 4;
  const FrontierRun timed = measure_frontier(task);
  const SettingSummary alone = summarize(task, timed)[0];
  EXPECT_EQ(alone.error_source, ErrorSource::none);
  EXPECT_EQ(alone.judged, 0u);
  EXPECT_EQ(alone.ratios.count, 0u);
  EXPECT_TRUE(alone.extrapolated);
  EXPECT_EQ(timed.measurements[0][0].steps, 10000);

  Table cosines = Table::empty(task.grid, Storage::matrix);
  for (std::size_t flat = 0; flat < task.grid.size(); ++flat)
    cosines.set_stored(flat, Eigen::Matrix3d::Identity());
  task.published = &cosines;
  const SettingSummary published = summarize(task, measure_frontier(task))[0];
  EXPECT_EQ(published.error_source, ErrorSource::published_table);
  EXPECT_EQ(published.judged, 3u);

  task.published = nullptr;
  task.whole_fits = 1;
  task.settings[0].fit.sgd.steps = 20;
  const FrontierRun run = measure_frontier(task);
  const SettingSummary whole = summarize(task, run)[0];
  EXPECT_EQ(whole.error_source, ErrorSource::whole_fits);
  EXPECT_EQ(whole.judged, 1u);
  EXPECT_FALSE(run.measurements[0][0].judged);
  EXPECT_TRUE(run.measurements[0][1].judged);
  EXPECT_EQ(run.measurements[0][1].steps, 20);
}

TEST(Frontier, TablesOfAnotherGridAreRefused) {
  FrontierTask task = small_task("default", 1);
  const Table other = Table::empty(Grid::paper(3), Storage::matrix);
  task.reference = &other;
  test::expect_one_line(test::message_of<InputError>([&] { measure_frontier(task); }),
                        {"4x4x4x4", "3x3x3x3"});
  task.reference = nullptr;
  task.published = &other;
  test::expect_one_line(test::message_of<InputError>([&] { measure_frontier(task); }),
                        {"4x4x4x4", "3x3x3x3"});
}

// ---- Reports ----

FrontierReport made_up_report() {
  FrontierReport report;
  report.task = small_task("gn-256x16,default,sgd-published,l3-nelder-mead", 2);
  report.run = made_up({{1.2, 1.2}, {1, 1.02}, {nan, nan}, {nan, 3}}, {1, 1});
  for (EntryMeasurement& measurement : report.run.measurements[2])
    measurement.judged = false;
  report.summaries = summarize(report.task, report.run);
  return report;
}

TEST(FrontierReport, JsonHoldsTheNumbersAndNullWhereThereAreNone) {
  const auto json = nlohmann::json::parse(frontier_json(made_up_report()));
  EXPECT_EQ(json["entries"], 2);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["grid"], (std::vector<int>{4, 4, 4, 4}));
  ASSERT_EQ(json["settings"].size(), 4u);
  const auto& first = json["settings"][0];
  EXPECT_EQ(first["name"], "gn-256x16");
  EXPECT_DOUBLE_EQ(first["milliseconds_mean"], 2500);
  EXPECT_DOUBLE_EQ(first["ratio_mean"], 1.2);
  const auto& published = json["settings"][2];
  EXPECT_TRUE(published["ratio_mean"].is_null());
  EXPECT_TRUE(published["time_extrapolated"]);
  EXPECT_EQ(json["settings"][3]["failures"], 1);
}

TEST(FrontierReport, CsvHasALineForEveryFit) {
  const std::string text = frontier_csv(made_up_report());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 4 * 2);
  EXPECT_TRUE(text.starts_with("setting,alpha,lambda,theta,phi,"));
  for (std::size_t line = 0; line < text.size(); line = text.find('\n', line) + 1)
    EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(line),
                         text.begin() + static_cast<std::ptrdiff_t>(text.find('\n', line)), ','),
              8);
}

TEST(FrontierReport, TheChartHasAPointForEveryKnownError) {
  const picture::Chart chart = frontier_chart(made_up_report());
  std::vector<std::string> labels;
  for (const picture::Series& series : chart.series)
    for (const picture::ChartPoint& point : series.points)
      if (!point.label.empty()) {
        labels.push_back(point.label);
        EXPECT_GT(point.y, 0);
        EXPECT_GT(point.x, 0);
      }
  EXPECT_EQ(labels, (std::vector<std::string>{"256 × 16", "default", "L3, first-order start"}));
  EXPECT_GT(picture::render(chart, 800, 600).png_bytes().size(), 1000u);
  EXPECT_EQ(chart.words.lines_below.back(),
            "Not shown, as nothing is known of its error: SGD, published");
  EXPECT_TRUE(chart.guides.empty());
}

// Where the best setting at each entry is what errors are over, that setting has none; against a
// table it may have less.
TEST(FrontierReport, TheChartShowsWhatIsAsGoodAsTheBestKnown) {
  FrontierReport report;
  report.task = small_task("gn-256x16,default,gn-4096x64", 2);
  report.run = made_up({{1.2, 1.2}, {1, 1}, {0.99, 0.99}}, {1, 1});
  report.summaries = summarize(report.task, report.run);
  const picture::Chart chart = frontier_chart(report);
  ASSERT_EQ(chart.guides.size(), 1u);
  const double none = chart.guides[0].value;
  EXPECT_GT(none, 0);
  const picture::Series& series = chart.series.at(1);
  ASSERT_EQ(series.points.size(), 3u);
  EXPECT_NEAR(series.points[0].y, 0.2, 1e-12);
  EXPECT_LT(none, 0.2);
  EXPECT_EQ(series.points[1].y, none);
  EXPECT_EQ(series.points[2].y, none);
  EXPECT_EQ(series.points[2].label, "4096 × 64");
  const picture::Canvas canvas(800, 600);
  const picture::ChartLayout layout =
      picture::lay_out(chart, canvas, canvas.area().inset(chart.font_size));
  EXPECT_EQ(layout.labels.size(), 3u);
}

// Where one lies on the other, both are seen.
TEST(FrontierReport, VariantsDoNotHideTheDefault) {
  FrontierReport report;
  report.task = small_task("gn-256x16,default,default-2-starts", 2);
  report.run = made_up({{1.3, 1.3}, {1.1, 1.1}, {1.1, 1.1}}, {1, 1});
  report.summaries = summarize(report.task, report.run);
  report.summaries[2].table_seconds = report.summaries[1].table_seconds;
  const picture::Chart chart = frontier_chart(report);
  const picture::Canvas canvas = picture::render(chart, 800, 600);
  const picture::ChartLayout layout =
      picture::lay_out(chart, canvas, canvas.area().inset(chart.font_size));
  const picture::ChartPoint& both = chart.series.at(2).points.at(0);
  EXPECT_EQ(both.y, chart.series.at(1).points.at(1).y);
  const picture::Point at = layout.at(both.x, both.y);
  EXPECT_EQ(canvas.pixel(static_cast<int>(at.x), static_cast<int>(at.y)), chart.series[1].color);
  bool triangle = false;
  for (int row = -20; row <= 20; ++row)
    triangle |=
        canvas.pixel(static_cast<int>(at.x), static_cast<int>(at.y) + row) == chart.series[2].color;
  EXPECT_TRUE(triangle);
}

}  // namespace
}  // namespace ltc
