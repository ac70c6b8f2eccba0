// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "mrpt_sgraphs/geometry/plane.h"

namespace mrpt_sgraphs {
namespace {

TEST(Plane, KeepsADirectionHoweverLongTheStep) {
  const Plane plane{{0.6, 0.0, 0.8}, 2.0};
  for (const double step : {1e-300, 1e-9, 1.0, 1e9, 1e155, 1e200, 1e300}) {
    const Plane moved = retract(plane, {step, -0.5 * step, 0.0});
    EXPECT_NEAR(moved.normal.norm(), 1.0, 1e-12) << step;
  }
}

}  // namespace
}  // namespace mrpt_sgraphs
