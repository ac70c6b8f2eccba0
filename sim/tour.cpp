// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/tour.h"

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <stdexcept>
#include <utility>

#include "sim/room_planner.h"
#include "sim/wall_faces.h"

namespace mrpt_sgraphs::sim {
namespace {

/// From the wall to where the robot turns to a door: a turn of 0.7 m radius fits, and it still has
/// room in a corridor of 1.4 m. Taken shorter where furniture stands in the way.
constexpr std::array<double, 3> kDoorApproach_m{0.75, 0.6, 0.45};
constexpr double kStairsApproach_m = 0.8;
/// Standing before a door, the robot (0.25 m to each side) touches nothing.
constexpr double kMinClearance_m = 0.32;

/// A door or a flight of stairs, with the places in front of it on both sides.
struct Link {
  std::array<size_t, 2> rooms{};
  std::array<Eigen::Vector2d, 2> ends{};
  const Flight* flight = nullptr;
};

class TourPlanner {
 public:
  TourPlanner(const Building& building, const std::vector<FloorPlan>& plans)
      : building_(building), plans_(plans), planners_(building.rooms.size()) {
    for (const Door& door : building.doors) {
      // one at the head of a flight is part of that
      const size_t storeys[] = {building.rooms[door.faces[0].room].storey,
                                building.rooms[door.faces[1].room].storey};
      if (storeys[0] == storeys[1]) links_.push_back(linkOf(door));
    }
    for (const Flight& flight : building.flights) links_.push_back(linkOf(flight));
  }

  Route plan() {
    for (const TourStop& stop : building_.tour) {
      if (!route_.empty()) goToRoom(stop);
      Polygon2 places = placesOf(stop);
      if (places.empty()) fail(stop, "there is no free place in it");
      if (route_.empty()) {
        room_ = stop.room;
        append(places.front());
      }
      for (const Eigen::Vector2d& place : places) goTo(place, stop);
    }
    return std::move(route_);
  }

 private:
  [[noreturn]] void fail(const TourStop& stop, const std::string& why) const {
    throw std::invalid_argument(stop.where + ": '" + building_.rooms[stop.room].name +
                                "' cannot be walked to: " + why);
  }

  Link linkOf(const Door& door) const {
    Link link;
    for (size_t side = 0; side < 2; ++side) {
      const DoorEdge edge = doorEdge(building_, door, side);
      link.rooms[side] = door.faces[side].room;
      const auto distance =
          std::find_if(kDoorApproach_m.begin(), kDoorApproach_m.end(), [&](double d) {
            return plans_[door.storey].clearance(edge.middle() + d * edge.inward) >=
                   kMinClearance_m;
          });
      if (distance == kDoorApproach_m.end()) {
        throw std::invalid_argument(door.where + ": something stands before it in '" +
                                    building_.rooms[link.rooms[side]].name + "'");
      }
      link.ends[side] = edge.middle() + *distance * edge.inward;
    }
    return link;
  }

  Link linkOf(const Flight& flight) const {
    Link link;
    link.flight = &flight;
    const Eigen::Vector2d up = direction(flight.heading_rad);
    link.ends = {flight.foot - kStairsApproach_m * up, flight.head() + kStairsApproach_m * up};
    const std::array<size_t, 2> storeys{flight.lower_storey, flight.upper_storey};
    for (size_t side = 0; side < 2; ++side) {
      const auto room = building_.roomAt(storeys[side], link.ends[side]);
      if (!room || plans_[storeys[side]].clearance(link.ends[side]) < kMinClearance_m) {
        throw std::invalid_argument(flight.where + ": there is no room to step on it " +
                                    (side == 0 ? "below" : "above"));
      }
      link.rooms[side] = *room;
    }
    return link;
  }

  const RoomPlanner& plannerOf(size_t room) {
    if (!planners_[room]) {
      planners_[room] = std::make_unique<RoomPlanner>(plans_[building_.rooms[room].storey],
                                                      building_.rooms[room].outline);
    }
    return *planners_[room];
  }

  Eigen::Vector2d position() const { return route_.back().floor_map.head<2>(); }

  void append(const Eigen::Vector2d& point) {
    const size_t storey = building_.rooms[room_].storey;
    const double floor_m = building_.storeys[storey].elevation_m;
    route_.push_back({{point.x(), point.y(), floor_m}, storey, false});
  }

  void goTo(const Eigen::Vector2d& place, const TourStop& stop) {
    const auto way = plannerOf(room_).path(position(), place);
    if (!way) fail(stop, "furniture blocks '" + building_.rooms[room_].name + "'");
    for (const Eigen::Vector2d& corner : *way) append(corner);
  }

  void goToRoom(const TourStop& stop) {
    for (const auto& [link, side] : linksTo(stop)) {
      goTo(link->ends[side], stop);
      room_ = link->rooms[1 - side];
      if (link->flight != nullptr) climb(*link->flight, side == 0);
      append(link->ends[1 - side]);
    }
  }

  /// The two ends of the flight, in the order of walking.
  void climb(const Flight& flight, bool up) {
    const Eigen::Vector2d foot = flight.foot;
    const Eigen::Vector2d head = flight.head();
    RoutePoint below{{foot.x(), foot.y(), building_.storeys[flight.lower_storey].elevation_m},
                     flight.lower_storey,
                     !up};
    RoutePoint above{{head.x(), head.y(), building_.storeys[flight.upper_storey].elevation_m},
                     flight.upper_storey,
                     up};
    route_.push_back(up ? below : above);
    route_.push_back(up ? above : below);
  }

  /// The links from the present room to that of the stop, each with the side it is entered from.
  std::vector<std::pair<const Link*, size_t>> linksTo(const TourStop& stop) const {
    std::vector<std::pair<const Link*, size_t>> entered_by(building_.rooms.size());
    std::deque<size_t> queue{room_};
    while (!queue.empty() && queue.front() != stop.room) {
      const size_t room = queue.front();
      queue.pop_front();
      for (const Link& link : links_) {
        for (size_t side = 0; side < 2; ++side) {
          const size_t next = link.rooms[1 - side];
          if (link.rooms[side] != room || next == room_ || entered_by[next].first) continue;
          entered_by[next] = {&link, side};
          queue.push_back(next);
        }
      }
    }
    if (queue.empty()) fail(stop, "no doors lead there");
    std::vector<std::pair<const Link*, size_t>> way;
    for (size_t room = stop.room; room != room_;) {
      way.push_back(entered_by[room]);
      room = way.back().first->rooms[way.back().second];
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// Where the stop asks the robot to be, for a round beginning with the place nearest to it.
  Polygon2 placesOf(const TourStop& stop) {
    if (!stop.points.empty()) return stop.points;
    const RoomPlanner& planner = plannerOf(stop.room);
    if (stop.pass_through) return {planner.middle()};
    Polygon2 places = planner.round(building_.rooms[stop.room].kind);
    if (places.empty() || route_.empty()) return places;
    const auto nearest =
        std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
          return (a - position()).norm() < (b - position()).norm();
        });
    std::rotate(places.begin(), nearest, places.end());
    return places;
  }

  const Building& building_;
  const std::vector<FloorPlan>& plans_;
  std::vector<std::unique_ptr<RoomPlanner>> planners_;  ///< One for each room, made when needed.
  std::vector<Link> links_;
  Route route_;
  size_t room_ = 0;  ///< Of the end of the route.
};

}  // namespace

Route planTour(const Building& building, const std::vector<FloorPlan>& plans) {
  return TourPlanner(building, plans).plan();
}

}  // namespace mrpt_sgraphs::sim
