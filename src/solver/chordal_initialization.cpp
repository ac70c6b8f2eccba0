// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/solver/chordal_initialization.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numeric>
#include <optional>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"

namespace mrpt_sgraphs {
namespace {

using Index = Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Between two poses by their place among the poses of the problem.
struct Measurement {
  int from;
  int to;
  Pose T_from_to;
  double rotation_weight;     ///< [1/rad^2]
  double translation_weight;  ///< [1/m^2]
};

/// The weight of the directions' mean: the relaxation has one for all of them.
double meanWeight(const Matrix6& information, int first) {
  return information.diagonal().segment<3>(first).mean();
}

std::optional<Measurement> measurementOf(const Factor& factor) {
  if (const auto* edge = dynamic_cast<const RelativePoseFactor*>(&factor)) {
    return Measurement{0, 0, edge->T_from_to, meanWeight(edge->information(), 3),
                       meanWeight(edge->information(), 0)};
  }
  if (const auto* edge = dynamic_cast<const RelativePoseQuaternionFactor*>(&factor)) {
    constexpr double kHalfAngle = 0.5;  // its rotation residual is half the rotation vector
    return Measurement{0, 0, edge->T_from_to,
                       kHalfAngle * kHalfAngle * meanWeight(edge->information(), 3),
                       meanWeight(edge->information(), 0)};
  }
  return std::nullopt;
}

/// The poses of a problem, by place in the order in which they were added; their measurements; and
/// which of them are solved for.
class PoseNetwork {
 public:
  explicit PoseNetwork(const Problem& problem)
      : place_(static_cast<std::size_t>(problem.variableCount()), -1) {
    for (int v = 0; v < problem.variableCount(); ++v) {
      if (isPlane(problem.node(v).layer)) continue;
      place_[static_cast<std::size_t>(v)] = static_cast<int>(poses_.size());
      poses_.push_back(problem.pose(v));
      held_.push_back(problem.isFixed(v));
    }
    for (int f = 0; f < problem.factorCount(); ++f) {
      std::optional<Measurement> measured = measurementOf(problem.factor(f));
      if (!measured) continue;
      // without a weight it says nothing, not even that they belong together
      if (!(measured->rotation_weight > 0.0 && measured->translation_weight > 0.0)) continue;
      measured->from = place(problem.variablesOf(f)[0]);
      measured->to = place(problem.variablesOf(f)[1]);
      measurements_.push_back(*measured);
    }
    holdOneOfEachPart();
    for (const bool held : held_) row_.push_back(held ? -1 : free_++);
  }

  int place(int variable) const { return place_[static_cast<std::size_t>(variable)]; }
  int freeCount() const { return free_; }
  const std::vector<Pose>& poses() const { return poses_; }

  bool solve() {
    if (free_ == 0 || !solveRotations() || !solveTranslations()) return false;
    for (const Pose& T : poses_) {
      if (!T.matrix().allFinite()) return false;
    }
    return true;
  }

 private:
  Pose& pose(int place) { return poses_[static_cast<std::size_t>(place)]; }
  int row(int place) const { return row_[static_cast<std::size_t>(place)]; }

  void holdOneOfEachPart() {
    std::vector<int> parent(poses_.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int k) {
      while (parent[static_cast<std::size_t>(k)] != k) {
        int& above = parent[static_cast<std::size_t>(k)];
        k = above = parent[static_cast<std::size_t>(above)];
      }
      return k;
    };
    for (const Measurement& m : measurements_) {
      parent[static_cast<std::size_t>(root(m.from))] = root(m.to);
    }
    std::vector<bool> has_held(poses_.size(), false);
    const auto part = [&](std::size_t k) {
      return static_cast<std::size_t>(root(static_cast<int>(k)));
    };
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (held_[k]) has_held[part(k)] = true;
    }
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (has_held[part(k)]) continue;
      has_held[part(k)] = true;
      held_[k] = true;
    }
  }

