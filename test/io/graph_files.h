// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mrpt_sgraphs/io/graph_formats.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs::test {

/// Three keyframes on a line, a loop between the ends, the first of them fixed.
constexpr const char* kSmallG2o =
    "VERTEX_SE3:QUAT 3 0 0 0 0 0 0 1\n"
    "VERTEX_SE3:QUAT 5 1.1 0 0 0 0 0 1\n"
    "VERTEX_SE3:QUAT 7 2.3 0 0.1 0 0 0.1 0.99\n"
    "FIX 3\n"
    "EDGE_SE3:QUAT 3 5 1 0 0 0 0 0 1 "
    "100 0 0 0 0 0 100 0 0 0 0 100 0 0 0 400 0 0 400 0 400\n"
    "EDGE_SE3:QUAT 5 7 1 0 0 0 0 0 1 "
    "100 0 0 0 0 0 100 0 0 0 0 100 0 0 0 400 0 0 400 0 400\n"
    "EDGE_SE3:QUAT 3 7 2.03 0 0 0 0 0 1 "
    "100 1 0 0 0 0 100 0 0 0 0 100 0 0 0 400 0 2 400 0 400\n";

/// A keyframe and a half of a room: two keyframes see two of its walls; normals point out of it.
constexpr const char* kSmallSg =
    "# a comment\n"
    "POSE 0 0 1 0  0 0 0.5  0 0 0 1\n"
    "GTPOSE 0 0 0 0.5 0 0 0 1\n"
    "POSE 1 0 -1 0  1.1 0 0.5  0 0 0 1\n"
    "PLANE 4 1 0 0 3\n"
    "PLANE 5 -1 0 0 2\n"
    "PLANE 6 0 1 0 2.5\n"
    "PLANE 7 0 -1 0 2.5\n"
    "ROOM 1 0 0.5 0 4 5 6 7\n"
    "FLOOR 0 0.5 0\n"
    "ODOM 0 1 1 0 0 0 0 0 1 0.02 0.003\n"
    "LOOP 1 0 -1 0 0 0 0 0 1 0.03 0.005\n"
    "OBS 0 4 1 0 0 3.01 0.01 0.02\n"
    "OBS 1 4 1 0 0 2.02 0.01 0.02\n"
    "OBS 1 6 0 1 0 2.5 0.01 0.02\n"
    "ROOMF 1 0.05\n"
    "FLOORF 0 1 0 0 0.5\n";

constexpr const char* kSmallJson = R"({"format": "mrpt_sgraphs/graph", "version": 1,
 "map_odom": [0, 0, 0, 0, 0, 0, 1], "walls": [], "rooms": [], "floors": [],
 "keyframes": [
  {"id": 0, "stamp": 1.0, "pose": [0, 0, 0, 0, 0, 0, 1], "odometry": [0, 0, 0, 0, 0, 0, 1],
   "floor": null, "room": null, "marginalized": false, "representative": 0},
  {"id": 2, "stamp": 2.0, "pose": [1.2, 0, 0, 0, 0, 0, 1], "odometry": [1, 0, 0, 0, 0, 0, 1],
   "floor": null, "room": null, "marginalized": false, "representative": 2}],
 "factors": [
  {"type": "odometry", "nodes": [{"keyframe": 0}, {"keyframe": 2}],
   "measurement": [1, 0, 0, 0, 0, 0, 1],
   "information": [100, 0, 0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 0, 400, 0, 0, 400, 0, 400]},
  {"type": "loop_closure", "nodes": [{"keyframe": 2}, {"keyframe": 0}],
   "measurement": [-1.1, 0, 0, 0, 0, 0, 1],
   "information": [100, 0, 0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0, 0, 400, 0, 0, 400, 0, 400]}]})";

/// `text` with its first `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no '" + from + "' to replace");
  return text.replace(at, from.size(), to);
}

/// What reading a file of this text throws.
inline std::string errorOf(const TemporaryFolder& folder, const std::string& name,
                           const std::string& text) {
  const std::string path = folder.write(name, text);
  return messageOf<FileError>([&] { readGraphFile(path); });
}

#define EXPECT_SAYS(message, text) \
  EXPECT_NE((message).find(text), std::string::npos) << "it says: " << (message)

/// The cost of a factor at the values of a file.
inline double costOf(const Factor& factor, const GraphFile& graph) {
  const auto view = [&](NodeId node) {
    for (const auto& keyframe : graph.keyframes) {
      if (node == NodeId(keyframe.id)) return VariableView(keyframe.T_map_base);
    }
    for (const auto& wall : graph.walls) {
      if (node == NodeId(wall.id)) return VariableView(wall.plane_map);
    }
    throw std::logic_error("no " + nameOf(node));
  };
  const VariableView values[] = {view(factor.node(0)), view(factor.node(1))};
  return factor.cost(values);
}

}  // namespace mrpt_sgraphs::test
