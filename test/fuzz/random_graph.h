// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <variant>
#include <vector>

#include "dice.h"
#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs::test {

/// Nodes of all layers with factors of all types between them, in no sensible arrangement.
struct RandomGraph {
  struct Node {
    NodeId id;
    std::variant<Pose, Plane> value;
    bool fixed = false;
  };
  std::vector<Node> nodes;
  std::vector<FactorConstPtr> factors;  ///< Some name nodes that are not there, or one twice.
  std::vector<std::invalid_argument> refusals;  ///< Of factors that could not even be made.
};

/// @param damage  The share of informations, measurements and values that are no such thing: not
///                finite, huge, tiny, zero, indefinite, asymmetric.
RandomGraph randomGraph(double damage, Dice* dice);

/// 0 for every second graph, else from little to all.
double randomDamage(Dice* dice);

}  // namespace mrpt_sgraphs::test
