// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/semantics/room_factors.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>

#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/room_walls.h"

namespace mrpt_sgraphs {
namespace {

// Weights of what only places the room: nothing else depends on them.
constexpr double kCentreSigma_m = 0.02;
constexpr double kPoseSigma_m = 0.05;
constexpr double kPoseSigma_rad = 0.02;

double inverseSquare(double sigma) { return 1.0 / (sigma * sigma); }

/// The information of a wall's direction, in the factor's own basis.
/// @param heading  1/rad^2; zero where the wall may head anywhere.
Eigen::Matrix2d directionInformation(const Eigen::Vector3d& axis_room, double heading,
                                     double upright) {
  const TangentBasis basis = tangentBasis(axis_room);
  const Eigen::Vector2d up = basis.transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d level =
      basis.transpose() * Eigen::Vector3d::UnitZ().cross(axis_room).normalized();
  return heading * level * level.transpose() + upright * up * up.transpose();
}

/// Along the directions that `held` says nothing on.
/// @param held  A sum of squares of unit vectors.
Eigen::Matrix3d openDirections(const Eigen::Matrix3d& held) {
  constexpr double kHeld = 0.1;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(held);
  Eigen::Matrix3d open = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (solver.eigenvalues()(k) > kHeld) continue;
    open += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose();
  }
  return open;
}

/// Collects the factors of one room, and what of its pose they hold.
class Factors {
 public:
  Factors(RoomId id, const DetectedRoom& room, const RoomLayerConfig& config,
          const RightAngles& exactness, const LayeredGraph& graph)
      : id_(id), room_(room), config_(config), exactness_(exactness), graph_(graph) {}

  void addWalls() {
    const RobustKernel doubt{RobustKernel::Kind::kCauchy, config_.kernel_chi2};
    const double upright = inverseSquare(exactness_.upright_rad);
    for (const BoundingWall& wall : room_.walls) {
      if (!graph_.contains(wall.id)) continue;
      const auto right = rightAngledAxis(wall, config_.max_angle_rad);
      const double heading = right ? inverseSquare(exactness_.right_angle_rad) : 0.0;
      const Eigen::Vector3d axis = right.value_or(wall.axis_room);
      factors_.push_back(std::make_shared<RoomWallFactor>(
          id_, wall.id, axis, directionInformation(axis, heading, upright), doubt));
      const Eigen::Vector3d hinge = axis.cross(Eigen::Vector3d::UnitZ());
      held_rotation_ += hinge * hinge.transpose();
      if (right) held_rotation_ += Eigen::Vector3d::UnitZ() * Eigen::RowVector3d::UnitZ();
    }
  }

  /// One pair in each direction: a polygon's walls that face each other are no two sides of it.
  void addCentres() {
    using Kind = RoomAttributes::Kind;
    if (room_.kind != Kind::kFourWalls && room_.kind != Kind::kCorridor) return;
    for (const int along : {0, 1}) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(along);
      const std::optional<WallId> a = wallAlong(axis);
      const std::optional<WallId> b = wallAlong(-axis);
      if (!a || !b) continue;
      const RoomCentreFactor::Information information(inverseSquare(kCentreSigma_m));
      factors_.push_back(std::make_shared<RoomCentreFactor>(id_, *a, *b, information));
      held_translation_ += axis * axis.transpose();
    }
  }

  void addFloor() {
    if (!room_.floor || !graph_.contains(*room_.floor)) return;
    const double upright = inverseSquare(exactness_.floor_rad);
    const Eigen::Vector3d information(upright, upright, inverseSquare(kCentreSigma_m));
    factors_.push_back(
        std::make_shared<FloorRoomFactor>(*room_.floor, id_, information.asDiagonal()));
    held_translation_ += Eigen::Vector3d::UnitZ() * Eigen::RowVector3d::UnitZ();
    held_rotation_ += Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal();
  }

  /// What is still open; a residual of zero rows would be none.
  void addPose() {
    Matrix6 information = Matrix6::Zero();
    information.topLeftCorner<3, 3>() =
        inverseSquare(kPoseSigma_m) * openDirections(held_translation_);
    information.bottomRightCorner<3, 3>() =
        inverseSquare(kPoseSigma_rad) * openDirections(held_rotation_);
    if (information.isZero()) return;
    const KeyframeId stays =
        graph_.attributes(room_.anchor).representative.value_or(room_.anchor);
    const Pose T_stays_room = orthonormalized(graph_.pose(stays).inverse() *
                                              graph_.pose(room_.anchor) * room_.T_anchor_room);
    factors_.push_back(std::make_shared<RelativePoseFactor>(
        stays, id_, T_stays_room, information, RelativePoseFactor::Kind::kRoom));
  }

  const std::vector<FactorConstPtr>& all() const { return factors_; }

