// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "normal_equations.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <exception>
#include <system_error>
#include <thread>

#include "mrpt_sgraphs/geometry/cpu_time.h"

namespace mrpt_sgraphs {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of so many fronts one has its time taken; of the first ones each.
constexpr int kSampledFronts = 16;

/// Less than this share of a diagonal entry left as its pivot is what rounding leaves of nothing. A
/// chain of 50 000 keyframes held at one end keeps about 1e-13.
constexpr double kMinPivotShare = 5e-14;
/// More than this share below zero is not rounding but a factor that rewards what it should punish.
constexpr double kIndefiniteShare = 1e-9;

/// target(row.., column..) += block, both column-major.
template <int Rows, int Columns>
void addBlock(const double* block, int block_ld, double* target, int target_ld) {
  for (int c = 0; c < Columns; ++c) {
    for (int r = 0; r < Rows; ++r) target[c * target_ld + r] += block[c * block_ld + r];
  }
}
template <int Rows, int Columns>
void addTransposed(const double* block, int block_ld, double* target, int target_ld) {
  for (int c = 0; c < Columns; ++c) {
    for (int r = 0; r < Rows; ++r) target[c * target_ld + r] += block[r * block_ld + c];
  }
}
using Adder = void (*)(const double*, int, double*, int);
/// By rows and columns being those of a pose or a plane.
constexpr Adder kAdders[2][2] = {{addBlock<3, 3>, addBlock<3, 6>}, {addBlock<6, 3>, addBlock<6, 6>}};
constexpr Adder kTransposedAdders[2][2] = {{addTransposed<3, 3>, addTransposed<3, 6>},
                                           {addTransposed<6, 3>, addTransposed<6, 6>}};

}  // namespace

/// What one thread needs for itself.
struct NormalEquations::Worker {
  std::vector<double> hessian;
  std::vector<double> gradient;
  std::vector<double> min_pivots;
  std::vector<LostPivot> lost;
  EliminationScratch scratch;
  std::vector<int> held;
  bool indefinite = false;
  std::exception_ptr error;  ///< What ended its work.
  double cpu_ms = 0.0;
  double sampled_s = 0.0;            ///< In some of the fronts, since clocks cost time as well:
  double sampled_linearize_s = 0.0;  ///< ... altogether and for linearizing alone.
};

FrontView NormalEquations::viewOf(const Front& front) {
  FrontView view;
  view.panel = panels_.get() + front.panel;
  view.update = updates_.get() + front.update;
  view.pivots = front.pivots;
  view.rows = front.rows;
  return view;
}

void NormalEquations::assemble(int index, const FrontView& view, double* pivot_diagonal,
                               double* row_diagonal, Worker* worker) {
  const int p = view.pivots;
  double cost = 0.0;
  double* const H = worker->hessian.data();
  double* const g = worker->gradient.data();
  for (int k = first_factor_[index]; k < first_factor_[index + 1]; ++k) {
    const BoundFactor& bound = factors_[k];
    const End* const ends = ends_.data() + bound.first_end;
    cost += bound.factor->linearize(views_.data() + bound.first_end, H, g);

    int column = 0;  // in the factor's own H
    for (int a = 0; a < bound.ends; column += ends[a].size, ++a) {
      if (ends[a].offset < 0) continue;
      double* const diagonal =
          ends[a].offset < p ? pivot_diagonal + ends[a].offset : row_diagonal + ends[a].offset - p;
      double* const target = view.column(ends[a].offset);
      const int ld = view.strideAt(ends[a].offset);
      for (int i = 0; i < ends[a].size; ++i) {
        diagonal[i] += H[(column + i) * (bound.tangents + 1)];
        target[i * ld + p + view.rows] -= g[column + i];
      }
      int row = column;
      for (int b = a; b < bound.ends; row += ends[b].size, ++b) {
        if (ends[b].offset < 0) continue;
        const double* const block = H + column * bound.tangents + row;
        if (ends[b].offset >= ends[a].offset) {
          kAdders[ends[b].size / 6][ends[a].size / 6](block, bound.tangents,
                                                      target + ends[b].offset, ld);
        } else {
          kTransposedAdders[ends[a].size / 6][ends[b].size / 6](
              block, bound.tangents, view.column(ends[b].offset) + ends[a].offset,
              view.strideAt(ends[b].offset));
        }
      }
    }
  }
  front_cost_[index] = cost;
}

