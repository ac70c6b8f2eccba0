// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "mrpt_sgraphs/factors/floor_rooms.h"
#include "mrpt_sgraphs/factors/prior.h"
#include "mrpt_sgraphs/factors/room_walls.h"
#include "support/dense_problem.h"

namespace mrpt_sgraphs {
namespace {

using test::DenseProblem;

const RoomId kRoom{0};
const FloorId kFloor{0};
const KeyframeId kKeyframe{0};
constexpr double kWeight = 100.0;

WallId wall(std::size_t k) { return WallId{k}; }

/// A room of `distances_m.size()` walls with normals at the given angles, somewhere in the map,
/// with its factors of direction.
class RoomTest : public ::testing::TestWithParam<double> {
 protected:
  DenseProblem room(const std::vector<double>& angles_rad, bool with_directions = true) {
    DenseProblem problem;
    T_map_room_ = random_.pose();
    problem.values[kRoom] = T_map_room_;
    for (std::size_t k = 0; k < angles_rad.size(); ++k) {
      const Eigen::Vector3d axis_room = expSO3({0.0, 0.0, angles_rad[k]}).col(0);
      problem.values[wall(k)] = T_map_room_ * Plane{axis_room, -2.0 - static_cast<double>(k % 2)};
      if (with_directions) {
        problem.factors.push_back(std::make_shared<RoomWallFactor>(
            kRoom, wall(k), axis_room, kWeight * Eigen::Matrix2d::Identity()));
      }
    }
    return problem;
  }

  static void addCentre(std::size_t a, std::size_t b, DenseProblem* problem) {
    problem->factors.push_back(std::make_shared<RoomCentreFactor>(
        kRoom, wall(a), wall(b), RoomCentreFactor::Information(kWeight)));
  }

  /// The information on the walls when the room is wherever it fits best.
  static Eigen::MatrixXd onWalls(const DenseProblem& problem, std::size_t walls) {
    std::vector<NodeId> nodes;
    for (std::size_t k = 0; k < walls; ++k) nodes.push_back(wall(k));
    return test::schurComplement(problem.linearize(), problem.rowsOf(nodes),
                                 problem.rowsOf({kRoom}))
        .H;
  }
  static int rankOnWalls(const DenseProblem& problem, std::size_t walls) {
    return test::rankOf(onWalls(problem, walls), problem.linearize().H.norm());
  }
  static int rankOnRoom(const DenseProblem& problem) {
    const std::vector<Eigen::Index> rows = problem.rowsOf({kRoom});
    return test::rankOf(test::pick(problem.linearize().H, rows, rows), kWeight);
  }

