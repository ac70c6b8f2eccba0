// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "levmarq.h"
#include "mrpt_sgraphs/hierarchy/network_optimizer.h"
#include "support/mrpt_networks.h"

namespace mrpt_sgraphs {
namespace {

/// Both from the same start, both minimizing the same sum: informations as MRPT's optimizer takes
/// them.
struct Costs {
  double start = 0.0;
  double theirs = 0.0;
  double ours = 0.0;
};

Costs compare(const MrptNetwork& start) {
  constexpr auto kMeaning = MrptInformation::kTangent;
  Costs costs;
  costs.start = networkCost(start, kMeaning);

  MrptNetwork theirs = start;
  test::optimizeWithMrpt(&theirs);
  costs.theirs = networkCost(theirs, kMeaning);

  MrptNetwork ours = start;
  OptimizerConfig config;
  config.max_iterations = 200;
  config.min_relative_decrease = 1e-10;
  const OptimizerReport report = optimizeNetwork(config, &ours, nullptr, kMeaning);
  EXPECT_TRUE(report.converged) << report.problem;
  costs.ours = networkCost(ours, kMeaning);
  EXPECT_NEAR(costs.start, report.cost_before, 1e-9 * costs.start);
  EXPECT_NEAR(costs.ours, report.cost_after, 1e-6 * costs.ours);
  return costs;
}

TEST(NetworkAgainstMrpt, OurOptimumIsNeverAboveMrpts) {
  constexpr double kRounding = 1e-9;
  int mrpt_stops_early = 0;
  int agree = 0;
  for (const test::WalkNoise& noise :
       {test::WalkNoise{0.02, 0.005}, test::WalkNoise{0.1, 0.05}, test::WalkNoise{0.3, 0.15}}) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(testing::Message() << "noise " << noise.rotation_rad << ", seed " << seed);
      const Costs costs = compare(test::circlingWalk(seed, 60, noise));
      EXPECT_LE(costs.ours, costs.theirs * (1.0 + kRounding));
      EXPECT_LT(costs.ours, 0.5 * costs.start);
      if (costs.theirs > 1.001 * costs.ours) ++mrpt_stops_early;
      if (costs.theirs < 1.000001 * costs.ours) ++agree;
    }
  }
  EXPECT_GT(mrpt_stops_early, 0) << "no graph shows that ours goes on where MRPT stops";
  EXPECT_GT(agree, 0) << "no graph shows that both mean the same sum";
}

}  // namespace
}  // namespace mrpt_sgraphs
