// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "mrpt_sgraphs/factors/factor.h"

namespace mrpt_sgraphs {

/// What the solver is given: variables with values, some of them held, and the factors between them.
/// Filled once, solved, read out; the factors are not owned and have to outlive it.
class Problem {
 public:
  void reserve(std::size_t variables, std::size_t factors);

  /// @return The variable's index: consecutive, from 0.
  /// @throws std::invalid_argument if the value is not finite, or of the wrong type for the node's
  ///         layer.
  int addVariable(NodeId node, const Pose& value, bool fixed = false);
  int addVariable(NodeId node, const Plane& value, bool fixed = false);

  /// @param variables  The index of each of the factor's nodes, in their order.
  /// @throws std::invalid_argument for an index that is none, that comes twice, or of another type
  ///         than the factor's node.
  void addFactor(const Factor& factor, const int* variables);

  int variableCount() const { return static_cast<int>(variables_.size()); }
  int factorCount() const { return static_cast<int>(factors_.size()); }

  NodeId node(int variable) const { return at(variable).node; }
  bool isFixed(int variable) const { return at(variable).fixed; }
  void setFixed(int variable, bool fixed) {
    variables_[static_cast<std::size_t>(variable)].fixed = fixed;
  }
  int tangentSizeOf(int variable) const { return tangentSize(at(variable).node.layer); }

  const Pose& pose(int variable) const { return poses_[at(variable).slot]; }
  const Plane& plane(int variable) const { return planes_[at(variable).slot]; }
  VariableView view(int variable) const {
    const Variable& v = at(variable);
    return isPlane(v.node.layer) ? VariableView(planes_[v.slot]) : VariableView(poses_[v.slot]);
  }

  const Factor& factor(int index) const { return *factors_[static_cast<std::size_t>(index)]; }
  /// The variables of a factor, as many as it has nodes.
  const int* variablesOf(int factor) const {
    return ends_.data() + first_end_[static_cast<std::size_t>(factor)];
  }

  /// The sum of all factors' costs.
  double cost() const;

  /// The values of all variables, to go back to.
  struct Values {
    std::vector<Pose> poses;
    std::vector<Plane> planes;
  };
  Values values() const { return {poses_, planes_}; }
  void setValues(const Values& values);

  /// Moves the variable along its tangent.
  void retractVariable(int variable, const double* delta);

 private:
  struct Variable {
    NodeId node;
    uint32_t slot = 0;  ///< In poses_ or planes_.
    bool fixed = false;
  };
  const Variable& at(int variable) const { return variables_[static_cast<std::size_t>(variable)]; }

  std::vector<Variable> variables_;
  std::vector<Pose> poses_;
  std::vector<Plane> planes_;
  std::vector<const Factor*> factors_;
  std::vector<uint32_t> first_end_;  ///< Of each factor, in ends_.
  std::vector<int> ends_;
};

}  // namespace mrpt_sgraphs
