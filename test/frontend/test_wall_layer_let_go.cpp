// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

// Walls whose keyframes have lost their planes.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mrpt_sgraphs/frontend/wall_layer.h"
#include "wall_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::kPairsOfSixRooms;
using test::kWallsOfSixRooms;
using test::WallLab;

/// The first keyframes are dropped, all for the sake of one of them, and their planes go.
void dropFirst(std::size_t count, KeyframeId representative, WallLab* lab) {
  std::vector<KeyframeId> dropped;
  for (std::size_t k = 0; k < count; ++k) {
    const KeyframeId id{k};
    KeyframeAttributes attributes = lab->graph.attributes(id);
    attributes.marginalized = id != representative;
    if (attributes.marginalized) attributes.representative = representative;
    attributes.planes.reset();
    lab->graph.setAttributes(id, attributes);
    dropped.push_back(id);
  }
  lab->layer.letPlanesGo(dropped, lab->graph);
}

/// By the walls' order [m^2].
std::vector<double> areasOf(const WallLab& lab) {
  std::vector<double> areas_m2;
  for (const auto& [number, track] : lab.layer.tracks()) {
    if (track.id) areas_m2.push_back(track.extent.area_m2());
  }
  return areas_m2;
}

double sumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void walkAll(WallLab* lab) {
  for (const Pose& T_world_base : test::walkThroughSixRooms()) lab->step(T_world_base);
}

/// All keyframes and walls, by a motion of the map.
void move(const Pose& T, LayeredGraph* graph) {
  const GraphSnapshotConstPtr now = graph->snapshot();
  for (const KeyframeNode& node : now->keyframes) graph->setPose(node.id, T * node.T_map_base);
  for (const WallNode& node : now->walls) graph->setPlane(node.id, T * node.plane_map);
}

class WallsLetGo : public ::testing::Test {
 protected:
  WallsLetGo() : lab_(test::sixRooms()) { walkAll(&lab_); }

  WallLab lab_;
};

TEST_F(WallsLetGo, NobodyKeepsThePlanes) {
  std::vector<std::weak_ptr<const ObservedPlanes>> planes;
  for (std::size_t k = 0; k < lab_.truth.size(); ++k) {
    planes.push_back(lab_.graph.attributes(KeyframeId{k}).planes);
  }
  const std::size_t gone = lab_.truth.size() - 5;
  dropFirst(gone, KeyframeId{0}, &lab_);
  lab_.graph.snapshot();  // the one before held them, too
  for (std::size_t k = 0; k < planes.size(); ++k) EXPECT_EQ(planes[k].expired(), k < gone) << k;
}

TEST_F(WallsLetGo, WallsStayWhatTheyAreAndAreFoundAgain) {
  const std::vector<double> areas_m2 = areasOf(lab_);
  const std::size_t observations = lab_.observations();
  dropFirst(lab_.truth.size(), KeyframeId{0}, &lab_);
  EXPECT_EQ(areasOf(lab_), areas_m2);
  EXPECT_EQ(lab_.observations(), observations) << "what is in the graph is not the layer's";
  walkAll(&lab_);
  EXPECT_EQ(lab_.walls(), static_cast<std::size_t>(kWallsOfSixRooms));
  EXPECT_EQ(lab_.pairs(), static_cast<std::size_t>(kPairsOfSixRooms));
  EXPECT_GT(lab_.observations(), 2 * observations - 20);
  for (const auto& [face, walls] : lab_.wallsOnFaces()) {
    EXPECT_NE(face, -1);
    EXPECT_EQ(walls, 1) << "face " << face;
  }
}

TEST_F(WallsLetGo, ExtentsMoveWithTheKeyframeThatStandsForOthers) {
  const std::vector<double> areas_m2 = areasOf(lab_);
  const auto box = [this] { return lab_.graph.snapshot()->walls[0].extent_map.outline; };
  const Outline3 before = box();
  dropFirst(lab_.truth.size() - 1, KeyframeId{0}, &lab_);
  Pose T = Pose::Identity();
  T.linear() = expSO3({0.0, 0.0, 0.3});
  T.translation() << 4.0, -2.0, 0.0;
  move(T, &lab_.graph);
  lab_.layer.maintain(lab_.way, &lab_.graph);
  ASSERT_EQ(areasOf(lab_).size(), areas_m2.size());
  for (std::size_t k = 0; k < areas_m2.size(); ++k) {
    EXPECT_NEAR(areasOf(lab_)[k], areas_m2[k], 0.04 * areas_m2[k] + 0.1) << k;
  }
  Eigen::AlignedBox3d expected, drawn;
  for (const Eigen::Vector3d& corner : before) expected.extend(T * corner);
  for (const Eigen::Vector3d& corner : box()) drawn.extend(corner);
  EXPECT_LT((expected.min() - drawn.min()).norm(), 0.25);
  EXPECT_LT((expected.max() - drawn.max()).norm(), 0.25);
}

/// As where planes are still there: walls that are there twice become one, and no sight of them is
/// lost, and no part.
TEST(WallsLetGoTwice, WallsThatALoopBringsTogetherAreMerged) {
  const std::vector<Pose> walk = test::walkThroughSixRooms();
  const std::size_t half = walk.size() / 2;
  double areas_m2[2] = {0.0, 0.0};
  for (const bool let_go : {false, true}) {
    WallLab lab(test::sixRooms());
    for (std::size_t k = 0; k < walk.size(); ++k) {
      const bool slips = k == half;
      lab.step(walk[k], slips ? Pose(Eigen::Translation3d(0.5, 0.5, 0.0)) : Pose::Identity());
    }
    const std::size_t sightings = lab.observations();
    EXPECT_GT(lab.walls(), static_cast<std::size_t>(kWallsOfSixRooms));
    if (let_go) dropFirst(half, KeyframeId{0}, &lab);
    std::size_t old = 0;  // the pose that the last one is nearest to
    for (std::size_t k = 0; k < half; ++k) {
      const auto distance = [&](std::size_t i) {
        return (walk[i].translation() - walk.back().translation()).norm();
      };
      if (distance(k) < distance(old)) old = k;
    }
    lab.closeLoop(old);
    lab.closeLoop(old);
    EXPECT_EQ(lab.walls(), static_cast<std::size_t>(kWallsOfSixRooms)) << let_go;
    EXPECT_GE(lab.observations(), sightings) << let_go;
    areas_m2[let_go ? 1 : 0] = sumOf(areasOf(lab));
  }
  EXPECT_NEAR(areas_m2[1], areas_m2[0], 0.05 * areas_m2[0]);
}

TEST(WallsLetGoEarly, WhatIsOnProbationIsForgotten) {
  test::PlaneWorld world;
  world.faces.push_back({{6.0, 2.0}, {0.0, 2.0}, {}});
  WallLab lab(world);
  Pose T_world_base = Pose::Identity();
  T_world_base.translation() << 2.0, 0.0, 0.8;
  lab.step(T_world_base);
  ASSERT_EQ(lab.layer.tracks().size(), 1U);
  dropFirst(1, KeyframeId{0}, &lab);
  EXPECT_TRUE(lab.layer.tracks().empty());
  for (int k = 0; k < 6; ++k) {
    T_world_base.translation().x() += 0.5;
    lab.step(T_world_base);
  }
  EXPECT_EQ(lab.walls(), 1U);
}

}  // namespace
}  // namespace mrpt_sgraphs
