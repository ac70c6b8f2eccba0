// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "mrpt_sgraphs/io/tum.h"
#include "random_walk.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

using test::messageOf;
using test::TemporaryFolder;

TEST(Tum, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const Trajectory written = test::moved(test::someMotion(), test::walk(300));
  writeTum(folder.file("walk.tum"), written);
  const Trajectory read = readTum(folder.file("walk.tum"));

  ASSERT_EQ(read.size(), written.size());
  for (std::size_t k = 0; k < read.size(); ++k) {
    EXPECT_NEAR(read[k].stamp_s, written[k].stamp_s, 1e-6);
    EXPECT_LT(local(read[k].T_world_body, written[k].T_world_body).norm(), 5e-9);
  }
}

TEST(Tum, WritesFixedDigitsAndOneOfTheTwoQuaternions) {
  const TemporaryFolder folder;
  StampedPose pose{1600000000.1, Pose::Identity()};
  pose.T_world_body.translation() << 1.0, -2.5, 1e-9;
  pose.T_world_body.linear() = Eigen::Quaterniond(-0.1, 0.5, 0.7, 0.5).toRotationMatrix();
  writeTum(folder.file("a.tum"), {pose});
  EXPECT_EQ(folder.read("a.tum"),
            "1600000000.100000 1.000000000 -2.500000000 0.000000001 "
            "-0.500000000 -0.700000000 -0.500000000 0.100000000\n");
}

TEST(Tum, PassesOverCommentsAndEmptyLinesAndReadsOtherLineEnds) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "a.tum", "# t x y z qx qy qz qw\n\n1.5 1 2 3 0 0 0 1\r\n  \n\t2.5\t4 5 6 0 0 0 2");
  const Trajectory trajectory = readTum(path);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp_s, 1.5);
  EXPECT_EQ(trajectory[1].T_world_body.translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(trajectory[1].T_world_body.linear(), Eigen::Matrix3d::Identity());
}

struct BadLine {
  const char* name;
  const char* text;
};

class TumBadLine : public ::testing::TestWithParam<BadLine> {};

TEST_P(TumBadLine, IsRefusedByFileAndLine) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("bad.tum", std::string("1 0 0 0 0 0 0 1\n") + GetParam().text + "\n");
  const std::string message = messageOf<std::runtime_error>([&] { readTum(path); });
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find("line 2"), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Lines, TumBadLine,
                         ::testing::Values(BadLine{"Nan", "2 nan 0 0 0 0 0 1"},
                                           BadLine{"Infinite", "2 inf 0 0 0 0 0 1"},
                                           BadLine{"TooLarge", "2 1e999 0 0 0 0 0 1"},
                                           BadLine{"TooShort", "2 0 0 0 0 0 0"},
                                           BadLine{"TooLong", "2 0 0 0 0 0 0 1 7"},
                                           BadLine{"NoNumber", "2 0 0 zero 0 0 0 1"},
                                           BadLine{"Commas", "2,0,0,0,0,0,0,1"},
                                           BadLine{"NoRotation", "2 0 0 0 0 0 0 0"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Tum, NamesTheFileThatItCannotReadOrWrite) {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing.tum");
  EXPECT_NE(messageOf<std::runtime_error>([&] { readTum(missing); }).find(missing),
            std::string::npos);
  EXPECT_THROW(readTum(folder.path()), std::runtime_error);
  const std::string nowhere = folder.file("nowhere/a.tum");
  EXPECT_NE(messageOf<std::runtime_error>([&] { writeTum(nowhere, {}); }).find(nowhere),
            std::string::npos);
}

}  // namespace
}  // namespace mrpt_sgraphs
