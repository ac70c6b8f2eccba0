// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "random_graph.h"

#include <limits>
#include <memory>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class Maker {
 public:
  Maker(double damage, Dice* dice)
      : dice_(*dice),
        damage_(damage),
        extent_m_(dice->oneOf(std::vector<double>{0.0, 1.0, 50.0, 1e6})),
        kernels_(dice->chance(0.3) ? 0.5 : 0.0) {}

  RandomGraph make() {
    makeNodes();
    if (graph_.nodes.empty()) return graph_;
    makeChain();
    const std::size_t factors = dice_.below(2 * graph_.nodes.size() + 1);
    for (std::size_t k = 0; k < factors; ++k) {
      attempt([&] { return makeFactor(); });
      if (!graph_.factors.empty() && dice_.chance(0.05)) {
        graph_.factors.push_back(dice_.oneOf(graph_.factors));
      }
    }
    return graph_;
  }

 private:
  double wild() {
    return dice_.oneOf(std::vector<double>{kNaN, kInfinity, -kInfinity, 1e308, -1e308, 1e200, 1e100,
                                           1e30, 1e-300, 5e-324, 0.0, -1.0});
  }

  /// A number of a measurement or an estimate, damaged now and then.
  void maybeDamage(double* value) {
    if (dice_.chance(damage_)) *value = wild();
  }
  Pose damaged(Pose T) {
    if (dice_.chance(0.3)) maybeDamage(&T.translation()[static_cast<int>(dice_.below(3))]);
    if (dice_.chance(0.1)) maybeDamage(&T.matrix()(0, 1));
    return T;
  }
  Plane damaged(Plane plane) {
    if (dice_.chance(0.3)) maybeDamage(&plane.distance);
    if (dice_.chance(0.1)) maybeDamage(&plane.normal[static_cast<int>(dice_.below(3))]);
    return plane;
  }

  Plane plane() {
    const std::vector<Eigen::Vector3d> axes{Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitZ(),
                                            Eigen::Vector3d::UnitX(), dice_.direction()};
    Plane plane{dice_.oneOf(axes), dice_.number(extent_m_)};
    if (!graph_.nodes.empty() && dice_.chance(0.2)) {  // through a pose
      if (const Pose* T = std::get_if<Pose>(&dice_.oneOf(graph_.nodes).value)) {
        plane.distance = plane.normal.dot(T->translation());
      }
    }
    return plane;
  }

  template <int Rows>
  Eigen::Matrix<double, Rows, Rows> information() {
    Eigen::Matrix<double, Rows, Rows> root;
    for (int k = 0; k < Rows * Rows; ++k) root(k) = dice_.number(10.0);
    Eigen::Matrix<double, Rows, Rows> result = root * root.transpose();
    if (dice_.chance(0.1)) {  // of rank one
      result = root.col(0) * root.col(0).transpose();
    } else if (dice_.chance(0.7)) {
      result.diagonal().array() += 1.0;
    }
    result = 0.5 * (result + result.transpose()).eval();
    if (dice_.chance(damage_)) damage(&result);
    return result;
  }

  template <typename Matrix>
  void damage(Matrix* matrix) {
    const auto any = [&] {
      return static_cast<Eigen::Index>(dice_.below(static_cast<std::size_t>(matrix->rows())));
    };
    if (matrix->rows() == 0) return;
    switch (dice_.below(6)) {
      case 0: {  // one entry and its mirror image
        const Eigen::Index i = any();
        const Eigen::Index j = any();
        (*matrix)(i, j) = (*matrix)(j, i) = wild();
        break;
      }
      case 1:  // asymmetric
        (*matrix)(any(), any()) += dice_.number(1e3);
        break;
      case 2:
        *matrix *= dice_.oneOf(std::vector<double>{1e300, 1e150, 1e30, 1e-30, 1e-300});
        break;
      case 3:
        matrix->setZero();
        break;
      case 4:
        *matrix *= -1.0;
        break;
      default: {
        const Eigen::Index i = any();
        (*matrix)(i, i) -= dice_.oneOf(std::vector<double>{1e2, 1e7, 1e300});
      }
    }
  }

  RobustKernel kernel() {
    using Kind = RobustKernel::Kind;
    if (!dice_.chance(kernels_)) return {};
    RobustKernel kernel{dice_.chance(0.5) ? Kind::kHuber : Kind::kCauchy, 10.0 * dice_.unit()};
    maybeDamage(&kernel.width_chi2);
    return kernel;
  }

  void makeNodes() {
    const double fixed = dice_.oneOf(std::vector<double>{0.0, 0.0, 0.1, 1.0});
    std::size_t left = dice_.oneOf(std::vector<std::size_t>{0, 1, 3, 10, 30, 60});
    left = left > 1 ? 1 + dice_.below(left) : left;
    const bool only_poses = dice_.chance(0.2);
    for (; left > 0; --left) {
      const std::size_t kind = only_poses ? 0 : dice_.below(8);
      const bool is_plane = kind == 4 || kind == 5 || kind == 6;
      RandomGraph::Node node;
      node.fixed = dice_.chance(fixed);
      if (is_plane) {
        node.value = damaged(plane());
      } else {
        node.value = damaged(dice_.pose(extent_m_));
      }
      const uint64_t value = dice_.chance(0.02) ? dice_.below(3) : counts_[kind < 4 ? 0 : kind]++;
      if (kind < 4) node.id = KeyframeId{value};
      if (kind == 4 || kind == 5) node.id = WallId{value + 100 * kind};
      if (kind == 6) node.id = FloorId{value};
      if (kind == 7) node.id = RoomId{value};
      graph_.nodes.push_back(node);
    }
  }

  /// @param make  Gives a factor, or null if the graph has not the nodes for it.
  template <typename Make>
  void attempt(const Make& make) {
    try {
      if (FactorConstPtr factor = make()) graph_.factors.push_back(std::move(factor));
    } catch (const std::invalid_argument& error) {
      graph_.refusals.push_back(error);
    }
  }

  /// Keyframe after keyframe; torn here and there in every second graph.
  void makeChain() {
    const double torn = dice_.chance(0.5) ? 0.0 : 0.3;
    const RandomGraph::Node* last = nullptr;
    for (const RandomGraph::Node& node : graph_.nodes) {
      if (node.id.layer != Layer::kKeyframe) continue;
      if (last != nullptr && !dice_.chance(torn)) {
        attempt(
            [&] { return relativePose(last->id, node.id, RelativePoseFactor::Kind::kOdometry); });
      }
      last = &node;
    }
  }

  /// Of the layer, if the graph has one; now and then one that it has not.
  template <typename AnyId>
  bool pick(AnyId* id) {
    std::vector<uint64_t> found;
    for (const RandomGraph::Node& node : graph_.nodes) {
      if (node.id.layer == NodeId(*id).layer) found.push_back(node.id.value);
    }
    if (found.empty()) return false;
    id->value = dice_.chance(0.003) ? 999 : dice_.oneOf(found);
    return true;
  }
  bool pickAny(bool plane, NodeId* id) {
    std::vector<NodeId> found;
    for (const RandomGraph::Node& node : graph_.nodes) {
      if (isPlane(node.id.layer) == plane) found.push_back(node.id);
    }
    if (found.empty()) return false;
    *id = dice_.oneOf(found);
    return true;
  }

  template <typename Value>
  Value valueOf(NodeId id, const Value& otherwise) {
    for (const RandomGraph::Node& node : graph_.nodes) {
      if (node.id == id) return std::get<Value>(node.value);
    }
    return otherwise;
  }
  Pose poseOf(NodeId id) { return valueOf<Pose>(id, Pose::Identity()); }
  Plane planeOf(NodeId id) { return valueOf<Plane>(id, Plane{}); }

  /// As it is but for noise; or anything.
  Pose measuredPose(NodeId from, NodeId to) {
    Tangent noise;
    noise << dice_.vector(0.1), dice_.vector(0.05);
    return damaged(dice_.chance(0.1) ? dice_.pose(extent_m_)
                                     : poseOf(from).inverse() * poseOf(to) * expPose(noise));
  }
  Plane measuredPlane(const Pose& T_map_base, NodeId surface) {
    return damaged(dice_.chance(0.1)
                       ? plane()
                       : retract(inverseTimes(T_map_base, planeOf(surface)), dice_.vector(0.05)));
  }

  FactorConstPtr relativePose(NodeId from, NodeId to, RelativePoseFactor::Kind kind) {
    return std::make_shared<RelativePoseFactor>(from, to, measuredPose(from, to), information<6>(),
                                                kind, kernel());
  }

  /// @return Null if the graph has not the nodes for it.
  FactorConstPtr makeFactor() {
    KeyframeId keyframe;
    WallId a, b;
    RoomId room;
    FloorId floor;
    NodeId from, to, surface;
    const bool with_plane = pickAny(true, &surface);
    switch (dice_.below(12)) {
      case 0:
        if (!pickAny(false, &from) || !pickAny(false, &to)) return nullptr;
        return relativePose(
            from, to, static_cast<RelativePoseFactor::Kind>(static_cast<int>(dice_.below(4))));
      case 1:
        if (!pickAny(false, &from) || !pickAny(false, &to)) return nullptr;
        return std::make_shared<RelativePoseQuaternionFactor>(from, to, measuredPose(from, to),
                                                              information<6>(), kernel());
      case 2:
      case 3:
        if (!pick(&keyframe) || !with_plane) return nullptr;
        return std::make_shared<PlaneObservationFactor>(keyframe, surface,
                                                        measuredPlane(poseOf(keyframe), surface),
                                                        information<3>(), kernel());
      case 4:
        if (!pick(&room) || !pick(&a)) return nullptr;
        return std::make_shared<RoomWallFactor>(room, a, damaged(plane()).normal, information<2>(),
                                                kernel());
      case 5:
        if (!pick(&room) || !pick(&a) || !pick(&b)) return nullptr;
        return std::make_shared<RoomCentreFactor>(room, a, b, information<1>(), kernel());
      case 6:
        if (!pick(&room) || !pick(&floor)) return nullptr;
        return std::make_shared<FloorRoomFactor>(floor, room, information<3>(), kernel());
      case 7: {
        if (!pick(&keyframe) || !pick(&a) || !pick(&b)) return nullptr;
        const Plane face = damaged(plane());
        return std::make_shared<WallPairFactor>(keyframe, a, b, face.normal, face.distance,
                                                information<3>(), kernel());
      }
      case 8:
        if (!dice_.chance(0.2) || !pickAny(false, &to)) return nullptr;
        return std::make_shared<PosePriorFactor>(to, measuredPose(to, to) * poseOf(to),
                                                 information<6>(), kernel());
      case 9: {
        if (!dice_.chance(0.2) || !with_plane) return nullptr;
        const Pose reference = damaged(dice_.pose(extent_m_));
        return std::make_shared<PlanePriorFactor>(
            surface, reference, measuredPlane(reference, surface), information<3>(), kernel());
      }
      case 10:
        return dice_.chance(0.2) && with_plane ? summed(surface) : nullptr;
      default:
        return pick(&keyframe) ? condensed(keyframe) : nullptr;
    }
  }

  FactorConstPtr summed(NodeId surface) {
    ObservationSum sum(planeOf(surface), dice_.vector(extent_m_));
    for (std::size_t k = dice_.below(4); k > 0; --k) {
      const Pose T = damaged(dice_.pose(extent_m_));
      sum.add({KeyframeId{0}, surface, measuredPlane(T, surface), information<3>()}, T);
    }
    if (dice_.chance(damage_)) damage(&sum.A);
    maybeDamage(&sum.c);
    return std::make_shared<SummedObservationsFactor>(surface, sum);
  }

  FactorConstPtr condensed(KeyframeId kept) {
    std::vector<CondensedFactor::Other> others;
    Eigen::Index rows = 0;
    for (std::size_t k = dice_.below(6); k > 0; --k) {
      const NodeId node = dice_.oneOf(graph_.nodes).id;
      others.push_back({node, Pose::Identity()});
      if (isPlane(node.layer)) {
        others.back().seen_kept = measuredPlane(poseOf(kept), node);
      } else {
        others.back().seen_kept = measuredPose(kept, node);
      }
      rows += tangentSize(node.layer);
    }
    Eigen::MatrixXd root(rows, rows);
    for (Eigen::Index k = 0; k < rows * rows; ++k) root(k) = dice_.number(3.0);
    if (rows > 0 && dice_.chance(0.3)) root.row(0).setZero();
    CondensedFactor::Quadratic quadratic;
    quadratic.Lambda = root.transpose() * root;
    Eigen::VectorXd e(rows);
    for (Eigen::Index k = 0; k < rows; ++k) e(k) = dice_.number(0.1);
    quadratic.eta = quadratic.Lambda * e;
    quadratic.c = e.dot(quadratic.eta);
    if (dice_.chance(damage_)) damage(&quadratic.Lambda);
    if (rows > 0) maybeDamage(&quadratic.eta(0));
    maybeDamage(&quadratic.c);
    return std::make_shared<CondensedFactor>(kept, others, quadratic);
  }

  Dice& dice_;
  const double damage_;
  const double extent_m_;
  const double kernels_;
  std::size_t counts_[8] = {};
  RandomGraph graph_;
};

}  // namespace

RandomGraph randomGraph(double damage, Dice* dice) { return Maker(damage, dice).make(); }

double randomDamage(Dice* dice) {
  return dice->oneOf(std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.005, 0.02, 0.1, 1.0});
}

}  // namespace mrpt_sgraphs::test
