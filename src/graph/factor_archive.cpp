// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/graph/archive_graph.h"

namespace mrpt_sgraphs {
namespace {

/// What every factor with a residual has. Each factor has a function `both` that writes it, or, where
/// it is null, makes it of what it reads.
template <typename FactorType>
struct Base {
  std::vector<NodeId> nodes;
  typename FactorType::Information information = FactorType::Information::Zero();
  RobustKernel kernel;

  template <typename Archive>
  Base(Archive& a, const FactorType* factor) {
    if (factor != nullptr) {
      for (int k = 0; k < factor->nodeCount(); ++k) nodes.push_back(factor->node(k));
      information = factor->information();
      kernel = factor->kernel();
    }
    a("nodes", nodes);
    if (nodes.size() != FactorType::kNodes) throw ArchiveError("a factor of other nodes");
    a("information", information);
    a("kernel", kernel.kind);
    a("width_chi2", kernel.width_chi2);
  }

  template <typename LayerId>
  LayerId id(std::size_t k) const {
    const LayerId id{nodes[k].value};
    if (NodeId(id) != nodes[k]) throw ArchiveError("a factor does not go with " + nameOf(nodes[k]));
    return id;
  }
};

template <typename Archive>
FactorConstPtr both(Archive& a, const RelativePoseFactor* factor) {
  const Base<RelativePoseFactor> base(a, factor);
  Pose T_from_to = factor == nullptr ? Pose::Identity() : factor->T_from_to;
  auto kind = factor == nullptr ? RelativePoseFactor::Kind::kOdometry : factor->kind;
  a("T_from_to", T_from_to);
  a("kind", kind);
  return std::make_shared<RelativePoseFactor>(base.nodes[0], base.nodes[1], T_from_to,
                                              base.information, kind, base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const RelativePoseQuaternionFactor* factor) {
  const Base<RelativePoseQuaternionFactor> base(a, factor);
  Pose T_from_to = factor == nullptr ? Pose::Identity() : factor->T_from_to;
  a("T_from_to", T_from_to);
  return std::make_shared<RelativePoseQuaternionFactor>(base.nodes[0], base.nodes[1], T_from_to,
                                                        base.information, base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const PlaneObservationFactor* factor) {
  const Base<PlaneObservationFactor> base(a, factor);
  Plane measured_base = factor == nullptr ? Plane() : factor->measured_base;
  a("measured_base", measured_base);
  return std::make_shared<PlaneObservationFactor>(base.template id<KeyframeId>(0), base.nodes[1],
                                                  measured_base, base.information, base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const PosePriorFactor* factor) {
  const Base<PosePriorFactor> base(a, factor);
  Pose prior_map = factor == nullptr ? Pose::Identity() : factor->prior_map;
  a("prior_map", prior_map);
  return std::make_shared<PosePriorFactor>(base.nodes[0], prior_map, base.information,
                                           base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const PlanePriorFactor* factor) {
  const Base<PlanePriorFactor> base(a, factor);
  Pose T_map_reference = factor == nullptr ? Pose::Identity() : factor->T_map_reference;
  Plane prior_reference = factor == nullptr ? Plane() : factor->prior_reference;
  a("T_map_reference", T_map_reference);
  a("prior_reference", prior_reference);
  return std::make_shared<PlanePriorFactor>(base.nodes[0], T_map_reference, prior_reference,
                                            base.information, base.kernel);
}

template <typename Archive>
void bothSeen(Archive& a, std::variant<Pose, Plane>* seen) {
  bool is_plane = std::holds_alternative<Plane>(*seen);
  a.item(is_plane);
  if (is_plane) {
    if (!std::holds_alternative<Plane>(*seen)) *seen = Plane();
    a.item(std::get<Plane>(*seen));
  } else {
    if (!std::holds_alternative<Pose>(*seen)) *seen = Pose::Identity();
    a.item(std::get<Pose>(*seen));
  }
}

template <typename Archive>
FactorConstPtr both(Archive& a, const CondensedFactor* factor) {
  using Others = std::vector<CondensedFactor::Other>;
  KeyframeId kept = factor == nullptr ? KeyframeId() : factor->kept();
  Others others = factor == nullptr ? Others() : factor->others();
  auto quadratic = factor == nullptr ? CondensedFactor::Quadratic() : factor->quadratic();
  a("kept", kept);
  others.resize(a.count(others.size()), {NodeId(), Pose::Identity()});
  for (CondensedFactor::Other& other : others) {
    a("node", other.node);
    bothSeen(a, &other.seen_kept);
    a("way_covariance", other.way_covariance);
  }
  a("Lambda", quadratic.Lambda);
  a("eta", quadratic.eta);
  a("c", quadratic.c);
  return std::make_shared<CondensedFactor>(kept, std::move(others), std::move(quadratic));
}

template <typename Archive>
FactorConstPtr both(Archive& a, const RoomWallFactor* factor) {
  const Base<RoomWallFactor> base(a, factor);
  Eigen::Vector3d axis_room = Eigen::Vector3d::UnitX();
  if (factor != nullptr) axis_room = factor->axis_room;
  a("axis_room", axis_room);
  return std::make_shared<RoomWallFactor>(base.template id<RoomId>(0), base.template id<WallId>(1),
                                          axis_room, base.information, base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const RoomCentreFactor* factor) {
  const Base<RoomCentreFactor> base(a, factor);
  return std::make_shared<RoomCentreFactor>(
      base.template id<RoomId>(0), base.template id<WallId>(1), base.template id<WallId>(2),
      base.information, base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const FloorRoomFactor* factor) {
  const Base<FloorRoomFactor> base(a, factor);
  return std::make_shared<FloorRoomFactor>(base.template id<FloorId>(0),
                                           base.template id<RoomId>(1), base.information,
                                           base.kernel);
}

template <typename Archive>
FactorConstPtr both(Archive& a, const WallPairFactor* factor) {
  const Base<WallPairFactor> base(a, factor);
  Eigen::Vector3d normal_a_base = Eigen::Vector3d::UnitX();
  if (factor != nullptr) normal_a_base = factor->normal_a_base;
  double thickness_m = factor == nullptr ? 0.0 : factor->thickness_m;
  a("normal_a_base", normal_a_base);
  a("thickness_m", thickness_m);
  return std::make_shared<WallPairFactor>(base.template id<KeyframeId>(0),
                                          base.template id<WallId>(1), base.template id<WallId>(2),
                                          normal_a_base, thickness_m, base.information,
                                          base.kernel);
}

struct Codec {
  bool (*is_of_it)(const Factor&);
  void (*write)(ArchiveWriter&, const Factor&);
  FactorConstPtr (*read)(ArchiveReader&);
};

template <typename FactorType>
Codec codecOf() {
  return {[](const Factor& factor) { return dynamic_cast<const FactorType*>(&factor) != nullptr; },
          [](ArchiveWriter& a, const Factor& factor) {
            both(a, static_cast<const FactorType*>(&factor));
          },
          [](ArchiveReader& a) { return both(a, static_cast<const FactorType*>(nullptr)); }};
}

/// By the number that a file has: new kinds come last.
const std::vector<Codec>& codecs() {
  static const std::vector<Codec> kCodecs{
      codecOf<RelativePoseFactor>(),     codecOf<RelativePoseQuaternionFactor>(),
      codecOf<PlaneObservationFactor>(), codecOf<PosePriorFactor>(),
      codecOf<PlanePriorFactor>(),       codecOf<CondensedFactor>(),
      codecOf<RoomWallFactor>(),         codecOf<RoomCentreFactor>(),
      codecOf<FloorRoomFactor>(),        codecOf<WallPairFactor>()};
  return kCodecs;
}

}  // namespace

void part(ArchiveWriter& a, FactorConstPtr& factor) {
  for (uint8_t kind = 0; kind < codecs().size(); ++kind) {
    if (!codecs()[kind].is_of_it(*factor)) continue;
    a.item(kind);
    codecs()[kind].write(a, *factor);
    return;
  }
  throw std::invalid_argument("no state is kept of a factor of type '" +
                              std::string(factor->type()) + "'");
}

void part(ArchiveReader& a, FactorConstPtr& factor) {
  uint8_t kind = 0;
  a.item(kind);
  if (kind >= codecs().size()) a.fail("no kind of factor has the number " + std::to_string(kind));
  try {
    factor = codecs()[kind].read(a);
  } catch (const std::invalid_argument& error) {
    a.fail(error.what());
  }
}

}  // namespace mrpt_sgraphs
