// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/hierarchy/whole_graph.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "graph_values.h"
#include "mrpt_sgraphs/factors/plane_observation.h"
#include "mrpt_sgraphs/factors/condensed.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/hierarchy/compression.h"
#include "mrpt_sgraphs/hierarchy/optimize_selection.h"
#include "mrpt_sgraphs/hierarchy/put_together.h"
#include "mrpt_sgraphs/hierarchy/whole_graph_regions.h"

namespace mrpt_sgraphs {
namespace {

/// Keyframes in a row in no room: more make fewer portals, and denser condensed factors.
constexpr std::size_t kLongestStretch = 20;
/// What is condensed again at the end need not be to the last digit before.
constexpr double kRoughDecrease = 0.01;
/// So little of the full cost is left between it and the condensed one: the same optimum.
constexpr double kSameCost = 1e-6;
constexpr int kMostRounds = 10;

HierarchyConfig configOf(const std::string& mode) {
  if (mode != "paper" && mode != "condensed") {
    throw std::invalid_argument(
        "the whole graph is compressed in mode 'paper' or 'condensed', not '" + mode + "'");
  }
  HierarchyConfig config;
  config.mode = mode;
  return config;
}

class WholeGraph {
 public:
  WholeGraph(const std::string& mode, const OptimizerConfig& config, LayeredGraph* graph)
      : is_paper_(mode == "paper"),
        config_(config),
        compression_(configOf(mode)),
        graph_(*graph),
        full_cost_(*graph) {
    rough_config_ = config;
    rough_config_.min_relative_decrease = std::max(config.min_relative_decrease, kRoughDecrease);
  }

  WholeGraphReport run() {
    OptimizerReport& global = report_.global;
    global.cost_before = full_cost_.of(graph_);
    compress();
    double cost = global.cost_before;
    while (true) {
      ++report_.rounds;
      if (report_.rounds > 1) condenseAgain();
      optimizeGlobally();
      resolve();
      if (is_paper_) break;
      const double before = std::exchange(cost, full_cost_.of(graph_));
      // in the first round they may agree by chance: how far it went tells nothing yet
      const bool is_done = report_.rounds > 1 &&
                           (std::abs(cost - report_.condensed_cost) <= kSameCost * cost ||
                            std::abs(cost - before) <= kSameCost * cost);
      if (is_done || !global.problem.empty()) break;
      if (report_.rounds == kMostRounds) {
        global.converged = false;
        global.problem = "condensed so often that it should have been enough";
        break;
      }
    }
    global.cost_after = full_cost_.of(graph_);
    return std::move(report_);
  }

 private:
  using Plans = std::vector<RegionPlan>;

  void compress() {
    const Values before(graph_);
    CpuStopwatch watch;
    const Plans plans =
        is_paper_ ? planWholeGraphByTheLetter(graph_) : planWholeGraph(graph_, kLongestStretch);
    report_.plan_ms = watch.lap();
    for (auto first = plans.begin(); first != plans.end();) {
      const auto last = std::find_if(
          first, plans.end(), [&](const RegionPlan& plan) { return plan.kept != first->kept; });
      optimizeRegion(first, last, before);
      report_.room_local_ms += watch.lap();
      for (auto visit = first; visit != last; ++visit) {
        compression_.apply(*visit, &graph_);
        const double visit_ms = watch.lap();
        report_.condense_ms += visit_ms;
        if (visit->room) report_.visit_ms.push_back(visit_ms);
        rememberWays(*visit);
        watch.lap();
      }
      if (!graph_.shelf().keptBy(first->kept).empty()) kept_.push_back(first->kept);
      first = last;
    }
    goBackTo(before);
    if (!is_paper_) putTogetherIfBetter(before);
    report_.global_ms += watch.lap();
    report_.dropped = ways_.size();
    report_.active = graph_.size(Layer::kKeyframe) - ways_.size();
    report_.condensed = countStandIns();
  }

  /// Under all that is known about the keyframes that will go, and nothing else: what is around may
  /// be far from where it belongs, as a later stay in a room is before the first loop is closed.
  void optimizeRegion(Plans::const_iterator first, Plans::const_iterator last,
                      const Values& before) {
    std::set<FactorId> ids;
    for (auto visit = first; visit != last; ++visit) {
      for (const KeyframeId id : visit->dropped) {
        for (const FactorLink& link : graph_.sightingsOf(id)) ids.insert(link.id);
        for (const FactorLink& link : graph_.otherFactorsOf(id)) ids.insert(link.id);
      }
    }
    std::vector<FactorConstPtr> factors;
    for (const FactorId id : ids) {
      factors.push_back(graph_.factor(id));
      const Factor& factor = *factors.back();
      for (int k = 0; k < factor.nodeCount(); ++k) {
        before.writeTo(&graph_, graph_.handle(factor.node(k)));
      }
    }
    for (auto visit = std::next(first); visit != last; ++visit) {
      bringToTheFirst(*visit);
      factors.push_back(sameLevel(*visit));
    }
    const NodeId kept = first->kept;
    optimizeUnder(
        factors, [&](NodeId node) { return node != kept; }, rough_config_, &graph_);
  }

  /// Walls tell how a later stay lies to the first, all but its height: tilted by no more than
  /// noise they put it metres off, and all lever arms with it. Only for the values that factors are
  /// linearized at, not among what is condensed.
  static FactorConstPtr sameLevel(const RegionPlan& visit) {
    constexpr double kSigma_m = 0.1;
    Matrix6 information = Matrix6::Zero();
    information(2, 2) = 1.0 / (kSigma_m * kSigma_m);
    return std::make_shared<RelativePoseFactor>(visit.kept, visit.dropped.front(), Pose::Identity(),
                                                information);
  }

