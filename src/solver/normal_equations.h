// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <vector>

#include "dense_kernels.h"
#include "elimination_plan.h"
#include "mrpt_sgraphs/solver/problem.h"

namespace mrpt_sgraphs {

/// The normal equations H delta = -g of a problem, H = sum J' Omega J, made and factorized in one
/// sweep (the multifrontal method): each factor adds its blocks to the front where its first variable
/// is eliminated, each front hands what is left to its parent. H itself is nowhere.
///
/// What depends on the structure alone is found once: the sweep searches nothing and allocates
/// nothing, and threads that share it give the same bits as one.
class NormalEquations {
 public:
  /// Orders the free variables and lays out memory.
  explicit NormalEquations(const Problem& problem);

  /// Has `problem` the structure that this was made for? The factors may be others of the same sizes.
  bool fits(const Problem& problem) const;

  /// Takes the variables and factors of a problem that fits. It has to stay where it is while the
  /// others are called.
  void bind(const Problem& problem);

  struct Sweep {
    double cost = 0.0;      ///< Of all factors, at the problem's values.
    double decrease = 0.0;  ///< g' (H + D)^-1 g: that of the quadratic model, if undamped.
    double linearize_ms = 0.0;  ///< CPU of all threads
    double factorize_ms = 0.0;  ///< CPU of all threads
    double other_threads_ms = 0.0;  ///< CPU, of all but the calling one.
    /// Tangents that nothing determines once those before them are known. They are held.
    std::vector<int> held;
    bool indefinite = false;  ///< A pivot was clearly negative, or not a number.
  };

  /// @param damping  D = damping * scales() is added to the diagonal of H.
  Sweep factorize(double damping, int threads);

  /// The step of all tangents, in elimination order, by back substitution.
  void solve(std::vector<double>* step) const;

  /// A direction that costs nothing: tangent `held` moves by one, those before it follow.
  void freeDirection(int held, std::vector<double>* step) const;

  /// Moves the variables of the problem that it is bound to.
  void retract(const std::vector<double>& step, Problem* problem) const;

  /// The cost at the problem's values, without any derivative.
  double cost() const { return costFrom(0); }

  int tangents() const { return plan_.tangent.back(); }
  /// What damping is relative to, in elimination order: the diagonal of H as of the last sweep, the
  /// largest entry for all tangents of a variable that have the same unit.
  const std::vector<double>& scales() const { return scales_; }
  /// The variable of a tangent.
  int variableOf(int tangent) const;
  const EliminationPlan& plan() const { return plan_; }

 private:
  struct End {
    int offset = 0;  ///< Row in its front; -1: fixed.
    int size = 0;
  };
  struct BoundFactor {
    const Factor* factor = nullptr;
    int first_end = 0;
    int ends = 0;
    int tangents = 0;
  };
  struct Worker;

  void assignFactors(const Problem& problem);
  double costFrom(int first_factor) const;
  void processFront(int index, double damping, Worker* worker);
  void assemble(int index, const FrontView& view, double* pivot_diagonal, double* row_diagonal,
                Worker* worker);
  void extendAdd(const Front& child, const Front& parent, const FrontView& view,
                 double* pivot_diagonal, double* row_diagonal);
  void useLargestOfEachUnit(const Front& front, double* diagonal) const;
  /// Back substitution, the right-hand side of each front's pivots given by `fill`.
  template <typename RightHandSide>
  void substitute(const RightHandSide& fill, std::vector<double>* step) const;
  FrontView viewOf(const Front& front);

  std::vector<int> structure_;  ///< What fits() compares.
  EliminationPlan plan_;
  std::vector<int> free_variables_;       ///< In elimination order, as indices of the problem.
  std::vector<int> factor_order_;         ///< Front by front; those without a free variable last.
  std::vector<int> first_factor_;         ///< Of each front, and behind the last.
  std::vector<BoundFactor> factors_;      ///< In that order.
  std::vector<End> ends_;
  std::vector<VariableView> views_;  ///< Of each end, in the problem that this is bound to.
  int max_tangents_ = 0;
  std::unique_ptr<double[]> panels_;
  std::unique_ptr<double[]> updates_;
  std::vector<double> scales_;
  std::vector<double> front_cost_;
  std::vector<double> front_decrease_;
};

}  // namespace mrpt_sgraphs
