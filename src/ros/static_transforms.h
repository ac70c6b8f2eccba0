// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <optional>
#include <string>

#include "mrpt_sgraphs/geometry/pose.h"
#include "throttle.h"

namespace mrpt_sgraphs {

/// Where the sensors sit on the robot, as tf says. Each transform is asked for until it is known,
/// and then kept: sensors are screwed on, and a bag that starts again may not bring /tf_static
/// again.
class StaticTransforms {
 public:
  /// T_base_sensor; identity only if the names are the same. While tf does not know it nothing, and
  /// a warning from time to time that names both frames.
  std::optional<Pose> find(const std::string& base, const std::string& sensor);

 private:
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
  std::map<std::pair<std::string, std::string>, Pose> known_;
  Throttle warning_;
};

}  // namespace mrpt_sgraphs
