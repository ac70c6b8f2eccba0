// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "mrpt_sgraphs/io/trajectory_error.h"
#include "random_walk.h"
#include "temporary_folder.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kMaxDt_s = 0.01;

TEST(TrajectoryError, IsZeroHoweverTheRunIsMoved) {
  const Trajectory truth = test::walk(500);
  const Pose T_run_truth = test::someMotion();
  const TrajectoryErrors errors =
      evaluateTrajectory(truth, test::moved(T_run_truth, truth), kMaxDt_s);
  EXPECT_EQ(errors.paired, truth.size());
  EXPECT_LT(errors.ate_m.max, 1e-9);
  EXPECT_LT(errors.ate_z_m.max, 1e-9);
  EXPECT_LT(errors.per_scan.translation_rmse_m, 1e-9);
  EXPECT_LT(errors.over_10m.translation_percent, 1e-6);
  EXPECT_LT(local(errors.T_truth_run, T_run_truth.inverse()).norm(), 1e-9);
}

TEST(TrajectoryError, DoesNotDependOnTheFrameOfTheRun) {
  const Trajectory truth = test::walk(500);
  const Trajectory run = test::withNoise(truth, 0.05, 1);
  const TrajectoryErrors here = evaluateTrajectory(truth, run, kMaxDt_s);
  const TrajectoryErrors there =
      evaluateTrajectory(truth, test::moved(test::someMotion(), run), kMaxDt_s);
  EXPECT_NEAR(here.ate_m.rmse, there.ate_m.rmse, 1e-9);
  EXPECT_NEAR(here.ate_z_m.rmse, there.ate_z_m.rmse, 1e-9);
  EXPECT_NEAR(here.over_1m.rotation_deg_per_m, there.over_1m.rotation_deg_per_m, 1e-9);
}

TEST(TrajectoryError, IsThatOfTheNoise) {
  constexpr double kSigma_m = 0.05;
  const Trajectory truth = test::walk(5000);
  const TrajectoryErrors errors =
      evaluateTrajectory(truth, test::withNoise(truth, kSigma_m, 2), kMaxDt_s);
  // Three axes; 5000 x 3 draws know their sigma to 1 / sqrt(2 * 15000) = 0.6 %.
  EXPECT_NEAR(errors.ate_m.rmse, kSigma_m * std::sqrt(3.0), 0.02 * kSigma_m * std::sqrt(3.0));
  EXPECT_NEAR(errors.ate_z_m.rmse, kSigma_m, 0.03 * kSigma_m);
  // Maxwell's distribution: mean 2 sigma sqrt(2 / pi), median 1.5382 sigma.
  EXPECT_NEAR(errors.ate_m.mean, 1.5958 * kSigma_m, 0.03 * kSigma_m);
  EXPECT_NEAR(errors.ate_m.median, 1.5382 * kSigma_m, 0.03 * kSigma_m);
  // The noise of two scans.
  EXPECT_NEAR(errors.per_scan.translation_rmse_m, kSigma_m * std::sqrt(6.0), 0.03 * kSigma_m * 2.5);
}

TEST(TrajectoryError, DoesNotScaleTheRun) {
  const Trajectory truth = test::walk(500);
  Trajectory run = truth;
  for (StampedPose& pose : run) pose.T_world_body.translation() *= 1.02;
  const TrajectoryErrors errors = evaluateTrajectory(truth, run, kMaxDt_s);
  EXPECT_GT(errors.ate_m.rmse, 0.01);
  EXPECT_NEAR(errors.over_1m.translation_percent, 2.0, 0.01);  // a metre of the walk is straight
}

TEST(TrajectoryError, FindsADriftOfHeading) {
  constexpr double kDrift_deg_per_m = 0.5;
  const Trajectory truth = test::walk(500);
  Trajectory run{truth[0]};
  Tangent turn = Tangent::Zero();
  turn[5] = kDrift_deg_per_m * 0.1 * M_PI / 180.0;  // each step is 0.1 m
  for (std::size_t k = 1; k < truth.size(); ++k) {
    const Pose step = truth[k - 1].T_world_body.inverse() * truth[k].T_world_body;
    run.push_back({truth[k].stamp_s, retract(run.back().T_world_body * step, turn)});
  }
  const TrajectoryErrors errors = evaluateTrajectory(truth, run, kMaxDt_s);
  EXPECT_NEAR(errors.over_1m.rotation_deg_per_m, kDrift_deg_per_m, 0.01);
  EXPECT_NEAR(errors.per_scan.rotation_rmse_deg, 0.1 * kDrift_deg_per_m, 1e-6);
}

