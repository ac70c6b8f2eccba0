// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/floor_plan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "mrpt_sgraphs/mapping/node_colour.h"
#include "mrpt_sgraphs/semantics/doors.h"
#include "mrpt_sgraphs/semantics/places.h"
#include "room_label.h"
#include "svg_canvas.h"
#include "wall_footprints.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kMargin_m = 1.0;
constexpr double kTitle_m = 1.2;   ///< Height of what stands above the plan,
constexpr double kLegend_m = 1.6;  ///< and below it.
constexpr double kDoorLine_m = 0.08;
constexpr double kDoorGap_m = 0.24;
constexpr const char* kMeasuredWall = "#2f3439";
constexpr const char* kOneFace = "#8d959c";
constexpr const char* kDoor = "#b4632a";
constexpr const char* kStairs = "#1f5fa8";
constexpr const char* kInk = "#20242a";

/// All that is drawn of one storey.
struct Storey {
  std::string name;
  std::vector<const RoomNode*> rooms;
  std::vector<WallFootprint> walls;
  std::vector<Door> doors;
  std::vector<Stairs> stairs;
};

Storey storeyOf(const GraphSnapshot& graph, std::optional<FloorId> floor) {
  const FloorNode* const node = floor ? findFloor(graph, *floor) : nullptr;
  Storey storey;
  storey.name = node != nullptr ? node->name : "no floor";
  storey.walls = wallFootprints(graph, floor, node != nullptr ? node->ground_map : Plane{});
  for (const RoomNode& room : graph.rooms) {
    if (room.floor == floor) storey.rooms.push_back(&room);
  }
  for (const Door& door : doorsOf(graph)) {
    if (findRoom(graph, door.from)->floor == floor) storey.doors.push_back(door);
  }
  for (const Stairs& stairs : stairsOf(graph)) {
    if (floor && (stairs.from == *floor || stairs.to == *floor)) storey.stairs.push_back(stairs);
  }
  return storey;
}

Eigen::AlignedBox2d boxAround(const Storey& storey) {
  Eigen::AlignedBox2d box;
  for (const WallFootprint& wall : storey.walls) {
    for (const Eigen::Vector2d& corner : wall.corners_map) box.extend(corner);
  }
  for (const RoomNode* room : storey.rooms) {
    for (const Eigen::Vector3d& corner : room->extent_map.outline) {
      box.extend(corner.head<2>().eval());
    }
  }
  for (const Stairs& stairs : storey.stairs) {
    box.extend(stairs.from_map.head<2>().eval());
    box.extend(stairs.to_map.head<2>().eval());
  }
  if (box.isEmpty()) box.extend(Eigen::Vector2d(0.0, 0.0));
  return box;
}

/// The colour that the room has in rviz, pale.
std::string fillOf(RoomId id) {
  const Eigen::Vector3f pale = 0.35F * colourOf(id) + Eigen::Vector3f::Constant(0.65F);
  std::ostringstream text;
  text << "rgb(";
  for (int k = 0; k < 3; ++k) text << (k > 0 ? "," : "") << std::lround(255.0F * pale[k]);
  text << ')';
  return text.str();
}

std::string squareMetres(double area_m2) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(1);
  text << area_m2 << " m\xC2\xB2";
  return text.str();
}

void drawRooms(const Storey& storey, SvgCanvas* canvas) {
  canvas->beginGroup("rooms");
  for (const RoomNode* room : storey.rooms) {
    if (room->extent_map.outline.size() < 3) continue;
    canvas->area(room->extent_map, fillOf(room->id),
                 room->name + ", " + nameOf(NodeId(room->id)) + ", " +
                     squareMetres(areaOf(*room)));
  }
  canvas->endGroup();
}

void drawWalls(const Storey& storey, SvgCanvas* canvas) {
  canvas->beginGroup("walls");
  for (const bool measured : {false, true}) {  // over what is guessed lies what is known
    for (const WallFootprint& wall : storey.walls) {
      if (wall.measured != measured) continue;
      canvas->polygon(wall.corners_map, measured ? kMeasuredWall : kOneFace);
    }
  }
  canvas->endGroup();
}

void drawDoors(const Storey& storey, SvgCanvas* canvas) {
  canvas->beginGroup("doors");
  for (const Door& door : storey.doors) {
    const Eigen::Vector2d begin = door.begin_map().head<2>();
    const Eigen::Vector2d end = door.end_map().head<2>();
    canvas->line(begin, end, kDoorGap_m, "#ffffff");
    canvas->line(begin, end, kDoorLine_m, kDoor);
  }
  canvas->endGroup();
}

