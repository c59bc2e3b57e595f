// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Labels: near their points where there is room, never over each other.
#include "picture/label_placement.h"

#include <gtest/gtest.h>

#include <random>

namespace ltc::picture {
namespace {

constexpr Box page{0, 0, 1000, 800};
constexpr double clearance = 12;

TEST(Crosses, SeesSegmentsInsideThroughAndPast) {
  const Box box{10, 10, 20, 10};
  EXPECT_TRUE(crosses({{0, 15}, {50, 15}}, box));
  EXPECT_TRUE(crosses({{12, 12}, {14, 14}}, box));
  EXPECT_TRUE(crosses({{5, 12}, {15, 25}}, box));
  EXPECT_FALSE(crosses({{0, 15}, {9, 15}}, box));
  EXPECT_FALSE(crosses({{0, 5}, {50, 5}}, box));
  EXPECT_FALSE(crosses({{5, 18}, {12, 25}}, box));  // past the corner
}

TEST(PlaceLabels, PutsALoneLabelToTheRight) {
  const LabelRequest request{{500, 400}, 80, 20};
  const auto places = place_labels(std::array{request}, clearance, page, {}, {});
  ASSERT_TRUE(places[0]);
  EXPECT_DOUBLE_EQ(places[0]->box.left, 512);
  EXPECT_DOUBLE_EQ(places[0]->box.center().y, 400);
  EXPECT_FALSE(places[0]->leader_end);
}

TEST(PlaceLabels, TurnsAwayFromTheEdgeFromMarkersAndFromLines) {
  const LabelRequest at_edge{{990, 400}, 80, 20};
  EXPECT_LT(place_labels(std::array{at_edge}, clearance, page, {}, {})[0]->box.right(), 1000);

  const LabelRequest request{{500, 400}, 80, 20};
  const Box marker{520, 390, 20, 20};
  EXPECT_FALSE(
      place_labels(std::array{request}, clearance, page, std::array{marker}, {})[0]->box.overlaps(
          marker));

  const Segment line{{500, 400}, {700, 400}};
  EXPECT_FALSE(crosses(
      line, place_labels(std::array{request}, clearance, page, {}, std::array{line})[0]->box));
}

TEST(PlaceLabels, NeverOverlapsInACrowd) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(420, 580), y(330, 470);
  std::vector<LabelRequest> requests;
  std::vector<Box> markers;
  for (int i = 0; i < 40; ++i) {
    requests.push_back({{x(random), y(random)}, 90, 22});
    const Point at = requests.back().anchor;
    markers.push_back({at.x - 6, at.y - 6, 12, 12});
  }
  const auto places = place_labels(requests, clearance, page, markers, {});
  std::size_t placed = 0, with_leader = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i])
      continue;
    ++placed;
    with_leader += places[i]->leader_end.has_value();
    EXPECT_TRUE(page.contains(places[i]->box));
    for (const Box& marker : markers)
      EXPECT_FALSE(places[i]->box.overlaps(marker));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(places[j] && places[i]->box.overlaps(places[j]->box)) << i << " " << j;
  }
  EXPECT_EQ(placed, 40u);
  EXPECT_GT(with_leader, 0u);
}

TEST(PlaceLabels, LeavesOutWhatHasNoRoom) {
  const LabelRequest request{{50, 50}, 80, 20};
  const auto places = place_labels(std::array{request, request, request, request}, clearance,
                                   {0, 0, 100, 80}, {}, {});
  std::size_t placed = 0;
  for (const auto& place : places)
    placed += place.has_value();
  EXPECT_GE(placed, 1u);
  EXPECT_LT(placed, 4u);
  EXPECT_FALSE(place_labels(std::array{LabelRequest{{50, 50}, 200, 20}}, clearance, {0, 0, 100, 80},
                            {}, {})[0]);
}

}  // namespace
}  // namespace ltc::picture
