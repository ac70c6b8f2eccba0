// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>

#include <boost/make_shared.hpp>
#include <optional>
#include <pluginlib/class_list_macros.hpp>

#include "cloud_trace.h"
#include "mrpt_sgraphs/KeyframeDecision.h"
#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "pipeline_nodelet.h"
#include "stamp_matcher.h"

namespace mrpt_sgraphs {

/// Picks the scans that the graph keeps; which, KeyframeSelector knows.
///
/// Subscribes  scan_odometry    (mrpt_sgraphs/ScanOdometry)     matched with
///             points_deskewed  (Cloud, zero-copy)              by their stamp
/// Publishes   keyframe           (mrpt_sgraphs/KeyframeStamped)   the scan's stamp
///             keyframe_points    (Cloud, zero-copy)               the same stamp, thinned out
///             keyframe_decision  (mrpt_sgraphs/KeyframeDecision)  for every scan, its stamp
/// Parameters  keyframes/*        KeyframeConfig
class KeyframesNodelet final : public PipelineNodelet {
 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;
  using Matcher = StampMatcher<ScanOdometryConstPtr, CloudConstPtr>;

  void start() override {
    selector_.emplace(section<KeyframeConfig>("keyframes"));
    ros::NodeHandle& nh = getNodeHandle();
    keyframe_pub_ = nh.advertise<KeyframeStamped>("keyframe", kQueueSize);
    decision_pub_ = nh.advertise<KeyframeDecision>("keyframe_decision", kQueueSize);
    cloud_pub_ = nh.advertise<Cloud>("keyframe_points", kQueueSize);
    scan_sub_ = nh.subscribe("scan_odometry", kQueueSize, &KeyframesNodelet::onScan, this);
    cloud_sub_ = nh.subscribe("points_deskewed", kQueueSize, &KeyframesNodelet::onCloud, this);
  }

  void onScan(const ScanOdometryConstPtr& msg) {
    if (msg->session != session_) {
      session_ = msg->session;
      selector_->reset();
    }
    process(matcher_.add<0>(pcl_conversions::toPCL(msg->header.stamp), msg));
  }

  void onCloud(const CloudConstPtr& cloud) {
    traceCloud("receive", "points_deskewed", cloud.get());
    process(matcher_.add<1>(cloud->header.stamp, cloud));
  }

  void process(const std::optional<Matcher::Set>& scan) {
    if (!scan) return;
    const ScanOdometry& odometry = *std::get<0>(*scan);
    const auto motion = toScanMotion(odometry);
    if (!motion || odometry.session != session_) return;
    const auto keyframe = selector_->process(*motion, *std::get<1>(*scan));
    const auto decision = boost::make_shared<KeyframeDecision>();
    decision->header = odometry.header;
    decision->session = session_;
    decision->is_keyframe = keyframe.has_value();
    decision_pub_.publish(decision);
    if (keyframe) publish(*keyframe, odometry);
  }

  void publish(const Keyframe& keyframe, const ScanOdometry& odometry) {
    const auto msg = boost::make_shared<KeyframeStamped>(
        toMsg(keyframe, odometry.header, odometry.child_frame_id));
    msg->session = session_;
    keyframe_pub_.publish(msg);  // as a pointer, or it is serialized
    traceCloud("publish", "keyframe_points", keyframe.cloud.get());
    cloud_pub_.publish(pcl::ros_ptr(keyframe.cloud));
  }

  std::optional<KeyframeSelector> selector_;
  Matcher matcher_;
  std::uint32_t session_ = 0;
  ros::Publisher keyframe_pub_;
  ros::Publisher cloud_pub_;
  ros::Publisher decision_pub_;
  ros::Subscriber scan_sub_;
  ros::Subscriber cloud_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::KeyframesNodelet, nodelet::Nodelet)
