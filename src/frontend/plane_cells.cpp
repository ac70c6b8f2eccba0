// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_cells.h"

#include <limits>

namespace mrpt_sgraphs {
namespace {

using Key = std::uint64_t;

/// 21 bits an axis, shifted to be positive: a million cells to each side.
constexpr int kBits = 21;
constexpr int kOffset = 1 << (kBits - 1);
constexpr Key kMask = (Key{1} << kBits) - 1;

using Index3 = Eigen::Vector3i;

Key keyOf(const Index3& index) {
  return (static_cast<Key>(index.x() + kOffset) & kMask) |
         (static_cast<Key>(index.y() + kOffset) & kMask) << kBits |
         (static_cast<Key>(index.z() + kOffset) & kMask) << (2 * kBits);
}

Index3 indexOf(Key key) {
  return {static_cast<int>(key & kMask) - kOffset,
          static_cast<int>(key >> kBits & kMask) - kOffset,
          static_cast<int>(key >> (2 * kBits) & kMask) - kOffset};
}

/// The cell of a point that is given in edges; rounding may put it into the next one.
Index3 indexAt(const Eigen::Vector3f& p) {
  // to integers by truncation of what is positive: floor() is a call for every coordinate
  constexpr float kShift = 8192.0F;
  const Eigen::Vector3f shifted = (p.array() + kShift).max(0.0F).min(2.0F * kShift);
  return shifted.cast<int>().array() - static_cast<int>(kShift);
}

Key parentKey(Key key) {
  const Index3 index = indexOf(key);
  return keyOf({index.x() >> 1, index.y() >> 1, index.z() >> 1});
}

/// Numbers keys in the order in which they first come.
class KeyNumbers {
 public:
  explicit KeyNumbers(std::size_t expected) {
    std::size_t slots = 64;
    while (slots < 2 * expected) slots *= 2;
    slots_.resize(slots, Slot{0, kNone});
  }

  int numberOf(Key key) {
    std::size_t at = slotOf(key);
    if (slots_[at].number != kNone) return slots_[at].number;
    if (2 * keys_.size() >= slots_.size()) {
      grow();
      at = slotOf(key);
    }
    slots_[at] = {key, static_cast<int>(keys_.size())};
    keys_.push_back(key);
    return slots_[at].number;
  }

  /// -1 if it has none.
  int find(Key key) const { return slots_[slotOf(key)].number; }

  const std::vector<Key>& keys() const { return keys_; }

 private:
  static constexpr int kNone = -1;
  struct Slot {
    Key key;
    int number;
  };

  std::size_t slotOf(Key key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32U) & mask;
    while (slots_[at].number != kNone && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), Slot{0, kNone});
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      slots_[slotOf(keys_[k])] = {keys_[k], static_cast<int>(k)};
    }
  }

  std::vector<Slot> slots_;
  std::vector<Key> keys_;
};

/// Sums about the centre of a cell: short enough for single precision.
struct CellSums {
  std::array<float, 10> values{};

  void add(const Eigen::Vector3f& p) {
    values[0] += 1.0F;
    for (std::size_t k = 0; k < 3; ++k) values[1 + k] += p[static_cast<int>(k)];
    for (std::size_t k = 0; k < 6; ++k) {
      values[4 + k] += p[Scatter::kPairs[k].first] * p[Scatter::kPairs[k].second];
    }
  }

  Scatter about(const Eigen::Vector3d& centre) const {
    std::array<double, 6> products{};
    for (std::size_t k = 0; k < 6; ++k) products[k] = values[4 + k];
    return Scatter::about(centre, values[0], {values[1], values[2], values[3]}, products);
  }
};

}  // namespace

PlaneCells::PlaneCells(const Cloud& cloud, double finest_m) {
  sortIntoFinest(cloud, finest_m);
  joinIntoCoarser();
  findNeighbours();
}

