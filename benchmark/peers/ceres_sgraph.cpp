// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <array>
#include <memory>

#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/relative_pose.h"
#include "mrpt_sgraphs/factors/relative_pose_quaternion.h"
#include "ceres_autodiff.h"
#include "peer.h"

/// Ceres on a graph's file: Levenberg-Marquardt with a sparse Cholesky factorization, one thread.
///
///     ceres_sgraph FILE.g2o|FILE.sg [--repeat N] [--out FILE]
///                  [--jacobians autodiff|analytic] [--radius R] [--library suite|eigen]
///
/// By default as its users have it: automatic differentiation, Ceres' own manifolds and damping. With
/// `--jacobians analytic --radius 1e8` as fast as we know to make it: the very residuals and Jacobians
/// that our solver uses, with respect to the tangents, and hardly any damping to begin with.
namespace mrpt_sgraphs::peers {
namespace {

template <typename Variable>
constexpr int kAmbient = 0;
template <>
constexpr int kAmbient<Pose> = 7;  ///< x y z qx qy qz qw
template <>
constexpr int kAmbient<Plane> = 4;  ///< nx ny nz d

Pose fromAmbient(const double* x, const Pose*) {
  Pose T = Pose::Identity();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(x);
  T.linear() = Eigen::Map<const Eigen::Quaterniond>(x + 3).toRotationMatrix();
  return T;
}
Plane fromAmbient(const double* x, const Plane*) {
  return {Eigen::Map<const Eigen::Vector3d>(x), x[3]};
}

std::array<double, 7> toAmbient(const Pose& T) {
  std::array<double, 7> x{};
  Eigen::Map<Eigen::Vector3d>(x.data()) = T.translation();
  Eigen::Map<Eigen::Quaterniond>(x.data() + 3) = Eigen::Quaterniond(T.linear()).normalized();
  return x;
}
std::array<double, 4> toAmbient(const Plane& plane) {
  return {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.distance};
}

/// The Jacobians of Cost are those of the tangents already: PlusJacobian is an identity with empty rows
/// below, so that no column is computed for nothing.
template <typename Variable>
class TangentManifold final : public ceres::Manifold {
 public:
  static constexpr int kTangent = kTangentSize<Variable>;
  int AmbientSize() const override { return kAmbient<Variable>; }
  int TangentSize() const override { return kTangent; }

  bool Plus(const double* x, const double* delta, double* moved) const override {
    const auto result =
        toAmbient(retract(fromAmbient(x, static_cast<const Variable*>(nullptr)),
                          Eigen::Map<const Eigen::Matrix<double, kTangent, 1>>(delta).eval()));
    std::copy(result.begin(), result.end(), moved);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, kAmbient<Variable>, kTangent, Eigen::RowMajor>>(jacobian)
        .setIdentity();
    return true;
  }
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }
};

template <int Rows, typename First, typename Second>
class Cost final : public ceres::SizedCostFunction<Rows, kAmbient<First>, kAmbient<Second>> {
 public:
  explicit Cost(const ResidualFactor<Rows, First, Second>& factor)
      : factor_(factor), root_(factor.information().llt().matrixU()) {}

  bool Evaluate(double const* const* x, double* residual, double** jacobians) const override {
    const First first = fromAmbient(x[0], static_cast<const First*>(nullptr));
    const Second second = fromAmbient(x[1], static_cast<const Second*>(nullptr));
    Eigen::Matrix<double, Rows, kTangentSize<First>> J_first;
    Eigen::Matrix<double, Rows, kTangentSize<Second>> J_second;
    const bool wanted = jacobians != nullptr;
    Eigen::Map<Eigen::Matrix<double, Rows, 1>>(residual).noalias() =
        root_ * factor_.evaluate(first, second, wanted ? &J_first : nullptr,
                                 wanted ? &J_second : nullptr);
    if (wanted) {
      store<First>(J_first, jacobians[0]);
      store<Second>(J_second, jacobians[1]);
    }
    return true;
  }

 private:
  template <typename Variable, typename Jacobian>
  void store(const Jacobian& J, double* jacobian) const {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::Matrix<double, Rows, kAmbient<Variable>, Eigen::RowMajor>> out(jacobian);
    out.template leftCols<kTangentSize<Variable>>().noalias() = root_ * J;
    out.template rightCols<kAmbient<Variable> - kTangentSize<Variable>>().setZero();
  }

