// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>

#include <boost/make_shared.hpp>
#include <exception>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "cloud_trace.h"
#include "diagnostics.h"
#include "graph_news.h"
#include "keyframe_clouds.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/ros/detections.h"
#include "mrpt_sgraphs/semantics/room_detector.h"
#include "newest_worker.h"
#include "pipeline_nodelet.h"
#include "throttle.h"

namespace mrpt_sgraphs {

/// The rooms of the graph; what is one, RoomDetector knows.
///
/// Subscribes  graph            (mrpt_sgraphs/SituationalGraph, zero-copy)  and for its keyframes
///             keyframe_points  (Cloud, zero-copy)                          the same stamps
/// Publishes   rooms            (mrpt_sgraphs/Rooms)                        the graph's stamp
/// Parameters  room_detection/*  RoomDetectorConfig
///
/// A search takes as long as it takes, on a thread of its own. Then comes the newest graph: those
/// between are skipped.
class RoomDetectorNodelet final : public PipelineNodelet {
 private:
  using CloudConstPtr = boost::shared_ptr<const Cloud>;
  using Worker = NewestWorker<SituationalGraphConstPtr>;

  void start() override {
    config_ = section<RoomDetectorConfig>("room_detection");
    ros::NodeHandle& nh = getNodeHandle();
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    if (!config_.enabled) return;
    rooms_pub_ = nh.advertise<Rooms>("rooms", kQueueSize);
    worker_ = std::make_unique<Worker>([this](const auto& msg) { detect(*msg); });
    cloud_sub_ = nh.subscribe("keyframe_points", kQueueSize, &RoomDetectorNodelet::onCloud, this);
    constexpr std::uint32_t kAll = 0;
    known_sub_ = nh.subscribe("known_points", kAll, &RoomDetectorNodelet::onKnownCloud, this);
    graph_sub_ = nh.subscribe("graph", kQueueSize, &RoomDetectorNodelet::onGraph, this);
  }

  void onCloud(const CloudConstPtr& cloud) {
    traceCloud("receive", "keyframe_points", cloud.get());
    clouds_.add(pcl::pcl_ptr(cloud));
  }

  void onKnownCloud(const CloudConstPtr& cloud) { clouds_.addKnown(pcl::pcl_ptr(cloud)); }

  void onGraph(const SituationalGraphConstPtr& msg) {
    if (news_.isNew(*msg)) worker_->put(msg);
  }

  /// On the worker's thread.
  void detect(const SituationalGraph& msg) {
    try {
      CpuStopwatch watch;
      GraphSnapshot graph = toSnapshot(msg);
      if (!clouds_.attachTo(&graph)) return;
      if (!detector_ || msg.session != session_) {
        detector_ = std::make_unique<RoomDetector>(config_);
        session_ = msg.session;
      }
      const std::size_t lost = msg.keyframes.size() - graph.keyframes.size();
      if (lost > 0) {  // rooms that it knows nothing of would be given up
        const std::lock_guard<std::mutex> lock(last_mutex_);
        last_.keyframes_without_cloud = lost;
        return;
      }
      const auto rooms =
          boost::make_shared<Rooms>(toMsg(detector_->detect(graph), msg.header.frame_id));
      rooms->session = msg.session;
      rooms->detect_ms = watch.lap();
      rooms_pub_.publish(rooms);  // as a pointer, or it is serialized

      const std::lock_guard<std::mutex> lock(last_mutex_);
      last_ = {true, 0, rooms->rooms.size(), rooms->detect_ms};
    } catch (const std::exception& error) {
      if (warning_.passes(error.what())) NODELET_WARN("No rooms: %s.", error.what());
    }
  }

  void describe(Diagnostics::Status& status) {
    const std::lock_guard<std::mutex> lock(last_mutex_);
    if (!config_.enabled) {
      status.summary(Diagnostics::Status::OK, "switched off by room_detection/enabled");
      return;
    }
    if (last_.keyframes_without_cloud > 0) {
      status.summary(Diagnostics::Status::WARN,
                     "clouds of keyframes were lost on the way: rooms stay as they are");
    } else {
      status.summary(Diagnostics::Status::OK, last_.any ? "rooms are looked for" : "no graph yet");
    }
    status.add("rooms", last_.rooms);
    status.add("last detection, ms", last_.detect_ms);
    status.add("graphs skipped", worker_ ? worker_->skipped() : 0);
    status.add("keyframes without a cloud", last_.keyframes_without_cloud);
  }

  /// What the last detection came to.
  struct Last {
    bool any = false;
    std::size_t keyframes_without_cloud = 0;
    std::size_t rooms = 0;
    double detect_ms = 0.0;
  };

  RoomDetectorConfig config_;
  GraphNews news_{GraphNews::Of::kKeyframesAndTheirFloors};
  KeyframeClouds clouds_;
  std::unique_ptr<RoomDetector> detector_;  ///< This and the next two belong to the worker.
  std::uint32_t session_ = 0;
  Throttle warning_;
  std::mutex last_mutex_;  ///< Guards the next one.
  Last last_;
  ros::Publisher rooms_pub_;
  std::unique_ptr<Worker> worker_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Subscriber cloud_sub_;
  ros::Subscriber known_sub_;
  ros::Subscriber graph_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::RoomDetectorNodelet, nodelet::Nodelet)
