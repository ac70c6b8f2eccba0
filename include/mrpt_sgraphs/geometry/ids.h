// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace mrpt_sgraphs {

/// An id of one layer. Ids of two layers do not mix, and no id is ever given twice.
template <typename Layer>
struct Id {
  uint64_t value = 0;

  friend bool operator==(Id a, Id b) { return a.value == b.value; }
  friend bool operator!=(Id a, Id b) { return a.value != b.value; }
  friend bool operator<(Id a, Id b) { return a.value < b.value; }
};

using KeyframeId = Id<struct KeyframeLayer>;
using WallId = Id<struct WallLayer>;
using RoomId = Id<struct RoomLayer>;
using FloorId = Id<struct FloorLayer>;
using FactorId = Id<struct FactorTag>;

/// The layers of the graph, from below (the paper, Fig. 1).
enum class Layer : uint8_t { kKeyframe, kWall, kRoom, kFloor };

/// A node of any layer: what factors connect.
struct NodeId {
  Layer layer = Layer::kKeyframe;
  uint64_t value = 0;

  NodeId() = default;
  NodeId(KeyframeId id) : layer(Layer::kKeyframe), value(id.value) {}
  NodeId(WallId id) : layer(Layer::kWall), value(id.value) {}
  NodeId(RoomId id) : layer(Layer::kRoom), value(id.value) {}
  NodeId(FloorId id) : layer(Layer::kFloor), value(id.value) {}

  friend bool operator==(NodeId a, NodeId b) { return a.layer == b.layer && a.value == b.value; }
  friend bool operator!=(NodeId a, NodeId b) { return !(a == b); }
  friend bool operator<(NodeId a, NodeId b) {
    return a.layer != b.layer ? a.layer < b.layer : a.value < b.value;
  }
};

/// As reports and errors name a node: "keyframe 12".
inline std::string nameOf(NodeId node) {
  constexpr const char* kNames[] = {"keyframe", "wall", "room", "floor"};
  return kNames[static_cast<int>(node.layer)] + (" " + std::to_string(node.value));
}

}  // namespace mrpt_sgraphs

template <typename Layer>
struct std::hash<mrpt_sgraphs::Id<Layer>> {
  std::size_t operator()(mrpt_sgraphs::Id<Layer> id) const noexcept {
    return std::hash<uint64_t>{}(id.value);
  }
};

template <>
struct std::hash<mrpt_sgraphs::NodeId> {
  std::size_t operator()(mrpt_sgraphs::NodeId id) const noexcept {
    return std::hash<uint64_t>{}((id.value << 2U) | static_cast<uint64_t>(id.layer));
  }
};