  /// Over the transposed rows x of the rotations: each has the same equations Z' x_i = x_j.
  bool solveRotations() {
    Triplets entries;
    Matrix right = Matrix::Zero(3 * free_, 3);
    for (const Measurement& m : measurements_) {
      const double w = m.rotation_weight;
      const Eigen::Matrix3d Z = m.T_from_to.linear();
      const int from = row(m.from);
      const int to = row(m.to);
      for (const int end : {from, to}) {
        for (int k = 0; end >= 0 && k < 3; ++k) entries.emplace_back(3 * end + k, 3 * end + k, w);
      }
      if (from >= 0 && to >= 0) {
        addBlock(-w * (from > to ? Z : Eigen::Matrix3d(Z.transpose())), std::max(from, to),
                 std::min(from, to), &entries);
      } else if (from >= 0) {
        right.middleRows<3>(3 * from) += w * Z * pose(m.to).linear().transpose();
      } else if (to >= 0) {
        right.middleRows<3>(3 * to) += w * Z.transpose() * pose(m.from).linear().transpose();
      }
    }
    if (!solveInPlace(entries, &right)) return false;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (row_[k] < 0) continue;
      poses_[k].linear() = nearestRotation(right.middleRows<3>(3 * row_[k]).transpose());
    }
    return true;
  }

  bool solveTranslations() {
    Triplets entries;
    Matrix right = Matrix::Zero(free_, 3);
    for (const Measurement& m : measurements_) {
      const double w = m.translation_weight;
      const Eigen::RowVector3d step_map =
          (pose(m.from).linear() * m.T_from_to.translation()).transpose();
      const int from = row(m.from);
      const int to = row(m.to);
      if (from >= 0) {
        entries.emplace_back(from, from, w);
        right.row(from) -= w * step_map;
        if (to < 0) right.row(from) += w * pose(m.to).translation().transpose();
      }
      if (to >= 0) {
        entries.emplace_back(to, to, w);
        right.row(to) += w * step_map;
        if (from < 0) right.row(to) += w * pose(m.from).translation().transpose();
      }
      if (from >= 0 && to >= 0) entries.emplace_back(std::max(from, to), std::min(from, to), -w);
    }
    if (!solveInPlace(entries, &right)) return false;
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      if (row_[k] >= 0) poses_[k].translation() = right.row(row_[k]).transpose();
    }
    return true;
  }

  static void addBlock(const Eigen::Matrix3d& block, int row, int column, Triplets* entries) {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) entries->emplace_back(3 * row + r, 3 * column + c, block(r, c));
    }
  }

  static bool solveInPlace(const Triplets& entries, Matrix* right) {
    Eigen::SparseMatrix<double> lower(right->rows(), right->rows());
    lower.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(lower);
    if (cholesky.info() != Eigen::Success) return false;
    *right = cholesky.solve(*right).eval();
    return right->allFinite();
  }

  static Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d U = svd.matrixU();
    if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) *= -1.0;
    return U * svd.matrixV().transpose();
  }

  std::vector<int> place_;  ///< Of a variable among the poses; -1: it is a plane.
  std::vector<Pose> poses_;
  std::vector<bool> held_;
  std::vector<int> row_;  ///< Of a pose in the equations; -1: held.
  int free_ = 0;
  std::vector<Measurement> measurements_;
};

void placePlanes(const PoseNetwork& network, const Problem& problem, Problem::Values* values) {
  std::vector<int> slot(static_cast<std::size_t>(problem.variableCount()), -1);
  int planes = 0;
  for (int v = 0; v < problem.variableCount(); ++v) {
    if (!isPlane(problem.node(v).layer)) continue;
    if (!problem.isFixed(v)) slot[static_cast<std::size_t>(v)] = planes;
    ++planes;
  }
  for (int f = 0; f < problem.factorCount(); ++f) {
    const auto* seen = dynamic_cast<const PlaneObservationFactor*>(&problem.factor(f));
    if (seen == nullptr || !isSound(seen->measured_base)) continue;
    int& plane = slot[static_cast<std::size_t>(problem.variablesOf(f)[1])];
    if (plane < 0) continue;
    const auto pose = static_cast<std::size_t>(network.place(problem.variablesOf(f)[0]));
    values->planes[static_cast<std::size_t>(plane)] = network.poses()[pose] * seen->measured_base;
    plane = -1;
  }
}

}  // namespace

int initializeChordal(Problem* problem) {
  PoseNetwork network(*problem);
  if (!network.solve()) return 0;
  Problem::Values values = problem->values();
  values.poses = network.poses();
  placePlanes(network, *problem, &values);
  problem->setValues(values);
  return network.freeCount();
}

}  // namespace mrpt_sgraphs
