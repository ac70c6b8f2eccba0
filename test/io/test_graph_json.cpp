// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "mrpt_sgraphs/factors/summed_observations.h"
#include "mrpt_sgraphs/factors/wall_pair.h"
#include "mrpt_sgraphs/io/exports.h"
#include "mrpt_sgraphs/io/graph_reader.h"
#include "support/factor_laws.h"

namespace mrpt_sgraphs {
namespace {

using Json = nlohmann::json;

std::string written(const LayeredGraph& graph) {
  std::ostringstream out;
  writeGraphJson(*graph.snapshot(), out);
  return out.str();
}

LayeredGraph read(const std::string& text) {
  std::istringstream in(text);
  return readGraphJson(in);
}

/// What the reader says of a text, "" if nothing.
std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// A graph with a node of each layer or a few, and a factor of every type.
class GraphJsonTest : public ::testing::Test {
 protected:
  void SetUp() override {
    graph_.setMapOdom(random_.pose());
    const FloorId floor{3};
    FloorAttributes ground;
    ground.centre_map = random_.vector(50.0);
    ground.name = "ground \"0\" ü";
    ground.connections = {{FloorId{5}, random_.vector(50.0), random_.vector(50.0)}};
    graph_.restoreFloor(floor, random_.pose() * Plane{}, ground);
    graph_.restoreFloor(FloorId{5}, random_.pose() * Plane{}, {});
    const auto triangle = [this] {
      return Outline3{random_.vector(50.0), random_.vector(50.0), random_.vector(50.0)};
    };
    for (const uint64_t id : {4U, 2U, 9U}) {
      WallAttributes attributes;
      if (id == 4) attributes.floor = floor;
      attributes.extent_map = {triangle(), {triangle(), triangle()}};
      graph_.restoreWall(WallId{id}, test::randomPlane(&random_, 50.0), attributes);
    }
    RoomAttributes room;
    room.kind = RoomAttributes::Kind::kCorridor;
    room.walls = {WallId{4}, WallId{2}};
    room.floor = floor;
    room.size_m = {4.1, 1.0 / 3.0};
    room.extent_map = {triangle(), {triangle()}};
    room.height_m = 2.7;
    room.doorways = {{RoomId{8}, random_.vector(50.0), 0.9}, {{}, random_.vector(50.0), 1.0 / 3.0}};
    graph_.restoreRoom(RoomId{7}, random_.pose(), room);
    graph_.restoreRoom(RoomId{8}, random_.pose(), {});
    for (const uint64_t id : {0U, 1U, 6U}) {
      KeyframeAttributes attributes;
      attributes.stamp_s = 1.7e9 + 0.1 * static_cast<double>(id);
      attributes.T_odom_base = random_.pose();
      attributes.marginalized = id == 1;
      if (id == 1) attributes.representative = KeyframeId{0};
      if (id != 6) attributes.room = RoomId{7};
      if (id != 1) attributes.floor = floor;
      graph_.restoreKeyframe(KeyframeId{id}, random_.pose(), attributes);
    }
    addFactors();
  }

