// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/geometry/point_cloud.h"
#include "mrpt_sgraphs/geometry/scatter.h"

namespace mrpt_sgraphs {

/// Points sorted into small cells of space, and these into coarser ones, each cell with the scatter
/// of its points: whether a plane takes a cell is then asked of a few numbers and not of its points.
class PlaneCells {
 public:
  static constexpr int kLevels = 4;  ///< Each with cells twice as large as the one below.
  static constexpr int kCoarsest = kLevels - 1;

  PlaneCells(const Cloud& cloud, double finest_m);

  std::size_t size(int level) const { return levels_[static_cast<std::size_t>(level)].size(); }
  const Scatter& scatter(int level, int cell) const {
    return levels_[static_cast<std::size_t>(level)][static_cast<std::size_t>(cell)];
  }

  /// The finest cell of a point of the cloud.
  int cellOf(std::size_t point) const { return cell_of_point_[point]; }

  /// The finest cells within a cell of a level are a run of this list.
  struct Run {
    const int* first;
    const int* last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  Run finestIn(int level, int cell) const;

  /// The cells next to a cell of the neighbour level, corners too.
  static constexpr int kNeighbourLevel = 2;
  /// The cell of that level that a finest cell is in.
  int neighbourLevelCellOf(int finest) const {
    return cell_of_neighbour_level_[static_cast<std::size_t>(finest)];
  }
  Run neighbours(int cell) const {
    const int* const run = neighbours_.data();
    return {run + neighbour_begins_[static_cast<std::size_t>(cell)],
            run + neighbour_begins_[static_cast<std::size_t>(cell) + 1]};
  }

 private:
  class KeyNumbers;

  KeyNumbers sortIntoFinest(const Cloud& cloud, double finest_m);
  void joinIntoCoarser(const KeyNumbers& finest);
  void listRuns(std::size_t level, const std::vector<int>& cell_of_finest);
  void findNeighbours(const KeyNumbers& numbers);

  std::vector<int> cell_of_point_;
  std::array<std::vector<Scatter>, kLevels> levels_;
  std::vector<int> cell_of_neighbour_level_;          ///< By finest cell.
  std::array<std::vector<int>, kLevels> run_begins_;  ///< Of each cell, and the end of the last.
  std::array<std::vector<int>, kLevels> runs_;
  std::vector<int> neighbour_begins_;  ///< Of each cell, and the end of the last.
  std::vector<int> neighbours_;
};

}  // namespace mrpt_sgraphs
