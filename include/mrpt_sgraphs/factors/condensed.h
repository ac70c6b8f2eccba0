// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <variant>
#include <vector>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"

namespace mrpt_sgraphs {

/// What eliminated keyframes said about the nodes that remain around them, relative to one of
/// these, the kept keyframe. With each other node j as the kept keyframe sees it, against where it
/// was when the quadratic was made, l_j:
///
///     e_j = log( l_j^-1 T_map_kept^-1 T_map_j )     6 rows, for a pose    (relativePoseResidual)
///     e_j = [ B' n_kept; d_kept - d_l ]             3 rows, for a plane   (planeResidual)
///
///     cost = e' Lambda e - 2 eta' e + c,   e = (e_1, e_2, ...)
///
/// At l_j, and to second order around it, e_j is the tangent of node j in the kept keyframe's
/// frame: Lambda, eta and c are the Schur complement of the eliminated factors, linearized with the
/// kept keyframe at the origin. As e is relative, the factor is the same wherever a loop closure
/// moves it all to, and says nothing on where that is.
///
/// Frames: nodes in `map`, the l_j in the kept keyframe's base.
class CondensedFactor final : public Factor {
 public:
  /// A node beside the kept keyframe, and where it was.
  struct Other {
    NodeId node;
    std::variant<Pose, Plane> seen_kept;
    /// Of a keyframe: covariance of T_kept_other, right perturbation of the other, by the relative
    /// poses alone that were eliminated, added up along the most certain way. None: there is no way.
    /// Not in the cost: it says how far to look for what may be the same.
    std::optional<Matrix6> way_covariance = std::nullopt;
  };

  /// The quadratic, rows in the order of the nodes.
  struct Quadratic {
    Eigen::MatrixXd Lambda;  ///< Symmetric, positive semidefinite; may well be singular.
    Eigen::VectorXd eta;     ///< In the range of Lambda, else there is no minimum.
    double c = 0.0;
  };

  /// @throws std::invalid_argument if a node's layer does not go with its value, or the quadratic's
  ///         size with the nodes.
  CondensedFactor(KeyframeId kept, std::vector<Other> others, Quadratic quadratic)
      : kept_(kept), others_(std::move(others)), quadratic_(std::move(quadratic)) {
    Eigen::Index rows = 0;
    for (const Other& other : others_) {
      if (isPlane(other.node.layer) != std::holds_alternative<Plane>(other.seen_kept)) {
        throw std::invalid_argument("A condensed factor has a value of the wrong type for " +
                                    nameOf(other.node) + ".");
      }
      rows += tangentSize(other.node.layer);
    }
    const Quadratic& q = quadratic_;
    if (q.Lambda.rows() != rows || q.Lambda.cols() != rows || q.eta.size() != rows) {
      throw std::invalid_argument("A condensed factor's quadratic has not the size of its nodes.");
    }
  }

  const char* type() const override { return "condensed"; }
  int nodeCount() const override { return 1 + static_cast<int>(others_.size()); }
  NodeId node(int index) const override {
    return index == 0 ? kept_ : others_[static_cast<std::size_t>(index) - 1].node;
  }

  double cost(const VariableView* values) const override {
    Workspace work(quadratic_.eta.size());
    evaluate(values, &work, false);
    return costOf(&work);
  }

