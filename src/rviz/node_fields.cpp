// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "node_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace mrpt_sgraphs {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

std::string number(double value, int digits = 3) {
  const bool is_zero = std::abs(value) < 0.5 * std::pow(10.0, -digits);  // not -0.000
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << (is_zero ? 0.0 : value);
  return text.str();
}

template <typename Vector>
std::string triple(const Vector& v) {
  return number(v.x) + ", " + number(v.y) + ", " + number(v.z);
}

/// As yaw, pitch and roll, which can be read.
std::string angles(const geometry_msgs::Quaternion& q) {
  const double yaw = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
  const double pitch = std::asin(std::max(-1.0, std::min(1.0, 2 * (q.w * q.y - q.z * q.x))));
  const double roll = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
  return number(yaw * kDegrees, 2) + ", " + number(pitch * kDegrees, 2) + ", " +
         number(roll * kDegrees, 2);
}

std::string idOrNone(std::int64_t id) {
  return id == GraphKeyframe::NONE ? "none" : std::to_string(id);
}

/// "3: 4, 9, 12"
template <typename Ids>
std::string list(const Ids& ids) {
  constexpr std::size_t kMax = 20;
  std::string text = std::to_string(ids.size());
  for (std::size_t k = 0; k < ids.size() && k < kMax; ++k) {
    text += (k == 0 ? ": " : ", ") + std::to_string(ids[k]);
  }
  return ids.size() > kMax ? text + ", ..." : text;
}

void addPose(const std::string& name, const geometry_msgs::Pose& pose, NodeFields* fields) {
  fields->emplace_back(name + ", x y z [m]", triple(pose.position));
  fields->emplace_back(name + ", yaw pitch roll [deg]", angles(pose.orientation));
}

void addOutline(const std::vector<geometry_msgs::Point>& polygon, std::size_t holes,
                NodeFields* fields) {
  fields->emplace_back(
      "outline", std::to_string(polygon.size()) + " corners, " + std::to_string(holes) + " holes");
}

NodeFields fields(const GraphKeyframe& msg, const SituationalGraph& graph) {
  std::vector<std::uint64_t> represented;
  for (const GraphKeyframe& other : graph.keyframes) {
    if (other.representative == msg.id && other.id != msg.id) represented.push_back(other.id);
  }
  NodeFields out{{"id", std::to_string(msg.id)}, {"stamp [s]", number(msg.stamp.toSec(), 6)}};
  addPose("pose", msg.pose, &out);
  addPose("odom pose", msg.odom_pose, &out);
  out.emplace_back("floor", idOrNone(msg.floor));
  out.emplace_back("room", idOrNone(msg.room));
  out.emplace_back("marginalized", msg.marginalized != 0 ? "yes" : "no");
  out.emplace_back("representative", std::to_string(msg.representative));
  if (!represented.empty()) out.emplace_back("stands for", list(represented));
  return out;
}

NodeFields fields(const GraphWall& msg, const SituationalGraph& graph) {
  std::vector<std::uint64_t> rooms;
  for (const GraphRoom& room : graph.rooms) {
    if (std::count(room.walls.begin(), room.walls.end(), msg.id) != 0) rooms.push_back(room.id);
  }
  NodeFields out{{"id", std::to_string(msg.id)},
                 {"normal", triple(msg.normal)},
                 {"distance [m]", number(msg.distance)},
                 {"floor", idOrNone(msg.floor)},
                 {"rooms", list(rooms)}};
  addOutline(msg.polygon, msg.holes.size(), &out);
  return out;
}

NodeFields fields(const GraphRoom& msg, const SituationalGraph&) {
  NodeFields out{{"id", std::to_string(msg.id)}, {"name", msg.name}, {"kind", msg.kind}};
  addPose("pose", msg.pose, &out);
  out.emplace_back("size [m]", number(msg.size[0], 2) + " x " + number(msg.size[1], 2));
  out.emplace_back("height [m]", msg.height > 0.0 ? number(msg.height, 2) : "unknown");
  out.emplace_back("floor", idOrNone(msg.floor));
  out.emplace_back("walls", list(msg.walls));
  out.emplace_back("keyframes", list(msg.keyframes));
  for (const GraphDoorway& doorway : msg.doorways) {
    out.emplace_back("doorway", "to room " + idOrNone(doorway.to) + ", " +
                                    number(doorway.width, 2) + " m wide, at " +
                                    triple(doorway.centre));
  }
  addOutline(msg.polygon, msg.holes.size(), &out);
  return out;
}

NodeFields fields(const GraphFloor& msg, const SituationalGraph& graph) {
  const auto is_here = [&msg](const GraphKeyframe& keyframe) {
    return keyframe.floor == static_cast<std::int64_t>(msg.id);
  };
  NodeFields out{{"id", std::to_string(msg.id)},
                 {"name", msg.name},
                 {"centre, x y z [m]", triple(msg.centre)},
                 {"normal", triple(msg.normal)},
                 {"distance [m]", number(msg.distance)},
                 {"rooms", list(msg.rooms)},
                 {"keyframes", std::to_string(std::count_if(graph.keyframes.begin(),
                                                            graph.keyframes.end(), is_here))}};
  for (const GraphFloorConnection& stairs : msg.connections) {
    out.emplace_back("stairs", "to floor " + std::to_string(stairs.to) + ", from " +
                                   triple(stairs.here) + " to " + triple(stairs.there));
  }
  return out;
}

/// What holds the node: how many factors of each type, and how many other nodes there are at them.
void addFactors(NodeId node, const SituationalGraph& graph, NodeFields* out) {
  std::map<std::string, std::size_t> count;
  std::set<std::pair<std::uint8_t, std::uint64_t>> others;
  for (const GraphFactor& factor : graph.factors) {
    const std::size_t size = std::min(factor.layers.size(), factor.nodes.size());
    const auto isIt = [&](std::size_t k) {
      return factor.layers[k] == static_cast<std::uint8_t>(node.layer) &&
             factor.nodes[k] == node.value;
    };
    bool is_at = false;
    for (std::size_t k = 0; k < size; ++k) is_at = is_at || isIt(k);
    if (!is_at) continue;
    ++count[factor.type];
    for (std::size_t k = 0; k < size; ++k) {
      if (!isIt(k)) others.emplace(factor.layers[k], factor.nodes[k]);
    }
  }
  std::string text;
  for (const auto& [type, factors] : count) {
    text += (text.empty() ? "" : ", ") + std::to_string(factors) + " " + type;
  }
  out->emplace_back("factors", text.empty() ? "none" : text);
  out->emplace_back("tied to", std::to_string(others.size()) + " nodes");
}

template <typename Messages>
NodeFields fieldsIn(const Messages& layer, NodeId node, const SituationalGraph& graph) {
  const auto found = std::find_if(layer.begin(), layer.end(),
                                  [node](const auto& msg) { return msg.id == node.value; });
  if (found == layer.end()) return {};
  NodeFields out = fields(*found, graph);
  addFactors(node, graph, &out);
  return out;
}

}  // namespace

NodeFields fieldsOf(const ShownGraph& graph, NodeId node) {
  const SituationalGraph& msg = *graph.msg;
  switch (node.layer) {
    case Layer::kKeyframe:
      return fieldsIn(msg.keyframes, node, msg);
    case Layer::kWall:
      return fieldsIn(msg.walls, node, msg);
    case Layer::kRoom:
      return fieldsIn(msg.rooms, node, msg);
    case Layer::kFloor:
      return fieldsIn(msg.floors, node, msg);
  }
  return {};
}

}  // namespace mrpt_sgraphs
