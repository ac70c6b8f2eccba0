// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mrpt_sgraphs/solver/problem.h"

namespace mrpt_sgraphs {

/// When the optimizer stops, and what it may use.
struct OptimizerConfig {
  int max_iterations = 50;
  double max_time_s = 0.0;              ///< Wall time after which no iteration begins; 0: no limit.
  double min_relative_decrease = 1e-6;  ///< Of the cost in one iteration: less is converged.
  int threads = 1;                      ///< The result does not depend on it.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("max_iterations", self.max_iterations, 1, 10000);
    field("max_time_s", self.max_time_s, 0.0, 3600.0);
    field("min_relative_decrease", self.min_relative_decrease, 1e-15, 0.1);
    field("threads", self.threads, 1, 64);
  }
};

/// Directions in which the factors leave a group of nodes free: the answer is one of many.
struct GaugeFreedom {
  std::vector<NodeId> nodes;  ///< In id order; they move together.
  int dimensions = 0;         ///< How many directions are free: 6 for a part that nothing holds.
  NodeId held;                ///< The node that was held instead, or whose free directions were.
};

/// What an optimization did.
struct OptimizerReport {
  int iterations = 0;  ///< Steps that were tried, the rejected ones too.
  int factorizations = 0;
  bool converged = false;
  std::string problem;  ///< Why not, in one sentence; empty if it converged.
  double cost_before = 0.0;
  double cost_after = 0.0;  ///< Never above cost_before.
  int free_tangents = 0;
  int factors = 0;
  std::vector<GaugeFreedom> gauge;  ///< Empty where the factors determine everything.
  double total_ms = 0.0;            ///< CPU, as all below
  double analyze_ms = 0.0;          ///< Ordering and symbolic factorization; 0 if they were reused.
  double linearize_ms = 0.0;
  double factorize_ms = 0.0;
};

/// Gauss-Newton, and Levenberg-Marquardt where it does not descend, over any factors. Keeps what it
/// found out about the structure of a problem, so that the next one of the same structure saves it.
class Optimizer {
 public:
  Optimizer();
  ~Optimizer();
  Optimizer(Optimizer&&) noexcept;
  Optimizer& operator=(Optimizer&&) noexcept;

  /// Optimizes the free variables of `problem` in place; the fixed ones do not change by one bit.
  /// Whatever goes wrong, the values afterwards are finite and cost no more than before, and the
  /// report says what it was.
  OptimizerReport optimize(const OptimizerConfig& config, Problem* problem);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrpt_sgraphs