  void addFactors() {
    const KeyframeId a{0};
    const KeyframeId b{6};
    const WallId wall{4};
    const WallId other{2};
    const RoomId room{7};
    const FloorId floor{3};
    const RobustKernel huber{RobustKernel::Kind::kHuber, 2.0 / 3.0};
    const RobustKernel cauchy{RobustKernel::Kind::kCauchy, 9.0};
    using Kind = RelativePoseFactor::Kind;
    for (const Kind kind : {Kind::kOdometry, Kind::kLoopClosure, Kind::kBridge}) {
      add<RelativePoseFactor>(a, b, random_.pose(), test::randomInformation<6>(&random_), kind,
                              huber);
    }
    Matrix6 along = Matrix6::Zero();
    along(0, 0) = 0.1;
    add<RelativePoseFactor>(a, room, random_.pose(), along, Kind::kRoom);
    add<RelativePoseQuaternionFactor>(a, b, random_.pose(), test::randomInformation<6>(&random_));
    for (const NodeId surface : {NodeId(wall), NodeId(floor)}) {
      add<PlaneObservationFactor>(a, surface, test::randomPlane(&random_, 9.0),
                                  test::randomInformation<3>(&random_), cauchy);
    }
    add<RoomWallFactor>(room, wall, test::randomDirection(&random_),
                        test::randomInformation<2>(&random_), cauchy);
    add<RoomCentreFactor>(room, wall, other, test::randomInformation<1>(&random_));
    add<FloorRoomFactor>(floor, room, test::randomInformation<3>(&random_));
    add<WallPairFactor>(a, wall, other, test::randomDirection(&random_), 0.2,
                        test::randomInformation<3>(&random_), huber);
    add<PosePriorFactor>(room, random_.pose(), test::randomInformation<6>(&random_));
    add<PlanePriorFactor>(floor, random_.pose(), test::randomPlane(&random_, 9.0),
                          test::randomInformation<3>(&random_));
    ObservationSum sum(test::randomPlane(&random_, 9.0), random_.vector(9.0));
    sum.add({a, wall, test::randomPlane(&random_, 9.0), test::randomInformation<3>(&random_)},
            random_.pose());
    add<SummedObservationsFactor>(wall, sum);
    const Eigen::MatrixXd Lambda = test::randomInformation<9>(&random_);
    add<CondensedFactor>(a,
                         std::vector<CondensedFactor::Other>{
                             {b, random_.pose(), test::randomInformation<6>(&random_)},
                             {wall, test::randomPlane(&random_, 9.0)}},
                         CondensedFactor::Quadratic{Lambda, Lambda.col(2), 0.1});
    shelveFactors();
  }

  /// Those of keyframe 1, which keyframe 0 stands for.
  void shelveFactors() {
    const KeyframeId kept{0};
    const KeyframeId dropped{1};
    const Matrix6 information = test::randomInformation<6>(&random_);
    const RobustKernel huber{RobustKernel::Kind::kHuber, 3.0};
    graph_.shelve(add<RelativePoseFactor>(kept, dropped, random_.pose(), information), kept);
    graph_.shelve(add<RelativePoseFactor>(dropped, KeyframeId{6}, random_.pose(), information,
                                          RelativePoseFactor::Kind::kLoopClosure, huber),
                  std::nullopt);
    graph_.shelve(add<PlaneObservationFactor>(dropped, WallId{4}, test::randomPlane(&random_, 9.0),
                                              test::randomInformation<3>(&random_)),
                  kept);
  }

  template <typename AnyFactor, typename... Arguments>
  FactorId add(Arguments&&... arguments) {
    return graph_.addFactor(std::make_shared<AnyFactor>(std::forward<Arguments>(arguments)...));
  }

