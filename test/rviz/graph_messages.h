// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/make_shared.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mrpt_sgraphs/ros/conversions.h"
#include "shown_graph.h"
#include "some_rooms.h"

namespace mrpt_sgraphs::test {

inline GraphFactor factorMsg(const std::string& type, const std::vector<NodeId>& nodes) {
  GraphFactor factor;
  factor.type = type;
  for (const NodeId node : nodes) {
    factor.layers.push_back(static_cast<std::uint8_t>(node.layer));
    factor.nodes.push_back(node.value);
  }
  return factor;
}

/// twoRoomsOnTwoFloors as its message, with a condensed factor around keyframe 0, a wall pair and
/// a factor of a node that is gone.
inline SituationalGraph roomsMessage() {
  SituationalGraph msg = toMsg(twoRoomsOnTwoFloors(), "map");
  msg.factors.push_back(factorMsg("condensed", {KeyframeId{0}, KeyframeId{2}, WallId{9}}));
  msg.factors.push_back(factorMsg("wall_pair", {WallId{4}, WallId{9}}));
  msg.factors.push_back(factorMsg("odometry", {KeyframeId{2}, KeyframeId{77}}));
  return msg;
}

inline ShownGraphConstPtr shown(const SituationalGraph& msg) {
  return std::make_shared<ShownGraph>(boost::make_shared<SituationalGraph>(msg));
}

}  // namespace mrpt_sgraphs::test
