// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "graph_support.h"
#include "mrpt_sgraphs/graph/layered_graph.h"

namespace mrpt_sgraphs {
namespace {

using test::odometry;
using test::sight;
using test::stamped;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Pose kNoMotion = Pose::Identity();

Plane groundAt(double height_m) { return {Eigen::Vector3d::UnitZ(), height_m}; }

TEST(LayeredGraph, GivesIdsInOrderInEachLayer) {
  LayeredGraph graph;
  for (uint64_t k = 0; k < 3; ++k) {
    EXPECT_EQ(graph.addKeyframe(Pose::Identity(), {}), KeyframeId{k});
    EXPECT_EQ(graph.addWall(Plane(), {}), WallId{k});
    EXPECT_EQ(graph.addRoom(Pose::Identity(), {}), RoomId{k});
    EXPECT_EQ(graph.addFloor(Plane(), {}), FloorId{k});
  }
}

TEST(LayeredGraph, GivesNoIdTwice) {
  LayeredGraph graph;
  graph.addWall(Plane(), {});
  graph.addWall(Plane(), {});
  graph.eraseNode(WallId{1});
  EXPECT_EQ(graph.addWall(Plane(), {}), WallId{2}) << "1 was the last one";
  EXPECT_THROW(graph.restoreWall(WallId{1}, Plane(), {}), std::invalid_argument);
  EXPECT_THROW(graph.restoreWall(WallId{0}, Plane(), {}), std::invalid_argument);

  graph.restoreWall(WallId{70}, Plane(), {});
  graph.restoreWall(WallId{40}, Plane(), {});
  EXPECT_EQ(graph.addWall(Plane(), {}), WallId{71});
}

TEST(LayeredGraph, TakesAnyIdOfAFile) {
  constexpr uint64_t kLast = std::numeric_limits<uint64_t>::max() - 1;
  LayeredGraph graph;
  graph.restoreKeyframe(KeyframeId{kLast}, Pose::Identity(), stamped(3.0));
  EXPECT_EQ(graph.attributes(KeyframeId{kLast}).stamp_s, 3.0);
  EXPECT_THROW(graph.addKeyframe(Pose::Identity(), {}), std::length_error) << "none above it";
  EXPECT_THROW(graph.restoreKeyframe(KeyframeId{kLast + 1}, Pose::Identity(), {}),
               std::invalid_argument)
      << "MRPT's INVALID_NODEID";
  EXPECT_EQ(graph.size(Layer::kKeyframe), 1U);
}

TEST(LayeredGraph, KeepsEstimatesBitByBit) {
  test::RandomGeometry random(3, 300.0);
  LayeredGraph graph;
  for (int k = 0; k < 100; ++k) {
    const Pose T_map_base = random.pose();
    const Pose T_map_room = random.pose();
    const Plane wall_map = test::randomPlane(&random);
    const Plane ground_map = test::randomPlane(&random);
    const KeyframeId keyframe = graph.addKeyframe(Pose::Identity(), {});
    graph.setPose(keyframe, T_map_base);
    const RoomId room = graph.addRoom(T_map_room, {});
    const WallId wall = graph.addWall(wall_map, {});
    const FloorId floor = graph.addFloor(Plane(), {});
    graph.setPlane(floor, ground_map);
    EXPECT_EQ(graph.pose(keyframe).matrix(), T_map_base.matrix());
    EXPECT_EQ(graph.pose(room).matrix(), T_map_room.matrix());
    EXPECT_EQ(graph.plane(wall).normal, wall_map.normal);
    EXPECT_EQ(graph.plane(wall).distance, wall_map.distance);
    EXPECT_EQ(graph.plane(floor).normal, ground_map.normal);
    EXPECT_EQ(graph.plane(floor).distance, ground_map.distance);
  }
}

TEST(LayeredGraph, KeepsTheOrderAndTheValuesOfThoseThatStay) {
  LayeredGraph graph;
  for (int k = 0; k < 600; ++k) graph.addFloor(groundAt(k), {});
  for (uint64_t k = 0; k < 600; k += 3) graph.eraseNode(FloorId{k});
  ASSERT_EQ(graph.size(Layer::kFloor), 400U);
  uint32_t slot = 0;
  for (uint64_t k = 0; k < 600; ++k) {
    EXPECT_EQ(graph.contains(FloorId{k}), k % 3 != 0);
    if (k % 3 == 0) continue;
    EXPECT_EQ(graph.plane(FloorId{k}).distance, static_cast<double>(k));
    EXPECT_EQ(graph.nodeAt({Layer::kFloor, slot++}), NodeId(FloorId{k}));
  }
}

TEST(LayeredGraph, RefusesEstimatesThatAreNone) {
  LayeredGraph graph;
  const KeyframeId keyframe = graph.addKeyframe(Pose::Identity(), {});
  const FloorId floor = graph.addFloor(groundAt(0.5), {});
  Pose scaled = Pose::Identity();
  scaled.linear() *= 1.001;
  Pose mirrored = Pose::Identity();
  mirrored.linear()(2, 2) = -1.0;
  Pose nowhere = Pose::Identity();
  nowhere.translation().y() = kNaN;
  for (const Pose& T : {scaled, mirrored, nowhere}) {
    EXPECT_THROW(graph.setPose(keyframe, T), std::invalid_argument);
    EXPECT_THROW(graph.addKeyframe(T, {}), std::invalid_argument);
    EXPECT_THROW(graph.addRoom(T, {}), std::invalid_argument);
  }
  for (const Plane& plane : {Plane{{0.0, 0.0, 1.1}, 0.0}, Plane{{0.0, 0.0, 0.0}, 0.0},
                             Plane{{kNaN, 0.0, 1.0}, 0.0}, groundAt(kInfinity)}) {
    EXPECT_THROW(graph.setPlane(floor, plane), std::invalid_argument);
    EXPECT_THROW(graph.addWall(plane, {}), std::invalid_argument);
  }
  EXPECT_EQ(graph.pose(keyframe).matrix(), Pose::Identity().matrix());
  EXPECT_EQ(graph.plane(floor).distance, 0.5);
  EXPECT_EQ(graph.size(Layer::kRoom) + graph.size(Layer::kWall), 0U);
}

TEST(LayeredGraph, NamesWhatIsNotThere) {
  LayeredGraph graph;
  try {
    graph.setPose(RoomId{7}, Pose::Identity());
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_STREQ(error.what(), "room 7 is not in the graph");
  }
  EXPECT_THROW(graph.pose(KeyframeId{0}), std::out_of_range);
  EXPECT_THROW(graph.eraseNode(WallId{0}), std::out_of_range);
  EXPECT_THROW(graph.eraseFactor(FactorId{0}), std::out_of_range);
  EXPECT_THROW(graph.sightingsOf(FloorId{0}), std::out_of_range);
}

TEST(LayeredGraph, RefusesFactorsThatAreNone) {
  LayeredGraph graph;
  const KeyframeId a = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId b = graph.addKeyframe(Pose::Identity(), {});
  const WallId wall = graph.addWall(Plane(), {});
  Pose nowhere = Pose::Identity();
  nowhere.translation().x() = kInfinity;
  Matrix6 indefinite = Matrix6::Identity();
  indefinite(4, 4) = -1.0;
  Matrix6 asymmetric = Matrix6::Identity();
  asymmetric(0, 1) = 0.1;
  EXPECT_THROW(graph.addFactor(nullptr), std::invalid_argument);
  for (const FactorConstPtr& factor :
       {odometry(a, a), odometry(a, KeyframeId{9}), odometry(a, b, nowhere),
        odometry(a, b, kNoMotion, kNaN * Matrix6::Identity()),
        odometry(a, b, kNoMotion, kInfinity * Matrix6::Identity()),
        odometry(a, b, kNoMotion, indefinite), odometry(a, b, kNoMotion, asymmetric),
        sight(a, WallId{5}), sight(a, wall, {Eigen::Vector3d::UnitX(), kNaN})}) {
    EXPECT_THROW(graph.addFactor(factor), std::invalid_argument);
  }
  EXPECT_EQ(graph.factorCount(), 0U);
  EXPECT_EQ(graph.network().edgeCount(), 0U);
  EXPECT_EQ(graph.factorCountOf(a), 0U);
  EXPECT_EQ(graph.addFactor(odometry(a, b, kNoMotion, Matrix6::Zero())), FactorId{0})
      << "knows nothing";
}

TEST(LayeredGraph, RefusesMeasurementsThatAreNoPoseOrPlane) {
  LayeredGraph graph;
  const KeyframeId a = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId b = graph.addKeyframe(Pose::Identity(), {});
  const WallId wall = graph.addWall(Plane(), {});
  Pose sheared = Pose::Identity();
  sheared.linear()(0, 1) = 0.5;
  EXPECT_THROW(graph.addFactor(odometry(a, b, sheared)), std::invalid_argument);
  EXPECT_THROW(graph.addFactor(sight(a, wall, {{0.0, 0.0, 1.1}, 0.0})), std::invalid_argument);
  EXPECT_EQ(graph.factorCount(), 0U);
}

TEST(LayeredGraph, TakesEveryOdometryWhoseInformationIsPositive) {
  // its Hessian is singular: the pivots of some of these are well below zero, the eigenvalues not
  test::RandomGeometry random(4, 10.0);
  Tangent weights;
  weights << 2500.0, 2500.0, 2500.0, 4e4, 4e4, 1e4;
  const Matrix6 information = weights.asDiagonal();
  LayeredGraph graph;
  const KeyframeId a = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId b = graph.addKeyframe(Pose::Identity(), {});
  for (int k = 0; k < 20000; ++k) {
    graph.setPose(a, random.pose());
    graph.setPose(b, random.pose());
    const Pose measured = graph.pose(a).inverse() * graph.pose(b) * random.smallPose(0.05, 0.02);
    FactorId id;
    ASSERT_NO_THROW(id = graph.addFactor(odometry(a, b, measured, information))) << k;
    graph.eraseFactor(id);
  }
}

TEST(LayeredGraph, NamesTheNodesOfABadFactor) {
  LayeredGraph graph;
  const KeyframeId a = graph.addKeyframe(Pose::Identity(), {});
  const KeyframeId b = graph.addKeyframe(Pose::Identity(), {});
  try {
    graph.addFactor(odometry(a, b, kNoMotion, -Matrix6::Identity()));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "odometry between keyframe 0 and keyframe 1: the information is not positive "
                 "semidefinite");
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
