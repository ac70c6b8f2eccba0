// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "elimination_plan.h"

#include <algorithm>
#include <numeric>

#include "dense_kernels.h"
#include "fill_columns.h"

namespace mrpt_sgraphs {
namespace {

/// Operations a tangent from which on nested dissection is tried: tiny fronts stay far below it.
constexpr double kHeavyFill_flops = 1e4;
/// Fewer operations are not shared among threads.
constexpr double kMinParallel_flops = 2e6;
constexpr double kSubtreeShare = 1.0 / 16.0;

class PlanBuilder {
 public:
  PlanBuilder(const VariableGraph& graph, const std::vector<int>& order, const Columns& columns)
      : graph_(graph), order_(order), columns_(columns) {}

  EliminationPlan build() {
    const std::vector<int> group_of = groupColumns(columns_);
    const std::vector<int> groups = postorder(columns_, group_of);
    orderVariables(group_of, groups);
    fillRows(groups);
    findChildren();
    findRuns();
    shareAmongThreads();
    layOutMemory();
    return std::move(plan_);
  }

 private:
  /// The new order: front by front, in each as before.
  void orderVariables(const std::vector<int>& group_of, const std::vector<int>& groups) {
    const std::size_t count = order_.size();
    std::vector<int> front_of_group(count, -1);
    plan_.fronts.resize(groups.size());
    for (std::size_t f = 0; f < groups.size(); ++f) {
      front_of_group[groups[f]] = static_cast<int>(f);
    }
    for (std::size_t k = 0; k < count; ++k) ++plan_.fronts[front_of_group[group_of[k]]].variables;
    int variables = 0;
    for (Front& front : plan_.fronts) {
      front.first_variable = variables;
      variables += front.variables;
    }
    std::vector<int> next(groups.size());
    for (std::size_t f = 0; f < groups.size(); ++f) next[f] = plan_.fronts[f].first_variable;
    plan_.order.resize(count);
    plan_.position.resize(count);
    plan_.front_of.resize(count);
    new_position_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const int front = front_of_group[group_of[k]];
      const int position = next[front]++;
      new_position_[k] = position;
      plan_.order[position] = order_[k];
      plan_.position[order_[k]] = position;
      plan_.front_of[position] = front;
    }
    plan_.tangent.resize(count + 1);
    plan_.tangent[0] = 0;
    for (std::size_t k = 0; k < count; ++k) {
      plan_.tangent[k + 1] = plan_.tangent[k] + graph_.sizes[plan_.order[k]];
    }
    for (Front& front : plan_.fronts) {
      front.first_pivot = plan_.tangent[front.first_variable];
      front.pivots = plan_.tangent[front.first_variable + front.variables] - front.first_pivot;
    }
  }

  void fillRows(const std::vector<int>& groups) {
    std::vector<int> positions;
    for (std::size_t f = 0; f < groups.size(); ++f) {
      Front& front = plan_.fronts[f];
      positions.clear();
      for (const int row : columns_.filled[groups[f]]) positions.push_back(new_position_[row]);
      std::sort(positions.begin(), positions.end());
      front.first_row = static_cast<int>(plan_.rows.size());
      for (const int position : positions) {
        for (int t = plan_.tangent[position]; t < plan_.tangent[position + 1]; ++t) {
          plan_.rows.push_back(t);
        }
      }
      front.rows = static_cast<int>(plan_.rows.size()) - front.first_row;
      front.parent = positions.empty() ? -1 : plan_.front_of[positions.front()];
      plan_.flops += flopsOf(front.pivots, front.rows);
    }
  }

  void findChildren() {
    for (const Front& front : plan_.fronts) {
      if (front.parent >= 0) ++plan_.fronts[front.parent].children;
    }
    int first = 0;
    for (Front& front : plan_.fronts) {
      front.first_child = first;
      first += front.children;
      front.children = 0;
    }
    plan_.children.resize(static_cast<std::size_t>(first));
    for (std::size_t f = 0; f < plan_.fronts.size(); ++f) {
      if (plan_.fronts[f].parent < 0) continue;
      Front& parent = plan_.fronts[plan_.fronts[f].parent];
      plan_.children[parent.first_child + parent.children++] = static_cast<int>(f);
    }
    for (std::size_t f = plan_.fronts.size(); f-- > 0;) {
      Front& front = plan_.fronts[f];
      front.depth = front.parent < 0 ? 0 : plan_.fronts[front.parent].depth + 1;
    }
  }

