// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "mrpt_sgraphs/frontend/ground_layer.h"
#include "mrpt_sgraphs/geometry/plane_covariance.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kSensorHeight_m = 0.6;

/// A level surface at a height of the world, as seen from a pose.
ObservedPlane levelPlane(const Pose& T_world_base, double height_m, double side_m,
                         double tilt_rad = 0.0, double sigma_m = 0.01, double noise = 0.0) {
  ObservedPlane plane;
  const Eigen::Vector3d middle(T_world_base.translation().x(), T_world_base.translation().y(),
                               height_m);
  const Eigen::Vector3d up(std::sin(tilt_rad), 0.0, std::cos(tilt_rad));
  const Pose T_base_world = T_world_base.inverse();
  plane.plane_base = T_base_world * Plane{up, up.dot(middle) + noise};
  plane.centroid_base = T_base_world * middle;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    plane.extent_base.outline.push_back(T_base_world *
                                        (middle + 0.5 * side_m * Eigen::Vector3d(x, y, 0.0)));
  }
  plane.area_m2 = side_m * side_m;
  const Eigen::Matrix3d J = tangentFromPoint(plane.plane_base, plane.centroid_base);
  plane.covariance =
      J * Eigen::Vector3d(1.6e-5, 1.6e-5, sigma_m * sigma_m).asDiagonal() * J.transpose();
  return plane;
}

class GroundLayerTest : public ::testing::Test {
 protected:
  /// A keyframe a metre along x from the last, at a height above the world's zero.
  void step(double height_m, const std::vector<ObservedPlane>& planes_at_origin,
            const Pose& slip = Pose::Identity()) {
    stepTo(at(height_m), planes_at_origin, slip);
  }

  void stepTo(const Pose& T_world_base, const std::vector<ObservedPlane>& planes_at_origin,
              const Pose& slip = Pose::Identity()) {
    KeyframeAttributes attributes;
    attributes.stamp_s = static_cast<double>(truth_.size());
    auto planes = std::make_shared<ObservedPlanes>(planes_at_origin);
    attributes.planes = planes;
    if (truth_.empty()) {
      attributes.T_odom_base = T_world_base;
      graph_.addKeyframe(T_world_base, attributes);
    } else {
      const KeyframeId last{truth_.size() - 1};
      const Pose T_last_new = truth_.back().inverse() * T_world_base * slip;
      attributes.T_odom_base = graph_.attributes(last).T_odom_base * T_last_new;
      const KeyframeId id = graph_.addKeyframe(graph_.pose(last) * T_last_new, attributes);
      Tangent sigma;
      sigma << 0.01, 0.01, 0.01, 0.002, 0.002, 0.002;
      const Matrix6 information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
      graph_.addFactor(std::make_shared<RelativePoseFactor>(last, id, T_last_new, information,
                                                            RelativePoseFactor::Kind::kOdometry));
    }
    truth_.push_back(T_world_base);
    way_.update(graph_);
    changed_ = layer_.associate(way_, &graph_);
    if (changed_) {
      optimizeSelection(selectAll(graph_), OptimizerConfig(), &optimizer_, &graph_);
    }
  }

  Pose at(double height_m) const {
    Pose T = Pose::Identity();
    T.translation() << static_cast<double>(truth_.size()), 0.0, height_m;
    return T;
  }

  void walkOn(double ground_m, int steps, const Pose& slip = Pose::Identity()) {
    for (int k = 0; k < steps; ++k) {
      const double height_m = ground_m + kSensorHeight_m;
      step(height_m, {levelPlane(at(height_m), ground_m, 6.0)}, slip);
    }
  }

  std::optional<FloorId> floorOf(std::size_t keyframe) const {
    return graph_.attributes(KeyframeId{keyframe}).floor;
  }

  LayeredGraph graph_;
  GroundLayer layer_{GroundLayerConfig()};
  WayToNewest way_;
  Optimizer optimizer_;
  std::vector<Pose> truth_;
  bool changed_ = false;
};

TEST_F(GroundLayerTest, ALevelHasToBeSeenOftenEnoughAndThenHoldsAllItsKeyframes) {
  walkOn(0.0, 4);
  EXPECT_EQ(graph_.size(Layer::kFloor), 0U);
  EXPECT_FALSE(changed_);
  walkOn(0.0, 1);
  ASSERT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_TRUE(changed_);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(floorOf(k), FloorId{0});
  EXPECT_EQ(graph_.sightingsOf(FloorId{0}).size(), 5U);
  EXPECT_NEAR(graph_.attributes(FloorId{0}).centre_map.z(), 0.0, 0.01);
}

