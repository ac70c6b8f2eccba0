// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/floor_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "walls_of_floors.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

double heightOver(const Plane& ground_map, const Eigen::Vector3d& point_map) {
  return ground_map.normal.dot(point_map) - ground_map.distance;
}

/// Finds the levels of one graph, by their places in it.
class Detection {
 public:
  Detection(const GraphSnapshot& graph, const FloorDetectorConfig& config);

  FloorDetection result();

 private:
  std::size_t levelOf(FloorId id) const;
  bool isOneLevel(std::size_t a, std::size_t b) const;
  Eigen::Vector3d whereNearest(std::size_t a, std::size_t b) const;
  void findSame();
  void findHeights();
  double off_m(std::size_t keyframe, std::size_t level) const;
  std::size_t standsOn(std::size_t keyframe, std::size_t before, std::size_t after) const;
  void standOnFloors();
  void climb();
  void takeOff(std::size_t keyframe, int step, std::size_t level);
  void connect(std::size_t from, std::size_t to, std::size_t begin, std::size_t end);
  bool isNear(const std::vector<std::size_t>& way, std::size_t begin, std::size_t end) const;

  const GraphSnapshot& graph_;
  const FloorDetectorConfig& config_;
  std::vector<std::size_t> same_;           ///< By level: the oldest that it is one with; itself.
  std::vector<std::size_t> levels_;         ///< By keyframe, as the graph has it; kNone.
  std::vector<std::size_t> on_;             ///< By keyframe: the level that it stands on; kNone.
  std::vector<double> standing_heights_m_;  ///< By level: of the base above it, usually.
  std::vector<std::vector<std::size_t>> ways_;  ///< By connection: the keyframes on it.
  FloorDetection detection_;
};

Detection::Detection(const GraphSnapshot& graph, const FloorDetectorConfig& config)
    : graph_(graph), config_(config) {
  detection_.stamp_s = graph.stamp_s;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    levels_.push_back(keyframe.floor ? levelOf(*keyframe.floor) : kNone);
  }
}

std::size_t Detection::levelOf(FloorId id) const {
  for (std::size_t k = 0; k < graph_.floors.size(); ++k) {
    if (graph_.floors[k].id == id) return k;
  }
  return kNone;
}

/// Of the keyframes of two levels: half-way between the two that are nearest to each other in plan.
Eigen::Vector3d Detection::whereNearest(std::size_t a, std::size_t b) const {
  // of very many, some are as good
  constexpr std::size_t kEnough = 1000;
  const std::size_t stride = levels_.size() / kEnough + 1;
  Eigen::Vector3d best = 0.5 * (graph_.floors[a].centre_map + graph_.floors[b].centre_map);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < levels_.size(); i += stride) {
    if (levels_[i] != a) continue;
    const Eigen::Vector3d one = graph_.keyframes[i].T_map_base.translation();
    for (std::size_t j = 0; j < levels_.size(); j += stride) {
      if (levels_[j] != b) continue;
      const Eigen::Vector3d other = graph_.keyframes[j].T_map_base.translation();
      const double apart = (one - other).head<2>().squaredNorm();
      if (apart >= least) continue;
      least = apart;
      best = 0.5 * (one + other);
    }
  }
  return best;
}

/// A gate that does not grow with drift: wings that differ by a step stay two, however long the way
/// between them, and what a drift has torn apart waits for the loop that brings it together.
bool Detection::isOneLevel(std::size_t a, std::size_t b) const {
  const Plane& one = graph_.floors[a].ground_map;
  const Plane& other = graph_.floors[b].ground_map;
  if (one.normal.dot(other.normal) < std::cos(config_.same_angle_rad)) return false;
  const auto apart_m = [&](const Eigen::Vector3d& point_map) {
    return std::abs(heightOver(one, point_map) - heightOver(other, point_map));
  };
  constexpr double kFar_m = 1.0;  // tells most apart without a search
  if (apart_m(graph_.floors[b].centre_map) > kFar_m) return false;
  return apart_m(whereNearest(a, b)) <= config_.same_height_m;
}

void Detection::findSame() {
  for (std::size_t k = 0; k < graph_.floors.size(); ++k) {
    same_.push_back(k);
    for (std::size_t older = 0; older < k && same_[k] == k; ++older) {
      if (same_[older] == older && isOneLevel(older, k)) same_[k] = older;
    }
    if (same_[k] != k) {
      detection_.same.emplace_back(graph_.floors[same_[k]].id, graph_.floors[k].id);
    }
  }
}

/// The median over the keyframes that the graph has on the level.
void Detection::findHeights() {
  std::vector<std::vector<double>> heights_m(graph_.floors.size());
  std::vector<double> all_m;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    if (levels_[k] == kNone) continue;
    all_m.push_back(heightOver(graph_.floors[levels_[k]].ground_map,
                               graph_.keyframes[k].T_map_base.translation()));
    heights_m[levels_[k]].push_back(all_m.back());
  }
  const auto median = [](std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  for (const std::vector<double>& own_m : heights_m) {
    const std::vector<double>& known_m = own_m.empty() ? all_m : own_m;
    standing_heights_m_.push_back(known_m.empty() ? 0.0 : median(known_m));
  }
}

/// How much higher a keyframe is than it usually is on a level.
double Detection::off_m(std::size_t keyframe, std::size_t level) const {
  return heightOver(graph_.floors[level].ground_map,
                    graph_.keyframes[keyframe].T_map_base.translation()) -
         standing_heights_m_[level];
}

