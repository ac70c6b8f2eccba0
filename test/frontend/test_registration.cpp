// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/frontend/registration.h"

#include <gtest/gtest.h>

#include "mrpt_sgraphs/frontend/thinning.h"
#include "support/random_geometry.h"
#include "support/simulated_scans.h"

namespace mrpt_sgraphs {
namespace {

Pose poseOf(const Eigen::Vector3d& t, const Eigen::Vector3d& theta) {
  Tangent delta;
  delta << t, theta;
  return expPose(delta);
}

/// Walls of buildings lie on round numbers, and so on the borders of cells: the map has them
/// elsewhere.
const Pose kMapBuilding = poseOf({0.13, 0.21, 0.17}, {0.02, -0.03, 0.4});

std::vector<ScanPoint> pointsOf(const Cloud& cloud, bool with_times) {
  constexpr double kVoxel_m = 0.15;
  std::vector<ScanPoint> points;
  for (const int i : firstInVoxels(cloud, kVoxel_m)) {
    const Point& point = cloud[static_cast<std::size_t>(i)];
    points.push_back({point.getVector3fMap().cast<double>(), with_times ? point.time : 0.0});
  }
  return points;
}

/// Standard deviations of what is believed before.
struct Belief {
  double position_m = 1.0;
  double heading_rad = 0.5;
  double velocity = 1e-3;  ///< [m/s and rad/s]
};

MotionPrior priorAt(const Pose& T_map_base, const Belief& belief = {}) {
  MotionPrior prior;
  prior.mean.T_map_base = T_map_base;
  const auto set = [&](int at, double sigma) {
    prior.information.block<3, 3>(at, at) = Eigen::Matrix3d::Identity() / (sigma * sigma);
  };
  set(0, belief.position_m);
  set(3, belief.heading_rad);
  set(6, belief.velocity);
  set(9, belief.velocity);
  return prior;
}

/// A room of 5 x 4 m that has been mapped at known poses.
class RegistrationInARoom : public ::testing::TestWithParam<double> {
 protected:
  RegistrationInARoom()
      : stage_(sim::test::buildingFrom(sim::test::kTwoRooms),
               test::lidarWithNoise("os1_64", GetParam())) {
    for (int k = 0; k < 4; ++k) {
      mapped_.push_back(scan({{1.7 + 0.3 * k, 1.6 + 0.2 * k}, 0.5 * k}, 1 + k));
    }
  }

  test::PlacedScan scan(const test::SteadyMotion& motion, int seed) const {
    test::PlacedScan scan = stage_.scan(motion, static_cast<std::uint64_t>(seed));
    scan.T_map_base = kMapBuilding * scan.T_map_base;
    return scan;
  }

  /// The map, moved.
  VoxelMap map(const Pose& T_other_map = Pose::Identity()) const {
    VoxelMap map(VoxelMapConfig{});
    for (const test::PlacedScan& scan : mapped_) {
      const Pose T_other_base = T_other_map * scan.T_map_base;
      for (const Point& point : *scan.cloud) {
        map.insert(T_other_base * point.getVector3fMap().cast<double>(),
                   T_other_base * stage_.T_base_lidar().translation());
      }
    }
    map.refit();
    return map;
  }

  RegistrationResult place(const std::vector<ScanPoint>& points, const VoxelMap& map,
                           const MotionPrior& prior) const {
    return registerScan(points, map, prior, {prior.mean}, stage_.T_base_lidar().translation(), {});
  }

  test::SteadyMotion somewhere() {
    return {{2.1 + random_.number(0.3), 1.9 + random_.number(0.3)}, random_.number(3.0)};
  }

  test::ScanStage stage_;
  std::vector<test::PlacedScan> mapped_;
  test::RandomGeometry random_{1};
};

INSTANTIATE_TEST_SUITE_P(RangeNoise, RegistrationInARoom, ::testing::Values(0.0, 0.012));

TEST_P(RegistrationInARoom, FindsWhereTheScanWasTaken) {
  const double tolerance_m = 5e-4 + 0.3 * GetParam();
  const double tolerance_rad = 3e-4 + 0.3 * GetParam();
  const VoxelMap map = this->map();
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const test::PlacedScan scan = this->scan(somewhere(), 100 + trial);
    const Pose guess = scan.T_map_base * random_.smallPose(0.1, 0.05);
    const RegistrationResult fit = place(pointsOf(*scan.cloud, false), map, priorAt(guess));
    EXPECT_TRUE(fit.converged);
    EXPECT_EQ(fit.degenerate_directions, 0);
    EXPECT_GT(fit.inlier_ratio, 0.6);
    EXPECT_LT(fit.rms_m, 0.025);
    const Tangent error = local(scan.T_map_base, fit.estimate.T_map_base);
    EXPECT_LT(error.head<3>().norm(), tolerance_m);
    EXPECT_LT(error.tail<3>().norm(), tolerance_rad);
    EXPECT_LT(fit.estimate.velocity_base.norm(), 0.01) << "the prior says that it stands";
  }
}

TEST_P(RegistrationInARoom, FindsItFromFartherOffWhenItBeginsCoarsely) {
  const VoxelMap map = this->map();
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const test::PlacedScan scan = this->scan(somewhere(), 100 + trial);
    const MotionPrior prior = priorAt(scan.T_map_base * random_.smallPose(0.3, 0.12));
    const RegistrationResult fit =
        registerScan(pointsOf(*scan.cloud, false), map, prior, {prior.mean, VoxelMap::kLevels - 1},
                     stage_.T_base_lidar().translation(), {});
    EXPECT_TRUE(fit.converged);
    EXPECT_LT(local(scan.T_map_base, fit.estimate.T_map_base).head<3>().norm(), 0.01);
  }
}

