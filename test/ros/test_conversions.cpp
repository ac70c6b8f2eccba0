// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

#include "mrpt_sgraphs/ros/conversions.h"
#include "some_graph.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

using test::somePose;
using test::threeKeyframes;

TEST(Conversions, APoseComesBackAsItWas) {
  const auto T = toPose(toPoseMsg(somePose(1.0)));
  ASSERT_TRUE(T);
  EXPECT_TRUE(T->isApprox(somePose(1.0), 1e-12));
}

TEST(Conversions, RefusePosesThatAreNone) {
  geometry_msgs::Pose msg;  // as drivers leave it: a quaternion of zeros
  EXPECT_FALSE(toPose(msg));
  msg = toPoseMsg(somePose(1.0));
  msg.orientation.w = std::nan("");
  EXPECT_FALSE(toPose(msg));
  msg = toPoseMsg(somePose(1.0));
  msg.position.x = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(toPose(msg));
}

TEST(Conversions, AMatrixComesBackAsItWasAndGoesByRows) {
  const Matrix6 matrix = Matrix6::Random();
  const auto msg = toMsg(matrix);
  EXPECT_EQ(msg[1], matrix(0, 1));
  EXPECT_EQ(toMatrix(msg), matrix);
}

TEST(Conversions, StampsAreKeptToTheMicrosecond) {
  EXPECT_EQ(toRosTime(1600000119.8), ros::Time(1600000119, 800000000));
}

TEST(Conversions, AScanComesBackAsItWas) {
  OdometryResult result;
  result.stamp_s = 1600000000.123456;
  result.T_odom_base = somePose(2.0);
  result.covariance = Matrix6::Random();
  std_msgs::Header header;
  header.stamp = toRosTime(result.stamp_s);
  const auto motion = toScanMotion(toScanOdometry(result, header, "base_link"));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->stamp_s, result.stamp_s, 1e-6);
  EXPECT_EQ(motion->T_odom_base.matrix(), result.T_odom_base.matrix());
  EXPECT_EQ(motion->covariance, result.covariance);
}

TEST(Conversions, AKeyframeComesBackToTheLastBit) {
  Cloud::Ptr cloud(new Cloud);
  cloud->header.stamp = 1600000000123457;
  cloud->header.frame_id = "base_link";
  cloud->sensor_origin_.head<3>() = Eigen::Vector3f(0.1F, -0.2F, 0.7F);
  test::RandomGeometry random(1);
  for (int k = 0; k < 10; ++k) {
    Point point;
    point.getVector3fMap() = random.vector(20.0).cast<float>();
    point.intensity = static_cast<float>(random.number(100.0));
    point.time = static_cast<float>(random.number(0.1));
    point.ring = static_cast<std::uint16_t>(k);
    cloud->push_back(point);
  }
  const Keyframe keyframe{stampOf(*cloud), somePose(2.0), Matrix6::Random(), cloud, nullptr};
  std_msgs::Header header;
  header.stamp = toRosTime(keyframe.stamp_s);
  const KeyframeStamped msg = toMsg(keyframe, header, "base_link");
  const auto back = toKeyframe(msg);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp_s, keyframe.stamp_s) << "as a cloud's";
  EXPECT_EQ(back->T_odom_base.matrix(), keyframe.T_odom_base.matrix());
  EXPECT_EQ(back->covariance, keyframe.covariance);
  EXPECT_EQ(msg.viewpoint.z, double{cloud->sensor_origin_.z()});

  const Cloud::Ptr points = toCloud(toMsg(*cloud));
  ASSERT_NE(points, nullptr);
  EXPECT_EQ(points->header.stamp, cloud->header.stamp);
  EXPECT_EQ(points->header.frame_id, cloud->header.frame_id);
  ASSERT_EQ(points->size(), cloud->size());
  for (std::size_t k = 0; k < cloud->size(); ++k) {
    const Point& a = (*points)[k];
    const Point& b = (*cloud)[k];
    EXPECT_EQ(a.getVector3fMap(), b.getVector3fMap());
    EXPECT_EQ(std::tuple(a.intensity, a.time, a.ring), std::tuple(b.intensity, b.time, b.ring));
  }
}

TEST(Conversions, ARotationThatIsNotThatOfThePoseIsNotHeeded) {
  const Keyframe keyframe{1600000000.0, somePose(1.0), Matrix6::Identity(), nullptr, nullptr};
  KeyframeStamped msg = toMsg(keyframe, std_msgs::Header(), "base_link");
  for (const double value : {0.0, 1.0, std::nan("")}) {  // of who knows the pose alone
    msg.rotation.fill(value);
    const auto back = toKeyframe(msg);
    ASSERT_TRUE(back);
    EXPECT_TRUE(back->T_odom_base.isApprox(keyframe.T_odom_base, 1e-12)) << value;
  }
}

