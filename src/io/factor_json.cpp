// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "factor_json.h"

#include <map>
#include <stdexcept>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/io/information_check.h"

namespace mrpt_sgraphs {
namespace {

// Writing: what each type has beside its type, its nodes, information and kernel.

void write(const RelativePoseFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(factor.T_from_to);
}
void write(const RelativePoseQuaternionFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(factor.T_from_to);
}
void write(const PlaneObservationFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(factor.measured_base);
}
void write(const RoomWallFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(Eigen::VectorXd(factor.axis_room));
}
void write(const RoomCentreFactor&, Json*) {}
void write(const FloorRoomFactor&, Json*) {}
void write(const WallPairFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(Plane{factor.normal_a_base, factor.thickness_m});
}
void write(const PosePriorFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(factor.prior_map);
}
void write(const PlanePriorFactor& factor, Json* json) {
  (*json)["measurement"] = toJson(factor.prior_reference);
  (*json)["reference"] = toJson(factor.T_map_reference);
}

void writeWeight(const SummedObservationsFactor& factor, Json* json) {
  const ObservationSum& sum = factor.sum;
  (*json)["measurement"] = toJson(sum.reference_point);
  (*json)["reference"] = toJson(Eigen::VectorXd(sum.point_map));
  (*json)["information"] = upperTriangle(sum.A);
  (*json)["linear"] = toJson(Eigen::VectorXd(sum.b));
  (*json)["constant"] = sum.c;
}
void writeWeight(const CondensedFactor& factor, Json* json) {
  Json seen = Json::array();
  Json ways = Json::array();
  for (const CondensedFactor::Other& other : factor.others()) {
    seen.push_back(std::visit([](const auto& value) { return toJson(value); }, other.seen_kept));
    ways.push_back(other.way_covariance ? upperTriangle(*other.way_covariance) : Json(nullptr));
  }
  (*json)["measurement"] = seen;
  (*json)["ways"] = ways;
  (*json)["information"] = upperTriangle(factor.quadratic().Lambda);
  (*json)["linear"] = toJson(factor.quadratic().eta);
  (*json)["constant"] = factor.quadratic().c;
}
template <typename AnyFactor>
void writeWeight(const AnyFactor& factor, Json* json) {
  write(factor, json);
  (*json)["information"] = upperTriangle(factor.information());
  if (factor.kernel().kind != RobustKernel::Kind::kNone) {
    const bool huber = factor.kernel().kind == RobustKernel::Kind::kHuber;
    (*json)["kernel"] = {{"type", huber ? "huber" : "cauchy"},
                         {"width_chi2", factor.kernel().width_chi2}};
  }
}

template <typename AnyFactor>
bool writeIf(const Factor& factor, Json* json) {
  const auto* const of_this_type = dynamic_cast<const AnyFactor*>(&factor);
  if (of_this_type != nullptr) writeWeight(*of_this_type, json);
  return of_this_type != nullptr;
}

// Reading.

/// A node of the layer that the factor's type has there.
template <typename AnyId>
AnyId idAt(const JsonPlace& factor, std::size_t index) {
  const JsonPlace nodes = factor["nodes"];
  const JsonPlace place = nodes[index];
  const NodeId node = place.node();
  if (node != NodeId(AnyId{node.value})) place.fail("is of the wrong layer for such a factor");
  return AnyId{node.value};
}

NodeId nodeAt(const JsonPlace& factor, std::size_t index, bool plane) {
  const JsonPlace nodes = factor["nodes"];
  const JsonPlace place = nodes[index];
  const NodeId node = place.node();
  if (isPlane(node.layer) != plane) place.fail(plane ? "is no wall or floor" : "has no pose");
  return node;
}

template <int Rows>
Eigen::Matrix<double, Rows, Rows> informationOf(const JsonPlace& factor) {
  return factor["information"].symmetric(Rows);
}

RobustKernel kernelOf(const JsonPlace& factor) {
  if (!factor.has("kernel")) return {};
  const JsonPlace kernel = factor["kernel"];
  const std::string type = kernel["type"].string();
  if (type != "huber" && type != "cauchy") kernel["type"].fail("is neither huber nor cauchy");
  const double width_chi2 = kernel["width_chi2"].number();
  if (!(width_chi2 > 0.0)) kernel["width_chi2"].fail("is not positive");
  return {type == "huber" ? RobustKernel::Kind::kHuber : RobustKernel::Kind::kCauchy, width_chi2};
}

template <RelativePoseFactor::Kind kKind>
FactorConstPtr relativePose(const JsonPlace& factor) {
  return std::make_shared<RelativePoseFactor>(nodeAt(factor, 0, false), nodeAt(factor, 1, false),
                                              factor["measurement"].pose(),
                                              informationOf<6>(factor), kKind, kernelOf(factor));
}

FactorConstPtr relativePoseQuaternion(const JsonPlace& factor) {
  return std::make_shared<RelativePoseQuaternionFactor>(
      nodeAt(factor, 0, false), nodeAt(factor, 1, false), factor["measurement"].pose(),
      informationOf<6>(factor), kernelOf(factor));
}

template <typename SurfaceId>
FactorConstPtr planeObservation(const JsonPlace& factor) {
  return std::make_shared<PlaneObservationFactor>(
      idAt<KeyframeId>(factor, 0), idAt<SurfaceId>(factor, 1), factor["measurement"].plane(),
      informationOf<3>(factor), kernelOf(factor));
}

FactorConstPtr roomWall(const JsonPlace& factor) {
  return std::make_shared<RoomWallFactor>(idAt<RoomId>(factor, 0), idAt<WallId>(factor, 1),
                                          factor["measurement"].unitVector(),
                                          informationOf<2>(factor), kernelOf(factor));
}

FactorConstPtr roomCentre(const JsonPlace& factor) {
  return std::make_shared<RoomCentreFactor>(idAt<RoomId>(factor, 0), idAt<WallId>(factor, 1),
                                            idAt<WallId>(factor, 2), informationOf<1>(factor),
                                            kernelOf(factor));
}

FactorConstPtr floorRoom(const JsonPlace& factor) {
  return std::make_shared<FloorRoomFactor>(idAt<FloorId>(factor, 0), idAt<RoomId>(factor, 1),
                                           informationOf<3>(factor), kernelOf(factor));
}

FactorConstPtr wallPair(const JsonPlace& factor) {
  const Plane measured = factor["measurement"].plane();
  return std::make_shared<WallPairFactor>(
      idAt<KeyframeId>(factor, 0), idAt<WallId>(factor, 1), idAt<WallId>(factor, 2),
      measured.normal, measured.distance, informationOf<3>(factor), kernelOf(factor));
}

FactorConstPtr posePrior(const JsonPlace& factor) {
  return std::make_shared<PosePriorFactor>(nodeAt(factor, 0, false), factor["measurement"].pose(),
                                           informationOf<6>(factor), kernelOf(factor));
}

FactorConstPtr planePrior(const JsonPlace& factor) {
  return std::make_shared<PlanePriorFactor>(nodeAt(factor, 0, true), factor["reference"].pose(),
                                            factor["measurement"].plane(), informationOf<3>(factor),
                                            kernelOf(factor));
}

FactorConstPtr summedObservations(const JsonPlace& factor) {
  ObservationSum sum;
  sum.reference_point = factor["measurement"].plane();
  sum.point_map = factor["reference"].vector(3);
  sum.A = informationOf<4>(factor);
  sum.b = factor["linear"].vector(4);
  sum.c = factor["constant"].number();
  return std::make_shared<SummedObservationsFactor>(nodeAt(factor, 0, true), sum);
}

/// How well the way to another node of a condensed factor is known, if there is one.
std::optional<Matrix6> wayTo(NodeId node, const JsonPlace& place) {
  if (place.isNull()) return std::nullopt;
  if (node.layer != Layer::kKeyframe) place.fail("is a way to " + nameOf(node));
  const Matrix6 covariance = place.symmetric(6);
  if (!isPositiveSemidefinite(covariance)) place.fail("is not positive semidefinite");
  return covariance;
}

FactorConstPtr condensed(const JsonPlace& factor) {
  const auto kept = idAt<KeyframeId>(factor, 0);
  const JsonPlace nodes = factor["nodes"];
  const JsonPlace seen = factor["measurement"];
  seen.requireSize(nodes.size() - 1);
  std::vector<CondensedFactor::Other> others;
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const NodeId node = nodes[k + 1].node();
    others.push_back({node, Pose::Identity()});
    if (isPlane(node.layer)) {
      others.back().seen_kept = seen[k].plane();
    } else {
      others.back().seen_kept = seen[k].pose();
    }
    rows += tangentSize(node.layer);
  }
  if (factor.has("ways")) {
    const JsonPlace ways = factor["ways"];
    ways.requireSize(others.size());
    for (std::size_t k = 0; k < others.size(); ++k) {
      others[k].way_covariance = wayTo(others[k].node, ways[k]);
    }
  }
  return std::make_shared<CondensedFactor>(
      kept, std::move(others),
      CondensedFactor::Quadratic{factor["information"].symmetric(rows),
                                 factor["linear"].vector(rows), factor["constant"].number()});
}

const std::map<std::string, FactorConstPtr (*)(const JsonPlace&)>& readers() {
  using Kind = RelativePoseFactor::Kind;
  static const std::map<std::string, FactorConstPtr (*)(const JsonPlace&)> kReaders{
      {"odometry", relativePose<Kind::kOdometry>},
      {"loop_closure", relativePose<Kind::kLoopClosure>},
      {"bridge", relativePose<Kind::kBridge>},
      {"room_pose", relativePose<Kind::kRoom>},
      {"relative_pose_quaternion", relativePoseQuaternion},
      {"wall_observation", planeObservation<WallId>},
      {"ground_observation", planeObservation<FloorId>},
      {"room_wall", roomWall},
      {"room_centre", roomCentre},
      {"floor_room", floorRoom},
      {"wall_pair", wallPair},
      {"pose_prior", posePrior},
      {"plane_prior", planePrior},
      {"summed_observations", summedObservations},
      {"condensed", condensed},
  };
  return kReaders;
}

}  // namespace

