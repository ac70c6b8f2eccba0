// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/network_optimizer.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <map>
#include <stdexcept>
#include <vector>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/graph/mrpt_information.h"

namespace mrpt_sgraphs {
namespace {

using mrpt::graphs::TNodeID;

/// Relative to the largest eigenvalue: how far rounding takes a zero below zero.
constexpr double kMaxNegative = 1e-9;

bool isPositiveSemidefinite(const Matrix6& information) {
  if (information.llt().info() == Eigen::Success) return true;  // the usual case, and fast
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(information, Eigen::EigenvaluesOnly);
  const Tangent values = eigen.eigenvalues();
  return eigen.info() == Eigen::Success &&
         values.minCoeff() >= -kMaxNegative * values.cwiseAbs().maxCoeff();
}

Matrix6 tangentInformation(MrptInformation meaning, const Pose& mean, const Matrix6& information) {
  switch (meaning) {
    case MrptInformation::kYawPitchRoll:
      return fromYawPitchRollInformation(mean, information);
    case MrptInformation::kPermuted:
      return permutedInformation(information);
    case MrptInformation::kTangent:
      break;
  }
  return information;
}

RelativePoseFactor factorOf(const MrptNetwork& network,
                            const MrptNetwork::edges_map_t::value_type& edge,
                            MrptInformation meaning) {
  const Matrix6 information = edge.second.cov_inv.asEigen();
  if (!isPositiveSemidefinite(information)) {
    throw std::invalid_argument(nameOf(edge.first) +
                                ": its information is not positive semidefinite");
  }
  const Pose mean = fromMrpt(edge.second.mean);
  KeyframeId from{edge.first.first};
  KeyframeId to{edge.first.second};
  if (network.edges_store_inverse_poses) std::swap(from, to);
  return {from, to, mean, tangentInformation(meaning, mean, information)};
}

void check(const MrptNetwork& network) {
  std::string fault = faultOf(network);
  if (fault.empty() && network.nodes.empty() && !network.edges.empty()) {
    fault = "the network has edges and no nodes";
  }
  if (!fault.empty()) throw std::invalid_argument(fault);
}

std::set<TNodeID> allButTheRoot(const MrptNetwork& network) {
  std::set<TNodeID> nodes;
  for (const auto& [id, pose] : network.nodes) {
    if (id != network.root) nodes.insert(nodes.end(), id);
  }
  return nodes;
}

/// The part of a network that the free nodes have to do with, as the solver takes it.
class NetworkProblem {
 public:
  NetworkProblem(const MrptNetwork& network, const std::set<TNodeID>& free,
                 MrptInformation meaning) {
    problem_.reserve(network.nodes.size(), network.edges.size());
    factors_.reserve(network.edges.size());  // the problem keeps references to them
    for (const TNodeID id : free) {
      if (network.nodes.count(id) == 0) {
        throw std::invalid_argument("node " + std::to_string(id) +
                                    " is to be optimized, and there is none");
      }
      addVariable(network, id, false);
    }
    for (const auto& edge : network.edges) {
      if (free.count(edge.first.first) == 0 && free.count(edge.first.second) == 0) continue;
      factors_.push_back(factorOf(network, edge, meaning));
      int variables[2];
      for (int end = 0; end < 2; ++end) {
        variables[end] = addVariable(network, factors_.back().node(end).value, true);
      }
      problem_.addFactor(factors_.back(), variables);
    }
  }

  Problem* problem() { return &problem_; }

  void writeTo(MrptNetwork* network) const {
    for (const auto& [id, variable] : variables_) {
      if (problem_.isFixed(variable)) continue;
      static_cast<mrpt::poses::CPose3D&>(network->nodes.at(id)) = toMrpt(problem_.pose(variable));
    }
  }

 private:
  /// Its index; that of the first time, if it has been added before.
  int addVariable(const MrptNetwork& network, TNodeID id, bool fixed) {
    const auto known = variables_.find(id);
    if (known != variables_.end()) return known->second;
    const int variable =
        problem_.addVariable(KeyframeId{id}, fromMrpt(network.nodes.at(id)), fixed);
    variables_[id] = variable;
    return variable;
  }

  Problem problem_;
  std::vector<RelativePoseFactor> factors_;
  std::map<TNodeID, int> variables_;
};

}  // namespace

double networkCost(const MrptNetwork& network, MrptInformation meaning) {
  check(network);
  double cost = 0.0;
  for (const auto& edge : network.edges) {
    const RelativePoseFactor factor = factorOf(network, edge, meaning);
    const Pose from = fromMrpt(network.nodes.at(factor.node(0).value));
    const Pose to = fromMrpt(network.nodes.at(factor.node(1).value));
    const VariableView values[2] = {from, to};
    cost += factor.cost(values);
  }
  return cost;
}

OptimizerReport optimizeNetwork(const OptimizerConfig& config, MrptNetwork* network,
                                const std::set<TNodeID>* nodes_to_optimize,
                                MrptInformation meaning) {
  check(*network);
  NetworkProblem problem(
      *network, nodes_to_optimize != nullptr ? *nodes_to_optimize : allButTheRoot(*network),
      meaning);
  Optimizer optimizer;
  const OptimizerReport report = optimizer.optimize(config, problem.problem());
  problem.writeTo(network);
  return report;
}

}  // namespace mrpt_sgraphs