void PlaneCells::sortIntoFinest(const Cloud& cloud, double finest_m) {
  constexpr std::size_t kPointsInCell = 8;
  KeyNumbers numbers(cloud.size() / kPointsInCell);
  std::vector<CellSums> sums;
  sums.reserve(cloud.size() / kPointsInCell);
  cell_of_point_.resize(cloud.size());
  const float edge_m = static_cast<float>(finest_m);
  const float inverse_edge = 1.0F / edge_m;
  // The points of one beam follow each other in space: most lie in the cell of its last one.
  struct Last {
    Key key = std::numeric_limits<Key>::max();
    int cell = 0;
  };
  constexpr std::size_t kBeams = 256;
  std::array<Last, kBeams> last_of_beam;
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const Eigen::Vector3f p = cloud[k].getVector3fMap();
    const Index3 index = indexAt(p * inverse_edge);
    const Key key = keyOf(index);
    Last& last = last_of_beam[cloud[k].ring % kBeams];
    if (key != last.key) {
      last = {key, numbers.numberOf(key)};
      if (static_cast<std::size_t>(last.cell) == sums.size()) sums.emplace_back();
    }
    sums[static_cast<std::size_t>(last.cell)].add(p - (index.cast<float>().array() + 0.5F).matrix() * edge_m);
    cell_of_point_[k] = last.cell;
  }
  keys_ = numbers.keys();
  levels_[0].reserve(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const Eigen::Vector3f corner = indexOf(keys_[c]).cast<float>();
    const Eigen::Vector3f centre = (corner.array() + 0.5F).matrix() * edge_m;
    levels_[0].push_back(sums[c].about(centre.cast<double>()));
  }
}

void PlaneCells::joinIntoCoarser() {
  std::vector<Key> keys = keys_;
  std::vector<int> cell_of_finest(keys_.size());
  for (std::size_t c = 0; c < keys_.size(); ++c) cell_of_finest[c] = static_cast<int>(c);
  for (std::size_t level = 0; level < kLevels; ++level) {
    if (level > 0) {
      KeyNumbers numbers(keys.size() / 2);
      std::vector<int>& parents = parents_[level - 1];
      parents.reserve(keys.size());
      for (const Key key : keys) parents.push_back(numbers.numberOf(parentKey(key)));
      levels_[level].resize(numbers.keys().size());
      for (std::size_t c = 0; c < keys.size(); ++c) {
        levels_[level][static_cast<std::size_t>(parents[c])] += levels_[level - 1][c];
      }
      for (int& cell : cell_of_finest) cell = parents[static_cast<std::size_t>(cell)];
      keys = numbers.keys();
    }
    if (level == kNeighbourLevel) neighbour_level_keys_ = keys;

    // counting sort of the finest cells by their cell of this level
    std::vector<int>& begins = run_begins_[level];
    begins.assign(keys.size() + 1, 0);
    for (const int cell : cell_of_finest) ++begins[static_cast<std::size_t>(cell) + 1];
    for (std::size_t c = 1; c < begins.size(); ++c) begins[c] += begins[c - 1];
    std::vector<int> next(begins.begin(), begins.end() - 1);
    runs_[level].resize(cell_of_finest.size());
    for (std::size_t c = 0; c < cell_of_finest.size(); ++c) {
      int& place = next[static_cast<std::size_t>(cell_of_finest[c])];
      runs_[level][static_cast<std::size_t>(place++)] = static_cast<int>(c);
    }
  }
}

void PlaneCells::findNeighbours() {
  KeyNumbers numbers(neighbour_level_keys_.size());
  for (const Key key : neighbour_level_keys_) numbers.numberOf(key);
  constexpr std::size_t kMost = 26;
  neighbours_.reserve(kMost * neighbour_level_keys_.size());
  neighbour_begins_.reserve(neighbour_level_keys_.size() + 1);
  for (std::size_t c = 0; c < neighbour_level_keys_.size(); ++c) {
    const Index3 index = indexOf(neighbour_level_keys_[c]);
    neighbour_begins_.push_back(static_cast<int>(neighbours_.size()));
    for (int n = 0; n < 27; ++n) {
      const Index3 step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const int neighbour = step.isZero() ? -1 : numbers.find(keyOf(index + step));
      if (neighbour >= 0) neighbours_.push_back(neighbour);
    }
  }
  neighbour_begins_.push_back(static_cast<int>(neighbours_.size()));
}

PlaneCells::Run PlaneCells::finestIn(int level, int cell) const {
  const std::vector<int>& begins = run_begins_[static_cast<std::size_t>(level)];
  const int* const run = runs_[static_cast<std::size_t>(level)].data();
  return {run + begins[static_cast<std::size_t>(cell)],
          run + begins[static_cast<std::size_t>(cell) + 1]};
}

}  // namespace mrpt_sgraphs
