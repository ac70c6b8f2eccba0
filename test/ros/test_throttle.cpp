// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "throttle.h"

namespace mrpt_sgraphs {
namespace {

TEST(Throttle, LetsOneOfAKindPass) {
  Throttle throttle(1000.0);
  EXPECT_TRUE(throttle.passes("only 3 of 100 points"));
  EXPECT_FALSE(throttle.passes("only 17 of 100 points"));
  EXPECT_TRUE(throttle.passes("no field x"));
}

TEST(Throttle, LetsItPassAgainAfterItsPeriod) {
  Throttle throttle(0.0);
  EXPECT_TRUE(throttle.passes("a"));
  EXPECT_TRUE(throttle.passes("a"));
}

}  // namespace
}  // namespace mrpt_sgraphs
