// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/polygon2d.h"

/// What a building file says, in the map frame: the loader has turned everything by `rotation_rad`.
/// Things refer to each other by their index in the lists of `Building`. `where` is the place in
/// the file ("office.yaml:12: door"), for messages.
namespace mrpt_sgraphs::sim {

struct Storey {
  std::string name;
  double elevation_m = 0.0;  ///< Of the floor.
  double height_m = 0.0;     ///< From floor to ceiling.
  std::string where;
};

enum class RoomKind { kRoom, kCorridor, kStairwell };
const char* toString(RoomKind kind);

struct Room {
  std::string name;
  RoomKind kind = RoomKind::kRoom;
  size_t storey = 0;
  Polygon2 outline;  ///< The inner wall faces, counter-clockwise. Between rooms it is solid.
  std::string where;
};

/// One wall face: edge `edge` of the outline of `room`.
struct FaceRef {
  size_t room = 0;
  size_t edge = 0;
};

/// An opening from the floor up that joins two rooms through the wall between them. One at the head
/// of a flight may join rooms of two storeys.
struct Door {
  size_t storey = 0;  ///< Of its floor.
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double width_m = 0.0;
  double height_m = 0.0;
  std::string where;
  std::array<FaceRef, 2> faces{};  ///< Found by `resolveOpenings`.
};

/// A pane in one wall face. Rays that reach it are gone.
struct Window {
  size_t storey = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double width_m = 0.0;
  double sill_m = 0.0;  ///< Above the floor.
  double height_m = 0.0;
  std::string where;
  FaceRef face{};  ///< Found by `resolveOpenings`.
};

enum class FurnitureKind { kBox, kTable, kScaffold };

struct Furniture {
  FurnitureKind kind = FurnitureKind::kBox;
  size_t storey = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
  std::array<double, 3> size_m{};  ///< Along its own x, y and up.
  std::string where;
};

/// From floor to ceiling; round if it has a radius, else a box.
struct Pillar {
  size_t storey = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  std::optional<double> radius_m;
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
  std::string where;
};

/// Walks to and fro between two points.
struct Person {
  size_t storey = 0;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double speed_m_s = 0.0;
  std::string where;
};

/// A straight flight of stairs, and the opening above it through ceiling and floor if it has a room
/// above it.
struct Flight {
  size_t lower_storey = 0;
  size_t upper_storey = 0;
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();  ///< Middle of the first riser's edge.
  double heading_rad = 0.0;                        ///< The way up.
  double width_m = 0.0;
  double run_m = 0.0;  ///< Horizontal length.
  int steps = 0;
  std::string where;

  Eigen::Vector2d head() const { return foot + run_m * direction(heading_rad); }
  Polygon2 footprint() const {
    return rectangle(0.5 * (foot + head()), {run_m, width_m}, heading_rad);
  }
};

/// Where the robot goes next: a room, and there either round the room or along given points.
struct TourStop {
  size_t room = 0;
  Polygon2 points;            ///< In order; empty: a round of the room.
  bool pass_through = false;  ///< Only to the room's middle.
  std::string where;
};

struct Building {
  std::string name;
  double rotation_rad = 0.0;  ///< Already applied.
  std::vector<Storey> storeys;
  std::vector<Room> rooms;
  std::vector<Door> doors;
  std::vector<Window> windows;
  std::vector<Furniture> furniture;
  std::vector<Pillar> pillars;
  std::vector<Person> people;
  std::vector<Flight> flights;
  std::vector<TourStop> tour;

  /// The room of a storey that contains the point, if one does.
  std::optional<size_t> roomAt(size_t storey, const Eigen::Vector2d& point) const {
    for (size_t k = 0; k < rooms.size(); ++k) {
      if (rooms[k].storey == storey && contains(rooms[k].outline, point)) return k;
    }
    return std::nullopt;
  }

  /// Whether the flight ends in a room above it, and not in one beside it, behind a door at its head.
  bool opensAbove(const Flight& flight) const {
    return roomAt(flight.upper_storey, 0.5 * (flight.foot + flight.head())).has_value();
  }
};

/// The building with everything in it turned about the origin.
Building turned(Building building, double angle_rad);

/// The building with its tour walked so many times, one after the other.
Building withTours(Building building, std::size_t tours);

/// Reads a building file, finds the walls of its doors and windows, and checks that it can be
/// built.
/// @throws std::invalid_argument naming file, line and field.
Building loadBuilding(const std::string& file);

}  // namespace mrpt_sgraphs::sim
