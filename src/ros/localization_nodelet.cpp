// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>

#include "diagnostics.h"
#include "display_publisher.h"
#include "graph_publisher.h"
#include "initial_pose.h"
#include "job_thread.h"
#include "keyframe_input.h"
#include "known_clouds.h"
#include "map_to_odom.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/slam/graph_state.h"
#include "mrpt_sgraphs/slam/localization.h"
#include "mrpt_sgraphs/slam/slam_config.h"
#include "pipeline_nodelet.h"

namespace mrpt_sgraphs {
namespace {

GraphSnapshotConstPtr savedGraph(const std::string& folder, const SlamConfig& config) {
  GraphSlam slam(config);
  RunLog log;
  readGraphState(StateReader(folder), &slam, &log);
  return slam.snapshot();
}

}  // namespace

/// Follows the robot in a saved map that stays as it is, in place of GraphSlam.
///
/// Subscribes  see KeyframeInput and InitialPose
/// Publishes   pose  (geometry_msgs/PoseWithCovarianceStamped)  frames/map, for every scan, while the
///                   place is known
///             see GraphPublisher, KnownClouds, MapToOdom (while the place is known), DisplayPublisher
/// Parameters  map (private)            a folder that dump or sgraphs_offline has written
///             relocation/*, localization/*, and for what is seen while lost those of GraphSlam
///             frames/map, frames/odom  FramesConfig
///             display/*                DisplayConfig
class LocalizationNodelet final : public PipelineNodelet {
 private:
  void start() override {
    const SlamConfig config = loadSlamConfig(getNodeHandle());
    const auto frames = section<FramesConfig>("frames");
    const auto display = section<DisplayConfig>("display");
    const auto folder = getPrivateNodeHandle().param<std::string>("map", "");
    if (folder.empty()) throw std::invalid_argument("map is not set: the folder of a saved map");
    map_frame_ = frameName(frames.map);
    map_ = savedGraph(folder, config);
    localization_ = std::make_unique<Localization>(map_, config);

    ros::NodeHandle& nh = getNodeHandle();
    publisher_ = std::make_unique<GraphPublisher>(nh, frames);
    known_clouds_ = std::make_unique<KnownClouds>(nh);
    map_to_odom_ = std::make_unique<MapToOdom>(nh, frames);
    pose_pub_ = nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", kQueueSize);
    jobs_ = std::make_unique<JobThread>(
        [this](const std::string& problem) { NODELET_WARN("%s", problem.c_str()); });

    ros::NodeHandle patient_nh(nh);
    patient_nh.setCallbackQueue(&patient_queue_);
    display_ = std::make_unique<DisplayPublisher>(
        patient_nh, GraphView{map_frame_, display.layer_lift_m},
        DisplayPublisher::Source{[this] { return map_; },
                                 [this] { return trajectory(); },
                                 [] { return std::optional<OptimizationSummary>(); }});
    patient_spinner_.start();
    known_clouds_->publish(map_);
    publisher_->publish(map_, 0);
    NODELET_INFO("%zu keyframes, %zu walls and %zu rooms of %s; the robot is looked for.",
                 map_->keyframes.size(), map_->walls.size(), map_->rooms.size(), folder.c_str());

    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    initial_pose_ = std::make_unique<InitialPose>(nh, map_frame_, [this](const Pose& T_map_base) {
      jobs_->post([this, T_map_base] { guess(T_map_base); });
    });
    input_ = std::make_unique<KeyframeInput>(
        nh, kQueueSize,
        KeyframeInput::Listener{
            [this](const ScanMotion& scan, const ScanReport&) {
              jobs_->post([this, scan] { publishPose(scan); });
            },
            [this](const Keyframe& keyframe, double) {
              jobs_->post([this, keyframe] { add(keyframe); });
            },
            [this, config] {
              jobs_->post([this, config] {
                localization_ = std::make_unique<Localization>(map_, config);
                tell();
              });
            }});
  }

  // On the thread of the jobs:

  void add(const Keyframe& keyframe) {
    localization_->addKeyframe(keyframe);
    newest_s_ = keyframe.stamp_s;
    tell();
  }

  void guess(const Pose& T_map_base) {
    if (!localization_->setInitialPose(T_map_base)) {
      NODELET_WARN("The robot is not where it was said to be: %s.",
                   localization_->status().problem.c_str());
    }
    tell();
  }

  /// What came of a keyframe or a guess.
  void tell() {
    const auto T_map_odom = localization_->T_map_odom();
    if (T_map_odom) {
      map_to_odom_->publish(*T_map_odom, newest_s_);
    } else {
      map_to_odom_->forget();
    }
    const LocalizationStatus status = localization_->status();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (status.localized != status_.localized) {
      NODELET_INFO("%s", status.localized ? "The robot is found." : "The robot is lost.");
    }
    status_ = status;
  }

  void publishPose(const ScanMotion& scan) {
    const auto T_map_odom = localization_->T_map_odom();
    if (!T_map_odom) return;
    const Pose T_map_base = *T_map_odom * scan.T_odom_base;
    geometry_msgs::PoseWithCovarianceStamped msg;
    msg.header.stamp = toRosTime(scan.stamp_s);
    msg.header.frame_id = map_frame_;
    msg.pose.pose = toPoseMsg(T_map_base);
    msg.pose.covariance = toMsg(localization_->covariance());
    pose_pub_.publish(msg);
    constexpr std::size_t kMost = 20000;  // half an hour
    const std::lock_guard<std::mutex> lock(mutex_);
    trajectory_.push_back({scan.stamp_s, T_map_base});
    if (trajectory_.size() > kMost) trajectory_.pop_front();
  }

  // On any thread:

  Trajectory trajectory() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {trajectory_.begin(), trajectory_.end()};
  }

  void describe(Diagnostics::Status& status) {
    constexpr std::size_t kMaxWaiting = 100;  // ten seconds of scans
    const std::lock_guard<std::mutex> lock(mutex_);
    if (jobs_->waiting() > kMaxWaiting) {
      status.summary(Diagnostics::Status::WARN, "localization cannot keep up");
    } else if (!status_.localized) {
      status.summary(Diagnostics::Status::WARN, "the robot's place in the map is not known");
    } else {
      status.summary(Diagnostics::Status::OK, "the robot is followed in the map");
    }
    status.add("problem", status_.problem);
    status.add("inlier ratio", status_.inlier_ratio);
    status.add("rms, m", status_.rms_m);
    status.add("way since a fit, m", status_.way_since_fit_m);
    status.add("relocations", status_.relocations);
    status.add("jobs waiting", jobs_->waiting());
  }

  std::string map_frame_;
  GraphSnapshotConstPtr map_;
  std::unique_ptr<Localization> localization_;  ///< Belongs to the jobs, as does the next one.
  double newest_s_ = 0.0;
  std::mutex mutex_;  ///< Guards the next two.
  LocalizationStatus status_;
  std::deque<StampedPose> trajectory_;
  std::unique_ptr<GraphPublisher> publisher_;
  std::unique_ptr<KnownClouds> known_clouds_;
  std::unique_ptr<MapToOdom> map_to_odom_;
  ros::Publisher pose_pub_;
  std::unique_ptr<JobThread> jobs_;
  ros::CallbackQueue patient_queue_;
  std::unique_ptr<DisplayPublisher> display_;
  ros::AsyncSpinner patient_spinner_{1, &patient_queue_};
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<InitialPose> initial_pose_;
  std::unique_ptr<KeyframeInput> input_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::LocalizationNodelet, nodelet::Nodelet)
