// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "job_thread.h"
#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"
#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {

/// The back end on a thread of its own: values go in and return at once, snapshots come out. What
/// is asked of it is done in the order in which it came.
class GraphSlamThread {
 public:
  /// All are called on the thread.
  struct Listener {
    /// After every change, with the number of the graph: it changes where another one begins.
    std::function<void(const GraphSnapshotConstPtr&, std::uint32_t)> on_graph;
    /// T_map_odom after every change, where it is known.
    std::function<void(const Pose&, double stamp_s)> on_place;
    /// Of a map that was loaded, before its graph: nobody else knows its clouds.
    std::function<void(const GraphSnapshotConstPtr&)> on_loaded;
    std::function<void(const OptimizationSummary&)> on_optimization;
    std::function<void(const std::string&)> on_problem;  ///< One sentence.
  };

  GraphSlamThread(const SlamConfig& config, Listener listener);
  ~GraphSlamThread();  ///< What still waits is not done any more.

  void addScan(const ScanMotion& scan, const ScanReport& report);

  /// @param segment_ms  What its planes have cost.
  void addKeyframe(const Keyframe& keyframe, double segment_ms);

  /// What was found in the graph of a number. Of one that is over, nothing is done with it.
  void setFloors(std::uint32_t number, const FloorDetection& floors);
  /// @param detect_ms  What it has cost.
  void setRooms(std::uint32_t number, const RoomDetection& rooms, double detect_ms);

  /// From the next job on. Where the mode is another one, all that was dropped comes back.
  void setHierarchy(const HierarchyConfig& hierarchy);

  /// Writes what there is into rescueFolder(), so that it is not lost, and begins with an empty graph.
  /// Their numbers are 0, 1, ...
  void startAgain();

  /// The same with a saved map. Where it was dumped from what there is now, the run goes on from there
  /// with all that came since; else what comes joins the map as soon as its place there is known.
  /// @return What there is to say. What StateReader throws comes with the future, and nothing has
  ///         changed then.
  std::future<std::string> load(const std::string& folder);

  /// Someone has pointed at where the robot is: right within a metre and half a radian. Nothing
  /// happens where that is known.
  void guess(const Pose& T_map_base);

  /// What GraphSlam::nameRoom throws comes with the future.
  std::future<void> nameRoom(RoomId room, const std::string& name);

  std::future<OptimizationSummary> optimize();
  /// What there is.
  std::future<RunRecord> record();
  /// The same with all that is needed to go on.
  /// @param finish  After a last optimization, which takes as long as it takes.
  std::future<RunRecord> dump(bool finish);

  /// T_map_base of every scan.
  std::future<Trajectory> trajectory();

  /// Jobs that wait.
  std::size_t waiting() const { return jobs_.waiting(); }

 private:
  struct Session;

  void join(const LoopClosure& link);
  void addToMap(const Keyframe& keyframe, double segment_ms);
  std::string rescue();

  void tell(const std::vector<OptimizationSummary>& optimizations);
  void tellGraph();
  void finish();
  RunRecord recordNow();
  RunRecord dumpNow();

  SlamConfig config_;  ///< Belongs to the thread.
  const Listener listener_;
  std::unique_ptr<Session> session_;  ///< Belongs to the thread.

  JobThread jobs_;  ///< Last member: its thread uses the others.
};

}  // namespace mrpt_sgraphs
