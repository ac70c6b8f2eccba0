// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mrpt_sgraphs/graph/shared_vector.h"

namespace mrpt_sgraphs {
namespace {

using Numbers = SharedVector<int, 4>;

Numbers countedTo(int count) {
  Numbers numbers;
  for (int k = 0; k < count; ++k) numbers.push_back(k);
  return numbers;
}

std::vector<int> contents(const Numbers& numbers) { return {numbers.begin(), numbers.end()}; }

TEST(SharedVector, IsAVector) {
  std::mt19937 random(1);
  Numbers numbers;
  std::vector<int> model;
  for (int k = 0; k < 5000; ++k) {
    const auto place = model.empty() ? 0 : random() % model.size();
    switch (model.empty() ? 0U : random() % (k < 2500 ? 5U : 3U)) {
      case 1:
        numbers.erase(place);
        model.erase(model.begin() + static_cast<std::ptrdiff_t>(place));
        break;
      case 2:
        numbers.pop_back();
        model.pop_back();
        break;
      case 3:
        numbers.edit(place) = k;
        model[place] = k;
        break;
      default:
        numbers.push_back(k);
        model.push_back(k);
    }
    ASSERT_EQ(contents(numbers), model);
    ASSERT_EQ(numbers.empty(), model.empty());
    ASSERT_EQ(numbers.chunkCount(), (model.size() + 3) / 4);
  }
}

TEST(SharedVector, IsWalkedByTheAlgorithmsOfTheLibrary) {
  const Numbers numbers = countedTo(23);
  EXPECT_EQ(*std::lower_bound(numbers.begin(), numbers.end(), 17), 17);
  EXPECT_EQ(numbers.end() - numbers.begin(), 23);
  EXPECT_EQ(*std::prev(numbers.end()), 22);
  EXPECT_EQ(numbers.begin()[9], 9);
  EXPECT_EQ(numbers.front(), 0);
  EXPECT_EQ(numbers.back(), 22);
}

TEST(SharedVector, CopiesShareAllUntilOneWrites) {
  Numbers numbers = countedTo(20);
  const Numbers copy = numbers;
  EXPECT_EQ(copy.chunksSharedWith(numbers), 5U);
  numbers.edit(9) = -1;
  numbers.edit(10) = -2;
  EXPECT_EQ(copy.chunksSharedWith(numbers), 4U) << "the two numbers lie in one chunk";
  EXPECT_EQ(contents(copy), contents(countedTo(20)));
  EXPECT_EQ(numbers[9], -1);
}

TEST(SharedVector, AddingClonesTheLastChunkAlone) {
  Numbers numbers = countedTo(18);
  const Numbers copy = numbers;
  numbers.push_back(18);
  EXPECT_EQ(copy.chunksSharedWith(numbers), 4U);
  EXPECT_EQ(copy.size(), 18U);
  EXPECT_EQ(contents(numbers), contents(countedTo(19)));
}

/// Counts how often it is copied.
struct Counted {
  Counted() = default;
  Counted(const Counted&) { ++copies; }
  Counted(Counted&&) = default;
  Counted& operator=(const Counted&) = default;
  Counted& operator=(Counted&&) = default;
  static int copies;
};
int Counted::copies = 0;

TEST(SharedVector, CopiesNoElementToBeCopiedAndAChunkToBeWritten) {
  SharedVector<Counted, 8> elements;
  for (int k = 0; k < 80; ++k) elements.push_back({});
  Counted::copies = 0;
  {
    const auto copy = elements;
    EXPECT_EQ(Counted::copies, 0);
    elements.edit(33);
    elements.edit(34);
    EXPECT_EQ(Counted::copies, 8);
  }
  elements.edit(50);
  EXPECT_EQ(Counted::copies, 8) << "the copy is gone: it is ours alone";
}

}  // namespace
}  // namespace mrpt_sgraphs
