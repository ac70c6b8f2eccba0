// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/solver/problem.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {

/// A robot that goes round and round in a square of 20 m with four walls about it, and measures with
/// noise: odometry, loops between its rounds, walls.
class SmallWorld {
 public:
  static constexpr int kStepsARound = 40;

  explicit SmallWorld(int keyframes, unsigned seed = 1, double noise = 1.0)
      : random_(seed), noise_(noise) {
    for (int i = 0; i < keyframes; ++i) truth.push_back(truePose(i));
    for (int w = 0; w < 4; ++w) {
      const double heading = M_PI_2 * w + 0.3;
      walls.push_back({{-std::cos(heading), -std::sin(heading), 0.0}, -15.0});
    }
    for (int i = 1; i < keyframes; ++i) {
      connect(i - 1, i, RelativePoseFactor::Kind::kOdometry);
      if (i >= kStepsARound && i % 4 == 0) {
        connect(i - kStepsARound, i, RelativePoseFactor::Kind::kLoopClosure);
      }
    }
    for (int i = 0; i < keyframes; ++i) {
      for (int w = 0; w < 4; ++w) {
        if ((i + w) % 2 == 0) observe(i, w);
      }
    }
  }

  void connect(int from, int to, RelativePoseFactor::Kind kind) {
    const Pose measured = truth[at(from)].inverse() * truth[at(to)] *
                          random_.smallPose(0.02 * noise_, 0.005 * noise_);
    Matrix6 information = Matrix6::Zero();
    information.diagonal() << Eigen::Vector3d::Constant(2500.0), Eigen::Vector3d::Constant(4e4);
    add(std::make_unique<RelativePoseFactor>(keyframe(from), keyframe(to), measured, information,
                                             kind),
        {from, to});
  }

  void observe(int i, int w) {
    const Plane seen = truth[at(i)].inverse() * walls[at(w)];
    const Plane measured =
        retract(seen, PlaneTangent(noise_ * random_.vector(0.01).cwiseProduct(
                          Eigen::Vector3d(1.0, 1.0, 2.0))));
    const Eigen::Vector3d information(1e4, 1e4, 2500.0);
    add(std::make_unique<PlaneObservationFactor>(keyframe(i), WallId{at(w)}, measured,
                                                 information.asDiagonal().toDenseMatrix()),
        {i, static_cast<int>(truth.size()) + w});
  }

  /// @param ends  Variables as problem() numbers them: keyframes, then walls.
  void add(std::unique_ptr<Factor> factor, const std::vector<int>& ends) {
    factors.push_back(std::move(factor));
    this->ends.push_back(ends);
  }

  /// All factors, the variables disturbed from the truth; the first keyframe exact and fixed.
  Problem problem(double disturbed_m = 0.3, double disturbed_rad = 0.1, bool fix_first = true) const {
    RandomGeometry random(99);
    Problem problem;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Pose T = i == 0 ? truth[i] : truth[i] * random.smallPose(disturbed_m, disturbed_rad);
      problem.addVariable(KeyframeId{i}, T, fix_first && i == 0);
    }
    for (std::size_t w = 0; w < walls.size(); ++w) {
      problem.addVariable(WallId{w},
                          retract(walls[w], PlaneTangent(random.vector(disturbed_rad))));
    }
    for (std::size_t f = 0; f < factors.size(); ++f) problem.addFactor(*factors[f], ends[f].data());
    return problem;
  }

  double worstPosition_m(const Problem& problem) const {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Vector3d t = problem.pose(static_cast<int>(i)).translation();
      worst_m = std::max(worst_m, (t - truth[i].translation()).norm());
    }
    return worst_m;
  }

  std::vector<Pose> truth;
  std::vector<Plane> walls;
  std::vector<std::unique_ptr<Factor>> factors;
  std::vector<std::vector<int>> ends;

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  static KeyframeId keyframe(int i) { return KeyframeId{static_cast<uint64_t>(i)}; }

  static Pose truePose(int i) {
    const double turn = 2.0 * M_PI * i / kStepsARound;
    Pose T = Pose::Identity();
    T.translation() << 10.0 * std::cos(turn), 10.0 * std::sin(turn), 0.02 * i;
    T.linear() = expSO3({0.0, 0.0, turn + M_PI_2});
    return T;
  }

  RandomGeometry random_;
  double noise_;
};

}  // namespace mrpt_sgraphs::test
