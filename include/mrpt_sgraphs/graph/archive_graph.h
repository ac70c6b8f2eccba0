// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/geometry/archive_geometry.h"
#include "mrpt_sgraphs/graph/factor_shelf.h"
#include "mrpt_sgraphs/graph/nodes.h"
#include "mrpt_sgraphs/graph/shared_vector.h"
#include "mrpt_sgraphs/graph/snapshot.h"
#include "mrpt_sgraphs/graph/topology.h"

namespace mrpt_sgraphs {

/// Factors do not change: what their constructors take is written, and they are made again of it.
/// @throws std::invalid_argument for a factor that no graph has.
void part(ArchiveWriter& a, FactorConstPtr& factor);
void part(ArchiveReader& a, FactorConstPtr& factor);

template <typename Archive, typename T, std::size_t kChunk>
void part(Archive& a, SharedVector<T, kChunk>& list) {
  const std::size_t size = a.count(list.size());
  if constexpr (Archive::kReads) {
    list = {};
    for (std::size_t k = 0; k < size; ++k) {
      T element{};
      a.item(element);
      list.push_back(std::move(element));
    }
  } else {
    for (const T& element : list) a.item(element);
  }
}

template <typename Archive>
void part(Archive& a, KeyframeAttributes& keyframe) {
  a("stamp_s", keyframe.stamp_s);
  a("T_odom_base", keyframe.T_odom_base);
  a("cloud", keyframe.cloud);
  a("planes", keyframe.planes);
  a("floor", keyframe.floor);
  a("room", keyframe.room);
  a("marginalized", keyframe.marginalized);
  a("representative", keyframe.representative);
}

template <typename Archive>
void part(Archive& a, WallAttributes& wall) {
  a("extent_map", wall.extent_map);
  a("floor", wall.floor);
}

template <typename Archive>
void part(Archive& a, Doorway& doorway) {
  a.item(doorway.to);
  a.item(doorway.centre_map);
  a.item(doorway.width_m);
}

template <typename Archive>
void part(Archive& a, RoomAttributes& room) {
  a("kind", room.kind);
  a("walls", room.walls);
  a("floor", room.floor);
  a("size_m", room.size_m);
  a("name", room.name);
  a("extent_map", room.extent_map);
  a("height_m", room.height_m);
  a("doorways", room.doorways);
}

template <typename Archive>
void part(Archive& a, FloorConnection& connection) {
  a.item(connection.to);
  a.item(connection.here_map);
  a.item(connection.there_map);
}

template <typename Archive>
void part(Archive& a, FloorAttributes& floor) {
  a("centre_map", floor.centre_map);
  a("name", floor.name);
  a("connections", floor.connections);
}

template <typename Archive>
void part(Archive& a, KeyframeNode& node) {
  a("id", node.id);
  a("T_map_base", node.T_map_base);
  part(a, static_cast<KeyframeAttributes&>(node));
}

template <typename Archive>
void part(Archive& a, WallNode& node) {
  a("id", node.id);
  a("plane_map", node.plane_map);
  part(a, static_cast<WallAttributes&>(node));
}

template <typename Archive>
void part(Archive& a, RoomNode& node) {
  a("id", node.id);
  a("T_map_room", node.T_map_room);
  part(a, static_cast<RoomAttributes&>(node));
}

template <typename Archive>
void part(Archive& a, FloorNode& node) {
  a("id", node.id);
  a("ground_map", node.ground_map);
  part(a, static_cast<FloorAttributes&>(node));
}

template <typename Archive>
void part(Archive& a, StoredFactor& stored) {
  a("id", stored.id);
  a("factor", stored.factor);
}

template <typename Archive>
void part(Archive& a, ShelvedFactor& shelved) {
  a("id", shelved.id);
  a("factor", shelved.factor);
  a("kept", shelved.kept);
}

template <typename Archive>
void part(Archive& a, NodeHandle& handle) {
  a.item(handle.layer);
  a.item(handle.slot);
}

template <typename Archive>
void part(Archive& a, FactorLink& link) {
  a.item(link.id);
  a.item(link.slot);
  a.item(link.end);
}

template <typename Archive>
void part(Archive& a, FactorEnd& end) {
  a.item(end.node);
  a.item(end.position);
}

template <typename Archive>
void part(Archive& a, Topology::Ends& ends) {
  ends.resize(a.count(ends.size()));
  for (FactorEnd& end : ends) a.item(end);
}

template <typename Archive>
void part(Archive& a, ObservationSum& sum) {
  a.item(sum.A);
  a.item(sum.b);
  a.item(sum.c);
  a.item(sum.point_map);
  a.item(sum.reference_point);
}

}  // namespace mrpt_sgraphs