Json toJson(const Factor& factor) {
  Json json{{"type", factor.type()}, {"nodes", Json::array()}};
  for (int k = 0; k < factor.nodeCount(); ++k) json["nodes"].push_back(toJson(factor.node(k)));
  const bool known =
      writeIf<RelativePoseFactor>(factor, &json) ||
      writeIf<PlaneObservationFactor>(factor, &json) || writeIf<RoomWallFactor>(factor, &json) ||
      writeIf<RoomCentreFactor>(factor, &json) || writeIf<FloorRoomFactor>(factor, &json) ||
      writeIf<WallPairFactor>(factor, &json) || writeIf<PosePriorFactor>(factor, &json) ||
      writeIf<PlanePriorFactor>(factor, &json) || writeIf<CondensedFactor>(factor, &json) ||
      writeIf<SummedObservationsFactor>(factor, &json) ||
      writeIf<RelativePoseQuaternionFactor>(factor, &json);
  if (!known) {
    throw std::invalid_argument("graph.json has no place for a factor of type '" +
                                std::string(factor.type()) + "'");
  }
  return json;
}

FactorConstPtr factorFrom(const JsonPlace& place) {
  const std::string type = place["type"].string();
  const auto reader = readers().find(type);
  if (reader == readers().end()) place["type"].fail("'" + type + "' is no type of factor");
  FactorConstPtr factor = reader->second(place);
  place["nodes"].requireSize(static_cast<std::size_t>(factor->nodeCount()));
  return factor;
}

}  // namespace mrpt_sgraphs