/// One whose level the graph does not know may stand on the one before or the one after it; whoever
/// climbs past the height of another wing is not there.
std::size_t Detection::standsOn(std::size_t keyframe, std::size_t before, std::size_t after) const {
  for (const std::size_t level : {levels_[keyframe], before, after}) {
    if (level == kNone) continue;
    if (std::abs(off_m(keyframe, level)) <= config_.max_off_m) return same_[level];
  }
  return kNone;
}

void Detection::standOnFloors() {
  std::vector<std::size_t> after = levels_;
  for (std::size_t k = after.size(); k-- > 1;) {
    if (after[k - 1] == kNone) after[k - 1] = after[k];
  }
  std::size_t before = kNone;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    on_.push_back(standsOn(k, before, after[k]));
    if (on_[k] != kNone) before = on_[k];
  }
  // who stoops or lifts the sensor without going anywhere stays where they are
  for (std::size_t begin = 0; begin < on_.size();) {
    std::size_t end = begin;
    while (end < on_.size() && on_[end] == kNone) ++end;
    if (end == begin) {
      ++begin;
      continue;
    }
    const std::size_t level = begin > 0 ? on_[begin - 1] : kNone;
    bool stays = level != kNone && end < on_.size() && on_[end] == level;
    for (std::size_t k = begin; stays && k < end; ++k) {
      stays = std::abs(off_m(k, level)) <= 2.0 * config_.max_off_m;
    }
    if (stays) {
      std::fill(on_.begin() + static_cast<std::ptrdiff_t>(begin),
                on_.begin() + static_cast<std::ptrdiff_t>(end), level);
    }
    begin = end;
  }
}

/// From the end of a climb into the level beside it: keyframes that are on their way already.
void Detection::takeOff(std::size_t keyframe, int step, std::size_t level) {
  double climbed_m = off_m(keyframe, level);
  for (;;) {
    if (step < 0 && keyframe == 0) return;
    keyframe = step < 0 ? keyframe - 1 : keyframe + 1;
    if (keyframe >= on_.size() || on_[keyframe] != level) return;
    const double off = off_m(keyframe, level);
    const bool same_side = (off > 0.0) == (climbed_m > 0.0);
    if (!same_side || std::abs(off) <= config_.climb_off_m) return;
    if (std::abs(off) >= std::abs(climbed_m)) return;
    climbed_m = off;
    on_[keyframe] = kNone;
  }
}

void Detection::climb() {
  const std::vector<std::size_t> on = on_;
  for (std::size_t k = 1; k < on.size(); ++k) {
    if (on[k] == on[k - 1]) continue;
    if (on[k] != kNone) takeOff(k - 1, +1, on[k]);
    if (on[k - 1] != kNone) takeOff(k, -1, on[k - 1]);
  }
  std::size_t from = kNone;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < on_.size(); ++k) {
    if (on_[k] == kNone) continue;
    if (from != kNone && on_[k] != from && begin < k) connect(from, on_[k], begin, k);
    from = on_[k];
    begin = k + 1;
  }
}

bool Detection::isNear(const std::vector<std::size_t>& way, std::size_t begin,
                       std::size_t end) const {
  for (const std::size_t known : way) {
    const Eigen::Vector3d place = graph_.keyframes[known].T_map_base.translation();
    for (std::size_t k = begin; k < end; ++k) {
      const Eigen::Vector3d apart = graph_.keyframes[k].T_map_base.translation() - place;
      if (apart.norm() < config_.stairs_apart_m) return true;
    }
  }
  return false;
}

/// The keyframes [begin, end) lead from one level to another: by stairs that are known, or new
/// ones.
void Detection::connect(std::size_t from, std::size_t to, std::size_t begin, std::size_t end) {
  const FloorId a = graph_.floors[from].id;
  const FloorId b = graph_.floors[to].id;
  std::size_t stairs = 0;
  for (; stairs < ways_.size(); ++stairs) {
    const DetectedConnection& known = detection_.connections[stairs];
    const bool joins_them =
        (known.from == a && known.to == b) || (known.from == b && known.to == a);
    if (joins_them && isNear(ways_[stairs], begin, end)) break;
  }
  if (stairs == ways_.size()) {
    ways_.emplace_back();
    detection_.connections.push_back({a, b, {}});
  }
  for (std::size_t k = begin; k < end; ++k) {
    ways_[stairs].push_back(k);
    detection_.connections[stairs].keyframes.push_back(graph_.keyframes[k].id);
  }
}

FloorDetection Detection::result() {
  findSame();
  findHeights();
  standOnFloors();
  climb();
  std::vector<std::size_t> places(graph_.floors.size(), kNone);
  for (std::size_t level = 0; level < graph_.floors.size(); ++level) {
    if (same_[level] != level) continue;
    places[level] = detection_.floors.size();
    detection_.floors.push_back({graph_.floors[level].id, {}, {}});
  }
  LevelPlaces standing;
  for (std::size_t k = 0; k < on_.size(); ++k) {
    if (on_[k] == kNone) continue;
    detection_.floors[places[on_[k]]].keyframes.push_back(graph_.keyframes[k].id);
    standing.push_back({graph_.keyframes[k].T_map_base.translation(),
                        graph_.floors[on_[k]].ground_map, places[on_[k]]});
  }
  for (const WallNode& wall : graph_.walls) {
    const std::size_t known = wall.floor ? levelOf(*wall.floor) : kNone;
    const std::optional<std::size_t> floor =
        known != kNone ? places[same_[known]] : floorOfWall(wall, standing);
    if (floor) detection_.floors[*floor].walls.push_back(wall.id);
  }
  return std::move(detection_);
}

}  // namespace

FloorDetection detectFloors(const GraphSnapshot& graph, const FloorDetectorConfig& config) {
  return Detection(graph, config).result();
}

}  // namespace mrpt_sgraphs
