// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kSpacing_m = 0.02;
/// The widest arc that fits is taken: at 1.1 m and full turning rate the robot need not slow down.
constexpr std::array<double, 6> kRadii_m{1.1, 0.9, 0.7, 0.5, 0.35, 0.25};
/// Half the robot's width, and a hand's breadth.
constexpr double kMinClearance_m = 0.33;
/// Sharper turns are made on the spot, as a walker would.
constexpr double kMaxArc_rad = 2.3;
/// Below it a corner is left to the spline.
constexpr double kStraight_rad = 0.01;
/// Legs shorter than this have no direction worth turning to.
constexpr double kMinLeg_m = 0.03;

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * M_PI); }

struct Corner {
  double turn_rad = 0.0;
  double radius_m = 0.0;  ///< 0: on the spot, or straight on.

  double trim_m() const { return radius_m * std::tan(0.5 * std::abs(turn_rad)); }
  bool onTheSpot() const { return radius_m == 0.0 && std::abs(turn_rad) > kStraight_rad; }
};

Route withoutRepetitions(const Route& route) {
  Route result{route.front()};
  for (const RoutePoint& point : route) {
    const double leg_m = (point.floor_map - result.back().floor_map).head<2>().norm();
    if (leg_m > kMinLeg_m) result.push_back(point);
  }
  return result;
}

class CornerRounder {
 public:
  CornerRounder(const Route& route, const std::vector<FloorPlan>& plans, const MotionLimits& limits)
      : route_(withoutRepetitions(route)), plans_(plans), limits_(limits) {}

  std::vector<Path> paths() {
    if (route_.size() < 2) return {{{route_.front().floor_map, 0.0, 0.0}}};
    yaw_rad_ = headingOf(0);
    paths_.emplace_back();
    Corner corner;
    for (size_t leg = 0; leg + 1 < route_.size(); ++leg) {
      const Corner next = leg + 2 < route_.size() ? cornerAfter(leg) : Corner{};
      addLeg(leg, corner.trim_m(), next.trim_m());
      addCorner(leg, next);
      corner = next;
    }
    return std::move(paths_);
  }

 private:
  Eigen::Vector2d at(size_t k) const { return route_[k].floor_map.head<2>(); }
  double lengthOf(size_t leg) const { return (at(leg + 1) - at(leg)).norm(); }
  Eigen::Vector2d alongOf(size_t leg) const { return (at(leg + 1) - at(leg)).normalized(); }
  double headingOf(size_t leg) const {
    const Eigen::Vector2d along = alongOf(leg);
    return std::atan2(along.y(), along.x());
  }

  Corner cornerAfter(size_t leg) const {
    Corner corner;
    corner.turn_rad = wrapped(headingOf(leg + 1) - headingOf(leg));
    if (std::abs(corner.turn_rad) < kStraight_rad) return corner;
    if (std::abs(corner.turn_rad) > kMaxArc_rad) return corner;
    for (const double radius_m : kRadii_m) {
      corner.radius_m = radius_m;
      const double room_m = 0.5 * std::min(lengthOf(leg), lengthOf(leg + 1));
      if (corner.trim_m() <= room_m && isClear(leg, corner)) return corner;
    }
    corner.radius_m = 0.0;
    return corner;
  }

  /// The arc's points from its first tangent point on, at fractions of its sweep.
  Eigen::Vector2d onArc(size_t leg, const Corner& corner, double fraction) const {
    const Eigen::Vector2d along = alongOf(leg);
    const Eigen::Vector2d begin = at(leg + 1) - corner.trim_m() * along;
    const double angle = fraction * std::abs(corner.turn_rad);
    const Eigen::Vector2d aside = std::copysign(1.0, corner.turn_rad) * leftOf(along);
    return begin + corner.radius_m * (std::sin(angle) * along + (1.0 - std::cos(angle)) * aside);
  }

  bool isClear(size_t leg, const Corner& corner) const {
    constexpr int kChecks = 16;  // an arc of 1.1 m radius every 16 cm or less
    const FloorPlan& plan = plans_[route_[leg + 1].storey];
    for (int k = 0; k <= kChecks; ++k) {
      const double fraction = static_cast<double>(k) / kChecks;
      if (plan.clearance(onArc(leg, corner, fraction)) < kMinClearance_m) return false;
    }
    return true;
  }

  void addLeg(size_t leg, double begin_m, double end_trim_m) {
    const double length_m = lengthOf(leg);
    const double span_m = length_m - begin_m - end_trim_m;
    const Eigen::Vector3d step = route_[leg + 1].floor_map - route_[leg].floor_map;
    const double speed = route_[leg + 1].by_stairs ? limits_.stairs_m_s : limits_.walking_m_s;
    const int samples = std::max(1, static_cast<int>(std::ceil(span_m / kSpacing_m)));
    for (int k = 0; k <= samples; ++k) {
      const double s = (begin_m + span_m * k / samples) / length_m;
      paths_.back().push_back({route_[leg].floor_map + s * step, yaw_rad_, speed});
    }
  }

  void addCorner(size_t leg, const Corner& corner) {
    const double yaw_rad = yaw_rad_;
    yaw_rad_ += corner.turn_rad;
    if (corner.onTheSpot()) {
      paths_.emplace_back();
      return;
    }
    const double speed = std::min(limits_.walking_m_s, limits_.turning_rad_s * corner.radius_m);
    const double length_m = corner.radius_m * std::abs(corner.turn_rad);
    const int samples = static_cast<int>(std::ceil(length_m / kSpacing_m));
    for (int k = 1; k < samples; ++k) {
      const double fraction = static_cast<double>(k) / samples;
      const Eigen::Vector2d p = onArc(leg, corner, fraction);
      paths_.back().push_back({{p.x(), p.y(), route_[leg + 1].floor_map.z()},
                               yaw_rad + fraction * corner.turn_rad,
                               speed});
    }
  }

  Route route_;
  const std::vector<FloorPlan>& plans_;
  const MotionLimits& limits_;
  std::vector<Path> paths_;
  double yaw_rad_ = 0.0;
};

}  // namespace

std::vector<Path> roundCorners(const Route& route, const std::vector<FloorPlan>& plans,
                               const MotionLimits& limits) {
  return CornerRounder(route, plans, limits).paths();
}

}  // namespace mrpt_sgraphs::sim
