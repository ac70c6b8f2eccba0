// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/sg_file.h"

#include <gtest/gtest.h>

#include <clocale>

#include "graph_files.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs::test {
namespace {

class SgFileTest : public ::testing::Test {
 protected:
  GraphFile read(const std::string& text) const { return readSg(folder_.write("a.sg", text)); }
  std::string error(const std::string& from, const std::string& to) const {
    return errorOf(folder_, "a.sg", with(kSmallSg, from, to));
  }

  TemporaryFolder folder_;
};

TEST_F(SgFileTest, ReadsEveryRecord) {
  const GraphFile graph = read(kSmallSg);
  ASSERT_EQ(graph.keyframes.size(), 2U);
  EXPECT_EQ(graph.keyframes[1].id.value, 1U);
  EXPECT_DOUBLE_EQ(graph.keyframes[1].T_map_base.translation().x(), 1.1);
  EXPECT_EQ(graph.keyframes[0].room->value, 1U);
  EXPECT_FALSE(graph.keyframes[1].room.has_value());
  EXPECT_FALSE(graph.keyframes[0].fixed);
  ASSERT_EQ(graph.walls.size(), 4U);
  ASSERT_EQ(graph.rooms.size(), 1U);
  EXPECT_EQ(graph.rooms[0].walls.size(), 4U);
  EXPECT_EQ(graph.floors.size(), 1U);
  ASSERT_EQ(graph.factors.size(), 5U);
  EXPECT_STREQ(graph.factors[0]->type(), "odometry");
  EXPECT_STREQ(graph.factors[1]->type(), "loop_closure");
  EXPECT_STREQ(graph.factors[2]->type(), "wall_observation");
  EXPECT_TRUE(graph.ignored.empty());
}

TEST_F(SgFileTest, TurnsNormalsIntoTheRoom) {
  const GraphFile graph = read(kSmallSg);
  EXPECT_EQ(graph.walls[0].plane_map.normal, Eigen::Vector3d(-1.0, 0.0, 0.0));
  EXPECT_EQ(graph.walls[0].plane_map.distance, -3.0);
}

TEST_F(SgFileTest, CostsAreThoseOfTheFile) {
  const GraphFile graph = read(kSmallSg);
  EXPECT_NEAR(costOf(*graph.factors[0], graph), 0.1 * 0.1 / (0.02 * 0.02), 1e-9);
  EXPECT_NEAR(costOf(*graph.factors[1], graph), 0.1 * 0.1 / (0.03 * 0.03), 1e-9);
  EXPECT_NEAR(costOf(*graph.factors[2], graph), 0.01 * 0.01 / (0.02 * 0.02), 1e-9);
  EXPECT_NEAR(costOf(*graph.factors[3], graph), 0.12 * 0.12 / (0.02 * 0.02), 1e-9);
  // a wall seen under one degree: the residual is the sine
  const GraphFile turned =
      read(with(kSmallSg, "OBS 0 4 1 0 0 3.01", "OBS 0 4 0.99984769516 0.01745240644 0 3"));
  EXPECT_NEAR(costOf(*turned.factors[2], turned), std::pow(0.01745240644 / 0.01, 2), 1e-6);
}

TEST_F(SgFileTest, WritesWhatTheScorerReads) {
  GraphFile graph = read(kSmallSg);
  graph.keyframes[1].T_map_base.translation().x() = 1.0 / 3.0;
  writeSgEstimate(folder_.file("estimate"), graph);
  const std::string text = folder_.read("estimate");
  EXPECT_SAYS(text, "POSE 1 0.33333333333333331 0 0.5 0 0 0 1\n");
  EXPECT_SAYS(text, "PLANE 4 1 ");
  EXPECT_SAYS(text, "PLANE 5 -1 ");
}

TEST_F(SgFileTest, NodesMayComeAfterTheirFactors) {
  const GraphFile graph = read(
      "ODOM 0 1 1 0 0 0 0 0 1 0.02 0.003\n"
      "POSE 1 0 0 0 1 0 0 0 0 0 1\n"
      "POSE 0 0 0 0 0 0 0 0 0 0 1\n");
  EXPECT_EQ(graph.factors.size(), 1U);
}

TEST_F(SgFileTest, PassesOverAndCountsWhatItDoesNotKnow) {
  const GraphFile graph = read(std::string(kSmallSg) + "WINDOW 1 2 3\nWINDOW 2\n");
  EXPECT_EQ(graph.ignored.at("WINDOW"), 2);
  EXPECT_EQ(graph.keyframes.size(), 2U);
  EXPECT_TRUE(read("").keyframes.empty());
}

TEST_F(SgFileTest, ReadsNumbersInAnyLocaleAndLineEnding) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) std::setlocale(LC_ALL, name);
  std::string text = kSmallSg;
  text = with(text, " 1.1 0 0.5 ", "\t1.1000000000000000001e0 +0 5E-1\r");
  const GraphFile graph = read(text);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_DOUBLE_EQ(graph.keyframes[1].T_map_base.translation().x(), 1.1);
  EXPECT_DOUBLE_EQ(graph.keyframes[1].T_map_base.translation().z(), 0.5);
}

