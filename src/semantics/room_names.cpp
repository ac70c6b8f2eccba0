// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_names.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "mrpt_sgraphs/semantics/places.h"

namespace mrpt_sgraphs {
namespace {

constexpr std::size_t kMaxBytes = 100;   ///< It is to be read on a map.
constexpr double kSameStorey_m = 1.0;    ///< Grounds that are farther apart are of two storeys.

/// Bytes of the character that begins with this one; 0 if none does.
std::size_t characterLength(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  if (first >= 0xF0 && first < 0xF5) return 4;
  return 0;
}

bool isLineOfUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const std::size_t length = characterLength(byte(at));
    const bool is_control = byte(at) < 0x20 || byte(at) == 0x7F;
    if (length == 0 || is_control || at + length > text.size()) return false;
    for (std::size_t k = at + 1; k < at + length; ++k) {
      if ((byte(k) & 0xC0U) != 0x80) return false;
    }
    // the long forms of short characters, and halves of pairs
    if (length == 3 && byte(at) == 0xE0 && byte(at + 1) < 0xA0) return false;
    if (length == 3 && byte(at) == 0xED && byte(at + 1) >= 0xA0) return false;
    if (length == 4 && byte(at) == 0xF0 && byte(at + 1) < 0x90) return false;
    if (length == 4 && byte(at) == 0xF4 && byte(at + 1) >= 0x90) return false;
    at += length;
  }
  return true;
}

}  // namespace

std::string defaultRoomName(RoomAttributes::Kind kind, RoomId id) {
  using Kind = RoomAttributes::Kind;
  const char* const word = kind == Kind::kCorridor    ? "corridor "
                           : kind == Kind::kStairwell ? "stairwell "
                                                      : "room ";
  return word + std::to_string(id.value);
}

bool isNamedByUser(RoomId id, const RoomAttributes& room) {
  return !room.name.empty() && room.name != defaultRoomName(room.kind, id);
}

void requireName(const GraphSnapshot& graph, RoomId room, const std::string& name) {
  if (findRoom(graph, room) == nullptr) {
    throw std::out_of_range(nameOf(NodeId(room)) + " is not in the graph");
  }
  if (name.find_first_not_of(' ') == std::string::npos) {
    throw std::invalid_argument("no name was given");
  }
  if (name.size() > kMaxBytes) {
    throw std::invalid_argument("the name has " + std::to_string(name.size()) +
                                " bytes, more than " + std::to_string(kMaxBytes));
  }
  if (!isLineOfUtf8(name)) throw std::invalid_argument("the name is not one line of UTF-8");
  for (const RoomNode* other : roomsNamed(graph, name)) {
    if (other->id == room) continue;
    throw std::invalid_argument("'" + name + "' is the name of the room with the id " +
                                std::to_string(other->id.value));
  }
}

void LostRoomNames::remember(RoomId room, KeyframeId anchor, const LayeredGraph& graph) {
  const RoomAttributes& attributes = graph.attributes(room);
  if (!isNamedByUser(room, attributes) || !graph.contains(anchor)) return;
  lost_.push_back({attributes.name, anchor,
                   graph.pose(anchor).inverse() * graph.pose(room).translation()});
}

void LostRoomNames::giveBack(const std::vector<std::optional<RoomId>>& rooms,
                             const std::vector<RoomAttributes>& outlines, LayeredGraph* graph) {
  if (lost_.empty()) return;
  const auto heirOf = [&](const Lost& lost) -> std::optional<RoomId> {
    const Eigen::Vector3d centre_map = graph->pose(lost.anchor) * lost.centre_anchor;
    for (std::size_t k = 0; k < rooms.size(); ++k) {
      if (!rooms[k] || isNamedByUser(*rooms[k], graph->attributes(*rooms[k]))) continue;
      RoomNode room;
      room.extent_map = outlines[k].extent_map;
      const auto border = nearestBorder(room, centre_map);
      const bool is_level =
          border && std::abs(border->nearest_map.z() - centre_map.z()) < kSameStorey_m;
      if (is_level && isAround(room, centre_map)) return rooms[k];
    }
    return std::nullopt;
  };
  const auto is_over = [&](const Lost& lost) {
    if (!graph->contains(lost.anchor)) return true;
    const GraphSnapshotConstPtr now = graph->snapshot();
    if (!roomsNamed(*now, lost.name).empty()) return true;  // a user has given it again
    const std::optional<RoomId> heir = heirOf(lost);
    if (!heir) return false;
    RoomAttributes attributes = graph->attributes(*heir);
    attributes.name = lost.name;
    graph->setAttributes(*heir, attributes);
    return true;
  };
  lost_.erase(std::remove_if(lost_.begin(), lost_.end(), is_over), lost_.end());
}

}  // namespace mrpt_sgraphs