  void findRuns() {
    std::vector<int> row_of(static_cast<std::size_t>(plan_.tangent.back()));
    for (const Front& parent : plan_.fronts) {
      if (parent.children == 0) continue;
      for (int k = 0; k < parent.pivots; ++k) row_of[parent.first_pivot + k] = k;
      for (int k = 0; k < parent.rows; ++k) {
        row_of[plan_.rows[parent.first_row + k]] = parent.pivots + k;
      }
      for (int c = 0; c < parent.children; ++c) {
        Front& child = plan_.fronts[plan_.children[parent.first_child + c]];
        child.first_run = static_cast<int>(plan_.runs.size());
        for (int k = 0; k < child.rows; ++k) {
          const int row = row_of[plan_.rows[child.first_row + k]];
          const bool begins = k == 0 || plan_.runs.back().parent_row + plan_.runs.back().size != row;
          if (begins) plan_.runs.push_back({k, row, 0});
          ++plan_.runs.back().size;
        }
        child.runs = static_cast<int>(plan_.runs.size()) - child.first_run;
      }
    }
  }

  /// Subtrees of about equal work; what is above them is done by one thread.
  void shareAmongThreads() {
    const int count = static_cast<int>(plan_.fronts.size());
    if (plan_.flops < kMinParallel_flops) {
      if (count > 0) plan_.subtrees.push_back({0, count});
      return;
    }
    std::vector<double> work(plan_.fronts.size());
    std::vector<int> first(plan_.fronts.size());  // of each subtree
    for (int f = 0; f < count; ++f) {
      const Front& front = plan_.fronts[f];
      work[f] += flopsOf(front.pivots, front.rows);
      first[f] = front.children == 0 ? f : first[plan_.children[front.first_child]];
      if (front.parent >= 0) work[front.parent] += work[f];
    }
    const double share = plan_.flops * kSubtreeShare;
    for (int f = 0; f < count; ++f) {
      if (work[f] > share) {
        plan_.top.push_back(f);
      } else if (plan_.fronts[f].parent < 0 || work[plan_.fronts[f].parent] > share) {
        const bool fits = !plan_.subtrees.empty() && plan_.subtrees.back().last == first[f] &&
                          work_of_last_ + work[f] <= share;
        if (fits) {
          plan_.subtrees.back().last = f + 1;
          work_of_last_ += work[f];
        } else {
          plan_.subtrees.push_back({first[f], f + 1});
          work_of_last_ = work[f];
        }
      }
    }
  }

  /// Panels stay. Updates live until their parent has taken them: two stacks for each subtree, for
  /// even and odd depths, so that a front's children are always the last ones of the other stack.
  void layOutMemory() {
    for (Front& front : plan_.fronts) {
      front.panel = plan_.panel_memory;
      plan_.panel_memory += FrontView::panelSize(front.pivots, front.rows);
    }
    for (const EliminationPlan::Subtree& subtree : plan_.subtrees) {
      std::vector<int> fronts(static_cast<std::size_t>(subtree.last - subtree.first));
      std::iota(fronts.begin(), fronts.end(), subtree.first);
      layOutUpdates(fronts);
    }
    layOutUpdates(plan_.top);
  }

  void layOutUpdates(const std::vector<int>& fronts) {
    std::size_t top[2] = {0, 0};
    std::size_t highest[2] = {0, 0};
    std::vector<char> inside(plan_.fronts.size() > 0 ? plan_.fronts.size() : 1, 0);
    for (const int f : fronts) inside[f] = 1;
    for (const int f : fronts) {
      Front& front = plan_.fronts[f];
      const int own = front.depth % 2;
      front.update = top[own];
      top[own] += FrontView::updateSize(front.rows) + static_cast<std::size_t>(front.rows);
      highest[own] = std::max(highest[own], top[own]);
      for (int c = 0; c < front.children; ++c) {
        const Front& child = plan_.fronts[plan_.children[front.first_child + c]];
        if (inside[plan_.children[front.first_child + c]] != 0) {
          top[1 - own] = std::min(top[1 - own], child.update);
        }
      }
    }
    for (const int f : fronts) {
      Front& front = plan_.fronts[f];
      front.update += plan_.update_memory + (front.depth % 2 == 0 ? 0 : highest[0]);
    }
    plan_.update_memory += highest[0] + highest[1];
  }

  const VariableGraph& graph_;
  const std::vector<int>& order_;
  const Columns& columns_;
  std::vector<int> new_position_;
  EliminationPlan plan_;
  double work_of_last_ = 0.0;
};

}  // namespace

EliminationPlan planElimination(const VariableGraph& graph) {
  std::vector<int> order = minimumDegreeOrder(graph);
  Columns columns = eliminateColumns(graph, order);
  const double flops = flopsOf(columns);
  const double tangents = std::accumulate(graph.sizes.begin(), graph.sizes.end(), 0.0);
  bool nested_dissection = false;
  if (flops > kHeavyFill_flops * tangents) {
    std::vector<int> other_order = nestedDissectionOrder(graph);
    Columns other = eliminateColumns(graph, other_order);
    if (flopsOf(other) < flops) {
      nested_dissection = true;
      order = std::move(other_order);
      columns = std::move(other);
    }
  }
  EliminationPlan plan = PlanBuilder(graph, order, columns).build();
  plan.nested_dissection = nested_dissection;
  return plan;
}

}  // namespace mrpt_sgraphs
