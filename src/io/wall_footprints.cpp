// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "wall_footprints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kLowest_m = 0.5;    ///< Above the ground: over most of what stands along walls,
constexpr double kHighest_m = 1.8;   ///< and under the lintels of doors.
constexpr double kStep_m = 0.1;
constexpr double kSeam_m = 0.05;     ///< Narrower gaps are of the drawing.
constexpr double kUnknown_m = 0.08;  ///< Thickness of what was seen from one side alone.
constexpr double kCorner_m = 0.3;    ///< A face may end so much before the other one at a corner.

/// Along u of a wall's frame [m].
using Interval = std::pair<double, double>;

/// A wall and how its coordinates lie.
struct Face {
  const WallNode* wall;
  PlaneFrame frame;
  std::vector<Interval> seen;  ///< In order, apart from each other.
};

void addCrossings(const Outline2& ring, double v, std::vector<double>* crossings) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d& a = ring[k];
    const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
    if ((a.y() > v) == (b.y() > v)) continue;
    crossings->push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

std::vector<Interval> unionOf(std::vector<Interval> intervals, double max_gap_m) {
  std::sort(intervals.begin(), intervals.end());
  std::vector<Interval> result;
  for (const Interval& interval : intervals) {
    if (result.empty() || interval.first > result.back().second + max_gap_m) {
      result.push_back(interval);
    } else {
      result.back().second = std::max(result.back().second, interval.second);
    }
  }
  return result;
}

/// Where the extent is closed on some of the heights.
std::vector<Interval> seenIntervals(const FlatExtent& extent, const PlaneFrame& frame,
                                    const Plane& ground_map) {
  const double origin_m = ground_map.normal.dot(frame.origin) - ground_map.distance;
  const double rise = ground_map.normal.dot(frame.v);  // near 1, walls stand upright
  std::vector<Interval> intervals;
  for (double height_m = kLowest_m; height_m <= kHighest_m; height_m += kStep_m) {
    std::vector<double> crossings;
    const double v = (height_m - origin_m) / rise;
    addCrossings(extent.outline, v, &crossings);
    for (const Outline2& hole : extent.holes) addCrossings(hole, v, &crossings);
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      intervals.emplace_back(crossings[k], crossings[k + 1]);
    }
  }
  return unionOf(intervals, kSeam_m);
}

std::vector<Face> facesOf(const GraphSnapshot& graph, std::optional<FloorId> floor,
                          const Plane& ground_map) {
  constexpr double kMaxTilt = 0.5;  // of a wall, as a sine: what leans by more has no footprint
  std::vector<Face> faces;
  for (const WallNode& wall : graph.walls) {
    const bool is_upright = std::abs(ground_map.normal.dot(wall.plane_map.normal)) < kMaxTilt;
    if (wall.floor != floor || wall.extent_map.outline.size() < 3 || !is_upright) continue;
    const PlaneFrame frame(wall.plane_map, wall.extent_map.outline.front());
    faces.push_back(
        {&wall, frame, seenIntervals(flattened(wall.extent_map, frame), frame, ground_map)});
  }
  return faces;
}

/// The part of `seen` that lies opposite to what was seen of the other face.
std::vector<Interval> oppositeTo(const Face& face, const Face& other) {
  std::vector<Interval> opposite;
  for (const Interval& interval : other.seen) {
    const auto place = [&](double u) { return face.frame.flat(other.frame.lifted({u, 0.0})).x(); };
    const auto [low, high] = std::minmax({place(interval.first), place(interval.second)});
    for (const Interval& own : face.seen) {
      const Interval both{std::max(own.first, low - kCorner_m),
                          std::min(own.second, high + kCorner_m)};
      if (both.first < both.second) opposite.push_back(both);
    }
  }
  return unionOf(opposite, kSeam_m);
}

/// The wall lies behind the face, against its normal.
WallFootprint footprint(const Face& face, const Interval& interval, double thickness_m,
                        bool measured) {
  const auto corner = [&](double u, double depth_m) -> Eigen::Vector2d {
    return (face.frame.lifted({u, 0.0}) - depth_m * face.frame.normal).head<2>();
  };
  return {face.wall->id,
          {corner(interval.first, 0.0), corner(interval.second, 0.0),
           corner(interval.second, thickness_m), corner(interval.first, thickness_m)},
          measured};
}

}  // namespace

std::vector<WallFootprint> wallFootprints(const GraphSnapshot& graph, std::optional<FloorId> floor,
                                          const Plane& ground_map) {
  const std::vector<Face> faces = facesOf(graph, floor, ground_map);
  std::map<WallId, const Face*> face_of;
  for (const Face& face : faces) face_of[face.wall->id] = &face;

  std::vector<WallFootprint> footprints;
  for (const Face& face : faces) {
    for (const Interval& interval : face.seen) {
      footprints.push_back(footprint(face, interval, kUnknown_m, false));
    }
  }
  const auto add_pair = [&](const Factor& factor) {
    const auto* const pair = dynamic_cast<const WallPairFactor*>(&factor);
    if (pair == nullptr) return;
    const auto a = face_of.find(WallId{pair->node(1).value});
    const auto b = face_of.find(WallId{pair->node(2).value});
    if (a == face_of.end() || b == face_of.end()) return;
    for (const auto& [face, other] : {std::pair{a->second, b->second}, {b->second, a->second}}) {
      for (const Interval& interval : oppositeTo(*face, *other)) {
        footprints.push_back(footprint(*face, interval, pair->thickness_m, true));
      }
    }
  };
  for (const StoredFactor& stored : graph.factors) add_pair(*stored.factor);
  for (const ShelvedFactor& shelved : graph.shelved) add_pair(*shelved.factor);
  return footprints;
}

}  // namespace mrpt_sgraphs