TEST_F(SgFileTest, ErrorsNameTheLineAndTheReason) {
  EXPECT_SAYS(error("1.1 0 0.5", "nan 0 0.5"), "line 4: 'POSE': 'nan' is not a finite number");
  EXPECT_SAYS(error("1.1 0 0.5", "inf 0 0.5"), "'inf' is not a finite number");
  EXPECT_SAYS(error("1.1 0 0.5", "1e999 0 0.5"), "'1e999' is not a finite number");
  EXPECT_SAYS(error("1.1 0 0.5", "1.1x 0 0.5"), "'1.1x' is not a finite number");
  EXPECT_SAYS(error("0.5  0 0 0 1", "0.5  0 0 0 0"), "line 2: 'POSE': the quaternion is zero");
  EXPECT_SAYS(error("PLANE 4 1 0 0", "PLANE 4 0 0 0"), "line 5: 'PLANE': the normal is zero");
  EXPECT_SAYS(error("0.02 0.003", "0 0.003"), "line 11: 'ODOM': the deviation in metres is not");
  EXPECT_SAYS(error("0.02 0.003", "0.02 -1"), "the deviation in radians is not above zero");
  EXPECT_SAYS(error("0.02 0.003", "1e-200 1"), "too small or too large");
  EXPECT_SAYS(error("0.02 0.003", "0.02"), "the line ends before the deviation in radians");
  EXPECT_SAYS(error("0.02 0.003", "0.02 0.003 7"), "more than there should be, from '7' on");
  EXPECT_SAYS(error("POSE 1", "POSE 0"), "line 4: 'POSE': keyframe 0 is there already, in line 2");
  EXPECT_SAYS(error("OBS 0 4", "OBS 0 9"), "line 13: there is no wall 9");
  EXPECT_SAYS(error("OBS 0 4", "OBS 9 4"), "line 13: there is no keyframe 9");
  EXPECT_SAYS(error("ROOMF 1", "ROOMF 2"), "there is no room 2");
  EXPECT_SAYS(error("ODOM 0 1", "ODOM 0 0"), "from keyframe 0 to itself");
  EXPECT_SAYS(error("POSE 1", "POSE -1"), "'-1' is not an id");
  EXPECT_SAYS(error("POSE 1", "POSE 18446744073709551616"), "is not an id");
}

TEST_F(SgFileTest, TheLargestIdIsAnId) {
  const GraphFile graph = read("POSE 18446744073709551615 0 0 0 0 0 0 0 0 0 1\n");
  EXPECT_EQ(graph.keyframes[0].id.value, ~uint64_t{0});
}

TEST_F(SgFileTest, OtherFilesAreRefused) {
  EXPECT_SAYS(errorOf(folder_, "b.sg", std::string("\x89PNG\r\n\x1a\n\0\0", 10)), "no record of");
  EXPECT_SAYS(messageOf<FileError>([&] { readSg(folder_.file("none.sg")); }), "No such file");
  EXPECT_SAYS(messageOf<FileError>([&] { readSg(folder_.path()); }), "a folder");
  EXPECT_SAYS(messageOf<FileError>([&] { readGraphFile("graph.txt"); }), "ends in none of");
}

}  // namespace
}  // namespace mrpt_sgraphs::test
