// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/frontend/odometry.h"
#include "mrpt_sgraphs/frontend/plane_observer.h"
#include "mrpt_sgraphs/frontend/prefilter.h"
#include "mrpt_sgraphs/slam/back_end.h"
#include "mrpt_sgraphs/slam/slam_config.h"

namespace mrpt_sgraphs {

/// Hears what the front end gives to the back end: all that is needed to do the back end's work
/// again. What is empty is not called.
struct FrontEndListener {
  std::function<void(const OdometryResult&)> on_scan;  ///< Of every scan that was placed.
  /// After its scan, with its planes and what these have cost [ms].
  std::function<void(const Keyframe&, double segment_ms)> on_keyframe;
};

/// The classes of the nodelets, one after the other on the caller's thread: the same input gives the
/// same output.
class Pipeline {
 public:
  explicit Pipeline(const SlamConfig& config, FrontEndListener listener = {});

  void addImu(const ImuSample& sample) {
    beginSessionAt(sample.stamp_s);
    odometry_.addImu(sample);
  }
  void addOdom(const OdomSample& sample) {
    beginSessionAt(sample.stamp_s);
    odometry_.addOdom(sample);
  }

  /// Takes a scan through all of the pipeline. What happens within its sweep should have been added
  /// before: IMU and odometry up to its last point.
  /// @return What is to be said of it, with numbers; empty if all is well. A scan that cannot be used
  ///         at all is not in the record.
  std::string addScan(const RawCloud& raw, const Pose& T_base_lidar, const std::string& base_frame);

  std::size_t scans() const { return back_end_.scans(); }
  GraphSnapshotConstPtr graph() const { return back_end_.graph(); }

  /// To be called when a run is over: see GraphSlam::finish.
  void finish() { back_end_.finish(); }

  /// Everything so far, and all that is needed to go on. `wall_s` is the caller's to fill in.
  RunRecord record();

  /// Goes on where a record was made, into a new one. The parameters are its own. What comes later
  /// than that by a pause is another session: see BackEnd::beginSession.
  /// @throws std::runtime_error as StateReader does.
  void restore(const StateReader& state);
  /// Uses the map of a record and leaves it as it is: see BackEnd::localize. The front end begins anew.
  /// @throws std::runtime_error as StateReader does.
  void localizeIn(const StateReader& state);
  /// Why a second session is not part of the map yet, with numbers; empty if there is none.
  std::string waitingFor() const { return back_end_.waitingFor(); }

  /// Of the last scan; none before the first.
  std::optional<double> stamp_s() const { return back_end_.stamp_s(); }

 private:
  template <typename Archive>
  void archiveFrontEnd(Archive& a) {
    a("odometry", odometry_);
    a("keyframes", keyframes_);
    a("planes", planes_);
  }
  void add(Keyframe* keyframe);
  void beginSessionAt(double stamp_s);

  SlamConfig config_;
  FrontEndListener listener_;
  Prefilter prefilter_;
  Odometry odometry_;
  KeyframeSelector keyframes_;
  PlaneObserver planes_;
  BackEnd back_end_;
  std::optional<double> resumes_until_s_;  ///< What is newer begins a session; none: nothing does.
};

}  // namespace mrpt_sgraphs
