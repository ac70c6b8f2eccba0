// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <boost/make_shared.hpp>
#include <exception>
#include <memory>
#include <pluginlib/class_list_macros.hpp>

#include "diagnostics.h"
#include "graph_news.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/ros/detections.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"
#include "pipeline_nodelet.h"
#include "throttle.h"

namespace mrpt_sgraphs {

/// What of the graph belongs to which level of the building; detectFloors() knows.
///
/// Subscribes  graph   (mrpt_sgraphs/SituationalGraph, zero-copy)
/// Publishes   floors  (mrpt_sgraphs/Floors)  the graph's stamp
/// Parameters  floors/*  FloorDetectorConfig
class FloorDetectorNodelet final : public PipelineNodelet {
 private:
  void start() override {
    config_ = section<FloorDetectorConfig>("floors");
    ros::NodeHandle& nh = getNodeHandle();
    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    if (!config_.enabled) return;
    constexpr std::uint32_t kNewestAlone = 1;
    floors_pub_ = nh.advertise<Floors>("floors", kQueueSize);
    graph_sub_ = nh.subscribe("graph", kNewestAlone, &FloorDetectorNodelet::onGraph, this);
  }

  void onGraph(const SituationalGraphConstPtr& msg) {
    if (msg->keyframes.empty() || !news_.isNew(*msg)) return;
    try {
      CpuStopwatch watch;
      const FloorDetection detection = detectFloors(toSnapshot(*msg), config_);
      const auto floors = boost::make_shared<Floors>(toMsg(detection, msg->header.frame_id));
      floors->session = msg->session;
      floors->detect_ms = watch.lap();
      floors_pub_.publish(floors);  // as a pointer, or it is serialized
      last_ = floors;
    } catch (const std::exception& error) {
      if (warning_.passes(error.what())) NODELET_WARN("No floors: %s.", error.what());
    }
  }

  void describe(Diagnostics::Status& status) {
    if (!config_.enabled) {
      status.summary(Diagnostics::Status::OK, "switched off by floors/enabled");
      return;
    }
    status.summary(Diagnostics::Status::OK, last_ ? "floors are looked for" : "no graph yet");
    status.add("floors", last_ ? last_->floors.size() : 0);
    status.add("connections", last_ ? last_->connections.size() : 0);
    status.add("last detection, ms", last_ ? last_->detect_ms : 0.0);
  }

  FloorDetectorConfig config_;
  GraphNews news_{GraphNews::Of::kKeyframes};
  FloorsConstPtr last_;
  Throttle warning_;
  std::unique_ptr<Diagnostics> diagnostics_;
  ros::Publisher floors_pub_;
  ros::Subscriber graph_sub_;  ///< Last member: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::FloorDetectorNodelet, nodelet::Nodelet)
