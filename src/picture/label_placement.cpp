// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
#include "picture/label_placement.h"

#include <cmath>
#include <limits>

namespace ltc::picture {
namespace {

// The directions tried, with what a reader would rather not have: nothing against the right.
struct Direction {
  double x, y;
  double cost;
};
constexpr double diagonal = 0.7071;
constexpr Direction directions[] = {{1, 0, 0},
                                    {-1, 0, 0.25},
                                    {0, -1, 0.15},
                                    {0, 1, 0.3},
                                    {diagonal, -diagonal, 0.1},
                                    {diagonal, diagonal, 0.2},
                                    {-diagonal, -diagonal, 0.3},
                                    {-diagonal, diagonal, 0.4},
                                    {0.92, -0.38, 0.1},
                                    {0.92, 0.38, 0.15},
                                    {-0.92, -0.38, 0.3},
                                    {-0.92, 0.38, 0.35},
                                    {0.38, -0.92, 0.15},
                                    {0.38, 0.92, 0.3},
                                    {-0.38, -0.92, 0.3},
                                    {-0.38, 0.92, 0.4}};

constexpr int rings = 14;
constexpr double ring_step = 0.6;  // in heights of the label
constexpr int first_ring_with_leader = 1;
constexpr double ring_cost = 0.5;
constexpr double line_cost = 0.9;  // a line runs through the label
constexpr double leader_cost = 2;  // the leader runs through a marker or another label
constexpr int improvement_rounds = 3;

struct Candidate {
  LabelPlace place;
  double cost = std::numeric_limits<double>::infinity();
};

Point nearest_point(const Box& box, Point to) {
  return {std::fmin(std::fmax(to.x, box.left), box.right()),
          std::fmin(std::fmax(to.y, box.top), box.bottom())};
}

class Placer {
 public:
  Placer(std::span<const LabelRequest> requests, double clearance, const Box& bounds,
         std::span<const Box> obstacles, std::span<const Segment> lines)
      : requests_(requests),
        clearance_(clearance),
        bounds_(bounds),
        obstacles_(obstacles),
        lines_(lines),
        places_(requests.size()) {}

  std::vector<std::optional<LabelPlace>> run() {
    // The first round is greedy; the later ones move each label to its best place among the others.
    for (int round = 0; round <= improvement_rounds; ++round)
      for (std::size_t i = 0; i < requests_.size(); ++i)
        place(i);
    return places_;
  }

 private:
  void place(std::size_t i) {
    places_[i].reset();
    Candidate best;
    for (int ring = 0; ring < rings; ++ring)
      for (const Direction& direction : directions) {
        Candidate candidate = at(requests_[i], direction, ring);
        // Rings and directions alone are a lower bound, so most are not looked at closely.
        if (candidate.cost < best.cost && is_free(candidate.place.box)) {
          candidate.cost += clutter(i, candidate.place);
          if (candidate.cost < best.cost)
            best = candidate;
        }
      }
    if (std::isfinite(best.cost))
      places_[i] = best.place;
  }

  Candidate at(const LabelRequest& request, const Direction& direction, int ring) const {
    const double distance = clearance_ + ring * ring_step * request.height;
    const Point center{
        request.anchor.x + direction.x * distance +
            std::copysign(request.width / 2, direction.x) * (direction.x != 0),
        request.anchor.y + direction.y * distance + direction.y * request.height / 2};
    Candidate candidate;
    candidate.cost = ring_cost * ring + direction.cost;
    candidate.place.box = {center.x - request.width / 2, center.y - request.height / 2,
                           request.width, request.height};
    if (ring >= first_ring_with_leader)
      candidate.place.leader_end = nearest_point(candidate.place.box, request.anchor);
    return candidate;
  }

  bool is_free(const Box& box) const {
    if (!bounds_.contains(box))
      return false;
    for (const Box& obstacle : obstacles_)
      if (box.overlaps(obstacle))
        return false;
    for (const std::optional<LabelPlace>& other : places_)
      if (other && box.overlaps(other->box))
        return false;
    return true;
  }

  double clutter(std::size_t i, const LabelPlace& place) const {
    double cost = 0;
    for (const Segment& line : lines_)
      cost += line_cost * crosses(line, place.box);
    if (place.leader_end) {
      const Segment leader{requests_[i].anchor, *place.leader_end};
      for (const Box& obstacle : obstacles_)
        // Its own marker is where the leader starts.
        cost += leader_cost * (!obstacle.contains(leader.from) && crosses(leader, obstacle));
      for (const std::optional<LabelPlace>& other : places_)
        cost += leader_cost * (other && crosses(leader, other->box));
    }
    for (std::size_t j = 0; j < places_.size(); ++j)
      if (places_[j] && places_[j]->leader_end)
        cost += leader_cost * crosses({requests_[j].anchor, *places_[j]->leader_end}, place.box);
    return cost;
  }

  std::span<const LabelRequest> requests_;
  double clearance_;
  Box bounds_;
  std::span<const Box> obstacles_;
  std::span<const Segment> lines_;
  std::vector<std::optional<LabelPlace>> places_;
};

}  // namespace

bool crosses(const Segment& segment, const Box& box) {
  // Liang and Barsky: cut the segment's parameter range [0, 1] at each of the four sides.
  double enter = 0, leave = 1;
  const auto cut = [&](double start, double step, double low, double high) {
    if (step == 0)
      return start > low && start < high;
    const double a = (low - start) / step, b = (high - start) / step;
    enter = std::fmax(enter, std::fmin(a, b));
    leave = std::fmin(leave, std::fmax(a, b));
    return enter < leave;
  };
  return cut(segment.from.x, segment.to.x - segment.from.x, box.left, box.right()) &&
         cut(segment.from.y, segment.to.y - segment.from.y, box.top, box.bottom());
}

std::vector<std::optional<LabelPlace>> place_labels(std::span<const LabelRequest> requests,
                                                    double clearance, const Box& bounds,
                                                    std::span<const Box> obstacles,
                                                    std::span<const Segment> lines) {
  return Placer(requests, clearance, bounds, obstacles, lines).run();
}

}  // namespace ltc::picture