TEST(Conversions, CloudsThatAreNotOfKeyframesAreNone) {
  Cloud cloud;
  cloud.push_back(Point());
  cloud.push_back(Point());
  const sensor_msgs::PointCloud2 good = toMsg(cloud);
  ASSERT_NE(toCloud(good), nullptr);
  EXPECT_EQ(toCloud(good)->size(), 2U);

  auto bad = good;
  bad.fields.pop_back();
  EXPECT_EQ(toCloud(bad), nullptr) << "a field less";
  bad = good;
  bad.fields[0].datatype = sensor_msgs::PointField::FLOAT64;
  EXPECT_EQ(toCloud(bad), nullptr) << "of another type";
  bad = good;
  bad.fields[5].offset = bad.point_step - 1;
  EXPECT_EQ(toCloud(bad), nullptr) << "beyond the point";
  bad = good;
  bad.data.pop_back();
  EXPECT_EQ(toCloud(bad), nullptr) << "a byte less";
  bad = good;
  bad.height = bad.width = 0xFFFFFFFFU;
  EXPECT_EQ(toCloud(bad), nullptr) << "more than there is";

  cloud[1].y = std::nanf("");
  EXPECT_EQ(toCloud(toMsg(cloud))->size(), 1U) << "a point that is none";
}

TEST(Conversions, ACloudIsViewedAndNotCopied) {
  sensor_msgs::PointCloud2 msg;
  msg.width = 2;
  msg.height = 1;
  msg.point_step = 4;
  msg.row_step = 8;
  msg.data.resize(8);
  msg.fields.resize(1);
  msg.fields[0].name = "x";
  msg.fields[0].datatype = sensor_msgs::PointField::FLOAT32;
  const RawCloud view = viewOf(msg);
  EXPECT_EQ(view.data, msg.data.data());
  EXPECT_EQ(view.size, 8U);
  ASSERT_EQ(view.fields.size(), 1U);
  EXPECT_EQ(view.fields[0].type, RawCloud::Type::kFloat32);
}

TEST(Conversions, TheGraphKeepsItsIdsAndItsFactors) {
  const SituationalGraph msg = toMsg(threeKeyframes(), "map");
  EXPECT_EQ(msg.header.frame_id, "map");
  ASSERT_EQ(msg.keyframes.size(), 3U);
  EXPECT_EQ(msg.keyframes[2].id, 2U);
  EXPECT_EQ(msg.keyframes[2].representative, 2U);
  EXPECT_EQ(msg.keyframes[2].room, GraphKeyframe::NONE);
  ASSERT_EQ(msg.factors.size(), 3U);
  EXPECT_EQ(msg.factors[0].type, "odometry");
  EXPECT_EQ(msg.factors[2].type, "loop_closure");
  EXPECT_EQ(msg.factors[2].nodes, (std::vector<std::uint64_t>{0, 2}));
}

TEST(Conversions, TheGraphHasItsWallsItsFloorsAndFactorsOfAllTypes) {
  const GraphSnapshot graph = test::threeKeyframesBetweenWalls();
  const SituationalGraph msg = toMsg(graph, "map");
  ASSERT_EQ(msg.walls.size(), 2U);
  const GraphWall& wall = msg.walls[0];
  EXPECT_EQ(wall.id, 4U);
  EXPECT_EQ(wall.normal.x, -1.0);
  EXPECT_EQ(wall.distance, -3.0);
  EXPECT_EQ(wall.floor, GraphKeyframe::NONE);
  ASSERT_EQ(wall.polygon.size(), 4U);
  EXPECT_EQ(wall.polygon[3].z, 2.5);
  ASSERT_EQ(wall.holes.size(), 1U);
  ASSERT_EQ(wall.holes[0].points.size(), 4U);
  EXPECT_EQ(wall.holes[0].points[2].z, 2.0);
  EXPECT_TRUE(msg.walls[1].polygon.empty());

  ASSERT_EQ(msg.floors.size(), 1U);
  EXPECT_EQ(msg.floors[0].normal.z, 1.0);
  EXPECT_EQ(msg.floors[0].distance, -0.5);
  EXPECT_EQ(msg.floors[0].centre.y, 0.5);

  ASSERT_EQ(msg.factors.size(), 6U);
  EXPECT_EQ(msg.factors[4].type, "wall_observation");
  EXPECT_EQ(msg.factors[4].layers,
            (std::vector<std::uint8_t>{GraphFactor::KEYFRAME, GraphFactor::WALL}));
  EXPECT_EQ(msg.factors[4].nodes, (std::vector<std::uint64_t>{1, 4}));
  EXPECT_EQ(msg.factors[5].type, "ground_observation");
  EXPECT_EQ(msg.factors[5].layers[1], std::uint8_t{GraphFactor::FLOOR});
}

