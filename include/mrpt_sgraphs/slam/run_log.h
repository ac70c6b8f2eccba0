// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/frontend/keyframe_selector.h"
#include "mrpt_sgraphs/io/run_writer.h"
#include "mrpt_sgraphs/slam/scan_trajectory.h"

namespace mrpt_sgraphs {

/// What a run leaves behind beside its graph.
class RunLog {
 public:
  void addScan(const ScanMotion& scan, const ScanReport& report);
  void add(const std::vector<OptimizationSummary>& optimizations);
  void beginSession() { trajectory_.beginSession(); }

  /// Takes over the scans of a log that go on where this one ends.
  void append(const RunLog& later);

  /// Of the scan of that stamp, to the microsecond; null if there is none.
  ScanReport* report(double stamp_s);

  template <typename Archive>
  void archive(Archive& a);

  std::size_t scans() const { return scans_.size(); }
  /// Of the last scan; none before the first.
  std::optional<double> stamp_s() const {
    return scans_.empty() ? std::nullopt : std::make_optional(scans_.back().stamp_s);
  }
  const ScanTrajectory& trajectory() const { return trajectory_; }

  /// All of it with the graph as it is now. Parameters and `wall_s` are the caller's to fill in.
  RunRecord record(const GraphSnapshotConstPtr& graph) const;

 private:
  ScanTrajectory trajectory_;
  std::vector<OptimizationSummary> optimizations_;
  std::vector<ScanReport> scans_;
};

}  // namespace mrpt_sgraphs
