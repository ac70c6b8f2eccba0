// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>
#include <sensor_msgs/PointCloud2.h>

#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "cloud_trace.h"
#include "diagnostics.h"
#include "mrpt_sgraphs/frontend/prefilter.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "pipeline_nodelet.h"
#include "ros_config.h"
#include "static_transforms.h"
#include "topic_watchdog.h"

namespace mrpt_sgraphs {

/// Driver's clouds in, clouds of believable points out; what is believable, Prefilter knows.
///
/// Subscribes  points           (sensor_msgs/PointCloud2)  frame of the sensor
/// Publishes   points_filtered  (Cloud, zero-copy)         base frame, stamp kept
/// Parameters  prefilter/*      PrefilterConfig
///             frames/base      FramesConfig; the place of the sensor on it comes from tf
class PrefilterNodelet final : public PipelineNodelet {
 private:
  void start() override {
    refuseMisspeltSections(getNodeHandle());
    prefilter_.emplace(section<PrefilterConfig>("prefilter"));
    base_frame_ = frameName(section<FramesConfig>("frames").base);

    ros::NodeHandle& nh = getNodeHandle();
    watchdog_ = std::make_unique<TopicWatchdog>(nh, nh.resolveName("points"),
                                                ros::message_traits::datatype<Input>());
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    cloud_pub_ = nh.advertise<Cloud>("points_filtered", kQueueSize);
    cloud_sub_ = nh.subscribe("points", kQueueSize, &PrefilterNodelet::onCloud, this,
                              ros::TransportHints().tcpNoDelay());
  }

  void onCloud(const sensor_msgs::PointCloud2ConstPtr& msg) {
    ++received_;
    watchdog_->arrived(msg->header.stamp);
    const std::string sensor = frameName(msg->header.frame_id);
    if (sensor.empty()) return refuse(*msg, "its frame_id is empty");
    const std::string& base = base_frame_.empty() ? sensor : base_frame_;
    const auto T_base_sensor = transforms_.find(base, sensor);
    if (!T_base_sensor) return;

    const PrefilterResult result = prefilter_->filter(viewOf(*msg), *T_base_sensor, base);
    if (!result.cloud) return refuse(*msg, result.problem);
    if (!result.remark.empty() && remark_warning_.passes(result.remark)) {
      NODELET_WARN("%s: %s", topic().c_str(), result.remark.c_str());
    }
    ++passed_;
    last_size_ = result.cloud->size();
    traceCloud("publish", "points_filtered", result.cloud.get());
    cloud_pub_.publish(pcl::ros_ptr(result.cloud));
  }

  void refuse(const sensor_msgs::PointCloud2& msg, const std::string& problem) {
    if (!refuse_warning_.passes(problem)) return;
    NODELET_WARN("%s: the cloud of %.3f in '%s' (%u x %u points) is not used: %s", topic().c_str(),
                 msg.header.stamp.toSec(), msg.header.frame_id.c_str(), msg.width, msg.height,
                 problem.c_str());
  }

  /// Since the last time it was asked for, about a second ago.
  void describe(Diagnostics::Status& status) {
    const char* const summary = received_ == 0 ? "no cloud arrives"
                                : passed_ == 0 ? "no cloud can be used"
                                               : "clouds arrive";
    status.summary(passed_ == 0 ? Diagnostics::Status::WARN : Diagnostics::Status::OK, summary);
    status.add("topic", topic());
    status.add("clouds received a second", received_);
    status.add("clouds passed on a second", passed_);
    status.add("points of the last cloud", last_size_);
    received_ = 0;
    passed_ = 0;
  }

  std::string topic() { return getNodeHandle().resolveName("points"); }

  using Input = sensor_msgs::PointCloud2;

  std::optional<Prefilter> prefilter_;
  std::string base_frame_;
  StaticTransforms transforms_;
  Throttle refuse_warning_;
  Throttle remark_warning_{60.0};
  int received_ = 0;
  int passed_ = 0;
  std::size_t last_size_ = 0;
  std::unique_ptr<TopicWatchdog> watchdog_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Publisher cloud_pub_;
  ros::Subscriber cloud_sub_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::PrefilterNodelet, nodelet::Nodelet)