TEST(Conversions, ReportsNameTheRoomWhereThereIsOne) {
  OptimizationSummary summary;
  summary.kind = "condense";
  summary.dropped = 3;
  EXPECT_EQ(toMsg(summary, "map").room, OptimizationReport::NONE);
  summary.room = RoomId{0};
  const OptimizationReport msg = toMsg(summary, "map");
  EXPECT_EQ(msg.room, 0);
  EXPECT_EQ(msg.kind, "condense");
  EXPECT_EQ(msg.dropped, 3);
}

ObservedPlane somePlane(double x) {
  test::RandomGeometry random(static_cast<unsigned>(x));
  ObservedPlane plane;
  plane.plane_base = {random.vector(1.0).normalized(), random.number(5.0)};
  const Eigen::Matrix3d root =
      Eigen::Matrix3d::NullaryExpr([&random] { return random.number(1.0); });
  plane.covariance =
      root * root.transpose() + Eigen::Matrix3d(Eigen::Vector3d(1, 2, 3).asDiagonal());
  plane.covariance = plane.covariance.selfadjointView<Eigen::Upper>();
  plane.centroid_base = random.vector(5.0);
  for (int k = 0; k < 5; ++k) plane.extent_base.outline.push_back(random.vector(5.0));
  plane.extent_base.holes.resize(2);
  for (int k = 0; k < 3; ++k) plane.extent_base.holes[1].push_back(random.vector(5.0));
  plane.area_m2 = random.number(10.0);
  plane.points = 1234;
  return plane;
}

TEST(Conversions, PlanesComeBackToTheLastBit) {
  ObservedPlanes planes;
  for (const double x : {1.0, 2.0, 3.0}) planes.push_back(somePlane(x));
  std_msgs::Header header;
  header.stamp = toRosTime(1600000000.3);
  header.frame_id = "base_link";
  const KeyframePlanes msg = toMsg(std::make_shared<const ObservedPlanes>(planes), header);
  EXPECT_EQ(msg.header.stamp, header.stamp);
  EXPECT_EQ(msg.planes[0].covariance[1], planes[0].covariance(0, 1)) << "by rows";

  const ObservedPlanesConstPtr back = toObservedPlanes(msg);
  ASSERT_NE(back, nullptr);
  ASSERT_EQ(back->size(), planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const ObservedPlane& a = planes[k];
    const ObservedPlane& b = (*back)[k];
    EXPECT_EQ(a.plane_base.normal, b.plane_base.normal);
    EXPECT_EQ(a.plane_base.distance, b.plane_base.distance);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.centroid_base, b.centroid_base);
    EXPECT_EQ(a.extent_base.outline, b.extent_base.outline);
    EXPECT_EQ(a.extent_base.holes, b.extent_base.holes);
    EXPECT_EQ(a.area_m2, b.area_m2);
    EXPECT_EQ(a.points, b.points);
  }
}

TEST(Conversions, NoPlanesAreNotTheSameAsPlanesThatWereNotLookedFor) {
  EXPECT_EQ(toObservedPlanes(toMsg(ObservedPlanesConstPtr(), std_msgs::Header())), nullptr);
  const auto none = toObservedPlanes(toMsg(std::make_shared<const ObservedPlanes>(), {}));
  ASSERT_NE(none, nullptr);
  EXPECT_TRUE(none->empty());
}

TEST(Conversions, LeaveOutPlanesThatAreNone) {
  const auto planes = std::make_shared<ObservedPlanes>(6, somePlane(1.0));
  (*planes)[0].plane_base.normal *= 1.1;
  (*planes)[1].plane_base.distance = std::nan("");
  (*planes)[2].covariance(2, 2) = -1.0;
  (*planes)[3].covariance(0, 1) = std::nan("");
  (*planes)[4].extent_base.holes[1][0].x() = std::numeric_limits<double>::infinity();
  const auto back = toObservedPlanes(toMsg(ObservedPlanesConstPtr(planes), std_msgs::Header()));
  EXPECT_EQ(back->size(), 1U);
}

}  // namespace
}  // namespace mrpt_sgraphs
