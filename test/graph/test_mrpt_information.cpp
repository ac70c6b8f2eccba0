// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/poses/CPose3D.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>

#include "mrpt_sgraphs/graph/mrpt_information.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs {
namespace {

Matrix6 randomInformation(test::RandomGeometry* random) {
  Matrix6 root;
  for (int k = 0; k < 36; ++k) root(k) = random->number(10.0);
  return root * root.transpose() + Matrix6::Identity();
}

Pose poseOfAngles(const Eigen::Vector3d& t, double yaw, double pitch, double roll) {
  Pose T = Pose::Identity();
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  T.translation() = t;
  return T;
}

/// x y z yaw pitch roll as MRPT understands them.
Tangent mrptCoordinates(const Pose& T) {
  const mrpt::poses::CPose3D pose(mrpt::math::CMatrixDouble44(T.matrix()));
  Tangent c;
  c << pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll();
  return c;
}

Pose fromMrptCoordinates(const Tangent& c) {
  const mrpt::poses::CPose3D pose(c(0), c(1), c(2), c(3), c(4), c(5));
  Pose T = Pose::Identity();
  T.linear() = pose.getRotationMatrix().asEigen();
  T.translation() = c.head<3>();
  return T;
}

double relativeError(const Matrix6& a, const Matrix6& b) { return (a - b).norm() / b.norm(); }

TEST(MrptInformation, AgreesWithCentralDifferencesOfMrptsOwnPoses) {
  test::RandomGeometry random(31, 40.0);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE(trial);
    const double pitch = random.number(1.4);
    const Pose T = poseOfAngles(random.vector(40.0), random.number(3.0), pitch, random.number(3.0));
    const Tangent c = mrptCoordinates(T);
    Matrix6 J;  // of the tangent with respect to MRPT's coordinates
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      J.col(k) = (local(T, fromMrptCoordinates(c + kStep * Tangent::Unit(k))) -
                  local(T, fromMrptCoordinates(c - kStep * Tangent::Unit(k)))) /
                 (2.0 * kStep);
    }
    const Matrix6 information = randomInformation(&random);
    EXPECT_LT(
        relativeError(toYawPitchRollInformation(T, information), J.transpose() * information * J),
        1e-7);
    const Matrix6 J_inverse = J.inverse();
    EXPECT_LT(relativeError(fromYawPitchRollInformation(T, information),
                            J_inverse.transpose() * information * J_inverse),
              1e-6);
  }
}

TEST(MrptInformation, AgreesWithSamples) {
  // Poses drawn from the right perturbation, and their covariance in MRPT's coordinates.
  test::RandomGeometry random(32, 5.0);
  std::mt19937 generator(33);
  std::normal_distribution<double> normal;
  for (const double pitch : {-1.2, 0.0, 0.7}) {
    SCOPED_TRACE(pitch);
    const Pose T = poseOfAngles(random.vector(5.0), 0.8, pitch, -1.1);
    const Matrix6 information = 1e4 * randomInformation(&random);
    const Matrix6 covariance = information.inverse();
    const Matrix6 root = covariance.llt().matrixL();
    const Tangent mean = mrptCoordinates(T);
    Matrix6 sampled = Matrix6::Zero();
    constexpr int kSamples = 100000;
    for (int k = 0; k < kSamples; ++k) {
      Tangent white;
      for (int row = 0; row < 6; ++row) white(row) = normal(generator);
      const Tangent d = mrptCoordinates(retract(T, root * white)) - mean;
      sampled += d * d.transpose() / kSamples;
    }
    const Matrix6 predicted = toYawPitchRollInformation(T, information).inverse();
    // whitened, so that the weak directions count as much as the strong ones
    const Matrix6 whitener = Matrix6(predicted.llt().matrixL()).inverse();
    const Matrix6 whitened = whitener * sampled * whitener.transpose();
    EXPECT_LT((whitened - Matrix6::Identity()).cwiseAbs().maxCoeff(), 0.03);
  }
}

