// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "scan_gate.h"

namespace mrpt_sgraphs {
namespace {

using Gate = ScanGate<int>;

TEST(ScanGate, LetsAScanPassAtOnceWithoutSensors) {
  Gate gate;
  gate.push(1, 100.0, 100.1);
  EXPECT_EQ(gate.pop(), 1);
  EXPECT_FALSE(gate.pop());
}

TEST(ScanGate, WaitsUntilTheImuCoversTheSweep) {
  Gate gate;
  gate.imuReached(99.99);
  gate.push(1, 100.0, 100.1);
  EXPECT_FALSE(gate.pop());
  gate.imuReached(100.09);
  EXPECT_FALSE(gate.pop());
  gate.imuReached(100.1);
  EXPECT_EQ(gate.pop(), 1);
}

TEST(ScanGate, WaitsForOdometryOnlyUntilTheStamp) {
  Gate gate;
  gate.odomReached(99.95);
  gate.push(1, 100.0, 100.1);
  EXPECT_FALSE(gate.pop());
  gate.odomReached(100.0);
  EXPECT_EQ(gate.pop(), 1);
}

TEST(ScanGate, DoesNotWaitForASensorThatFellSilent) {
  Gate gate;
  gate.imuReached(90.0);
  gate.push(1, 100.0, 100.1);
  EXPECT_EQ(gate.pop(), 1);
}

TEST(ScanGate, WaitsNoLongerThanUntilTheNextScan) {
  Gate gate;
  gate.imuReached(99.9);
  gate.push(1, 100.0, 100.1);
  gate.push(2, 100.1, 100.2);
  EXPECT_EQ(gate.pop(), 1);
  EXPECT_FALSE(gate.pop());
}

TEST(ScanGate, WaitsNoLongerThanATenthOfASecondOfTheOtherSensor) {
  Gate gate;
  gate.imuReached(99.9);
  gate.push(1, 100.0, 100.1);
  gate.odomReached(100.15);
  EXPECT_FALSE(gate.pop());
  gate.odomReached(100.21);
  EXPECT_EQ(gate.pop(), 1);
}

TEST(ScanGate, WaitsNoLongerThanTwoTicks) {
  Gate gate;
  gate.imuReached(99.9);
  gate.push(1, 100.0, 100.1);
  gate.tick();
  EXPECT_FALSE(gate.pop());
  gate.tick();
  EXPECT_EQ(gate.pop(), 1);
}

}  // namespace
}  // namespace mrpt_sgraphs
