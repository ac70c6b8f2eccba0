// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_cuts.h"

#include <algorithm>
#include <cmath>

namespace mrpt_sgraphs {
namespace {

/// Planes that meet at less than 30 degrees do not cross.
constexpr double kMaxCosine = 0.87;
/// Next to a crossing: nearer than the first, points may belong to either plane; farther than the
/// second begins the room behind a thin wall [m].
constexpr double kNear_m = 0.04;
constexpr double kFar_m = 0.13;
/// So few of the points next to it lie behind what is solid.
constexpr double kMaxShareBehind = 0.15;
constexpr int kEnough = 10;
/// What crosses stands out from the plane by this: more than a pillar, a cabinet [m].
constexpr double kMinReach_m = 1.0;

/// A box about points, along u and v.
struct Box {
  Eigen::Array2f low;
  Eigen::Array2f high;

  explicit Box(const std::vector<Eigen::Vector3f>& local) {
    low = high = local.front().head<2>().array();
    for (const Eigen::Vector3f& p : local) {
      low = low.min(p.head<2>().array());
      high = high.max(p.head<2>().array());
    }
  }

  /// Whether some of it lies on either side of a line.
  bool isOnBothSides(const Crossing& crossing) const {
    const Eigen::Array2f middle = 0.5F * (low + high);
    const Eigen::Array2f half = 0.5F * (high - low);
    const float reach = (crossing.normal.array().abs() * half).sum();
    const float offset = crossing.normal.dot(middle.matrix()) - crossing.distance;
    return std::abs(offset) < reach - static_cast<float>(kFar_m);
  }
};

/// Whether the plane begins in front of the crossing and does not go on behind it.
bool endsAt(const Crossing& crossing, const std::vector<Eigen::Vector3f>& local) {
  constexpr std::size_t kSamples = 2000;
  const std::size_t stride = local.size() / kSamples + 1;
  int in_front = 0, behind = 0, next_in_front = 0, next_behind = 0;
  for (std::size_t k = 0; k < local.size(); k += stride) {
    const float side = crossing.side(local[k].head<2>());
    ++(side > 0.0F ? in_front : behind);
    const float far = std::abs(side);
    if (far > kNear_m && far < kFar_m) ++(side > 0.0F ? next_in_front : next_behind);
  }
  return in_front >= kEnough && behind >= kEnough && next_in_front >= kEnough &&
         next_behind < kMaxShareBehind * next_in_front;
}

/// Whether a plane stands out from another one, from where they meet on.
bool standsOn(const Plane& plane, const PlanePoints& crossing) {
  constexpr double kFoot_m = 0.4;
  int foot = 0, beyond = 0;
  const Eigen::Vector3d axis(crossing.frame.u.dot(plane.normal), crossing.frame.v.dot(plane.normal),
                             crossing.frame.normal.dot(plane.normal));
  const Eigen::Vector3f axis_local = axis.cast<float>();
  const float origin_m =
      static_cast<float>(plane.normal.dot(crossing.frame.origin) - plane.distance);
  constexpr std::size_t kSamples = 500;
  const std::size_t stride = crossing.local.size() / kSamples + 1;
  for (std::size_t k = 0; k < crossing.local.size(); k += stride) {
    const float height_m = origin_m + axis_local.dot(crossing.local[k]);
    if (height_m > kNear_m && height_m < kFoot_m) ++foot;
    if (height_m > kMinReach_m) ++beyond;
  }
  return foot >= kEnough && beyond >= kEnough;
}

/// What lies behind the crossing, taken away from the plane.
PlanePoints takeBehind(const Crossing& crossing, PlanePoints* points) {
  PlanePoints behind{points->frame, points->sigma_m, {}, {}};
  std::size_t kept = 0;
  for (std::size_t k = 0; k < points->local.size(); ++k) {
    if (crossing.side(points->local[k].head<2>()) < 0.0F) {
      behind.local.push_back(points->local[k]);
      behind.indices.push_back(points->indices[k]);
      continue;
    }
    points->local[kept] = points->local[k];
    points->indices[kept] = points->indices[k];
    ++kept;
  }
  points->local.resize(kept);
  points->indices.resize(kept);
  return behind;
}

}  // namespace

std::optional<Crossing> crossingOf(const PlaneFrame& frame, const Plane& other) {
  if (std::abs(frame.normal.dot(other.normal)) > kMaxCosine) return std::nullopt;
  const Eigen::Vector2d direction(other.normal.dot(frame.u), other.normal.dot(frame.v));
  const double length = direction.norm();
  const double distance = other.distance - other.normal.dot(frame.origin);
  return Crossing{(direction / length).cast<float>(), static_cast<float>(distance / length)};
}

void cutAtCrossings(int min_points, std::vector<PlaneCandidate>* planes) {
  // what was cut off comes at the end and is looked at in its turn
  for (std::size_t k = 0; k < planes->size(); ++k) {
    const Box box((*planes)[k].points.local);
    for (std::size_t other = 0; other < planes->size(); ++other) {
      const PlaneCandidate& crossing_plane = (*planes)[other];
      const auto crossing = crossingOf((*planes)[k].points.frame, crossing_plane.measured.plane);
      if (!crossing || !box.isOnBothSides(*crossing)) continue;
      PlaneCandidate& plane = (*planes)[k];
      if (!standsOn(plane.measured.plane, crossing_plane.points) ||
          !endsAt(*crossing, plane.points.local)) {
        continue;
      }
      PlanePoints behind = takeBehind(*crossing, &plane.points);
      plane.measured = measurePlane(&plane.points);
      const MeasuredPlane measured_behind = measurePlane(&behind);
      if (static_cast<int>(behind.local.size()) < min_points) continue;
      planes->push_back({std::move(behind), measured_behind});
    }
  }
}

}  // namespace mrpt_sgraphs
