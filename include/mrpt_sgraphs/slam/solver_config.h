// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mrpt_sgraphs/solver/optimizer.h"

namespace mrpt_sgraphs {

/// How the graph is optimized. No limit of time: the same input is to give the same map.
struct SolverConfig {
  OptimizerConfig optimizer;
  double loop_kernel_chi2 = 12.6;  ///< Loops with a larger chi^2 (6 dof, 5 %) lose weight.

  template <typename Self, typename Field>
  static void fields(Self& self, Field&& field) {
    field("max_iterations", self.optimizer.max_iterations, 1, 10000);
    field("min_relative_decrease", self.optimizer.min_relative_decrease, 1e-15, 0.1);
    field("threads", self.optimizer.threads, 1, 64);
    field("loop_kernel_chi2", self.loop_kernel_chi2, 0.1, 1e6);
  }
};

}  // namespace mrpt_sgraphs
