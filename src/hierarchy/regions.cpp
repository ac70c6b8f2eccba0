// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/regions.h"

#include <algorithm>
#include <limits>
#include <map>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/wall_pair.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSamePassage_m = 2.5;  ///< Portals that lie farther apart are of two ways.
constexpr double kDoubtful = 0.9;       ///< A loop that its kernel leaves less weight is in doubt.

class Planner {
 public:
  Planner(const LayeredGraph& graph, const std::vector<KeyframeId>& active, uint32_t first_late,
          const HierarchyConfig& config)
      : graph_(graph), active_(active), first_late_(first_late), config_(config) {}

  std::vector<RegionPlan> plan() {
    for (const KeyframeId id : active_) assign(id);
    for (const KeyframeId id : active_) {
      if (!isLate(id) && isPortal(id)) portals_.insert(id);
    }
    for (const KeyframeId id : active_) {
      if (!mayGo(id)) continue;
      std::set<FactorId> transferred;
      if (!canGo(id, &transferred)) continue;
      RegionPlan& plan = plans_[keptFor(id)];
      plan.dropped.push_back(id);
      plan.transferred.insert(transferred.begin(), transferred.end());
    }
    return finished();
  }

 private:
  bool isPaper() const { return config_.mode == "paper"; }
  bool isLate(KeyframeId id) const { return graph_.handle(id).slot >= first_late_; }
  bool isKept(KeyframeId id) const { return keptFor(id) == id; }
  KeyframeId keptFor(KeyframeId id) const { return kept_.at(id); }
  bool isOfOneRegion(KeyframeId a, KeyframeId b) const {
    const auto kept_a = kept_.find(a);
    const auto kept_b = kept_.find(b);
    return kept_a != kept_.end() && kept_b != kept_.end() && kept_a->second == kept_b->second;
  }

  /// To the room's first keyframe, or to the nearest kept one around.
  void assign(KeyframeId id) {
    const KeyframeAttributes& keyframe = graph_.attributes(id);
    if (keyframe.room) {
      kept_[id] = first_of_.try_emplace(*keyframe.room, id).first->second;
      return;
    }
    const Eigen::Vector3d place_map = graph_.pose(id).translation();
    KeyframeId nearest = id;
    double least_m = config_.region_radius_m;
    for (const KeyframeId centre : centres_) {
      if (graph_.attributes(centre).floor != keyframe.floor) continue;
      const double distance_m = (graph_.pose(centre).translation() - place_map).norm();
      if (distance_m > least_m) continue;
      least_m = distance_m;
      nearest = centre;
    }
    kept_[id] = nearest;
    if (nearest == id) centres_.push_back(id);
  }

  template <typename Visit>
  void forOthers(KeyframeId id, const Visit& visit) const {
    for (const FactorLink& link : graph_.otherFactorsOf(id)) {
      visit(link.id, *graph_.factorAt(link.slot).factor);
    }
  }

  static std::optional<KeyframeId> otherEnd(KeyframeId id, const Factor& factor) {
    if (keyframeEdge(factor) == nullptr) return std::nullopt;
    return KeyframeId{factor.node(factor.node(0) == NodeId(id) ? 1 : 0).value};
  }

