// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <unordered_map>

#include "mrpt_sgraphs/graph/snapshot.h"

namespace mrpt_sgraphs {

/// The ground of a room: level, through its centre.
inline Plane groundOf(const RoomNode& room) {
  const Eigen::Vector3d up = room.T_map_room.linear().col(2);
  return {up, up.dot(room.T_map_room.translation())};
}

/// Where the nodes of a graph are shown, in `map`: keyframes where they are, walls at the middle of
/// their extents, rooms and floors above their centres; each layer a lift above the one below.
class ShownPlaces {
 public:
  ShownPlaces(const GraphSnapshot& graph, double layer_lift_m);

  /// Null for a node that is not in the graph.
  const Eigen::Vector3d* find(NodeId node) const {
    const auto found = places_.find(node);
    return found == places_.end() ? nullptr : &found->second;
  }

  /// Where what belongs to a layer is shown.
  Eigen::Vector3d lifted(const Eigen::Vector3d& point_map, Layer layer) const {
    return point_map + static_cast<double>(layer) * layer_lift_m_ * Eigen::Vector3d::UnitZ();
  }

 private:
  void add(NodeId node, const Eigen::Vector3d& place_map) {
    places_[node] = lifted(place_map, node.layer);
  }

  double layer_lift_m_;
  std::unordered_map<NodeId, Eigen::Vector3d> places_;
};

}  // namespace mrpt_sgraphs