TEST_F(GroundLayerTest, HoldsHeightRollAndPitch) {
  const Pose slip = expPose((Tangent() << 0.0, 0.0, 0.004, 0.0005, 0.001, 0.0).finished());
  walkOn(0.0, 60, slip);
  ASSERT_EQ(graph_.size(Layer::kFloor), 1U);
  const Pose T_map_base = graph_.pose(KeyframeId{59});
  EXPECT_GT(
      std::abs(graph_.attributes(KeyframeId{59}).T_odom_base.translation().z() - kSensorHeight_m),
      0.2);
  const Plane ground_map = graph_.plane(FloorId{0});
  EXPECT_NEAR(inverseTimes(T_map_base, ground_map).distance, -kSensorHeight_m, 0.005);
  EXPECT_GT(T_map_base.linear().col(2).dot(ground_map.normal), std::cos(0.002));
  EXPECT_GT(ground_map.normal.z(), std::cos(0.002)) << "the first keyframe stays";
}

TEST_F(GroundLayerTest, StairsLeadToAnotherLevelAndAreNone) {
  walkOn(0.0, 8);
  for (int k = 1; k <= 8; ++k) {  // treads only
    const double height_m = kSensorHeight_m + 0.35 * k;
    step(height_m, {levelPlane(at(height_m), 0.35 * k, 0.5)});
  }
  walkOn(2.8, 8);
  ASSERT_EQ(graph_.size(Layer::kFloor), 2U);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(floorOf(k), FloorId{0});
  for (std::size_t k = 8; k < 16; ++k) EXPECT_FALSE(floorOf(k));
  for (std::size_t k = 16; k < 24; ++k) EXPECT_EQ(floorOf(k), FloorId{1});
  EXPECT_NEAR(graph_.plane(FloorId{1}).distance, 2.8, 0.05);
  for (int k = 1; k <= 8; ++k) {
    const double height_m = kSensorHeight_m + 2.8 - 0.35 * k;
    step(height_m, {levelPlane(at(height_m), 2.8 - 0.35 * k, 0.5)});
  }
  walkOn(0.0, 6);
  EXPECT_EQ(graph_.size(Layer::kFloor), 2U) << "back on the first";
  EXPECT_EQ(floorOf(37), FloorId{0});
}

TEST_F(GroundLayerTest, ARampIsNoLevel) {
  walkOn(0.0, 6);
  for (int k = 1; k <= 8; ++k) {
    const double ground_m = 0.1 * k;
    step(ground_m + kSensorHeight_m,
         {levelPlane(at(ground_m + kSensorHeight_m), ground_m, 4.0, -0.1)});
    EXPECT_FALSE(changed_);
  }
  walkOn(0.8, 6);
  EXPECT_EQ(graph_.size(Layer::kFloor), 2U);
}

TEST_F(GroundLayerTest, ATableIsNotTheGround) {
  for (int k = 0; k < 6; ++k) {
    step(1.0, {levelPlane(at(1.0), 0.75, 2.0), levelPlane(at(1.0), 0.0, 6.0)});
  }
  ASSERT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_NEAR(graph_.plane(FloorId{0}).distance, 0.0, 0.01);
  const std::size_t sightings = graph_.sightingsOf(FloorId{0}).size();
  for (int k = 0; k < 6; ++k) step(1.0, {levelPlane(at(1.0), 0.75, 2.0)});
  EXPECT_EQ(graph_.sightingsOf(FloorId{0}).size(), sightings);
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
}

/// From the stairs the floor below is seen whole: it is not what the robot stands on.
TEST_F(GroundLayerTest, TheFloorBelowTheStairsIsNotStoodOn) {
  walkOn(0.0, 8);
  for (int k = 1; k <= 14; ++k) {
    const double height_m = kSensorHeight_m + 0.2 * k;
    step(height_m, {levelPlane(at(height_m), 0.0, 6.0)});
  }
  walkOn(2.8, 8);
  EXPECT_EQ(graph_.size(Layer::kFloor), 2U);
  EXPECT_FALSE(floorOf(12));
  EXPECT_EQ(floorOf(29), FloorId{1});
}

/// However long the robot stands on a landing.
TEST_F(GroundLayerTest, ALandingIsNoLevel) {
  walkOn(0.0, 8);
  for (int k = 1; k <= 4; ++k) step(kSensorHeight_m + 0.35 * k, {});
  Pose landing = at(kSensorHeight_m + 1.4);
  for (int k = 0; k < 8; ++k) {
    const std::size_t steps = truth_.size();
    landing.translation().x() += 0.2;
    stepTo(landing, {levelPlane(landing, 1.4, 2.4)});
    EXPECT_FALSE(floorOf(steps));
  }
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
}

