// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_ros/point_cloud.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>

#include "diagnostics.h"
#include "display_publisher.h"
#include "graph_publisher.h"
#include "graph_services.h"
#include "graph_slam_thread.h"
#include "initial_pose.h"
#include "keyframe_input.h"
#include "known_clouds.h"
#include "live_hierarchy.h"
#include "map_to_odom.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/ros/detections.h"
#include "pipeline_nodelet.h"
#include "room_services.h"
#include "throttle.h"

namespace mrpt_sgraphs {
namespace {

std::size_t droppedIn(const GraphSnapshot& graph) {
  return static_cast<std::size_t>(
      std::count_if(graph.keyframes.begin(), graph.keyframes.end(),
                    [](const KeyframeNode& keyframe) { return keyframe.marginalized; }));
}

}  // namespace

/// The back end among the nodelets: GraphSlam on its own thread, what goes in and what comes out.
///
/// Subscribes  see KeyframeInput; InitialPose, for a map that was loaded
///             floors           (mrpt_sgraphs/Floors)           found in graphs of ours
///             rooms            (mrpt_sgraphs/Rooms)            likewise
/// Publishes   see GraphPublisher, MapToOdom, DisplayPublisher and KnownClouds
/// Serves      see GraphServices and RoomServices; LiveHierarchy in hierarchy
/// Parameters  loop_closure/*, walls/*, ground/*, rooms/*, hierarchy/*, solver/*, and for the
///             record of a run all of SlamConfig
///             frames/map, frames/odom                          FramesConfig
///             display/*                                        DisplayConfig
///             map                                              a folder to begin with; empty: none
class GraphSlamNodelet final : public PipelineNodelet {
 private:
  void start() override {
    const SlamConfig config = loadSlamConfig(getNodeHandle());
    const auto frames = section<FramesConfig>("frames");
    const auto display = section<DisplayConfig>("display");
    detectors_wanted_ = config.floors.enabled && config.room_detection.enabled;
    ros::NodeHandle& nh = getNodeHandle();
    map_frame_ = frameName(frames.map);
    publisher_ = std::make_unique<GraphPublisher>(nh, frames);
    known_clouds_ = std::make_unique<KnownClouds>(nh);
    map_to_odom_ = std::make_unique<MapToOdom>(nh, frames);
    slam_ = std::make_unique<GraphSlamThread>(
        config, GraphSlamThread::Listener{
                    [this](const GraphSnapshotConstPtr& graph, std::uint32_t number) {
                      onGraph(graph, number);
                    },
                    [this](const Pose& T_map_odom, double stamp_s) {
                      map_to_odom_->publish(T_map_odom, stamp_s);
                    },
                    [this](const GraphSnapshotConstPtr& graph) { known_clouds_->publish(graph); },
                    [this](const OptimizationSummary& summary) { onOptimization(summary); },
                    [this](const std::string& problem) { NODELET_WARN("%s", problem.c_str()); }});

    ros::NodeHandle patient_nh(nh);
    patient_nh.setCallbackQueue(&patient_queue_);
    services_ = std::make_unique<GraphServices>(patient_nh, *slam_, map_frame_);
    room_services_ = std::make_unique<RoomServices>(patient_nh, *slam_,
                                                    [this] { return publisher_->graph(); });
    display_ = std::make_unique<DisplayPublisher>(
        patient_nh, GraphView{frameName(frames.map), display.layer_lift_m},
        DisplayPublisher::Source{[this] { return publisher_->graph(); },
                                 [this] { return slam_->trajectory().get(); },
                                 [this] { return lastOptimization(); }});
    hierarchy_ = std::make_unique<LiveHierarchy>(
        ros::NodeHandle(patient_nh, "hierarchy"),
        LiveHierarchy::Listener{
            [this](const HierarchyConfig& hierarchy) { slam_->setHierarchy(hierarchy); },
            [this](const std::string& problem) { NODELET_WARN("%s", problem.c_str()); }});
    patient_spinner_.start();

    diagnostics_ = std::make_unique<Diagnostics>(
        nh, getName(), [this](Diagnostics::Status& status) { describe(status); });
    input_ = std::make_unique<KeyframeInput>(
        nh, kQueueSize,
        KeyframeInput::Listener{
            [this](const ScanMotion& motion, const ScanReport& report) {
              slam_->addScan(motion, report);
            },
            [this](const Keyframe& keyframe, double segment_ms) {
              slam_->addKeyframe(keyframe, segment_ms);
            },
            [this] { slam_->startAgain(); }});
    floors_sub_ = nh.subscribe("floors", kQueueSize, &GraphSlamNodelet::onFloors, this);
    rooms_sub_ = nh.subscribe("rooms", kQueueSize, &GraphSlamNodelet::onRooms, this);
    initial_pose_ = std::make_unique<InitialPose>(
        nh, map_frame_, [this](const Pose& T_map_base) { slam_->guess(T_map_base); });
    loadMap();
  }

