// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_detector.h"

#include <iterator>
#include <map>
#include <set>

#include "mrpt_sgraphs/geometry/ground_frame.h"
#include "storey_rooms.h"

namespace mrpt_sgraphs {

struct RoomDetector::State {
  struct Storey {
    Storey(const RoomDetectorConfig& config, FloorId floor) : rooms(config, floor) {}

    StoreyRooms rooms;
    std::vector<DetectedRoom> detected;

    template <typename Archive>
    void archive(Archive& a) {
      a("rooms", rooms);
      a("detected", detected);
    }
  };

  explicit State(const RoomDetectorConfig& config) : config(config) {}

  RoomDetectorConfig config;
  std::map<FloorId, Storey> storeys;
};

RoomDetector::RoomDetector(const RoomDetectorConfig& config)
    : state_(std::make_unique<State>(config)) {}

RoomDetector::~RoomDetector() = default;

RoomDetection RoomDetector::detect(const GraphSnapshot& graph) {
  RoomDetection detection;
  detection.stamp_s = graph.stamp_s;
  std::map<FloorId, std::vector<const KeyframeNode*>> keyframes;
  std::vector<const KeyframeNode*> passing;
  for (const KeyframeNode& keyframe : graph.keyframes) {
    if (keyframe.floor) {
      keyframes[*keyframe.floor].push_back(&keyframe);
    } else {
      passing.push_back(&keyframe);
    }
  }
  std::set<FloorId> present;
  for (const FloorNode& floor : graph.floors) present.insert(floor.id);
  for (auto storey = state_->storeys.begin(); storey != state_->storeys.end();) {
    const bool is_gone = present.count(storey->first) == 0;
    storey = is_gone ? state_->storeys.erase(storey) : std::next(storey);
  }
  for (const FloorNode& floor : graph.floors) {
    const auto storey = state_->storeys.try_emplace(floor.id, state_->config, floor.id).first;
    const Pose T_floor_map = floorFrame(floor.ground_map);
    const auto& on_floor = keyframes[floor.id];
    if (storey->second.rooms.integrate(on_floor, T_floor_map)) {
      storey->second.detected =
          storey->second.rooms.detect(on_floor, passing, graph.walls, T_floor_map);
    }
    const std::size_t before = detection.rooms.size();
    for (DetectedRoom room : storey->second.detected) {
      for (DetectedDoorway& doorway : room.doorways) {
        if (doorway.to) *doorway.to += before;
      }
      detection.rooms.push_back(std::move(room));
    }
  }
  return detection;
}

template <typename Archive>
void RoomDetector::archive(Archive& a) {
  const std::size_t storeys = a.count(state_->storeys.size());
  if constexpr (Archive::kReads) {
    state_->storeys.clear();
    for (std::size_t k = 0; k < storeys; ++k) {
      FloorId floor;
      a.item(floor);
      a("storey", state_->storeys.try_emplace(floor, state_->config, floor).first->second);
    }
  } else {
    for (auto& [floor, storey] : state_->storeys) {
      a.item(floor);
      a("storey", storey);
    }
  }
}

template void RoomDetector::archive(ArchiveWriter&);
template void RoomDetector::archive(ArchiveReader&);

}  // namespace mrpt_sgraphs