TEST_F(GroundLayerTest, TwoLevelsThatAreOneBecomeTheOlder) {
  walkOn(0.0, 6);
  for (int k = 0; k < 6; ++k) step(kSensorHeight_m, {}, Pose(Eigen::Translation3d(0.0, 0.0, 0.05)));
  walkOn(0.0, 6);
  ASSERT_EQ(graph_.size(Layer::kFloor), 2U) << "more than the odometry's covariance says";
  ASSERT_TRUE(layer_.merge(FloorId{0}, FloorId{1}, &graph_));
  ASSERT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_FALSE(graph_.contains(FloorId{1}));
  EXPECT_EQ(graph_.sightingsOf(FloorId{0}).size(), 12U);
  for (std::size_t k = 12; k < 18; ++k) EXPECT_EQ(floorOf(k), FloorId{0});
  optimizeSelection(selectAll(graph_), OptimizerConfig(), &optimizer_, &graph_);
  EXPECT_NEAR(graph_.pose(KeyframeId{17}).translation().z(), kSensorHeight_m, 0.03);
  walkOn(0.0, 3);
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_EQ(floorOf(20), FloorId{0});
  EXPECT_FALSE(layer_.merge(FloorId{0}, FloorId{1}, &graph_)) << "it is gone";
  EXPECT_FALSE(layer_.merge(FloorId{0}, FloorId{0}, &graph_));
}

/// Two levels, the planes of whose keyframes are gone: what they measured is in their factors.
TEST_F(GroundLayerTest, LevelsWithoutPlanesAreMergedAndFoundAgain) {
  walkOn(0.0, 6);
  for (int k = 0; k < 6; ++k) step(kSensorHeight_m, {}, Pose(Eigen::Translation3d(0.0, 0.0, 0.05)));
  walkOn(0.0, 6);
  ASSERT_EQ(graph_.size(Layer::kFloor), 2U);
  std::vector<KeyframeId> all;
  std::vector<std::weak_ptr<const ObservedPlanes>> planes;
  for (std::size_t k = 0; k < truth_.size(); ++k) {
    all.push_back(KeyframeId{k});
    KeyframeAttributes attributes = graph_.attributes(all.back());
    planes.push_back(attributes.planes);
    attributes.planes.reset();
    graph_.setAttributes(all.back(), attributes);
  }
  layer_.letPlanesGo(all);
  graph_.snapshot();  // the one before held them, too
  for (const auto& gone : planes) EXPECT_TRUE(gone.expired());
  ASSERT_TRUE(layer_.merge(FloorId{0}, FloorId{1}, &graph_));
  EXPECT_EQ(graph_.sightingsOf(FloorId{0}).size(), 12U);
  optimizeSelection(selectAll(graph_), OptimizerConfig(), &optimizer_, &graph_);
  EXPECT_NEAR(graph_.pose(KeyframeId{17}).translation().z(), kSensorHeight_m, 0.03);
  walkOn(0.0, 3);
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_EQ(floorOf(20), FloorId{0});
}

/// A map that was begun tilted.
TEST_F(GroundLayerTest, ATiltedStartHasItsLevelToo) {
  constexpr double kTilt_rad = 0.08;
  for (int k = 0; k < 8; ++k) {
    const double ground_m = -std::tan(kTilt_rad) * k;
    const double height_m = ground_m + kSensorHeight_m;
    step(height_m, {levelPlane(at(height_m), ground_m, 6.0, kTilt_rad)});
  }
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
}

/// The height drifts by 0.3 m and more on the way round through the other storey.
TEST_F(GroundLayerTest, DriftIsNoNewLevel) {
  walkOn(0.0, 10);
  for (int k = 0; k < 60; ++k) {  // the ground is out of sight
    step(kSensorHeight_m, {}, Pose(Eigen::Translation3d(0.0, 0.0, 0.003)));
  }
  EXPECT_GT(graph_.pose(KeyframeId{69}).translation().z(), kSensorHeight_m + 0.15);
  walkOn(0.0, 6);
  EXPECT_EQ(graph_.size(Layer::kFloor), 1U);
  EXPECT_NEAR(graph_.pose(KeyframeId{75}).translation().z(), kSensorHeight_m, 0.03);
}

}  // namespace
}  // namespace mrpt_sgraphs