  const ResidualFactor<Rows, First, Second>& factor_;
  Eigen::Matrix<double, Rows, Rows> root_;
};

struct State {
  std::vector<std::array<double, 7>> poses;
  std::vector<std::array<double, 4>> planes;
  std::unique_ptr<ceres::Problem> problem;
};

std::string further(const Options& options, const std::string& name, const char* otherwise) {
  const auto found = options.further.find(name);
  return found == options.further.end() ? otherwise : found->second;
}

ceres::CostFunction* costFunction(const Factor& factor, bool analytic) {
  if (const auto* seen = dynamic_cast<const PlaneObservationFactor*>(&factor)) {
    if (!analytic) return autodiff(*seen);
    return new Cost<3, Pose, Plane>(*seen);
  }
  const auto& relative = dynamic_cast<const ResidualFactor<6, Pose, Pose>&>(factor);
  if (analytic) return new Cost<6, Pose, Pose>(relative);
  if (const auto* logarithm = dynamic_cast<const RelativePoseFactor*>(&factor)) {
    return autodiff(relative, logarithm->T_from_to, true);
  }
  const auto& quaternion = dynamic_cast<const RelativePoseQuaternionFactor&>(factor);
  return autodiff(relative, quaternion.T_from_to, false);
}

ceres::Solver::Options solverOptions(const Options& options) {
  ceres::Solver::Options ceres_options;
  ceres_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  ceres_options.sparse_linear_algebra_library_type =
      further(options, "--library", "suite") == "eigen" ? ceres::EIGEN_SPARSE : ceres::SUITE_SPARSE;
  ceres_options.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  ceres_options.initial_trust_region_radius = std::stod(further(options, "--radius", "1e4"));
  ceres_options.max_trust_region_radius = 1e32;
  ceres_options.num_threads = 1;
  ceres_options.max_num_iterations = 200;
  ceres_options.function_tolerance = 1e-6;
  ceres_options.gradient_tolerance = 0.0;
  ceres_options.parameter_tolerance = 0.0;
  ceres_options.logging_type = ceres::SILENT;
  return ceres_options;
}

Solve build(const Options& options, IndexedGraph* indexed) {
  const auto state = std::make_shared<State>();
  ceres::Problem::Options problem_options;
  problem_options.disable_all_safety_checks = true;
  state->problem = std::make_unique<ceres::Problem>(problem_options);
  for (const auto& keyframe : indexed->graph.keyframes) {
    state->poses.push_back(toAmbient(keyframe.T_map_base));
  }
  for (const auto& wall : indexed->graph.walls) state->planes.push_back(toAmbient(wall.plane_map));
  const bool analytic = further(options, "--jacobians", "autodiff") == "analytic";
  for (auto& x : state->poses) {
    state->problem->AddParameterBlock(
        x.data(), 7, analytic ? new TangentManifold<Pose> : poseManifold());
  }
  for (auto& x : state->planes) {
    state->problem->AddParameterBlock(
        x.data(), 4, analytic ? new TangentManifold<Plane> : planeManifold());
  }
  for (std::size_t k = 0; k < indexed->ends.size(); ++k) {
    const Factor& factor = *indexed->graph.factors[k];
    const auto [first, second] = indexed->ends[k];
    double* const second_x = isPlane(factor.node(1).layer) ? state->planes[second].data()
                                                           : state->poses[second].data();
    state->problem->AddResidualBlock(costFunction(factor, analytic), nullptr,
                                     state->poses[first].data(), second_x);
  }
  state->problem->SetParameterBlockConstant(state->poses[indexed->held].data());

  return [state, indexed, ceres_options = solverOptions(options)] {
    ceres::Solver::Summary summary;
    ceres::Solve(ceres_options, state->problem.get(), &summary);
    for (std::size_t k = 0; k < state->poses.size(); ++k) {
      indexed->graph.keyframes[k].T_map_base =
          fromAmbient(state->poses[k].data(), static_cast<const Pose*>(nullptr));
    }
    for (std::size_t k = 0; k < state->planes.size(); ++k) {
      indexed->graph.walls[k].plane_map =
          fromAmbient(state->planes[k].data(), static_cast<const Plane*>(nullptr));
    }
    return Solved{summary.num_successful_steps + summary.num_unsuccessful_steps - 1,
                  summary.termination_type == ceres::CONVERGENCE};
  };
}

}  // namespace
}  // namespace mrpt_sgraphs::peers

int main(int argc, char** argv) {
  using namespace mrpt_sgraphs::peers;
  return guarded([&] { return run(optionsOf(argc, argv), build); });
}
