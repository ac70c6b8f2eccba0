// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/solver/optimizer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "gauge.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "normal_equations.h"

namespace mrpt_sgraphs {
namespace {

/// Damping when Gauss-Newton fails for the first time; relative to the diagonal of H.
constexpr double kFirstDamping = 1e-9;
/// Below it damping is none.
constexpr double kMinDamping = 1e-10;
/// Gauss-Newton may climb for so many steps before it has to be below where it began: bending a long
/// trajectory back costs more on the way than it saves at first.
constexpr int kMaxRises = 3;
/// Above it no step is large enough to matter.
constexpr double kMaxDamping = 1e10;
/// A cost that has fallen to this share of the first one is zero: all factors agree.
constexpr double kZeroCost = 1e-14;
/// A step so short, in metres for each metre from the origin and in radians, is rounding: where all
/// factors agree no share of the cost says so.
constexpr double kNoStep = 1e-12;
/// The model's promise was kept well enough to trust it further.
constexpr double kGoodGain = 0.5;

std::string inMilliseconds(double seconds) {
  return std::to_string(static_cast<long>(std::lround(1e3 * seconds))) + " ms";
}

/// The first factor whose cost is no number.
std::string nameOfBadFactor(const Problem& problem) {
  std::vector<VariableView> views;
  for (int f = 0; f < problem.factorCount(); ++f) {
    const Factor& factor = problem.factor(f);
    views.clear();
    for (int k = 0; k < factor.nodeCount(); ++k) {
      views.push_back(problem.view(problem.variablesOf(f)[k]));
    }
    if (std::isfinite(factor.cost(views.data()))) continue;
    std::string name = std::string(factor.type()) + " between";
    for (int k = 0; k < factor.nodeCount(); ++k) name += " " + nameOf(factor.node(k));
    return "the cost of the factor " + name + " is not finite";
  }
  return "the sum of all costs is not finite";
}

bool isFinite(const std::vector<double>& step) {
  return std::all_of(step.begin(), step.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

class Optimizer::Impl {
 public:
  OptimizerReport optimize(const OptimizerConfig& config, Problem* problem) {
    const double start_ms = threadCpuMilliseconds();
    const auto start = std::chrono::steady_clock::now();
    OptimizerReport report;
    report.factors = problem->factorCount();

    std::vector<int> held;
    report.gauge = floatingParts(*problem, &held);
    for (const int variable : held) problem->setFixed(variable, true);
    try {
      prepare(*problem, &report);
      Run(config, start, equations_.get(), problem, &report).run();
    } catch (const std::exception& error) {  // of an ordering, or for want of memory
      report.problem = error.what();
      report.converged = false;
      equations_.reset();
    }
    for (const int variable : held) problem->setFixed(variable, false);
    report.total_ms += threadCpuMilliseconds() - start_ms;
    return report;
  }

 private:
  void prepare(const Problem& problem, OptimizerReport* report) {
    CpuStopwatch watch;
    if (equations_ == nullptr || !equations_->fits(problem)) {
      equations_.reset();
      equations_ = std::make_unique<NormalEquations>(problem);
      report->analyze_ms = watch.lap();
    }
    equations_->bind(problem);
    report->free_tangents = equations_->tangents();
  }

  /// One optimization, from the first sweep to the last value.
  class Run {
   public:
    Run(const OptimizerConfig& config, std::chrono::steady_clock::time_point start,
        NormalEquations* equations, Problem* problem, OptimizerReport* report)
        : config_(config),
          start_(start),
          equations_(*equations),
          problem_(*problem),
          report_(*report) {}

    void run() {
      try {
        iterateToTheEnd();
      } catch (...) {
        goBack();
        report_.cost_after = cost_;
        throw;
      }
    }

   private:
    void iterateToTheEnd() {
      sweep_ = sweep(0.0);
      cost_ = best_cost_ = sweep_.cost;
      report_.cost_before = report_.cost_after = cost_;
      if (!std::isfinite(cost_)) {
        report_.problem = nameOfBadFactor(problem_);
        return;
      }
      while (!report_.converged && report_.problem.empty()) {
        if (report_.iterations >= config_.max_iterations) {
          report_.problem = "stopped after " + std::to_string(report_.iterations) + " iterations";
        } else if (config_.max_time_s > 0.0 && elapsed_s() > config_.max_time_s) {
          report_.problem = "stopped after " + inMilliseconds(elapsed_s());
        } else {
          iterate();
        }
      }
      goBack();
      report_.cost_after = cost_;
      nameFreeDirections();
    }

    double elapsed_s() const {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    NormalEquations::Sweep sweep(double damping) {
      ++report_.factorizations;
      NormalEquations::Sweep result = equations_.factorize(damping, config_.threads);
      report_.linearize_ms += result.linearize_ms;
      report_.factorize_ms += result.factorize_ms;
      report_.total_ms += result.other_threads_ms;
      if (damping == 0.0) held_ = result.held;
      return result;
    }

    /// From a factorized system at the current values to the next one.
    void iterate() {
      ++report_.iterations;
      CpuStopwatch watch;
      equations_.solve(&step_);
      report_.factorize_ms += watch.lap();
      const bool usable = isFinite(step_) && !sweep_.indefinite;
      const double promised = promisedDecrease();
      const bool is_last =
          usable && damping_ == 0.0 && (isSmall(promised) || isRounding(step_));
      if (usable) {
        if (best_is_current_) best_ = problem_.values();
        best_is_current_ = false;
        equations_.retract(step_, &problem_);
      }
      // Gauss-Newton mostly descends, so the next sweep tells the cost as well. Otherwise ask first.
      const bool sweeps_on = usable && damping_ == 0.0 && !is_last;
      NormalEquations::Sweep next;
      double new_cost = std::numeric_limits<double>::infinity();
      if (sweeps_on) {
        next = sweep(0.0);
        new_cost = next.cost;
      } else if (usable) {
        new_cost = equations_.cost();
      }

      if (new_cost <= best_cost_) {  // false for what is no number
        accept(promised, new_cost, is_last, sweeps_on ? &next : nullptr);
      } else if (sweeps_on && std::isfinite(new_cost) && rises_ < kMaxRises) {
        ++rises_;
        cost_ = new_cost;
        sweep_ = std::move(next);
      } else {
        reject(is_last);
      }
    }

    void accept(double promised, double new_cost, bool is_last, NormalEquations::Sweep* next) {
      const double decrease = best_cost_ - new_cost;
      cost_ = best_cost_ = new_cost;
      best_is_current_ = true;
      rises_ = 0;
      growth_ = kGrowth;
      if (is_last || cost_ <= kZeroCost * report_.cost_before) {
        report_.converged = true;
        return;
      }
      if (damping_ > 0.0) {
        // A damped step that gains little may just be too short: Gauss-Newton decides.
        if (isSmall(decrease)) {
          if (undamped_failed_ && damping_ <= kFirstDamping) {
            report_.converged = true;
            return;
          }
          undamped_failed_ = true;
          damping_ = damping_ <= kFirstDamping ? 0.0 : damping_ / (kGrowth * kGrowth);
        } else {
          damping_ *= decrease > kGoodGain * promised ? 0.1 : 1.0;
        }
        if (damping_ < kMinDamping) damping_ = 0.0;
      }
      sweep_ = next != nullptr ? std::move(*next) : sweep(damping_);
    }

    /// Back to the best values, with shorter steps.
    void reject(bool is_last) {
      goBack();
      // at the optimum rounding decides whether the cost falls
      if (is_last) {
        report_.converged = true;
        return;
      }
      rises_ = kMaxRises;
      damping_ = std::max(kFirstDamping, damping_ * growth_);
      growth_ *= 2.0;
      if (damping_ > kMaxDamping) {
        report_.problem =
            sweep_.indefinite
                ? "the information about " +
                      nameOf(problem_.node(equations_.variableOf(sweep_.held.front()))) +
                      " is indefinite: some factor rewards what it should punish"
                : "no step makes the cost smaller";
        return;
      }
      sweep_ = sweep(damping_);
    }

    void goBack() {
      if (!best_is_current_) problem_.setValues(best_);
      best_is_current_ = true;
      cost_ = best_cost_;
    }

    /// Of the quadratic model by the step.
    double promisedDecrease() const {
      double decrease = sweep_.decrease;
      if (damping_ > 0.0) {
        for (std::size_t k = 0; k < step_.size(); ++k) {
          decrease += damping_ * equations_.scales()[k] * step_[k] * step_[k];
        }
      }
      return decrease;
    }

    bool isSmall(double decrease) const {
      return decrease <= config_.min_relative_decrease * cost_ + kZeroCost * report_.cost_before;
    }

    bool isRounding(const std::vector<double>& step) const {
      double extent_m = 1.0;
      for (int v = 0; v < problem_.variableCount(); ++v) {
        extent_m = std::max(extent_m, isPlane(problem_.node(v).layer)
                                          ? std::abs(problem_.plane(v).distance)
                                          : problem_.pose(v).translation().cwiseAbs().maxCoeff());
      }
      return std::all_of(step.begin(), step.end(),
                         [&](double x) { return std::abs(x) <= kNoStep * extent_m; });
    }

    void nameFreeDirections() {
      if (held_.empty()) return;
      // the factor has to be that of the undamped system, at the values that come out
      sweep(0.0);
      for (GaugeFreedom& freedom : freeDirections(equations_, held_, problem_)) {
        report_.gauge.push_back(std::move(freedom));
      }
    }

    static constexpr double kGrowth = 4.0;

    const OptimizerConfig& config_;
    const std::chrono::steady_clock::time_point start_;
    NormalEquations& equations_;
    Problem& problem_;
    OptimizerReport& report_;
    NormalEquations::Sweep sweep_;
    Problem::Values best_;
    bool best_is_current_ = true;  ///< The problem has the best values; else best_ has them.
    double best_cost_ = 0.0;
    int rises_ = 0;  ///< Steps that were taken though the cost rose, since it was lowest.
    std::vector<double> step_;
    std::vector<int> held_;  ///< Tangents, by the last undamped sweep.
    double cost_ = 0.0;
    double damping_ = 0.0;
    double growth_ = kGrowth;
    bool undamped_failed_ = false;
  };

  std::unique_ptr<NormalEquations> equations_;
};

Optimizer::Optimizer() : impl_(std::make_unique<Impl>()) {}
Optimizer::~Optimizer() = default;
Optimizer::Optimizer(Optimizer&&) noexcept = default;
Optimizer& Optimizer::operator=(Optimizer&&) noexcept = default;

OptimizerReport Optimizer::optimize(const OptimizerConfig& config, Problem* problem) {
  return impl_->optimize(config, problem);
}

}  // namespace mrpt_sgraphs