  void loadMap() {
    const auto folder = getPrivateNodeHandle().param<std::string>("map", "");
    if (folder.empty()) return;
    NODELET_INFO("%s", slam_->load(folder).get().c_str());
  }

  void onFloors(const FloorsConstPtr& msg) {
    takeDetection([&] { slam_->setFloors(msg->session, toFloorDetection(*msg)); });
  }

  void onRooms(const RoomsConstPtr& msg) {
    takeDetection([&] { slam_->setRooms(msg->session, toRoomDetection(*msg), msg->detect_ms); });
  }

  template <typename Take>
  void takeDetection(const Take& take) {
    try {
      take();
    } catch (const std::invalid_argument& error) {
      if (warning_.passes(error.what())) NODELET_WARN("Not used: %s.", error.what());
    }
  }

  void onGraph(const GraphSnapshotConstPtr& graph, std::uint32_t number) {
    if (number != number_of_graph_) {
      map_to_odom_->forget();
      number_of_graph_ = number;
      const std::lock_guard<std::mutex> lock(last_optimization_mutex_);
      last_optimization_.reset();
    }
    publisher_->publish(graph, number);
  }

  void onOptimization(const OptimizationSummary& summary) {
    publisher_->publish(summary);
    if (summary.free_keyframes.runs().empty()) return;  // of dropping keyframes nothing is shown
    const std::lock_guard<std::mutex> lock(last_optimization_mutex_);
    last_optimization_ = summary;
  }

  std::optional<OptimizationSummary> lastOptimization() {
    const std::lock_guard<std::mutex> lock(last_optimization_mutex_);
    return last_optimization_;
  }

  void describe(Diagnostics::Status& status) {
    constexpr std::size_t kMaxWaiting = 100;    // ten seconds of scans
    constexpr std::size_t kMaxIncomplete = 10;  // as many metres, unless told otherwise
    const std::size_t waiting = slam_->waiting();
    const GraphSnapshotConstPtr graph = publisher_->graph();
    if (waiting > kMaxWaiting) {
      status.summary(Diagnostics::Status::WARN, "the back end cannot keep up");
    } else if (input_->incomplete() > kMaxIncomplete) {
      status.summary(Diagnostics::Status::WARN,
                     "keyframes wait for their planes: is PlaneSegmentation loaded?");
    } else if (detectors_wanted_ &&
               std::min(rooms_sub_.getNumPublishers(), floors_sub_.getNumPublishers()) == 0) {
      status.summary(
          Diagnostics::Status::WARN,
          "nobody looks for rooms or floors: are RoomDetector and FloorDetector loaded?");
    } else {
      status.summary(Diagnostics::Status::OK, graph ? "the graph grows" : "no keyframe yet");
    }
    status.add("jobs waiting", waiting);
    status.add("keyframes incomplete", input_->incomplete());
    const std::size_t dropped = graph ? droppedIn(*graph) : 0;
    status.add("mode", hierarchy_->now().mode);
    status.add("keyframes", graph ? graph->keyframes.size() : 0);
    status.add("keyframes active", graph ? graph->keyframes.size() - dropped : 0);
    status.add("keyframes dropped", dropped);
    status.add("walls", graph ? graph->walls.size() : 0);
    status.add("rooms", graph ? graph->rooms.size() : 0);
    status.add("floors", graph ? graph->floors.size() : 0);
    status.add("factors", graph ? graph->factors.size() : 0);
    const std::optional<OptimizationSummary> optimization = lastOptimization();
    if (!optimization) return;
    status.add("last optimization", optimization->kind);
    status.add("last optimization, stamp", optimization->stamp_s);
    status.add("last optimization, ms", optimization->total_ms);
    status.add("last optimization, iterations", optimization->iterations);
    status.add("last optimization, converged", optimization->converged);
  }

  Throttle warning_;
  bool detectors_wanted_ = true;
  std::mutex last_optimization_mutex_;  ///< Guards the next one.
  std::optional<OptimizationSummary> last_optimization_;
  std::uint32_t number_of_graph_ = 0;  ///< Belongs to the back end's thread.
  std::string map_frame_;
  std::unique_ptr<GraphPublisher> publisher_;
  std::unique_ptr<KnownClouds> known_clouds_;
  std::unique_ptr<MapToOdom> map_to_odom_;
  std::unique_ptr<GraphSlamThread> slam_;
  ros::CallbackQueue patient_queue_;  ///< For what may wait for the back end.
  std::unique_ptr<GraphServices> services_;
  std::unique_ptr<RoomServices> room_services_;
  std::unique_ptr<DisplayPublisher> display_;
  std::unique_ptr<LiveHierarchy> hierarchy_;
  ros::AsyncSpinner patient_spinner_{1, &patient_queue_};
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<KeyframeInput> input_;
  ros::Subscriber floors_sub_;
  std::unique_ptr<InitialPose> initial_pose_;
  ros::Subscriber rooms_sub_;  ///< Last members: no callback outlives the others.
};

}  // namespace mrpt_sgraphs

PLUGINLIB_EXPORT_CLASS(mrpt_sgraphs::GraphSlamNodelet, nodelet::Nodelet)
