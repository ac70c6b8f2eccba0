// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "mrpt_sgraphs/factors/robust_kernel.h"
#include "mrpt_sgraphs/geometry/ids.h"
#include "mrpt_sgraphs/geometry/plane.h"
#include "mrpt_sgraphs/geometry/pose.h"

namespace mrpt_sgraphs {

/// What a layer's nodes are to the solver: keyframes and rooms are poses, walls and floors planes.
inline constexpr bool isPlane(Layer layer) {
  return layer == Layer::kWall || layer == Layer::kFloor;
}

/// Degrees of freedom of a variable.
template <typename Variable>
inline constexpr int kTangentSize = 0;
template <>
inline constexpr int kTangentSize<Pose> = 6;
template <>
inline constexpr int kTangentSize<Plane> = 3;
inline constexpr int tangentSize(Layer layer) { return isPlane(layer) ? 3 : 6; }

/// Where a variable's value is. Its type follows from the layer of its node.
class VariableView {
 public:
  VariableView() = default;
  VariableView(const Pose& pose) : address_(&pose) {}
  VariableView(const Plane& plane) : address_(&plane) {}

  template <typename Variable>
  const Variable& as() const {
    return *static_cast<const Variable*>(address_);
  }

 private:
  const void* address_ = nullptr;
};

/// Something that is known about a few nodes: a term of the cost that the graph minimizes.
/// Immutable, so graph, snapshots and solver share it.
class Factor {
 public:
  virtual ~Factor() = default;

  /// What a file calls it: "odometry", "wall_observation", ...
  virtual const char* type() const = 0;

  virtual int nodeCount() const = 0;
  virtual NodeId node(int index) const = 0;

  /// Its term of the cost: e' Omega e (no half), through the robust kernel.
  /// @param values  One for each node, in their order.
  virtual double cost(const VariableView* values) const = 0;

  /// The quadratic model cost(x + delta) ~ cost + 2 g' delta + delta' H delta, the nodes' tangents
  /// one after the other.
  /// @param H  Its lower triangle, column-major with as many rows as tangents in all; overwritten.
  /// @param g  Overwritten.
  /// @return   The cost at `values`.
  virtual double linearize(const VariableView* values, double* H, double* g) const = 0;

  /// Of all its nodes' tangents together: the rows of `H`.
  int tangentRows() const {
    int rows = 0;
    for (int k = 0; k < nodeCount(); ++k) rows += tangentSize(node(k).layer);
    return rows;
  }
};

using FactorConstPtr = std::shared_ptr<const Factor>;

/// A factor with a residual of `Rows` rows over some variables: its derived class gives residual and
/// Jacobians, everything else follows.
template <int Rows, typename... Variables>
class ResidualFactor : public Factor {
 public:
  using Residual = Eigen::Matrix<double, Rows, 1>;
  using Information = Eigen::Matrix<double, Rows, Rows>;
  template <typename Variable>
  using Jacobian = Eigen::Matrix<double, Rows, kTangentSize<Variable>>;

  static constexpr int kNodes = sizeof...(Variables);
  static constexpr int kTangents = (kTangentSize<Variables> + ...);

  /// The residual, and the Jacobians with respect to the variables' tangents where not null.
  virtual Residual evaluate(const Variables&... values, Jacobian<Variables>*... jacobians) const = 0;

  /// The squared residual e' Omega e, before the robust kernel.
  double chi2(const Variables&... values) const {
    const Residual e = evaluate(values..., static_cast<Jacobian<Variables>*>(nullptr)...);
    return e.dot(information_ * e);
  }

  int nodeCount() const final { return kNodes; }
  NodeId node(int index) const final { return nodes_[static_cast<std::size_t>(index)]; }

  double cost(const VariableView* values) const final {
    return costOf(values, std::index_sequence_for<Variables...>());
  }
  double linearize(const VariableView* values, double* H, double* g) const final {
    return linearizeAt(values, H, g, std::index_sequence_for<Variables...>());
  }

  const Information& information() const { return information_; }
  const RobustKernel& kernel() const { return kernel_; }

 protected:
  /// @param information  Inverse covariance of the residual: symmetric, positive semidefinite.
  /// @throws std::invalid_argument for a node of a layer that has another type of variable, or a
  ///         kernel whose width is not above zero, or not finite.
  ResidualFactor(const std::array<NodeId, kNodes>& nodes, const Information& information,
                 const RobustKernel& kernel = {})
      : nodes_(nodes), information_(information), kernel_(kernel) {
    if (!kernel.isSound()) throw std::invalid_argument("a robust kernel's width is none");
    constexpr std::array<bool, kNodes> kPlanes{std::is_same_v<Variables, Plane>...};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (isPlane(nodes[k].layer) == kPlanes[k]) continue;
      throw std::invalid_argument(nameOf(nodes[k]) + " is " + (kPlanes[k] ? "no plane" : "no pose"));
    }
  }

 private:
  template <std::size_t... I>
  double costOf(const VariableView* values, std::index_sequence<I...>) const {
    return kernel_.cost(chi2(values[I].template as<Variables>()...));
  }

  template <std::size_t... I>
  double linearizeAt(const VariableView* values, double* H, double* g,
                     std::index_sequence<I...>) const {
    std::tuple<Jacobian<Variables>...> jacobians;
    const Residual e =
        evaluate(values[I].template as<Variables>()..., &std::get<I>(jacobians)...);
    const Residual information_e = information_ * e;
    const double chi2 = e.dot(information_e);
    const double weight = kernel_.weight(chi2);

    Eigen::Map<Eigen::Matrix<double, kTangents, kTangents>> hessian(H);
    Eigen::Map<Eigen::Matrix<double, kTangents, 1>> gradient(g);
    constexpr std::array<int, kNodes> kSizes{kTangentSize<Variables>...};
    int column = 0;
    (
        [&] {
          constexpr int kColumns = kTangentSize<std::tuple_element_t<I, std::tuple<Variables...>>>;
          const auto& J_column = std::get<I>(jacobians);
          Eigen::Matrix<double, Rows, kColumns> weighted;
          weighted.noalias() = information_ * J_column;
          if (weight != 1.0) weighted *= weight;
          gradient.template segment<kColumns>(column).noalias() = weighted.transpose() * e;
          int row = column;
          fillRows<I, 0>(jacobians, weighted, column, &row, &hessian);
          column += kSizes[I];
        }(),
        ...);
    return kernel_.cost(chi2);
  }

  /// Blocks (row, column) for the row variables from the column's own on.
  template <std::size_t Column, std::size_t Row, typename Jacobians, typename Weighted,
            typename Hessian>
  static void fillRows(const Jacobians& jacobians, const Weighted& weighted, int column, int* row,
                       Hessian* hessian) {
    if constexpr (Row < static_cast<std::size_t>(kNodes)) {
      if constexpr (Row >= Column) {
        constexpr int kRows = kTangentSize<std::tuple_element_t<Row, std::tuple<Variables...>>>;
        hessian->template block<kRows, Weighted::ColsAtCompileTime>(*row, column).noalias() =
            std::get<Row>(jacobians).transpose() * weighted;
        *row += kRows;
      }
      fillRows<Column, Row + 1>(jacobians, weighted, column, row, hessian);
    }
  }

  std::array<NodeId, kNodes> nodes_;
  Information information_;
  RobustKernel kernel_;
};

}  // namespace mrpt_sgraphs