TEST(TrajectoryError, HasNoSegmentLongerThanThePath) {
  const Trajectory truth = test::walk(50);  // 4.9 m
  const TrajectoryErrors errors = evaluateTrajectory(truth, truth, kMaxDt_s);
  EXPECT_EQ(errors.over_10m.segments, 0u);
  EXPECT_TRUE(std::isnan(errors.over_10m.translation_percent));
  EXPECT_GT(errors.over_1m.segments, 30u);
}

TEST(TrajectoryError, SaysWhatHasNoPartner) {
  const Trajectory truth = test::walk(100);
  Trajectory run = truth;
  run.erase(run.begin() + 40);                      // a scan was lost,
  run.push_back({1.6e9 + 60.0, Pose::Identity()});  // two are later than the truth,
  run.push_back({1.6e9 + 60.1, Pose::Identity()});
  run.push_back(run.front());  // one comes twice
  const TrajectoryErrors errors = evaluateTrajectory(truth, run, kMaxDt_s);
  EXPECT_EQ(errors.poses, 102u);
  EXPECT_EQ(errors.paired, 99u);
  EXPECT_EQ(errors.run_unpaired, 3u);
  EXPECT_EQ(errors.truth_unpaired, 1u);
  EXPECT_LT(errors.ate_m.rmse, 1e-9);
}

TEST(TrajectoryError, PairsTheNearestInTimeAndEachOnce) {
  const auto at = [](double stamp_s, double x) {
    StampedPose pose{stamp_s, Pose::Identity()};
    pose.T_world_body.translation().x() = x;
    return pose;
  };
  // 1.008 is nearest to 1.007; 1.000 gets what is left, not the same one again.
  const Trajectory truth{at(1.000, 10.0), at(1.008, 20.0), at(2.0, 30.0)};
  const Trajectory run{at(1.007, 2.0), at(1.004, 1.0), at(2.02, 3.0)};
  const PairedTrajectories paired = pairByTime(truth, run, kMaxDt_s);
  ASSERT_EQ(paired.pairs.size(), 2u);
  for (const PosePair& pair : paired.pairs) {
    EXPECT_EQ(pair.T_truth_body.translation().x(), 10.0 * pair.T_run_body.translation().x());
  }
  EXPECT_EQ(paired.run_unpaired, 1u);
  EXPECT_EQ(paired.truth_unpaired, 1u);
}

TEST(TrajectoryError, RefusesWhatCannotBeAligned) {
  const auto message = [](const Trajectory& truth) {
    return test::messageOf<std::runtime_error>([&] { evaluateTrajectory(truth, truth, kMaxDt_s); });
  };
  EXPECT_NE(message(test::walk(2)).find("2 poses have a truth, three are needed"),
            std::string::npos);

  Trajectory standing = test::walk(100);
  Trajectory straight = standing;
  for (std::size_t k = 0; k < standing.size(); ++k) {
    standing[k].T_world_body.translation() = Eigen::Vector3d(5.0, 6.0, 7.0);
    straight[k].T_world_body.translation() =
        0.1 * static_cast<double>(k) * Eigen::Vector3d(0.6, 0.8, 0.1);
  }
  EXPECT_NE(message(standing).find("at one point"), std::string::npos);
  EXPECT_NE(message(straight).find("on one line"), std::string::npos);
}

TEST(TrajectoryError, AlignsAPathInAPlaneWithoutAMirror) {
  Trajectory truth = test::walk(300);
  for (StampedPose& pose : truth) pose.T_world_body.translation().z() = 0.0;
  // The direction without spread has either sign in the decomposition: some of these need a turn.
  for (int k = 0; k < 20; ++k) {
    const Pose T = expPose(Tangent::Constant(0.3 * k));
    const TrajectoryErrors errors = evaluateTrajectory(truth, test::moved(T, truth), kMaxDt_s);
    EXPECT_LT(errors.ate_m.max, 1e-9) << k;
    EXPECT_NEAR(errors.T_truth_run.linear().determinant(), 1.0, 1e-12) << k;
  }
}

TEST(TrajectoryError, TellsErrorsOfHeightApart) {
  const Trajectory truth = test::walk(2000);
  Trajectory run = truth;
  for (std::size_t k = 0; k < run.size(); ++k) {
    run[k].T_world_body.translation().z() += k % 2 == 0 ? 0.1 : -0.1;
  }
  const TrajectoryErrors errors = evaluateTrajectory(truth, run, kMaxDt_s);
  EXPECT_NEAR(errors.ate_z_m.rmse, 0.1, 1e-4);
  EXPECT_NEAR(errors.ate_m.rmse, 0.1, 1e-4);
}

}  // namespace
}  // namespace mrpt_sgraphs
