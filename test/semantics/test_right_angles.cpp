// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <random>

#include "mrpt_sgraphs/semantics/right_angles.h"
#include "room_lab.h"

namespace mrpt_sgraphs {
namespace {

using test::rectangle;
using test::RoomLab;

constexpr double kRadPerDeg = M_PI / 180.0;
constexpr double kReach_rad = 0.035;
constexpr double kLeast_rad = 0.0002;

/// Rooms of four walls, each with a heading of its own, measured to `measured_rad`.
std::vector<ScatterGroup> roomsOf(int rooms, double built_rad, double measured_rad, int strangers) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  std::vector<ScatterGroup> groups;
  for (int room = 0; room < rooms; ++room) {
    ScatterGroup group;
    group.r = Eigen::VectorXd::Constant(4, 0.1 * normal(generator));
    group.v = Eigen::VectorXd::Constant(4, measured_rad * measured_rad);
    group.X = Eigen::MatrixXd::Ones(4, 1);
    for (int k = 0; k < 4; ++k) {
      group.r(k) += std::hypot(built_rad, measured_rad) * normal(generator);
    }
    if (room < strangers) group.r(3) += 1.0 * kRadPerDeg;
    groups.push_back(group);
  }
  return groups;
}

TEST(Scatter, ABuildingIsFoundToBeAsExactAsItIs) {
  for (const double built_deg : {0.05, 0.1, 0.3, 1.0}) {
    SCOPED_TRACE(built_deg);
    const double built_rad = built_deg * kRadPerDeg;
    const double sigma_rad =
        scatterOf(roomsOf(20, built_rad, 0.02 * kRadPerDeg, 0), kLeast_rad, kReach_rad);
    EXPECT_GT(sigma_rad, built_rad / 1.5);
    EXPECT_LT(sigma_rad, built_rad * 1.5);
  }
}

TEST(Scatter, AnExactBuildingIsFoundToBeFarMoreExactThanItWasMeasured) {
  const double measured_rad = 0.05 * kRadPerDeg;
  EXPECT_LT(scatterOf(roomsOf(20, 0.0, measured_rad, 0), kLeast_rad, kReach_rad),
            0.6 * measured_rad);
}

TEST(Scatter, FewValuesAreNoProof) {
  const double measured_rad = 0.02 * kRadPerDeg;
  const double of_none = scatterOf({}, kLeast_rad, kReach_rad);
  const double of_one = scatterOf(roomsOf(1, 0.0, measured_rad, 0), kLeast_rad, kReach_rad);
  const double of_many = scatterOf(roomsOf(30, 0.0, measured_rad, 0), kLeast_rad, kReach_rad);
  EXPECT_GT(of_none, 0.1 * kRadPerDeg);
  EXPECT_GE(of_none, of_one);
  EXPECT_GE(of_one, of_many);
}

TEST(Scatter, SomeWallsThatAreAskewDoNotMakeTheOthersSo) {
  const double measured_rad = 0.02 * kRadPerDeg;
  EXPECT_LT(scatterOf(roomsOf(20, 0.0, measured_rad, 3), kLeast_rad, kReach_rad),
            2.0 * measured_rad);
}

/// Six rooms in a row whose corners are off by so much, each wall seen by a few keyframes.
struct Row : RoomLab {
  explicit Row(double askew_rad) {
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    sight_sigma_rad = 0.15 * kRadPerDeg;
    odometry_sigma_rad = 0.005 * kRadPerDeg;  // a room that is turned as a whole stays so
    for (int k = 0; k < 6; ++k) {
      std::vector<Eigen::Vector2d> corners = rectangle(5.0 * k, 0.0, 5.0 * k + 4.8, 4.0);
      for (Eigen::Vector2d& corner : corners) {
        corner += 3.0 * askew_rad * Eigen::Vector2d(normal(generator), normal(generator));
      }
      const std::vector<WallId> walls = addWalls(corners);
      std::vector<KeyframeId> keyframes;
      for (int n = 0; n < 8; ++n) {
        keyframes.push_back(addKeyframe({5.0 * k + 0.5 * (n + 1), 2.0}, walls));
      }
      all_walls.insert(all_walls.end(), walls.begin(), walls.end());
      rooms_.push_back(detected(corners, walls, keyframes));
    }
    optimize();
  }

  /// The mean error of the walls with rooms over that without.
  double errorRatio() {
    const double without = normalError_rad(all_walls);
    layer.update(detection(rooms_), &graph);
    optimize();
    return normalError_rad(all_walls) / without;
  }

  std::vector<WallId> all_walls;
  std::vector<DetectedRoom> rooms_;
};

TEST(RightAngles, ArePulledTogetherWhereTheBuildingIsExact) {
  Row row(0.0);
  EXPECT_LT(row.errorRatio(), 0.8);
  EXPECT_LT(row.layer.exactness().right_angle_rad, 0.05 * kRadPerDeg);
}

TEST(RightAngles, AreLeftAloneWhereItIsNot) {
  Row row(0.3 * kRadPerDeg);
  EXPECT_LT(row.errorRatio(), 1.02);
  EXPECT_GT(row.layer.exactness().right_angle_rad, 0.15 * kRadPerDeg);
}

TEST(RightAngles, ARoomThatHasNoneIsNotBentIntoOne) {
  RoomLab lab;
  const std::vector<Eigen::Vector2d> corners{{0.0, 0.0}, {6.0, 0.0}, {4.5, 3.0}, {1.0, 3.5}};
  const std::vector<WallId> walls = lab.addWalls(corners);
  std::vector<KeyframeId> keyframes;
  for (const double x : {1.5, 2.5, 3.5, 4.0}) keyframes.push_back(lab.addKeyframe({x, 1.5}, walls));
  lab.optimize();
  const GraphSnapshotConstPtr before = lab.graph.snapshot();
  lab.layer.update(
      lab.detection({lab.detected(corners, walls, keyframes, RoomAttributes::Kind::kPolygon)}),
      &lab.graph);
  lab.optimize();
  for (const WallNode& wall : before->walls) {
    const Eigen::Vector3d a = wall.plane_map.normal;
    const Eigen::Vector3d b = lab.graph.plane(wall.id).normal;
    EXPECT_NEAR(std::atan2(a.x() * b.y() - a.y() * b.x(), a.head<2>().dot(b.head<2>())), 0.0,
                0.01 * kRadPerDeg);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
