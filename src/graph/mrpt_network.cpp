// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/graph/mrpt_network.h"

namespace mrpt_sgraphs {
namespace {

/// Of R'R from identity: more than what rounding in six decimal digits does to a rotation.
constexpr double kMaxRotationError = 1e-4;

/// Of an information from its transpose, relative to its largest entry.
constexpr double kMaxAsymmetry = 1e-9;

std::string faultOf(const mrpt::poses::CPose3D& pose) {
  const Pose T = fromMrpt(pose);
  if (!T.matrix().allFinite()) return "its pose is not finite";
  const Eigen::Matrix3d R = T.linear();
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kMaxRotationError) || R.col(0).cross(R.col(1)).dot(R.col(2)) < 0.0) {
    return "its pose has no rotation matrix";
  }
  return "";
}

std::string faultOf(const Matrix6& information) {
  if (!information.allFinite()) return "its information is not finite";
  const double asymmetry = (information - information.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > kMaxAsymmetry * information.cwiseAbs().maxCoeff()) {
    return "its information is not symmetric";
  }
  return "";
}

}  // namespace

mrpt::poses::CPose3D toMrpt(const Pose& T) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(T.matrix()));
}

Pose fromMrpt(const mrpt::poses::CPose3D& pose) {
  Pose T = Pose::Identity();
  T.linear() = pose.getRotationMatrix().asEigen();
  T.translation() << pose.x(), pose.y(), pose.z();
  return T;
}

std::string nameOf(const mrpt::graphs::TPairNodeIDs& edge) {
  return "edge " + std::to_string(edge.first) + " -> " + std::to_string(edge.second);
}

std::string faultOf(const MrptNetwork& network) {
  for (const auto& [id, pose] : network.nodes) {
    const std::string fault = faultOf(static_cast<const mrpt::poses::CPose3D&>(pose));
    if (!fault.empty()) return "node " + std::to_string(id) + ": " + fault;
  }
  for (const auto& [ends, edge] : network.edges) {
    if (ends.first == ends.second) return nameOf(ends) + ": it ends where it begins";
    for (const mrpt::graphs::TNodeID end : {ends.first, ends.second}) {
      if (!network.nodes.empty() && network.nodes.count(end) == 0) {
        return nameOf(ends) + ": there is no node " + std::to_string(end);
      }
    }
    std::string fault = faultOf(edge.mean);
    if (fault.empty()) fault = faultOf(Matrix6(edge.cov_inv.asEigen()));
    if (!fault.empty()) return nameOf(ends) + ": " + fault;
  }
  return "";
}

}  // namespace mrpt_sgraphs
