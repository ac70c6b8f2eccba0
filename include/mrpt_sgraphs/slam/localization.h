// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/semantics/relocation.h"
#include "mrpt_sgraphs/slam/back_end_config.h"

namespace mrpt_sgraphs {

class GraphSlam;

/// What is known of the robot's place.
struct LocalizationStatus {
  bool localized = false;
  std::string problem;       ///< Why not, or why the last keyframe did not help; empty if all is well.
  double inlier_ratio = 0.0; ///< Of the last keyframe that was registered to the map.
  double rms_m = 0.0;        ///< Of its points' distances.
  double way_since_fit_m = 0.0;  ///< Since a keyframe has fitted the map.
  int relocations = 0;       ///< How often the place was found, by search or by someone's guess.
};

/// Follows a robot in a saved map that stays as it is: the back end in place of GraphSlam.
///
/// Lost, it builds a graph of what it sees and looks for it in the map (see Relocator) with every
/// keyframe. Localized, each keyframe is registered to the map around it and corrects T_map_odom as a
/// Kalman filter does, so that the place is smooth and outlives what the map does not know. When
/// nothing has fitted for some metres it says that it is lost, and looks again.
///
/// One thread owns it. Its memory does not grow: of what was seen it keeps the last keyframes only.
class Localization {
 public:
  /// @param map  With clouds where they are kept; not null. It is never changed.
  Localization(GraphSnapshotConstPtr map, const BackEndConfig& config);
  ~Localization();

  const GraphSnapshotConstPtr& map() const { return map_; }

  /// @throws std::invalid_argument for a keyframe without a cloud, not newer than the last one, or
  ///         with a covariance that is not positive definite.
  const LocalizationStatus& addKeyframe(const Keyframe& keyframe);

  /// Someone says where the robot is, as with rviz's initialpose: right within a metre and half a
  /// radian. Tried at the newest keyframe, or at the first that comes; if it does not fit there, all
  /// stays as it was.
  /// @return Whether it fitted, or is kept for the first keyframe.
  bool setInitialPose(const Pose& T_map_base);

  const LocalizationStatus& status() const { return status_; }

  /// T_map_base is T_map_odom * T_odom_base of any scan since the newest keyframe.
  /// @return Nothing while lost.
  std::optional<Pose> T_map_odom() const;
  /// Of T_map_base at the newest keyframe, right perturbation `[t; theta]`.
  const Matrix6& covariance() const { return covariance_; }

 private:
  struct Surroundings;

  void requireUsable(const Keyframe& keyframe) const;
  void follow(const Keyframe& keyframe);
  void correct(const Keyframe& keyframe, const RegistrationResult& fit);
  void search(const Keyframe& keyframe);
  bool guess(const Pose& T_map_base);
  void localizeAt(const Pose& T_map_base, const Matrix6& information);
  void becomeLost(const std::string& problem);
  void addToSession(const Keyframe& keyframe);
  const VoxelMap& surroundings(const Eigen::Vector3d& place_map);
  std::string misfitOf(const RegistrationResult& fit) const;

  GraphSnapshotConstPtr map_;
  BackEndConfig config_;
  Relocator relocator_;
  LocalizationStatus status_;
  Pose T_map_odom_ = Pose::Identity();
  Matrix6 covariance_ = Matrix6::Identity();
  std::optional<Pose> T_map_base_pointed_at_;  ///< Before the first keyframe.
  std::deque<Keyframe> recent_;                ///< The newest last.
  std::unique_ptr<GraphSlam> session_;         ///< While lost.
  std::unique_ptr<Surroundings> surroundings_;
};

}  // namespace mrpt_sgraphs
