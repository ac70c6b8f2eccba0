// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/local_window.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_set>

#include "node_set.h"

namespace mrpt_sgraphs {
namespace {

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

void LocalWindow::forget() { sums_.clear(); }

const ObservationSum& LocalWindow::sumOf(const LayeredGraph& graph, NodeHandle surface,
                                         uint32_t first_in_window) {
  const Topology& topology = graph.topology();
  const Topology::Links& links = topology.sightings(surface);
  const auto keyframeOf = [&topology](const FactorLink& link) {
    return topology.ends(link.slot)[0].node;
  };
  Sum& known = sums_[graph.nodeAt(surface)];
  const auto still_there =
      std::count_if(links.begin(), links.end(), [&](const FactorLink& link) {
        return keyframeOf(link).slot < known.summed_below;
      });
  const bool is_good = known.erasures == graph.erasures() && known.count == still_there &&
                       first_in_window >= known.summed_below;
  if (!is_good) known = Sum();
  known.erasures = graph.erasures();
  const Plane surface_map = graph.plane(surface);
  for (const FactorLink& link : links) {
    const NodeHandle keyframe = keyframeOf(link);
    if (keyframe.slot < known.summed_below || keyframe.slot >= first_in_window) continue;
    const auto* sighting =
        dynamic_cast<const PlaneObservationFactor*>(graph.factorAt(link.slot).factor.get());
    if (sighting == nullptr) continue;
    const Pose T_map_base = graph.pose(keyframe);
    if (known.count++ == 0) known.sum = ObservationSum(surface_map, T_map_base.translation());
    known.sum.add(withoutKernel(*sighting, T_map_base, surface_map), T_map_base);
  }
  known.summed_below = first_in_window;
  return known.sum;
}

Selection LocalWindow::select(const LayeredGraph& graph) {
  const std::size_t count = graph.size(Layer::kKeyframe);
  const auto first = static_cast<uint32_t>(count > keyframes_ ? count - keyframes_ : 0);
  const auto first_free = static_cast<uint32_t>(
      count > keyframes_ ? first : std::min<std::size_t>(count, 1));  // something has to stay
  const Topology& topology = graph.topology();
  NodeSet free;
  NodeSet all;
  const auto addFree = [&](NodeHandle node) {
    if (all.add(node)) free.add(node);
  };
  if (first_free > first && count > 0) all.add({Layer::kKeyframe, first});
  for (uint32_t slot = first_free; slot < count; ++slot) {
    if (topology.linkCount({Layer::kKeyframe, slot}) > 0) addFree({Layer::kKeyframe, slot});
  }
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
    window.sums.emplace_back(node, sumOf(graph, graph.handle(node), first_free));
  }
  return window;
}

}  // namespace mrpt_sgraphs
