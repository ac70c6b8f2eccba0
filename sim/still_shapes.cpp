// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "sim/scene.h"
#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr Material kPlaster{0.6, true};
constexpr Material kConcrete{0.35, true};
constexpr Material kCeiling{0.7, true};
constexpr Material kWood{0.5, true};
constexpr Material kSteel{0.85, true};
constexpr Material kGlass{0.0, false};

constexpr double kTableTop_m = 0.04;  ///< Thickness.
constexpr double kTableLeg_m = 0.05;  ///< Edge of a leg.
constexpr double kScaffoldPole_m = 0.05;
constexpr double kScaffoldDeck_m = 0.05;  ///< Thickness of a platform.
constexpr double kScaffoldLevel_m = 1.0;  ///< Between platforms.

Polygon2 upright(double begin, double end, double bottom, double top) {
  return {{begin, bottom}, {end, bottom}, {end, top}, {begin, top}};
}

/// A vertical rectangle over the line from a to b.
Patch verticalPatch(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bottom_m,
                    double top_m, std::vector<Polygon2> holes, const Material& material,
                    int face = kNoFace) {
  const Eigen::Vector2d along = (b - a).normalized();
  return Patch({a.x(), a.y(), bottom_m}, {along.x(), along.y(), 0.0}, Eigen::Vector3d::UnitZ(),
               upright(0.0, (b - a).norm(), 0.0, top_m - bottom_m), std::move(holes), material,
               face);
}

Patch horizontalPatch(Polygon2 outline, double z_m, std::vector<Polygon2> holes,
                      const Material& material) {
  return Patch({0.0, 0.0, z_m}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
               std::move(outline), std::move(holes), material);
}

class ShapeMaker {
 public:
  explicit ShapeMaker(const Building& building) : building_(building) {}

  std::vector<Shape> make() {
    const std::vector<WallFace> faces = wallFaces(building_);
    for (size_t k = 0; k < faces.size(); ++k) addWall(faces[k], static_cast<int>(k));
    for (const Room& room : building_.rooms) addFloorAndCeiling(room);
    for (const Door& door : building_.doors) addPassage(door);
    for (const Furniture& piece : building_.furniture) addFurniture(piece);
    for (const Pillar& pillar : building_.pillars) addPillar(pillar);
    for (const Flight& flight : building_.flights) addFlight(flight);
    return std::move(shapes_);
  }

 private:
  void addWall(const WallFace& face, int index) {
    std::vector<Polygon2> holes;
    for (const FaceOpening& opening : face.openings) {
      holes.push_back(upright(opening.begin_m, opening.end_m, opening.bottom_m, opening.top_m));
      if (!opening.window) continue;
      const Eigen::Vector2d begin = face.first + opening.begin_m * face.along();
      const Eigen::Vector2d end = face.first + opening.end_m * face.along();
      shapes_.emplace_back(verticalPatch(begin, end, face.floor_m + opening.bottom_m,
                                         face.floor_m + opening.top_m, {}, kGlass));
    }
    shapes_.emplace_back(verticalPatch(face.first, face.second, face.floor_m,
                                       face.floor_m + face.height_m, std::move(holes), kPlaster,
                                       index));
  }

  void addFloorAndCeiling(const Room& room) {
    std::vector<Polygon2> floor_holes;
    std::vector<Polygon2> ceiling_holes;
    for (const Flight& flight : building_.flights) {
      const Polygon2 footprint = flight.footprint();
      const Eigen::Vector2d middle = 0.5 * (flight.foot + flight.head());
      if (!contains(room.outline, middle) || !building_.opensAbove(flight)) continue;
      if (flight.upper_storey == room.storey) floor_holes.push_back(footprint);
      if (flight.lower_storey == room.storey) ceiling_holes.push_back(footprint);
    }
    const Storey& storey = building_.storeys[room.storey];
    shapes_.emplace_back(
        horizontalPatch(room.outline, storey.elevation_m, std::move(floor_holes), kConcrete));
    shapes_.emplace_back(horizontalPatch(room.outline, storey.elevation_m + storey.height_m,
                                         std::move(ceiling_holes), kCeiling));
  }

