// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {

/// "corridor 5", until somebody gives it another name.
std::string defaultRoomName(RoomAttributes::Kind kind, RoomId id);

/// Whether somebody has.
bool isNamedByUser(RoomId id, const RoomAttributes& room);

/// @throws std::invalid_argument that says why a room cannot be called so: no name at all, longer
///         than 100 bytes, not one line of UTF-8, or the name of another room.
/// @throws std::out_of_range for a room that is not in the graph.
void requireName(const GraphSnapshot& graph, RoomId room, const std::string& name);

/// Names that users gave to rooms which the graph has lost since: become one with an older room, or
/// not found for a while. The name stays with the place, and goes to the next room around it that
/// has no name of its own.
class LostRoomNames {
 public:
  /// To be called before the room is erased.
  /// @param anchor  A keyframe of the room: the place moves with it.
  void remember(RoomId room, KeyframeId anchor, const LayeredGraph& graph);

  /// Gives the names to those of the rooms that are around their places.
  /// @param outlines  Of each room; where it is none, the room is passed over.
  void giveBack(const std::vector<std::optional<RoomId>>& rooms,
                const std::vector<RoomAttributes>& outlines, LayeredGraph* graph);

  /// See geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("lost", lost_);
  }

 private:
  struct Lost {
    std::string name;
    KeyframeId anchor;
    Eigen::Vector3d centre_anchor = Eigen::Vector3d::Zero();

    template <typename Archive>
    void archive(Archive& a) {
      a("name", name);
      a("anchor", anchor);
      a("centre", centre_anchor);
    }
  };

  std::vector<Lost> lost_;
};

}  // namespace mrpt_sgraphs
