// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "../io/temporary_folder.h"
#include "mrpt_sgraphs/io/tum.h"

/// Bags to run the programs on. No header of rosbag here: they do not mix with PCL's everywhere.
namespace mrpt_sgraphs::test {

/// A simulated robot in sim/buildings/small.yaml, with 16 sparse beams at 10 Hz. The bag has
/// /points in `lidar`, /odom of `base_link`, /imu in `imu_link` and /tf_static.
class Recording {
 public:
  explicit Recording(double duration_s);

  std::string bag() const { return folder_.file("run.bag"); }
  Trajectory lidarTruth() const { return readTum(folder_.file("truth/trajectory.tum")); }
  Trajectory baseTruth() const { return readTum(folder_.file("truth/base_trajectory.tum")); }

 private:
  TemporaryFolder folder_;
};

/// Made when first asked for, and then kept.
const Recording& tenSeconds();
const Recording& wholeTour();  ///< It closes loops.

/// A scan and when it was recorded.
struct RecordedScan {
  ros::Time recorded;
  sensor_msgs::PointCloud2 cloud;
};
using RecordedScans = std::vector<RecordedScan>;

/// What the index-th scan becomes: itself, others, none.
using ScanEdit = std::function<RecordedScans(std::size_t index, const RecordedScan& scan)>;

void writeWithScans(const std::string& from, const std::string& to, const ScanEdit& edit);

void writeWithOdometry(const std::string& from, const std::string& to,
                       const std::function<void(nav_msgs::Odometry*)>& edit);

/// The transforms, a message for each, in the place of all that there were.
void writeWithTransforms(const std::string& from, const std::string& to, const std::string& topic,
                         const std::vector<geometry_msgs::TransformStamped>& transforms);

enum class Compression { kNone, kLz4, kBz2 };
void writeCompressed(const std::string& from, const std::string& to, Compression compression);

/// How a message is recorded: as what topic, and how much later than it was.
struct RecordedAs {
  std::string topic;
  double later_s = 0.0;
};

/// What the messages of a topic become: themselves, others, none.
void writeRerecorded(const std::string& from, const std::string& to,
                     const std::function<std::vector<RecordedAs>(const std::string& topic)>& edit);

/// A recording of the front end as it was, and then all of it again as of the next session: as if
/// the nodelets had been given a bag twice.
void writeTwoSessions(const std::string& from, const std::string& to);

/// Everything, and then everything again: recorded later, with the same header stamps.
void writeTwice(const std::string& from, const std::string& to);

/// As `rosbag record --split` does; the second part has no /tf_static.
void writeSplit(const std::string& from, double first_s, const std::string& first,
                const std::string& second);

/// Where in a bag its index begins.
std::size_t indexPosition(const std::string& bag);

}  // namespace mrpt_sgraphs::test