  /// Threshold, lintel and the two jambs between the faces of a pierced wall.
  void addPassage(const Door& door) {
    const DoorEdge a = doorEdge(building_, door, 0);
    const DoorEdge b = doorEdge(building_, door, 1);  // runs the other way
    const double floor_m = building_.storeys[door.storey].elevation_m;
    const Polygon2 outline{a.end, a.begin, b.end, b.begin};
    shapes_.emplace_back(horizontalPatch(outline, floor_m, {}, kConcrete));
    shapes_.emplace_back(horizontalPatch(outline, floor_m + door.height_m, {}, kPlaster));
    shapes_.emplace_back(
        verticalPatch(a.begin, b.end, floor_m, floor_m + door.height_m, {}, kPlaster));
    shapes_.emplace_back(
        verticalPatch(a.end, b.begin, floor_m, floor_m + door.height_m, {}, kPlaster));
  }

  void addFurniture(const Furniture& piece) {
    const double floor_m = building_.storeys[piece.storey].elevation_m;
    const Eigen::Vector2d size(piece.size_m[0], piece.size_m[1]);
    const double top_m = floor_m + piece.size_m[2];
    if (piece.kind == FurnitureKind::kBox) {
      shapes_.emplace_back(Box(piece.at, size, piece.yaw_rad, floor_m, top_m, kWood));
      return;
    }
    if (piece.kind == FurnitureKind::kTable) {
      addLegs(piece, kTableLeg_m, floor_m, top_m - kTableTop_m, kSteel);
      shapes_.emplace_back(Box(piece.at, size, piece.yaw_rad, top_m - kTableTop_m, top_m, kWood));
      return;
    }
    addLegs(piece, kScaffoldPole_m, floor_m, top_m, kSteel);
    for (double z = kScaffoldLevel_m; z < piece.size_m[2]; z += kScaffoldLevel_m) {
      shapes_.emplace_back(
          Box(piece.at, size, piece.yaw_rad, floor_m + z - kScaffoldDeck_m, floor_m + z, kWood));
    }
  }

  void addLegs(const Furniture& piece, double thickness_m, double bottom_m, double top_m,
               const Material& material) {
    const Eigen::Vector2d thickness = Eigen::Vector2d::Constant(thickness_m);
    const Eigen::Vector2d spacing = Eigen::Vector2d(piece.size_m[0], piece.size_m[1]) - thickness;
    for (const Eigen::Vector2d& corner : rectangle(piece.at, spacing, piece.yaw_rad)) {
      shapes_.emplace_back(Box(corner, thickness, piece.yaw_rad, bottom_m, top_m, material));
    }
  }

  void addPillar(const Pillar& pillar) {
    const Storey& storey = building_.storeys[pillar.storey];
    const double top_m = storey.elevation_m + storey.height_m;
    if (pillar.radius_m) {
      shapes_.emplace_back(
          Cylinder(pillar.at, *pillar.radius_m, storey.elevation_m, top_m, kConcrete));
    } else {
      shapes_.emplace_back(
          Box(pillar.at, pillar.size_m, pillar.yaw_rad, storey.elevation_m, top_m, kConcrete));
    }
  }

  /// The steps as boxes from the floor up, and the sides of the opening in the slab above them.
  void addFlight(const Flight& flight) {
    const Storey& lower = building_.storeys[flight.lower_storey];
    const Storey& upper = building_.storeys[flight.upper_storey];
    const double rise_m = (upper.elevation_m - lower.elevation_m) / flight.steps;
    const double tread_m = flight.run_m / flight.steps;
    for (int k = 0; k < flight.steps; ++k) {
      const Eigen::Vector2d middle =
          flight.foot + (k + 0.5) * tread_m * direction(flight.heading_rad);
      shapes_.emplace_back(Box(middle, {tread_m, flight.width_m}, flight.heading_rad,
                               lower.elevation_m, lower.elevation_m + (k + 1) * rise_m, kConcrete));
    }
    const double ceiling_m = lower.elevation_m + lower.height_m;
    if (upper.elevation_m <= ceiling_m) return;  // a slab without thickness has no sides
    const Polygon2 opening = flight.footprint();
    for (size_t k = 0; k < opening.size(); ++k) {
      shapes_.emplace_back(verticalPatch(opening[k], nextCorner(opening, k), ceiling_m,
                                         upper.elevation_m, {}, kConcrete));
    }
  }

  const Building& building_;
  std::vector<Shape> shapes_;
};

}  // namespace

std::vector<Shape> stillShapes(const Building& building) { return ShapeMaker(building).make(); }

}  // namespace mrpt_sgraphs::sim
