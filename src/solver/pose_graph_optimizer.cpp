// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/solver/pose_graph_optimizer.h"

#include <Eigen/SparseCholesky>
#include <cmath>

#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kInitialDamping = 1e-9;  ///< Relative to the diagonal: Gauss-Newton first.
constexpr double kMaxDamping = 1e6;
constexpr double kDampingStep = 10.0;
constexpr double kMinDamping = 1e-12;

/// A solve in progress: poses in id order, the first fixed.
class Problem {
 public:
  Problem(const std::vector<RelativePoseEdge>& edges, const PoseGraphOptimizerConfig& config,
          const std::map<KeyframeId, Pose>& poses)
      : edges_(edges), config_(config) {
    for (const auto& [id, T_map_base] : poses) {
      index_[id] = static_cast<int>(poses_.size());
      poses_.push_back(T_map_base);
    }
    for (const RelativePoseEdge& edge : edges) {
      ends_.emplace_back(index_.at(edge.from), index_.at(edge.to));
    }
  }

  int dimension() const { return 6 * (static_cast<int>(poses_.size()) - 1); }
  const std::vector<Pose>& poses() const { return poses_; }
  void setPoses(std::vector<Pose> poses) { poses_ = std::move(poses); }

  double cost() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      sum += kernelCost(edges_[k], chi2(k));
    }
    return sum;
  }

  /// Lower triangle of J'WJ, and J'We.
  void linearize(Eigen::SparseMatrix<double>* h, Eigen::VectorXd* g) const {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(edges_.size() * 120 + static_cast<std::size_t>(dimension()));
    g->setZero(dimension());
    // every diagonal entry exists, also of a pose that no edge reaches: damping writes to them
    for (int k = 0; k < dimension(); ++k) triplets.emplace_back(k, k, 0.0);
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const RelativePoseEdge& edge = edges_[k];
      const auto [from, to] = ends_[k];
      Matrix6 J[2];
      const Tangent e = relativePoseResidual(edge.T_from_to, pose(from), pose(to), &J[0], &J[1]);
      const Matrix6 information = kernelWeight(edge, e.dot(edge.information * e)) * edge.information;
      const int columns[2] = {6 * (from - 1), 6 * (to - 1)};  // negative: the fixed one
      for (int a = 0; a < 2; ++a) {
        if (columns[a] < 0) continue;
        g->segment<6>(columns[a]) += J[a].transpose() * information * e;
        for (int b = 0; b < 2; ++b) {
          if (columns[b] < 0 || columns[b] > columns[a]) continue;
          addBlock(J[a].transpose() * information * J[b], columns[a], columns[b], &triplets);
        }
      }
    }
    h->resize(dimension(), dimension());
    h->setFromTriplets(triplets.begin(), triplets.end());
  }

  std::vector<Pose> stepped(const Eigen::VectorXd& step) const {
    std::vector<Pose> poses = poses_;
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Tangent delta = step.segment<6>(6 * (static_cast<Eigen::Index>(i) - 1));
      poses[i] = orthonormalized(retract(poses[i], delta));
    }
    return poses;
  }

 private:
  const Pose& pose(int index) const { return poses_[static_cast<std::size_t>(index)]; }

  double chi2(std::size_t k) const {
    const Tangent e = relativePoseResidual(edges_[k].T_from_to, pose(ends_[k].first),
                                           pose(ends_[k].second), nullptr, nullptr);
    return e.dot(edges_[k].information * e);
  }

  // Cauchy: rho = c^2 log(1 + chi2 / c^2)
  double kernelCost(const RelativePoseEdge& edge, double chi2) const {
    if (edge.kind == RelativePoseEdge::Kind::kOdometry) return chi2;
    return config_.loop_kernel_chi2 * std::log1p(chi2 / config_.loop_kernel_chi2);
  }
  double kernelWeight(const RelativePoseEdge& edge, double chi2) const {
    if (edge.kind == RelativePoseEdge::Kind::kOdometry) return 1.0;
    return 1.0 / (1.0 + chi2 / config_.loop_kernel_chi2);
  }

  static void addBlock(const Matrix6& block, int row, int column,
                       std::vector<Eigen::Triplet<double>>* triplets) {
    for (int c = 0; c < 6; ++c) {
      for (int r = row == column ? c : 0; r < 6; ++r) {
        triplets->emplace_back(row + r, column + c, block(r, c));
      }
    }
  }

  const std::vector<RelativePoseEdge>& edges_;
  const PoseGraphOptimizerConfig& config_;
  std::map<KeyframeId, int> index_;
  std::vector<Pose> poses_;
  std::vector<std::pair<int, int>> ends_;
};

}  // namespace

