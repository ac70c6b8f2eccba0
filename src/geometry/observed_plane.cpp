// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/geometry/observed_plane.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace mrpt_sgraphs {
namespace {

bool allFinite(const Outline3& outline) {
  return std::all_of(outline.begin(), outline.end(),
                     [](const Eigen::Vector3d& corner) { return corner.allFinite(); });
}

}  // namespace

bool isSound(const ObservedPlane& plane) {
  const std::vector<Outline3>& holes = plane.extent_base.holes;
  return isSound(plane.plane_base) && plane.centroid_base.allFinite() &&
         allFinite(plane.extent_base.outline) &&
         std::all_of(holes.begin(), holes.end(), allFinite) && plane.covariance.allFinite() &&
         plane.covariance.llt().info() == Eigen::Success;
}

}  // namespace mrpt_sgraphs
