// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "stamp_matcher.h"
#include "stamp_order.h"

namespace mrpt_sgraphs {
namespace {

using Matcher = StampMatcher<std::string, int>;

TEST(StampMatcher, BringsThemTogetherWhicheverComesFirst) {
  Matcher matcher;
  EXPECT_FALSE(matcher.addFirst(10, "a"));
  EXPECT_FALSE(matcher.addSecond(20, 2));
  EXPECT_EQ(matcher.addSecond(10, 1), (Matcher::Pair{"a", 1}));
  EXPECT_EQ(matcher.addFirst(20, "b"), (Matcher::Pair{"b", 2}));
}

TEST(StampMatcher, GivesEachPairOnce) {
  Matcher matcher;
  matcher.addFirst(10, "a");
  EXPECT_TRUE(matcher.addSecond(10, 1));
  EXPECT_FALSE(matcher.addSecond(10, 1));
}

TEST(StampMatcher, ForgetsTheOldestOfThoseWithoutAPartner) {
  Matcher matcher;
  for (std::uint64_t stamp = 0; stamp < 1000; ++stamp) matcher.addFirst(stamp, "a");
  EXPECT_FALSE(matcher.addSecond(0, 1));
  EXPECT_TRUE(matcher.addSecond(999, 1));
}

using Verdict = StampOrder::Verdict;

TEST(StampOrder, LetsNewerOnesPass) {
  StampOrder order;
  EXPECT_EQ(order.check(100.0), Verdict::kNext);
  EXPECT_EQ(order.check(100.1), Verdict::kNext);
  EXPECT_EQ(order.check(500.0), Verdict::kNext);
}

TEST(StampOrder, HoldsBackWhatComesTwiceOrLate) {
  StampOrder order;
  order.check(100.0);
  EXPECT_EQ(order.check(100.0), Verdict::kNotNewer);
  EXPECT_EQ(order.check(99.5), Verdict::kNotNewer);
  EXPECT_EQ(order.check(100.05), Verdict::kNext) << "the late one left no trace";
}

TEST(StampOrder, SeesABagThatStartsAgain) {
  StampOrder order;
  order.check(100.0);
  EXPECT_EQ(order.check(50.0), Verdict::kStartedAgain);
  EXPECT_EQ(order.check(50.1), Verdict::kNext);
}

TEST(StampOrder, TakesAFirstStampOfZero) {
  StampOrder order;
  EXPECT_EQ(order.check(0.0), Verdict::kNext);
  EXPECT_EQ(order.check(0.0), Verdict::kNotNewer);
}

}  // namespace
}  // namespace mrpt_sgraphs
