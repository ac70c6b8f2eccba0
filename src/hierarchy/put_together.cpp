// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/put_together.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mrpt_sgraphs/factors/condensed.h"

namespace mrpt_sgraphs {
namespace {

class Placing {
 public:
  explicit Placing(LayeredGraph* graph) : graph_(*graph) {
    for (const Layer layer : {Layer::kKeyframe, Layer::kWall, Layer::kRoom, Layer::kFloor}) {
      is_placed_[static_cast<std::size_t>(layer)].assign(graph->size(layer), false);
    }
    is_done_.assign(graph->factorCount(), false);
  }

  void run() {
    if (graph_.size(Layer::kKeyframe) == 0) return;
    reach({Layer::kKeyframe, 0});
    for (std::size_t k = 0; k < reached_.size(); ++k) {
      Topology::Links links = graph_.topology().others(reached_[k]);
      std::sort(links.begin(), links.end(),
                [](const FactorLink& a, const FactorLink& b) { return a.id < b.id; });
      for (const FactorLink& link : links) {
        if (is_done_[link.slot]) continue;
        is_done_[link.slot] = true;
        follow(*graph_.factorAt(link.slot).factor, graph_.pose(reached_[k]), link.end);
      }
    }
  }

 private:
  /// Poses lead on, planes do not.
  void reach(NodeHandle node) {
    is_placed_[static_cast<std::size_t>(node.layer)][node.slot] = true;
    if (!isPlane(node.layer)) reached_.push_back(node);
  }

  bool isPlaced(NodeHandle node) const {
    return is_placed_[static_cast<std::size_t>(node.layer)][node.slot];
  }

  void follow(const Factor& factor, const Pose& T_map_end, uint32_t end) {
    if (const auto* edge = dynamic_cast<const RelativePoseFactor*>(&factor)) {
      const Pose T_end_other = end == 0 ? edge->T_from_to : edge->T_from_to.inverse();
      place(edge->node(end == 0 ? 1 : 0), orthonormalized(T_map_end * T_end_other));
    } else if (const auto* condensed = dynamic_cast<const CondensedFactor*>(&factor)) {
      followCondensed(*condensed, T_map_end, end);
    }
  }

  void followCondensed(const CondensedFactor& condensed, const Pose& T_map_end, uint32_t end) {
    Pose T_map_kept = T_map_end;
    if (end > 0) {
      const auto& T_kept_end = std::get<Pose>(condensed.others()[end - 1].seen_kept);
      T_map_kept = orthonormalized(T_map_end * T_kept_end.inverse());
      place(condensed.kept(), T_map_kept);
    }
    for (const CondensedFactor::Other& other : condensed.others()) {
      if (const Plane* plane_kept = std::get_if<Plane>(&other.seen_kept)) {
        const NodeHandle node = graph_.handle(other.node);
        if (isPlaced(node)) continue;
        graph_.setPlane(node, T_map_kept * *plane_kept);
        reach(node);
      } else {
        place(other.node, orthonormalized(T_map_kept * std::get<Pose>(other.seen_kept)));
      }
    }
  }

  void place(NodeId id, const Pose& T_map_node) {
    const NodeHandle node = graph_.handle(id);
    if (isPlaced(node)) return;
    graph_.setPose(node, T_map_node);
    reach(node);
  }

  LayeredGraph& graph_;
  std::array<std::vector<bool>, 4> is_placed_;  ///< By layer and slot.
  std::vector<bool> is_done_;                   ///< By place of the factor.
  std::vector<NodeHandle> reached_;             ///< In this order.
};

}  // namespace

void putTogether(LayeredGraph* graph) { Placing(graph).run(); }

}  // namespace mrpt_sgraphs
