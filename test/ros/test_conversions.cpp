// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mrpt_sgraphs/ros/conversions.h"
#include "mrpt_sgraphs/ros/markers.h"

namespace mrpt_sgraphs {
namespace {

Pose somePose(double x) {
  Tangent tangent;
  tangent << x, -2.0, 0.5, 0.1, -0.2, 0.3 * x;
  return expPose(tangent);
}

GraphSnapshot threeKeyframes() {
  GraphSnapshot graph;
  graph.stamp_s = 1600000000.3;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const double x = static_cast<double>(i);
    KeyframeNode keyframe;
    keyframe.id = KeyframeId{i};
    keyframe.stamp_s = 1600000000.0 + 0.1 * x;
    keyframe.T_map_base = keyframe.T_odom_base = somePose(x);
    graph.keyframes.push_back(keyframe);
  }
  const auto add = [&graph](std::uint64_t from, std::uint64_t to, RelativePoseFactor::Kind kind) {
    graph.factors.push_back(
        {FactorId{graph.factors.size()},
         std::make_shared<RelativePoseFactor>(KeyframeId{from}, KeyframeId{to}, Pose::Identity(),
                                              Matrix6::Identity(), kind)});
  };
  add(0, 1, RelativePoseFactor::Kind::kOdometry);
  add(1, 2, RelativePoseFactor::Kind::kOdometry);
  add(0, 2, RelativePoseFactor::Kind::kLoopClosure);
  return graph;
}

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
  EXPECT_TRUE(motion->T_odom_base.isApprox(result.T_odom_base, 1e-12));
  EXPECT_EQ(motion->covariance, result.covariance);
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

TEST(Markers, ShowEachLayerInItsOwnNamespace) {
  const auto markers = toMarkers(threeKeyframes(), "map").markers;
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_EQ(markers[0].ns, "keyframes");
  EXPECT_EQ(markers[0].points.size(), 3U);
  EXPECT_EQ(markers[1].ns, "odometry");
  EXPECT_EQ(markers[1].points.size(), 4U);
  EXPECT_EQ(markers[2].ns, "loop_closures");
  EXPECT_EQ(markers[2].points.size(), 2U);
}

TEST(Markers, OfAnEmptyGraphRemoveWhatWasShown) {
  for (const auto& marker : toMarkers(GraphSnapshot(), "map").markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