  test::RandomGeometry random_{23, 500.0};
  LayeredGraph graph_;
};

TEST_F(GraphJsonTest, WhatIsReadIsWrittenAgainToTheLastDigit) {
  const std::string text = written(graph_);
  EXPECT_EQ(written(read(text)), text);
}

TEST_F(GraphJsonTest, PosesOfAnyRotationStayWhatTheyAre) {
  for (int k = 0; k < 3000; ++k) {
    Pose T = random_.pose();
    if (k % 3 == 1) T.linear() = expSO3({0.0, 0.0, M_PI_2 * (k % 5)});
    if (k % 3 == 2)
      T.linear() = expSO3(M_PI * Eigen::Vector3d::Unit(k % 2)) * expSO3(random_.vector(1e-9));
    graph_.addKeyframe(T, {});
  }
  const std::string text = written(graph_);
  const LayeredGraph again = read(text);
  EXPECT_EQ(written(again), text);
  for (const KeyframeNode& keyframe : graph_.snapshot()->keyframes) {
    const Pose T = again.pose(keyframe.id);
    EXPECT_EQ(T.translation(), keyframe.T_map_base.translation());
    EXPECT_NEAR((T.linear() - keyframe.T_map_base.linear()).norm(), 0.0, 2e-14);
  }
}

TEST_F(GraphJsonTest, EveryFactorCostsTheSameAfterwards) {
  const LayeredGraph again = read(written(graph_));
  ASSERT_EQ(again.factorCount(), graph_.factorCount());
  for (uint32_t k = 0; k < graph_.factorCount(); ++k) {
    const Factor& before = *graph_.factorAt(k).factor;
    const Factor& after = *again.factorAt(k).factor;
    SCOPED_TRACE(before.type());
    ASSERT_STREQ(after.type(), before.type());
    ASSERT_EQ(after.nodeCount(), before.nodeCount());
    test::Values values;
    for (int n = 0; n < before.nodeCount(); ++n) {
      EXPECT_EQ(after.node(n), before.node(n));
      if (isPlane(before.node(n).layer)) {
        values.emplace_back(graph_.plane(graph_.handle(before.node(n))));
      } else {
        values.emplace_back(graph_.pose(graph_.handle(before.node(n))));
      }
    }
    const test::Linearized expected = test::linearize(before, values);
    const test::Linearized got = test::linearize(after, values);
    EXPECT_NEAR(got.cost, expected.cost, 1e-9 * (1.0 + std::abs(expected.cost)));
    EXPECT_NEAR((got.H - expected.H).norm(), 0.0, 1e-9 * (1.0 + expected.H.norm()));
    EXPECT_NEAR((got.g - expected.g).norm(), 0.0, 1e-9 * (1.0 + expected.g.norm()));
  }
}

TEST_F(GraphJsonTest, ShelvedFactorsAreOnTheShelfAgainAndNowhereElse) {
  const LayeredGraph again = read(written(graph_));
  const auto before = graph_.snapshot()->shelved;
  const auto after = again.snapshot()->shelved;
  ASSERT_EQ(before.size(), 3U);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(again.factorCount(), graph_.factorCount());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_STREQ(after[k].factor->type(), before[k].factor->type());
    EXPECT_EQ(after[k].factor->node(1), before[k].factor->node(1));
    EXPECT_EQ(after[k].kept, before[k].kept);
  }
  EXPECT_EQ(again.factorCountOf(KeyframeId{1}), 0U);
  EXPECT_EQ(again.shelf().of(KeyframeId{1}).size(), 3U);
  EXPECT_EQ(again.shelf().keptBy(KeyframeId{0}).size(), 2U);
  EXPECT_TRUE(again.brokenShelves().empty());
}

TEST_F(GraphJsonTest, WaysOfCondensedFactorsComeBack) {
  const LayeredGraph again = read(written(graph_));
  const auto condensed = [](const LayeredGraph& graph) {
    const auto last = static_cast<uint32_t>(graph.factorCount() - 1);
    return dynamic_cast<const CondensedFactor&>(*graph.factorAt(last).factor);
  };
  ASSERT_TRUE(condensed(graph_).others()[0].way_covariance);
  EXPECT_EQ(condensed(again).others()[0].way_covariance,
            condensed(graph_).others()[0].way_covariance);
  EXPECT_EQ(condensed(again).others()[1].way_covariance, std::nullopt);
}

TEST_F(GraphJsonTest, NodesKeepWhatIsKnownOfThem) {
  const LayeredGraph again = read(written(graph_));
  EXPECT_EQ(again.attributes(KeyframeId{1}).representative, KeyframeId{0});
  EXPECT_TRUE(again.attributes(KeyframeId{1}).marginalized);
  EXPECT_EQ(again.attributes(KeyframeId{6}).room, std::nullopt);
  EXPECT_EQ(again.attributes(KeyframeId{6}).representative, std::nullopt);
  EXPECT_EQ(again.attributes(RoomId{7}).kind, RoomAttributes::Kind::kCorridor);
  EXPECT_EQ(again.attributes(RoomId{7}).walls, graph_.attributes(RoomId{7}).walls);
  EXPECT_EQ(again.attributes(RoomId{7}).size_m, graph_.attributes(RoomId{7}).size_m);
  EXPECT_EQ(again.attributes(FloorId{3}).name, "ground \"0\" ü");
  const auto& extent = graph_.attributes(WallId{9}).extent_map;
  EXPECT_EQ(again.attributes(WallId{9}).extent_map.outline, extent.outline);
  EXPECT_EQ(again.attributes(WallId{9}).extent_map.holes, extent.holes);
  EXPECT_EQ(again.attributes(WallId{4}).floor, FloorId{3});
  EXPECT_EQ(again.attributes(WallId{9}).floor, std::nullopt);
  const Json document = Json::parse(written(graph_));
  EXPECT_EQ(document["rooms"][0]["keyframes"], Json({0, 1}));
  EXPECT_EQ(document["floors"][0]["keyframes"], Json({0, 6}));
  EXPECT_EQ(document["floors"][0]["rooms"], Json({7}));
}

TEST_F(GraphJsonTest, RoomsAndFloorsKeepTheirShapesAndWays) {
  const LayeredGraph again = read(written(graph_));
  const RoomAttributes& before = graph_.attributes(RoomId{7});
  const RoomAttributes& room = again.attributes(RoomId{7});
  EXPECT_EQ(room.extent_map.outline, before.extent_map.outline);
  EXPECT_EQ(room.extent_map.holes, before.extent_map.holes);
  EXPECT_EQ(room.height_m, 2.7);
  ASSERT_EQ(room.doorways.size(), 2u);
  EXPECT_EQ(room.doorways[0].to, RoomId{8});
  EXPECT_EQ(room.doorways[1].to, std::nullopt);
  EXPECT_EQ(room.doorways[0].centre_map, before.doorways[0].centre_map);
  EXPECT_EQ(room.doorways[0].width_m, 0.9);
  const auto& ways = again.attributes(FloorId{3}).connections;
  ASSERT_EQ(ways.size(), 1u);
  EXPECT_EQ(ways[0].to, FloorId{5});
  EXPECT_EQ(ways[0].here_map, graph_.attributes(FloorId{3}).connections[0].here_map);
  EXPECT_EQ(ways[0].there_map, graph_.attributes(FloorId{3}).connections[0].there_map);
}

TEST_F(GraphJsonTest, AFileFromBeforeTheShapesOfRoomsIsRead) {
  Json old = Json::parse(written(graph_));
  for (Json& wall : old["walls"]) wall.erase("floor");
  for (Json& room : old["rooms"]) {
    for (const char* field : {"holes", "height", "doorways"}) room.erase(field);
  }
  for (Json& floor : old["floors"]) {
    for (const char* field : {"connections", "rooms", "keyframes"}) floor.erase(field);
  }
  old.erase("shelved");
  for (Json& factor : old["factors"]) factor.erase("ways");
  const LayeredGraph again = read(old.dump());
  EXPECT_TRUE(again.snapshot()->shelved.empty());
  EXPECT_EQ(again.attributes(RoomId{7}).height_m, 0.0);
  EXPECT_EQ(again.attributes(RoomId{7}).extent_map.outline,
            graph_.attributes(RoomId{7}).extent_map.outline);
  EXPECT_EQ(again.attributes(WallId{4}).floor, std::nullopt);
  EXPECT_TRUE(again.attributes(FloorId{3}).connections.empty());
}

TEST_F(GraphJsonTest, DamageIsNamedWithItsPlace) {
  const Json good = Json::parse(written(graph_));
  const auto expectComplaint = [&](const char* pointer, const Json& value, const char* expected) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    EXPECT_NE(complaint(bad.dump()).find(expected), std::string::npos)
        << pointer << ": \"" << complaint(bad.dump()) << '"';
  };
  EXPECT_EQ(complaint(good.dump()), "");
  expectComplaint("/format", "other", "graph.json: format is not");
  expectComplaint("/version", 3, "graph.json: version is 3");
  expectComplaint("/factors/2/type", "magic", "graph.json: factors/2/type 'magic' is no type");
  expectComplaint("/factors/2/information/5", "x", "factors/2/information/5 is no number");
  expectComplaint("/factors/2/information", Json::array({1}), "has 1 elements, not 21");
  expectComplaint("/factors/2/information/0", -1e9, "factors/2 is refused: bridge between");
  expectComplaint("/factors/0/nodes/1/keyframe", 55, "factors/0 is refused: odometry between");
  expectComplaint("/factors/0/nodes/1/keyframe", -1, "factors/0/nodes/1/keyframe is no id");
  expectComplaint("/factors/0/nodes/1", {{"wall", 4}}, "factors/0/nodes/1 has no pose");
  expectComplaint("/factors/5/nodes/1", {{"floor", 3}}, "is of the wrong layer");
  expectComplaint("/factors/0/nodes/1", 3, "factors/0/nodes/1 names no node");
  expectComplaint("/factors/0/nodes/2", {{"keyframe", 1}}, "factors/0/nodes has 3 elements, not 2");
  expectComplaint("/factors/0/kernel/type", "odd", "factors/0/kernel/type is neither");
  expectComplaint("/factors/0/kernel/width_chi2", 0, "width_chi2 is not positive");
  expectComplaint("/factors/0/measurement/6", 2.0, "has a quaternion that is not of length 1");
  expectComplaint("/factors/5/measurement/0", 2.0, "has a normal not of length 1");
  expectComplaint("/factors/7/measurement/0", 2.0, "is not of length 1");
  expectComplaint("/keyframes/1/id", 0, "keyframes/1 is refused: keyframe 0");
  expectComplaint("/keyframes/1/room", 70, "keyframes/1 refers to room 70");
  expectComplaint("/keyframes/1/marginalized", 1, "is neither true nor false");
  expectComplaint("/keyframes", Json::object(), "keyframes is no list");
  expectComplaint("/rooms/0/kind", "hall", "rooms/0/kind is none of");
  expectComplaint("/rooms/0/walls/0", 70, "rooms/0 refers to wall 70");
  expectComplaint("/rooms/0/name", 7, "rooms/0/name is no text");
  expectComplaint("/rooms/0/height", "x", "rooms/0/height is no number");
  expectComplaint("/rooms/0/doorways/0/to", 70, "rooms/0 refers to room 70");
  expectComplaint("/rooms/0/doorways/1/width", nullptr, "rooms/0/doorways/1/width is no number");
  expectComplaint("/walls/0/floor", 70, "walls/0 refers to floor 70");
  expectComplaint("/floors/0/connections/0/to", 70, "floors/0 refers to floor 70");
  expectComplaint("/floors/0/connections/0/to", nullptr, "floors/0/connections/0/to is no id");
  expectComplaint("/walls/0", 7, "walls/0 is no object");
  expectComplaint("/shelved", 7, "shelved is no list");
  expectComplaint("/shelved/1/type", "magic", "graph.json: shelved/1/type 'magic' is no type");
  expectComplaint("/shelved/1/information/0", -1e9, "shelved/1 is refused: loop_closure between");
  expectComplaint("/shelved/0/nodes/1/keyframe", 55, "shelved/0 is refused: odometry between");
  expectComplaint("/shelved/0/kept", 55, "shelved/0 refers to keyframe 55");
  expectComplaint("/shelved/0/kept", "0", "shelved/0/kept is no id");
  const std::string condensed = "/factors/" + std::to_string(graph_.factorCount() - 1);
  expectComplaint((condensed + "/ways").c_str(), Json::array({nullptr}), "has 1 elements, not 2");
  expectComplaint((condensed + "/ways/0").c_str(), Json::array({1}), "has 1 elements, not 21");
  expectComplaint((condensed + "/ways/0/0").c_str(), -1e3, "/ways/0 is not positive semidefinite");
  expectComplaint((condensed + "/ways/1").c_str(), good["factors"][0]["information"],
                  "/ways/1 is a way to wall 4");
}

