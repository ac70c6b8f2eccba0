// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <string>

#include "mrpt_sgraphs/graph/nodes.h"

namespace mrpt_sgraphs {

/// As files and messages name the kind of a room.
inline const char* nameOf(RoomAttributes::Kind kind) {
  constexpr const char* kNames[] = {"four_walls", "corridor", "polygon", "stairwell"};
  return kNames[static_cast<int>(kind)];
}

/// Nothing for what is no kind's name.
inline std::optional<RoomAttributes::Kind> roomKind(const std::string& name) {
  using Kind = RoomAttributes::Kind;
  for (const Kind kind : {Kind::kFourWalls, Kind::kCorridor, Kind::kPolygon, Kind::kStairwell}) {
    if (name == nameOf(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace mrpt_sgraphs
