// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/semantics/detected_room.h"
#include "mrpt_sgraphs/semantics/room_layer_config.h"

namespace mrpt_sgraphs {

/// The rooms layer: which detected room is which node of the graph, and the factors that tie its
/// walls through it.
class RoomLayer {
 public:
  explicit RoomLayer(const RoomLayerConfig& config) : config_(config) {}

  /// Brings the graph's rooms in line with a detection, which may be older than the graph.
  /// @return Whether factors have come or gone.
  bool update(const RoomDetection& detection, LayeredGraph* graph);

  /// To be called after an optimization: outlines and doorways follow their rooms.
  void follow(LayeredGraph* graph);

 private:
  RoomLayerConfig config_;
};

}  // namespace mrpt_sgraphs
