// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "mrpt_sgraphs/semantics/relocation.h"
#include "mrpt_sgraphs/slam/back_end_config.h"
#include "mrpt_sgraphs/slam/graph_slam.h"
#include "mrpt_sgraphs/slam/run_log.h"

namespace mrpt_sgraphs {

/// A second session of a map, as long as it is not known where in the map it is. What comes from the
/// front end makes a graph of its own, and is kept: once the place is known, it can be told to the
/// map as if that had been there from the start.
class WaitingSession {
 public:
  WaitingSession(GraphSnapshotConstPtr map, const BackEndConfig& config);

  void addScan(const ScanMotion& motion, const ScanReport& report) {
    events_.push_back(Scan{motion, report});
  }

  /// @return How its first keyframe is reached from the map, once that is known.
  /// @throws std::invalid_argument as GraphSlam::addKeyframe.
  std::optional<LoopClosure> addKeyframe(const Keyframe& keyframe, double segment_ms);

  /// Someone has pointed at where it is: right within a metre and half a radian.
  /// @return As addKeyframe; none before the first keyframe.
  std::optional<LoopClosure> guess(const Pose& T_map_base);

  /// Tells all that came, in its order.
  void replay(const std::function<void(const ScanMotion&, const ScanReport&)>& on_scan,
              const std::function<void(const Keyframe&, double segment_ms)>& on_keyframe) const;

  /// Why the place is not known, with numbers.
  const std::string& undecided() const { return undecided_; }

 private:
  struct Scan {
    ScanMotion motion;
    ScanReport report;
  };
  struct KeyframeOfIt {
    Keyframe keyframe;
    double segment_ms = 0.0;
  };
  using Event = std::variant<Scan, KeyframeOfIt>;

  std::optional<LoopClosure> take(const RelocationSearch& search);

  Relocator relocator_;
  GraphSlam session_;
  std::deque<Event> events_;  ///< In the order in which they came.
  std::string undecided_ = "nothing was seen";
};

}  // namespace mrpt_sgraphs