  /// In the condensed factor of another region.
  bool isPortal(KeyframeId id) const {
    bool portal = false;
    forOthers(id, [&](FactorId, const Factor& factor) {
      const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor);
      if (condensed != nullptr && !isOfOneRegion(condensed->kept(), id)) portal = true;
    });
    return portal;
  }

  bool stays(KeyframeId id) const { return isKept(id) || portals_.count(id) != 0; }

  bool mayGo(KeyframeId id) const {
    // what has no room yet may be given one while the robot is near
    constexpr uint32_t kPatience = 2;
    if (stays(id) || isLate(id)) return false;
    if (isPaper()) return graph_.attributes(id).room.has_value();
    if (graph_.attributes(id).room) return true;
    const auto window = static_cast<uint32_t>(config_.local_keyframes);
    return graph_.handle(id).slot + kPatience * window < first_late_;
  }

  /// Unless one of its edges keeps it.
  bool canGo(KeyframeId id, std::set<FactorId>* transferred) {
    bool can = true;
    forOthers(id, [&](FactorId factor_id, const Factor& factor) {
      if (!can || isCarriedOver(factor) || dynamic_cast<const CondensedFactor*>(&factor)) return;
      const std::optional<KeyframeId> other = otherEnd(id, factor);
      if (other && isPaper()) return;
      if (!other) {  // it says where in the map the keyframe is
        can = false;
      } else if (isOfOneRegion(id, *other)) {
        // goes with it, now or later
      } else if (isLate(*other)) {
        can = false;  // nobody knows yet what becomes of it
      } else if (stays(*other)) {
        if (isInDoubt(factor)) transferred->insert(factor_id);
      } else if (isLoop(factor) || passages(id, *other) >= config_.max_passages) {
        transferred->insert(factor_id);
      } else {
        portals_.insert(id);
        can = false;
      }
    });
    return can;
  }

  /// Made of where things are, not measured from the keyframe: the kept one does as well.
  static bool isCarriedOver(const Factor& factor) {
    if (dynamic_cast<const WallPairFactor*>(&factor) != nullptr) return true;
    const auto* edge = dynamic_cast<const RelativePoseFactor*>(&factor);
    return edge != nullptr && edge->kind == RelativePoseFactor::Kind::kRoom;
  }

  static bool isLoop(const Factor& factor) {
    return keyframeEdge(factor)->kind == RelativePoseFactor::Kind::kLoopClosure;
  }

  bool isInDoubt(const Factor& factor) const {
    const RelativePoseFactor& edge = *keyframeEdge(factor);
    const KeyframeId from{edge.node(0).value};
    const KeyframeId to{edge.node(1).value};
    return edge.kernel().weight(edge.chi2(graph_.pose(from), graph_.pose(to))) < kDoubtful;
  }

  /// How many keyframes that stay tie the regions of two keyframes together near them.
  int passages(KeyframeId a, KeyframeId b) const {
    int count = 0;
    const Eigen::Vector3d place_map =
        0.5 * (graph_.pose(a).translation() + graph_.pose(b).translation());
    for (const KeyframeId id : active_) {
      const bool is_of_a = isOfOneRegion(id, a);
      if ((!is_of_a && !isOfOneRegion(id, b)) || isLate(id) || !stays(id)) continue;
      if ((graph_.pose(id).translation() - place_map).norm() > kSamePassage_m) continue;
      if (isTiedTo(is_of_a ? b : a, id)) ++count;
    }
    return count;
  }

  bool isTiedTo(KeyframeId region, KeyframeId id) const {
    bool tied = false;
    forOthers(id, [&](FactorId, const Factor& factor) {
      if (const std::optional<KeyframeId> other = otherEnd(id, factor)) {
        if (isOfOneRegion(*other, region)) tied = true;
      } else if (const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor)) {
        if (isOfOneRegion(condensed->kept(), region)) tied = true;
      }
    });
    return tied;
  }

  /// Regions of which enough can go, or from which the robot has gone.
  std::vector<RegionPlan> finished() {
    std::set<KeyframeId> present;
    for (const KeyframeId id : active_) {
      if (isLate(id)) present.insert(keptFor(id));
    }
    std::map<KeyframeId, std::vector<KeyframeId>> staying;
    for (const KeyframeId id : active_) {
      if (!isLate(id) && stays(id)) staying[keptFor(id)].push_back(id);
    }
    std::vector<RegionPlan> plans;
    for (auto& [kept, plan] : plans_) {
      const bool is_enough =
          static_cast<int>(plan.dropped.size()) >= config_.min_condensed || !present.count(kept);
      if (isLate(kept) || !is_enough) continue;
      plan.kept = kept;
      plan.room = graph_.attributes(kept).room;
      plan.stay = staying[kept];
      plans.push_back(std::move(plan));
    }
    // an edge into another region is transferred where keyframes are known best: in the smaller ones
    std::stable_sort(plans.begin(), plans.end(), [this](const RegionPlan& a, const RegionPlan& b) {
      return extentOf(a) < extentOf(b);
    });
    return plans;
  }

  int extentOf(const RegionPlan& plan) const {
    if (!plan.room) return 2;
    return graph_.attributes(*plan.room).kind == RoomAttributes::Kind::kCorridor ? 1 : 0;
  }

  const LayeredGraph& graph_;
  const std::vector<KeyframeId>& active_;
  const uint32_t first_late_;
  const HierarchyConfig& config_;
  std::map<KeyframeId, KeyframeId> kept_;     ///< Of every active keyframe: its region's.
  std::map<RoomId, KeyframeId> first_of_;
  std::vector<KeyframeId> centres_;           ///< Kept ones in no room.
  std::set<KeyframeId> portals_;
  std::map<KeyframeId, RegionPlan> plans_;    ///< By kept keyframe.
};

}  // namespace

std::vector<RegionPlan> planRegions(const LayeredGraph& graph,
                                    const std::vector<KeyframeId>& active, uint32_t first_late,
                                    const HierarchyConfig& config) {
  return Planner(graph, active, first_late, config).plan();
}

}  // namespace mrpt_sgraphs
