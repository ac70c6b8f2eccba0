// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/plane_frame.h"

#include <algorithm>
#include <cstddef>

namespace mrpt_sgraphs {
namespace {

/// By how often a ray along u meets the ring.
bool isWithin(const Outline2& ring, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d& a = ring[k];
    const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double u = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < u) inside = !inside;
  }
  return inside;
}

}  // namespace

bool contains(const FlatExtent& extent, const Eigen::Vector2d& point) {
  return isWithin(extent.outline, point) &&
         std::none_of(extent.holes.begin(), extent.holes.end(),
                      [&point](const Outline2& hole) { return isWithin(hole, point); });
}

FlatExtent flattened(const PlanarExtent& extent, const PlaneFrame& frame) {
  const auto flat = [&frame](const Outline3& ring) {
    Outline2 result;
    result.reserve(ring.size());
    for (const Eigen::Vector3d& corner : ring) result.push_back(frame.flat(corner));
    return result;
  };
  FlatExtent result{flat(extent.outline), {}};
  for (const Outline3& hole : extent.holes) result.holes.push_back(flat(hole));
  return result;
}

PlanarExtent lifted(const FlatExtent& extent, const PlaneFrame& frame) {
  const auto lift = [&frame](const Outline2& ring) {
    Outline3 result;
    result.reserve(ring.size());
    for (const Eigen::Vector2d& corner : ring) result.push_back(frame.lifted(corner));
    return result;
  };
  PlanarExtent result{lift(extent.outline), {}};
  for (const Outline2& hole : extent.holes) result.holes.push_back(lift(hole));
  return result;
}

}  // namespace mrpt_sgraphs
