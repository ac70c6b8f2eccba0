// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/building_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mrpt_sgraphs::sim {
namespace {

/// Thinner walls are slips of the pen: two rooms that share a face would have no wall between them.
constexpr double kMinWallThickness_m = 0.02;
/// A door's point lies in the wall, so no face that it pierces is further away than a thick wall.
constexpr double kMaxWallThickness_m = 0.6;
/// Faces of a pierced wall may differ by this much (as drawn by hand).
constexpr double kMaxFaceAngle_rad = 0.02;
/// Furniture may reach this far into the wall that it stands at (rounding in the file).
constexpr double kContactTolerance_m = 0.01;

[[noreturn]] void fail(const std::string& where, const std::string& message) {
  throw std::invalid_argument(where + ": " + message);
}

void checkStoreys(const Building& building) {
  for (size_t k = 1; k < building.storeys.size(); ++k) {
    const Storey& below = building.storeys[k - 1];
    const Storey& storey = building.storeys[k];
    if (storey.elevation_m < below.elevation_m) {
      fail(storey.where, "'elevation_m' of '" + storey.name + "' is below '" + below.name + "'");
    }
    for (size_t j = 0; j < k; ++j) {
      if (building.storeys[j].name == storey.name) {
        fail(storey.where, "the name '" + storey.name + "' is given twice");
      }
    }
  }
}

/// Storeys may overlap in height, as in a split level, where no room lies above the other.
void checkAbove(const Building& building, const Room& room, const Room& other) {
  const Room& upper = room.storey > other.storey ? room : other;
  const Room& lower = room.storey > other.storey ? other : room;
  const Storey& above = building.storeys[upper.storey];
  const Storey& below = building.storeys[lower.storey];
  if (above.elevation_m >= below.elevation_m + below.height_m) return;
  if (gapBetween(upper.outline, lower.outline) < kMinWallThickness_m) {
    fail(above.where, "'elevation_m' of '" + above.name + "' is below the ceiling of '" +
                          lower.name + "', which '" + upper.name + "' overlaps");
  }
}

void checkOutline(const Room& room) {
  if (room.outline.size() < 3) fail(room.where, "the outline needs at least three corners");
  for (size_t k = 0; k < room.outline.size(); ++k) {
    if ((nextCorner(room.outline, k) - room.outline[k]).norm() < kMinWallThickness_m) {
      fail(room.where, "corner " + std::to_string(k) + " is given twice");
    }
  }
  if (!isSimple(room.outline)) fail(room.where, "the outline crosses itself");
  if (signedArea(room.outline) <= 0.0) fail(room.where, "the outline must be counter-clockwise");
}

double lengthOf(const Building& building, FaceRef face) {
  const Polygon2& outline = building.rooms[face.room].outline;
  return (nextCorner(outline, face.edge) - outline[face.edge]).norm();
}

Eigen::Vector2d directionOf(const Building& building, FaceRef face) {
  const Polygon2& outline = building.rooms[face.room].outline;
  return (nextCorner(outline, face.edge) - outline[face.edge]).normalized();
}

/// How far along the face the point is, from the face's first corner.
double positionOn(const Building& building, FaceRef face, const Eigen::Vector2d& point) {
  const Eigen::Vector2d& first = building.rooms[face.room].outline[face.edge];
  return (point - first).dot(directionOf(building, face));
}

/// For every room within reach the face that is nearest to the point, the nearest room first.
std::vector<FaceRef> facesNear(const Building& building, size_t storey,
                               const Eigen::Vector2d& point) {
  std::vector<std::pair<double, FaceRef>> found;
  for (size_t r = 0; r < building.rooms.size(); ++r) {
    const Polygon2& outline = building.rooms[r].outline;
    if (building.rooms[r].storey != storey) continue;
    double nearest = kMaxWallThickness_m;
    FaceRef face{r, outline.size()};
    for (size_t k = 0; k < outline.size(); ++k) {
      const double distance = distanceToSegment(point, outline[k], nextCorner(outline, k));
      if (distance >= nearest) continue;
      nearest = distance;
      face.edge = k;
    }
    if (face.edge < outline.size()) found.emplace_back(nearest, face);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<FaceRef> faces;
  for (const auto& entry : found) faces.push_back(entry.second);
  return faces;
}

void checkFits(const Building& building, FaceRef face, const Eigen::Vector2d& at, double width_m,
               const std::string& where) {
  const double s = positionOn(building, face, at);
  if (s - 0.5 * width_m < 0.0 || s + 0.5 * width_m > lengthOf(building, face)) {
    fail(where, "'width_m' does not fit into the wall of '" + building.rooms[face.room].name + "'");
  }
}

/// At the head of a flight between rooms side by side: the wall of the lower room.
std::optional<FaceRef> faceOfFlight(const Building& building, const Door& door) {
  for (const Flight& flight : building.flights) {
    if (flight.upper_storey != door.storey || building.opensAbove(flight)) continue;
    if ((flight.head() - door.at).norm() > kMaxWallThickness_m) continue;
    const std::vector<FaceRef> faces = facesNear(building, flight.lower_storey, door.at);
    if (!faces.empty()) return faces.front();
  }
  return std::nullopt;
}

void checkHeight(const Building& building, const Door& door) {
  for (const FaceRef& face : door.faces) {
    const Storey& storey = building.storeys[building.rooms[face.room].storey];
    const double sill_m = building.storeys[door.storey].elevation_m - storey.elevation_m;
    if (sill_m + door.height_m >= storey.height_m) {
      fail(door.where, "'height_m' must be less than the storey's");
    }
  }
}

void resolveDoor(const Building& building, Door& door) {
  std::vector<FaceRef> faces = facesNear(building, door.storey, door.at);
  if (faces.size() == 1) {
    const std::optional<FaceRef> below = faceOfFlight(building, door);
    if (below) faces.push_back(*below);
  }
  if (faces.size() < 2) {
    fail(door.where, "joins " + std::to_string(faces.size()) + " rooms instead of two; 'at' must " +
                         "lie in the wall between them");
  }
  door.faces = {faces[0], faces[1]};
  const double cosine =
      directionOf(building, door.faces[0]).dot(directionOf(building, door.faces[1]));
  if (cosine > -std::cos(kMaxFaceAngle_rad)) {
    fail(door.where, "the walls of '" + building.rooms[faces[0].room].name + "' and '" +
                         building.rooms[faces[1].room].name + "' are not parallel there");
  }
  for (const FaceRef& face : door.faces) {
    checkFits(building, face, door.at, door.width_m, door.where);
  }
  checkHeight(building, door);
}

/// The stretch of a face that an opening takes.
struct Stretch {
  FaceRef face;
  double begin_m;
  double end_m;
  const std::string* where;
};

void checkOpeningsApart(const Building& building) {
  std::vector<Stretch> stretches;
  const auto add = [&](FaceRef face, const Eigen::Vector2d& at, double width_m,
                       const std::string& where) {
    const double s = positionOn(building, face, at);
    stretches.push_back({face, s - 0.5 * width_m, s + 0.5 * width_m, &where});
  };
  for (const Door& door : building.doors) {
    for (const FaceRef& face : door.faces) add(face, door.at, door.width_m, door.where);
  }
  for (const Window& window : building.windows) {
    add(window.face, window.at, window.width_m, window.where);
  }
  for (size_t i = 0; i < stretches.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const Stretch& a = stretches[i];
      const Stretch& b = stretches[j];
      if (a.face.room != b.face.room || a.face.edge != b.face.edge) continue;
      if (a.begin_m < b.end_m && b.begin_m < a.end_m) {
        fail(*a.where, "overlaps the opening at " + *b.where);
      }
    }
  }
}

void checkInside(const Building& building, size_t storey, const Polygon2& footprint,
                 const Eigen::Vector2d& centre, const std::string& where) {
  const std::optional<size_t> room = building.roomAt(storey, centre);
  if (!room) fail(where, "is not inside a room");
  for (const Eigen::Vector2d& corner : footprint) {
    const Polygon2& outline = building.rooms[*room].outline;
    if (!contains(outline, corner) && distanceToOutline(outline, corner) > kContactTolerance_m) {
      fail(where, "reaches into the wall of '" + building.rooms[*room].name + "'");
    }
  }
}

void checkFlight(const Building& building, const Flight& flight) {
  if (flight.upper_storey != flight.lower_storey + 1) {
    fail(flight.where, "'to' must be the storey above 'from'");
  }
  const Eigen::Vector2d middle = 0.5 * (flight.foot + flight.head());
  checkInside(building, flight.lower_storey, flight.footprint(), middle, flight.where);
  if (building.opensAbove(flight)) {
    checkInside(building, flight.upper_storey, flight.footprint(), middle, flight.where);
  }
}

}  // namespace

