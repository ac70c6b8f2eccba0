// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stamp_matcher.h"
#include "stamp_order.h"

namespace mrpt_sgraphs {
namespace {

using Matcher = StampMatcher<std::string, int>;
using ThreeMatcher = StampMatcher<int, int, int>;

TEST(StampMatcher, BringsThemTogetherWhicheverComesFirst) {
  Matcher matcher;
  EXPECT_FALSE(matcher.add<0>(10, "a"));
  EXPECT_FALSE(matcher.add<1>(20, 2));
  EXPECT_EQ(matcher.add<1>(10, 1), (Matcher::Set{"a", 1}));
  EXPECT_EQ(matcher.add<0>(20, "b"), (Matcher::Set{"b", 2}));
  EXPECT_EQ(matcher.waiting(), 0U);
}

TEST(StampMatcher, GivesEachSetOnce) {
  Matcher matcher;
  matcher.add<0>(10, "a");
  EXPECT_TRUE(matcher.add<1>(10, 1));
  EXPECT_FALSE(matcher.add<1>(10, 1));
}

TEST(StampMatcher, ForgetsTheOldestOfThoseWithoutAPartner) {
  Matcher matcher;
  for (std::uint64_t stamp = 0; stamp < 1000; ++stamp) matcher.add<0>(stamp, "a");
  EXPECT_FALSE(matcher.add<1>(0, 1));
  EXPECT_TRUE(matcher.add<1>(999, 1));
}

/// Takes the next message of a kind: its stamp is the message. Gives the stamp of a set if it
/// completes one.
std::optional<std::uint64_t> addNext(ThreeMatcher* matcher, int kind, std::array<int, 3>* next) {
  const int stamp = (*next)[static_cast<std::size_t>(kind)]++;
  const auto stamp_us = static_cast<std::uint64_t>(stamp);
  const auto set = kind == 0   ? matcher->add<0>(stamp_us, stamp)
                   : kind == 1 ? matcher->add<1>(stamp_us, stamp)
                               : matcher->add<2>(stamp_us, stamp);
  if (!set) return std::nullopt;
  EXPECT_EQ(*set, (ThreeMatcher::Set{stamp, stamp, stamp}));
  return stamp_us;
}

TEST(StampMatcher, CompletesSetsInTheirOrderHoweverTheKindsOvertakeEachOther) {
  std::vector<int> kinds = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2};
  int orders = 0;
  do {
    ThreeMatcher matcher;
    std::array<int, 3> next{0, 0, 0};
    std::vector<std::uint64_t> completed;
    for (const int kind : kinds) {
      if (const auto stamp = addNext(&matcher, kind, &next)) completed.push_back(*stamp);
    }
    ASSERT_EQ(completed, (std::vector<std::uint64_t>{0, 1, 2, 3}));
    ++orders;
  } while (std::next_permutation(kinds.begin(), kinds.end()));
  EXPECT_EQ(orders, 34650) << "12! / (4!)^3";
}

TEST(StampMatcher, HandsOutWhatWillNotBeCompleteAnyMore) {
  Matcher matcher;
  matcher.add<0>(10, "a");
  matcher.add<1>(20, 2);
  matcher.add<0>(30, "c");
  const auto older = matcher.takeIncompleteBefore(30);
  ASSERT_EQ(older.size(), 2U);
  EXPECT_EQ(older[0], (Matcher::Parts{"a", std::nullopt}));
  EXPECT_EQ(older[1], (Matcher::Parts{std::nullopt, 2}));
  EXPECT_FALSE(matcher.add<0>(20, "b")) << "its partner was handed out";
  EXPECT_TRUE(matcher.add<1>(30, 3));
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
