// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// A node of the keyframes layer.
struct KeyframeNode {
  KeyframeId id;
  double stamp_s = 0.0;
  Pose T_map_base = Pose::Identity();
  Pose T_odom_base = Pose::Identity();  ///< What odometry alone said.
  Cloud::ConstPtr cloud;                ///< Base frame.
};

/// A relative pose between two keyframes: T_from_to as measured, with the inverse covariance of its
/// right perturbation, `[t; theta]`.
struct RelativePoseEdge {
  enum class Kind { kOdometry, kLoopClosure };

  KeyframeId from;
  KeyframeId to;
  Pose T_from_to = Pose::Identity();
  Matrix6 information = Matrix6::Identity();  ///< [1/m^2, 1/(m rad), 1/rad^2]
  Kind kind = Kind::kOdometry;
};

/// The graph as it was at one moment; never changes, shared between threads.
struct GraphSnapshot {
  double stamp_s = 0.0;  ///< Of the last keyframe.
  Pose T_map_odom = Pose::Identity();
  std::vector<KeyframeNode> keyframes;  ///< In id order.
  std::vector<RelativePoseEdge> edges;
};

using GraphSnapshotConstPtr = std::shared_ptr<const GraphSnapshot>;

}  // namespace mrpt_sgraphs
