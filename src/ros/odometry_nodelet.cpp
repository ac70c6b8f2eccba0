// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "cloud_trace.h"
#include "diagnostics.h"
#include "motion_inputs.h"
#include "mrpt_sgraphs/frontend/odometry.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "pipeline_nodelet.h"
#include "scan_gate.h"
#include "stamp_order.h"

namespace mrpt_sgraphs {

/// Where each scan was taken, and the scan as if it had been taken at once; how, Odometry knows.
///
/// Subscribes  points_filtered  (Cloud, zero-copy)           base frame
///             imu, odom_in     see MotionInputs
/// Publishes   odom             (nav_msgs/Odometry)          frames/odom to the cloud's frame
///             scan_odometry    (mrpt_sgraphs/ScanOdometry)  the same in full, the cloud's stamp
///             points_deskewed  (Cloud, zero-copy)           stamp and frame of the cloud
///             tf               frames/odom -> the cloud's frame
/// Parameters  odometry/*       OdometryConfig
///             frames/odom      FramesConfig
///             inputs/*         InputsConfig
class OdometryNodelet final : public PipelineNodelet {
 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;

  void start() override {
    odometry_.emplace(section<OdometryConfig>("odometry"));
    odom_frame_ = frameName(section<FramesConfig>("frames").odom);

    ros::NodeHandle& nh = getNodeHandle();
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    odom_pub_ = nh.advertise<nav_msgs::Odometry>("odom", kQueueSize);
    scan_pub_ = nh.advertise<ScanOdometry>("scan_odometry", kQueueSize);
    cloud_pub_ = nh.advertise<Cloud>("points_deskewed", kQueueSize);
    inputs_ = std::make_unique<MotionInputs>(
        nh, section<InputsConfig>("inputs"),
        [this](const ImuSample& sample) {
          odometry_->addImu(sample);
          gate_.imuReached(sample.stamp_s);
          placeReadyScans();
        },
        [this](const OdomSample& sample) {
          odometry_->addOdom(sample);
          gate_.odomReached(sample.stamp_s);
          placeReadyScans();
        });
    timer_ = nh.createSteadyTimer(ros::WallDuration(0.1), [this](const ros::SteadyTimerEvent&) {
      gate_.tick();
      placeReadyScans();
    });
    cloud_sub_ = nh.subscribe("points_filtered", kQueueSize, &OdometryNodelet::onCloud, this);
  }

  void onCloud(const CloudConstPtr& cloud) {
    traceCloud("receive", "points_filtered", cloud.get());
    inputs_->setBase(cloud->header.frame_id);
    if (!isNext(stampOf(*cloud))) return;
    const auto last =
        std::max_element(cloud->begin(), cloud->end(),
                         [](const Point& a, const Point& b) { return a.time < b.time; });
    gate_.push(cloud, stampOf(*cloud), stampOf(*cloud) + (last == cloud->end() ? 0.0 : last->time));
    placeReadyScans();
  }

  bool isNext(double stamp_s) {
    const double last_s = order_.last_s();
    switch (order_.check(stamp_s)) {
      case StampOrder::Verdict::kNext:
        return true;
      case StampOrder::Verdict::kNotNewer:
        if (order_warning_.passes()) {
          NODELET_WARN("The scan of %.6f is not newer than the last one, of %.6f: not used.",
                       stamp_s, last_s);
        }
        return false;
      case StampOrder::Verdict::kStartedAgain:
        NODELET_WARN("Time went back from %.6f to %.6f: odometry starts again.", last_s, stamp_s);
        odometry_->reset();
        gate_.clear();
        last_stamp_s_.reset();
        ++session_;
        return true;
    }
    return false;
  }

  void placeReadyScans() {
    while (const auto cloud = gate_.pop()) {
      const auto result = odometry_->process(**cloud);
      if (result) publish(*result);
    }
  }

  void publish(const OdometryResult& result) {
    std_msgs::Header header = pcl_conversions::fromPCL(result.deskewed->header);
    const std::string base_frame = header.frame_id;
    header.frame_id = odom_frame_;
    const double dt_s = result.stamp_s - last_stamp_s_.value_or(result.stamp_s);
    last_stamp_s_ = result.stamp_s;

    ++placed_;
    if (result.registered) ++registered_;
    if (!result.problem.empty()) {
      problem_ = result.problem;
      if (problem_warning_.passes(problem_)) {
        NODELET_WARN("The pose at %.3f is not to be trusted: %s.", result.stamp_s,
                     problem_.c_str());
      }
    }
    odom_pub_.publish(toOdometry(result, header, base_frame, dt_s));
    broadcaster_.sendTransform(toMsg(result.T_odom_base, header.stamp, odom_frame_, base_frame));
    const auto scan = boost::make_shared<ScanOdometry>(toScanOdometry(result, header, base_frame));
    scan->session = session_;
    scan_pub_.publish(scan);  // as a pointer, or it is serialized and comes after the cloud
    traceCloud("publish", "points_deskewed", result.deskewed.get());
    cloud_pub_.publish(pcl::ros_ptr(result.deskewed));
  }

  void describe(Diagnostics::Status& status) {
    const double share = placed_ == 0 ? 0.0 : static_cast<double>(registered_) / placed_;
    constexpr double kMinShare = 0.9;
    if (placed_ == 0) {
      status.summary(Diagnostics::Status::WARN, "no scan was placed yet");
    } else if (share < kMinShare) {
      status.summary(Diagnostics::Status::WARN, "many scans could not be registered");
    } else {
      status.summary(Diagnostics::Status::OK, "scans are placed");
    }
    status.add("scans placed", placed_);
    status.add("registered share", share);
    status.add("last problem", problem_);
    status.add("started again", session_);
  }

  std::optional<Odometry> odometry_;
  std::string odom_frame_;
  ScanGate<CloudConstPtr> gate_;
  StampOrder order_;
  std::optional<double> last_stamp_s_;
  std::uint32_t session_ = 0;
  int placed_ = 0;
  int registered_ = 0;
  std::string problem_;
  Throttle order_warning_;
  Throttle problem_warning_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Publisher odom_pub_;
  ros::Publisher scan_pub_;
  ros::Publisher cloud_pub_;
  std::unique_ptr<MotionInputs> inputs_;
  ros::SteadyTimer timer_;
  ros::Subscriber cloud_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::OdometryNodelet, nodelet::Nodelet)