TEST_P(RegistrationInARoom, MovesWithTheMap) {
  const test::PlacedScan scan = this->scan(somewhere(), 100);
  const std::vector<ScanPoint> points = pointsOf(*scan.cloud, false);
  const Pose guess = scan.T_map_base * random_.smallPose(0.05, 0.03);
  const Pose T_map_base = place(points, map(), priorAt(guess)).estimate.T_map_base;

  const auto differenceIn = [&](const Pose& T_other_map) {
    const RegistrationResult fit = place(points, map(T_other_map), priorAt(T_other_map * guess));
    EXPECT_TRUE(fit.converged);
    return local(T_other_map * T_map_base, fit.estimate.T_map_base).norm();
  };
  // by whole cells of all levels, and quarter turns: cell by cell the same
  const double cells_m = 9.0 * VoxelMapConfig{}.voxel_size_m;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Pose T_other_map =
        poseOf(cells_m * Eigen::Vector3d(2 * quarter - 3, 5 - quarter, quarter - 1),
               {0.0, 0.0, 0.5 * M_PI * quarter});
    EXPECT_LT(differenceIn(T_other_map), 1e-6) << quarter;
  }
  // anywhere: cells cut the same surfaces elsewhere
  for (int trial = 0; trial < 4; ++trial) {
    const Pose T_other_map = poseOf(random_.vector(50.0), {0.0, 0.0, random_.number(3.0)}) *
                             random_.smallPose(0.0, 0.1);
    EXPECT_LT(differenceIn(T_other_map), 1e-3 + 0.3 * GetParam()) << trial;
  }
}

TEST_P(RegistrationInARoom, FindsAConstantVelocityFromThePoints) {
  const VoxelMap map = this->map();
  // a sweep shows velocity some forty times worse than place
  const double tolerance_m_s = 0.03 + 15.0 * GetParam();
  const double tolerance_rad_s = 0.02 + 8.0 * GetParam();
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    test::SteadyMotion motion = somewhere();
    motion.velocity_map << random_.number(1.0), random_.number(1.0);
    motion.turning_rad_s = random_.number(1.0);
    const test::PlacedScan scan = this->scan(motion, 200 + trial);
    const Pose guess = scan.T_map_base * random_.smallPose(0.05, 0.03);
    const RegistrationResult fit =
        place(pointsOf(*scan.cloud, true), map, priorAt(guess, {1.0, 0.5, 1.0}));
    EXPECT_TRUE(fit.converged);

    const Eigen::Vector3d velocity_building(motion.velocity_map.x(), motion.velocity_map.y(), 0.0);
    const Eigen::Matrix3d R_base_building =
        scan.T_map_base.linear().transpose() * kMapBuilding.linear();
    const Eigen::Vector3d turning_base(0.0, 0.0, motion.turning_rad_s);
    EXPECT_LT((fit.estimate.velocity_base.head<3>() - R_base_building * velocity_building).norm(),
              tolerance_m_s);
    EXPECT_LT((fit.estimate.velocity_base.tail<3>() - turning_base).norm(), tolerance_rad_s);
    const Tangent error = local(scan.T_map_base, fit.estimate.T_map_base);
    EXPECT_LT(error.head<3>().norm(), 0.003 + GetParam());
  }
}

TEST_P(RegistrationInARoom, SaysSoWhenThereIsNothingToGoBy) {
  const test::PlacedScan scan = this->scan(somewhere(), 100);
  const std::vector<ScanPoint> points = pointsOf(*scan.cloud, false);
  const auto expectPrior = [&](const std::vector<ScanPoint>& some, const VoxelMap& map) {
    const RegistrationResult fit = place(some, map, priorAt(scan.T_map_base));
    EXPECT_FALSE(fit.converged);
    EXPECT_TRUE(fit.estimate.T_map_base.isApprox(scan.T_map_base, 1e-12));
    EXPECT_TRUE(fit.estimate.velocity_base.isZero(0.0));
    EXPECT_LT(fit.matched, 30);
    EXPECT_TRUE(std::isfinite(fit.inlier_ratio) && std::isfinite(fit.rms_m));
  };
  expectPrior(points, VoxelMap(VoxelMapConfig{}));
  expectPrior({}, map());
  expectPrior({points.begin(), points.begin() + 20}, map());
  std::vector<ScanPoint> elsewhere = points;
  for (ScanPoint& point : elsewhere) point.position.x() += 500.0;
  expectPrior(elsewhere, map());
}

