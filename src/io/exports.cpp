// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/exports.h"

#include <Eigen/Geometry>
#include <iomanip>
#include <vector>

#include "pose_graph.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kAllDigits = 17;  ///< A double comes back as it was.

void writePose(const Pose& T, std::ostream& out) {
  const Eigen::Quaterniond q(T.linear());
  out << T.translation().transpose() << ' ' << q.coeffs().transpose();
}

}  // namespace

void writeG2o(const GraphSnapshot& graph, std::ostream& out) {
  out << std::setprecision(kAllDigits);
  for (const KeyframeNode& keyframe : graph.keyframes) {
    out << "VERTEX_SE3:QUAT " << keyframe.id.value << ' ';
    writePose(keyframe.T_map_base, out);
    out << '\n';
  }
  if (!graph.keyframes.empty()) out << "FIX " << graph.keyframes.front().id.value << '\n';
  Tangent scale;
  scale << 1.0, 1.0, 1.0, 2.0, 2.0, 2.0;
  for (const PoseEdge& edge : poseGraph(graph)) {
    out << "EDGE_SE3:QUAT " << edge.from.value << ' ' << edge.to.value << ' ';
    writePose(edge.T_from_to, out);
    const Matrix6 information = scale.asDiagonal() * edge.information * scale.asDiagonal();
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column) out << ' ' << information(row, column);
    }
    out << '\n';
  }
}

void writePcd(const Cloud& cloud, std::ostream& out) {
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\n"
         "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
      << cloud.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud.size()
      << "\nDATA binary\n";
  std::vector<float> values;
  values.reserve(4 * cloud.size());
  for (const Point& p : cloud) values.insert(values.end(), {p.x, p.y, p.z, p.intensity});
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
}

}  // namespace mrpt_sgraphs