TEST_F(GraphJsonTest, EveryFieldThatIsMissingIsNamed) {
  const std::set<std::pair<std::string, std::string>> kOptional{
      {"factors", "kernel"},   {"walls", "holes"},        {"walls", "floor"},
      {"rooms", "holes"},      {"rooms", "height"},       {"rooms", "doorways"},
      {"rooms", "keyframes"},  {"floors", "connections"}, {"floors", "rooms"},
      {"floors", "keyframes"}, {"factors", "ways"},       {"shelved", "kernel"}};
  const Json good = Json::parse(written(graph_));
  for (const char* list : {"keyframes", "walls", "rooms", "floors", "factors", "shelved"}) {
    for (std::size_t k = 0; k < good[list].size(); ++k) {
      for (const auto& field : good[list][k].items()) {
        const bool optional = kOptional.count({list, field.key()}) != 0;
        Json bad = good;
        bad[list][k].erase(field.key());
        const std::string expected = optional
                                         ? ""
                                         : std::string("graph.json: ") + list + "/" +
                                               std::to_string(k) + " has no '" + field.key() + "'";
        EXPECT_EQ(complaint(bad.dump()), expected);
      }
    }
  }
}

TEST_F(GraphJsonTest, CutOffOrNotFiniteItIsRefused) {
  const std::string good = written(graph_);
  for (std::size_t length = 0; length + 2 < good.size(); length += good.size() / 97) {
    EXPECT_NE(complaint(good.substr(0, length)).find("graph.json: is no JSON"), std::string::npos);
  }
  const Json document = Json::parse(good);
  const std::string number = document["walls"][0]["plane"][3].dump();
  for (const char* bad : {"1e999", "NaN", "null", "-Infinity", "\"1\"", "[]"}) {
    std::string text = good;
    text.replace(text.find(number), number.size(), bad);
    EXPECT_NE(complaint(text), "") << bad;
  }
}