void NormalEquations::extendAdd(const Front& child, const Front& parent, const FrontView& view,
                                double* pivot_diagonal, double* row_diagonal) {
  const double* const update = updates_.get() + child.update;
  const int child_ld = padded(child.rows + 1);
  const double* const child_diagonal = update + FrontView::updateSize(child.rows);
  const int p = view.pivots;
  const RowRun* const runs = plan_.runs.data() + child.first_run;
  for (int a = 0; a < child.runs; ++a) {
    for (int i = 0; i < runs[a].size; ++i) {
      const int column = runs[a].parent_row + i;
      const double* source = update + static_cast<std::ptrdiff_t>(runs[a].child_row + i) * child_ld;
      double* const target = view.column(column);
      for (int r = i; r < runs[a].size; ++r) {
        target[runs[a].parent_row + r] += source[runs[a].child_row + r];
      }
      for (int b = a + 1; b < child.runs; ++b) {
        double* const to = target + runs[b].parent_row;
        const double* const from = source + runs[b].child_row;
        for (int r = 0; r < runs[b].size; ++r) to[r] += from[r];
      }
      target[p + parent.rows] += source[child.rows];
      const double diagonal = child_diagonal[runs[a].child_row + i];
      if (column < p) {
        pivot_diagonal[column] += diagonal;
      } else {
        row_diagonal[column - p] += diagonal;
      }
    }
  }
}

/// Metres with metres and radians with radians: neither damping nor the test for zero may depend on
/// how a body's axes lie.
void NormalEquations::useLargestOfEachUnit(const Front& front, double* diagonal) const {
  for (int v = front.first_variable; v < front.first_variable + front.variables; ++v) {
    const int size = plan_.tangent[v + 1] - plan_.tangent[v];
    double* const first = diagonal + (plan_.tangent[v] - front.first_pivot);
    double* const second = first + (size == 6 ? 3 : 2);  // [t; theta], [a b; d]
    std::fill(first, second, *std::max_element(first, second));
    std::fill(second, first + size, *std::max_element(second, first + size));
  }
}

void NormalEquations::processFront(int index, double damping, Worker* worker) {
  const Front& front = plan_.fronts[index];
  const FrontView view = viewOf(front);
  const bool sampled = index < kSampledFronts || index % kSampledFronts == 0;
  const Clock::time_point start = sampled ? Clock::now() : Clock::time_point();
  const std::size_t panel_size = FrontView::panelSize(front.pivots, front.rows);
  const std::size_t update_size = FrontView::updateSize(front.rows);
  double* const pivot_diagonal = scales_.data() + front.first_pivot;
  double* const row_diagonal = view.update + update_size;
  std::memset(view.panel, 0, panel_size * sizeof(double));
  std::memset(view.update, 0, (update_size + static_cast<std::size_t>(front.rows)) * sizeof(double));
  std::memset(pivot_diagonal, 0, static_cast<std::size_t>(front.pivots) * sizeof(double));

  assemble(index, view, pivot_diagonal, row_diagonal, worker);
  if (sampled) worker->sampled_linearize_s += secondsSince(start);
  for (int c = 0; c < front.children; ++c) {
    extendAdd(plan_.fronts[plan_.children[front.first_child + c]], front, view, pivot_diagonal,
              row_diagonal);
  }

  useLargestOfEachUnit(front, pivot_diagonal);

  const int ld = view.panelStride();
  worker->min_pivots.resize(static_cast<std::size_t>(front.pivots));
  for (int k = 0; k < front.pivots; ++k) {
    view.panel[k * ld + k] += damping * pivot_diagonal[k];
    worker->min_pivots[k] = kMinPivotShare * pivot_diagonal[k];
  }
  worker->lost.clear();
  eliminatePivots(view, worker->min_pivots.data(), &worker->scratch, &worker->lost);
  for (const LostPivot& lost : worker->lost) {
    worker->held.push_back(front.first_pivot + lost.column);
    if (!(lost.value >= -kIndefiniteShare * pivot_diagonal[lost.column])) worker->indefinite = true;
  }
  double decrease = 0.0;
  for (int k = 0; k < front.pivots; ++k) {
    const double y = view.panel[k * ld + front.pivots + front.rows];
    decrease += y * y;
  }
  front_decrease_[index] = decrease;
  if (sampled) worker->sampled_s += secondsSince(start);
}