  /// How a stay has to be turned for its walls to lie as the graph has them; identity where too few
  /// directions are seen.
  Eigen::Matrix3d turnOntoWalls(const RegionPlan& visit) const {
    constexpr double kLeast = 1e-3;  // of the second direction, in proportion to the first
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const KeyframeId id : visit.dropped) {
      for (const FactorLink& link : graph_.sightingsOf(id)) {
        const auto* seen =
            dynamic_cast<const PlaneObservationFactor*>(graph_.factor(link.id).get());
        if (seen == nullptr) continue;
        const Plane surface_map = graph_.plane(graph_.handle(seen->node(1)));
        sum += surface_map.normal *
               (graph_.pose(id).linear() * seen->measured_base.normal).transpose();
      }
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.singularValues()(1) <= kLeast * svd.singularValues()(0)) {
      return Eigen::Matrix3d::Identity();
    }
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }

  /// A later stay turned as its walls say, and as if it had begun where the first did.
  void bringToTheFirst(const RegionPlan& visit) {
    Pose motion = Pose::Identity();
    motion.linear() = turnOntoWalls(visit);
    motion.translation() = graph_.pose(visit.kept).translation() -
                           motion.linear() * graph_.pose(visit.dropped.front()).translation();
    for (const auto* const keyframes : {&visit.dropped, &visit.stay}) {
      for (const KeyframeId id : *keyframes) {
        if (id != visit.kept) graph_.setPose(id, orthonormalized(motion * graph_.pose(id)));
      }
    }
  }

  /// How the keyframes that were dropped lie from those that they go with.
  void rememberWays(const RegionPlan& visit) {
    for (const KeyframeId id : visit.dropped) {
      if (!graph_.attributes(id).marginalized) continue;  // its factors do not determine it
      const KeyframeId leader = *graph_.attributes(id).representative;
      ways_.emplace_back(id, graph_.pose(leader).inverse() * graph_.pose(id));
    }
  }

  /// Each region was optimized for itself: they do not fit together. What is left begins where it
  /// was.
  void goBackTo(const Values& before) {
    const Selection left = selectAll(graph_);
    for (const auto* const nodes : {&left.free, &left.fixed}) {
      for (const NodeId node : *nodes) before.writeTo(&graph_, graph_.handle(node));
    }
  }

  /// Where the values to begin with are far off, as odometry's are, the regions know better.
  void putTogetherIfBetter(const Values& before) {
    const FullCost left(graph_);
    const double cost = left.of(graph_);
    putTogether(&graph_);
    if (left.of(graph_) >= cost) goBackTo(before);
  }

  void condenseAgain() {
    CpuStopwatch watch;
    for (const KeyframeId kept : kept_) compression_.condenseAgain(kept, &graph_);
    report_.condense_ms += watch.lap();
  }

  void optimizeGlobally() {
    CpuStopwatch watch;
    const OptimizerReport report =
        optimizeSelection(selectAll(graph_), config_, &optimizer_, &graph_);
    report_.global_ms += watch.lap();
    if (report_.rounds == 1) report_.first_global_ms = report_.global_ms;
    report_.condensed_cost = report.cost_after;
    OptimizerReport& sum = report_.global;
    sum.iterations += report.iterations;
    sum.factorizations += report.factorizations;
    sum.converged = report.converged;
    sum.problem = report.problem;
    sum.free_tangents = report.free_tangents;
    sum.factors = report.factors;
    sum.gauge = report.gauge;
    sum.total_ms += report.total_ms;
    sum.analyze_ms += report.analyze_ms;
    sum.linearize_ms += report.linearize_ms;
    sum.factorize_ms += report.factorize_ms;
  }

  /// The dropped keyframes, first as they lay from those that they go with.
  void resolve() {
    CpuStopwatch watch;
    if (report_.rounds == 1) {
      for (const auto& [id, T_leader_id] : ways_) {
        const KeyframeId leader = *graph_.attributes(id).representative;
        graph_.setPose(id, orthonormalized(graph_.pose(leader) * T_leader_id));
      }
    }
    if (!is_paper_) {
      for (const KeyframeId kept : kept_) resolveDropped(kept, config_, &graph_);
    }
    report_.resolve_ms += watch.lap();
  }

  std::size_t countStandIns() const {
    std::size_t count = 0;
    for (uint32_t slot = 0; slot < graph_.factorCount(); ++slot) {
      const Factor& factor = *graph_.factorAt(slot).factor;
      const RelativePoseFactor* const edge = keyframeEdge(factor);
      const bool is_bridge = edge != nullptr && edge->kind == RelativePoseFactor::Kind::kBridge;
      if (is_bridge || dynamic_cast<const CondensedFactor*>(&factor) != nullptr) ++count;
    }
    return count;
  }

  const bool is_paper_;
  const OptimizerConfig config_;
  OptimizerConfig rough_config_;
  Compression compression_;
  LayeredGraph& graph_;
  const FullCost full_cost_;
  Optimizer optimizer_;
  std::vector<KeyframeId> kept_;
  std::vector<std::pair<KeyframeId, Pose>> ways_;  ///< From those that they go with.
  WholeGraphReport report_;
};

}  // namespace

WholeGraphReport optimizeWholeGraph(const std::string& mode, const OptimizerConfig& config,
                                    LayeredGraph* graph) {
  return WholeGraph(mode, config, graph).run();
}

}  // namespace mrpt_sgraphs
