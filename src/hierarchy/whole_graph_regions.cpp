// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/whole_graph_regions.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace mrpt_sgraphs {
namespace {

using Slot = uint32_t;

struct Region {
  std::optional<RoomId> room;
  std::vector<Slot> slots;  ///< Of keyframes, ascending.
};

NodeHandle keyframeAt(Slot slot) { return {Layer::kKeyframe, slot}; }

class Planner {
 public:
  explicit Planner(const LayeredGraph& graph)
      : graph_(graph),
        region_of_(graph.size(Layer::kKeyframe), 0),
        stays_(graph.size(Layer::kKeyframe), false) {}

  std::vector<RegionPlan> plan(std::size_t longest) {
    assign(longest);
    for (const Region& region : regions_) stays_[region.slots.front()] = true;
    keepWhatIsHeldByTheMap();
    keepPortals();
    return plans();
  }

  std::vector<RegionPlan> planByTheLetter() {
    assign(region_of_.size());
    for (const Region& region : regions_) {
      if (region.room) {
        stays_[region.slots.front()] = true;
      } else {
        for (const Slot slot : region.slots) stays_[slot] = true;
      }
    }
    return plans();
  }

 private:
  const KeyframeAttributes& attributes(Slot slot) const { return graph_.attributes(idAt(slot)); }
  KeyframeId idAt(Slot slot) const { return {graph_.nodeAt(keyframeAt(slot)).value}; }

  /// To rooms, and where there is none to pieces of the way.
  void assign(std::size_t longest) {
    std::map<RoomId, std::size_t> of_room;
    for (Slot slot = 0; slot < region_of_.size(); ++slot) {
      const std::optional<RoomId>& room = attributes(slot).room;
      std::size_t region = regions_.size();
      if (room) {
        region = of_room.try_emplace(*room, region).first->second;
      } else if (slot > 0 && !attributes(slot - 1).room &&
                 regions_[region_of_[slot - 1]].slots.size() < longest) {
        region = region_of_[slot - 1];
      }
      if (region == regions_.size()) regions_.push_back({room, {}});
      regions_[region].slots.push_back(slot);
      region_of_[slot] = region;
    }
  }

  /// What says where in the map a keyframe is has no place in a condensed factor.
  void keepWhatIsHeldByTheMap() {
    for (Slot slot = 0; slot < stays_.size(); ++slot) {
      for (const FactorLink& link : graph_.topology().others(keyframeAt(slot))) {
        if (graph_.topology().ends(link.slot).size() == 1) stays_[slot] = true;
      }
    }
  }

  /// Keyframes of other regions that share a factor with one.
  std::vector<Slot> acrossFrom(Slot slot) const {
    std::vector<Slot> across;
    for (const FactorLink& link : graph_.topology().others(keyframeAt(slot))) {
      for (const FactorEnd& end : graph_.topology().ends(link.slot)) {
        if (end.node.layer != Layer::kKeyframe) continue;
        if (region_of_[end.node.slot] != region_of_[slot]) across.push_back(end.node.slot);
      }
    }
    return across;
  }

  /// Of each pair across a border one stays: first those that have most, so that they are few.
  void keepPortals() {
    std::vector<std::vector<Slot>> across(stays_.size());
    for (Slot slot = 0; slot < stays_.size(); ++slot) across[slot] = acrossFrom(slot);
    std::vector<Slot> order(stays_.size());
    std::iota(order.begin(), order.end(), Slot{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Slot a, Slot b) { return across[a].size() > across[b].size(); });
    for (const Slot slot : order) {
      const bool is_needed = std::any_of(across[slot].begin(), across[slot].end(),
                                         [this](Slot other) { return !stays_[other]; });
      if (is_needed) stays_[slot] = true;
    }
  }

  std::vector<RegionPlan> plans() const {
    std::vector<RegionPlan> plans;
    for (const Region& region : regions_) {
      std::optional<Slot> kept;
      for (auto first = region.slots.begin(); first != region.slots.end();) {
        // a stay in a room, or on the way what lies between two keyframes that remain
        const auto last = std::adjacent_find(first, region.slots.end(), [&](Slot a, Slot b) {
          return b != a + 1 || (!region.room && stays_[b]);
        });
        const auto end = last == region.slots.end() ? last : std::next(last);
        if (!kept || !region.room) kept = *first;
        RegionPlan plan = planOfStay(*first, *std::prev(end));
        plan.kept = idAt(*kept);
        plan.room = region.room;
        if (plan.stay.empty()) plan.stay.push_back(plan.kept);
        if (!plan.dropped.empty()) plans.push_back(std::move(plan));
        first = end;
      }
    }
    return plans;
  }

  /// What is dropped goes with what remains of the same stay, or just before and after it: to where
  /// the region was entered before, the way is long until a loop is closed.
  RegionPlan planOfStay(Slot first, Slot last) const {
    RegionPlan plan;
    const Slot before = first > 0 ? first - 1 : first;
    const Slot after = std::min<Slot>(last + 1, static_cast<Slot>(stays_.size()) - 1);
    for (Slot slot = before; slot <= after; ++slot) {
      if (stays_[slot]) {
        plan.stay.push_back(idAt(slot));
      } else if (slot >= first && slot <= last) {
        plan.dropped.push_back(idAt(slot));
      }
    }
    return plan;
  }

  const LayeredGraph& graph_;
  std::vector<Region> regions_;
  std::vector<std::size_t> region_of_;  ///< By slot of the keyframe.
  std::vector<bool> stays_;
};

}  // namespace

std::vector<RegionPlan> planWholeGraph(const LayeredGraph& graph, std::size_t longest) {
  return Planner(graph).plan(longest);
}

std::vector<RegionPlan> planWholeGraphByTheLetter(const LayeredGraph& graph) {
  return Planner(graph).planByTheLetter();
}

}  // namespace mrpt_sgraphs
