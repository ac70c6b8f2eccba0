// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/io/surface_residuals.h"

namespace mrpt_sgraphs {
namespace {

/// Two keyframes, a wall and a ground.
class SurfaceResidualsTest : public ::testing::Test {
 protected:
  SurfaceResidualsTest() {
    Pose T_map_base = Pose::Identity();
    T_map_base.translation().x() = 1.0;
    near_ = graph_.addKeyframe(T_map_base, {});
    T_map_base.translation().x() = 3.0;
    far_ = graph_.addKeyframe(T_map_base, {});
    wall_ = graph_.addWall({-Eigen::Vector3d::UnitX(), -5.0}, {});
    ground_ = graph_.addFloor({Eigen::Vector3d::UnitZ(), 0.0}, {});
  }

  /// The surface was measured this many sigmas of distance off.
  template <typename SurfaceId>
  void observe(KeyframeId keyframe, SurfaceId surface, double sigmas,
               const RobustKernel& kernel = {}) {
    constexpr double kSigma_m = 0.02;
    Plane measured_base = inverseTimes(graph_.pose(keyframe), graph_.plane(surface));
    measured_base.distance += sigmas * kSigma_m;
    const Eigen::Matrix3d information =
        Eigen::Vector3d(1e4, 1e4, 1.0 / (kSigma_m * kSigma_m)).asDiagonal();
    graph_.addFactor(std::make_shared<PlaneObservationFactor>(keyframe, surface, measured_base,
                                                              information, kernel));
  }

  LayeredGraph graph_;
  KeyframeId near_, far_;
  WallId wall_;
  FloorId ground_;
};

TEST_F(SurfaceResidualsTest, AreSquaresInSigmasByKindOfSurface) {
  observe(near_, wall_, 1.0);
  observe(far_, wall_, 3.0);
  observe(far_, ground_, -2.0);
  const SurfaceResiduals residuals = surfaceResiduals(graph_);
  EXPECT_EQ(residuals.wall_observation.count, 2u);
  EXPECT_NEAR(residuals.wall_observation.mean_chi2, 5.0, 1e-9);
  EXPECT_NEAR(residuals.wall_observation.above_95, 0.5, 1e-9);
  EXPECT_EQ(residuals.ground_observation.count, 1u);
  EXPECT_NEAR(residuals.ground_observation.mean_chi2, 4.0, 1e-9);
  EXPECT_EQ(residuals.ground_observation.above_95, 0.0);
}

TEST_F(SurfaceResidualsTest, AreNotMadeSmallerByAKernel) {
  observe(near_, wall_, 10.0, {RobustKernel::Kind::kHuber, 7.8});
  EXPECT_NEAR(surfaceResiduals(graph_).wall_observation.mean_chi2, 100.0, 1e-9);
}

TEST_F(SurfaceResidualsTest, OfNoObservationAreNoNumber) {
  const SurfaceResiduals residuals = surfaceResiduals(graph_);
  EXPECT_EQ(residuals.wall_observation.count, 0u);
  EXPECT_TRUE(std::isnan(residuals.wall_observation.mean_chi2));
  EXPECT_TRUE(std::isnan(residuals.ground_observation.above_95));
}

}  // namespace
}  // namespace mrpt_sgraphs
