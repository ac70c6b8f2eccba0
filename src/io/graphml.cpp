// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/graphml.h"

#include <Eigen/Geometry>
#include <iomanip>
#include <optional>
#include <string>

#include "mrpt_sgraphs/graph/room_kind.h"
#include "mrpt_sgraphs/semantics/doors.h"
#include "xml_text.h"

namespace mrpt_sgraphs {
namespace {

constexpr int kAllDigits = 17;  ///< A double comes back as it was.

struct Key {
  const char* name;
  const char* type;
  const char* of;
};

constexpr Key kKeys[] = {
    {"layer", "string", "node"},      {"id", "long", "node"},
    {"name", "string", "node"},       {"kind", "string", "node"},
    {"stamp_s", "double", "node"},    {"marginalized", "boolean", "node"},
    {"floor", "string", "node"},      {"room", "string", "node"},
    {"x", "double", "node"},          {"y", "double", "node"},
    {"z", "double", "node"},          {"qx", "double", "node"},
    {"qy", "double", "node"},         {"qz", "double", "node"},
    {"qw", "double", "node"},         {"nx", "double", "node"},
    {"ny", "double", "node"},         {"nz", "double", "node"},
    {"distance_m", "double", "node"}, {"type", "string", "edge"},
    {"factor", "long", "edge"},       {"shelved", "boolean", "edge"},
    {"width_m", "double", "edge"},
};

/// As XML names it: ids have no blanks.
std::string idOf(NodeId node) {
  std::string id = nameOf(node);
  id[id.find(' ')] = '_';
  return id;
}

class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {
    out_ << std::setprecision(kAllDigits) << std::boolalpha;
  }

  void begin() {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\"\n"
            "         xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
            "         xsi:schemaLocation=\"http://graphml.graphdrawing.org/xmlns "
            "http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd\">\n";
    for (const Key& key : kKeys) {
      out_ << " <key id=\"" << key.name << "\" for=\"" << key.of << "\" attr.name=\"" << key.name
           << "\" attr.type=\"" << key.type << "\"/>\n";
    }
    out_ << " <graph id=\"situational_graph\" edgedefault=\"undirected\">\n";
  }
  void end() { out_ << " </graph>\n</graphml>\n"; }

  void beginNode(NodeId node, const char* layer) {
    out_ << "  <node id=\"" << idOf(node) << "\">\n";
    data("layer", layer);
    data("id", node.value);
  }
  void endNode() { out_ << "  </node>\n"; }

  void beginEdge(NodeId from, NodeId to, const char* type) {
    out_ << "  <edge id=\"e" << edges_++ << "\" source=\"" << idOf(from) << "\" target=\""
         << idOf(to) << "\">\n";
    data("type", type);
  }
  void endEdge() { out_ << "  </edge>\n"; }

  template <typename Value>
  void data(const char* key, const Value& value) {
    out_ << "   <data key=\"" << key << "\">" << value << "</data>\n";
  }
  void text(const char* key, const std::string& value) { data(key, xmlText(value)); }
  template <typename AnyId>
  void reference(const char* key, const std::optional<AnyId>& id) {
    if (id) data(key, idOf(*id));
  }
  void position(const Eigen::Vector3d& p_map) {
    data("x", p_map.x());
    data("y", p_map.y());
    data("z", p_map.z());
  }
  void pose(const Pose& T) {
    const Eigen::Quaterniond q(T.linear());
    position(T.translation());
    data("qx", q.x());
    data("qy", q.y());
    data("qz", q.z());
    data("qw", q.w());
  }
  void plane(const Plane& plane_map) {
    data("nx", plane_map.normal.x());
    data("ny", plane_map.normal.y());
    data("nz", plane_map.normal.z());
    data("distance_m", plane_map.distance);
  }

 private:
  std::ostream& out_;
  std::size_t edges_ = 0;
};

/// Where a drawing may have a wall: in the middle of what was seen of it.
Eigen::Vector3d middleOf(const WallNode& wall) {
  const Outline3& outline = wall.extent_map.outline;
  if (outline.empty()) return wall.plane_map.normal * wall.plane_map.distance;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : outline) sum += corner;
  return sum / static_cast<double>(outline.size());
}

void write(const KeyframeNode& keyframe, Writer* writer) {
  writer->beginNode(keyframe.id, "keyframe");
  writer->data("stamp_s", keyframe.stamp_s);
  writer->data("marginalized", keyframe.marginalized);
  writer->reference("floor", keyframe.floor);
  writer->reference("room", keyframe.room);
  writer->pose(keyframe.T_map_base);
  writer->endNode();
}

void write(const WallNode& wall, Writer* writer) {
  writer->beginNode(wall.id, "wall");
  writer->reference("floor", wall.floor);
  writer->position(middleOf(wall));
  writer->plane(wall.plane_map);
  writer->endNode();
}

void write(const RoomNode& room, Writer* writer) {
  writer->beginNode(room.id, "room");
  writer->text("name", room.name);
  writer->data("kind", nameOf(room.kind));
  writer->reference("floor", room.floor);
  writer->pose(room.T_map_room);
  writer->endNode();
}

void write(const FloorNode& floor, Writer* writer) {
  writer->beginNode(floor.id, "floor");
  writer->text("name", floor.name);
  writer->position(floor.centre_map);
  writer->plane(floor.ground_map);
  writer->endNode();
}

void write(const Factor& factor, FactorId id, bool shelved, Writer* writer) {
  const bool is_unary = factor.nodeCount() == 1;
  for (int k = is_unary ? 0 : 1; k < factor.nodeCount(); ++k) {
    writer->beginEdge(factor.node(0), factor.node(k), factor.type());
    writer->data("factor", id.value);
    writer->data("shelved", shelved);
    writer->endEdge();
  }
}

void writeWays(const GraphSnapshot& graph, Writer* writer) {
  for (const Door& door : doorsOf(graph)) {
    if (!door.to) continue;
    writer->beginEdge(door.from, *door.to, "doorway");
    writer->data("width_m", door.width_m);
    writer->endEdge();
  }
  for (const Stairs& stairs : stairsOf(graph)) {
    writer->beginEdge(stairs.from, stairs.to, "stairs");
    writer->endEdge();
  }
}

}  // namespace

void writeGraphMl(const GraphSnapshot& graph, std::ostream& out) {
  Writer writer(out);
  writer.begin();
  for (const KeyframeNode& node : graph.keyframes) write(node, &writer);
  for (const WallNode& node : graph.walls) write(node, &writer);
  for (const RoomNode& node : graph.rooms) write(node, &writer);
  for (const FloorNode& node : graph.floors) write(node, &writer);
  for (const StoredFactor& stored : graph.factors) {
    write(*stored.factor, stored.id, false, &writer);
  }
  for (const ShelvedFactor& shelved : graph.shelved) {
    write(*shelved.factor, shelved.id, true, &writer);
  }
  writeWays(graph, &writer);
  writer.end();
}

}  // namespace mrpt_sgraphs
