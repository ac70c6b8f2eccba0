// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/g2o_file.h"

#include <gtest/gtest.h>

#include "graph_files.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"

namespace mrpt_sgraphs::test {
namespace {

class G2oFileTest : public ::testing::Test {
 protected:
  GraphFile read(const std::string& text) const { return readG2o(folder_.write("a.g2o", text)); }
  std::string error(const std::string& from, const std::string& to) const {
    return errorOf(folder_, "a.g2o", with(kSmallG2o, from, to));
  }

  TemporaryFolder folder_;
};

TEST_F(G2oFileTest, ReadsVerticesEdgesAndWhatIsFixed) {
  const GraphFile graph = read(kSmallG2o);
  ASSERT_EQ(graph.keyframes.size(), 3U);
  EXPECT_EQ(graph.keyframes[1].id.value, 5U);
  EXPECT_TRUE(graph.keyframes[0].fixed);
  EXPECT_FALSE(graph.keyframes[1].fixed);
  ASSERT_EQ(graph.factors.size(), 3U);
  const auto& edge = dynamic_cast<const RelativePoseQuaternionFactor&>(*graph.factors[2]);
  EXPECT_EQ(edge.node(1), NodeId(KeyframeId{7}));
  EXPECT_EQ(edge.T_from_to.translation(), Eigen::Vector3d(2.03, 0.0, 0.0));
  EXPECT_EQ(edge.information()(0, 1), 1.0);
  EXPECT_EQ(edge.information()(1, 0), 1.0);
  EXPECT_EQ(edge.information()(3, 5), 2.0);
  EXPECT_EQ(edge.information()(5, 5), 400.0);
}

TEST_F(G2oFileTest, NormalizesQuaternions) {
  const GraphFile graph = read(kSmallG2o);
  const Eigen::Matrix3d R = graph.keyframes[2].T_map_base.linear();
  EXPECT_NEAR((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
}

TEST_F(G2oFileTest, TheCostIsG2os) {
  const GraphFile graph = read(
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 0.1 0 0 0 0 0.6 0.8\n"
      "EDGE_SE3:QUAT 0 1 0 0 0 0 0 0 1 2 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 5\n");
  EXPECT_NEAR(costOf(*graph.factors[0], graph), 2.0 * 0.01 + 5.0 * 0.36, 1e-14);
}

TEST_F(G2oFileTest, EstimatesComeBackAsTheyWere) {
  GraphFile graph = read(kSmallG2o);
  graph.keyframes[1].T_map_base.translation() << 1e7 / 3.0, -1e-7 / 3.0, 0.1;
  writeG2oEstimate(folder_.file("estimate.g2o"), graph);
  const GraphFile again = readG2o(folder_.file("estimate.g2o"));
  ASSERT_EQ(again.keyframes.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(again.keyframes[k].id, graph.keyframes[k].id);
    EXPECT_EQ(again.keyframes[k].T_map_base.translation(),
              graph.keyframes[k].T_map_base.translation());
    EXPECT_TRUE(again.keyframes[k].T_map_base.isApprox(graph.keyframes[k].T_map_base, 1e-15));
  }
}

TEST_F(G2oFileTest, PassesOverVerticesAndParametersButNoEdges) {
  const GraphFile graph =
      read(std::string(kSmallG2o) + "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 99 0 0 0\n");
  EXPECT_EQ(graph.ignored.at("PARAMS_SE3OFFSET"), 1);
  EXPECT_EQ(graph.ignored.at("VERTEX_TRACKXYZ"), 1);
  EXPECT_SAYS(error("EDGE_SE3:QUAT 5 7", "EDGE_SE3_TRACKXYZ 5 7"),
              "line 6: 'EDGE_SE3_TRACKXYZ': edges of this type are not known");
  EXPECT_SAYS(error("VERTEX_SE3:QUAT 3", "VERTEX_SE2 3"), "line 1: 'VERTEX_SE2': a pose graph in 2D");
}

TEST_F(G2oFileTest, InformationThatIsNoneIsRefused) {
  EXPECT_SAYS(error("100 0 0 0 0 0 100", "nan 0 0 0 0 0 100"), "line 5: 'EDGE_SE3:QUAT': 'nan'");
  EXPECT_SAYS(error("100 0 0 0 0 0 100", "100 0 0 0 0 inf 100"), "'inf' is not a finite number");
  EXPECT_SAYS(error("100 0 0 0 0 0 100", "-100 0 0 0 0 0 100"), "not positive semidefinite");
  EXPECT_SAYS(error("100 0 0 0 0 0 100", "100 101 0 0 0 0 100"), "not positive semidefinite");
  EXPECT_SAYS(error("100 0 0 0 0 0 100", "1e308 1e308 1e308 0 0 0 1e308"), "semidefinite");
}

TEST_F(G2oFileTest, InformationMayHaveDirectionsThatItSaysNothingAbout) {
  const std::string text = with(kSmallG2o, "100 0 0 0 0 0 100", "0 0 0 0 0 0 0");
  EXPECT_EQ(read(text).factors.size(), 3U);
  EXPECT_EQ(read(with(kSmallG2o, "100 0 0 0 0 0 100", "100 100 0 0 0 0 100")).factors.size(), 3U);
}

TEST_F(G2oFileTest, ErrorsNameTheLineAndTheReason) {
  EXPECT_SAYS(error("VERTEX_SE3:QUAT 5", "VERTEX_SE3:QUAT 3"), "line 2: 'VERTEX_SE3:QUAT': vertex 3");
  EXPECT_SAYS(error("EDGE_SE3:QUAT 5 7", "EDGE_SE3:QUAT 5 8"), "line 6: there is no vertex 8");
  EXPECT_SAYS(error("EDGE_SE3:QUAT 5 7", "EDGE_SE3:QUAT 5 5"), "from vertex 5 to itself");
  EXPECT_SAYS(error("FIX 3", "FIX 4"), "line 4: there is no vertex 4");
  EXPECT_SAYS(error("FIX 3", "FIX"), "line 4: 'FIX': the line ends before vertex");
  EXPECT_SAYS(error("1.1 0 0 0 0 0 1", "1.1 0 0 0 0 0 0"), "line 2: 'VERTEX_SE3:QUAT': the quat");
  EXPECT_SAYS(error("1.1 0 0 0 0 0 1", "1.1 0 0 0 0 0"), "the line ends before pose");
}

}  // namespace
}  // namespace mrpt_sgraphs::test
