// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

/// Faces are made room by room, so that the face of a reference is found by counting.
size_t indexOf(const Building& building, FaceRef face) {
  size_t index = face.edge;
  for (size_t r = 0; r < face.room; ++r) index += building.rooms[r].outline.size();
  return index;
}

FaceOpening openingAt(const WallFace& face, const Eigen::Vector2d& at, double width_m) {
  const double s = (at - face.first).dot(face.along());
  return {s - 0.5 * width_m, s + 0.5 * width_m, 0.0, 0.0, false};
}

}  // namespace

std::vector<WallFace> wallFaces(const Building& building) {
  std::vector<WallFace> faces;
  for (size_t r = 0; r < building.rooms.size(); ++r) {
    const Room& room = building.rooms[r];
    const Storey& storey = building.storeys[room.storey];
    for (size_t k = 0; k < room.outline.size(); ++k) {
      faces.push_back({r,
                       room.storey,
                       room.outline[k],
                       nextCorner(room.outline, k),
                       storey.elevation_m,
                       storey.height_m,
                       {}});
    }
  }
  for (const Door& door : building.doors) {
    for (const FaceRef& side : door.faces) {
      WallFace& face = faces[indexOf(building, side)];
      FaceOpening opening = openingAt(face, door.at, door.width_m);
      opening.bottom_m = building.storeys[door.storey].elevation_m - face.floor_m;
      opening.top_m = opening.bottom_m + door.height_m;
      face.openings.push_back(opening);
    }
  }
  for (const Window& window : building.windows) {
    WallFace& face = faces[indexOf(building, window.face)];
    FaceOpening opening = openingAt(face, window.at, window.width_m);
    opening.bottom_m = window.sill_m;
    opening.top_m = window.sill_m + window.height_m;
    opening.window = true;
    face.openings.push_back(opening);
  }
  return faces;
}

DoorEdge doorEdge(const Building& building, const Door& door, size_t side) {
  const FaceRef ref = door.faces[side];
  const Polygon2& outline = building.rooms[ref.room].outline;
  const Eigen::Vector2d& first = outline[ref.edge];
  const Eigen::Vector2d along = (nextCorner(outline, ref.edge) - first).normalized();
  const Eigen::Vector2d middle = first + (door.at - first).dot(along) * along;
  const Eigen::Vector2d half = 0.5 * door.width_m * along;
  return {middle - half, middle + half, leftOf(along)};
}

}  // namespace mrpt_sgraphs::sim
