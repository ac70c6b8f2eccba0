// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_reunion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mrpt_sgraphs/graph/uncertainty.h"
#include "mrpt_sgraphs/semantics/places.h"
#include "mrpt_sgraphs/semantics/room_matching.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSameShape = 0.8;       ///< Of each other's ground.
constexpr double kSameDoorway_m = 0.5;   ///< Doorways of rooms laid upon each other,
constexpr double kOtherDoorway_m = 1.0;  ///< and where they lie apart in the map.
constexpr double kSamePlace_m = 0.5;     ///< Rooms that lie upon each other need no loop.
/// Uncertainties that are added up know nothing of systematic errors, and outlines are drawn on
/// cells.
constexpr double kGateInflation = 4.0;
constexpr double kGuessSigma_m = 0.15;
constexpr double kGuessSigma_rad = 0.02;

const RoomNode* roomOf(const KeyframeNode& keyframe, const GraphSnapshot& graph) {
  for (const RoomNode& room : graph.rooms) {
    // of a keyframe that no detection has seen yet, its place tells
    if (keyframe.room ? *keyframe.room == room.id
                      : (!keyframe.floor || room.floor == keyframe.floor) &&
                            isAround(room, keyframe.T_map_base.translation())) {
      return &room;
    }
  }
  return nullptr;
}

/// The motion of the map that lays the younger room upon the older one, by the least of the turns
/// that its axes allow.
Pose motionOnto(const RoomNode& older, const RoomNode& younger) {
  const Eigen::Matrix3d R = older.T_map_room.linear().transpose() * younger.T_map_room.linear();
  const double step = younger.kind == RoomAttributes::Kind::kCorridor ? M_PI : 0.5 * M_PI;
  const double turns = std::round(std::atan2(R(1, 0), R(0, 0)) / step);
  Pose T_map_turned = younger.T_map_room;
  T_map_turned.linear() = (T_map_turned.linear() * expSO3({0.0, 0.0, -turns * step})).eval();
  return older.T_map_room * T_map_turned.inverse();
}

bool haveOneShape(const RoomNode& older, const RoomNode& younger, const Pose& T_map_moved) {
  const PlanarExtent moved = T_map_moved * younger.extent_map;
  return coveredShare(older.extent_map, moved) > kSameShape &&
         coveredShare(moved, older.extent_map) > kSameShape;
}

/// Every way out of the younger room that leads to a room is one of the older, and at least one is.
bool haveTheSameNeighbours(const RoomNode& older, const RoomNode& younger,
                           const Pose& T_map_moved) {
  bool one = false;
  for (const Doorway& doorway : younger.doorways) {
    if (!doorway.to) continue;
    const Eigen::Vector3d moved = T_map_moved * doorway.centre_map;
    const auto same =
        std::find_if(older.doorways.begin(), older.doorways.end(), [&moved](const Doorway& other) {
          return (other.centre_map - moved).norm() < kSameDoorway_m;
        });
    if (same == older.doorways.end() || doorway.to == older.id) return false;
    const double apart_m = (same->centre_map - doorway.centre_map).norm();
    if (same->to == doorway.to && apart_m > kOtherDoorway_m) return false;
    one = true;
  }
  return one;
}

/// The keyframe of a room that is the nearest to a place, of those with a cloud if there are any.
std::optional<std::size_t> nearestOf(RoomId room, const Eigen::Vector3d& place_map,
                                     const GraphSnapshot& graph) {
  std::optional<std::size_t> nearest;
  std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < graph.keyframes.size(); ++k) {
    const KeyframeNode& keyframe = graph.keyframes[k];
    if (keyframe.room != room) continue;
    const double distance_m = (keyframe.T_map_base.translation() - place_map).norm();
    const std::pair<bool, double> rank{keyframe.cloud == nullptr, distance_m};
    if (rank >= least) continue;
    least = rank;
    nearest = k;
  }
  return nearest;
}

bool canBeDrift(const Pose& T_old_newest, const Pose& guess, const Matrix6& uncertainty,
                double max_chi2) {
  Matrix6 gate = kGateInflation * uncertainty;
  gate.diagonal().head<3>().array() += kGuessSigma_m * kGuessSigma_m;
  gate.diagonal().tail<3>().array() += kGuessSigma_rad * kGuessSigma_rad;
  const Tangent surprise = local(T_old_newest, guess);
  return surprise.dot(gate.ldlt().solve(surprise)) <= max_chi2;
}

}  // namespace

std::optional<RoomReunion> findReunion(const GraphSnapshot& graph, double max_chi2) {
  if (graph.keyframes.empty()) return std::nullopt;
  const KeyframeNode& newest = graph.keyframes.back();
  const RoomNode* const younger = roomOf(newest, graph);
  if (younger == nullptr) return std::nullopt;
  std::vector<Matrix6> uncertainty;  // of no use to most keyframes
  std::optional<RoomReunion> found;
  for (const RoomNode& older : graph.rooms) {
    if (!(older.id < younger->id) || older.kind != younger->kind) continue;
    if (older.floor != younger->floor) continue;
    const Pose T_map_moved = motionOnto(older, *younger);
    const Eigen::Vector3d centre_map = younger->T_map_room.translation();
    if ((T_map_moved * centre_map - centre_map).norm() < kSamePlace_m) continue;
    if (!haveOneShape(older, *younger, T_map_moved)) continue;
    if (!haveTheSameNeighbours(older, *younger, T_map_moved)) continue;
    const Pose T_map_newest = T_map_moved * newest.T_map_base;
    const auto nearest = nearestOf(older.id, T_map_newest.translation(), graph);
    if (!nearest) continue;
    if (uncertainty.empty()) uncertainty = uncertaintyToNewest(graph);
    const Pose T_old_map = graph.keyframes[*nearest].T_map_base.inverse();
    const Pose guess = T_old_map * T_map_newest;
    if (!canBeDrift(T_old_map * newest.T_map_base, guess, uncertainty[*nearest], max_chi2)) {
      continue;
    }
    if (found) return std::nullopt;
    found = RoomReunion{older.id, younger->id, graph.keyframes[*nearest].id, guess};
  }
  return found;
}

}  // namespace mrpt_sgraphs
