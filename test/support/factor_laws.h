// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <tuple>
#include <variant>
#include <vector>

#include "mrpt_sgraphs/factors/factor.h"
#include "support/random_geometry.h"

namespace mrpt_sgraphs::test {

/// Values of the nodes of any factor.
using Value = std::variant<Pose, Plane>;
using Values = std::vector<Value>;

inline std::vector<VariableView> views(const Values& values) {
  std::vector<VariableView> result;
  for (const Value& value : values) {
    std::visit([&](const auto& v) { result.emplace_back(v); }, value);
  }
  return result;
}

/// The same nodes in a map that has its origin elsewhere.
inline Values moved(const Pose& T_other_map, Values values) {
  for (Value& value : values) std::visit([&](auto& v) { v = T_other_map * v; }, value);
  return values;
}

inline Values retracted(Values values, const Eigen::VectorXd& delta) {
  Eigen::Index row = 0;
  for (Value& value : values) {
    std::visit(
        [&](auto& v) {
          constexpr int kSize = kTangentSize<std::decay_t<decltype(v)>>;
          v = mrpt_sgraphs::retract(v, delta.segment<kSize>(row));
          row += kSize;
        },
        value);
  }
  return values;
}

/// `[rows x tangents]`, central differences of `f(values)`, a vector.
template <typename Function>
Eigen::MatrixXd centralDifferences(const Function& f, const Values& values, Eigen::Index tangents,
                                   double step) {
  Eigen::MatrixXd J(f(values).size(), tangents);
  for (Eigen::Index k = 0; k < tangents; ++k) {
    const Eigen::VectorXd delta = step * Eigen::VectorXd::Unit(tangents, k);
    J.col(k) = (f(retracted(values, delta)) - f(retracted(values, -delta))) / (2.0 * step);
  }
  return J;
}

/// The residual of any ResidualFactor, and its Jacobians side by side if `J` is not null.
template <int Rows, typename... Variables, std::size_t... I>
Eigen::VectorXd evaluate(const ResidualFactor<Rows, Variables...>& factor, const Values& values,
                         Eigen::MatrixXd* J, std::index_sequence<I...>) {
  std::tuple<Eigen::Matrix<double, Rows, kTangentSize<Variables>>...> jacobians;
  const Eigen::VectorXd e = factor.evaluate(std::get<Variables>(values[I])...,
                                            (J == nullptr ? nullptr : &std::get<I>(jacobians))...);
  if (J == nullptr) return e;
  J->resize(Rows, ResidualFactor<Rows, Variables...>::kTangents);
  Eigen::Index column = 0;
  ((J->middleCols(column, std::get<I>(jacobians).cols()) = std::get<I>(jacobians),
    column += std::get<I>(jacobians).cols()),
   ...);
  return e;
}
template <int Rows, typename... Variables>
Eigen::VectorXd evaluate(const ResidualFactor<Rows, Variables...>& factor, const Values& values,
                         Eigen::MatrixXd* J = nullptr) {
  return evaluate(factor, values, J, std::index_sequence_for<Variables...>());
}

/// Jacobians equal to central differences of the residual.
template <int Rows, typename... Variables>
void expectJacobiansMatch(const ResidualFactor<Rows, Variables...>& factor, const Values& values) {
  Eigen::MatrixXd J;
  evaluate(factor, values, &J);
  const Eigen::MatrixXd numeric = centralDifferences(
      [&](const Values& v) { return evaluate(factor, v); }, values, J.cols(), 1e-6);
  EXPECT_NEAR((J - numeric).cwiseAbs().maxCoeff(), 0.0, 1e-6 * (1.0 + J.cwiseAbs().maxCoeff()));
}

/// What Factor::linearize returns, both triangles.
struct Linearized {
  double cost;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};
inline Linearized linearize(const Factor& factor, const Values& values) {
  const Eigen::Index rows = factor.tangentRows();
  Linearized result{0.0, Eigen::MatrixXd::Constant(rows, rows, NAN),
                    Eigen::VectorXd::Constant(rows, NAN)};
  result.cost = factor.linearize(views(values).data(), result.H.data(), result.g.data());
  result.H = Eigen::MatrixXd(result.H.selfadjointView<Eigen::Lower>());
  return result;
}

/// Factor::linearize against the definition: H = w J' Omega J, g = w J' Omega e.
template <int Rows, typename... Variables>
void expectLinearizeMatches(const ResidualFactor<Rows, Variables...>& factor,
                            const Values& values) {
  Eigen::MatrixXd J;
  const Eigen::VectorXd e = evaluate(factor, values, &J);
  const double chi2 = e.dot(factor.information() * e);
  const double weight = factor.kernel().weight(chi2);
  const Eigen::MatrixXd H = weight * J.transpose() * factor.information() * J;
  const Eigen::VectorXd g = weight * J.transpose() * factor.information() * e;
  const Linearized got = linearize(factor, values);
  EXPECT_NEAR((got.H - H).norm(), 0.0, 1e-12 * (1.0 + H.norm()));
  EXPECT_NEAR((got.g - g).norm(), 0.0, 1e-12 * (1.0 + g.norm()));
  EXPECT_NEAR(got.cost, factor.kernel().cost(chi2), 1e-12 * (1.0 + chi2));
}

/// Factor::linearize of any factor against its cost: equal to it, and its slope twice g.
inline void expectGradientMatches(const Factor& factor, const Values& values) {
  const Linearized got = linearize(factor, values);
  const double cost = factor.cost(views(values).data());
  EXPECT_NEAR(got.cost, cost, 1e-12 * (1.0 + std::abs(cost)));
  const Eigen::MatrixXd slope = centralDifferences(
      [&](const Values& v) { return Eigen::Matrix<double, 1, 1>(factor.cost(views(v).data())); },
      values, got.g.size(), 1e-6);
  EXPECT_NEAR((2.0 * got.g - slope.transpose()).cwiseAbs().maxCoeff(), 0.0,
              1e-5 * (1.0 + std::abs(cost) + got.g.cwiseAbs().maxCoeff()));
}

/// Symmetric, positive definite, well conditioned.
template <int Size>
Eigen::Matrix<double, Size, Size> randomInformation(RandomGeometry* random) {
  Eigen::Matrix<double, Size, Size> root;
  for (int k = 0; k < root.size(); ++k) root(k) = random->number(3.0);
  return root * root.transpose() + Eigen::Matrix<double, Size, Size>::Identity();
}

inline Eigen::Vector3d randomDirection(RandomGeometry* random) {
  return expSO3(M_PI * random->vector(1.0)) * Eigen::Vector3d::UnitZ();
}

/// A plane at most so far from the origin, looking anywhere.
inline Plane randomPlane(RandomGeometry* random, double limit_m) {
  return {randomDirection(random), random->number(limit_m)};
}

}  // namespace mrpt_sgraphs::test
