// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/graphml.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>
#include <string>

#include "support/small_building.h"
#include "xml_file.h"

namespace mrpt_sgraphs {
namespace {

std::string written(const GraphSnapshot& graph) {
  std::ostringstream out;
  writeGraphMl(graph, out);
  return out.str();
}

class GraphMlTest : public ::testing::Test {
 protected:
  /// The data of a node or edge, "" if it has none of that key.
  static std::string data(const tinyxml2::XMLElement& element, const std::string& key) {
    for (const auto* child = element.FirstChildElement("data"); child != nullptr;
         child = child->NextSiblingElement("data")) {
      if (child->Attribute("key") == key) return child->GetText();
    }
    return "";
  }

  const tinyxml2::XMLElement* node(const std::string& id) const {
    for (const auto* node : file_.elements("node")) {
      if (node->Attribute("id") == id) return node;
    }
    return nullptr;
  }

  const test::SmallBuilding building_;
  const test::XmlFile file_{written(*building_.snapshot())};
};

TEST_F(GraphMlTest, EveryNodeOfTheFourLayersIsThereOnce) {
  std::map<std::string, int> layers;
  std::set<std::string> ids;
  for (const auto* node : file_.elements("node")) {
    ++layers[data(*node, "layer")];
    EXPECT_TRUE(ids.insert(node->Attribute("id")).second);
  }
  const std::map<std::string, int> expected{
      {"keyframe", 2}, {"wall", 3}, {"room", 3}, {"floor", 2}};
  EXPECT_EQ(layers, expected);
}

TEST_F(GraphMlTest, NodesHaveNamesPosesAndPlanes) {
  ASSERT_NE(node("room_1"), nullptr);
  EXPECT_EQ(data(*node("room_1"), "name"), test::SmallBuilding::kName);
  EXPECT_EQ(data(*node("room_1"), "floor"), "floor_0");
  EXPECT_DOUBLE_EQ(std::stod(data(*node("room_1"), "x")), 6.7);
  EXPECT_EQ(data(*node("keyframe_1"), "room"), "room_1");
  EXPECT_EQ(data(*node("keyframe_1"), "marginalized"), "false");
  EXPECT_EQ(data(*node("wall_2"), "nx"), "-1");
  EXPECT_EQ(std::stod(data(*node("wall_2"), "distance_m")), -9.2);
}

TEST_F(GraphMlTest, FactorsAreEdgesOfNodesThatAreThere) {
  std::map<std::string, int> types;
  for (const auto* edge : file_.elements("edge")) {
    EXPECT_NE(node(edge->Attribute("source")), nullptr);
    EXPECT_NE(node(edge->Attribute("target")), nullptr);
    ++types[data(*edge, "type")];
    const bool is_way = data(*edge, "type") == "doorway" || data(*edge, "type") == "stairs";
    EXPECT_EQ(data(*edge, "factor").empty(), is_way);
    EXPECT_EQ(data(*edge, "shelved") == "true", data(*edge, "type") == "wall_observation");
  }
  const std::map<std::string, int> expected{{"pose_prior", 1}, {"odometry", 1},
                                            {"wall_pair", 2},  {"wall_observation", 1},
                                            {"doorway", 1},    {"stairs", 1}};
  EXPECT_EQ(types, expected);
}

TEST_F(GraphMlTest, AFactorOfOneNodeIsALoopAndOneOfMoreAStar) {
  std::set<std::string> of_pair;
  for (const auto* edge : file_.elements("edge")) {
    const std::string source = edge->Attribute("source");
    const std::string target = edge->Attribute("target");
    if (data(*edge, "type") == "pose_prior") {
      EXPECT_EQ(source, target);
    }
    if (data(*edge, "type") != "wall_pair") continue;
    EXPECT_EQ(source, "keyframe_0");
    of_pair.insert(data(*edge, "factor") + " " + target);
  }
  EXPECT_EQ(of_pair, (std::set<std::string>{"2 wall_0", "2 wall_1"}));
}

TEST_F(GraphMlTest, EveryKeyThatIsUsedIsDeclaredForWhereItIsUsed) {
  std::set<std::string> declared;
  for (const auto* key : file_.elements("key")) {
    declared.insert(std::string(key->Attribute("for")) + " " + key->Attribute("id"));
  }
  for (const std::string kind : {"node", "edge"}) {
    for (const auto* element : file_.elements(kind)) {
      for (const auto* child = element->FirstChildElement("data"); child != nullptr;
           child = child->NextSiblingElement("data")) {
        EXPECT_EQ(declared.count(kind + " " + child->Attribute("key")), 1U);
      }
    }
  }
}

TEST(GraphMl, NamesThatXmlCannotSayDoNotCostTheFile) {
  LayeredGraph graph;
  RoomAttributes room;
  room.name = std::string("a\x01" "b\xFF") + "]]>";
  graph.addRoom(Pose::Identity(), room);
  const test::XmlFile file(written(*graph.snapshot()));
  bool found = false;
  for (const auto* element : file.elements("data")) {
    if (std::string(element->GetText()) == "a\xEF\xBF\xBD" "b\xEF\xBF\xBD]]>") found = true;
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace mrpt_sgraphs
