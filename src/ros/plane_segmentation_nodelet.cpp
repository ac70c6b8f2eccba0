// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>

#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>

#include "cloud_trace.h"
#include "diagnostics.h"
#include "mrpt_sgraphs/KeyframeDecision.h"
#include "mrpt_sgraphs/frontend/plane_observer.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "pipeline_nodelet.h"
#include "stamp_matcher.h"

namespace mrpt_sgraphs {

/// The flat surfaces that keyframes see; what is one, PlaneObserver knows.
///
/// Subscribes  scan_odometry      (mrpt_sgraphs/ScanOdometry)      matched with
///             points_deskewed    (Cloud, zero-copy)               and
///             keyframe_decision  (mrpt_sgraphs/KeyframeDecision)  by their stamp
/// Publishes   keyframe_planes    (mrpt_sgraphs/KeyframePlanes)    for each keyframe, its stamp
/// Parameters  plane_segmentation/*  PlaneSegmentationConfig
///
/// A scan waits until it is known whether it is a keyframe. So the scans up to a keyframe are
/// gathered and none after it, as offline, whichever of the three comes first.
class PlaneSegmentationNodelet final : public PipelineNodelet {
 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;
  using Matcher = StampMatcher<ScanOdometryConstPtr, CloudConstPtr, KeyframeDecisionConstPtr>;

  void start() override {
    observer_.emplace(section<PlaneSegmentationConfig>("plane_segmentation"));
    ros::NodeHandle& nh = getNodeHandle();
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    planes_pub_ = nh.advertise<KeyframePlanes>("keyframe_planes", kQueueSize);
    scan_sub_ = nh.subscribe("scan_odometry", kQueueSize, &PlaneSegmentationNodelet::onScan, this);
    cloud_sub_ =
        nh.subscribe("points_deskewed", kQueueSize, &PlaneSegmentationNodelet::onCloud, this);
    decision_sub_ =
        nh.subscribe("keyframe_decision", kQueueSize, &PlaneSegmentationNodelet::onDecision, this);
  }

  void onScan(const ScanOdometryConstPtr& msg) {
    if (!isOfThisSession(msg->session)) return;
    process(matcher_.add<0>(pcl_conversions::toPCL(msg->header.stamp), msg));
  }

  void onCloud(const CloudConstPtr& cloud) {
    traceCloud("receive", "points_deskewed", cloud.get());
    process(matcher_.add<1>(cloud->header.stamp, cloud));
  }

  void onDecision(const KeyframeDecisionConstPtr& msg) {
    if (!isOfThisSession(msg->session)) return;
    process(matcher_.add<2>(pcl_conversions::toPCL(msg->header.stamp), msg));
  }

  /// Of a newer session, nothing of the last one is waited for any more.
  bool isOfThisSession(std::uint32_t session) {
    if (session > session_) {
      session_ = session;
      matcher_.clear();
      observer_->reset();
    }
    return session == session_;
  }

  void process(const std::optional<Matcher::Set>& scan) {
    if (!scan) return;
    const auto& [odometry, cloud, decision] = *scan;
    giveUpBefore(cloud->header.stamp);
    const auto motion = toScanMotion(*odometry);
    if (motion) {
      observer_->addScan(pcl::pcl_ptr(cloud), motion->T_odom_base, odometry->registered != 0);
    }
    if (!decision->is_keyframe) return;
    CpuStopwatch watch;
    const ObservedPlanesConstPtr planes = observer_->take();
    publish(planes, watch.lap(), decision->header, cloud->header.frame_id);
  }

  /// A keyframe whose own scan was lost on the way here: the back end must not wait for its planes.
  void giveUpBefore(std::uint64_t stamp_us) {
    for (const Matcher::Parts& lost : matcher_.takeIncompleteBefore(stamp_us)) {
      const auto& decision = std::get<2>(lost);
      if (!decision || !(*decision)->is_keyframe) continue;
      observer_->reset();
      publish(nullptr, 0.0, (*decision)->header, base_frame_);
    }
  }

  void publish(const ObservedPlanesConstPtr& planes, double segment_ms, std_msgs::Header header,
               const std::string& base_frame) {
    base_frame_ = header.frame_id = base_frame;
    const auto msg = boost::make_shared<KeyframePlanes>(toMsg(planes, header));
    msg->session = session_;
    msg->segment_ms = segment_ms;
    traceCloud("publish", "keyframe_planes", msg.get());
    planes_pub_.publish(msg);  // as a pointer, or it is serialized

    ++keyframes_;
    last_planes_ = msg->planes.size();
    last_ms_ = segment_ms;
  }

  void describe(Diagnostics::Status& status) {
    status.summary(Diagnostics::Status::OK,
                   keyframes_ == 0 ? "no keyframe yet" : "keyframes are segmented");
    status.add("keyframes", keyframes_);
    status.add("planes of the last keyframe", last_planes_);
    status.add("segmentation of the last keyframe, ms", last_ms_);
  }

  std::optional<PlaneObserver> observer_;
  Matcher matcher_;
  std::uint32_t session_ = 0;
  std::string base_frame_;
  int keyframes_ = 0;
  std::size_t last_planes_ = 0;
  double last_ms_ = 0.0;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Publisher planes_pub_;
  ros::Subscriber scan_sub_;
  ros::Subscriber cloud_sub_;
  ros::Subscriber decision_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::PlaneSegmentationNodelet, nodelet::Nodelet)