  test::RandomGeometry random_{11, GetParam()};
  Pose T_map_room_ = Pose::Identity();
  const std::vector<double> kRectangle_{0.0, M_PI, M_PI_2, -M_PI_2};
  const std::vector<double> kCorridor_{M_PI_2, -M_PI_2};
};
INSTANTIATE_TEST_SUITE_P(Extents, RoomTest, ::testing::Values(1.0, 50.0, 500.0));

// Four directions, 8 rows; the room's own rotation takes 3 of them, its centre both other rows.
TEST_P(RoomTest, FourWallsKeepFiveRowsOfInformationWithoutTheRoom) {
  DenseProblem problem = room(kRectangle_);
  addCentre(0, 1, &problem);
  addCentre(2, 3, &problem);
  EXPECT_EQ(rankOnWalls(problem, 4), 5);
}

// Two directions, 4 rows; turning the room about their common normal moves none: 2 are taken.
TEST_P(RoomTest, ACorridorKeepsTwo) {
  DenseProblem problem = room(kCorridor_);
  addCentre(0, 1, &problem);
  EXPECT_EQ(rankOnWalls(problem, 2), 2);
}

TEST_P(RoomTest, APolygonOfFiveWallsKeepsSeven) {
  EXPECT_EQ(rankOnWalls(room({0.1, 1.2, 2.9, 3.9, 5.1}), 5), 10 - 3);
}

// What a factor on the centre alone is worth: the room goes where it says, and nothing is said.
TEST_P(RoomTest, TheCentreAloneSaysNothingOnTheWalls) {
  DenseProblem problem = room(kRectangle_, false);
  addCentre(0, 1, &problem);
  addCentre(2, 3, &problem);
  const Eigen::MatrixXd H = problem.linearize().H;
  EXPECT_GT(H.norm(), kWeight);
  EXPECT_NEAR(onWalls(problem, 4).norm(), 0.0, 1e-9 * H.norm());
}

TEST_P(RoomTest, WallsAndFloorPlaceARoomOfFourWalls) {
  DenseProblem problem = room(kRectangle_);
  EXPECT_EQ(rankOnRoom(problem), 3);
  addCentre(0, 1, &problem);
  addCentre(2, 3, &problem);
  EXPECT_EQ(rankOnRoom(problem), 5);
  problem.values[kFloor] = T_map_room_ * Plane{};
  problem.factors.push_back(
      std::make_shared<FloorRoomFactor>(kFloor, kRoom, kWeight * Eigen::Matrix3d::Identity()));
  EXPECT_EQ(rankOnRoom(problem), 6);
}

TEST_P(RoomTest, AKeyframeHoldsACorridorWhereItsWallsDoNotAndSaysNothingOnThem) {
  DenseProblem problem = room(kCorridor_);
  addCentre(0, 1, &problem);
  EXPECT_EQ(rankOnRoom(problem), 3);
  const Eigen::MatrixXd without = onWalls(problem, 2);

  const Pose T_room_keyframe = random_.smallPose(3.0, 1.0);
  problem.values[kKeyframe] = T_map_room_ * T_room_keyframe;
  Tangent open;  // along the corridor, up, and turning about the walls' normal
  open << 1.0, 0.0, 1.0, 0.0, 1.0, 0.0;
  problem.factors.push_back(std::make_shared<RelativePoseFactor>(
      kKeyframe, kRoom, T_room_keyframe.inverse(), kWeight * Matrix6(open.asDiagonal()),
      RelativePoseFactor::Kind::kRoom));
  EXPECT_EQ(rankOnRoom(problem), 6);
  EXPECT_NEAR((onWalls(problem, 2) - without).norm(), 0.0, 1e-9 * without.norm());
}

/// A rectangle whose last wall is turned, each wall measured to 0.5 deg.
class SkewedRoomTest : public RoomTest {
 protected:
  /// The angle between the normals of the last two walls [rad], before and after.
  std::pair<double, double> angleOfLastWall(double turn_rad, const RobustKernel& kernel) {
    std::vector<double> angles_rad = kRectangle_;
    DenseProblem problem = room(angles_rad, false);
    addCentre(0, 1, &problem);
    addCentre(2, 3, &problem);
    problem.values[wall(3)] =
        T_map_room_ * Plane{expSO3({0.0, 0.0, turn_rad - M_PI_2}).col(0), -2.0};
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector3d axis_room = expSO3({0.0, 0.0, angles_rad[k]}).col(0);
      problem.factors.push_back(std::make_shared<RoomWallFactor>(
          kRoom, wall(k), axis_room, 1.0 / square(0.01) * Eigen::Matrix2d::Identity(), kernel));
      problem.factors.push_back(std::make_shared<PlanePriorFactor>(
          wall(k), T_map_room_, inverseTimes(T_map_room_, at(problem, k)),
          1.0 / square(0.5 * M_PI / 180.0) * Eigen::Matrix3d::Identity()));
    }
    problem.factors.push_back(
        std::make_shared<FloorRoomFactor>(kFloor, kRoom, 1e4 * Eigen::Matrix3d::Identity()));
    problem.values[kFloor] = T_map_room_ * Plane{};
    problem.factors.push_back(std::make_shared<PlanePriorFactor>(
        kFloor, T_map_room_, Plane{}, 1e4 * Eigen::Matrix3d::Identity()));
    const double before = std::acos(-at(problem, 2).normal.dot(at(problem, 3).normal));
    problem.minimize();
    return {before, std::acos(-at(problem, 2).normal.dot(at(problem, 3).normal))};
  }

  static double square(double x) { return x * x; }
  static const Plane& at(const DenseProblem& problem, std::size_t k) {
    return std::get<Plane>(problem.values.at(wall(k)));
  }
};
INSTANTIATE_TEST_SUITE_P(Extents, SkewedRoomTest, ::testing::Values(1.0, 500.0));

TEST_P(SkewedRoomTest, WallsThatAreNearlyParallelBecomeMoreSo) {
  const auto [before, after] = angleOfLastWall(0.02, {RobustKernel::Kind::kCauchy, 9.0});
  EXPECT_NEAR(before, 0.02, 1e-6);
  EXPECT_LT(after, 0.016);
}

TEST_P(SkewedRoomTest, AWallThatIsNotIsNotBent) {
  const auto [before, after] = angleOfLastWall(0.3, {RobustKernel::Kind::kCauchy, 9.0});
  EXPECT_NEAR(after, before, 0.01);
  EXPECT_LT(angleOfLastWall(0.3, {}).second, before - 0.05) << "without a kernel it is";
}

}  // namespace
}  // namespace mrpt_sgraphs
