// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "static_transforms.h"

#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

namespace mrpt_sgraphs {

std::optional<Pose> StaticTransforms::find(const std::string& base, const std::string& sensor) {
  if (base == sensor) return Pose::Identity();
  const auto known = known_.find({base, sensor});
  if (known != known_.end()) return known->second;
  try {
    const Pose T_base_sensor(
        tf2::transformToEigen(buffer_.lookupTransform(base, sensor, ros::Time(0))).matrix());
    known_.emplace(std::make_pair(base, sensor), T_base_sensor);
    return T_base_sensor;
  } catch (const tf2::TransformException& error) {
    if (warning_.passes(base + sensor)) {
      ROS_WARN("Waiting for the transform from '%s' to '%s': %s", sensor.c_str(), base.c_str(),
               error.what());
    }
    return std::nullopt;
  }
}

}  // namespace mrpt_sgraphs
