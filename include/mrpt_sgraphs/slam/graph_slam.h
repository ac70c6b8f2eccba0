// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/floor_detector.h"
#include "mrpt_sgraphs/semantics/loop_closer.h"
#include "mrpt_sgraphs/slam/graph_slam_config.h"
#include "mrpt_sgraphs/solver/optimization_summary.h"

namespace mrpt_sgraphs {

/// What adding a keyframe came to.
struct KeyframeOutcome {
  KeyframeId id;
  int loop_closures = 0;  ///< Believed and added.
  /// What followed: none for a keyframe that nothing but odometry holds, two where walls were
  /// merged after the first.
  std::vector<OptimizationSummary> optimizations;
};

/// The back end: keyframes in, a graph of keyframes, walls and ground with loops closed out. One
/// thread owns it; others read the snapshots that it hands out.
class GraphSlam {
 public:
  explicit GraphSlam(const GraphSlamConfig& config);
  ~GraphSlam();

  /// Takes the keyframe into the graph, finds the walls and the ground among its planes, looks for
  /// loops, and optimizes if there is more than odometry to it.
  /// @throws std::invalid_argument for a keyframe without a cloud, not newer than the last one, or
  ///         with a covariance that is not positive definite; the graph is then as it was.
  KeyframeOutcome addKeyframe(const Keyframe& keyframe);

  /// The next keyframe is the first of another session in this map: no odometry leads to it, and
  /// its own begins anywhere. It was found from another keyframe.
  /// @param link  Its `to` is the next keyframe, whatever it says.
  /// @throws std::out_of_range if `from` is not in the graph.
  void beginSession(const LoopClosure& link);

  /// Brings floors and rooms in line with what was detected in this graph or an older one, and
  /// optimizes if there are new factors.
  std::vector<OptimizationSummary> setFloors(const FloorDetection& detection);
  std::vector<OptimizationSummary> setRooms(const RoomDetection& detection);

  /// @throws std::invalid_argument, std::out_of_range as requireName does.
  void nameRoom(RoomId room, const std::string& name);

  /// Optimizes the whole graph now; walls that grow together by it are merged.
  OptimizationSummary optimize();

  /// To be called when a run is over: what the stages have put off, a global optimization and dropped
  /// keyframes found again within their regions as these are now.
  std::vector<OptimizationSummary> finish();

  /// From now on. Where the mode is another one, all that was dropped comes back, with the factors that it had.
  /// @throws std::invalid_argument for a mode that is none.
  void setHierarchy(const HierarchyConfig& hierarchy);

  /// What the graph is now; the same object until it changes.
  GraphSnapshotConstPtr snapshot() const;

  /// The drift that the graph has found, at the newest keyframe.
  const Pose& T_map_odom() const;

  /// All that it knows but for its parameters, for a run that goes on later: see geometry/archive.h.
  /// Read into a new one. Keyframes' clouds should be known to the archive before.
  template <typename Archive>
  void archive(Archive& a);

 private:
  struct State;  ///< Not in the header: graph and solver are slow to compile.

  std::unique_ptr<State> state_;
};

}  // namespace mrpt_sgraphs