// Bytes changed, cut out and doubled at random: read, or refused with a word.
TEST_F(GraphJsonTest, WhateverHappensToTheFileItIsReadOrRefused) {
  const std::string good = Json::parse(written(graph_)).dump();
  const auto below = [this](std::size_t limit) {
    return static_cast<std::size_t>(std::abs(random_.number(0.999999)) *
                                    static_cast<double>(limit));
  };
  const std::string bytes = "0123456789-+.eE[]{},:\"ntf \\\xff";
  int refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string text = good;
    for (std::size_t change = 0; change <= below(3); ++change) {
      const std::size_t place = below(text.size());
      const std::size_t length = 1 + below(trial % 2 == 0 ? 1 : 60);
      const std::size_t kind = below(3);
      if (kind == 0) text[place] = bytes[below(bytes.size())];
      if (kind == 1) text.erase(place, length);
      if (kind == 2) text.insert(place, text.substr(place, length));
    }
    refused +=
        complaint(text).empty() ? 0 : 1;  // anything else than a runtime_error fails the test
  }
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 1000);
}

TEST_F(GraphJsonTest, ANameThatIsNoTextDoesNotCostTheFile) {
  FloorAttributes floor = graph_.attributes(FloorId{3});
  floor.name = "\xff\xfe";
  graph_.setAttributes(FloorId{3}, floor);
  EXPECT_EQ(complaint(written(graph_)), "");
}

}  // namespace
}  // namespace mrpt_sgraphs
