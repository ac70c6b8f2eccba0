// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sample_files.h"

#include <fstream>
#include <iomanip>
#include <iterator>
#include <memory>
#include <sstream>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/mrpt_network.h"
#include "random_graph.h"
#include "support/mrpt_networks.h"

namespace mrpt_sgraphs::test {
namespace {

void writePose(const Pose& T, std::ostream* out) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  for (const double x : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) *out << ' ' << x;
}

void writePlane(const Plane& plane, std::ostream* out) {
  for (const double x : {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.distance}) {
    *out << ' ' << x;
  }
}

Pose noise(Dice* dice) {
  Tangent delta;
  delta << dice->vector(0.05), dice->vector(0.02);
  return expPose(delta);
}

MrptNetwork sampleNetwork(Dice* dice) {
  return circlingWalk(static_cast<unsigned>(dice->below(100)),
                      2 + static_cast<int>(dice->below(16)));
}

std::string contentsOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::string sampleSg(Dice* dice) {
  constexpr double kHalf_m = 4.0;
  std::vector<Pose> poses{Pose::Identity()};
  for (std::size_t k = dice->below(10); k > 0; --k) {
    Tangent step;
    step << 0.5, 0.0, 0.0, 0.0, 0.0, 0.3;
    poses.push_back(poses.back() * expPose(step) * noise(dice));
  }
  std::vector<Plane> walls;  // their normals out of the room, as the format has it
  for (int w = 0; w < 4; ++w) walls.push_back({expSO3({0.0, 0.0, M_PI_2 * w}).col(0), kHalf_m});

  std::ostringstream out;
  out << "# a room\n" << std::setprecision(10);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    out << "POSE " << k << " 0 0 0";
    writePose(poses[k] * noise(dice), &out);
    out << '\n';
  }
  for (std::size_t w = 0; w < walls.size(); ++w) {
    out << "PLANE " << w;
    writePlane(walls[w], &out);
    out << '\n';
  }
  out << "ROOM 0 0 0 0 0 1 2 3\nFLOOR 0 0 0\nGTROOM 0 0 0\n";
  for (std::size_t k = 1; k < poses.size(); ++k) {
    out << (k % 5 == 0 ? "LOOP " : "ODOM ") << k - 1 << ' ' << k;
    writePose(poses[k - 1].inverse() * poses[k] * noise(dice), &out);
    out << " 0.02 0.004\n";
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
      out << "OBS " << k << ' ' << w;
      writePlane(inverseTimes(poses[k] * noise(dice), walls[w]), &out);
      out << " 0.01 0.02\n";
    }
  }
  out << "ROOMF 0 0.05\nFLOORF 0 0 0 0 0.5\n";
  return out.str();
}

std::string sampleG2o(Dice* dice) {
  LayeredGraph graph;
  std::vector<KeyframeId> keyframes;
  const std::size_t count = 1 + dice->below(12);
  Pose T = Pose::Identity();
  for (std::size_t k = 0; k < count; ++k) {
    keyframes.push_back(graph.addKeyframe(T, {}));
    T = T * dice->pose(1.0);
  }
  for (std::size_t k = 1; k < 2 * count - 1; ++k) {
    const std::size_t from = k < count ? k - 1 : dice->below(count);
    const std::size_t to = k < count ? k : dice->below(count);
    if (from == to) continue;
    const Pose measured =
        graph.pose(keyframes[from]).inverse() * graph.pose(keyframes[to]) * noise(dice);
    Tangent weights;
    weights << 2500.0, 2500.0, 2500.0, 4e4, 4e4, 1e4;
    graph.addFactor(std::make_shared<RelativePoseFactor>(keyframes[from], keyframes[to], measured,
                                                         weights.asDiagonal().toDenseMatrix()));
  }
  std::ostringstream out;
  writeG2o(*graph.snapshot(), out);
  return out.str();
}

std::string sampleJson(Dice* dice) {
  const RandomGraph made = randomGraph(0.0, dice);
  LayeredGraph graph;
  std::size_t left = 15;  // a file of kilobytes
  for (const RandomGraph::Node& node : made.nodes) {
    if (left-- == 0) break;
    const uint64_t id = node.id.value;
    if (graph.contains(node.id)) continue;
    const Layer layer = node.id.layer;
    if (layer == Layer::kKeyframe) graph.restoreKeyframe({id}, std::get<Pose>(node.value), {});
    if (layer == Layer::kRoom) graph.restoreRoom({id}, std::get<Pose>(node.value), {});
    if (layer == Layer::kWall) graph.restoreWall({id}, std::get<Plane>(node.value), {});
    if (layer == Layer::kFloor) graph.restoreFloor({id}, std::get<Plane>(node.value), {});
  }
  for (const FactorConstPtr& factor : made.factors) {
    try {
      graph.addFactor(factor);
    } catch (const std::invalid_argument&) {  // of a node that is not there, or twice
    }
  }
  std::ostringstream out;
  writeGraphJson(*graph.snapshot(), out);
  return out.str();
}

std::string sampleMrptText(const std::string& folder, Dice* dice) {
  writeMrptText(folder + "/sample.graph", sampleNetwork(dice));
  return contentsOf(folder + "/sample.graph");
}

std::string sampleMrptBinary(const std::string& folder, Dice* dice) {
  writeMrptBinary(folder + "/sample.bin", sampleNetwork(dice));
  return contentsOf(folder + "/sample.bin");
}

}  // namespace mrpt_sgraphs::test
