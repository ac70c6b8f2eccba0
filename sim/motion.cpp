// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/path.h"

namespace mrpt_sgraphs::sim {
namespace {

/// Turning on the spot follows a quintic step, whose steepest rate is this times the mean.
constexpr double kQuinticPeak = 1.875;
/// A breath before and after turning on the spot.
constexpr double kPause_s = 0.2;
/// Legs ease into a slope: height is averaged twice over this many states to each side (0.6 s).
constexpr int kEasing = 4;

struct Moment {
  double time_s;
  MotionState state;
};

/// The fastest speed along a path that starts and ends at rest.
std::vector<double> speedsAlong(const Path& path, double acceleration_m_s2) {
  std::vector<double> speed;
  for (const PathSample& sample : path) speed.push_back(sample.max_speed_m_s);
  speed.front() = speed.back() = 0.0;
  const auto reach = [&](size_t from, size_t to) {
    const double step_m = (path[to].floor_map - path[from].floor_map).head<2>().norm();
    const double reachable =
        std::sqrt(speed[from] * speed[from] + 2.0 * acceleration_m_s2 * step_m);
    speed[to] = std::min(speed[to], reachable);
  };
  for (size_t k = 1; k < path.size(); ++k) reach(k - 1, k);
  for (size_t k = path.size() - 1; k > 0; --k) reach(k, k - 1);
  return speed;
}

class Walk {
 public:
  explicit Walk(const MotionLimits& limits) : limits_(limits) {}

  void rest(const Eigen::Vector3d& floor_map, double yaw_rad, double duration_s) {
    add(0.0, {floor_map, yaw_rad, 0.0, 0.0});
    add(duration_s, {floor_map, yaw_rad, 0.0, 0.0});
  }

  void along(const Path& path) {
    const std::vector<double> speed = speedsAlong(path, limits_.acceleration_m_s2);
    add(0.0, {path.front().floor_map, path.front().yaw_rad, 0.0, 0.0});
    for (size_t k = 1; k < path.size(); ++k) {
      const Eigen::Vector3d step = path[k].floor_map - path[k - 1].floor_map;
      const double step_m = step.head<2>().norm();
      const double mean_speed = 0.5 * (speed[k - 1] + speed[k]);
      if (step_m == 0.0 || mean_speed == 0.0) continue;
      add(step_m / mean_speed, {path[k].floor_map, path[k].yaw_rad, step.z() / step_m,
                                std::min(1.0, speed[k] / limits_.walking_m_s)});
    }
  }

  void turn(const Eigen::Vector3d& floor_map, double from_rad, double to_rad) {
    const double duration_s = kQuinticPeak * std::abs(to_rad - from_rad) / limits_.turning_rad_s;
    rest(floor_map, from_rad, kPause_s);
    constexpr int kParts = 40;
    for (int k = 1; k <= kParts; ++k) {
      const double f = static_cast<double>(k) / kParts;
      const double progress = f * f * f * (10.0 - 15.0 * f + 6.0 * f * f);
      const double rate = 16.0 * f * f * (1.0 - f) * (1.0 - f);  // 1 at its peak
      add(duration_s / kParts, {floor_map, from_rad + progress * (to_rad - from_rad), 0.0, rate});
    }
    rest(floor_map, to_rad, kPause_s);
  }

  /// The walk at equal intervals, linear between its moments.
  std::vector<MotionState> sampled() const {
    std::vector<MotionState> states;
    size_t k = 0;
    for (int i = 0; i * kMotionPeriod_s <= moments_.back().time_s; ++i) {
      const double time_s = i * kMotionPeriod_s;
      while (k + 2 < moments_.size() && moments_[k + 1].time_s < time_s) ++k;
      const Moment& a = moments_[k];
      const Moment& b = moments_[k + 1];
      const double span_s = b.time_s - a.time_s;
      const double f = span_s > 0.0 ? std::clamp((time_s - a.time_s) / span_s, 0.0, 1.0) : 1.0;
      const auto mix = [f](const auto& x, const auto& y) { return x + f * (y - x); };
      states.push_back({a.state.floor_map + f * (b.state.floor_map - a.state.floor_map),
                        mix(a.state.yaw_rad, b.state.yaw_rad), mix(a.state.slope, b.state.slope),
                        mix(a.state.activity, b.state.activity)});
    }
    states.push_back(moments_.back().state);
    return states;
  }

 private:
  void add(double after_s, const MotionState& state) {
    const double now_s = moments_.empty() ? 0.0 : moments_.back().time_s;
    moments_.push_back({now_s + after_s, state});
  }

  const MotionLimits& limits_;
  std::vector<Moment> moments_;
};

void easeSlopes(std::vector<MotionState>& states) {
  const std::vector<MotionState> sharp = states;
  const int last = static_cast<int>(sharp.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    MotionState& state = states[static_cast<size_t>(k)];
    state.floor_map.z() = 0.0;
    state.slope = 0.0;
    for (int j = k - kEasing; j <= k + kEasing; ++j) {
      const MotionState& neighbour = sharp[static_cast<size_t>(std::clamp(j, 0, last))];
      state.floor_map.z() += neighbour.floor_map.z() / (2 * kEasing + 1);
      state.slope += neighbour.slope / (2 * kEasing + 1);
    }
  }
}

}  // namespace

std::vector<MotionState> planMotion(const Route& route, const std::vector<FloorPlan>& plans,
                                    const MotionLimits& limits, double start_turn_rad) {
  const std::vector<Path> paths = roundCorners(route, plans, limits);
  Walk walk(limits);
  const PathSample& start = paths.front().front();
  walk.rest(start.floor_map, start.yaw_rad - start_turn_rad, limits.still_s);
  if (start_turn_rad != 0.0) {
    walk.turn(start.floor_map, start.yaw_rad - start_turn_rad, start.yaw_rad);
  }
  for (size_t k = 0; k < paths.size(); ++k) {
    walk.along(paths[k]);
    if (k + 1 == paths.size()) break;
    walk.turn(paths[k].back().floor_map, paths[k].back().yaw_rad, paths[k + 1].front().yaw_rad);
  }
  walk.rest(paths.back().back().floor_map, paths.back().back().yaw_rad, limits.still_s);
  std::vector<MotionState> states = walk.sampled();
  easeSlopes(states);
  easeSlopes(states);
  return states;
}

}  // namespace mrpt_sgraphs::sim
