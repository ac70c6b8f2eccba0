// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "sim/floor_plan.h"
#include "sim/lidar.h"
#include "sim/point_encoding.h"
#include "sim_support.h"

namespace mrpt_sgraphs::sim {
namespace {

constexpr double kFiveSigma = 5.0;

double timeOf(const LidarScan& scan, const LidarReturn& echo) {
  return 1e-9 * static_cast<double>(scan.start_ns + int64_t{echo.offset_ns});
}

/// How far a point is from the surfaces of a building without windows in reach: walls, jambs and
/// furniture by the floor plan, floor, ceiling and lintels by height.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const Building& building)
      : plan_(building, 0), storey_(building.storeys[0]), building_(building) {}

  double operator()(const Eigen::Vector3d& p) const {
    double distance = std::min(std::abs(plan_.clearance(p.head<2>())),
                               std::min(std::abs(p.z() - storey_.elevation_m),
                                        std::abs(p.z() - storey_.elevation_m - storey_.height_m)));
    for (const Door& door : building_.doors) {
      const bool below = (p.head<2>() - door.at).norm() < door.width_m;
      if (below) {
        distance = std::min(distance, std::abs(p.z() - storey_.elevation_m - door.height_m));
      }
    }
    return distance;
  }

 private:
  FloorPlan plan_;
  const Storey& storey_;
  const Building& building_;
};

TEST(Lidar, PointsOfARobotAtRestLieOnSurfaces) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Scene scene(building);
  const SurfaceDistance distance(building);
  const LidarModel model = lidarNamed("vlp16");
  const Trajectory trajectory = test::standingAt({2.0, 1.5, 0.0}, 0.7);
  const Pose T_base_lidar = robotNamed("legged").T_base_lidar(0.05);
  Lidar lidar(model, T_base_lidar, scene, trajectory, 1);
  const LidarScan scan = lidar.scan(0);
  ASSERT_GT(scan.returns.size(), 25000U);
  const Pose T_map_lidar = trajectory.T_map_base(0.0) * T_base_lidar;
  for (const LidarReturn& echo : scan.returns) {
    ASSERT_LT(distance(T_map_lidar * echo.point_lidar.cast<double>()), kFiveSigma * model.noise_m);
  }
}

TEST(Lidar, NoiseAndDropoutsAreAsTheModelSays) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Scene scene(building);
  const LidarModel model = lidarNamed("vlp16");
  const Trajectory trajectory = test::standingAt({7.0, 3.2, 0.0});
  const Pose T_base_lidar = robotNamed("legged").T_base_lidar(0.0);
  Lidar lidar(model, T_base_lidar, scene, trajectory, 3);
  const Pose T_map_lidar = trajectory.T_map_base(0.0) * T_base_lidar;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  double count = 0.0;
  for (int k = 0; k < 3; ++k) {
    for (const LidarReturn& echo : lidar.scan(k).returns) {
      const Eigen::Vector3d beam = echo.point_lidar.cast<double>().normalized();
      const auto hit =
          scene.cast({T_map_lidar.translation(), T_map_lidar.linear() * beam}, 100.0, {});
      ASSERT_TRUE(hit);
      const double error = echo.range_m - hit->range_m;
      if (std::abs(error) > 0.2) continue;  // a float's beam may miss the edge of the door
      sum += error;
      sum_of_squares += error * error;
      count += 1.0;
    }
  }
  const double fired = 3.0 * model.rings * model.columns;
  EXPECT_NEAR(sum / count, 0.0, 4.0 * model.noise_m / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(sum_of_squares / count), model.noise_m, 0.02 * model.noise_m);
  // From here nothing is hit at a grazing angle, and the window is out of sight.
  EXPECT_NEAR(1.0 - count / fired, model.dropout, 0.2 * model.dropout);
}

TEST(Lidar, PointsOfAWalkingRobotLieOnSurfacesWhenMappedAtTheirTimes) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Scene scene(building);
  const SurfaceDistance distance(building);
  const LidarModel model = lidarNamed("vlp16_sparse");
  const Robot robot = robotNamed("legged");
  const Trajectory trajectory = walkTour(building, robot);
  const Pose T_base_lidar = robot.T_base_lidar(0.05);
  Lidar lidar(model, T_base_lidar, scene, trajectory, 1);
  double worst_at_stamp_m = 0.0;
  for (int k = 0; k < static_cast<int>(trajectory.duration_s() * model.rate_hz); ++k) {
    const LidarScan scan = lidar.scan(k);
    const Pose T_map_base_at_stamp = trajectory.T_map_base(1e-9 * double(scan.start_ns));
    for (const LidarReturn& echo : scan.returns) {
      const Eigen::Vector3d p_base = T_base_lidar * echo.point_lidar.cast<double>();
      const Pose T_map_base = trajectory.T_map_base(timeOf(scan, echo));
      ASSERT_LT(distance(T_map_base * p_base), kFiveSigma * model.noise_m);
      worst_at_stamp_m = std::max(worst_at_stamp_m, distance(T_map_base_at_stamp * p_base));
    }
  }
  // Without their times they do not, so the above says something.
  EXPECT_GT(worst_at_stamp_m, 0.15);
}

