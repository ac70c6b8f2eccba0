// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mrpt_sgraphs/graph/layered_graph.h"
#include "mrpt_sgraphs/io/floor_error.h"
#include "random_walk.h"

namespace mrpt_sgraphs {
namespace {

using Ids = std::vector<uint64_t>;

constexpr double kUpper_m = 3.3;
constexpr double kBodyHeight_m = 0.45;

/// Along x: 10 m on the ground, stairs from x = 10 to 16 and 10 m on the storey above; a pose every
/// 0.1 m and 0.1 s.
class FloorErrorTest : public ::testing::Test {
 protected:
  FloorErrorTest() {
    truth_.floors = {{7, kUpper_m}, {4, 0.0}};
    TrueRoom stairs;
    stairs.kind = TrueRoom::Kind::kStairwell;
    stairs.extent.outline = {
        {9.5, -1.0, 0.0}, {16.5, -1.0, 0.0}, {16.5, 1.0, 0.0}, {9.5, 1.0, 0.0}};
    truth_.rooms = {stairs};
    for (int k = 0; k < 260; ++k) {
      StampedPose pose;
      pose.stamp_s = 100.0 + 0.1 * k;
      const double x = 0.1 * k;
      const double climbed = std::min(std::max((x - 10.0) / 6.0, 0.0), 1.0);
      pose.T_world_body.translation() = Eigen::Vector3d(x, 0.0, climbed * kUpper_m + kBodyHeight_m);
      trajectory_.push_back(pose);
    }
  }

  FloorId addFloor(double height_m, double x, double tilt_rad = 0.0) {
    FloorAttributes attributes;
    attributes.centre_map = T_map_truth_ * Eigen::Vector3d(x, 0.0, height_m);
    const Eigen::Vector3d normal(std::sin(tilt_rad), 0.0, std::cos(tilt_rad));
    const Plane ground{normal, normal.dot(Eigen::Vector3d(x, 0.0, height_m))};
    return graph_.addFloor(T_map_truth_ * ground, attributes);
  }

  KeyframeId addKeyframe(std::size_t pose, std::optional<FloorId> floor) {
    KeyframeAttributes attributes;
    attributes.stamp_s = trajectory_[pose].stamp_s + 0.002;
    attributes.floor = floor;
    return graph_.addKeyframe(T_map_truth_ * trajectory_[pose].T_world_body, attributes);
  }

  /// The run's heights are `error_m(x)` off.
  template <typename Error>
  FloorErrors evaluate(const Error& error_m) const {
    std::vector<PosePair> poses;
    for (const StampedPose& pose : trajectory_) {
      Pose T_truth_run = pose.T_world_body;
      T_truth_run.translation().z() += error_m(pose.T_world_body.translation().x());
      poses.push_back({pose.T_world_body, T_map_truth_ * T_truth_run});
    }
    return evaluateFloors(truth_, trajectory_, *graph_.snapshot(), poses, T_map_truth_.inverse(),
                          0.01);
  }
  FloorErrors evaluate() const {
    return evaluate([](double) { return 0.0; });
  }

