// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mrpt_sgraphs/factors/floor_rooms.h"

namespace mrpt_sgraphs {
namespace {

using Kind = RobustKernel::Kind;

class RobustKernelTest : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, RobustKernelTest,
                         ::testing::Values(Kind::kNone, Kind::kHuber, Kind::kCauchy));

TEST_P(RobustKernelTest, WeightIsTheSlopeOfTheCost) {
  for (const double width : {0.5, 4.0, 100.0}) {
    const RobustKernel kernel{GetParam(), width};
    for (const double chi2 : {1e-3, 0.1, 0.4, 0.6, 3.0, 5.0, 90.0, 110.0, 1e4, 1e8}) {
      const double step = 1e-5 * chi2;
      const double slope = (kernel.cost(chi2 + step) - kernel.cost(chi2 - step)) / (2.0 * step);
      EXPECT_NEAR(kernel.weight(chi2), slope, 1e-6 * (1.0 + slope)) << width << ' ' << chi2;
    }
  }
}

TEST_P(RobustKernelTest, CostAndWeightAreContinuousAtTheWidth) {
  const RobustKernel kernel{GetParam(), 4.0};
  EXPECT_NEAR(kernel.cost(4.0 - 1e-12), kernel.cost(4.0 + 1e-12), 1e-11);
  EXPECT_NEAR(kernel.weight(4.0 - 1e-12), kernel.weight(4.0 + 1e-12), 1e-11);
}

TEST_P(RobustKernelTest, BelievesWhatIsSmall) {
  const RobustKernel kernel{GetParam(), 4.0};
  EXPECT_EQ(kernel.cost(0.0), 0.0);
  EXPECT_EQ(kernel.weight(0.0), 1.0);
  EXPECT_NEAR(kernel.cost(1e-6), 1e-6, 1e-12);
}

TEST_P(RobustKernelTest, WeightNeverGrows) {
  const RobustKernel kernel{GetParam(), 4.0};
  for (double chi2 = 0.0; chi2 < 50.0; chi2 += 0.5) {
    EXPECT_LE(kernel.weight(chi2 + 0.5), kernel.weight(chi2));
    EXPECT_LT(kernel.cost(chi2), kernel.cost(chi2 + 0.5));
  }
}

TEST(RobustKernel, FarOutHuberGrowsLikeTheResidualAndCauchyLikeItsLogarithm) {
  const RobustKernel huber{Kind::kHuber, 4.0};
  EXPECT_NEAR(huber.cost(4e12) / huber.cost(1e12), 2.0, 1e-3);
  const RobustKernel cauchy{Kind::kCauchy, 4.0};
  EXPECT_NEAR(cauchy.cost(4e12) - cauchy.cost(1e12), 4.0 * std::log(4.0), 1e-6);
}

TEST(RobustKernel, AFactorWithAWidthThatIsNoneIsRefused) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double width : {0.0, -1.0, kInfinity, std::nan("")}) {
    for (const Kind kind : {Kind::kHuber, Kind::kCauchy}) {
      EXPECT_THROW(FloorRoomFactor(FloorId{0}, RoomId{0}, Eigen::Matrix3d::Identity(),
                                   RobustKernel{kind, width}),
                   std::invalid_argument);
    }
    EXPECT_NO_THROW(FloorRoomFactor(FloorId{0}, RoomId{0}, Eigen::Matrix3d::Identity(),
                                    RobustKernel{Kind::kNone, width}));
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