TEST(Lidar, LosesEchoesAtGrazingAngles) {
  // A long corridor: far along its floor the rays graze.
  const Building building = test::buildingFrom(
      "name: tube\nstoreys:\n  - name: s\n    height_m: 3\n    rooms:\n"
      "      - {name: tube, rectangle: [0, 0, 90, 3]}\ntour: [tube]\n");
  const Scene scene(building);
  const Trajectory trajectory = test::standingAt({1.0, 1.5, 0.0});
  Lidar lidar(lidarNamed("vlp16"), robotNamed("legged").T_base_lidar(0.0), scene, trajectory, 1);
  int grazing = 0;
  for (const LidarReturn& echo : lidar.scan(0).returns) {
    if (echo.ring == 7 && std::abs(echo.point_lidar.x()) > 30.0F) ++grazing;  // 1 degree down
  }
  EXPECT_LT(grazing, 30);  // about 40 columns look far along the corridor; most are lost
}

TEST(Lidar, SameSeedSameScanOtherSeedOtherNoise) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Scene scene(building);
  const Trajectory trajectory = test::standingAt({2.0, 1.5, 0.0});
  const auto scanWith = [&](uint64_t seed) {
    const LidarModel model = lidarNamed("vlp16_sparse");
    Lidar lidar(model, Pose::Identity(), scene, trajectory, seed);
    return encode(lidar.scan(0), model, 0.0).data;
  };
  EXPECT_EQ(scanWith(5), scanWith(5));
  EXPECT_NE(scanWith(5), scanWith(6));
}

/// Every make's cloud, read back by its described fields.
class EncodedScan : public ::testing::TestWithParam<const char*> {};

template <typename T>
T valueAt(const EncodedCloud& cloud, size_t point, const std::string& name) {
  for (const EncodedCloud::Field& field : cloud.fields) {
    if (field.name != name) continue;
    T value;
    std::memcpy(&value, cloud.data.data() + point * cloud.point_step + field.offset, sizeof value);
    return value;
  }
  throw std::logic_error("there is no field " + name);
}

TEST_P(EncodedScan, HasEveryEchoWithItsRingAndTime) {
  const Building building = test::buildingFrom(test::kTwoRooms);
  const Scene scene(building);
  const Trajectory trajectory = test::standingAt({2.0, 1.5, 0.0});
  const LidarModel model = lidarNamed(GetParam());
  Lidar lidar(model, robotNamed("legged").T_base_lidar(0.0), scene, trajectory, 1);
  const LidarScan scan = lidar.scan(4);
  constexpr double kStamp_s = 1.7e9;
  const EncodedCloud cloud = encode(scan, model, kStamp_s);
  ASSERT_EQ(cloud.data.size(), size_t{cloud.height} * cloud.width * cloud.point_step);

  const bool organized = model.encoding == Encoding::kOuster;
  ASSERT_EQ(cloud.height, organized ? static_cast<uint32_t>(model.rings) : 1U);
  for (size_t k = 0; k < scan.returns.size(); ++k) {
    const LidarReturn& echo = scan.returns[k];
    const size_t point = organized ? echo.ring * size_t{cloud.width} + echo.column : k;
    ASSERT_EQ(valueAt<float>(cloud, point, "x"), echo.point_lidar.x());
    ASSERT_EQ(valueAt<float>(cloud, point, "z"), echo.point_lidar.z());
    ASSERT_EQ(valueAt<float>(cloud, point, "intensity"), echo.intensity);
    ASSERT_EQ(valueAt<uint16_t>(cloud, point, "ring"), echo.ring);
    double offset_s = 0.0;
    if (model.encoding == Encoding::kVelodyne) offset_s = valueAt<float>(cloud, point, "time");
    if (model.encoding == Encoding::kOuster) offset_s = 1e-9 * valueAt<uint32_t>(cloud, point, "t");
    if (model.encoding == Encoding::kHesai) {
      offset_s = valueAt<double>(cloud, point, "timestamp") - kStamp_s;
    }
    ASSERT_NEAR(offset_s, 1e-9 * echo.offset_ns, 1e-6);
    ASSERT_LT(offset_s, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Makes, EncodedScan, ::testing::Values("vlp16", "os1_64", "xt32"),
                         [](const auto& info) { return std::string(info.param); });

TEST(EncodedScan, OusterKeepsZerosWhereNothingCameBack) {
  const LidarModel model = lidarNamed("os1_64");
  LidarScan scan;
  scan.period_ns = 100'000'000;
  const EncodedCloud cloud = encode(scan, model, 0.0);
  EXPECT_EQ(cloud.width, 1024U);
  EXPECT_EQ(valueAt<float>(cloud, 1024 + 512, "x"), 0.0F);
  EXPECT_EQ(valueAt<uint16_t>(cloud, 1024 + 512, "ring"), 1);
  EXPECT_EQ(valueAt<uint32_t>(cloud, 1024 + 512, "t"), 50'000'000U);
}

}  // namespace
}  // namespace mrpt_sgraphs::sim
