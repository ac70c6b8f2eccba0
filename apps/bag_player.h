// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "mrpt_sgraphs/ros/bag_source.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/slam/pipeline.h"
#include "progress_bar.h"
#include "remarks.h"

namespace mrpt_sgraphs {

/// Plays bags into the pipeline. Each scan waits for the next, so that IMU and odometry messages of
/// its own sweep have come.
class BagPlayer {
 public:
  /// @param base_frame  Frame whose trajectory is wanted; empty for that of the clouds.
  /// @throws std::runtime_error if the bags do not say where the LiDAR is in it.
  BagPlayer(const BagRequest& request, const std::string& base_frame, BagSource* source,
            Pipeline* pipeline, Remarks* remarks)
      : request_(request),
        source_(*source),
        pipeline_(*pipeline),
        remarks_(*remarks),
        lidar_frame_(source->pointsFrame()),
        base_frame_(base_frame.empty() ? lidar_frame_ : base_frame) {
    T_base_lidar_[lidar_frame_] = source_.transform(base_frame_, lidar_frame_);
  }

  /// Scans up to and with this stamp are known already.
  void skipTo(double stamp_s) { known_until_s_ = stamp_s; }

  /// All but the last scan: what happened within its sweep may come in another bag, or with a longer
  /// duration.
  /// @return What of the bags could not be read; empty if all could.
  std::string play(ProgressBar* bar) {
    BagHandlers handlers;
    handlers.points = [this](const auto& cloud) {
      takeWaitingScan();
      waiting_ = cloud;
    };
    handlers.odom = [this](const auto& odom) { addOdom(*odom); };
    handlers.imu = [this](const auto& imu) { addImu(*imu); };
    handlers.progress = [bar](double done) { bar->show(done); };
    return source_.play(handlers);
  }

  void takeLastScan() { takeWaitingScan(); }

  std::size_t clouds() const { return clouds_; }

 private:
  void takeWaitingScan() {
    if (waiting_ == nullptr) return;
    const auto cloud = std::exchange(waiting_, nullptr);
    if (cloud->header.stamp.toSec() <= known_until_s_) return;
    ++clouds_;
    const std::string remark = take(*cloud);
    if (!remark.empty()) remarks_.add(request_.points_topic, cloud->header.stamp.toSec(), remark);
  }

  std::string take(const sensor_msgs::PointCloud2& cloud) {
    const std::string& frame = cloud.header.frame_id.empty() ? lidar_frame_ : cloud.header.frame_id;
    const auto T_base_lidar = transformTo(frame);
    if (!T_base_lidar) {
      return "its frame '" + frame + "' is not connected with '" + base_frame_ + "'; left out";
    }
    return pipeline_.addScan(viewOf(cloud), *T_base_lidar, base_frame_);
  }

  std::optional<Pose> transformTo(const std::string& lidar_frame) {
    const auto known = T_base_lidar_.find(lidar_frame);
    if (known != T_base_lidar_.end()) return known->second;
    std::optional<Pose> T_base_lidar;
    try {
      T_base_lidar = source_.transform(base_frame_, lidar_frame);
    } catch (const std::runtime_error&) {
    }
    return T_base_lidar_[lidar_frame] = T_base_lidar;
  }

  void addOdom(const nav_msgs::Odometry& odom) {
    const double stamp_s = odom.header.stamp.toSec();
    const auto T_odom_child = toPose(odom.pose.pose);
    if (!T_odom_child) {
      remarks_.add(request_.odom_topic, stamp_s,
                   "its pose is not finite or its quaternion not of length 1; left out");
      return;
    }
    if (!T_child_base_) {
      // the odometry may be of another frame of the robot than the one whose trajectory is wanted
      const std::string& child = odom.child_frame_id.empty() ? base_frame_ : odom.child_frame_id;
      T_child_base_ = transformOrIdentity(child, base_frame_, request_.odom_topic, stamp_s);
    }
    pipeline_.addOdom({stamp_s, *T_odom_child * *T_child_base_});
  }

  void addImu(const sensor_msgs::Imu& imu) {
    const double stamp_s = imu.header.stamp.toSec();
    const Eigen::Vector3d turning(imu.angular_velocity.x, imu.angular_velocity.y,
                                  imu.angular_velocity.z);
    const Eigen::Vector3d force(imu.linear_acceleration.x, imu.linear_acceleration.y,
                                imu.linear_acceleration.z);
    if (!turning.allFinite() || !force.allFinite()) {
      remarks_.add(request_.imu_topic, stamp_s, "it has numbers that are not finite; left out");
      return;
    }
    if (!R_base_imu_) {
      R_base_imu_ =
          transformOrIdentity(base_frame_, imu.header.frame_id, request_.imu_topic, stamp_s)
              .linear();
    }
    pipeline_.addImu({stamp_s, *R_base_imu_ * turning, *R_base_imu_ * force});
  }

  Pose transformOrIdentity(const std::string& parent, const std::string& child,
                           const std::string& topic, double stamp_s) {
    try {
      return source_.transform(parent, child);
    } catch (const std::runtime_error& e) {
      remarks_.add(topic, stamp_s,
                   std::string(e.what()) + "\n'" + parent + "' and '" + child +
                       "' are taken to be one frame");
      return Pose::Identity();
    }
  }

  const BagRequest& request_;
  BagSource& source_;
  Pipeline& pipeline_;
  Remarks& remarks_;
  std::string lidar_frame_;
  std::string base_frame_;
  std::map<std::string, std::optional<Pose>> T_base_lidar_;  ///< By the LiDAR's frame.
  std::optional<Pose> T_child_base_;
  std::optional<Eigen::Matrix3d> R_base_imu_;
  sensor_msgs::PointCloud2::ConstPtr waiting_;
  double known_until_s_ = -std::numeric_limits<double>::infinity();
  std::size_t clouds_ = 0;
};

}  // namespace mrpt_sgraphs
