// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

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
