// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/local_window.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_set>

namespace mrpt_sgraphs {
namespace {

/// Nodes in the order in which they were found, each once.
class FoundNodes {
 public:
  bool add(NodeHandle node) {
    if (!seen_.insert((static_cast<uint64_t>(node.layer) << 32U) | node.slot).second) return false;
    nodes_.push_back(node);
    return true;
  }
  const std::vector<NodeHandle>& nodes() const { return nodes_; }

 private:
  std::unordered_set<uint64_t> seen_;
  std::vector<NodeHandle> nodes_;
};

/// A sighting that a robust kernel weakens counts as much as it does now.
PlaneObservationFactor withoutKernel(const PlaneObservationFactor& sighting, const Pose& T_map_base,
                                     const Plane& surface_map) {
  const Eigen::Vector3d e = sighting.evaluate(T_map_base, surface_map, nullptr, nullptr);
  const double weight = sighting.kernel().weight(e.dot(sighting.information() * e));
  return PlaneObservationFactor(KeyframeId{sighting.node(0).value}, sighting.node(1),
                                sighting.measured_base, weight * sighting.information());
}

}  // namespace

LocalWindow::LocalWindow(std::size_t keyframes) : keyframes_(keyframes) {
  if (keyframes == 0) throw std::invalid_argument("a window needs at least one keyframe");
}

void LocalWindow::forget() {
  sums_.clear();
  summed_keyframes_ = 0;
  known_factors_ = 0;
}

void LocalWindow::add(const LayeredGraph& graph, uint32_t factor) {
  const auto* sighting =
      dynamic_cast<const PlaneObservationFactor*>(graph.factorAt(factor).factor.get());
  if (sighting == nullptr) return;
  const NodeHandle surface = graph.topology().ends(factor)[1].node;
  const Pose T_map_base = graph.pose(graph.topology().ends(factor)[0].node);
  const Plane surface_map = graph.plane(surface);
  const auto found =
      sums_.try_emplace(sighting->node(1), surface_map, T_map_base.translation()).first;
  found->second.add(withoutKernel(*sighting, T_map_base, surface_map), T_map_base);
}

void LocalWindow::catchUp(const LayeredGraph& graph, uint32_t first_in_window) {
  if (graph.erasures() != erasures_ || first_in_window < summed_keyframes_) forget();
  erasures_ = graph.erasures();
  // new factors of keyframes that have left already
  const auto factors = static_cast<uint32_t>(graph.factorCount());
  for (uint32_t factor = known_factors_; factor < factors; ++factor) {
    const auto& ends = graph.topology().ends(factor);
    const NodeHandle first = ends[0].node;
    if (first.layer == Layer::kKeyframe && first.slot < summed_keyframes_) add(graph, factor);
  }
  known_factors_ = factors;
  // keyframes that leave now
  for (; summed_keyframes_ < first_in_window; ++summed_keyframes_) {
    for (const FactorLink& link :
         graph.topology().sightings({Layer::kKeyframe, summed_keyframes_})) {
      add(graph, link.slot);
    }
  }
}

Selection LocalWindow::select(const LayeredGraph& graph) {
  const std::size_t count = graph.size(Layer::kKeyframe);
  const auto first = static_cast<uint32_t>(count > keyframes_ ? count - keyframes_ : 0);
  const auto first_free = static_cast<uint32_t>(
      count > keyframes_ ? first : std::min<std::size_t>(count, 1));  // something has to stay
  catchUp(graph, first_free);

  const Topology& topology = graph.topology();
  FoundNodes free;
  FoundNodes all;
  const auto addFree = [&](NodeHandle node) {
    if (all.add(node)) free.add(node);
  };
  if (first_free > first && count > 0) all.add({Layer::kKeyframe, first});
  for (uint32_t slot = first_free; slot < count; ++slot) addFree({Layer::kKeyframe, slot});
  for (uint32_t slot = first; slot < count; ++slot) {
    for (const FactorLink& link : topology.sightings({Layer::kKeyframe, slot})) {
      const NodeHandle surface = topology.ends(link.slot)[1].node;
      if (surface.layer == Layer::kWall) addFree(surface);
    }
  }
  for (std::size_t k = 0; k < free.nodes().size(); ++k) {  // it grows by the rooms
    const NodeHandle wall = free.nodes()[k];
    if (wall.layer != Layer::kWall) continue;
    for (const FactorLink& link : topology.others(wall)) {
      for (const FactorEnd& end : topology.ends(link.slot)) {
        if (end.node.layer == Layer::kRoom) addFree(end.node);
      }
    }
  }

  Selection window;
  for (const NodeHandle node : free.nodes()) window.free.push_back(graph.nodeAt(node));
  const std::size_t free_count = free.nodes().size();
  const auto addNeighbours = [&](const Topology::Links& links) {
    for (const FactorLink& link : links) {
      for (const FactorEnd& end : topology.ends(link.slot)) all.add(end.node);
    }
  };
  for (std::size_t k = 0; k < free_count; ++k) {
    const NodeHandle node = free.nodes()[k];
    addNeighbours(topology.others(node));
    if (node.layer == Layer::kKeyframe) {  // the ground among them
      addNeighbours(topology.sightings(node));
    }
  }
  std::unordered_set<NodeId> is_free(window.free.begin(), window.free.end());
  for (const NodeHandle node : all.nodes()) {
    const NodeId id = graph.nodeAt(node);
    if (is_free.count(id) == 0) window.fixed.push_back(id);
  }
  for (const NodeId node : window.free) {
    if (node.layer != Layer::kWall) continue;
    const auto sum = sums_.find(node);
    window.sums.emplace_back(node, sum == sums_.end() ? ObservationSum() : sum->second);
  }
  return window;
}

}  // namespace mrpt_sgraphs
