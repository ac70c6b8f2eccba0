// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mrpt_sgraphs/hierarchy/selection.h"
#include "support/storey_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::StoreyLab;
using Nodes = std::set<NodeId>;

Nodes setOf(const std::vector<NodeId>& nodes) { return {nodes.begin(), nodes.end()}; }

template <typename Ids>
void add(const Ids& ids, Nodes* nodes) {
  nodes->insert(ids.begin(), ids.end());
}

TEST(SelectRoom, FreesWhatIsInTheRoomAndHoldsWhatIsAroundIt) {
  StoreyLab lab;
  lab.tour();
  const KeyframeId outside = lab.keyframes[StoreyLab::kCorridor][3];
  lab.graph.addFactor(std::make_shared<RelativePoseFactor>(
      lab.keyframes[StoreyLab::kFirst].front(), lab.rooms[StoreyLab::kFirst], Pose::Identity(),
      Matrix6::Identity(), RelativePoseFactor::Kind::kRoom));
  lab.graph.addFactor(std::make_shared<PlaneObservationFactor>(  // through the door
      outside, lab.walls[StoreyLab::kFirst][3], Plane{}, Eigen::Matrix3d::Identity()));

  const Selection room = selectRoom(lab.graph, lab.rooms[StoreyLab::kFirst]);
  Nodes free{lab.rooms[StoreyLab::kFirst], lab.floor};
  add(lab.keyframes[StoreyLab::kFirst], &free);
  add(lab.walls[StoreyLab::kFirst], &free);
  EXPECT_EQ(setOf(room.free), free);
  // whoever stands on the floor holds it: all others, among them those before and after the visit
  Nodes fixed;
  add(lab.keyframes[StoreyLab::kCorridor], &fixed);
  add(lab.keyframes[StoreyLab::kSecond], &fixed);
  EXPECT_EQ(setOf(room.fixed), fixed);
}

TEST(SelectRoom, HoldsItsFirstKeyframeWhereNothingElseDoes) {
  StoreyLab lab;
  const KeyframeId first = lab.add(StoreyLab::kFirst, 2.0, 3.0);
  const KeyframeId second = lab.add(StoreyLab::kFirst, 3.0, 3.0);
  const Selection room = selectRoom(lab.graph, lab.rooms[StoreyLab::kFirst]);
  EXPECT_EQ(room.fixed, std::vector<NodeId>{first});
  EXPECT_EQ(std::count(room.free.begin(), room.free.end(), NodeId(second)), 1);
  Optimizer optimizer;
  EXPECT_TRUE(optimizeSelection(room, {}, &optimizer, &lab.graph).gauge.empty());
}

TEST(SelectRoom, KnowsKeyframesWithoutARoomByTheEquationOfThePaper) {
  StoreyLab lab;
  lab.tour();
  for (const int place : {StoreyLab::kFirst, StoreyLab::kCorridor}) {
    for (const KeyframeId id : lab.keyframes[place]) {
      KeyframeAttributes attributes = lab.graph.attributes(id);
      attributes.room.reset();
      lab.graph.setAttributes(id, attributes);
    }
  }
  const Selection room = selectRoom(lab.graph, lab.rooms[StoreyLab::kFirst]);
  Nodes free;
  for (const NodeId node : room.free) {
    if (node.layer == Layer::kKeyframe) free.insert(node);
  }
  Nodes expected;
  add(lab.keyframes[StoreyLab::kFirst], &expected);
  EXPECT_EQ(free, expected);
}

