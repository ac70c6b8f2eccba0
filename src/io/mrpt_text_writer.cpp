// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/io/mrpt_network.h"

namespace mrpt_sgraphs {
namespace {

/// ` x y z roll pitch yaw`. Near the pole yaw and roll are not defined well, each for itself; pitch
/// and roll are those of the rotation that is left when just this yaw is taken off, so that the
/// three together give the rotation to rounding error.
void writePose(const mrpt::poses::CPose3D& pose, std::ostream* out) {
  const Pose T = fromMrpt(pose);
  const double yaw = std::atan2(T.linear()(1, 0), T.linear()(0, 0));
  const Eigen::Matrix3d left =
      Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * T.linear();
  const double pitch = std::atan2(-left(2, 0), left(0, 0));
  const double roll = std::atan2(-left(1, 2), left(1, 1));
  for (const double value : {pose.x(), pose.y(), pose.z(), roll, pitch, yaw}) *out << ' ' << value;
}

/// The upper triangle in the order x y z roll pitch yaw.
void writeInformation(const mrpt::math::CMatrixDouble66& information, std::ostream* out) {
  constexpr int kOrder[6] = {0, 1, 2, 5, 4, 3};
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      *out << ' ' << information(kOrder[row], kOrder[column]);
    }
  }
}

}  // namespace

void writeMrptText(const std::string& path, const MrptNetwork& network) {
  const std::string fault = faultOf(network);
  if (!fault.empty()) throw std::invalid_argument(fault);
  if (network.edges_store_inverse_poses) {
    throw std::invalid_argument("the edges of the network store inverse poses");
  }

  AtomicFile file(path);
  std::ostream& out = file.stream();
  out.precision(std::numeric_limits<double>::max_digits10);
  for (const auto& [id, pose] : network.nodes) {
    out << "VERTEX3 " << id;
    writePose(pose, &out);
    out << '\n';
    if (id == network.root) out << "FIX " << id << '\n';
  }
  for (const auto& [ends, edge] : network.edges) {
    out << "EDGE3 " << ends.first << ' ' << ends.second;
    writePose(edge.mean, &out);
    writeInformation(edge.cov_inv, &out);
    out << '\n';
  }
  file.commit();
}

}  // namespace mrpt_sgraphs