OptimizationSummary optimizePoseGraph(const std::vector<RelativePoseEdge>& edges,
                                      const PoseGraphOptimizerConfig& config,
                                      std::map<KeyframeId, Pose>* poses) {
  const double start_ms = threadCpuMilliseconds();
  OptimizationSummary summary;
  summary.kind = "full";
  summary.mode = "baseline";
  summary.keyframes_active = static_cast<int>(poses->size());
  summary.factors = static_cast<int>(edges.size());
  if (poses->size() < 2 || edges.empty()) {
    summary.converged = true;
    return summary;
  }

  Problem problem(edges, config, *poses);
  summary.free_variables = problem.dimension();
  summary.cost_before = problem.cost();
  double cost = summary.cost_before;
  double damping = kInitialDamping;
  bool accepted = true;
  Eigen::SparseMatrix<double> h;
  Eigen::VectorXd g;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky;
  bool analyzed = false;

  while (summary.iterations < config.max_iterations && !summary.converged) {
    ++summary.iterations;
    const double linearize_ms = threadCpuMilliseconds();
    if (accepted) problem.linearize(&h, &g);
    Eigen::SparseMatrix<double> damped = h;
    damped.diagonal() *= 1.0 + damping;
    const double factorize_ms = threadCpuMilliseconds();
    summary.linearize_ms += factorize_ms - linearize_ms;
    if (!analyzed) cholesky.analyzePattern(damped);
    analyzed = true;
    cholesky.factorize(damped);
    const bool solvable = cholesky.info() == Eigen::Success && cholesky.vectorD().minCoeff() > 0.0;
    const Eigen::VectorXd step = solvable ? Eigen::VectorXd(-cholesky.solve(g)) : Eigen::VectorXd();
    summary.factorize_ms += threadCpuMilliseconds() - factorize_ms;

    accepted = false;
    if (solvable && step.allFinite()) {
      const std::vector<Pose> before = problem.poses();
      problem.setPoses(problem.stepped(step));
      const double new_cost = problem.cost();
      accepted = std::isfinite(new_cost) && new_cost <= cost;
      if (accepted) {
        summary.converged = cost - new_cost <= config.min_relative_decrease * cost + 1e-12;
        cost = new_cost;
      } else {
        problem.setPoses(before);
        // at the optimum rounding decides whether the cost falls
        const double rise = std::isfinite(new_cost) ? new_cost - cost : cost;
        summary.converged = rise <= config.min_relative_decrease * cost + 1e-12;
      }
    }
    damping = accepted ? std::max(kMinDamping, damping / kDampingStep) : damping * kDampingStep;
    if (damping > kMaxDamping) {
      summary.problem = "no step makes the cost smaller; the graph may be in unconnected parts";
      break;
    }
  }

  if (!summary.converged && summary.problem.empty()) {
    summary.problem = "stopped after " + std::to_string(summary.iterations) + " iterations";
  }
  summary.cost_after = cost;
  auto optimized = problem.poses().begin();
  for (auto& [id, T_map_base] : *poses) T_map_base = *optimized++;
  summary.total_ms = threadCpuMilliseconds() - start_ms;
  return summary;
}

}  // namespace mrpt_sgraphs
