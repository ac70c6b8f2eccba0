// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/PointCloud2.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// What to read from a set of bags.
struct BagRequest {
  std::vector<std::string> files;
  std::string points_topic;
  std::string odom_topic;   ///< Empty: none.
  std::string imu_topic;    ///< Empty: none.
  double start_s = 0.0;     ///< After the first message.
  double duration_s = 0.0;  ///< From there on; 0: all.
};

/// Where the messages go, in the order in which they were recorded.
struct BagHandlers {
  std::function<void(const sensor_msgs::PointCloud2::ConstPtr&)> points;
  std::function<void(const nav_msgs::Odometry::ConstPtr&)> odom;
  std::function<void(const sensor_msgs::Imu::ConstPtr&)> imu;
  std::function<void(double done)> progress;  ///< 0 to 1, after each scan
};

/// Bags opened for reading. rosbag keeps to itself here: its headers do not mix with PCL's
/// everywhere.
class BagSource {
 public:
  /// @throws std::runtime_error for a file that is missing, no bag or cut short, and for a topic
  ///         that is not in any of them or has another type: it names what was found instead.
  explicit BagSource(const BagRequest& request);
  ~BagSource();

  /// Hands over every message that can be read. A damaged chunk takes its own messages with it, not
  /// those after it.
  /// @return What could not be read: file, number and first message. Empty if all could.
  std::string play(const BagHandlers& handlers);

  /// T_parent_child from the bags' /tf_static and, should that not do, the first of each in /tf.
  /// @throws std::runtime_error naming the frames that there are if the two are not connected.
  Pose transform(const std::string& parent, const std::string& child) const;

  /// Of the first cloud that names one.
  std::string pointsFrame() const;

  /// Time that the messages cover.
  double duration() const;

 private:
  struct Bags;
  std::unique_ptr<Bags> bags_;
};

}  // namespace mrpt_sgraphs
