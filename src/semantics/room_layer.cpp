// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_layer.h"

namespace mrpt_sgraphs {

bool RoomLayer::update(const RoomDetection&, LayeredGraph*) { return false; }

void RoomLayer::follow(LayeredGraph*) {}

}  // namespace mrpt_sgraphs
