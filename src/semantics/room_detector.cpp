// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_detector.h"

namespace mrpt_sgraphs {

struct RoomDetector::State {};

RoomDetector::RoomDetector(const RoomDetectorConfig&) : state_(std::make_unique<State>()) {}

RoomDetector::~RoomDetector() = default;

RoomDetection RoomDetector::detect(const GraphSnapshot& graph) { return {graph.stamp_s, {}}; }

}  // namespace mrpt_sgraphs
