// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <optional>
#include <vector>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/right_angles.h"
#include "mrpt_sgraphs/semantics/room_layer_config.h"
#include "mrpt_sgraphs/semantics/room_names.h"

namespace mrpt_sgraphs {

/// The rooms layer: which detected room is which node of the graph, and the factors that tie its
/// walls through it.
///
/// A room keeps its id while it grows and while the graph moves. Rooms that have become one are the
/// oldest of them, of a room that has become several the largest part keeps the id, and a room that
/// was not found a few times is erased. The name that a user gave stays with the place. Nothing
/// depends on the map's origin or on the directions of its x and y.
class RoomLayer {
 public:
  explicit RoomLayer(const RoomLayerConfig& config) : config_(config) {}

  /// Brings the graph's rooms in line with a detection, which may be older than the graph: what it
  /// does not know of stays as it is, and walls that the graph has lost since are passed over. What
  /// is as it was is not touched.
  /// @return Whether factors have come or gone.
  bool update(const RoomDetection& detection, LayeredGraph* graph);

  /// Those that the last update has found, or given other walls.
  const std::vector<RoomId>& grown() const { return grown_; }

  /// To be called before an optimization: rooms that have lost walls, or whose floor has become
  /// another, are held by other factors.
  void mend(LayeredGraph* graph);

  /// How exactly the building is built, as its walls tell.
  const RightAngles& exactness() const { return exactness_; }

  /// To be called after an optimization: outlines and doorways follow their rooms.
  void follow(LayeredGraph* graph);

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("known", known_);
    a("missed", missed_);
    a("grown", grown_);
    a("exactness", exactness_);
    a("measured_walls", measured_walls_);
    a("measured_keyframes", measured_keyframes_);
    a("losses", losses_);
    a("names", names_);
  }

 private:
  /// A doubtful wall must not cost a room its id and its name.
  static constexpr int kMaxMissed = 3;

  /// A room as it was last detected, its axes as those of its node.
  struct Known {
    DetectedRoom room;
    std::vector<Doorway> doorways_anchor;  ///< As those of the graph, but for the frame.
    /// How outline and doorways move with the room. None: not yet, the room has new factors and is
    /// not where they want it.
    std::optional<Pose> T_room_anchor;

    template <typename Archive>
    void archive(Archive& a) {
      a("room", room);
      a("doorways_anchor", doorways_anchor);
      a("T_room_anchor", T_room_anchor);
    }
  };

  static Known shapeOf(const DetectedRoom& room, const RoomAttributes& attributes,
                       const Pose& T_map_room, const LayeredGraph& graph);
  /// Rooms whose keyframes are in others now, or that were not found for a while.
  bool eraseAllBut(const std::vector<std::optional<RoomId>>& nodes,
                   const std::vector<DetectedRoom>& rooms, LayeredGraph* graph);
  bool bringInLine(RoomId id, const DetectedRoom& room, RoomAttributes attributes,
                   LayeredGraph* graph);
  void updateExactness(const std::vector<DetectedRoom>& rooms, const LayeredGraph& graph);
  void assignKeyframes(const RoomDetection& detection,
                       const std::vector<std::optional<RoomId>>& nodes, LayeredGraph* graph) const;

  RoomLayerConfig config_;
  std::map<RoomId, Known> known_;
  std::map<RoomId, int> missed_;  ///< How often in a row each was not found, of those that were not.
  LostRoomNames names_;
  std::vector<RoomId> grown_;
  RightAngles exactness_;  ///< Of the building, as far as it is known, and what from:
  std::vector<WallId> measured_walls_;
  double measured_keyframes_ = 0.0;
  uint64_t losses_ = 0;  ///< Of the graph, when it was last looked at.
};

}  // namespace mrpt_sgraphs
