// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/floor_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "mrpt_sgraphs/geometry/plane_frame.h"
#include "mrpt_sgraphs/io/statistics.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegPerRad = 180.0 / M_PI;
constexpr double kSameFloor_m = 0.3;
constexpr double kOnStorey_m = 0.2;       ///< A gait's bob is less, a step of stairs about that.
constexpr double kSurelyOn_m = 0.1;       ///< No step of stairs is that low.
constexpr std::ptrdiff_t kMinPoses = 10;  ///< On a storey that the robot was on.

std::vector<TrueFloor> upwards(std::vector<TrueFloor> floors) {
  std::sort(floors.begin(), floors.end(), [](const TrueFloor& a, const TrueFloor& b) {
    return std::tie(a.elevation_m, a.id) < std::tie(b.elevation_m, b.id);
  });
  return floors;
}

/// How high the body is above the ground: the height with which most positions stand on a storey,
/// the lowest if there are several.
double bodyHeight_m(const std::vector<TrueFloor>& floors, const Trajectory& trajectory) {
  constexpr double kBin_m = 0.1;
  std::map<int, std::vector<double>> bins;
  for (const StampedPose& pose : trajectory) {
    for (const TrueFloor& floor : floors) {
      const double above_m = pose.T_world_body.translation().z() - floor.elevation_m;
      if (above_m >= 0.0) bins[static_cast<int>(above_m / kBin_m)].push_back(above_m);
    }
  }
  std::vector<double> most;
  for (const auto& [bin, heights_m] : bins) {
    std::vector<double> around = heights_m;  // a body may bob about the edge of a bin
    const auto next = bins.find(bin + 1);
    if (next != bins.end()) around.insert(around.end(), next->second.begin(), next->second.end());
    if (around.size() > most.size()) most = std::move(around);
  }
  return quantile(most, 0.5);
}

/// The storeys with the body's height above them.
class Storeys {
 public:
  Storeys(const TrueBuilding& truth, const Trajectory& trajectory)
      : truth_(truth),
        floors_(upwards(truth.floors)),
        body_height_m_(bodyHeight_m(floors_, trajectory)) {}

  const std::vector<TrueFloor>& floors() const { return floors_; }

  /// How far a position is from one whose body stands on the storey.
  double offset_m(const TrueFloor& floor, const Eigen::Vector3d& position) const {
    return std::abs(position.z() - body_height_m_ - floor.elevation_m);
  }

  bool surelyOnOne(const Eigen::Vector3d& position) const {
    const bool on_one = std::any_of(floors_.begin(), floors_.end(), [&](const TrueFloor& floor) {
      return offset_m(floor, position) <= kSurelyOn_m;
    });
    return on_one && !inStairwell(position);
  }

 private:
  bool inStairwell(const Eigen::Vector3d& position) const {
    return std::any_of(truth_.rooms.begin(), truth_.rooms.end(), [&](const TrueRoom& room) {
      return room.kind == TrueRoom::Kind::kStairwell &&
             contains(flattened(room.extent, PlaneFrame()), position.head<2>());
    });
  }

  const TrueBuilding& truth_;
  std::vector<TrueFloor> floors_;
  double body_height_m_;
};

/// What the trajectory says of a storey.
FloorErrors::Level levelOf(const TrueFloor& floor, const Storeys& storeys,
                           const std::vector<PosePair>& poses, const Pose& T_truth_map) {
  std::vector<double> errors_m;
  for (const PosePair& pose : poses) {
    const Eigen::Vector3d& position = pose.T_truth_body.translation();
    if (storeys.offset_m(floor, position) > kOnStorey_m) continue;
    errors_m.push_back((T_truth_map * pose.T_run_body.translation() - position).z());
  }
  FloorErrors::Level level;
  level.id = floor.id;
  level.elevation_m = floor.elevation_m;
  level.poses = errors_m.size();
  level.z_mean_m = mean(errors_m);
  level.z_rmse_m = rootMeanSquare(errors_m);
  for (double& error_m : errors_m) error_m -= level.z_mean_m;
  level.z_spread_m = rootMeanSquare(errors_m);
  return level;
}

/// A floor of the run in the truth's frame.
struct Ground {
  uint64_t id = 0;
  double height_m = 0.0;  ///< At its centre.
  double tilt_deg = 0.0;
};

std::vector<Ground> groundsOf(const GraphSnapshot& graph, const Pose& T_truth_map) {
  std::vector<Ground> grounds;
  for (const FloorNode& floor : graph.floors) {
    const Plane plane = T_truth_map * floor.ground_map;
    const Eigen::Vector3d foot = PlaneFrame(plane, T_truth_map * floor.centre_map).origin;
    const double tilt_rad = std::atan2(plane.normal.head<2>().norm(), plane.normal.z());
    grounds.push_back({floor.id.value, foot.z(), tilt_rad * kDegPerRad});
  }
  return grounds;
}

