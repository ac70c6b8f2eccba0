// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "topic_watchdog.h"

namespace mrpt_sgraphs {
namespace {

constexpr char kCloud[] = "sensor_msgs/PointCloud2";
constexpr char kOwn[] = "/sgraphs/manager";

TEST(DescribeSilence, SaysThatNobodyPublishes) {
  EXPECT_EQ(describeSilence("/points", kCloud, {}, kOwn),
            "Nothing arrives on '/points' (sensor_msgs/PointCloud2): nobody publishes it.");
}

TEST(DescribeSilence, NamesTheWrongType) {
  const std::vector<PublishedTopic> published{{"/points", "sensor_msgs/LaserScan", {"/driver"}}};
  EXPECT_EQ(describeSilence("/points", kCloud, published, kOwn),
            "Nothing arrives on '/points' (sensor_msgs/PointCloud2): /driver publishes it as "
            "sensor_msgs/LaserScan.");
}

TEST(DescribeSilence, SaysThatAPublisherHasSentNothing) {
  const std::vector<PublishedTopic> published{{"/points", kCloud, {"/driver", "/player"}}};
  EXPECT_EQ(describeSilence("/points", kCloud, published, kOwn),
            "Nothing arrives on '/points' (sensor_msgs/PointCloud2): /driver, /player publishes "
            "it, but has sent nothing yet.");
}

TEST(DescribeSilence, NamesUpToThreeTopicsOfTheTypeButNoneOfItsOwn) {
  const std::vector<PublishedTopic> published{{"/a", kCloud, {"/driver"}},
                                              {"/b", kCloud, {"/driver"}},
                                              {"/sgraphs/points_filtered", kCloud, {kOwn}},
                                              {"/scan", "sensor_msgs/LaserScan", {"/driver"}},
                                              {"/c", kCloud, {"/driver"}},
                                              {"/d", kCloud, {"/driver"}}};
  const std::string text = describeSilence("/points", kCloud, published, kOwn);
  EXPECT_NE(text.find(" Topics of this type: /a, /b, /c."), std::string::npos) << text;
}

}  // namespace
}  // namespace mrpt_sgraphs
