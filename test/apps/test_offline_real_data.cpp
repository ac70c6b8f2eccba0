// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <future>

#include "mrpt_sgraphs/io/evaluation.h"
#include "program.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr double kMaxDt_s = 0.01;

/// Recordings that are not ours, in the folder that MRPT_SGRAPHS_DATA names.
class RealDataTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MRPT_SGRAPHS_DATA");
    if (folder == nullptr) GTEST_SKIP() << "MRPT_SGRAPHS_DATA names no folder with recordings";
    data_ = folder;
  }

  /// Runs on a recording; every scan must have got its pose.
  TrajectoryErrors errorsOf(const std::string& bag, const std::string& points,
                            const std::string& truth, const Arguments& further = {}) const {
    const TemporaryFolder out;
    Arguments arguments{"--bag", data_ + "/" + bag, "--points", points, "--out", out.path()};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const ProgramResult result = runOffline(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const TrajectoryErrors errors =
        evaluateRun(readTruth(data_ + "/" + truth), out.path(), kMaxDt_s).trajectory;
    EXPECT_EQ(errors.truth_unpaired, 0U) << bag;
    std::printf("%s: ATE %.4f m\n", bag.c_str(), errors.ate_m.rmse);
    return errors;
  }

  std::string data_;
};

TEST_F(RealDataTest, OfficeFloorWithAndWithoutOdometry) {
  const auto run = [this](const Arguments& further) {
    return errorsOf("office_floor.bag", "/velodyne_points", "office_floor_truth.tum", further);
  };
  auto with = std::async(std::launch::async, run, Arguments{"--odom", "/odom"});
  const double ate_m = run({}).ate_m.rmse;
  const double ate_with_odometry_m = with.get().ate_m.rmse;
  EXPECT_LE(ate_m, 0.05);
  EXPECT_LE(ate_with_odometry_m, 1.05 * ate_m);
}

TEST_F(RealDataTest, Hall) {
  EXPECT_LE(errorsOf("hall.bag", "/points", "hall_reference.tum").ate_m.rmse, 0.10);
}

TEST_F(RealDataTest, RoomClip) {
  EXPECT_LE(errorsOf("room_clip.bag", "/points", "room_clip_reference.tum").ate_m.rmse, 0.05);
}

}  // namespace
}  // namespace mrpt_sgraphs::test