/// Storeys and grounds, one to one, the nearest first.
void matchGrounds(const std::vector<Ground>& grounds, FloorErrors* errors) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t l = 0; l < errors->levels.size(); ++l) {
    for (std::size_t g = 0; g < grounds.size(); ++g) {
      const double off_m = std::abs(grounds[g].height_m - errors->levels[l].elevation_m);
      if (off_m <= kSameFloor_m) candidates.emplace_back(off_m, l, g);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> is_right(grounds.size(), false);
  for (const auto& [off_m, l, g] : candidates) {
    FloorErrors::Level& level = errors->levels[l];
    if (level.found || is_right[g]) continue;
    level.found = grounds[g].id;
    level.height_error_m = grounds[g].height_m - level.elevation_m;
    level.tilt_deg = grounds[g].tilt_deg;
    is_right[g] = true;
  }
  for (std::size_t g = 0; g < grounds.size(); ++g) {
    if (!is_right[g]) errors->wrong.push_back(grounds[g].id);
  }
}

double betweenError_m(const std::vector<FloorErrors::Level>& levels) {
  double greatest_m = kNaN;
  const FloorErrors::Level* below = nullptr;
  for (const FloorErrors::Level& level : levels) {
    if (!level.found) continue;
    if (below != nullptr) {
      const double error_m = std::abs(level.height_error_m - below->height_error_m);
      greatest_m = std::fmax(greatest_m, error_m);  // of NaN and a number the number
    }
    below = &level;
  }
  return greatest_m;
}

/// The position nearest in time.
std::optional<Eigen::Vector3d> positionAt(double stamp_s, const Trajectory& by_time,
                                          double max_dt_s) {
  const auto distance_s = [stamp_s](const StampedPose& pose) {
    return std::abs(pose.stamp_s - stamp_s);
  };
  auto nearest =
      std::lower_bound(by_time.begin(), by_time.end(), stamp_s,
                       [](const StampedPose& pose, double stamp) { return pose.stamp_s < stamp; });
  const bool has_before = nearest != by_time.begin();
  if (has_before && (nearest == by_time.end() || distance_s(nearest[-1]) < distance_s(*nearest))) {
    --nearest;
  }
  if (nearest == by_time.end() || distance_s(*nearest) > max_dt_s) return std::nullopt;
  return nearest->T_world_body.translation();
}

bool isRight(const KeyframeNode& keyframe, const Eigen::Vector3d& position, const Storeys& storeys,
             const std::vector<FloorErrors::Level>& levels) {
  if (!keyframe.floor) return !storeys.surelyOnOne(position);
  return std::any_of(levels.begin(), levels.end(), [&](const FloorErrors::Level& level) {
    return level.found == keyframe.floor->value &&
           storeys.offset_m({level.id, level.elevation_m}, position) <= kSameFloor_m;
  });
}

}  // namespace

bool FloorErrors::exact() const {
  return wrong.empty() && std::all_of(levels.begin(), levels.end(),
                                      [](const Level& level) { return level.found.has_value(); });
}

FloorErrors evaluateFloors(const TrueBuilding& truth, const Trajectory& truth_trajectory,
                           const GraphSnapshot& graph, const std::vector<PosePair>& poses,
                           const Pose& T_truth_map, double max_dt_s) {
  Trajectory by_time = truth_trajectory;
  std::stable_sort(by_time.begin(), by_time.end(),
                   [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
  const Storeys storeys(truth, by_time);
  FloorErrors errors;
  for (const TrueFloor& floor : storeys.floors()) {
    const auto there = std::count_if(by_time.begin(), by_time.end(), [&](const auto& pose) {
      return storeys.offset_m(floor, pose.T_world_body.translation()) <= kOnStorey_m;
    });
    if (there < kMinPoses) continue;
    errors.levels.push_back(levelOf(floor, storeys, poses, T_truth_map));
  }
  errors.found = graph.floors.size();
  matchGrounds(groundsOf(graph, T_truth_map), &errors);
  errors.between_error_m = betweenError_m(errors.levels);

  for (const KeyframeNode& keyframe : graph.keyframes) {
    const auto position = positionAt(keyframe.stamp_s, by_time, max_dt_s);
    if (!position) continue;
    ++errors.keyframes;
    if (isRight(keyframe, *position, storeys, errors.levels)) continue;
    errors.wrong_keyframes.push_back(keyframe.id.value);
  }
  return errors;
}

}  // namespace mrpt_sgraphs
