// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "mrpt_sgraphs/hierarchy/whole_graph.h"
#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// A file's graph, to be optimized again and again from the same values.
class OptimizableGraph {
 public:
  struct Counts {
    std::size_t keyframes = 0;
    std::size_t walls = 0;
    std::size_t factors = 0;
    std::map<std::string, int> ignored;  ///< Records that nobody knows.
  };

  virtual ~OptimizableGraph() = default;

  virtual Counts counts() const = 0;

  /// Makes the values to begin with from the relative poses alone.
  /// @return The cost of the file's values, and how many poses were placed.
  /// @throws std::runtime_error if the format has no such start.
  virtual std::pair<double, int> initializeChordal() = 0;

  /// Back to the values to begin with.
  virtual void reset() = 0;

  /// By an optimizer that knows nothing yet.
  virtual OptimizerReport optimize(const OptimizerConfig& config) = 0;

  /// What the hierarchy did in the last optimization; null in mode baseline.
  virtual const WholeGraphReport* stages() const { return nullptr; }

  /// Writes the estimate in the format of the file.
  /// @throws std::runtime_error naming the file if it cannot be written.
  virtual void write(const std::string& path) const = 0;
};

/// To be optimized as a whole. By the end of the file's name: .g2o, .sg or .json.
/// @throws std::runtime_error naming the file and what is wrong with it.
std::unique_ptr<OptimizableGraph> readOptimizableGraph(const std::string& path);

}  // namespace mrpt_sgraphs
