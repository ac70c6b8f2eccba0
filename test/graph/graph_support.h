// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/graph/layered_graph.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {

inline KeyframeAttributes stamped(double stamp_s) {
  KeyframeAttributes attributes;
  attributes.stamp_s = stamp_s;
  return attributes;
}

inline Plane randomPlane(RandomGeometry* random) {
  return {random->vector(1.0).normalized(), random->number(10.0)};
}

inline Matrix6 randomInformation(RandomGeometry* random) {
  Matrix6 root;
  for (int k = 0; k < 36; ++k) root(k) = random->number(10.0);
  return root * root.transpose() + Matrix6::Identity();
}

inline FactorConstPtr odometry(NodeId from, NodeId to, const Pose& T_from_to = Pose::Identity(),
                               const Matrix6& information = Matrix6::Identity()) {
  return std::make_shared<RelativePoseFactor>(from, to, T_from_to, information);
}

inline FactorConstPtr sight(KeyframeId keyframe, NodeId surface, const Plane& measured_base = {}) {
  return std::make_shared<PlaneObservationFactor>(keyframe, surface, measured_base,
                                                  Eigen::Matrix3d::Identity());
}

}  // namespace mrpt_sgraphs::test
