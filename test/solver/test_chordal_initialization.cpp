// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/solver/chordal_initialization.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {
namespace {

constexpr int kPoses = 30;
constexpr double kTolerance = 1e-9;

/// A walk with loops and one wall, measured without error; the values to begin with are anywhere.
class ChordalInitializationTest : public ::testing::Test {
 protected:
  ChordalInitializationTest() {
    for (int k = 0; k < kPoses; ++k) truth_.push_back(random_.pose());
    for (int k = 0; k < kPoses; ++k) {
      problem_.addVariable(keyframe(k), k == kHeld ? truth_[k] : random_.pose(), k == kHeld);
    }
    for (int k = 0; k + 1 < kPoses; ++k) measure(k, k + 1);
    for (int k = 0; k + 7 < kPoses; k += 5) measure(k + 7, k);
  }

  static KeyframeId keyframe(int k) { return KeyframeId{static_cast<uint64_t>(k)}; }

  void measure(int from, int to) {
    const Matrix6 information = (Tangent() << 9, 8, 7, 60, 50, 40).finished().asDiagonal();
    const Pose& T_from = truth_[static_cast<std::size_t>(from)];
    add(std::make_shared<RelativePoseFactor>(
            keyframe(from), keyframe(to), T_from.inverse() * truth_[static_cast<std::size_t>(to)],
            information),
        from, to);
  }

  void add(FactorConstPtr factor, int first, int second) {
    const int variables[] = {first, second};
    problem_.addFactor(*factor, variables);
    factors_.push_back(std::move(factor));
  }

  static constexpr int kHeld = 4;
  RandomGeometry random_{3, 20.0};
  std::vector<Pose> truth_;
  std::vector<FactorConstPtr> factors_;
  Problem problem_;
};

TEST_F(ChordalInitializationTest, FindsWhatWasMeasuredWithoutError) {
  const Plane wall_map{random_.vector(1.0).normalized(), 2.0};
  const int wall = problem_.addVariable(WallId{0}, Plane{});
  add(std::make_shared<PlaneObservationFactor>(
          keyframe(9), WallId{0}, inverseTimes(truth_[9], wall_map), Eigen::Matrix3d::Identity()),
      9, wall);
  const Pose held = problem_.pose(kHeld);
  EXPECT_EQ(initializeChordal(&problem_), kPoses - 1);
  for (int k = 0; k < kPoses; ++k) {
    EXPECT_TRUE(problem_.pose(k).isApprox(truth_[static_cast<std::size_t>(k)], kTolerance)) << k;
  }
  EXPECT_EQ(problem_.pose(kHeld).matrix(), held.matrix());
  EXPECT_NEAR((problem_.plane(wall).normal - wall_map.normal).norm(), 0.0, kTolerance);
  EXPECT_NEAR(problem_.plane(wall).distance, wall_map.distance, 1e-7);
  EXPECT_NEAR(problem_.cost(), 0.0, 1e-12);
}

TEST_F(ChordalInitializationTest, EveryPartHasItsOwnFirstPose) {
  const int part[] = {problem_.addVariable(keyframe(100), random_.pose()),
                      problem_.addVariable(keyframe(101), random_.pose())};
  const int alone = problem_.addVariable(keyframe(102), random_.pose());
  const Pose Z = random_.pose();
  add(std::make_shared<RelativePoseFactor>(keyframe(100), keyframe(101), Z, Matrix6::Identity()),
      part[0], part[1]);
  const Problem::Values before = problem_.values();
  EXPECT_EQ(initializeChordal(&problem_), kPoses);
  EXPECT_EQ(problem_.pose(alone).matrix(), before.poses[kPoses + 2].matrix());
  EXPECT_EQ(problem_.pose(part[0]).matrix(), before.poses[kPoses].matrix());
  EXPECT_TRUE(problem_.pose(part[1]).isApprox(before.poses[kPoses] * Z, kTolerance));
}

TEST_F(ChordalInitializationTest, NothingMeasuredChangesNothing) {
  Problem empty;
  EXPECT_EQ(initializeChordal(&empty), 0);
  Problem alone;
  alone.addVariable(keyframe(0), truth_[0]);
  alone.addVariable(WallId{0}, Plane{});
  EXPECT_EQ(initializeChordal(&alone), 0);
  EXPECT_EQ(alone.pose(0).matrix(), truth_[0].matrix());
}

TEST_F(ChordalInitializationTest, WeightsThatOverflowChangeNothing) {
  add(std::make_shared<RelativePoseFactor>(keyframe(0), keyframe(2), Pose::Identity(),
                                           1e308 * Matrix6::Identity()),
      0, 2);
  add(std::make_shared<RelativePoseFactor>(keyframe(0), keyframe(2), Pose::Identity(),
                                           1e308 * Matrix6::Identity()),
      0, 2);
  const Problem::Values before = problem_.values();
  EXPECT_EQ(initializeChordal(&problem_), 0);
  EXPECT_EQ(problem_.pose(2).matrix(), before.poses[2].matrix());
}

TEST(ChordalInitialization, PlanesDoNotFollowAMeasurementThatIsNone) {
  const Matrix6 information = Matrix6::Identity();
  const RelativePoseFactor edge(KeyframeId{0}, KeyframeId{1}, Pose::Identity(), information);
  for (const Plane& none :
       {Plane{{0.2, 0.0, 1e-300}, 0.0}, Plane{{1.0, 0.0, 0.0}, std::nan("")}}) {
    const PlaneObservationFactor seen(KeyframeId{0}, WallId{0}, none, Eigen::Matrix3d::Identity());
    Problem problem;
    const int poses[] = {problem.addVariable(KeyframeId{0}, Pose::Identity(), true),
                         problem.addVariable(KeyframeId{1}, Pose::Identity())};
    const int ends[] = {poses[0], problem.addVariable(WallId{0}, Plane{})};
    problem.addFactor(edge, poses);
    problem.addFactor(seen, ends);
    EXPECT_EQ(initializeChordal(&problem), 1);
    EXPECT_EQ(problem.plane(ends[1]).normal, Plane{}.normal);
    EXPECT_EQ(problem.plane(ends[1]).distance, 0.0);
  }
}

}  // namespace
}  // namespace mrpt_sgraphs::test
