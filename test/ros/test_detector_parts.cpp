// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
// What the nodelets of the detectors are made of.
#include <gtest/gtest.h>

#include <cstddef>
#include <future>
#include <vector>

#include "graph_news.h"
#include "keyframe_clouds.h"
#include "mrpt_sgraphs/ros/conversions.h"
#include "newest_worker.h"
#include "some_rooms.h"

namespace mrpt_sgraphs {
namespace {

TEST(NewestWorker, SkipsWhatIsOlderThanTheNewestWhileItWorks) {
  std::promise<void> begun;
  std::promise<void> may_go_on;
  std::promise<void> done;
  std::vector<int> worked_on;
  NewestWorker<int> worker([&](const int& job) {
    worked_on.push_back(job);
    if (job == 1) {
      begun.set_value();
      may_go_on.get_future().wait();
    } else {
      done.set_value();
    }
  });
  worker.put(1);
  begun.get_future().wait();
  for (const int job : {2, 3, 4}) worker.put(job);  // returns, though 1 is not done
  may_go_on.set_value();
  done.get_future().wait();
  EXPECT_EQ(worked_on, (std::vector<int>{1, 4}));
  EXPECT_EQ(worker.skipped(), 2U);
}

TEST(NewestWorker, EndsWhetherItEverHadAJobOrNot) {
  {
    NewestWorker<int> idle([](const int&) {});
  }
  std::promise<void> begun;
  std::vector<int> worked_on;
  {
    NewestWorker<int> busy([&](const int& job) {
      worked_on.push_back(job);
      if (job == 1) begun.set_value();
    });
    busy.put(1);
    begun.get_future().wait();
  }
  EXPECT_EQ(worked_on, std::vector<int>{1});
}

class GraphNewsTest : public ::testing::Test {
 protected:
  SituationalGraph graph_ = toMsg(test::twoRoomsOnTwoFloors(), "map");
  GraphNews keyframes_{GraphNews::Of::kKeyframes};
  GraphNews floors_{GraphNews::Of::kKeyframesAndTheirFloors};

  void expectNews(bool of_keyframes, bool of_floors) {
    EXPECT_EQ(keyframes_.isNew(graph_), of_keyframes);
    EXPECT_EQ(floors_.isNew(graph_), of_floors);
  }
};

TEST_F(GraphNewsTest, KeyframesAreNewToAll) {
  expectNews(true, true);
  graph_.keyframes.push_back(graph_.keyframes.back());
  graph_.keyframes.back().id = 77;
  expectNews(true, true);
  expectNews(false, false);
}

TEST_F(GraphNewsTest, RoomsAndPosesAreNewToNone) {
  expectNews(true, true);
  graph_.rooms.pop_back();
  graph_.keyframes[0].room = 3;
  graph_.keyframes[0].pose.position.x += 1.0;
  expectNews(false, false);
}

TEST_F(GraphNewsTest, FloorsOfKeyframesAreNewToTheRooms) {
  expectNews(true, true);
  graph_.keyframes[2].floor = 0;
  expectNews(false, true);
}

TEST_F(GraphNewsTest, AnotherSessionIsNewThoughItLooksTheSame) {
  expectNews(true, true);
  ++graph_.session;
  expectNews(true, true);
}

Cloud::ConstPtr cloudOf(double stamp_s) {
  const Cloud::Ptr cloud(new Cloud);
  cloud->header.stamp = toPclStamp(stamp_s);
  return cloud;
}

class KeyframeCloudsTest : public ::testing::Test {
 protected:
  GraphSnapshot graph_ = test::threeKeyframes();  // 0.1 s apart
  KeyframeClouds clouds_;
  std::vector<Cloud::ConstPtr> given_;

  /// For keyframe `number`, or for the one that would be.
  void give(int number) {
    given_.push_back(cloudOf(graph_.keyframes[0].stamp_s + 0.1 * number));
    clouds_.add(given_.back());
  }
};

TEST_F(KeyframeCloudsTest, EachKeyframeGetsTheVeryCloudOfItsStamp) {
  for (const int number : {0, 1, 2, 3}) give(number);
  ASSERT_TRUE(clouds_.attachTo(&graph_));
  ASSERT_EQ(graph_.keyframes.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(graph_.keyframes[k].cloud, given_[k]);
}

TEST_F(KeyframeCloudsTest, AKeyframeWhoseCloudWasLostIsLeftOut) {
  for (const int number : {0, 2}) give(number);
  ASSERT_TRUE(clouds_.attachTo(&graph_));
  ASSERT_EQ(graph_.keyframes.size(), 2U);
  EXPECT_EQ(graph_.keyframes[1].id, KeyframeId{2});
}

TEST_F(KeyframeCloudsTest, WithoutTheNewestCloudNothingIsDone) {
  for (const int number : {0, 1}) give(number);
  EXPECT_FALSE(clouds_.attachTo(&graph_));
  EXPECT_EQ(graph_.keyframes.size(), 3U);
  EXPECT_EQ(graph_.keyframes[0].cloud, nullptr);
  GraphSnapshot empty;
  EXPECT_FALSE(clouds_.attachTo(&empty));
}

TEST_F(KeyframeCloudsTest, ForgetsWhatIsOfNoKeyframeAndKeepsWhatMayStillBe) {
  for (const int number : {-1, 0, 1, 2, 3}) give(number);
  ASSERT_TRUE(clouds_.attachTo(&graph_));
  constexpr long kHereAlone = 1;
  EXPECT_EQ(given_.front().use_count(), kHereAlone);
  for (std::size_t k = 1; k < given_.size(); ++k) EXPECT_GT(given_[k].use_count(), kHereAlone) << k;
}

TEST_F(KeyframeCloudsTest, BeginsAnewWhenTimeStartsAgain) {
  for (const int number : {0, 1, 2, -5}) give(number);
  EXPECT_FALSE(clouds_.attachTo(&graph_)) << "of the time before";
  for (const int number : {0, 1, 2}) give(number);
  EXPECT_TRUE(clouds_.attachTo(&graph_));
}

}  // namespace
}  // namespace mrpt_sgraphs
