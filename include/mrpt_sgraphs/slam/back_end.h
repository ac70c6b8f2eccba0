// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "mrpt_sgraphs/io/state_files.h"
#include "mrpt_sgraphs/semantics/room_detector.h"
#include "mrpt_sgraphs/slam/back_end_config.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

class LocalizedRun;
class WaitingSession;

/// What comes after the front end, on the caller's thread: each keyframe goes into the graph, and
/// then floors and rooms are looked for in it. The same input gives the same output, whether it
/// comes from the front end itself or from a recording of it: its budgets are iterations, and none
/// is wall time.
class BackEnd {
 public:
  explicit BackEnd(const BackEndConfig& config);
  ~BackEnd();

  /// Every scan that was placed, in their order.
  void addScan(const ScanMotion& scan, const ScanReport& report);

  /// What comes now is of another session in the map that was restored: odometry began again,
  /// anywhere. It is kept until its place in the map is known, and is then told to the map as if that
  /// had been there from the start.
  void beginSession();
  /// Why a session is still kept, with numbers; empty if none is.
  std::string waitingFor() const;

  /// From now on the map that was restored is used and stays as it is: see LocalizedRun.
  void localize();

  /// After its scan.
  /// @param segment_ms  What its planes have cost.
  /// @throws std::invalid_argument as GraphSlam::addKeyframe does.
  void addKeyframe(const Keyframe& keyframe, double segment_ms);

  std::size_t scans() const { return log().scans(); }
  std::optional<double> stamp_s() const { return log().stamp_s(); }  ///< Of the last scan.
  GraphSnapshotConstPtr graph() const { return graph_slam_.snapshot(); }

  /// To be called when a run is over: see GraphSlam::finish.
  void finish();

  /// Everything so far, with the parameters of the back end, and all that is needed to go on.
  /// `wall_s` is the caller's to fill in.
  RunRecord record();

  /// What record() is to keep of its state.
  void writeState(StateWriter* state);
  /// Into a new one. The parameters are its own.
  /// @throws std::runtime_error as StateReader does.
  void restore(const StateReader& state);

 private:
  const RunLog& log() const;
  void join(const LoopClosure& link);
  void addToMap(const Keyframe& keyframe, double segment_ms);

  BackEndConfig config_;
  GraphSlam graph_slam_;
  RoomDetector rooms_;
  RunLog log_;
  std::unique_ptr<WaitingSession> waiting_;  ///< Null: none.
  std::unique_ptr<LocalizedRun> localized_;  ///< Null: the map grows.
};

}  // namespace mrpt_sgraphs