void drawStairs(const GraphSnapshot& graph, std::optional<FloorId> floor, const Storey& storey,
                SvgCanvas* canvas) {
  constexpr double kDash_m = 0.1;
  constexpr double kText_m = 0.4;
  canvas->beginGroup("stairs");
  for (const Stairs& stairs : storey.stairs) {
    const bool leaves = stairs.from == *floor;
    const Eigen::Vector2d here = (leaves ? stairs.from_map : stairs.to_map).head<2>();
    const Eigen::Vector2d there = (leaves ? stairs.to_map : stairs.from_map).head<2>();
    const FloorNode* const other = findFloor(graph, leaves ? stairs.to : stairs.from);
    canvas->line(here, there, kDash_m, kStairs, SvgCanvas::Dashes::kYes);
    canvas->disc(here, 2.0 * kDash_m, kStairs);
    canvas->text(0.5 * (here + there) + Eigen::Vector2d(0.0, kText_m),
                 "to " + (other != nullptr ? other->name : std::string("a floor")), kText_m, 0.0,
                 kStairs);
  }
  canvas->endGroup();
}

void drawNames(const Storey& storey, SvgCanvas* canvas) {
  canvas->beginGroup("names");
  for (const RoomNode* room : storey.rooms) {
    if (room->extent_map.outline.size() < 3) continue;
    const RoomLabel label = labelOf(*room);
    const Eigen::Vector2d up(-std::sin(label.turn_rad), std::cos(label.turn_rad));
    canvas->text(label.place_map + 0.35 * label.text_m * up, room->name, label.text_m,
                 label.turn_rad, kInk);
    canvas->text(label.place_map - 0.65 * label.text_m * up,
                 squareMetres(areaOf(*room)), 0.7 * label.text_m,
                 label.turn_rad, kInk);
  }
  canvas->endGroup();
}

/// As long as a quarter of the plan, or a bit less.
double scaleBar_m(double width_m) {
  double length_m = 1.0;
  for (const double longer_m : {2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (longer_m <= 0.25 * width_m) length_m = longer_m;
  }
  return length_m;
}

void drawLegend(const Eigen::AlignedBox2d& box, const std::string& title, SvgCanvas* canvas) {
  constexpr double kTitleText_m = 0.7;
  constexpr double kText_m = 0.35;
  using Anchor = SvgCanvas::Anchor;
  canvas->beginGroup("legend");
  canvas->text(Eigen::Vector2d(box.min().x(), box.max().y() + kMargin_m), title, kTitleText_m, 0.0,
               kInk, Anchor::kBegin);
  const double length_m = scaleBar_m(box.sizes().x());
  const Eigen::Vector2d begin = box.min() - Eigen::Vector2d(0.0, kMargin_m);
  const Eigen::Vector2d end = begin + Eigen::Vector2d(length_m, 0.0);
  const Eigen::Vector2d tick(0.0, 0.15);
  for (const auto& [a, b] : {std::pair<Eigen::Vector2d, Eigen::Vector2d>{begin, end},
                             {begin - tick, begin + tick},
                             {end - tick, end + tick}}) {
    canvas->line(a, b, 0.06, kInk);
  }
  canvas->text(end + Eigen::Vector2d(0.3, -0.12),
               std::to_string(std::lround(length_m)) + " m", kText_m, 0.0, kInk, Anchor::kBegin);
  canvas->text(begin - Eigen::Vector2d(0.0, 0.8),
               "Walls in light grey were seen from one side: their thickness is not known.",
               0.8 * kText_m, 0.0, kInk, Anchor::kBegin);
  canvas->endGroup();
}

}  // namespace

void writeFloorPlan(const GraphSnapshot& graph, std::optional<FloorId> floor, std::ostream& out) {
  const Storey storey = storeyOf(graph, floor);
  const Eigen::AlignedBox2d box = boxAround(storey);
  constexpr double kLeastWidth_m = 14.0;  // for the legend
  Eigen::AlignedBox2d page(box.min() - Eigen::Vector2d(kMargin_m, kMargin_m + kLegend_m),
                           box.max() + Eigen::Vector2d(kMargin_m, kMargin_m + kTitle_m));
  page.extend(page.min() + Eigen::Vector2d(kLeastWidth_m, 0.0));
  SvgCanvas canvas(page, storey.name, out);
  drawRooms(storey, &canvas);
  drawWalls(storey, &canvas);
  drawDoors(storey, &canvas);
  drawStairs(graph, floor, storey, &canvas);
  drawNames(storey, &canvas);
  drawLegend(box, storey.name, &canvas);
}

}  // namespace mrpt_sgraphs
