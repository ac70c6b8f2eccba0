// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_cells.h"

#include <limits>
#include <numeric>

#include "mrpt_sgraphs/geometry/cell_key.h"

namespace mrpt_sgraphs {
namespace {

using Key = CellKey;
using Index3 = Eigen::Vector3i;

Key keyOf(const Index3& index) { return cellKey(index.x(), index.y(), index.z()); }

/// The cell of a point that is given in edges; rounding may put it into the next one.
Index3 indexAt(const Eigen::Vector3f& p) {
  // to integers by truncation of what is positive: floor() is a call for every coordinate
  constexpr float kShift = 8192.0F;
  const Eigen::Vector3f shifted = (p.array() + kShift).max(0.0F).min(2.0F * kShift);
  return shifted.cast<int>().array() - static_cast<int>(kShift);
}

Key parentKey(Key key) {
  const auto [x, y, z] = cellIndexOf(key);
  return cellKey(x >> 1, y >> 1, z >> 1);
}

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

/// Numbers keys in the order in which they first come.
class PlaneCells::KeyNumbers {
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

PlaneCells::PlaneCells(const Cloud& cloud, double finest_m) {
  joinIntoCoarser(sortIntoFinest(cloud, finest_m));
}

PlaneCells::KeyNumbers PlaneCells::sortIntoFinest(const Cloud& cloud, double finest_m) {
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
  levels_[0].reserve(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const auto [x, y, z] = cellIndexOf(numbers.keys()[c]);
    const Eigen::Vector3f corner = Index3(x, y, z).cast<float>();
    const Eigen::Vector3f centre = (corner.array() + 0.5F).matrix() * edge_m;
    levels_[0].push_back(sums[c].about(centre.cast<double>()));
  }
  return numbers;
}

void PlaneCells::joinIntoCoarser(const KeyNumbers& finest) {
  std::vector<int> cell_of_finest(finest.keys().size());
  std::iota(cell_of_finest.begin(), cell_of_finest.end(), 0);
  listRuns(0, cell_of_finest);
  std::vector<Key> keys = finest.keys();
  for (std::size_t level = 1; level < kLevels; ++level) {
    KeyNumbers numbers(keys.size() / 2);
    std::vector<int> parents;
    parents.reserve(keys.size());
    for (const Key key : keys) parents.push_back(numbers.numberOf(parentKey(key)));
    levels_[level].resize(numbers.keys().size());
    for (std::size_t c = 0; c < keys.size(); ++c) {
      levels_[level][static_cast<std::size_t>(parents[c])] += levels_[level - 1][c];
    }
    for (int& cell : cell_of_finest) cell = parents[static_cast<std::size_t>(cell)];
    listRuns(level, cell_of_finest);
    if (level == kNeighbourLevel) {
      cell_of_neighbour_level_ = cell_of_finest;
      findNeighbours(numbers);
    }
    keys = numbers.keys();
  }
}

void PlaneCells::listRuns(std::size_t level, const std::vector<int>& cell_of_finest) {
  // a counting sort
  std::vector<int>& begins = run_begins_[level];
  begins.assign(levels_[level].size() + 1, 0);
  for (const int cell : cell_of_finest) ++begins[static_cast<std::size_t>(cell) + 1];
  for (std::size_t c = 1; c < begins.size(); ++c) begins[c] += begins[c - 1];
  std::vector<int> next(begins.begin(), begins.end() - 1);
  runs_[level].resize(cell_of_finest.size());
  for (std::size_t c = 0; c < cell_of_finest.size(); ++c) {
    int& place = next[static_cast<std::size_t>(cell_of_finest[c])];
    runs_[level][static_cast<std::size_t>(place++)] = static_cast<int>(c);
  }
}

void PlaneCells::findNeighbours(const KeyNumbers& numbers) {
  constexpr std::size_t kMost = 26;
  neighbours_.reserve(kMost * numbers.keys().size());
  neighbour_begins_.reserve(numbers.keys().size() + 1);
  for (const Key key : numbers.keys()) {
    const auto [x, y, z] = cellIndexOf(key);
    const Index3 index(x, y, z);
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
