// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/geometry/archive.h"

#include <gtest/gtest.h>

#include <limits>

namespace mrpt_sgraphs {
namespace {

struct Inner {
  double value = 0.0;
  std::string name;

  template <typename Archive>
  void archive(Archive& a) {
    a("value", value);
    a("name", name);
  }
  friend bool operator==(const Inner& a, const Inner& b) {
    return a.value == b.value && a.name == b.name;
  }
};

struct Outer {
  std::vector<Inner> list;
  std::map<int, std::optional<double>> map;
  std::unordered_map<uint64_t, std::vector<int>> table;
  std::set<int> set;
  std::vector<bool> bits;
  std::pair<bool, float> pair;
  Eigen::MatrixXd matrix;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::shared_ptr<const std::vector<Inner>> shared;
  std::shared_ptr<const std::vector<Inner>> same;
  std::shared_ptr<const Inner> part;
  std::shared_ptr<const Inner> nothing;

  template <typename Archive>
  void archive(Archive& a) {
    a("list", list);
    a("map", map);
    a("table", table);
    a("set", set);
    a("bits", bits);
    a("pair", pair);
    a("matrix", matrix);
    a("pose", pose);
    a("shared", shared);
    a("same", same);
    a("part", part);
    a("nothing", nothing);
  }
};

Outer example() {
  Outer outer;
  outer.list = {{0.1, "one"}, {-std::numeric_limits<double>::infinity(), ""}};
  outer.map = {{3, 0.3}, {-1, std::nullopt}};
  outer.table = {{7, {1, 2}}, {1ULL << 63U, {}}};
  outer.set = {5, 2};
  outer.bits = {true, false, true};
  outer.pair = {true, 0.1F};
  outer.matrix = Eigen::MatrixXd::Random(3, 2);
  outer.pose.translation() << 1.0 / 3.0, 2.0, 3.0;
  outer.shared = std::make_shared<const std::vector<Inner>>(outer.list);
  outer.same = outer.shared;
  outer.part = std::shared_ptr<const Inner>(outer.shared, &(*outer.shared)[1]);
  return outer;
}

std::string bytesOf(const Outer& outer) {
  ArchiveWriter writer;
  writer("outer", outer);
  return writer.bytes();
}

TEST(Archive, GivesBackWhatItWasGiven) {
  const Outer before = example();
  const std::string bytes = bytesOf(before);
  Outer after;
  ArchiveReader reader(bytes);
  reader("outer", after);
  reader.finish();
  EXPECT_EQ(after.list, before.list);
  EXPECT_EQ(after.map, before.map);
  EXPECT_EQ(after.table, before.table);
  EXPECT_EQ(after.set, before.set);
  EXPECT_EQ(after.bits, before.bits);
  EXPECT_EQ(after.pair, before.pair);
  EXPECT_TRUE(after.matrix == before.matrix);
  EXPECT_TRUE(after.pose.matrix() == before.pose.matrix());
  EXPECT_EQ(after.nothing, nullptr);
  EXPECT_EQ(bytesOf(after), bytes);
}

TEST(Archive, SharesWhatWasShared) {
  const std::string bytes = bytesOf(example());
  Outer after;
  ArchiveReader reader(bytes);
  reader("outer", after);
  EXPECT_EQ(*after.shared, example().list);
  EXPECT_EQ(after.same, after.shared);
  EXPECT_EQ(after.part.get(), &(*after.shared)[1]);
  after.shared.reset();
  after.same.reset();
  EXPECT_EQ(*after.part, example().list[1]);  // holds the list
}

TEST(Archive, RefersToWhatIsKnown) {
  const auto known = std::make_shared<const Inner>(Inner{4.0, "known"});
  ArchiveWriter writer;
  writer.know(known);
  writer("pointer", known);
  const auto other = std::make_shared<const Inner>(Inner{5.0, "other"});
  ArchiveReader reader(writer.bytes());
  reader.know(other);
  std::shared_ptr<const Inner> pointer;
  reader("pointer", pointer);
  EXPECT_EQ(pointer, other);
}

/// Bytes that end anywhere, or of which one is another, never do more than to be refused.
TEST(Archive, RefusesDamagedBytesAndSaysWhere) {
  const std::string bytes = bytesOf(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string cut = bytes.substr(0, size);
    Outer outer;
    ArchiveReader reader(cut);
    EXPECT_THROW(reader("outer", outer), ArchiveError) << size;
  }
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string damaged = bytes;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x15);
    Outer outer;
    ArchiveReader reader(damaged);
    try {
      reader("outer", outer);
      reader.finish();
    } catch (const ArchiveError&) {
    }
  }
  Outer outer;
  std::string damaged = bytes;
  damaged[1] = static_cast<char>(damaged[1] ^ 1);  // the mark of `list`
  ArchiveReader reader(damaged);
  try {
    reader("outer", outer);
    FAIL();
  } catch (const ArchiveError& error) {
    EXPECT_STREQ(error.what(), "byte 2 (outer.list): something else begins here");
  }
}

TEST(Archive, RefusesWhatIsLeftOver) {
  const std::string bytes = bytesOf(example()) + "x";
  Outer outer;
  ArchiveReader reader(bytes);
  reader("outer", outer);
  EXPECT_THROW(reader.finish(), ArchiveError);
}

}  // namespace
}  // namespace mrpt_sgraphs
