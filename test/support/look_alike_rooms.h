// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mrpt_sgraphs/frontend/plane_observer.h"
#include "mrpt_sgraphs/slam/back_end.h"
#include "semantics/keyframes_of_a_walk.h"

/// A map with rooms that look alike from within, and walks through it.
namespace mrpt_sgraphs::test {

/// Two offices of one size with their doors at the same place, on a corridor whose ends cannot be seen
/// from either.
inline const std::string kLookAlikes = R"(name: look_alikes
storeys:
  - name: ground
    elevation_m: 0.0
    height_m: 2.8
    rooms:
      - {name: corridor, kind: corridor, rectangle: [-3.0, 0.0, 14.0, 2.0]}
      - {name: west, rectangle: [0.0, 2.2, 4.5, 6.7]}
      - {name: east, rectangle: [4.7, 2.2, 9.2, 6.7]}
    doors:
      - {at: [1.2, 2.1], width_m: 1.0}
      - {at: [5.9, 2.1], width_m: 1.0}
tour:
  - {room: corridor, at: [[1.0, 1.0]]}
)";

/// Other rooms altogether.
inline const std::string kElsewhere = R"(name: elsewhere
storeys:
  - name: ground
    elevation_m: 0.0
    height_m: 2.8
    rooms:
      - {name: hall, rectangle: [0.0, 0.0, 8.0, 7.0]}
      - {name: store, rectangle: [8.2, 1.0, 11.0, 4.0]}
    doors:
      - {at: [8.1, 2.5], width_m: 1.2}
    pillars: []
tour:
  - {room: hall, at: [[1.0, 1.0]]}
)";

inline sim::Building lookAlikes() { return sim::test::buildingFrom(kLookAlikes); }

/// Of both offices and all of the corridor.
inline std::vector<Eigen::Vector2d> roundOfLookAlikes() {
  return {{-2.0, 1.0}, {1.0, 1.0}, {1.2, 3.0}, {3.0, 4.0}, {2.0, 5.5}, {1.2, 3.0}, {1.2, 1.0}, {5.9, 1.0},
          {5.9, 3.0}, {7.7, 4.0}, {6.7, 5.5}, {5.9, 3.0}, {5.9, 1.0}, {13.0, 1.0}, {6.0, 1.0}};
}
/// In the eastern office, not by the door.
inline std::vector<Eigen::Vector2d> roundOfTheEastOffice() {
  return {{8.4, 5.6}, {8.4, 3.4}, {6.8, 4.4}, {8.2, 5.4}};
}
/// From there into the corridor and along it.
inline std::vector<Eigen::Vector2d> outOfTheEastOffice() {
  return {{8.4, 5.6}, {8.4, 3.4}, {6.8, 4.4}, {5.9, 3.0}, {5.9, 1.0}, {11.0, 1.0}};
}

/// ... and back, into the western one.
inline std::vector<Eigen::Vector2d> fromEastToWest() {
  std::vector<Eigen::Vector2d> way = outOfTheEastOffice();
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(1.2, 1.0), Eigen::Vector2d(1.2, 3.0), Eigen::Vector2d(3.0, 4.5)}) {
    way.push_back(corner);
  }
  return way;
}

/// Keyframes with planes, of a robot that walks along corner points with good odometry.
/// @param T_odom_start  Where the odometry has the first one.
inline std::vector<KeyframeWithTruth> walkWithPlanes(
    const sim::Building& building, const std::vector<Eigen::Vector2d>& corners,
    const Pose& T_odom_start = Pose::Identity()) {
  const ScanStage stage(building, sim::lidarNamed("vlp16_sparse"));
  std::vector<KeyframeWithTruth> keyframes = walk(stage, corners, {});
  PlaneObserver planes{PlaneSegmentationConfig{}};
  for (KeyframeWithTruth& each : keyframes) {
    Keyframe& keyframe = each.keyframe;
    keyframe.T_odom_base = T_odom_start * keyframe.T_odom_base;
    keyframe.cloud = withoutTimes(*keyframe.cloud);  // as deskewed ones are
    planes.addScan(keyframe.cloud, keyframe.T_odom_base, true);
    keyframe.planes = planes.take();
  }
  return keyframes;
}

inline GraphSnapshotConstPtr mapOf(const std::vector<KeyframeWithTruth>& walk) {
  BackEnd back_end{BackEndConfig{}};
  for (const KeyframeWithTruth& each : walk) back_end.addKeyframe(each.keyframe, 0.0);
  back_end.finish();
  return back_end.graph();
}

/// T_frame_building of what the walk was seen from.
inline Pose frameOf(const std::vector<KeyframeWithTruth>& walk) {
  return walk.front().keyframe.T_odom_base * walk.front().T_map_base.inverse();
}

}  // namespace mrpt_sgraphs::test
