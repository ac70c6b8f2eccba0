// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/solver/problem.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mrpt_sgraphs {
namespace {

void checkValue(NodeId node, bool plane, bool finite) {
  if (isPlane(node.layer) != plane) {
    throw std::invalid_argument(nameOf(node) + (plane ? " is no plane" : " is no pose"));
  }
  if (!finite) throw std::invalid_argument("the value of " + nameOf(node) + " is not finite");
}

}  // namespace

void Problem::reserve(std::size_t variables, std::size_t factors) {
  variables_.reserve(variables);
  factors_.reserve(factors);
  first_end_.reserve(factors);
  ends_.reserve(2 * factors);
}

int Problem::addVariable(NodeId node, const Pose& value, bool fixed) {
  checkValue(node, false, value.matrix().allFinite());
  variables_.push_back({node, static_cast<uint32_t>(poses_.size()), fixed});
  poses_.push_back(value);
  return variableCount() - 1;
}

int Problem::addVariable(NodeId node, const Plane& value, bool fixed) {
  checkValue(node, true, value.normal.allFinite() && std::isfinite(value.distance));
  variables_.push_back({node, static_cast<uint32_t>(planes_.size()), fixed});
  planes_.push_back(value);
  return variableCount() - 1;
}

void Problem::addFactor(const Factor& factor, const int* variables) {
  const int count = factor.nodeCount();
  for (int k = 0; k < count; ++k) {
    const int variable = variables[k];
    if (variable < 0 || variable >= variableCount()) {
      throw std::invalid_argument("a factor of type " + std::string(factor.type()) + " has " +
                                  nameOf(factor.node(k)) + ", which is not in the problem");
    }
    if (isPlane(node(variable).layer) != isPlane(factor.node(k).layer)) {
      throw std::invalid_argument("a factor of type " + std::string(factor.type()) + " takes " +
                                  nameOf(node(variable)) + " for " + nameOf(factor.node(k)));
    }
    for (int other = 0; other < k; ++other) {
      if (variables[other] == variable) {
        throw std::invalid_argument("a factor of type " + std::string(factor.type()) + " has " +
                                    nameOf(node(variable)) + " twice");
      }
    }
  }
  factors_.push_back(&factor);
  first_end_.push_back(static_cast<uint32_t>(ends_.size()));
  ends_.insert(ends_.end(), variables, variables + count);
}

double Problem::cost() const {
  double sum = 0.0;
  std::vector<VariableView> views;
  for (int f = 0; f < factorCount(); ++f) {
    views.clear();
    for (int k = 0; k < factor(f).nodeCount(); ++k) views.push_back(view(variablesOf(f)[k]));
    sum += factor(f).cost(views.data());
  }
  return sum;
}

void Problem::setValues(const Values& values) {
  poses_ = values.poses;
  planes_ = values.planes;
}

void Problem::retractVariable(int variable, const double* delta) {
  const Variable& v = at(variable);
  if (isPlane(v.node.layer)) {
    planes_[v.slot] = retract(planes_[v.slot], Eigen::Map<const PlaneTangent>(delta));
  } else {
    poses_[v.slot] = orthonormalized(poses_[v.slot] * expSE3(Eigen::Map<const Tangent>(delta)));
  }
}

}  // namespace mrpt_sgraphs