/// Rectangles without noise and without the edges between them.
class PlanarWorld {
 public:
  /// @param u, v  From its middle to the middles of its sides.
  void add(const Eigen::Vector3d& middle, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    constexpr double kStep_m = 0.05;
    const int a_max = static_cast<int>(u.norm() / kStep_m);
    const int b_max = static_cast<int>(v.norm() / kStep_m);
    for (int a = -a_max; a <= a_max; ++a) {
      for (int b = -b_max; b <= b_max; ++b) {
        const Eigen::Vector3d p =
            middle + kStep_m * (a * u.normalized() + b * v.normalized());
        map_points_.push_back(p);
        if ((7 * a + 3 * b) % 20 == 0 && p.norm() < 7.0) points_.push_back({p, 0.0});
      }
    }
  }

  /// Seen from the origin.
  VoxelMap map(const Pose& T_map_world) const {
    VoxelMap map(VoxelMapConfig{});
    for (const Eigen::Vector3d& p : map_points_) {
      map.insert(T_map_world * p, T_map_world.translation());
    }
    map.refit();
    return map;
  }
  const std::vector<ScanPoint>& points() const { return points_; }

 private:
  std::vector<Eigen::Vector3d> map_points_;
  std::vector<ScanPoint> points_;
};

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

/// Along x, three metres wide and high.
PlanarWorld corridor() {
  PlanarWorld world;
  for (const double side : {-1.5, 1.5}) {
    world.add(side * kY, 12.0 * kX, 1.2 * kZ);
    world.add(side * kZ, 12.0 * kX, 1.2 * kY);
  }
  return world;
}

TEST(Registration, ACorridorWithoutEndsIsOpenInOneDirectionAndStaysAtThePriorThere) {
  const PlanarWorld world = corridor();
  test::RandomGeometry random(3);
  for (int trial = 0; trial < 5; ++trial) {
    SCOPED_TRACE(trial);
    const Pose T_map_world = poseOf(random.vector(20.0), {0.0, 0.0, random.number(3.0)});
    const Pose T_world_guess = poseOf({0.2, 0.05, -0.04}, {0.02, -0.01, 0.03});
    const MotionPrior prior = priorAt(T_map_world * T_world_guess);
    const RegistrationResult fit = registerScan(world.points(), world.map(T_map_world), prior,
                                                {prior.mean}, Eigen::Vector3d::Zero(), {});
    EXPECT_TRUE(fit.converged);
    EXPECT_EQ(fit.degenerate_directions, 1);
    const Pose T_world_base = T_map_world.inverse() * fit.estimate.T_map_base;
    EXPECT_NEAR(T_world_base.translation().x(), 0.2, 0.01);
    EXPECT_NEAR(T_world_base.translation().y(), 0.0, 1e-4);
    EXPECT_NEAR(T_world_base.translation().z(), 0.0, 1e-4);
    EXPECT_LT(logSO3(T_world_base.linear()).norm(), 1e-4);
  }
}

TEST(Registration, OpenDirectionsAreThoseThatNoPlaneHolds) {
  const auto openDirections = [](const PlanarWorld& world) {
    const Pose T_map_world = poseOf({0.1, 0.2, 0.3}, {0.0, 0.0, 0.0});
    const MotionPrior prior = priorAt(T_map_world);
    return registerScan(world.points(), world.map(T_map_world), prior, {prior.mean},
                        Eigen::Vector3d::Zero(), {})
        .degenerate_directions;
  };
  PlanarWorld ground;
  ground.add(-1.5 * kZ, 8.0 * kX, 8.0 * kY);
  EXPECT_EQ(openDirections(ground), 3);  // two of place, and the heading
  PlanarWorld with_wall = ground;
  with_wall.add(2.0 * kY, 8.0 * kX, 1.2 * kZ);
  EXPECT_EQ(openDirections(with_wall), 1);
  PlanarWorld with_corner = with_wall;
  with_corner.add(3.0 * kX, 1.2 * kY, 1.2 * kZ);
  EXPECT_EQ(openDirections(with_corner), 0);
}

TEST(Registration, MovesPointsAsTheRobotMoved) {
  test::RandomGeometry random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const ScanPoint point{random.vector(20.0), random.number(0.2)};
    Tangent velocity;
    velocity << random.vector(3.0), random.vector(trial % 2 == 0 ? 2.0 : 8.0);
    const Eigen::Vector3d expected =
        expSO3(point.time_s * velocity.tail<3>()) * point.position +
        point.time_s * velocity.head<3>();
    EXPECT_LT((pointAtStamp(point, velocity) - expected).norm(), 20.0 * 1e-6);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
