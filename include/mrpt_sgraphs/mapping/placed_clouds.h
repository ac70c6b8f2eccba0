// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <iterator>
#include <map>
#include <set>

#include "mrpt_sgraphs/graph/nodes.h"

namespace mrpt_sgraphs {

/// The keyframes' clouds that are in a map, and where they were put. Takes out and puts in again
/// only what lies in other cells than before.
class PlacedClouds {
 public:
  /// @param tolerance_m  What a keyframe has seen may be so far from where it was put.
  explicit PlacedClouds(double tolerance_m) : tolerance_m_(tolerance_m) {}

  /// Calls `remove(cloud, T_frame_base)` for what is gone, has moved or has another cloud, and
  /// `add(cloud, T_frame_base)` for what is new, has moved or has another cloud.
  /// @param keyframes  Nodes or pointers to them, in any order; those without a cloud are not there.
  /// @return Whether it called either.
  template <typename Keyframes, typename Add, typename Remove>
  bool update(const Keyframes& keyframes, const Pose& T_frame_map, const Add& add,
              const Remove& remove) {
    bool changed = false;
    std::set<KeyframeId> present;
    for (const auto& element : keyframes) {
      const KeyframeNode& keyframe = nodeOf(element);
      if (keyframe.cloud == nullptr) continue;  // what it has seen goes with its cloud
      present.insert(keyframe.id);
      const Placed now{T_frame_map * keyframe.T_map_base, keyframe.cloud};
      const auto known = placed_.find(keyframe.id);
      if (known != placed_.end()) {
        const bool is_same_cloud = known->second.cloud == now.cloud;
        if (is_same_cloud && !hasMoved(known->second.T_frame_base, now.T_frame_base)) continue;
        remove(*known->second.cloud, known->second.T_frame_base);
      }
      add(*now.cloud, now.T_frame_base);
      placed_[keyframe.id] = now;
      changed = true;
    }
    for (auto entry = placed_.begin(); entry != placed_.end();) {
      if (present.count(entry->first) > 0) {
        ++entry;
        continue;
      }
      remove(*entry->second.cloud, entry->second.T_frame_base);
      entry = placed_.erase(entry);
      changed = true;
    }
    return changed;
  }

  /// Calls `visit(cloud, T_frame_base)` for all that is in the map.
  template <typename Visit>
  void forEach(const Visit& visit) const {
    for (const auto& [id, placed] : placed_) visit(*placed.cloud, placed.T_frame_base);
  }

  /// All that it knows, for a run that goes on later: see geometry/archive.h.
  template <typename Archive>
  void archive(Archive& a) {
    a("placed", placed_);
  }

 private:
  struct Placed {
    Pose T_frame_base;
    Cloud::ConstPtr cloud;

    template <typename Archive>
    void archive(Archive& a) {
      a("T_frame_base", T_frame_base);
      a("cloud", cloud);
    }
  };

  static const KeyframeNode& nodeOf(const KeyframeNode& node) { return node; }
  static const KeyframeNode& nodeOf(const KeyframeNode* node) { return *node; }

  bool hasMoved(const Pose& from, const Pose& to) const {
    constexpr double kLever_m = 5.0;  // most of what a keyframe sees is nearer
    const Tangent way = local(from, to);
    return way.head<3>().norm() + kLever_m * way.tail<3>().norm() > tolerance_m_;
  }

  double tolerance_m_;
  std::map<KeyframeId, Placed> placed_;
};

}  // namespace mrpt_sgraphs
