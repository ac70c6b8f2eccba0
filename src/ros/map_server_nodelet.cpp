// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>
#include <ros/steady_timer.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <exception>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "cloud_trace.h"
#include "diagnostics.h"
#include "keyframe_clouds.h"
#include "map_publisher.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/mapping/room_clouds.h"
#include "mrpt_sgraphs/ros/detections.h"
#include "newest_worker.h"
#include "pipeline_nodelet.h"
#include "throttle.h"

namespace mrpt_sgraphs {

/// The maps to use, which follow the graph.
///
/// Subscribes  graph            (mrpt_sgraphs/SituationalGraph, zero-copy)  and for its keyframes
///             keyframe_points  (Cloud, zero-copy)                          the same stamps
///             known_points     (Cloud)                                     of a map that was loaded
/// Publishes   see MapPublisher: every map/publish_period_s if something changed, or somebody came
/// Parameters  map/*            MapConfig
///
/// Maps are made on a thread of their own, of the newest graph: those between are skipped.
class MapServerNodelet final : public PipelineNodelet {
 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;
  using Worker = NewestWorker<SituationalGraphConstPtr>;

  void start() override {
    config_ = section<MapConfig>("map");
    ros::NodeHandle& nh = getNodeHandle();
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    publisher_ = std::make_unique<MapPublisher>(nh, config_, [this] { is_asked_for_ = true; });
    worker_ = std::make_unique<Worker>([this](const auto& msg) { makeMaps(*msg); });
    cloud_sub_ = nh.subscribe("keyframe_points", kQueueSize, &MapServerNodelet::onCloud, this);
    constexpr std::uint32_t kAll = 0;
    known_sub_ = nh.subscribe("known_points", kAll, &MapServerNodelet::onKnownCloud, this);
    graph_sub_ = nh.subscribe("graph", kQueueSize, &MapServerNodelet::onGraph, this);
    timer_ = nh.createSteadyTimer(ros::WallDuration(config_.publish_period_s),
                                  [this](const ros::SteadyTimerEvent&) { onTimer(); });
  }

  void onCloud(const CloudConstPtr& cloud) {
    traceCloud("receive", "keyframe_points", cloud.get());
    clouds_.add(pcl::pcl_ptr(cloud));
  }

  void onKnownCloud(const CloudConstPtr& cloud) {
    clouds_.addKnown(pcl::pcl_ptr(cloud));
    is_asked_for_ = true;  // its graph may have come before
  }

  void onGraph(const SituationalGraphConstPtr& msg) { newest_ = msg; }

  void onTimer() {
    if (!newest_) return;
    const bool is_asked_for = is_asked_for_.exchange(false);
    if (newest_ == given_ && !is_asked_for) return;
    given_ = newest_;
    worker_->put(newest_);
  }

  /// On the worker's thread.
  void makeMaps(const SituationalGraph& msg) {
    try {
      CpuStopwatch watch;
      GraphSnapshot graph = toSnapshot(msg);
      if (!clouds_.attachTo(&graph, KeyframeClouds::Without::kKeep)) return;
      if (!room_clouds_ || msg.session != session_) {
        room_clouds_ = std::make_unique<RoomClouds>(config_.cell_m);
        publisher_->startAgain();
        session_ = msg.session;
      }
      room_clouds_->attachTo(&graph);
      std::size_t without_cloud = 0;
      for (const KeyframeNode& keyframe : graph.keyframes) {
        if (room_clouds_->isThinned(keyframe.id)) clouds_.forget(keyframe.stamp_s);
        without_cloud += keyframe.cloud == nullptr ? 1 : 0;
      }
      publisher_->publish(graph, msg.header);

      const std::lock_guard<std::mutex> lock(last_mutex_);
      last_ = {true, without_cloud, graph.keyframes.size(), room_clouds_->points(),
               publisher_->knownVoxels(), watch.lap()};
    } catch (const std::exception& error) {
      if (warning_.passes(error.what())) NODELET_WARN("No maps: %s.", error.what());
    }
  }

  void describe(Diagnostics::Status& status) {
    const std::lock_guard<std::mutex> lock(last_mutex_);
    if (last_.keyframes_without_cloud > 0) {
      status.summary(Diagnostics::Status::WARN,
                     "clouds of keyframes were lost on the way: the maps lack what they have seen");
    } else {
      status.summary(Diagnostics::Status::OK, last_.any ? "maps follow the graph" : "no graph yet");
    }
    status.add("keyframes", last_.keyframes);
    status.add("keyframes without a cloud", last_.keyframes_without_cloud);
    status.add("points kept", last_.points);
    status.add("voxels known", last_.voxels);
    status.add("last maps, ms", last_.total_ms);
    status.add("graphs skipped", worker_ ? worker_->skipped() : 0);
  }

  /// What the last maps came to.
  struct Last {
    bool any = false;
    std::size_t keyframes_without_cloud = 0;
    std::size_t keyframes = 0;
    std::size_t points = 0;
    std::size_t voxels = 0;
    double total_ms = 0.0;
  };

  MapConfig config_;
  KeyframeClouds clouds_;
  std::unique_ptr<RoomClouds> room_clouds_;  ///< This and the next two belong to the worker.
  std::uint32_t session_ = 0;
  Throttle warning_;
  std::mutex last_mutex_;  ///< Guards the next one.
  Last last_;
  std::atomic<bool> is_asked_for_{false};  ///< Somebody came who has not got the newest.
  SituationalGraphConstPtr newest_;
  SituationalGraphConstPtr given_;  ///< To the worker.
  std::unique_ptr<MapPublisher> publisher_;
  std::unique_ptr<Worker> worker_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Subscriber cloud_sub_;
  ros::Subscriber known_sub_;
  ros::Subscriber graph_sub_;
  ros::SteadyTimer timer_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::MapServerNodelet, nodelet::Nodelet)