  double linearize(const VariableView* values, double* H, double* g) const override {
    const Eigen::Index rows = quadratic_.eta.size();
    const Eigen::MatrixXd& Lambda = quadratic_.Lambda;
    Workspace work(rows);
    evaluate(values, &work, true);
    const double cost = costOf(&work);

    Eigen::Map<Eigen::MatrixXd> hessian(H, 6 + rows, 6 + rows);
    Eigen::Map<Eigen::VectorXd> gradient(g, 6 + rows);
    // sizes at which to block and pack costs more than to multiply
    work.weighted_J_kept.noalias() = Lambda.lazyProduct(work.J_kept);
    hessian.topLeftCorner<6, 6>().noalias() =
        work.J_kept.transpose().lazyProduct(work.weighted_J_kept);
    gradient.head<6>().noalias() = work.J_kept.transpose() * work.half_gradient;

    // the Jacobians of planes, and of a pose's translation and rotation each, have three columns
    for (Eigen::Index column = 0; column < rows; column += 3) {
      const auto J_column = work.J_other.middleRows<3>(column);
      gradient.segment<3>(6 + column).noalias() =
          J_column.transpose() * work.half_gradient.segment<3>(column);
      hessian.block<3, 6>(6 + column, 0).noalias() =
          J_column.transpose() * work.weighted_J_kept.middleRows<3>(column);
      for (Eigen::Index row = column; row < rows; row += 3) {
        const Eigen::Matrix3d weighted = Lambda.block<3, 3>(row, column) * J_column;
        hessian.block<3, 3>(6 + row, 6 + column).noalias() =
            work.J_other.middleRows<3>(row).transpose() * weighted;
      }
    }
    return cost;
  }

  KeyframeId kept() const { return kept_; }
  const std::vector<Other>& others() const { return others_; }
  const Quadratic& quadratic() const { return quadratic_; }

 private:
  using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  /// What a linearization needs, in memory that each thread keeps for the next one.
  struct Workspace {
    explicit Workspace(Eigen::Index rows)
        : e(take(rows), rows),
          half_gradient(e.data() + rows, rows),
          J_kept(e.data() + 2 * rows, rows, 6),
          J_other(e.data() + 8 * rows, rows, 3),
          weighted_J_kept(e.data() + 11 * rows, rows, 6) {}

    static double* take(Eigen::Index rows) {
      thread_local std::vector<double> memory;
      memory.resize(std::max(memory.size(), static_cast<std::size_t>(17 * rows)));
      return memory.data();
    }

    Eigen::Map<Eigen::VectorXd> e;
    Eigen::Map<Eigen::VectorXd> half_gradient;  ///< Lambda e - eta
    Eigen::Map<Rows6> J_kept;
    /// Of three rows each with those three of the tangent that they change with, and no others do: a
    /// plane's, a pose's translation, its rotation.
    Eigen::Map<Rows3> J_other;
    Eigen::Map<Rows6> weighted_J_kept;
  };

  void evaluate(const VariableView* values, Workspace* work, bool with_jacobians) const {
    const Pose& T_map_kept = values[0].as<Pose>();
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < others_.size(); ++k) {
      if (const Plane* plane = std::get_if<Plane>(&others_[k].seen_kept)) {
        Eigen::Matrix<double, 3, 6> J_kept;
        Eigen::Matrix3d J_plane;
        work->e.segment<3>(row) = planeResidual(
            *plane, tangentBasis(plane->normal), T_map_kept, values[k + 1].as<Plane>(),
            with_jacobians ? &J_kept : nullptr, with_jacobians ? &J_plane : nullptr);
        if (with_jacobians) {
          work->J_kept.middleRows<3>(row) = J_kept;
          work->J_other.middleRows<3>(row) = J_plane;
        }
        row += 3;
      } else {
        Matrix6 J_kept;
        Matrix6 J_pose;
        work->e.segment<6>(row) = relativePoseResidual(
            std::get<Pose>(others_[k].seen_kept), T_map_kept, values[k + 1].as<Pose>(),
            with_jacobians ? &J_kept : nullptr, with_jacobians ? &J_pose : nullptr);
        if (with_jacobians) {
          work->J_kept.middleRows<6>(row) = J_kept;
          work->J_other.middleRows<3>(row) = J_pose.topLeftCorner<3, 3>();
          work->J_other.middleRows<3>(row + 3) = J_pose.bottomRightCorner<3, 3>();
        }
        row += 6;
      }
    }
  }

  double costOf(Workspace* work) const {
    work->half_gradient = -quadratic_.eta;
    work->half_gradient.noalias() += quadratic_.Lambda * work->e;
    return work->e.dot(work->half_gradient - quadratic_.eta) + quadratic_.c;
  }

  KeyframeId kept_;
  std::vector<Other> others_;
  Quadratic quadratic_;
};

}  // namespace mrpt_sgraphs