 private:
  std::optional<WallId> wallAlong(const Eigen::Vector3d& axis) const {
    constexpr double kAlong = 0.9;
    for (const BoundingWall& wall : room_.walls) {
      if (!graph_.contains(wall.id)) continue;
      const auto right = rightAngledAxis(wall, config_.max_angle_rad);
      if (right && right->dot(axis) > kAlong) return wall.id;
    }
    return std::nullopt;
  }

  RoomId id_;
  const DetectedRoom& room_;
  const RoomLayerConfig& config_;
  const RightAngles& exactness_;
  const LayeredGraph& graph_;
  std::vector<FactorConstPtr> factors_;
  Eigen::Matrix3d held_translation_ = Eigen::Matrix3d::Zero();  ///< In the room's axes,
  Eigen::Matrix3d held_rotation_ = Eigen::Matrix3d::Zero();     ///< as this.
};

template <typename Residual>
bool sameWeight(const Residual& a, const Residual& b) {
  constexpr double kRelative = 1e-3;
  return (a.information() - b.information()).norm() <= kRelative * a.information().norm();
}

bool saysTheSame(const RoomWallFactor& a, const RoomWallFactor& b) {
  constexpr double kAngle_rad = 0.02;  // of walls that may head anywhere
  return (a.axis_room - b.axis_room).norm() < kAngle_rad && sameWeight(a, b);
}
bool saysTheSame(const RoomCentreFactor& a, const RoomCentreFactor& b) { return sameWeight(a, b); }
bool saysTheSame(const FloorRoomFactor& a, const FloorRoomFactor& b) { return sameWeight(a, b); }
bool saysTheSame(const RelativePoseFactor& a, const RelativePoseFactor& b) {
  // only what is open counts
  const Tangent e = local(a.T_from_to, b.T_from_to);
  return sameWeight(a, b) && e.dot(a.information() * e) < 1.0;
}

/// Whether both are of one kind and say the same; nothing if `a` is of another kind.
template <typename Kind>
std::optional<bool> sameAs(const Factor& a, const Factor& b) {
  const auto* first = dynamic_cast<const Kind*>(&a);
  if (first == nullptr) return std::nullopt;
  const auto* second = dynamic_cast<const Kind*>(&b);
  return second != nullptr && saysTheSame(*first, *second);
}

bool saysTheSame(const Factor& a, const Factor& b) {
  if (a.nodeCount() != b.nodeCount()) return false;
  for (int k = 0; k < a.nodeCount(); ++k) {
    if (a.node(k) != b.node(k)) return false;
  }
  for (const auto same : {sameAs<RoomWallFactor>(a, b), sameAs<RoomCentreFactor>(a, b),
                          sameAs<FloorRoomFactor>(a, b), sameAs<RelativePoseFactor>(a, b)}) {
    if (same) return *same;
  }
  return false;
}

}  // namespace

std::optional<Eigen::Vector3d> rightAngledAxis(const BoundingWall& wall, double max_angle_rad) {
  const Eigen::Vector3d& axis = wall.axis_room;
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  const int along = std::abs(axis.x()) >= std::abs(axis.y()) ? 0 : 1;
  nearest(along) = std::copysign(1.0, axis(along));
  if (axis.dot(nearest) < std::cos(max_angle_rad)) return std::nullopt;
  return nearest;
}

std::vector<FactorConstPtr> roomFactors(RoomId id, const DetectedRoom& room,
                                        const RoomLayerConfig& config, const RightAngles& exactness,
                                        const LayeredGraph& graph) {
  Factors factors(id, room, config, exactness, graph);
  if (config.factors) {
    factors.addWalls();
    factors.addCentres();
    factors.addFloor();
  }
  factors.addPose();
  return factors.all();
}

bool exchangeFactors(RoomId id, const std::vector<FactorConstPtr>& wanted, LayeredGraph* graph) {
  std::vector<FactorId> stale;
  std::vector<bool> is_there(wanted.size(), false);
  for (const Topology::Links* links : {&graph->sightingsOf(id), &graph->otherFactorsOf(id)}) {
    for (const FactorLink& link : *links) {
      const Factor& factor = *graph->factor(link.id);
      std::size_t same = 0;
      while (same < wanted.size() && (is_there[same] || !saysTheSame(factor, *wanted[same])))
        ++same;
      if (same < wanted.size()) {
        is_there[same] = true;
      } else {
        stale.push_back(link.id);
      }
    }
  }
  std::sort(stale.begin(), stale.end());
  for (const FactorId factor : stale) graph->eraseFactor(factor);
  bool changed = !stale.empty();
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (is_there[k]) continue;
    graph->addFactor(wanted[k]);
    changed = true;
  }
  return changed;
}

}  // namespace mrpt_sgraphs