TEST(MrptInformation, ComesBackAsItWas) {
  test::RandomGeometry random(34, 1e5);
  for (int trial = 0; trial < 100; ++trial) {
    const Pose T = poseOfAngles(random.vector(1e5), random.number(3.1), random.number(1.5),
                                random.number(3.1));
    const Matrix6 information = randomInformation(&random);
    const Matrix6 there = toYawPitchRollInformation(T, information);
    EXPECT_EQ(there, there.transpose());
    EXPECT_LT(relativeError(fromYawPitchRollInformation(T, there), information), 1e-10);
  }
}

TEST(MrptInformation, ComesBackUntilNearThePole) {
  test::RandomGeometry random(35);
  const Matrix6 information = randomInformation(&random);
  const Pose T = poseOfAngles({1.0, 2.0, 3.0}, 0.4, 0.5 * M_PI - 2.0 * kGimbalLockCosine, -0.9);
  const Matrix6 back = fromYawPitchRollInformation(T, toYawPitchRollInformation(T, information));
  EXPECT_LT(relativeError(back, information), 1e-5);
}

TEST(MrptInformation, StaysFiniteAndInventsNothingAtThePole) {
  test::RandomGeometry random(36);
  for (const double pitch : {0.5 * M_PI, -0.5 * M_PI}) {
    for (const double off_rad : {0.0, 1e-17, 1e-12, 1e-7}) {
      SCOPED_TRACE(testing::Message() << pitch << " + " << off_rad);
      const double roll = random.number(3.0);
      const Pose T = poseOfAngles(random.vector(3.0), random.number(3.0), pitch + off_rad, roll);
      const Matrix6 information = randomInformation(&random);

      const Matrix6 there = toYawPitchRollInformation(T, information);
      EXPECT_TRUE(there.allFinite());
      // of any information in a file, and of our own that comes back
      for (const Matrix6& ypr : {Matrix6(Matrix6::Identity()), information, there}) {
        const Matrix6 back = fromYawPitchRollInformation(T, ypr);
        ASSERT_TRUE(back.allFinite());
        const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(back);
        EXPECT_GT(eigen.eigenvalues()(0), -1e-9 * eigen.eigenvalues()(5));
        EXPECT_LT(eigen.eigenvalues()(0), 1e-9 * eigen.eigenvalues()(5)) << "one direction is lost";
        EXPECT_GT(eigen.eigenvalues()(1), 1e-6 * eigen.eigenvalues()(5)) << "and only one";
        EXPECT_LT(eigen.eigenvalues()(5), 10.0 * ypr.norm());
      }
    }
  }
}

TEST(MrptInformation, ExactlyAtThePoleARotationAboutTheBodysXIsStillKnown) {
  Pose T = Pose::Identity();
  T.linear() << 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0;  // pitch 90 degrees, not one bit off
  Matrix6 information = Matrix6::Zero();
  information.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const Matrix6 back = fromYawPitchRollInformation(T, toYawPitchRollInformation(T, information));
  Matrix6 expected = information;
  expected(5, 5) = 0.0;  // about the body's z, which is neither the axis of yaw nor pitch nor roll
  EXPECT_LT((back - expected).norm(), 1e-12);
}

TEST(MrptInformation, PermutationIsTheExactOneNearIdentityOnly) {
  test::RandomGeometry random(37);
  const Matrix6 information = randomInformation(&random);
  EXPECT_EQ(permutedInformation(permutedInformation(information)), information);
  EXPECT_EQ(toYawPitchRollInformation(Pose::Identity(), information),
            permutedInformation(information));
  const Pose turned = poseOfAngles({0.0, 0.0, 0.0}, 0.5, 0.0, 0.0);
  EXPECT_GT(relativeError(toYawPitchRollInformation(turned, information),
                          permutedInformation(information)),
            0.05);
}

}  // namespace
}  // namespace mrpt_sgraphs