  TrueBuilding truth_;
  Trajectory trajectory_;
  Pose T_map_truth_ = test::someMotion();
  LayeredGraph graph_;
};

TEST_F(FloorErrorTest, OfThatWhichIsThereThereAreNone) {
  const FloorId ground = addFloor(0.0, 5.0);
  const FloorId upper = addFloor(kUpper_m, 20.0);
  addKeyframe(20, ground);
  addKeyframe(130, std::nullopt);
  addKeyframe(200, upper);
  const FloorErrors errors = evaluate();
  ASSERT_EQ(errors.levels.size(), 2u);
  EXPECT_TRUE(errors.exact());
  EXPECT_EQ(errors.levels[0].id, 4u);
  EXPECT_EQ(errors.levels[0].found, ground.value);
  EXPECT_EQ(errors.levels[1].id, 7u);
  EXPECT_EQ(errors.levels[1].found, upper.value);
  for (const FloorErrors::Level& level : errors.levels) {
    EXPECT_GE(level.poses, 100u);
    EXPECT_LE(level.poses, 106u);  // and the first step
    EXPECT_NEAR(level.height_error_m, 0.0, 1e-9);
    EXPECT_NEAR(level.tilt_deg, 0.0, 1e-6);
    EXPECT_NEAR(level.z_rmse_m, 0.0, 1e-9);
  }
  EXPECT_NEAR(errors.between_error_m, 0.0, 1e-9);
  EXPECT_EQ(errors.keyframes, 3u);
  EXPECT_TRUE(errors.wrong_keyframes.empty());
}

TEST_F(FloorErrorTest, HeightsAndTiltsAreTold) {
  addFloor(0.05, 5.0, 0.02);
  addFloor(kUpper_m - 0.02, 20.0);
  const FloorErrors errors =
      evaluate([](double x) { return x < 13.0 ? 0.04 : 0.01 * (x - 20.95); });
  ASSERT_EQ(errors.levels.size(), 2u);
  EXPECT_NEAR(errors.levels[0].height_error_m, 0.05, 1e-9);
  EXPECT_NEAR(errors.levels[0].tilt_deg, 0.02 * 180.0 / M_PI, 1e-6);
  EXPECT_NEAR(errors.between_error_m, 0.07, 1e-9);
  EXPECT_NEAR(errors.levels[0].z_mean_m, 0.04, 1e-9);
  EXPECT_NEAR(errors.levels[0].z_spread_m, 0.0, 1e-9);
  EXPECT_NEAR(errors.levels[0].z_rmse_m, 0.04, 1e-9);
  EXPECT_NEAR(errors.levels[1].z_mean_m, 0.0, 3e-3);
  EXPECT_NEAR(errors.levels[1].z_spread_m, 0.1 / std::sqrt(12.0), 2e-3);  // a ramp of 10 m
}

TEST_F(FloorErrorTest, AFloorTooManyOrTooFarOffIsWrong) {
  addFloor(0.1, 5.0);
  const FloorId nearer = addFloor(-0.02, 8.0);
  const FloorId far = addFloor(kUpper_m - 0.4, 20.0);
  const FloorErrors errors = evaluate();
  EXPECT_FALSE(errors.exact());
  EXPECT_EQ(errors.levels[0].found, nearer.value);
  EXPECT_EQ(errors.levels[1].found, std::nullopt);
  EXPECT_TRUE(std::isnan(errors.levels[1].tilt_deg));
  EXPECT_TRUE(std::isnan(errors.between_error_m));
  EXPECT_EQ(errors.wrong, (Ids{0, far.value}));
}

TEST_F(FloorErrorTest, AStoreyThatIsNotFoundIsNotExact) {
  addFloor(0.0, 5.0);
  EXPECT_FALSE(evaluate().exact());
  trajectory_.resize(100);  // it was not there
  EXPECT_TRUE(evaluate().exact());
}

TEST_F(FloorErrorTest, OnTheUpperStoreyAloneTheBodyIsNotFourMetresHigh) {
  trajectory_.erase(trajectory_.begin(), trajectory_.begin() + 170);
  const FloorId upper = addFloor(kUpper_m, 20.0);
  const FloorErrors errors = evaluate();
  ASSERT_EQ(errors.levels.size(), 1u);
  EXPECT_EQ(errors.levels[0].found, upper.value);
}

TEST_F(FloorErrorTest, KeyframesOnTheWrongFloorAreNamed) {
  const FloorId ground = addFloor(0.0, 5.0);
  const FloorId upper = addFloor(kUpper_m, 20.0);
  const KeyframeId none = addKeyframe(20, std::nullopt);
  const KeyframeId other = addKeyframe(30, upper);
  addKeyframe(98, std::nullopt);  // in the stairwell, before the first step
  addKeyframe(99, ground);
  addKeyframe(105, ground);  // 0.28 m up
  addKeyframe(105, std::nullopt);
  const KeyframeId stairs = addKeyframe(130, ground);
  const FloorErrors errors = evaluate();
  EXPECT_EQ(errors.keyframes, 7u);
  EXPECT_EQ(errors.wrong_keyframes, (Ids{none.value, other.value, stairs.value}));
}

}  // namespace
}  // namespace mrpt_sgraphs