NormalEquations::Sweep NormalEquations::factorize(double damping, int threads) {
  const auto count = std::max<std::size_t>(
      1, std::min<std::size_t>(static_cast<std::size_t>(threads), plan_.subtrees.size()));
  std::vector<Worker> workers(count);
  for (Worker& worker : workers) {
    worker.hessian.resize(static_cast<std::size_t>(max_tangents_) *
                          static_cast<std::size_t>(max_tangents_));
    worker.gradient.resize(static_cast<std::size_t>(max_tangents_));
  }
  std::atomic<std::size_t> next{0};
  const auto work = [&](Worker* worker) {
    const double start_ms = threadCpuMilliseconds();
    try {
      for (std::size_t s = next++; s < plan_.subtrees.size(); s = next++) {
        for (int f = plan_.subtrees[s].first; f < plan_.subtrees[s].last; ++f) {
          processFront(f, damping, worker);
        }
      }
    } catch (...) {  // for want of memory; it may not leave the thread
      worker->error = std::current_exception();
    }
    worker->cpu_ms = threadCpuMilliseconds() - start_ms;
  };
  std::vector<std::thread> others;
  others.reserve(count);
  try {
    for (std::size_t t = 1; t < count; ++t) others.emplace_back(work, &workers[t]);
  } catch (const std::system_error&) {
    // no more threads to be had: those that are there do the work
  }
  work(&workers[0]);
  for (std::thread& other : others) other.join();
  for (const Worker& worker : workers) {
    if (worker.error) std::rethrow_exception(worker.error);
  }
  CpuStopwatch top;
  for (const int f : plan_.top) processFront(f, damping, &workers[0]);
  workers[0].cpu_ms += top.lap();

  Sweep sweep;
  for (std::size_t t = 1; t < count; ++t) sweep.other_threads_ms += workers[t].cpu_ms;
  for (const Worker& worker : workers) {
    const double share =
        worker.sampled_s > 0.0 ? worker.sampled_linearize_s / worker.sampled_s : 0.0;
    sweep.linearize_ms += share * worker.cpu_ms;
    sweep.factorize_ms += (1.0 - share) * worker.cpu_ms;
    sweep.held.insert(sweep.held.end(), worker.held.begin(), worker.held.end());
    sweep.indefinite = sweep.indefinite || worker.indefinite;
  }
  std::sort(sweep.held.begin(), sweep.held.end());
  for (const double cost : front_cost_) sweep.cost += cost;
  for (const double decrease : front_decrease_) sweep.decrease += decrease;
  // factors between fixed variables count, though nothing can be done about them
  sweep.cost += costFrom(first_factor_[plan_.fronts.size()]);
  return sweep;
}

void NormalEquations::solve(std::vector<double>* step) const {
  substitute([](const Front& front, const double* panel, double* right) {
    const int ld = FrontView::panelStride(front.pivots, front.rows);
    for (int k = 0; k < front.pivots; ++k) {
      right[k] = panel[static_cast<std::ptrdiff_t>(k) * ld + front.pivots + front.rows];
    }
  }, step);
}

void NormalEquations::freeDirection(int held, std::vector<double>* step) const {
  substitute([held](const Front& front, const double*, double* right) {
    std::fill(right, right + front.pivots, 0.0);
    const int own = held - front.first_pivot;  // its column is that of the identity
    if (own >= 0 && own < front.pivots) right[own] = 1.0;
  }, step);
}

template <typename RightHandSide>
void NormalEquations::substitute(const RightHandSide& fill, std::vector<double>* step) const {
  step->resize(static_cast<std::size_t>(tangents()));
  std::vector<double> later;
  std::vector<double> right;
  for (std::size_t f = plan_.fronts.size(); f-- > 0;) {
    const Front& front = plan_.fronts[f];
    const double* const panel = panels_.get() + front.panel;
    later.resize(static_cast<std::size_t>(front.rows));
    right.resize(static_cast<std::size_t>(front.pivots));
    for (int r = 0; r < front.rows; ++r) later[r] = (*step)[plan_.rows[front.first_row + r]];
    fill(front, panel, right.data());
    substituteBack(panel, front.pivots, front.rows, right.data(), later.data(),
                   step->data() + front.first_pivot);
  }
}

void NormalEquations::retract(const std::vector<double>& step, Problem* problem) const {
  for (std::size_t k = 0; k < free_variables_.size(); ++k) {
    problem->retractVariable(free_variables_[k], step.data() + plan_.tangent[k]);
  }
}

double NormalEquations::costFrom(int first_factor) const {
  double sum = 0.0;
  for (std::size_t k = static_cast<std::size_t>(first_factor); k < factors_.size(); ++k) {
    sum += factors_[k].factor->cost(views_.data() + factors_[k].first_end);
  }
  return sum;
}

int NormalEquations::variableOf(int tangent) const {
  const auto after = std::upper_bound(plan_.tangent.begin(), plan_.tangent.end(), tangent);
  return free_variables_[static_cast<std::size_t>(after - plan_.tangent.begin()) - 1];
}

}  // namespace mrpt_sgraphs