// Both walls on one side of the origin, normals that point in or out: all the same.
TEST(SelectRoom, TheEquationDoesNotDependOnTheOriginNorOnTheNormals) {
  for (const double far_m : {0.0, 50.0, -300.0}) {
    Pose T_map_world = expPose((Tangent() << far_m, far_m, 0.0, 0.0, 0.0, 1.0).finished());
    StoreyLab lab(T_map_world);
    const RoomId room = lab.rooms[StoreyLab::kFirst];
    for (const bool turned : {false, true}) {
      if (turned) {
        const Plane wall = lab.graph.plane(lab.walls[StoreyLab::kFirst][0]);
        lab.graph.setPlane(lab.walls[StoreyLab::kFirst][0], Plane{-wall.normal, -wall.distance});
      }
      EXPECT_TRUE(isWithin(lab.graph, room, T_map_world * Eigen::Vector3d(0.5, 2.0, 1.0)));
      EXPECT_TRUE(isWithin(lab.graph, room, T_map_world * Eigen::Vector3d(5.5, 6.0, 1.0)));
      EXPECT_FALSE(isWithin(lab.graph, room, T_map_world * Eigen::Vector3d(-0.5, 2.0, 1.0)));
      EXPECT_FALSE(isWithin(lab.graph, room, T_map_world * Eigen::Vector3d(6.5, 2.0, 1.0)));
      EXPECT_FALSE(isWithin(lab.graph, room, T_map_world * Eigen::Vector3d(3.0, 1.0, 1.0)));
    }
    // a corridor is told by its outline
    const RoomId corridor = lab.rooms[StoreyLab::kCorridor];
    EXPECT_TRUE(isWithin(lab.graph, corridor, T_map_world * Eigen::Vector3d(13.0, 0.0, 1.0)));
    EXPECT_FALSE(isWithin(lab.graph, corridor, T_map_world * Eigen::Vector3d(15.0, 0.0, 1.0)));
  }
}

TEST(SelectRoom, ThrowsForARoomThatIsNotThere) {
  EXPECT_THROW(selectRoom(StoreyLab().graph, RoomId{7}), std::out_of_range);
}

TEST(SelectFloor, FreesAStoreyAndHoldsTheWayToIt) {
  StoreyLab lab;
  lab.tour();
  // up some stairs to another storey
  const std::size_t on_floor = lab.truth.size();
  const FloorId upper = lab.graph.addFloor(Plane{{0.0, 0.0, 1.0}, 3.0}, {});
  KeyframeId last{on_floor - 1};
  for (int k = 0; k < 3; ++k) {
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(on_floor) + k;
    if (k > 0) attributes.floor = upper;
    const KeyframeId id = lab.graph.addKeyframe(lab.graph.pose(last), attributes);
    lab.connect(last, id, Pose::Identity(), RelativePoseFactor::Kind::kOdometry);
    last = id;
  }
  lab.graph.addFactor(std::make_shared<PlaneObservationFactor>(
      last, upper, Plane{{0.0, 0.0, 1.0}, -1.0}, Eigen::Matrix3d::Identity()));

  const Selection storey = selectFloor(lab.graph, upper);
  EXPECT_EQ(setOf(storey.free), (Nodes{KeyframeId{on_floor + 1}, last, upper}));
  EXPECT_EQ(setOf(storey.fixed), (Nodes{KeyframeId{on_floor}}));

  const Selection ground = selectFloor(lab.graph, lab.floor);
  EXPECT_EQ(setOf(ground.fixed), (Nodes{KeyframeId{0}, KeyframeId{on_floor}}));
  Nodes free{lab.floor};
  for (std::size_t k = 1; k < on_floor; ++k) free.insert(KeyframeId{k});
  for (const int place : {StoreyLab::kCorridor, StoreyLab::kFirst, StoreyLab::kSecond}) {
    add(lab.walls[place], &free);
  }
  EXPECT_EQ(setOf(ground.free), free);
}

TEST(SelectAll, LeavesOutWhatIsDroppedAndWhatNothingHolds) {
  StoreyLab lab;
  lab.tour();
  const WallId lonely = lab.graph.addWall(Plane{}, {});
  const KeyframeId dropped = lab.keyframes[StoreyLab::kFirst][4];
  while (!lab.graph.sightingsOf(dropped).empty()) {
    lab.graph.shelve(lab.graph.sightingsOf(dropped).back().id, KeyframeId{0});
  }
  while (!lab.graph.otherFactorsOf(dropped).empty()) {
    lab.graph.shelve(lab.graph.otherFactorsOf(dropped).back().id, KeyframeId{0});
  }
  const Selection all = selectAll(lab.graph);
  EXPECT_EQ(all.fixed, std::vector<NodeId>{KeyframeId{0}});
  const Nodes free = setOf(all.free);
  EXPECT_EQ(free.count(dropped) + free.count(lonely), 0U);
  EXPECT_EQ(free.size(), lab.truth.size() - 2 + 12 + 1);
}

}  // namespace
}  // namespace mrpt_sgraphs