void checkRooms(const Building& building) {
  checkStoreys(building);
  for (size_t k = 0; k < building.rooms.size(); ++k) {
    const Room& room = building.rooms[k];
    checkOutline(room);
    for (size_t j = 0; j < k; ++j) {
      const Room& other = building.rooms[j];
      if (other.name == room.name) fail(room.where, "the name is given twice");
      if (other.storey != room.storey) {
        checkAbove(building, room, other);
        continue;
      }
      const double gap_m = gapBetween(room.outline, other.outline);
      if (gap_m == 0.0) fail(room.where, "overlaps the room '" + other.name + "'");
      if (gap_m < kMinWallThickness_m) {
        fail(room.where, "there is no wall between it and '" + other.name + "'");
      }
    }
  }
}

void resolveOpenings(Building& building) {
  for (Door& door : building.doors) resolveDoor(building, door);
  for (Window& window : building.windows) {
    const std::vector<FaceRef> faces = facesNear(building, window.storey, window.at);
    if (faces.empty()) fail(window.where, "there is no wall at 'at'");
    window.face = faces.front();
    checkFits(building, window.face, window.at, window.width_m, window.where);
    if (window.sill_m + window.height_m >= building.storeys[window.storey].height_m) {
      fail(window.where, "'sill_m' and 'height_m' reach above the ceiling");
    }
  }
  checkOpeningsApart(building);
}

void checkContents(const Building& building) {
  for (const Furniture& piece : building.furniture) {
    checkInside(building, piece.storey,
                rectangle(piece.at, {piece.size_m[0], piece.size_m[1]}, piece.yaw_rad), piece.at,
                piece.where);
    if (piece.size_m[2] >= building.storeys[piece.storey].height_m) {
      fail(piece.where, "is higher than the storey");
    }
  }
  for (const Pillar& pillar : building.pillars) {
    checkInside(building, pillar.storey, {}, pillar.at, pillar.where);
  }
  for (const Person& person : building.people) {
    const auto from = building.roomAt(person.storey, person.from);
    if (!from || from != building.roomAt(person.storey, person.to)) {
      fail(person.where, "'from' and 'to' must lie in one room");
    }
  }
  for (const Flight& flight : building.flights) checkFlight(building, flight);
  for (const TourStop& stop : building.tour) {
    for (const Eigen::Vector2d& point : stop.points) {
      if (!contains(building.rooms[stop.room].outline, point)) {
        fail(stop.where, "a point of 'at' is not in '" + building.rooms[stop.room].name + "'");
      }
    }
  }
}

}  // namespace mrpt_sgraphs::sim
