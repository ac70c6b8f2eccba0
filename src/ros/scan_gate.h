// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

namespace mrpt_sgraphs {

/// Holds a scan back until the motion sensors have caught up with it: their messages take another
/// way through the network. It waits for sensors that are there, and never for longer than until
/// the next scan, 0.1 s of the sensors' time or two ticks.
template <typename Scan>
class ScanGate {
 public:
  void imuReached(double stamp_s) { imu_reached_s_ = stamp_s; }
  void odomReached(double stamp_s) { odom_reached_s_ = stamp_s; }

  /// @param sweep_end_s  Stamp of the scan's last point.
  void push(Scan scan, double stamp_s, double sweep_end_s) {
    waiting_.push_back({std::move(scan), stamp_s, sweep_end_s, 0});
  }

  /// Called from time to time, so that sensors that fall silent do not hold the last scan for ever.
  void tick() {
    for (Waiting& scan : waiting_) ++scan.ticks;
  }

  /// The oldest scan, if it need not wait any longer.
  std::optional<Scan> pop() {
    if (waiting_.empty() || !isReady(waiting_.front())) return std::nullopt;
    std::optional<Scan> scan(std::move(waiting_.front().scan));
    waiting_.pop_front();
    return scan;
  }

  void clear() { *this = ScanGate(); }

 private:
  struct Waiting {
    Scan scan;
    double stamp_s;
    double sweep_end_s;
    int ticks;
  };

  static constexpr double kPatience_s = 0.1;
  static constexpr double kPresent_s = 1.0;  ///< A sensor silent for longer is not waited for.
  static constexpr int kMaxTicks = 2;

  static bool isBehind(double reached_s, double needed_s) {
    return reached_s < needed_s && reached_s > needed_s - kPresent_s;
  }

  bool isReady(const Waiting& scan) const {
    if (waiting_.size() > 1 || scan.ticks >= kMaxTicks) return true;
    if (std::max(imu_reached_s_, odom_reached_s_) > scan.sweep_end_s + kPatience_s) return true;
    return !isBehind(imu_reached_s_, scan.sweep_end_s) && !isBehind(odom_reached_s_, scan.stamp_s);
  }

  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  double imu_reached_s_ = kNever;
  double odom_reached_s_ = kNever;
  std::deque<Waiting> waiting_;
};

}  // namespace mrpt_sgraphs
